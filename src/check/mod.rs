//! The verdict: claims about a threshold, each tried on a subject with evidence.
//!
//! What never lives here: statistics themselves ([`crate::stats`]), pictures ([`crate::report`]), printing.

pub mod claims;
pub mod compare;
pub mod coordinates;
pub mod diagnosis;
pub mod draw;
pub mod evidence;
pub mod expectation;
pub mod findings;
pub mod kinship;
pub mod outcome;
pub mod parity;
pub mod rescaled;
pub mod results;
pub mod sample;
#[cfg(feature = "shader")]
pub mod shaders;
pub mod shared_cell;
pub mod sheet;
pub mod specimen;
pub mod subject;
pub mod suite;
pub mod tolerance;

pub use compare::{Agreement, Comparison, compare};
pub use draw::{Budget, Draw};
pub use evidence::Evidence;
pub use outcome::{Outcome, Verdict};
pub use results::Results;
pub use subject::Subject;
pub use suite::{Suite, run, run_claims};
