//! What is counted: a plan predicts it, a run counts it, and the two must agree.

use core::ops::{Add, AddAssign, Mul};

/// Declares the quantities, their sums and their list.
macro_rules! quantities {
    ($($field:ident: $meaning:literal;)*) => {
        /// Counted quantities.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct Cost {
            $(#[doc = $meaning] pub $field: u64,)*
        }

        impl Cost {
            /// Returns every quantity with its name.
            #[must_use]
            pub fn quantities(&self) -> Vec<(&'static str, u64)> {
                vec![$((stringify!($field), self.$field)),*]
            }
        }

        impl Add for Cost {
            type Output = Self;
            fn add(self, other: Self) -> Self {
                Self { $($field: self.$field + other.$field),* }
            }
        }

        impl Mul<u64> for Cost {
            type Output = Self;
            fn mul(self, times: u64) -> Self {
                Self { $($field: self.$field * times),* }
            }
        }

        impl Cost {
            $(
                #[doc = concat!("So many of: ", $meaning)]
                #[must_use]
                pub fn $field(count: u64) -> Self {
                    Self { $field: count, ..Self::default() }
                }
            )*
        }
    };
}

quantities! {
    frames: "Frames that were drawn.";
    passes: "Times that the whole scene was rasterised.";
    fragments: "Fragments that were shaded.";
    texels: "Texels that were read for alpha.";
    hashes: "Hashes of cells or words.";
    randoms: "Random numbers that were drawn.";
    tests: "Comparisons of an alpha with a threshold.";
    rays: "Rays that were traced.";
    projections: "Pixels whose surface was looked for in the frame before.";
    blends: "Pixels that were mixed with those of other frames or layers.";
}

/// What a price is for one of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Per {
    /// A frame.
    Frame,
    /// A fragment.
    Fragment,
    /// A texel that alpha is read from.
    Texel,
    /// A threshold: one a fragment, or one a sample of it.
    Threshold,
    /// A pixel of the image.
    Pixel,
    /// A pixel, or a place within one, that shows a surface.
    Shown,
}

/// What the costs of a frame, or of a part of it, depend on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Census {
    /// Frames.
    pub frames: u64,
    /// Fragments.
    pub fragments: u64,
    /// Texels that they read when all are read once.
    pub texels: u64,
    /// Thresholds.
    pub thresholds: u64,
    /// Pixels of the image.
    pub pixels: u64,
    /// Pixels of the places that show a surface; 0 where no stage asks.
    pub shown: u64,
}

impl Census {
    /// Returns what a price comes to.
    #[must_use]
    pub fn cost(&self, price: &[(Per, Cost)]) -> Cost {
        let count = |per: Per| match per {
            Per::Frame => self.frames,
            Per::Fragment => self.fragments,
            Per::Texel => self.texels,
            Per::Threshold => self.thresholds,
            Per::Pixel => self.pixels,
            Per::Shown => self.shown,
        };
        price.iter().map(|&(per, each)| each * count(per)).sum()
    }
}

impl AddAssign for Cost {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl core::iter::Sum for Cost {
    fn sum<I: Iterator<Item = Self>>(costs: I) -> Self {
        costs.fold(Self::default(), Add::add)
    }
}
