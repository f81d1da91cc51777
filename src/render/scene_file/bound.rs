//! The numbers that a key of a scene file may have.

/// The numbers that a key may have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// Both ends are allowed.
    From(f64, f64),
    /// Above 0, up to an end that is allowed.
    UpTo(f64),
}

use Bound::{From, UpTo};

impl Bound {
    /// Lengths and scales of objects.
    pub const LENGTH: Self = From(1.0 / LARGEST, LARGEST);
    /// Ratios: of distances, of noise to a pixel.
    pub const RATIO: Self = From(1.0e-6, 1.0e6);
    /// The threshold of an alpha test.
    pub const THRESHOLD: Self = UpTo(1.0);
    /// Samples in a pixel: bits of a word.
    pub const SAMPLES: Self = From(1.0, 64.0);
    /// Frames that belong together.
    pub const CYCLE: Self = From(1.0, 1024.0);
    /// Any number that no key has a narrower bound for.
    pub const ANY: Self = From(-LARGEST, LARGEST);

    /// Returns whether a number is allowed; NaN never is.
    #[must_use]
    pub fn holds(self, value: f64) -> bool {
        match self {
            From(low, high) => (low..=high).contains(&value),
            UpTo(high) => value > 0.0 && value <= high,
        }
    }
}

/// What no number exceeds, whatever its key: beyond, the positions of a mesh lose whole units.
pub const LARGEST: f64 = 1.0e15;
/// The largest side of a picture, in pixels.
pub const LARGEST_SIDE: u32 = 16_384;
/// The largest side of an image file, in pixels.
pub const LARGEST_IMAGE_SIDE: u32 = 65_535;
