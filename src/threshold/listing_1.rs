//! Listing 1 as a whole, line by line with the names of the paper.
//!
//! What the crate evaluates is put together of parts ([`HashedAlpha`](super::hashed::HashedAlpha)); a test says that they give
//! the same bits. Literal: without a derivative the scale is infinite and the threshold NaN.

use super::footprint::Footprint;
use super::hash::sine::hash_3d;
use super::real::Real;
use super::real::length_of as length;

/// Returns the isotropic hashed alpha threshold of a footprint, in [1e-6, 1] or NaN. `g_hash_scale` is the size of the noise in
/// pixels, by default 1. Listing 1.
///
/// ```
/// use hashed_alpha::Footprint;
/// use hashed_alpha::threshold::listing_1::listing_1;
///
/// let footprint = Footprint::<f32> {
///     position: glam::vec3(0.31, -1.72, 2.43),
///     dpdx: glam::vec3(0.0121, 0.0003, -0.0007),
///     dpdy: glam::vec3(0.0002, 0.0094, 0.0033),
/// };
/// let discards = 0.4 < listing_1(&footprint, 1.0);
/// # let _ = discards;
/// ```
#[must_use]
#[rustfmt::skip]
pub fn listing_1<R: Real>(footprint: &Footprint<R>, g_hash_scale: R) -> R {
    let [half, one, two] = [0.5, 1.0, 2.0].map(R::from_f64);
    let obj_coord: [R; 3] = footprint.position.into();
    // Find the discretized derivatives of our coordinates
    let max_deriv = Real::max(length(footprint.dpdx.into()), length(footprint.dpdy.into()));
    let pix_scale = one / (g_hash_scale * max_deriv);
    // Find two nearest log-discretized noise scales
    let pix_scales = [pix_scale.log2().floor().exp2(), pix_scale.log2().ceil().exp2()];
    // Compute alpha thresholds at our two noise scales
    let alpha = pix_scales.map(|scale| hash_3d::<R>(obj_coord.map(|x| (scale * x).floor()).into()));
    // Factor to linearly interpolate with
    let lerp_factor = pix_scale.log2().fract();
    // Interpolate alpha threshold from noise at two scales
    let x = (one - lerp_factor) * alpha[0] + lerp_factor * alpha[1];
    // Pass into CDF to compute uniformly distrib threshold
    let a = Real::min(lerp_factor, one - lerp_factor);
    let cases = [x * x / (two * a * (one - a)),
                 (x - half * a) / (one - a),
                 one - ((one - x) * (one - x) / (two * a * (one - a)))];
    // Find our final, uniformly distributed alpha threshold
    let alpha_tau = if x < one - a { if x < a { cases[0] } else { cases[1] } } else { cases[2] };
    // Avoids alpha_tau == 0. Could also do alpha_tau = 1 - alpha_tau
    Real::clamp(alpha_tau, R::from_f64(1.0e-6), one)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::threshold::hashed::HashedAlpha;
    use crate::threshold::listing_2::listing_2;
    use crate::threshold::two_scale::Variant;

    /// Footprints in general position, and every combination of what is hard.
    fn footprints() -> impl Iterator<Item = Footprint<f64>> {
        let hard = [0.0, -0.0, 1e-45, 1e-30, 0.25, -3.0, 1e10, 3e38, f64::INFINITY, f64::NAN];
        let of = |p: f64, x: f64, y: f64| Footprint {
            position: glam::dvec3(p, 0.3, -p),
            dpdx: glam::dvec3(x, 0.0, x),
            dpdy: glam::dvec3(0.0, y, x),
        };
        let hard = (0..1000).map(move |i| of(hard[i % 10], hard[i / 10 % 10], hard[i / 100]));
        let plain = (0..20_000).map(f64::from).map(|t| Footprint {
            position: glam::dvec3(0.37 * t - 700.0, 3.0 - 0.011 * t, 0.013 * t),
            dpdx: glam::dvec3(0.01 + 1e-4 * t, -0.003, 0.0007 * t),
            dpdy: glam::dvec3(0.002, 0.02 - 7e-6 * t, 0.004),
        });
        hard.chain(plain)
    }

    fn expect_same_bits<R: Real>() {
        for scale in [1.0, 0.3, 0.0, 1e30] {
            for footprint in footprints().map(|footprint| footprint.cast::<R>()) {
                for (variant, whole) in
                    [(Variant::Isotropic, listing_1 as fn(&_, R) -> R), (Variant::Anisotropic, listing_2)]
                {
                    let parts = HashedAlpha { hash_scale: scale, ..HashedAlpha::listing(variant) };
                    let (whole, parts) = (whole(&footprint, R::from_f64(scale)), parts.threshold(&footprint));
                    let [a, b] = [whole, parts].map(R::to_f64);
                    assert!(a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan(), "{footprint:?} {a} {b}");
                }
            }
        }
    }

    #[test]
    fn both_listings_are_their_parts_bit_for_bit() {
        expect_same_bits::<f32>();
        expect_same_bits::<f64>();
    }
}
