//! Statistical analysis and verification of hashed alpha thresholds, after Wyman & McGuire, *Improved Alpha Testing
//! Using Hashed Sampling* (2017).
//!
//! Where to begin: [`Robust`] for a threshold to use, [`HashedAlpha`] for the paper's to the letter, `check::run` for a
//! verdict on a threshold of your own.
//!
//! ```
//! use hashed_alpha::{Footprint, Robust};
//!
//! // A position in object units, and its change to the next pixel along screen x and y.
//! let footprint = Footprint::<f32>::new([0.31, -1.72, 2.43], [0.0121, 0.0003, -0.0007], [0.0002, 0.0094, 0.0033]);
//! let threshold = Robust::default().threshold(&footprint)?;
//! let is_kept = 0.7 >= threshold;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Wings
//!
//! | wing | what lives there | feature |
//! |---|---|---|
//! | [`threshold`] | the mathematics: from a footprint to a threshold, literal and robust | |
//! | [`scene`] | cameras and surfaces: where footprints come from | |
//! | `check` | the verdict: claims, subjects, runs | `check` |
//! | `technique` | what the sources compare with or build upon the hash | `check` |
//! | `stats` | tests with true tails; knows nothing of alpha testing | `check` |
//! | `cost` | what accuracy and effects cost in time | `check` |
//! | `shader` | the threshold in shading languages, an interpreter for them, and the device | `shader` |
//! | `render` | scene files, and what simulates the effects that are in them | `render` |
//! | `report` | what people see: figures; text, JSON and HTML with `cli` | `plots` |
//!
//! # Features
//!
//! Without any feature the crate is [`threshold`] and [`scene`], on glam and libm.
//!
//! | feature | brings | by default |
//! |---|---|---|
//! | `threads` | batches on all cores | through `cli` |
//! | `check` | claims, subjects, runs; statistics, techniques, costs | through `cli` |
//! | `shader` | shader text in six languages, a reader and an interpreter of shaders | through `cli` |
//! | `gpu` | shaders on a device | yes |
//! | `render` | scene files, pictures, their metrics | through `cli` |
//! | `plots` | figures as SVG | through `cli` |
//! | `cli` | the command line, and the report that it writes | yes |
//!
//! # Words
//!
//! Where the field has a word it is used. These are ours:
//!
//! | word | means |
//! |---|---|
//! | pipeline | where a threshold comes from, and what becomes of it: source, strata, fade, clamp |
//! | footprint | a position on a surface and its two screen derivatives: what a threshold is computed from |
//! | variant | how scales follow from the derivatives: Listing 1, Listing 2, or an ablation of §5.4 |
//! | join | how the hashes of two octaves become one value |
//! | repair | a named difference of the robust threshold from the listings |
//! | twin | the WGSL function that computes what a Rust function computes |
//! | tier | one way to compute the same threshold in a batch, by accuracy and speed |
//! | subject | a threshold on trial, from wherever: a closure, a shader, a device |
//! | claim | a statement about thresholds with a trial that could refute it |
//! | outcome | what a trial of one claim on one subject found |
//! | standing | what an outcome is worth: as expected, against the subject, known, unanswered, not applicable |
//! | specimen | a threshold that is broken on purpose, so that a claim is seen to reject it |
//! | sentence | what a source says, in `docs/sentences.md`, measured |
//! | effect | a table of a scene file, and the part of a renderer that it switches on |
//! | wing | a folder of `src`; arrows between wings run in one direction |
//!
//! # Versions
//!
//! What is documented here follows semantic versioning. Items that are public for the tests, the benches and the command
//! line alone are hidden from these pages and may change in any version.

#[cfg(feature = "check")]
pub mod check;
#[cfg(feature = "check")]
#[doc(hidden)]
pub mod cost;
#[cfg(feature = "render")]
pub mod render;
#[cfg(feature = "plots")]
#[doc(hidden)]
pub mod report;
pub mod scene;
#[cfg(feature = "shader")]
pub mod shader;
#[cfg(feature = "check")]
#[doc(hidden)]
pub mod stats;
#[cfg(feature = "check")]
pub mod technique;
pub mod threshold;

#[cfg(feature = "check")]
pub use check::{Budget, Subject, Suite};
pub use glam;
pub use threshold::footprint::Footprint;
pub use threshold::hashed::HashedAlpha;
pub use threshold::pipeline::Pipeline;
pub use threshold::robust::Robust;
pub use threshold::two_scale::Variant;

/// The examples of the README, so that they are compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
