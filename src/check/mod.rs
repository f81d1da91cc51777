//! The verdict: claims about a threshold, each tried on a subject with evidence.
//!
//! What never lives here: statistics themselves ([`crate::stats`]), pictures ([`crate::report`]), printing.

pub mod claims;
pub mod evidence;
pub mod expectation;
pub mod outcome;
pub mod sample;
pub mod subject;
pub mod suite;
pub mod tolerance;

pub use evidence::Evidence;
pub use outcome::{Outcome, Verdict};
pub use subject::Subject;
pub use suite::run;
