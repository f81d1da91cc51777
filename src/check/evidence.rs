//! What a claim saw, in the form in which it is drawn.

use crate::stats::histogram::Histogram;

/// Evidence of one claim.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Evidence {
    /// Nothing to draw.
    #[default]
    None,
    /// Counts of thresholds in equal bins over [0, 1], one histogram a group.
    Histograms(Vec<NamedHistogram>),
    /// Counts of pairs of thresholds in `side` x `side` equal squares over [0, 1]^2, row by row.
    Pairs {
        /// Squares along one side.
        side: usize,
        /// `side * side` counts, first threshold selects the row.
        counts: Vec<u64>,
    },
    /// Measured shares beside those that are predicted.
    Shares {
        /// What `x` is, with its unit in brackets.
        abscissa: &'static str,
        /// The shares.
        points: Vec<ComparedShare>,
    },
    /// Measured values of any quantity beside those that are predicted.
    Quantity {
        /// What `x` is, with its unit in brackets.
        abscissa: &'static str,
        /// What is measured, with its unit in brackets.
        ordinate: &'static str,
        /// The values.
        points: Vec<ComparedShare>,
    },
}

/// A histogram with the name of its group.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedHistogram {
    /// What the group is, as in "lerp factor 0.25-0.31" or "frontal wall".
    pub name: String,
    /// Counts in equal bins over [0, 1].
    pub counts: Vec<u64>,
}

impl NamedHistogram {
    /// Names what a histogram has counted.
    #[must_use]
    pub fn new(name: impl Into<String>, histogram: &Histogram) -> Self {
        Self { name: name.into(), counts: histogram.counts().to_vec() }
    }
}

/// A share that was measured and the one that was predicted for it.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedShare {
    /// Where it was measured, as in "fence, along x".
    pub series: String,
    /// The abscissa, as in the shift in pixels.
    pub x: f64,
    /// Measured share in [0, 1].
    pub measured: f64,
    /// Predicted share in [0, 1].
    pub predicted: f64,
    /// Standard deviation of the measured share under the prediction.
    pub sigma: f64,
}
