//! How textures are read: what lies beyond their edges, and how texels become one value.

use crate::threshold::real::Real;
use serde::Deserialize;

/// What lies beyond the edge of a texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Wrap {
    /// The texture again.
    Repeat,
    /// The texture again, the other way round each time.
    Mirror,
    /// Its outermost texel.
    #[default]
    Clamp,
}

/// How texels become one value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Filter {
    /// The nearest texel of the nearest level.
    Nearest,
    /// The nearest texel of each of the two nearest levels.
    NearestLinear,
    /// Four texels of the nearest level.
    Bilinear,
    /// Four texels of each of the two nearest levels.
    #[default]
    Trilinear,
    /// Up to 16 trilinear probes along the longer axis of the footprint.
    Anisotropic,
}

/// How a texture is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampler {
    /// What lies beyond its left and right edges, and beyond its upper and lower ones.
    pub wrap: [Wrap; 2],
    /// How texels become one value.
    pub filter: Filter,
    /// The same where a texel is as large as a pixel or larger; as `filter` without.
    pub magnified: Option<Filter>,
    /// Whether it has coarser levels than the finest.
    pub has_levels: bool,
}

impl Sampler {
    /// One with a mip chain that is the same along both axes and at every size.
    #[must_use]
    pub const fn new(wrap: Wrap, filter: Filter) -> Self {
        Self { wrap: [wrap; 2], filter, magnified: None, has_levels: true }
    }

    /// How texels become one value at a level of detail.
    #[inline]
    pub(super) fn filter(&self, lod: f32) -> Filter {
        match self.magnified {
            Some(filter) if lod <= 0.0 => filter,
            Some(_) | None => self.filter,
        }
    }
}

impl Wrap {
    /// The texel that is read for a place along a side of so many, inside the texture or not.
    pub(super) fn texel(self, at: i64, side: u32) -> usize {
        let side = i64::from(side);
        if (0..side).contains(&at) {
            return at as usize;
        }
        let inside = match self {
            Self::Repeat => at.rem_euclid(side),
            Self::Mirror => {
                let along = at.rem_euclid(2 * side);
                along.min(2 * side - 1 - along)
            }
            Self::Clamp => at.clamp(0, side - 1),
        };
        inside as usize
    }

    /// The two texels along a side of so many between whose middles a place lies, [0, 1] across the texture, and how far it is
    /// from the first.
    #[inline(always)]
    pub(super) fn between(self, place: f32, side: u32) -> (usize, usize, f32) {
        let along = place * side as f32 - 0.5;
        // Most places lie between two texels that are there, where rounding is towards zero.
        if along >= 0.0 && along < (side - 1) as f32 {
            let first = along as i32;
            return (first as usize, first as usize + 1, along - first as f32);
        }
        if !along.is_finite() {
            return (0, 0, 0.0);
        }
        let first = Real::floor(along);
        (self.texel(first as i64, side), self.texel((first as i64).saturating_add(1), side), along - first)
    }
}
