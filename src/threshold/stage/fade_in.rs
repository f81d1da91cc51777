//! Fading noise in with distance: Eqs. 3 to 5 and the anisotropy factor of §7.1.1.
//!
//! While the noise fades in, fragments with alpha below `(1 - b) / 2` vanish as they do under the traditional test:
//! Eq. 4 keeps a fragment with probability `clamp((alpha - 1/2) / b + 1/2, 0, 1)`.

use super::clamp::clamp_last;
use crate::threshold::cdf::CdfForm;
use crate::threshold::fixed::FIXED_THRESHOLD;
use crate::threshold::real::Real;

/// The anisotropy of texture filtering that hardware goes to; beyond it no finer level is read.
pub const GREATEST_ANISOTROPY: f64 = 16.0;

/// Noise that fades in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FadeIn {
    /// The threshold without noise, in (0, 1]: 1/2 in Eq. 4, or what an artist set.
    pub authored: f32,
    /// Level of detail from which on all is noise (`n` of Eq. 5), above 0.
    pub full_noise_lod: f32,
    /// Whether the level is multiplied by the degree of anisotropy of the texture access (§7.1.1).
    pub anisotropy: bool,
}

impl Default for FadeIn {
    /// From 1/2 over six levels.
    fn default() -> Self {
        Self { authored: FIXED_THRESHOLD as f32, full_noise_lod: 6.0, anisotropy: false }
    }
}

impl FadeIn {
    /// Returns the share of noise at a level of detail; `texel` are the lengths that [`anisotropy`] takes.
    pub(in crate::threshold) fn share<R: Real>(self, form: CdfForm, lod: R, texel: [R; 2]) -> R {
        let n = R::from_f64(f64::from(self.full_noise_lod));
        let scaled = |degree: fn([R; 2]) -> R| if self.anisotropy { lod * degree(texel) } else { lod };
        match form {
            CdfForm::Literal => blend_literal(scaled(anisotropy_literal), n),
            CdfForm::Stable => blend(scaled(anisotropy), n),
        }
    }

    /// Fades a threshold to a share of noise.
    pub(in crate::threshold) fn threshold<R: Real>(self, form: CdfForm, threshold: R, share: R) -> R {
        let authored = R::from_f64(f64::from(self.authored));
        match form {
            CdfForm::Literal => fade_in_literal(authored, threshold, share),
            CdfForm::Stable => fade_in(authored, threshold, share),
        }
    }
}

/// Returns the share of noise at a level of detail: 0 up to level 0, `(lod / n)^2` below `n`, 1 from `n` on. Eq. 5.
///
/// Literal: NaN where `lod` is NaN gives 1.
#[must_use]
pub fn blend_literal<R: Real>(lod: R, n: R) -> R {
    let [zero, one] = [0.0, 1.0].map(R::from_f64);
    if lod <= zero {
        zero
    } else if zero < lod && lod < n {
        (lod / n) * (lod / n)
    } else {
        one
    }
}

/// Returns the share of noise at a level of detail, in [0, 1] for every input. Eq. 5.
///
/// A level that is NaN counts as 0 (no noise), an `n` that is not above 0 as a step at level 0.
#[must_use]
pub fn blend<R: Real>(lod: R, n: R) -> R {
    let [zero, one] = [0.0, 1.0].map(R::from_f64);
    if lod > zero {
        let share = lod / n;
        // Also false for NaN, as from infinity over infinity.
        if share >= zero && share < one { share * share } else { one }
    } else {
        zero
    }
}

/// Returns the degree of anisotropy of a texture access, by which §7.1.1 multiplies the level of detail.
///
/// `lengths` are those of the two screen derivatives of the texture coordinate. Literal: NaN where both are 0, infinite
/// where one is.
#[must_use]
pub fn anisotropy_literal<R: Real>([x, y]: [R; 2]) -> R {
    Real::max(x / y, y / x)
}

/// Returns the degree of anisotropy of a texture access, in [1, 16]; 1 where it has none to speak of. §7.1.1.
///
/// Negative or non-finite lengths count as no anisotropy.
#[must_use]
pub fn anisotropy<R: Real>([x, y]: [R; 2]) -> R {
    let [one, greatest] = [1.0, GREATEST_ANISOTROPY].map(R::from_f64);
    let (long, short) = if x < y { (y, x) } else { (x, y) };
    if !(long.is_finite() && short.is_finite() && short >= R::from_f64(0.0)) || long <= short {
        one
    } else if long >= short * greatest {
        greatest
    } else {
        Real::clamp(long / short, one, greatest)
    }
}

/// Fades a threshold towards the authored one: `authored + (threshold - authored) b`. Eq. 4, where `authored` is 1/2.
///
/// Literal: with 1/2 it loses a threshold below 2^-25 even at `b` = 1, and can return 0.
#[must_use]
pub fn fade_in_literal<R: Real>(authored: R, threshold: R, b: R) -> R {
    authored + (threshold - authored) * b
}

/// Fades a threshold in (0, 1] towards the authored one: exactly `authored` at `b` = 0 and `threshold` at `b` = 1, in
/// [2^-24, 1]. A `b` outside [0, 1] counts as its nearer end, NaN as 0. Eq. 4 as a mixture, where `authored` is 1/2.
///
/// The slides compare with thresholds that artists set for each level; the paper has 1/2 only.
#[must_use]
pub fn fade_in<R: Real>(authored: R, threshold: R, b: R) -> R {
    let [zero, one] = [0.0, 1.0].map(R::from_f64);
    // Also false for NaN, which fades to nothing.
    let b = if b > zero { Real::min(b, one) } else { zero };
    clamp_last((one - b) * authored + b * threshold)
}

/// Returns the probability that a fragment is kept under [`fade_in`] with a uniform threshold:
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
    use super::*;

    #[test]
    fn the_ramp_is_quadratic_between_its_ends() {
        for (lod, expected) in [(-1.0, 0.0), (0.0, 0.0), (3.0, 0.25), (6.0, 1.0), (9.0, 1.0)] {
            assert_eq!(blend(lod, 6.0_f64), expected);
            assert_eq!(blend_literal(lod, 6.0_f64), expected);
        }
        for (lod, n, expected) in
            [(f32::NAN, 6.0, 0.0), (1.0, 0.0, 1.0), (1.0, -3.0, 1.0), (1.0, f32::NAN, 1.0), (0.0, 0.0, 0.0)]
        {
            assert_eq!(blend(lod, n), expected, "{lod} {n}");
        }
        assert_eq!(blend(f64::INFINITY, f64::INFINITY), 1.0);
    }

    #[test]
    fn anisotropy_has_bounds_where_the_literal_form_has_none() {
        assert!(anisotropy_literal([0.0_f32, 0.0]).is_nan());
        assert_eq!(anisotropy([0.0_f32, 0.0]), 1.0);
        assert!(anisotropy_literal([0.0_f32, 1.0]).is_infinite());
        assert_eq!(anisotropy([0.0_f32, 1.0]), 16.0);
        assert_eq!(anisotropy([0.2_f64, 0.4]), 2.0);
        assert_eq!(anisotropy([0.4_f64, 0.2]), 2.0);
        assert_eq!(anisotropy([f64::NAN, 0.2]), 1.0);
        assert_eq!(anisotropy([f64::INFINITY, 0.2]), 1.0);
    }

    #[test]
    fn a_small_threshold_survives_full_noise() {
        let small = 1.0_f32 / 16_777_216.0;
        assert_eq!(fade_in_literal(0.5, small, 1.0), 5.960_464_5e-8);
        assert_eq!(fade_in_literal(0.5, small * 0.25, 1.0), 0.0);
        assert_eq!(fade_in(0.5, small, 1.0), small);
        assert_eq!(fade_in(0.5, small, 0.0), 0.5);
        assert_eq!(fade_in(0.5, small, f32::NAN), 0.5);
        assert_eq!(fade_in(0.5, small, f32::INFINITY), small);
    }

    #[test]
    fn between_its_ends_a_threshold_moves_on_a_line() {
        for b in [0.25_f64, 0.5, 0.75] {
            assert_eq!(fade_in_literal(0.5, 0.9, b), 0.5 + 0.4 * b);
            assert!((fade_in(0.5, 0.9, b) - fade_in_literal(0.5, 0.9, b)).abs() < 1e-15);
        }
    }

    #[test]
    fn kept_share_follows_the_ramp() {
        let n = 10_000;
        for (alpha, b) in [(0.3, 0.25), (0.45, 0.25), (0.7, 0.5), (0.2, 1.0)] {
            let kept = (0..n)
                .map(|i| fade_in(0.5, (f64::from(i) + 0.5) / f64::from(n), b))
                .filter(|&threshold| alpha >= threshold)
                .count();
            let expected: f64 = ((alpha - 0.5) / b + 0.5_f64).clamp(0.0, 1.0);
            assert!((kept as f64 / f64::from(n) - expected).abs() < 1e-3, "alpha {alpha}, b {b}");
        }
    }

    #[test]
    fn without_noise_the_authored_threshold_decides() {
        assert_eq!(fade_in(0.3_f64, 0.9, 0.0), 0.3);
        assert_eq!(fade_in(0.3_f64, 0.9, 1.0), 0.9);
        assert_eq!(fade_in(0.3_f64, 0.9, f64::NAN), 0.3);
        // An authored threshold of 0 would keep alpha 0.
        assert!(fade_in(0.0_f32, 0.9, 0.0) > 0.0);
    }

    #[test]
    fn the_kept_share_is_the_one_said() {
        let n = 10_000;
        for (alpha, authored, b) in [(0.3, 0.25, 0.25), (0.3, 0.5, 0.25), (0.5, 0.7, 0.5), (0.2, 0.3, 1.0)] {
            let kept = (0..n)
                .filter(|&i| alpha >= fade_in(authored, (f64::from(i) + 0.5) / f64::from(n), b))
                .count() as f64;
            assert!((kept / f64::from(n) - kept_share(alpha, authored, b)).abs() < 1e-3);
        }
    }
}
