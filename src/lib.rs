//! Statistical analysis and verification of hashed alpha thresholds, after Wyman & McGuire, *Improved Alpha Testing
//! Using Hashed Sampling* (2017).
//!
//! | wing | what lives there |
//! |---|---|
//! | [`threshold`] | the mathematics: from a footprint to a threshold, literal and robust |
//! | [`scene`] | cameras and surfaces: where footprints come from |
//! | [`stats`] | tests with true tails; knows nothing of alpha testing |
//! | `shader` (feature `shader`) | the same in shading languages, an interpreter for them, and the device |
//! | [`technique`] | what the sources compare with or build upon the hash |
//! | `render` (feature `render`) | scenes that simulate only the effects they call for |
//! | [`check`] | the verdict: claims, subjects, runs |
//! | [`cost`] | what accuracy and effects cost in time |
//! | `report` (feature `plots`; text, JSON and HTML with `cli`) | what people see |
//!
//! Where to begin: [`threshold::robust::Robust`] for a threshold to use, [`threshold::hashed::HashedAlpha`] for the
//! paper's to the letter, [`check::run`] for a verdict.

#[cfg(feature = "check")]
pub mod check;
#[cfg(feature = "check")]
pub mod cost;
#[cfg(feature = "render")]
pub mod render;
#[cfg(feature = "plots")]
pub mod report;
pub mod scene;
#[cfg(feature = "shader")]
pub mod shader;
#[cfg(feature = "check")]
pub mod stats;
#[cfg(feature = "check")]
pub mod technique;
pub mod threshold;

#[cfg(feature = "check")]
pub use check::{Budget, Subject, Suite};
pub use glam;
pub use threshold::footprint::Footprint;
pub use threshold::hashed::HashedAlpha;
pub use threshold::robust::Robust;
pub use threshold::two_scale::Variant;

/// The examples of the README, so that they are compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
