//! What is counted: a plan predicts it, a run counts it, and the two must agree.

use core::ops::{Add, AddAssign};

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
