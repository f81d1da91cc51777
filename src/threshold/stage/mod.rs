//! What a pipeline does with a threshold after its source: one file a stage, literal and stable side by side.
//!
//! | module | place in the sources |
//! |---|---|
//! | [`independent`] | frames with hashes of their own, §7.2.2 |
//! | [`stratify`], [`order`] | strata of frames and their order, §7.2.3, Eq. 6 |
//! | [`coverage`] | several thresholds in one fragment, §8, Eqs. 7 to 9 |
//! | [`screen_door`], [`stipple`] | thresholds of the pixel, §3, Ols 2009 |
//! | [`fade_in`] | noise that fades in, §7.1, Eqs. 3 to 5 |
//! | [`clamp`] | the last step of all |

pub mod clamp;
pub mod coverage;
pub mod fade_in;
pub mod independent;
pub mod order;
pub mod screen_door;
pub mod stipple;
pub mod stratify;
