//! Histograms of thresholds, and whether they are uniform.

use crate::check::tolerance::{BINS, LEAST_GROUP};
use crate::stats::chi_square::{self, ChiSquare};
use crate::stats::histogram::Histogram;

/// Counts values in [`BINS`] bins.
pub(crate) fn histogram(values: impl IntoIterator<Item = f64>) -> Histogram {
    let mut histogram = Histogram::new(BINS);
    histogram.extend(values);
    histogram
}

/// Tests one histogram; `None` if it has too few samples.
pub(crate) fn uniformity(histogram: &Histogram) -> Option<ChiSquare> {
    (histogram.total() >= LEAST_GROUP as u64).then(|| chi_square::uniform(histogram.counts()).ok()).flatten()
}
