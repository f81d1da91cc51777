//! The fragments of one tile as columns. A column that nobody needs stays empty.

use crate::threshold::batch::ColumnBuffer;
use core::num::NonZeroU32;
use glam::Vec2;
use serde::Deserialize;

/// What a plan needs to know of a fragment beyond its pixel, its depth and its texture coordinate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// The place that is hashed with its two screen derivatives.
    pub footprint: bool,
    /// The two screen derivatives of the texture coordinate.
    pub texture_derivatives: bool,
    /// Which of the fragments of its pixel it is, in the order in which they are drawn.
    pub layer: bool,
    /// The level of detail that the texture is read at.
    pub lod: bool,
    /// The index of the frame.
    pub frame: bool,
    /// The pixel, where thresholds differ by it.
    pub pixel: bool,
    /// The share of its pixel that it covers; every pixel that a triangle touches is drawn then.
    pub coverage: bool,
    /// The depth of what each pixel shows.
    pub depth: bool,
    /// Which of so many samples of its pixel it covers, in place of whether it covers the centre.
    pub samples: Option<NonZeroU32>,
}

impl Needs {
    /// The needs by name, for people.
    #[must_use]
    pub fn names(&self) -> Vec<&'static str> {
        let all = [
            (true, "pixel, depth and texture coordinate"),
            (self.texture_derivatives, "screen derivatives of the texture coordinate"),
            (self.footprint, "hashed position and its screen derivatives"),
            (self.layer, "index of the layer"),
            (self.lod, "level of detail"),
            (self.frame, "index of the frame"),
            (self.pixel, "place of the pixel, for the threshold"),
            (self.coverage, "share of the pixel that is covered"),
            (self.depth, "depth of what each pixel shows"),
            (self.samples.is_some(), "samples that geometry covers"),
        ];
        all.into_iter().filter(|&(needed, _)| needed).map(|(_, name)| name).collect()
    }
}

/// Coordinates of a fragment that may be hashed (§5.2, §5.3).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Space {
    /// Those of the whole object, before its deformation: what the paper chose.
    #[default]
    Object,
    /// Those of the object after its deformation.
    Deformed,
    /// Those of the part, as of one leaf: what the paper warns of.
    Part,
    /// Those of the world.
    World,
    /// Texture coordinates, with 0 for the third.
    Texture,
    /// Those of the eye: x to the right, y down, z along the line of sight.
    Eye,
    /// Pixels, with 0 for the third.
    Screen,
    /// Normalised device coordinates, [-1, 1] across the image, with 0 for the third.
    Device,
}

impl Space {
    /// The name of the coordinates.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Object => "object",
            Self::Deformed => "deformed object",
            Self::Part => "part",
            Self::World => "world",
            Self::Texture => "texture",
            Self::Eye => "eye",
            Self::Screen => "screen",
            Self::Device => "device",
        }
    }
}

/// Fragments of one tile, in the order in which their triangles are drawn.
#[derive(Clone, Debug, Default)]
pub struct Fragments {
    /// Index of the pixel within the tile, row by row.
    pub pixel: Vec<u16>,
    /// Index of the triangle.
    pub triangle: Vec<u32>,
    /// Distance along the line of sight, in object units.
    pub depth: Vec<f32>,
    /// Texture coordinates.
    pub texcoord: Vec<Vec2>,
    /// Their change to the next pixel on the right; empty unless needed.
    pub dtdx: Vec<Vec2>,
    /// Their change to the next pixel below; empty unless needed.
    pub dtdy: Vec<Vec2>,
    /// What colour and alpha of the texture are multiplied by; empty where no vertex of the mesh changes them.
    pub tint: Vec<[f32; 4]>,
    /// What is hashed; empty unless needed.
    pub footprint: ColumnBuffer<f32>,
    /// Which of the fragments of its pixel it is; empty unless needed.
    pub layer: Vec<u32>,
    /// The share of its pixel that its triangle covers, in (0, 1]; empty unless needed.
    pub coverage: Vec<f64>,
    /// The samples of its pixel that its triangle covers, a bit each; empty unless needed.
    pub covered: Vec<u64>,
}

impl Fragments {
    /// Returns the number of fragments.
    #[must_use]
    pub fn len(&self) -> usize {
        self.pixel.len()
    }

    /// Returns whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pixel.is_empty()
    }

    /// Returns what the colour and the alpha of the texture are multiplied by at a fragment.
    #[must_use]
    pub fn tint(&self, at: usize) -> [f32; 4] {
        self.tint.get(at).copied().unwrap_or([1.0; 4])
    }

    /// Takes out all fragments and keeps the room.
    pub fn clear(&mut self) {
        self.pixel.clear();
        self.triangle.clear();
        self.depth.clear();
        self.texcoord.clear();
        self.tint.clear();
        self.dtdx.clear();
        self.dtdy.clear();
        self.layer.clear();
        self.coverage.clear();
        self.covered.clear();
        let ColumnBuffer { position, dpdx, dpdy } = &mut self.footprint;
        [position, dpdx, dpdy].into_iter().flatten().for_each(Vec::clear);
    }
}
