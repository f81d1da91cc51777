//! How much work the exhaustive tests do.
#![allow(dead_code)] // Each test program includes this file and uses a part of it.

use std::sync::OnceLock;

/// The intensity of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Budget {
    /// Coarse strides: seconds.
    Quick,
    /// About a minute on two cores.
    Ci,
    /// Everything.
    Nightly,
}

impl Budget {
    const ALL: [(&'static str, Self); 3] =
        [("quick", Self::Quick), ("ci", Self::Ci), ("nightly", Self::Nightly)];

    /// Returns the value that belongs to this budget.
    pub fn pick<T>(self, quick: T, ci: T, nightly: T) -> T {
        match self {
            Self::Quick => quick,
            Self::Ci => ci,
            Self::Nightly => nightly,
        }
    }
}

/// Returns what `HASHED_ALPHA_BUDGET` asks for; `ci` where it is not set.
pub fn budget() -> Budget {
    static BUDGET: OnceLock<Budget> = OnceLock::new();
    *BUDGET.get_or_init(|| {
        let asked = std::env::var("HASHED_ALPHA_BUDGET").unwrap_or_else(|_| "ci".to_owned());
        let known = Budget::ALL.map(|(name, _)| name).join(", ");
        Budget::ALL
            .into_iter()
            .find(|(name, _)| *name == asked)
            .unwrap_or_else(|| panic!("HASHED_ALPHA_BUDGET is `{asked}`; known are {known}"))
            .1
    })
}
