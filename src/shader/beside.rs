//! Functions that a shader calls beside its threshold: twins of [`technique`](crate::technique), one chunk each.

/// `corrected(value, coverage)`, see [`corrected`](crate::technique::conservative::corrected).
pub const CORRECTED: &str = include_str!("chunk/corrected.wgsl");

/// `coarser_by(pixel, gaze, radius, slope)`, see [`Gaze::coarser_by`](crate::technique::foveated::Gaze::coarser_by).
pub const COARSER_BY: &str = include_str!("chunk/coarser_by.wgsl");

/// `cosine_direction(chi)`, see [`cosine_direction`](crate::technique::occlusion::cosine_direction).
pub const COSINE_DIRECTION: &str = include_str!("chunk/cosine_direction.wgsl");
