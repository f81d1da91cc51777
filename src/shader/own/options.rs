//! What is asked of a shader file.

use std::collections::BTreeMap;

/// What is asked of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// Name of the function.
    pub function: String,
    /// Values by name, as written: parameters, uniforms and overrides.
    pub settings: BTreeMap<String, String>,
}

impl Default for Options {
    fn default() -> Self {
        Self { function: "threshold".to_owned(), settings: BTreeMap::new() }
    }
}
