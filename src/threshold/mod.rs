//! The mathematics: from a footprint to an alpha threshold.
//!
//! | module | place in the paper |
//! |---|---|
//! | [`real`] | the arithmetic under every listing |
//! | [`emulated`] | the same listings under models of a GPU's arithmetic (not in the paper) |
//! | [`footprint`] | position and its two screen derivatives, the inputs of Listings 1 and 2 |
//! | [`hash`] | §5.1, §7.2.2, §9, and integer hashes that are not in the paper |
//! | [`two_scale`] | §5.4.1, §5.4.2, Listings 1 and 2 up to `lerpFactor` |
//! | [`listing_1`], [`listing_2`] | Listings 1 and 2 as whole functions, to read beside the paper |
//! | [`cdf`] | Eq. 2 |
//! | [`hashed`], [`stochastic`], [`fixed`] | where the threshold comes from: §5-6, §4, §1 |
//! | [`model`] | any of those of which the hash has a name |
//! | [`robust`] | Listings 1 and 2 with every repair (not in the paper); [`normal`] serves its copula join |
//! | [`pipeline`] | a source and the stages after it, as one description |
//! | [`stage`] | what follows the hash: §7.1, §7.2.2, §7.2.3, §8 |
//! | [`batch`] | the same thresholds by the thousand, in the vector instructions of the machine (not in the paper) |
//! | [`stability`] | closed forms for how often a threshold changes under motion (not in the paper) |
//!
//! What never lives here: statistics, files, scenes, allocation per sample. Nothing in this wing imports another.

pub mod batch;
pub mod cdf;
pub mod choice;
pub mod emulated;
mod exponent;
pub mod fixed;
pub mod footprint;
pub mod hash;
pub mod hashed;
pub mod listing_1;
pub mod listing_2;
pub mod model;
pub mod names;
pub mod normal;
pub mod pipeline;
pub mod real;
pub mod robust;
pub mod stability;
pub mod stage;
pub mod stochastic;
pub mod two_scale;
