//! Statistics: the tests, bounds and error-rate control that turn samples into p-values.
//!
//! Everything here is `f64` arithmetic over slices, counts and sums. A p-value is always a *true tail*: it is
//! computed as a tail, never as one minus a distribution function, because a family of hundreds of tests
//! judges at levels near 1e-9. Each p-value function is itself tested, for its value against references of
//! high precision, for its calibration (uniform p-values on an ideal source) and for its teeth (it rejects a
//! broken source).
//!
//! | module | answers |
//! |---|---|
//! | [`histogram`] | how often did each equal part of `[0, 1]` come up? |
//! | [`chi_square`] | do counts follow given probabilities, each other, or a product law? |
//! | [`ecdf`] | how far is a sample from uniform (Kolmogorov-Smirnov, and a bound for every size)? |
//! | [`two_sample`] | how far are two samples from each other? |
//! | [`normal`] | tails and quantile of the normal law |
//! | [`beta`] | tails of Student's t and Fisher's F |
//! | [`variance`] | is a variance what it should be? are two of them equal? |
//! | [`binomial`] | exact tails of binomial and Poisson counts, and the Clopper-Pearson interval |
//! | [`clusters`] | do events on a lattice come in blocks? |
//! | [`collisions`] | do values that should be spread over many urns meet too often? |
//! | [`poisson_binomial`] | does a count of unequal but independent events match their probabilities? |
//! | [`correlation`] | are two sequences related? |
//! | [`tails`] | both tails of a statistic, and their common p-value |
//! | [`autocorrelation`] | does a field repeat itself as predicted? |
//! | [`forms`] | do three values satisfy a linear relation? |
//! | [`lags`] | does a block of values repeat itself at any distance? |
//! | [`spectrum`] | does an image have the spectrum that its autocovariance predicts? |
//! | [`fisher_g`] | is one of many exponential ordinates too large? |
//! | [`gamma_sum`] | tails of weighted sums of exponential ordinates |
//! | [`multiplicity`] | what is a p-value worth among many? |
//! | [`sequential`] | the same, when what is suspect may be asked again on fresh data |
//! | [`power`] | what is the smallest defect that a test can see? |
//! | [`seed`] | random numbers that are fixed by a name, never by looking at the result |
//!
//! What never lives here: thresholds, hashes, textures or any other subject of a test; significance levels
//! and tolerances; files, text output and serialization; estimates without a stated law.

pub mod autocorrelation;
pub mod beta;
pub mod binomial;
pub mod chi_square;
pub mod clusters;
pub mod collisions;
pub mod correlation;
pub mod ecdf;
pub mod error;
pub mod fisher_g;
pub mod forms;
pub mod gamma_sum;
pub mod histogram;
pub mod lags;
pub mod multiplicity;
pub mod normal;
pub mod poisson_binomial;
pub mod power;
pub mod seed;
pub mod sequential;
pub mod spectrum;
pub mod tails;
mod transform;
pub mod two_sample;
pub mod variance;

pub use error::StatsError;
pub use tails::Tails;
