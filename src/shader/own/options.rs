//! What is asked of a shader file.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// The name of the function where none is given.
pub const THRESHOLD: &str = "threshold";

/// What `--map` calls the alpha that is tested.
pub(super) const ALPHA: &str = "alpha";

/// The largest file that is read.
pub const LARGEST_FILE: u64 = 4 << 20;

/// What is asked of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// Name of the function. Where it is [`THRESHOLD`] and the file has none of that name, the only one that sounds like it, or that
    /// discards, is taken.
    pub function: String,
    /// Values by name, as written: parameters, uniforms, overrides and macros.
    pub settings: BTreeMap<String, String>,
    /// What the file calls the values of a fragment, by our names for them, as in `position` and `pos`. The usual names need not be
    /// given.
    pub map: BTreeMap<String, String>,
    /// Folders in which files are looked for that an `#include` names, behind that of the file itself.
    pub include: Vec<PathBuf>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            function: THRESHOLD.to_owned(),
            settings: BTreeMap::new(),
            map: BTreeMap::new(),
            include: Vec::new(),
        }
    }
}

impl Options {
    /// The names in a file that something is said of.
    pub(super) fn names(&self) -> BTreeSet<&str> {
        // `block.member` is found by either.
        self.settings.keys().chain(self.map.values()).flat_map(|name| name.split('.')).collect()
    }
}
