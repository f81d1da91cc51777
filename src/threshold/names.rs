//! The listings under one name a precision, for callers who want no type parameter.
//!
//! Each function forwards to the generic one that its documentation names; domains and ranges are stated there.

use super::footprint::Footprint;
use super::hash::{sine, sine_chi_2};
use super::hashed::HashedAlpha;
use super::two_scale::Variant;
use super::{cdf, hash::sine::Sine};

/// Declares the named entry points of one precision.
macro_rules! entry_points {
    ($real:ty, $vec2:ty, $vec3:ty, $hash_2d:ident, $hash_3d:ident, $chi_2:ident, $cdf:ident, $literal:ident,
     $isotropic:ident, $anisotropic:ident) => {
        #[doc = concat!("[`sine::hash_2d`] in `", stringify!($real), "` (§5.1).")]
        #[must_use]
        pub fn $hash_2d(coordinates: $vec2) -> $real {
            sine::hash_2d(coordinates.x, coordinates.y)
        }

        #[doc = concat!("[`sine::hash_3d`] in `", stringify!($real), "` (§5.1).")]
        #[must_use]
        pub fn $hash_3d(coordinates: $vec3) -> $real {
            sine::hash_3d::<$real>(coordinates)
        }

        #[doc = concat!("[`sine_chi_2::hash_3d_chi_2`] in `", stringify!($real), "` (§9).")]
        #[must_use]
        pub fn $chi_2(coordinates: $vec3) -> $real {
            sine_chi_2::hash_3d_chi_2::<$real>(coordinates)
        }

        #[doc = concat!("[`cdf::cdf`], the stable form of Eq. 2, in `", stringify!($real), "`.")]
        #[must_use]
        pub fn $cdf(x: $real, lerp_factor: $real) -> $real {
            cdf::cdf(x, lerp_factor)
        }

        #[doc = concat!("[`cdf::cdf_literal`], Eq. 2 as the listings write it, in `", stringify!($real), "`.")]
        #[must_use]
        pub fn $literal(x: $real, lerp_factor: $real) -> $real {
            cdf::cdf_literal(x, lerp_factor)
        }

        #[doc = concat!("Listing 1 in `", stringify!($real), "`; `hash_scale` in pixels, above 0.")]
        #[must_use]
        pub fn $isotropic(footprint: &Footprint<$real>, hash_scale: f64) -> $real {
            listing(Variant::Isotropic, hash_scale).threshold(footprint)
        }

        #[doc = concat!("Listing 2 in `", stringify!($real), "`; `hash_scale` in pixels, above 0.")]
        #[must_use]
        pub fn $anisotropic(footprint: &Footprint<$real>, hash_scale: f64) -> $real {
            listing(Variant::Anisotropic, hash_scale).threshold(footprint)
        }
    };
}

fn listing(variant: Variant, hash_scale: f64) -> HashedAlpha<Sine> {
    HashedAlpha { hash_scale, ..HashedAlpha::listing(variant) }
}

entry_points!(
    f32,
    glam::Vec2,
    glam::Vec3,
    hash_2d_f32,
    hash_3d_f32,
    hash_3d_chi_2_f32,
    cdf_f32,
    cdf_literal_f32,
    listing_1_f32,
    listing_2_f32
);
entry_points!(
    f64,
    glam::DVec2,
    glam::DVec3,
    hash_2d_f64,
    hash_3d_f64,
    hash_3d_chi_2_f64,
    cdf_f64,
    cdf_literal_f64,
    listing_1_f64,
    listing_2_f64
);
