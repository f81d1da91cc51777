//! The hashed alpha threshold (§5, §6): two cells, two hashes, one weight, one uniform value.

use super::cdf::CdfForm;
use super::footprint::Footprint;
use super::hash::{Hash, HashKind, sine::Sine};
use super::real::Real;
use super::two_scale::{TwoScale, Variant};

/// The smallest threshold that Listings 1 and 2 return.
pub const SMALLEST_THRESHOLD: f64 = 1.0e-6;

/// Everything that turns a footprint into a threshold.
///
/// ```
/// use glam::vec3;
/// use hashed_alpha::threshold::{footprint::Footprint, hashed::HashedAlpha, two_scale::Variant};
///
/// let footprint = Footprint::<f32> {
///     position: vec3(0.31, -1.72, 2.43),
///     dpdx: vec3(0.0121, 0.0003, -0.0007),
///     dpdy: vec3(0.0002, 0.0094, 0.0033),
/// };
/// let threshold = HashedAlpha::listing(Variant::Isotropic).threshold(&footprint);
/// assert!(threshold > 0.0 && threshold <= 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HashedAlpha<H = HashKind> {
    /// How scales come from derivatives.
    pub variant: Variant,
    /// What is asked for the value of a cell.
    pub hash: H,
    /// Size of the noise in pixels, above 0 (`g_HashScale`; the paper's default is 1).
    pub hash_scale: f64,
    /// Literal: to the letter. Stable: Eq. 2 without a division by zero, and the clamp in every variant, where the
    /// paper has it in Listings 1 and 2 only.
    pub form: CdfForm,
}

/// Every intermediate value of one threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trace<R: Real> {
    /// Scales, cells and weight.
    pub two_scale: TwoScale<R>,
    /// The hash of the larger cell.
    pub hash_coarse: R,
    /// The hash of the smaller cell.
    pub hash_fine: R,
    /// The two hashes joined by the weight (`x` in Listing 1), before Eq. 2.
    pub interpolated: R,
    /// The threshold, in [1e-6, 1] or NaN.
    pub threshold: R,
}

impl HashedAlpha<Sine> {
    /// The paper's threshold to the letter, with its own hash and a noise of one pixel.
    #[must_use]
    pub const fn listing(variant: Variant) -> Self {
        Self { variant, hash: Sine, hash_scale: 1.0, form: CdfForm::Literal }
    }
}

impl Default for HashedAlpha {
    /// Listing 1 to the letter.
    fn default() -> Self {
        HashedAlpha::listing(Variant::Isotropic).with_hash(HashKind::Sine)
    }
}

impl<H> HashedAlpha<H> {
    /// The same with another hash in place of its own.
    #[must_use]
    pub fn with_hash<G>(self, hash: G) -> HashedAlpha<G> {
        let Self { variant, hash: _, hash_scale, form } = self;
        HashedAlpha { variant, hash, hash_scale, form }
    }

    /// Returns the threshold of a footprint.
    ///
    /// In [1e-6, 1]; NaN where the listing gives NaN (a derivative of zero along an axis of Listing 2, derivatives
    /// that vanish or are not finite). Without the clamp, in the literal form of [`Variant::Linear`] and
    /// [`Variant::Single`], it can be 0.
    #[must_use]
    pub fn threshold<R: Real>(&self, footprint: &Footprint<R>) -> R
    where
        H: Hash<R>,
    {
        self.trace(footprint).threshold
    }

    /// Returns the threshold of a footprint with every value on the way.
    #[must_use]
    pub fn trace<R: Real>(&self, footprint: &Footprint<R>) -> Trace<R>
    where
        H: Hash<R>,
    {
        let two_scale = self.variant.two_scale(footprint, R::from_f64(self.hash_scale));
        let interpolates = self.variant != Variant::Single;
        let [at_floor, at_ceil] = if interpolates {
            self.hash.hash_all([two_scale.floor_cell, two_scale.ceil_cell])
        } else {
            [self.hash.hash(&two_scale.floor_cell); 2]
        };
        let lerp_factor = two_scale.lerp_factor;
        let interpolated = if interpolates {
            (R::from_f64(1.0) - lerp_factor) * at_floor + lerp_factor * at_ceil
        } else {
            at_floor
        };
        let corrects = matches!(self.variant, Variant::Isotropic | Variant::Anisotropic);
        let uniform = if corrects { self.form.cdf(interpolated, lerp_factor) } else { interpolated };
        let clamps = corrects || self.form == CdfForm::Stable;
        let threshold = if clamps {
            Real::clamp(uniform, R::from_f64(SMALLEST_THRESHOLD), R::from_f64(1.0))
        } else {
            uniform
        };
        let (hash_coarse, hash_fine) =
            if self.variant == Variant::Linear { (at_ceil, at_floor) } else { (at_floor, at_ceil) };
        Trace { two_scale, hash_coarse, hash_fine, interpolated, threshold }
    }
}

#[cfg(test)]
mod tests {
    use super::super::hash::Cell;
    use super::*;
    use glam::{dvec3, vec3};

    /// A hash that returns what it is told, to see the rest of the listing alone.
    struct Constant(f64);
    impl<R: Real> Hash<R> for Constant {
        fn hash(&self, _: &Cell<R>) -> R {
            R::from_f64(self.0)
        }
    }

    fn footprint(derivative: f64) -> Footprint<f64> {
        Footprint {
            position: dvec3(0.31, -1.72, 2.43),
            dpdx: dvec3(derivative, 0.0, 0.0),
            dpdy: dvec3(0.0, derivative, 0.0),
        }
    }

    #[test]
    fn threshold_of_zero_is_clamped_up() {
        let zero = HashedAlpha {
            variant: Variant::Isotropic,
            hash: Constant(0.0),
            hash_scale: 1.0,
            form: CdfForm::Literal,
        };
        assert_eq!(zero.threshold(&footprint(0.3)), 1.0e-6);
        assert_eq!(zero.threshold(&footprint(0.25)), 1.0e-6);
    }

    #[test]
    fn listing_2_has_no_threshold_on_an_axis_aligned_plane() {
        assert!(HashedAlpha::listing(Variant::Anisotropic).threshold(&footprint(0.1)).is_nan());
    }

    #[test]
    fn listing_1_has_no_threshold_without_derivatives() {
        let still = Footprint::<f32> {
            position: vec3(0.3, 0.4, 0.5),
            dpdx: glam::Vec3::ZERO,
            dpdy: glam::Vec3::ZERO,
        };
        assert!(HashedAlpha::listing(Variant::Isotropic).threshold(&still).is_nan());
    }

    #[test]
    fn single_returns_the_hash_and_linear_the_plain_mixture() {
        let single = HashedAlpha::listing(Variant::Single).trace(&footprint(0.3));
        assert_eq!(single.threshold, single.hash_coarse);
        let linear = HashedAlpha::listing(Variant::Linear).trace(&footprint(2.25));
        assert_eq!(linear.threshold, 0.75 * linear.hash_fine + 0.25 * linear.hash_coarse);
    }

    #[test]
    fn threshold_is_continuous_over_an_octave() {
        let listing = HashedAlpha::listing(Variant::Isotropic);
        let below: f64 = listing.threshold(&footprint(0.25 * (1.0 + 1e-12)));
        let above: f64 = listing.threshold(&footprint(0.25 * (1.0 - 1e-12)));
        assert!((below - above).abs() < 1e-10, "{below} {above}");
    }
}
