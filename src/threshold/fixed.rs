//! The traditional alpha test (§1) and the test itself.

/// The threshold of the traditional alpha test (§1, Eq. 3).
pub const FIXED_THRESHOLD: f64 = 0.5;

/// Returns whether a fragment is kept: the paper's `if (color.a < threshold) discard` (§1).
///
/// Literal: the comparison is false for NaN, so a NaN threshold (or alpha) keeps the fragment.
#[must_use]
pub fn passes<T: PartialOrd>(alpha: T, threshold: T) -> bool {
    let discard = alpha < threshold;
    !discard
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn alpha_at_the_threshold_is_kept_and_nan_too() {
        assert!(passes(0.5, FIXED_THRESHOLD));
        assert!(!passes(0.499, FIXED_THRESHOLD));
        assert!(passes(0.0, f64::NAN));
    }
}
