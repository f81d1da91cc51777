//! Pictures: pure functions from data to SVG text.
//!
//! One file a concept, each with small structs of public fields that hold what is drawn. Nothing here reads a clock, a
//! random number or a hash map, so equal data gives equal bytes. Text stays text: a viewer sets it in its own
//! sans-serif font, and the layout leaves room for wide ones.
//!
//! | module | what it shows |
//! |---|---|
//! | [`before_and_after`] | thresholds before and after Eq. 2 |
//! | [`cdf_family`] | Eq. 2 and its density for several weights |
//! | [`stability`] | how many thresholds a small shift changes |
//! | [`noise`] | the thresholds themselves as grey levels |
//! | [`validity`] | where each arithmetic keeps the law of the hash |
//! | [`planes`] | bias, flicker and missing thresholds on planes that follow an axis |
//! | [`distance`] | coverage against distance |
//! | [`evidence`] | what a claim saw |
//! | [`front`] | a value against the time that it costs, and the points that no other one beats |
//! | [`growth`] | costs against a size |
//! | [`hashes`] | time, quality and flicker of each hash |
//! | [`kill_matrix`] | which claims reject which specimens |
//! | [`price`] | nanoseconds a threshold, and how far its law is from the uniform one |
//! | [`until_failure`] | how many samples it takes until a claim fails |

pub mod before_and_after;
pub mod cdf_family;
pub mod distance;
pub mod evidence;
pub mod front;
pub mod growth;
pub mod hashes;
pub mod kill_matrix;
pub mod noise;
pub mod planes;
pub mod price;
pub mod stability;
pub mod until_failure;
pub mod validity;

mod raster;
mod rows;
mod style;
