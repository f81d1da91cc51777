//! One hash, n frames: thresholds that divide [0, 1) among the frames of temporal antialiasing (§7.2.3).

use super::clamp::clamp_last;
use crate::threshold::real::Real;
use core::num::NonZeroU32;

/// Returns the threshold of frame `i` of `n`: `fract(chi + i / n)`. Eq. 6.
///
/// Literal: it is applied to a clamped `chi` but not clamped itself, and returns 0 where the sum is a whole number.
#[must_use]
pub fn stratified_literal<R: Real>(chi: R, i: u32, n: NonZeroU32) -> R {
    (chi + R::from_f64(f64::from(i)) / R::from_f64(f64::from(n.get()))).fract()
}

/// Returns the threshold of stratum `i` of `n`, in [2^-24, 1], for `chi` in (0, 1]; `i` counts modulo `n`. Eq. 6, with
/// a whole sum as 1 and the clamp after it.
///
/// With `fract` a `chi` that comes to 1 would fall to 0 in the first stratum, where nothing else changes `chi` at all: a
/// fragment that no alpha below 1 shows would be shown by every alpha.
#[must_use]
pub fn stratified<R: Real>(chi: R, i: u32, n: NonZeroU32) -> R {
    wrap(chi + R::from_f64(f64::from(i % n)) / R::from_f64(f64::from(n.get())))
}

/// Brings the sum of a threshold in (0, 1] and an offset in [0, 1) back into [2^-24, 1], where 0 counts as 1.
pub(crate) fn wrap<R: Real>(sum: R) -> R {
    let one = R::from_f64(1.0);
    clamp_last(if sum > one { sum - one } else { sum })
}

/// Returns the stratum that the paper gives to frame `i` of `n`: `i / 2 + (i mod 2) n / 2`, in whole numbers. §7.2.3.
///
/// Literal: a permutation of 0..n for even `n` only; an odd `n` repeats strata and leaves others out.
#[must_use]
pub fn alternating_literal(i: u32, n: NonZeroU32) -> u32 {
    i / 2 + (i % 2) * (n.get() / 2)
}

/// Returns the stratum of frame `i` of `n`, so that the lower and the upper half of the strata take turns: a
/// permutation of 0..n for every `n`. `i` counts modulo `n`. §7.2.3, with the half rounded up.
#[must_use]
pub fn alternating(i: u32, n: NonZeroU32) -> u32 {
    let i = i % n;
    i / 2 + (i % 2) * n.get().div_ceil(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::threshold::robust::SMALLEST_ROBUST_THRESHOLD;

    fn sizes() -> impl Iterator<Item = NonZeroU32> {
        (1..=64).filter_map(NonZeroU32::new)
    }

    fn is_permutation(order: impl Fn(u32) -> u32, n: NonZeroU32) -> bool {
        let mut strata: Vec<_> = (0..n.get()).map(order).collect();
        strata.sort_unstable();
        strata.into_iter().eq(0..n.get())
    }

    #[test]
    fn the_order_visits_every_stratum_for_every_n() {
        for n in sizes() {
            assert!(is_permutation(|i| alternating(i, n), n), "{n}");
            assert_eq!(
                is_permutation(|i| alternating_literal(i, n), n),
                n.get() % 2 == 0 || n.get() == 1,
                "{n}"
            );
        }
    }

    #[test]
    fn literal_and_stable_orders_agree_for_even_n() {
        for n in sizes().filter(|n| n.get() % 2 == 0) {
            assert!((0..n.get()).all(|i| alternating(i, n) == alternating_literal(i, n)));
        }
    }

    #[test]
    fn the_first_stratum_changes_nothing() {
        for chi in [SMALLEST_ROBUST_THRESHOLD as f32, 0.3, 0.999_999_94, 1.0] {
            assert!(sizes().all(|n| stratified(chi, 0, n) == chi), "{chi}");
        }
        assert!(stratified(f32::NAN, 3, NonZeroU32::MIN).is_nan());
    }

    #[test]
    fn literal_strata_reach_zero_and_stable_ones_do_not() {
        let n = NonZeroU32::new(8).unwrap();
        assert_eq!(stratified_literal(1.0_f32, 0, n), 0.0);
        assert_eq!(stratified_literal(0.25_f32, 6, n), 0.0);
        assert_eq!([stratified(1.0_f32, 0, n), stratified(0.25_f32, 6, n)], [1.0; 2]);
    }

    /// The share of frames that keep a fragment misses alpha by less than one frame.
    #[test]
    fn coverage_of_a_pixel_is_alpha_to_within_one_frame() {
        for n in sizes() {
            for alpha in [0.0, 0.1, 0.33, 0.5, 0.871, 1.0] {
                for chi in [1e-6, 0.1, 0.499, 0.5, 0.77, 0.999_999, 1.0] {
                    let kept =
                        (0..n.get()).filter(|&i| alpha >= stratified(chi, alternating(i, n), n)).count();
                    let error = (kept as f64 / f64::from(n.get()) - alpha) * f64::from(n.get());
                    assert!(error.abs() < 1.0 + 1e-9, "n {n}, alpha {alpha}, chi {chi}: {error}");
                }
            }
        }
    }
}
