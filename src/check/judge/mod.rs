//! From what was measured to a trial, where several claims judge alike.

pub mod correlations;
pub mod counts;
pub mod equality;
pub(crate) mod pools;
pub(crate) mod pops;
pub mod powers;
pub mod replicate_means;
pub mod shares;
pub mod uniformity;

pub(crate) use correlations::uncorrelated;
pub(crate) use counts::detectable_factor;
pub(crate) use equality::equality;
pub(crate) use powers::detectable_change;
pub(crate) use shares::detectable_error;
pub(crate) use uniformity::{histogram, uniformity};
