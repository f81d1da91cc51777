//! From a footprint to the two cells whose hashes are joined, and how far between them it lies.
//!
//! [`single`] and [`linear`] are the steps of §5.4 that lead to [`isotropic`] (Listing 1) and [`anisotropic`]
//! (Listing 2); they are kept as ablations. All four are literal: they follow the paper where it divides by zero too.

pub mod anisotropic;
pub mod isotropic;
pub mod linear;
mod scales;
pub mod single;

pub use scales::TwoScale;

use super::choice::{UnknownName, by_name};
use super::footprint::Footprint;
use super::real::Real;
use core::fmt;
use core::str::FromStr;

/// How scales are chosen from the derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Variant {
    /// One scale for all axes, between two octaves (Listing 1).
    Isotropic,
    /// One scale an axis, between two octaves (Listing 2).
    Anisotropic,
    /// Between two whole numbers of object units per pixel (§5.4.2, before the logarithm).
    Linear,
    /// The scale itself, one hash (§5.4.1).
    Single,
}

impl Variant {
    /// Every variant, in the order in which they are listed to users.
    pub const ALL: [Self; 4] = [Self::Isotropic, Self::Anisotropic, Self::Linear, Self::Single];

    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Isotropic => "isotropic",
            Self::Anisotropic => "anisotropic",
            Self::Linear => "linear",
            Self::Single => "single",
        }
    }

    /// The number of cells that are hashed for one threshold.
    #[must_use]
    pub const fn hashes(self) -> u64 {
        match self {
            Self::Isotropic | Self::Anisotropic | Self::Linear => 2,
            Self::Single => 1,
        }
    }

    /// Runs the variant on a footprint; `hash_scale` is in pixels (`g_HashScale`).
    #[must_use]
    pub fn two_scale<R: Real>(self, footprint: &Footprint<R>, hash_scale: R) -> TwoScale<R> {
        match self {
            Self::Isotropic => isotropic::two_scale(footprint, hash_scale),
            Self::Anisotropic => anisotropic::two_scale(footprint, hash_scale),
            Self::Linear => linear::two_scale(footprint, hash_scale),
            Self::Single => single::two_scale(footprint, hash_scale),
        }
    }
}

impl fmt::Display for Variant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Variant {
    type Err = UnknownName;
    fn from_str(name: &str) -> Result<Self, UnknownName> {
        by_name("variant", &Self::ALL, Self::name, name)
    }
}

#[cfg(test)]
mod tests {
    use super::scales::cell_at;
    use super::*;
    use glam::dvec3;

    fn footprint(scale: f64) -> Footprint<f64> {
        Footprint {
            position: dvec3(0.31, -1.72, 2.43),
            dpdx: dvec3(0.6, 0.0, 0.8) * scale,
            dpdy: dvec3(0.1, 0.3, -0.2) * scale,
        }
    }

    #[test]
    fn isotropic_finds_the_octaves_around_the_scale() {
        let found = Variant::Isotropic.two_scale(&footprint(0.3), 1.0);
        assert!((found.max_derivative[0] - 0.3).abs() < 1e-15);
        assert_eq!(found.octave, [1; 3]);
        assert_eq!(found.floor_cell, cell_at(dvec3(0.31, -1.72, 2.43), [2.0; 3], [1; 3]));
        assert_eq!(found.ceil_cell, cell_at(dvec3(0.31, -1.72, 2.43), [4.0; 3], [2; 3]));
        assert!((found.lerp_factor - libm::log2(10.0 / 6.0)).abs() < 1e-15);
    }

    #[test]
    fn power_of_two_scales_have_one_octave() {
        let found = Variant::Isotropic.two_scale(&footprint(0.25), 1.0);
        assert_eq!(found.lerp_factor, 0.0);
        assert_eq!(found.floor_cell, found.ceil_cell);
    }

    #[test]
    fn anisotropic_scales_each_axis_by_its_own_derivative() {
        let found = Variant::Anisotropic.two_scale(&footprint(0.3), 2.0);
        assert_eq!(found.max_derivative.map(|d| (d * 1e6).round()), [180_000.0, 90_000.0, 240_000.0]);
        assert_eq!(found.octave, [0, 1, 0]);
        assert!(found.lerp_factor > 0.0 && found.lerp_factor < 1.0);
    }

    #[test]
    fn anisotropic_divides_by_zero_on_an_axis_aligned_plane() {
        let flat = Footprint::<f64> {
            position: dvec3(0.3, 0.4, 0.5),
            dpdx: dvec3(0.1, 0.0, 0.0),
            dpdy: dvec3(0.0, 0.1, 0.0),
        };
        let found = Variant::Anisotropic.two_scale(&flat, 1.0);
        assert_eq!(found.pixel_scale[2], f64::INFINITY);
        assert!(found.lerp_factor.is_nan());
    }

    #[test]
    fn linear_lies_between_whole_derivatives() {
        let found = Variant::Linear.two_scale(&footprint(2.25), 1.0);
        assert_eq!(found.octave, [2; 3]);
        assert_eq!(found.floor_cell.index, dvec3(0.0, -1.0, 1.0));
        assert_eq!(found.ceil_cell.index, dvec3(0.0, -1.0, 0.0));
        assert!((found.lerp_factor - 0.25).abs() < 1e-15);
    }

    #[test]
    fn single_takes_the_scale_as_it_is() {
        let found = Variant::Single.two_scale(&footprint(0.3), 1.0);
        assert_eq!(found.floor_cell, found.ceil_cell);
        assert_eq!(found.floor_cell.index, dvec3(1.0, -6.0, 8.0));
    }

    #[test]
    fn names_lead_back_to_their_variant() {
        for variant in Variant::ALL {
            assert_eq!(variant.name().parse(), Ok(variant));
        }
        assert!("iso".parse::<Variant>().is_err());
    }
}
