//! What is asked of a shader file.

use std::collections::BTreeMap;

/// What is asked of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// Name of the function.
    pub function: String,
    /// Values by name, as written: parameters, uniforms and overrides.
    pub settings: BTreeMap<String, String>,
    /// What the file calls the values of a fragment, by our names for them, as in `position` and `pos`. The usual names need not be
    /// given.
    pub map: BTreeMap<String, String>,
}

impl Default for Options {
    fn default() -> Self {
        Self { function: "threshold".to_owned(), settings: BTreeMap::new(), map: BTreeMap::new() }
    }
}
