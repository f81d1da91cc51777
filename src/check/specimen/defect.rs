//! What a specimen is.

use crate::check::Subject;
use core::fmt;

/// A threshold with one defect.
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct Specimen {
    /// Its name, in words joined by hyphens.
    pub name: &'static str,
    /// What is wrong, in one sentence.
    pub defect: &'static str,
    /// What to change, in one sentence.
    pub mend: &'static str,
    /// Identifier of the claim that must reject it.
    pub claim: &'static str,
    /// Makes the threshold.
    pub subject: fn() -> Subject<'static>,
}

impl fmt::Debug for Specimen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Specimen({})", self.name)
    }
}
