//! Fading the noise in from a threshold of the artist's in place of 1/2 (§7.1 with another constant).

use super::clamp::clamp_last;
use crate::threshold::real::Real;

/// Blends a hashed threshold in (0, 1] with the authored one: exactly `authored` at `b` = 0 and `threshold` at `b` = 1,
/// in [2^-24, 1]. A `b` outside [0, 1] counts as its nearer end, NaN as 0.
///
/// With `authored` = 1/2 it is [`fade_in`](crate::threshold::stage::fade_in::fade_in), Eq. 4. Not in the paper, whose slides
/// compare with thresholds that artists set for each level.
#[must_use]
pub fn blend_towards<R: Real>(authored: R, threshold: R, b: R) -> R {
    let [zero, one] = [0.0, 1.0].map(R::from_f64);
    // Also false for NaN.
    let b = if b > zero { Real::min(b, one) } else { zero };
    clamp_last((one - b) * authored + b * threshold)
}

/// Returns the probability that a fragment is kept under [`blend_towards`] with a uniform threshold:
/// `clamp((alpha - (1 - b) authored) / b, 0, 1)`, a step at `authored` for `b` = 0.
#[must_use]
pub fn kept_share(alpha: f64, authored: f64, b: f64) -> f64 {
    if b > 0.0 {
        ((alpha - (1.0 - b) * authored) / b).clamp(0.0, 1.0)
    } else {
        f64::from(u8::from(alpha >= authored))
    }
}

#[cfg(test)]
mod tests {
    use super::super::fade_in::fade_in;
    use super::*;

    #[test]
    fn one_half_gives_equation_4() {
        for i in 1..=64 {
            for b in [0.0, 0.1, 0.5, 1.0, 2.0, -1.0] {
                let threshold = i as f32 / 64.0;
                assert_eq!(blend_towards(0.5, threshold, b), fade_in(threshold, b));
            }
        }
    }

    #[test]
    fn without_noise_the_authored_threshold_decides() {
        assert_eq!(blend_towards(0.3_f64, 0.9, 0.0), 0.3);
        assert_eq!(blend_towards(0.3_f64, 0.9, 1.0), 0.9);
        assert_eq!(blend_towards(0.3_f64, 0.9, f64::NAN), 0.3);
        // An authored threshold of 0 would keep alpha 0.
        assert!(blend_towards(0.0_f32, 0.9, 0.0) > 0.0);
    }

    #[test]
    fn the_kept_share_is_the_one_said() {
        let n = 10_000;
        for (alpha, authored, b) in [(0.3, 0.25, 0.25), (0.3, 0.5, 0.25), (0.5, 0.7, 0.5), (0.2, 0.3, 1.0)] {
            let kept = (0..n)
                .filter(|&i| alpha >= blend_towards(authored, (f64::from(i) + 0.5) / f64::from(n), b))
                .count() as f64;
            assert!((kept / f64::from(n) - kept_share(alpha, authored, b)).abs() < 1e-3);
        }
    }
}
