//! Statistical analysis and verification of hashed alpha thresholds.
#![deny(missing_docs)]

pub mod check;
#[cfg(feature = "plots")]
pub mod report;
pub mod scene;
pub mod stats;
pub mod threshold;
