//! One fragment: where a surface is seen at one pixel of one frame, in every coordinate that a shader may hash.

use crate::threshold::footprint::Footprint;
use glam::{DVec2, DVec3};

/// A fragment: its footprint in object coordinates, and its place in all other coordinates.
///
/// Whoever has a footprint alone makes a fragment of it with `from`: all else is zero then.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fragment {
    /// Position in object coordinates and its screen derivatives, in object units.
    pub footprint: Footprint<f64>,
    /// Position in world coordinates, in object units.
    pub world: DVec3,
    /// Position in eye coordinates: x to the right, y down, z along the line of sight, in object units.
    pub eye: DVec3,
    /// Place on the screen in pixels from the upper left corner; the centre of the first pixel is (0.5, 0.5).
    pub pixel: DVec2,
    /// Texture coordinates, [0, 1] across the surface.
    pub texcoord: DVec2,
    /// Level of detail of the texture, log2 of texels per pixel along the longer axis.
    pub lod: f64,
    /// Index of the frame.
    pub frame: u32,
    /// Index of the layer: which of the surfaces along one line of sight this is, the nearest first.
    pub layer: u32,
}

impl From<Footprint<f64>> for Fragment {
    fn from(footprint: Footprint<f64>) -> Self {
        Self {
            footprint,
            world: DVec3::ZERO,
            eye: DVec3::ZERO,
            pixel: DVec2::ZERO,
            texcoord: DVec2::ZERO,
            lod: 0.0,
            frame: 0,
            layer: 0,
        }
    }
}

impl From<&Footprint<f64>> for Fragment {
    fn from(footprint: &Footprint<f64>) -> Self {
        Self::from(*footprint)
    }
}
