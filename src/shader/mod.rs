//! The threshold in shading languages: its text, its checks without a driver, and its runs on a device.
//!
//! What never lives here: claims, statistics, printing.

pub mod assemble;
pub mod beside;
pub mod export;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod interpreter;
pub mod own;
pub mod spelling;
