//! From what was measured to a trial, where several claims judge alike.

pub mod counts;
pub mod equality;
pub mod replicate_means;
pub mod shares;
pub mod uniformity;
