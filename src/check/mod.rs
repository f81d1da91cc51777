//! The verdict: claims about a threshold, each tried on a subject with evidence.
//!
//! What never lives here: statistics themselves ([`crate::stats`]), pictures ([`crate::report`]), printing.

pub mod claim;
pub mod claims;
pub mod compare;
pub mod coordinates;
pub mod diagnosis;
pub mod draw;
pub mod evidence;
pub mod input;
pub mod judge;
pub mod known;
pub mod outcome;
pub mod parity;
pub mod predict;
pub mod results;
pub mod run;
#[cfg(feature = "shader")]
pub mod shaders;
pub mod specimen;
pub mod subject;
pub mod tolerance;
pub mod trial;

pub use claim::{Claim, Promise};
pub use compare::{Agreement, Comparison, compare};
pub use draw::{Budget, Draw};
pub use evidence::Evidence;
pub use known::Known;
pub use outcome::{Outcome, Standing, Verdict};
pub use results::{Results, Suite};
pub use run::{run, run_claims};
pub use subject::Subject;
pub use trial::{Attempt, Conclusion, Trial};
