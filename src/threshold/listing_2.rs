//! Listing 2 as a whole, line by line with the names of the paper.
//!
//! What the crate evaluates is put together of parts ([`HashedAlpha`](super::hashed::HashedAlpha)); a test beside Listing 1 says
//! that they give the same bits. Literal: along an axis in which neither derivative moves the scale is infinite and the
//! threshold NaN.

use super::footprint::Footprint;
use super::hash::sine::hash_3d;
use super::real::Real;
use super::real::length_of as length;

/// Returns the anisotropic hashed alpha threshold of a footprint, in [1e-6, 1] or NaN. `g_hash_scale` is the size of the noise
/// in pixels, by default 1. Listing 2.
#[must_use]
#[rustfmt::skip]
pub fn listing_2<R: Real>(footprint: &Footprint<R>, g_hash_scale: R) -> R {
    let [half, one, two] = [0.5, 1.0, 2.0].map(R::from_f64);
    let [obj_coord, dpdx, dpdy]: [[R; 3]; 3] =
        [footprint.position, footprint.dpdx, footprint.dpdy].map(Into::into);
    // Find the discretized derivatives of our coordinates
    let aniso_deriv = [0, 1, 2].map(|i| Real::max(dpdx[i].abs(), dpdy[i].abs()));
    let aniso_scales = aniso_deriv.map(|deriv| R::from_f64(0.707) / (g_hash_scale * deriv));
    // Find log-discretized noise scales
    let scale_flr = aniso_scales.map(|scale| scale.log2().floor().exp2());
    let scale_ceil = aniso_scales.map(|scale| scale.log2().ceil().exp2());
    // Compute alpha thresholds at our two noise scales
    let alpha = [scale_flr, scale_ceil]
        .map(|scale| hash_3d::<R>([0, 1, 2].map(|i| (scale[i] * obj_coord[i]).floor()).into()));
    // Factor to linearly interpolate with
    let fract_loc = aniso_scales.map(|scale| scale.log2().fract());
    let to_corners = [length(fract_loc), length(fract_loc.map(|fract| one - fract))];
    let lerp_factor = to_corners[0] / (to_corners[0] + to_corners[1]);
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
