//! n thresholds in one fragment: alpha-to-coverage as n alpha tests (§8, Eqs. 7 to 9).

use super::clamp::clamp_last;
use crate::threshold::real::Real;
use core::num::NonZeroU32;

/// Returns the threshold of sample `i` of `n` under the fixed dither: `(i + 1/2) / n`; `i` counts modulo `n`. Eq. 7.
///
/// It keeps `round(n alpha)` samples; the paper says that this is the same as the `floor(n alpha)` of hardware (§3),
/// which it is not for half of all alphas.
#[must_use]
pub fn regular<R: Real>(i: u32, n: NonZeroU32) -> R {
    (R::from_f64(f64::from(i % n)) + R::from_f64(0.5)) / R::from_f64(f64::from(n.get()))
}

/// Returns the threshold of sample `i` of `n`, jittered within its stratum: `(i + chi) / n`. Eq. 8.
///
/// Literal: 0 for `i` = 0 and `chi` = 0.
#[must_use]
pub fn jittered_literal<R: Real>(chi: R, i: u32, n: NonZeroU32) -> R {
    (R::from_f64(f64::from(i)) + chi) / R::from_f64(f64::from(n.get()))
}

/// Returns the threshold of sample `i` of `n`, jittered within its stratum by `chi` in [0, 1], in [2^-24, 1]; `i` counts
/// modulo `n`. Eq. 8, with the clamp after it.
#[must_use]
pub fn jittered<R: Real>(chi: R, i: u32, n: NonZeroU32) -> R {
    clamp_last(jittered_literal(chi, i % n, n))
}

/// Returns the stratum of sample `i` of `n`: `(offset + i step) mod n` with `offset = floor(n xi_1)` and the odd
/// `step = 2 floor(n xi_2 / 2) + 1`. Eq. 9.
///
/// Literal: a permutation of 0..n only where `step` is coprime to `n`, as for powers of two, to which the paper limits
/// it.
#[must_use]
pub fn decorrelated_literal<R: Real>(xi: [R; 2], i: u32, n: NonZeroU32) -> u32 {
    let size = R::from_f64(f64::from(n.get()));
    let offset = (size * xi[0]).floor().to_word();
    let step = 2 * (R::from_f64(0.5) * size * xi[1]).floor().to_word() + 1;
    offset.wrapping_add(i.wrapping_mul(step)) % n
}

/// Returns the stratum of sample `i` of `n`: a permutation of 0..n for every `n` and every `xi` in [0, 1]. Eq. 9, with a
/// step that is drawn from the numbers coprime to `n`; `i` counts modulo `n`.
///
/// For powers of two these are the odd numbers, as in the paper. The work grows with `n`.
#[must_use]
pub fn decorrelated<R: Real>(xi: [R; 2], i: u32, n: NonZeroU32) -> u32 {
    let offset = choice(xi[0], n.get());
    let coprime = |&step: &u32| gcd(step, n.get()) == 1;
    let count = (1..=n.get()).filter(coprime).count();
    let chosen = choice(xi[1], count as u32);
    let step = (1..=n.get()).filter(coprime).nth(chosen as usize).unwrap_or(1);
    let stratum = (u64::from(offset) + u64::from(i % n) * u64::from(step)) % u64::from(n.get());
    stratum as u32
}

/// Cuts [0, 1] into `n` equal parts and returns the index of the one that holds `xi`; 0 for NaN.
fn choice<R: Real>(xi: R, n: u32) -> u32 {
    let scaled = (Real::clamp(xi, R::from_f64(0.0), R::from_f64(1.0)) * R::from_f64(f64::from(n))).floor();
    scaled.to_word().min(n - 1)
}

fn gcd(mut a: u32, mut b: u32) -> u32 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sizes() -> impl Iterator<Item = NonZeroU32> {
        (1..=64).filter_map(NonZeroU32::new)
    }

    fn parameters() -> impl Iterator<Item = [f64; 2]> {
        (0..=5).flat_map(|a| (0..=128).map(move |b| [f64::from(a) / 5.0, f64::from(b) / 128.0]))
    }

    fn is_permutation(xi: [f64; 2], n: NonZeroU32, order: impl Fn([f64; 2], u32, NonZeroU32) -> u32) -> bool {
        let mut strata: Vec<_> = (0..n.get()).map(|i| order(xi, i, n)).collect();
        strata.sort_unstable();
        strata.into_iter().eq(0..n.get())
    }

    #[test]
    fn every_sample_gets_a_stratum_of_its_own_for_every_n() {
        for n in sizes() {
            assert!(parameters().all(|xi| is_permutation(xi, n, decorrelated)), "{n}");
        }
    }

    #[test]
    fn the_literal_step_fails_for_n_that_are_no_powers_of_two() {
        for n in sizes() {
            let always = parameters().all(|xi| is_permutation(xi, n, decorrelated_literal));
            assert_eq!(always, n.get().is_power_of_two(), "{n}");
        }
    }

    #[test]
    fn regular_thresholds_keep_the_rounded_number_of_samples() {
        let n = NonZeroU32::new(4).unwrap();
        let kept = |alpha: f64| (0..4).filter(|&i| alpha >= regular(i, n)).count();
        assert_eq!(kept(0.2), 1);
        assert_eq!((4.0_f64 * 0.2).floor(), 0.0);
        assert_eq!((kept(0.0), kept(0.5), kept(1.0)), (0, 2, 4));
    }

    #[test]
    fn alpha_0_never_passes_and_alpha_1_always_does() {
        for n in sizes() {
            for chi in [0.0, 1e-30, 1.0 / 16_777_216.0, 0.5, 1.0 - 1.0 / 16_777_216.0, 1.0_f32] {
                for i in 0..n.get() {
                    let threshold = jittered(chi, i, n);
                    assert!(threshold > 0.0 && threshold <= 1.0);
                }
            }
        }
        assert_eq!(jittered_literal(0.0_f32, 0, NonZeroU32::MIN), 0.0);
    }
}
