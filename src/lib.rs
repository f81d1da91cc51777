//! Statistical analysis and verification of hashed alpha thresholds.
#![deny(missing_docs)]

pub mod check;
pub mod scene;
pub mod stats;
pub mod threshold;
