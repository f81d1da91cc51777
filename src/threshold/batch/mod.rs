//! Thresholds by the thousand, in the vector instructions of the machine.
//!
//! A second, faster way to the numbers that a [`Model`] defines: with [`Tier::BitExact`] not one bit
//! differs, whatever the instruction set or the number of threads. Footprints come as a structure of arrays
//! ([`Columns`]). They are evaluated in blocks of [`BLOCK`], stage by stage, each stage one short loop without a
//! branch; where the scalar path would have branched away from the common case (a derivative of zero, a cell beyond
//! the domain of the sine), the loop leaves NaN and the scalar path is asked.
//!
//! | module | holds |
//! |---|---|
//! | [`isa`] | instruction sets and their choice at run time |
//! | [`columns`] | footprints as a structure of arrays |
//! | `lane`, `double` | sine, logarithm and powers of two without a branch, in `f32` and `f64` |
//! | `plan` | a model as the loops want it |
//! | `octaves`, `cells`, `evaluate` | the stages |
//! | `slices` | [`Isa::sin`], [`Isa::log2`] and [`Isa::hash`] |
//! | `stream`, `bins` | any number of thresholds on every core, counted as they come |
//!
//! Not in the paper.

// A lane is one index into several arrays.
#![allow(clippy::needless_range_loop)]

mod bins;
mod cells;
pub mod columns;
mod double;
mod evaluate;
pub mod isa;
mod lane;
mod octaves;
mod plan;
pub(crate) mod slices;
mod stream;

pub use bins::Bins;
pub use columns::{ColumnBuffer, Columns};
pub use isa::Isa;
pub use stream::CHUNK;

pub use super::model::Model;

use core::fmt;

/// How many footprints a stage handles at once: 128 keep every intermediate array in the first cache.
pub const BLOCK: usize = 128;

/// One array of a block.
pub(crate) type Block<T> = [T; BLOCK];

/// A precision that is evaluated in batches: `f32` or `f64`, and no other.
pub trait Lane: lane::Kernel {
    /// [`Batch::thresholds`], compiled once for each precision.
    #[doc(hidden)]
    fn thresholds(batch: &Batch, columns: &Columns<'_, Self>, out: &mut [Self]);
    /// [`Bins::add`], likewise.
    #[doc(hidden)]
    fn count(isa: Isa, values: &[Self], counts: &mut [u64]);
}

/// Has the loops compiled here, and not in every crate that calls them.
macro_rules! lane {
    ($real:ty) => {
        impl Lane for $real {
            fn thresholds(batch: &Batch, columns: &Columns<'_, Self>, out: &mut [Self]) {
                let plan = plan::Plan::new(&batch.model, batch.tier);
                batch.isa.run(evaluate::Thresholds { model: &batch.model, plan, columns: *columns, out });
            }
            fn count(isa: Isa, values: &[Self], counts: &mut [u64]) {
                isa.run(bins::Count { values, counts });
            }
        }
    };
}
lane!(f32);
lane!(f64);

/// How exact the sine and the logarithm of a batch are.
///
/// The figures are those of `f32`. In `f64` the sine of [`Tier::TwoUlp`] is within two units of *its* last place and that of
/// [`Tier::Fast`] within 2^-50, for arguments up to 2^30; [`Tier::Coarse`] is the same.
///
/// Each tier has the same bits on every machine. One without fused multiply-add emulates it for the faster tiers, which
/// are slow there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Tier {
    /// Sine within 2^-11 for arguments up to pi, which is all that WGSL promises; beyond, the error grows with the
    /// argument, and the law of the hash suffers with it. Octave by the exponent.
    Coarse,
    /// Sine within 2^-22 for arguments up to 2^20, octave by the exponent. Same law as the exact tier, other values:
    /// the hash turns the last digit of a sine into another number.
    Fast,
    /// Sine within 2.1 units in the last place for arguments up to 2^20, octave by the exponent.
    TwoUlp,
    /// Sine and logarithm correctly rounded: bit for bit the scalar path.
    #[default]
    BitExact,
}

impl Tier {
    /// Every tier, the fastest first.
    pub const ALL: [Self; 4] = [Self::Coarse, Self::Fast, Self::TwoUlp, Self::BitExact];

    /// The name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Coarse => "wgsl-minimum",
            Self::Fast => "fast",
            Self::TwoUlp => "two-ulp",
            Self::BitExact => "bit-exact",
        }
    }
}

impl fmt::Display for Tier {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// What to evaluate, and by which instructions.
///
/// ```
/// use hashed_alpha::threshold::batch::{Batch, ColumnBuffer};
/// use hashed_alpha::threshold::{footprint::Footprint, robust::Robust, two_scale::Variant};
///
/// let footprints = (0..1000_u16).map(|i| Footprint::<f32> {
///     position: glam::vec3(0.01 * f32::from(i), 0.3, -2.0),
///     dpdx: glam::vec3(0.01, 0.0, 0.0),
///     dpdy: glam::vec3(0.0, 0.02, 0.0),
/// });
/// let robust = Robust::new(Variant::Isotropic);
/// let columns: ColumnBuffer<f32> = footprints.clone().collect();
/// let mut thresholds = vec![0.0; 1000];
/// Batch::new(robust).thresholds(&columns.columns(), &mut thresholds);
/// for (footprint, threshold) in footprints.zip(thresholds) {
///     assert_eq!(robust.threshold(&footprint), Ok(threshold));
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Batch {
    /// The threshold.
    pub model: Model,
    /// How exact sine and logarithm are.
    pub tier: Tier,
    /// The instructions.
    pub isa: Isa,
}

impl Batch {
    /// The bits of the scalar path, by the best instructions of the machine.
    #[must_use]
    pub fn new(model: impl Into<Model>) -> Self {
        Self { model: model.into(), tier: Tier::BitExact, isa: Isa::best() }
    }

    /// Writes the threshold of every footprint; NaN where [`Model::threshold`] is NaN.
    ///
    /// # Panics
    /// If the columns and `out` are not all of one length.
    pub fn thresholds<R: Lane>(&self, columns: &Columns<'_, R>, out: &mut [R]) {
        assert!(columns.is_as_long_as(out), "columns of unequal length");
        R::thresholds(self, columns, out);
    }
}
