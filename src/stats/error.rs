//! What can be wrong with the data of a test.

/// Reports why a statistic is not defined for the data that it was given.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StatsError {
    /// There is no data at all, or too little to define the statistic.
    #[error("no data, or too little of it to define the statistic")]
    Empty,
    /// Fewer than two bins (or rows, or columns) remain after pooling, so that there is nothing to compare.
    #[error("{bins} bins remain after pooling, at least 2 are needed")]
    TooFewBins {
        /// How many remain.
        bins: usize,
    },
    /// Two slices that belong together differ in length, or a table is not a whole number of rows.
    #[error("lengths {left} and {right} do not fit together")]
    LengthMismatch {
        /// Length of the first slice.
        left: usize,
        /// Length of the second slice, or the number of columns.
        right: usize,
    },
    /// A value that has to lie in `[0, 1]` does not, or is NaN.
    #[error("{value} is not in [0, 1]")]
    NotAProbability {
        /// The offending value.
        value: f64,
    },
    /// A value that has to be finite is NaN or infinite.
    #[error("{value} is not finite")]
    NotFinite {
        /// The offending value.
        value: f64,
    },
    /// Expected probabilities do not add up to one within 1e-9.
    #[error("the expected probabilities add up to {sum}, not to 1")]
    NotNormalized {
        /// What they add up to.
        sum: f64,
    },
    /// A sequence has no variance, so that its correlation with anything is undefined.
    #[error("a constant sequence has no correlation")]
    Constant,
}
