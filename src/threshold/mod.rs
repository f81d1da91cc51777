//! The mathematics: from a footprint to an alpha threshold.
//!
//! | module | place in the paper |
//! |---|---|
//! | [`real`] | the arithmetic under every listing |
//! | [`footprint`] | position and its two screen derivatives, the inputs of Listings 1 and 2 |
//! | [`hash`] | §5.1, §7.2.2, §9, and integer hashes that are not in the paper |
//! | [`two_scale`] | §5.4.1, §5.4.2, Listings 1 and 2 up to `lerpFactor` |
//! | [`cdf`] | Eq. 2 |
//! | [`hashed`], [`stochastic`], [`fixed`] | where the threshold comes from: §5-6, §4, §1 |
//! | [`stability`] | closed forms for how often a threshold changes under motion (not in the paper) |
//!
//! What never lives here: statistics, files, scenes, allocation per sample. Nothing in this wing imports another.

pub mod cdf;
pub mod fixed;
pub mod footprint;
pub mod hash;
pub mod hashed;
pub mod named;
pub mod real;
pub mod stability;
pub mod stochastic;
pub mod two_scale;
