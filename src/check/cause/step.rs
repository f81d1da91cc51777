//! In which step of a threshold a slip is.

use super::slip::Slip;

/// A step of a threshold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// From the derivatives to octaves and the size of cells.
    Scale,
    /// Cells and their hashes.
    Hash,
    /// From two hashes to the threshold.
    Join,
}

impl Slip {
    /// Returns the step that it is in.
    #[must_use]
    pub fn step(&self) -> Step {
        if OF_SCALE.contains(&self.name) {
            Step::Scale
        } else if OF_JOIN.contains(&self.name) {
            Step::Join
        } else {
            Step::Hash
        }
    }
}

/// Slips on the way to a scale.
const OF_SCALE: [&str; 20] = [
    "dfdx-twice",
    "min-for-max",
    "fwidth",
    "length-of-sum",
    "sum-of-lengths",
    "area-of-a-pixel",
    "largest-component",
    "derivative-without-z",
    "hash-scale-ignored",
    "hash-scale-divides",
    "squared-length",
    "one-plus-derivative",
    "missing-sqrt-half",
    "noise-of-another-size",
    "half-the-noise",
    "inverse-scale",
    "natural-logarithm",
    "axes-exchanged",
    "other-variant",
    "no-octaves",
];

/// Slips of the join and behind it.
const OF_JOIN: [&str; 44] = [
    "coarser-for-finer",
    "octave-skipped",
    "one-octave-for-both",
    "coarse-octave-alone",
    "nearest-octave",
    "octave-rounded",
    "linear-weight",
    "weight-of-the-scale",
    "smoothstep-weight",
    "second-hash-from-the-first",
    "weights-that-add-up-to-more",
    "geometric-mean",
    "weights-swapped",
    "weight-always-half",
    "no-cdf",
    "case-by-lerp-factor",
    "divisor-without-two",
    "a-without-min",
    "first-cases-swapped",
    "last-case-missing",
    "middle-case-unshifted",
    "last-case-unmirrored",
    "first-case-wrong",
    "middle-case-wrong",
    "last-case-wrong",
    "max-for-min-in-a",
    "cdf-of-equal-weights",
    "inverse-for-cdf",
    "density-for-cdf",
    "smoothstep-for-cdf",
    "cdf-twice",
    "larger-of-two",
    "product-of-two",
    "mean-of-two",
    "sum-that-wraps",
    "clamped-at-zero",
    "coarse-steps",
    "half-precision",
    "gamma-curve",
    "srgb-curve",
    "around-a-cutoff",
    "safe-middle",
    "clamped-by-255ths",
    "clamped-below-opaque",
];
