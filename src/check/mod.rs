//! The verdict: claims about a threshold, each tried on a subject with evidence.
//!
//! A [`Claim`] is a sentence about thresholds and the function that tries it; a [`Trial`] is what one try on a [`Subject`] saw;
//! an [`Outcome`] is the answer when all trials of a run are judged together, and its [`Standing`] what that is worth.
//!
//! ```
//! use hashed_alpha::check::{Draw, Standing, claims, run_claims};
//! use hashed_alpha::{Budget, Subject, Variant};
//!
//! // A threshold that keeps the same half of all fragments, whatever their alpha.
//! let constant = Subject::of_f32("constant", Variant::Isotropic, |_| 0.5);
//! let draw = Draw { budget: Budget::Quick, ..Draw::default() };
//! let outcomes = run_claims(&[claims::uniform::COVERAGE], &[constant], &draw, || {});
//! assert_eq!(outcomes[0].standing(), Standing::Against);
//! ```
//!
//! The modules that are hidden from these pages hold what stands here, or are public for our own tests alone (inputs, closed
//! forms, statistics that claims share, constants) and outside of semantic versioning.
//!
//! What never lives here: statistics themselves ([`crate::stats`]), pictures ([`crate::report`]), printing.

pub mod catalogue;
#[doc(hidden)]
pub mod cause;
pub mod claim;
pub mod claims;
pub mod compare;
#[doc(hidden)]
pub mod coordinates;
pub mod diagnosis;
pub mod domain;
#[doc(hidden)]
pub mod draw;
pub mod evidence;
pub mod grain;
pub mod growth;
#[doc(hidden)]
pub mod input;
#[doc(hidden)]
pub mod judge;
pub mod known;
#[cfg(feature = "shader")]
#[doc(hidden)]
pub mod mend;
pub mod motion;
#[doc(hidden)]
pub mod outcome;
#[doc(hidden)]
pub mod parity;
#[doc(hidden)]
pub mod predict;
#[doc(hidden)]
pub mod rests_on;
#[doc(hidden)]
pub mod results;
#[doc(hidden)]
pub mod run;
pub mod scale_policy;
#[cfg(feature = "shader")]
pub mod shaders;
mod shrink;
#[doc(hidden)]
pub mod sizes;
pub mod specimen;
pub mod subject;
#[doc(hidden)]
pub mod tolerance;
#[doc(hidden)]
pub mod trial;

pub use claim::{Claim, Promise};
pub use compare::{Agreement, Comparison, compare};
pub use domain::Domain;
pub use draw::{Budget, Draw, Reach};
pub use evidence::{ComparedShare, Evidence, NamedHistogram};
pub use known::Known;
pub use outcome::{LikeTheListing, Outcome, Standing, Verdict, worst};
pub use rests_on::RestsOn;
pub use results::{Results, Suite};
pub use run::{run, run_claims};
pub use subject::{Frames, Precision, Subject};
pub use trial::{Attempt, Conclusion, Trial};
