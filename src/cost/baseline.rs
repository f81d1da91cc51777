//! The listings as one writes them in Rust: `f32` or `f64`, and the standard library's sine, logarithm and power.
//!
//! This is what the ratios of the ladder refer to. Other machines, and other versions of the C library, give other
//! bits. Not the reference: [`HashedAlpha`](crate::threshold::hashed::HashedAlpha) is.

// The only place of the crate that calls them: their price is what is asked for.
#![allow(clippy::disallowed_methods)]

use crate::threshold::footprint::Footprint;
use glam::{DVec3, Vec3};

/// Writes both listings for one precision.
macro_rules! listings {
    ($real:ident, $vec3:ty, $isotropic:ident, $anisotropic:ident, $hash:ident, $finish:ident) => {
        /// `hash3D` (§5.1).
        #[inline]
        #[must_use]
        pub fn $hash(cell: $vec3) -> $real {
            let hash_2d = |x: $real, y: $real| {
                let amplitude = 1.0e4 * (17.0 * x + 0.1 * y).sin();
                let value = amplitude * (0.1 + (13.0 * y + x).sin().abs());
                value - value.floor()
            };
            hash_2d(hash_2d(cell.x, cell.y), cell.z)
        }

        #[inline]
        fn $finish(hashes: [$real; 2], t: $real) -> $real {
            let x = (1.0 - t) * hashes[0] + t * hashes[1];
            let a = t.min(1.0 - t);
            let threshold = if x < a {
                x * x / (2.0 * a * (1.0 - a))
            } else if x < 1.0 - a {
                (x - 0.5 * a) / (1.0 - a)
            } else {
                1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))
            };
            threshold.clamp(1.0e-6, 1.0)
        }

        /// Listing 1 with a noise of one pixel.
        #[must_use]
        pub fn $isotropic(footprint: &Footprint<$real>) -> $real {
            let derivative = footprint.dpdx.length().max(footprint.dpdy.length());
            let log_scale = (1.0 / derivative).log2();
            let [coarse, fine] = [log_scale.floor(), log_scale.ceil()].map(<$real>::exp2);
            let hash = |scale: $real| $hash((scale * footprint.position).floor());
            $finish([hash(coarse), hash(fine)], log_scale - log_scale.floor())
        }

        /// Listing 2 with a noise of one pixel.
        #[must_use]
        pub fn $anisotropic(footprint: &Footprint<$real>) -> $real {
            let derivative = footprint.dpdx.abs().max(footprint.dpdy.abs());
            let log_scale = (0.707 / derivative).map(<$real>::log2);
            let (floor, ceil) = (log_scale.floor(), log_scale.ceil());
            let hash = |octaves: $vec3| $hash((octaves.map(<$real>::exp2) * footprint.position).floor());
            let fraction = log_scale - floor;
            let (to_floor, to_ceil) = (fraction.length(), (1.0 - fraction).length());
            $finish([hash(floor), hash(ceil)], to_floor / (to_floor + to_ceil))
        }
    };
}
listings!(f32, Vec3, listing_1_f32, listing_2_f32, hash_f32, finish_f32);
listings!(f64, DVec3, listing_1_f64, listing_2_f64, hash_f64, finish_f64);

/// The sine of the standard library.
#[must_use]
pub fn sin_f32(x: f32) -> f32 {
    x.sin()
}

/// The sine of the standard library.
#[must_use]
pub fn sin_f64(x: f64) -> f64 {
    x.sin()
}

/// The logarithm of the standard library.
#[must_use]
pub fn log2_f32(x: f32) -> f32 {
    x.log2()
}

/// The logarithm of the standard library.
#[must_use]
pub fn log2_f64(x: f64) -> f64 {
    x.log2()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::pool::{Pool, WIDE};
    use crate::threshold::hashed::HashedAlpha;
    use crate::threshold::real::Real;
    use crate::threshold::two_scale::Variant;

    /// Returns the share of footprints for which two thresholds are within 1e-5.
    fn agreement<R: Real>(ours: fn(&Footprint<R>) -> R, variant: Variant) -> f64 {
        let pool = Pool::<R>::new(WIDE, 1);
        let listing = HashedAlpha::listing(variant);
        let near = |footprint: &&Footprint<R>| {
            let reference: R = listing.threshold(*footprint);
            (ours(footprint).to_f64() - reference.to_f64()).abs() < 1e-5
        };
        let footprints = pool.footprints(0);
        footprints.iter().filter(near).count() as f64 / footprints.len() as f64
    }

    #[test]
    fn the_baselines_are_the_listings_but_for_the_last_digits_of_a_sine() {
        // A sine that is rounded otherwise gives another threshold altogether; in `f64` it changes a late digit.
        assert!(agreement(listing_1_f32, Variant::Isotropic) > 0.8);
        assert!(agreement(listing_2_f32, Variant::Anisotropic) > 0.8);
        assert!(agreement(listing_1_f64, Variant::Isotropic) > 0.95);
        assert!(agreement(listing_2_f64, Variant::Anisotropic) > 0.95);
    }
}
