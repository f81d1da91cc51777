//! A model, evaluated by the thousand.

use super::columns::{ColumnBuffer, Columns};
use super::isa::Isa;
use super::tier::Tier;
use super::{bin_count, evaluate, lane, plan};
use crate::threshold::footprint::Footprint;
use crate::threshold::model::Model;

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
                isa.run(bin_count::Count { values, counts });
            }
        }
    };
}
lane!(f32);
lane!(f64);

/// What to evaluate, and by which instructions.
///
/// ```
/// use hashed_alpha::threshold::batch::Batch;
/// use hashed_alpha::{Footprint, Robust, Variant};
///
/// let footprints: Vec<_> = (0..1000_u16)
///     .map(|i| Footprint::<f32>::new([0.01 * f32::from(i), 0.3, -2.0], [0.01, 0.0, 0.0], [0.0, 0.02, 0.0]))
///     .collect();
/// let robust = Robust::new(Variant::Isotropic);
/// let thresholds = Batch::new(robust).of(&footprints);
/// for (footprint, threshold) in footprints.iter().zip(thresholds) {
///     assert_eq!(robust.threshold(footprint), Ok(threshold));
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

    /// Returns the threshold of every footprint; NaN where [`Model::threshold`] is NaN.
    #[must_use]
    pub fn of<R: Lane>(&self, footprints: &[Footprint<R>]) -> Vec<R> {
        let columns: ColumnBuffer<R> = footprints.iter().copied().collect();
        let mut thresholds = vec![R::from_f64(f64::NAN); footprints.len()];
        self.thresholds(&columns.columns(), &mut thresholds);
        thresholds
    }
}
