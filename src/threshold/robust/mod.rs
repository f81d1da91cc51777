//! The robust threshold: Listings 1 and 2 with every repair that the hard cases ask for.
//!
//! With [`Repairs::NONE`], [`Join::Interpolate`] and the sine hash it is the listing, bit for bit; each repair can be
//! switched alone, so that its effect and its price can be measured. With [`Repairs::ALL`] and an integer hash it is
//! total: every bit pattern of its inputs gives a threshold in [2^-24, 1] or an [`InvalidInput`].

pub mod join;
pub mod nested;
pub mod preset;
pub mod repairs;
pub mod scales;

pub use join::Join;
pub use preset::Preset;
pub use repairs::{Repair, Repairs};

use super::footprint::Footprint;
use super::hash::{Hash, HashKind};
use super::real::Real;
use super::two_scale::Variant;
use core::fmt;
use join::{Joined, Mixed};
use scales::Scales;

/// The smallest robust threshold, 2^-24: half a step of the open lattice, so that alpha 0 never passes.
pub const SMALLEST_ROBUST_THRESHOLD: f64 = 1.0 / 16_777_216.0;

/// A footprint or parameter that has no threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum InvalidInput {
    /// A coordinate or derivative is NaN or infinite.
    NotFinite {
        /// Which one, as in "dpdx.y".
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// The hash scale is not a positive number.
    HashScale(f64),
}

// By hand, here and for `UnknownName`: a macro for two messages would be half of what the crate takes to compile without
// features.
impl fmt::Display for InvalidInput {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { what, value } => write!(f, "{what} is {value}; a finite number is needed"),
            Self::HashScale(scale) => {
                write!(f, "the hash scale is {scale}; a finite number of pixels above 0 is needed")
            }
        }
    }
}

impl core::error::Error for InvalidInput {}

/// The robust threshold and what it is made of.
///
/// ```
/// use glam::vec3;
/// use hashed_alpha::threshold::{footprint::Footprint, robust::Robust, two_scale::Variant};
///
/// // A wall of constant z: Listing 2 divides by zero here.
/// let footprint = Footprint::<f32> {
///     position: vec3(0.3, 0.4, 0.5),
///     dpdx: vec3(0.1, 0.0, 0.0),
///     dpdy: vec3(0.0, 0.1, 0.0),
/// };
/// let threshold = Robust::new(Variant::Anisotropic).threshold(&footprint).unwrap();
/// assert!(threshold > 0.0 && threshold <= 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Robust<H = HashKind> {
    /// [`Variant::Isotropic`] or [`Variant::Anisotropic`]; the ablations of §5.4 have no robust form and count as
    /// isotropic here.
    pub variant: Variant,
    /// What is asked for the value of a cell.
    pub hash: H,
    /// Size of the noise in pixels, finite and above 0 (`g_HashScale`).
    pub hash_scale: f64,
    /// How the hashes of two octaves become one value.
    pub join: Join,
    /// Which repairs are made.
    pub repairs: Repairs,
}

/// Every intermediate value of one robust threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RobustTrace<R: Real> {
    /// Derivatives, scales and octaves.
    pub scales: Scales<R>,
    /// Hashes and weights.
    pub joined: Joined<R>,
    /// The threshold.
    pub threshold: R,
}

impl Robust {
    /// The hash that is taken unless another one is named: the fastest that no claim rejects, by `docs/hashes.md`.
    pub const HASH: HashKind = HashKind::LowbiasLinear;

    /// Every repair, [`Robust::HASH`] and a noise of one pixel; joined as in the paper with one scale, by the copula with
    /// one scale an axis, where the paper's join jumps. [`Robust::recommended`] has joins that change less.
    #[must_use]
    pub const fn new(variant: Variant) -> Self {
        let join = if matches!(variant, Variant::Anisotropic) { Join::Copula } else { Join::Interpolate };
        Self { variant, hash: Self::HASH, hash_scale: 1.0, join, repairs: Repairs::ALL }
    }
}

impl Robust {
    /// The threshold that is recommended: with every repair, noise of one pixel, and the fastest hash that no claim rejects.
    ///
    /// ```
    /// use hashed_alpha::threshold::robust::{Preset, Robust};
    /// use hashed_alpha::Footprint;
    ///
    /// let footprint = Footprint::<f32>::new([0.31, -1.72, 2.43], [0.0121, 0.0003, -0.0007], [0.0002, 0.0094, 0.0033]);
    /// let threshold = Robust::recommended(Preset::Steady).threshold(&footprint).expect("a finite footprint");
    /// let is_kept = 0.7 >= threshold;
    /// ```
    #[must_use]
    pub const fn recommended(preset: Preset) -> Self {
        match preset {
            Preset::Steady => Self { join: Join::Inherit, ..Self::new(Variant::Isotropic) },
            Preset::Smooth => Self { join: Join::Copula, ..Self::new(Variant::Anisotropic) },
        }
    }

    /// Whether the hash tells cells of different octaves apart where the join needs it: [`Join::Inherit`] hashes cells of several octaves
    /// side by side, and by their indices alone whole layers would have one threshold.
    #[must_use]
    pub fn tells_octaves_apart(&self) -> bool {
        self.join != Join::Inherit || self.hash.reads_octave() && self.repairs.contains(Repair::OctaveWord)
    }
}

impl Default for Robust {
    /// [`Robust::recommended`], steady.
    fn default() -> Self {
        Self::recommended(Preset::Steady)
    }
}

impl<H> Robust<H> {
    /// The same with another hash in place of its own.
    #[must_use]
    pub fn with_hash<G>(self, hash: G) -> Robust<G> {
        let Self { variant, hash: _, hash_scale, join, repairs } = self;
        Robust { variant, hash, hash_scale, join, repairs }
    }

    /// Returns the threshold of a footprint, in [2^-24, 1] with every repair.
    ///
    /// # Errors
    ///
    /// With [`Repair::ValidateInputs`]: [`InvalidInput`] for a coordinate or derivative that is NaN or infinite and for
    /// a hash scale that is not a finite number above 0.
    pub fn threshold<R: Real>(&self, footprint: &Footprint<R>) -> Result<R, InvalidInput>
    where
        H: Hash<R>,
    {
        use Join::{Copula, Dithered, Inherit, Interpolate};
        use Variant::{Anisotropic, Isotropic};
        const ALL: Repairs = Repairs::ALL;
        // Each arm is compiled for what it names.
        let made = match (self.variant == Anisotropic, self.join) {
            (false, Interpolate) if self.repairs == ALL => self.made(Isotropic, Interpolate, ALL, footprint),
            (false, Copula) if self.repairs == ALL => self.made(Isotropic, Copula, ALL, footprint),
            (false, Dithered) if self.repairs == ALL => self.made(Isotropic, Dithered, ALL, footprint),
            (false, Inherit) if self.repairs == ALL => self.made(Isotropic, Inherit, ALL, footprint),
            (true, Interpolate) if self.repairs == ALL => self.made(Anisotropic, Interpolate, ALL, footprint),
            (true, Copula) if self.repairs == ALL => self.made(Anisotropic, Copula, ALL, footprint),
            (true, Dithered) if self.repairs == ALL => self.made(Anisotropic, Dithered, ALL, footprint),
            (true, Inherit) if self.repairs == ALL => self.made(Anisotropic, Inherit, ALL, footprint),
            (_, Interpolate | Copula | Dithered | Inherit) => {
                self.made(self.variant, self.join, self.repairs, footprint)
            }
        };
        made.map(|(_, _, threshold)| threshold)
    }

    /// Returns the threshold of a footprint with every value on the way.
    ///
    /// # Errors
    ///
    /// Those of [`Robust::threshold`].
    pub fn trace<R: Real>(&self, footprint: &Footprint<R>) -> Result<RobustTrace<R>, InvalidInput>
    where
        H: Hash<R>,
    {
        let (scales, mixed, threshold) = self.made(self.variant, self.join, self.repairs, footprint)?;
        let [hash_coarse, hash_fine] =
            join::ends(self.join, self.variant, &self.hash, footprint.position, &scales, self.repairs);
        let Mixed { lerp_factor, interpolated, uniform } = mixed;
        let joined = Joined { lerp_factor, hash_coarse, hash_fine, interpolated, uniform };
        Ok(RobustTrace { scales, joined, threshold })
    }

    /// The threshold by a variant, join and repairs that the caller may know before it runs, and what it comes from.
    #[inline(always)]
    fn made<R: Real>(
        &self,
        variant: Variant,
        join: Join,
        repairs: Repairs,
        footprint: &Footprint<R>,
    ) -> Result<(Scales<R>, Mixed<R>, R), InvalidInput>
    where
        H: Hash<R>,
    {
        if repairs.contains(Repair::ValidateInputs) {
            validate(footprint, self.hash_scale)?;
        }
        let hash_scale = R::from_f64(self.hash_scale);
        let scales = scales::robust_scales(variant, footprint, hash_scale, repairs);
        let mixed = join::joined(join, variant, &self.hash, footprint.position, &scales, repairs);
        let smallest = if repairs.contains(Repair::FinalClamp) {
            SMALLEST_ROBUST_THRESHOLD
        } else {
            super::hashed::SMALLEST_THRESHOLD
        };
        let threshold = Real::clamp(mixed.uniform, R::from_f64(smallest), R::from_f64(1.0));
        Ok((scales, mixed, threshold))
    }
}

#[inline(always)]
fn validate<R: Real>(footprint: &Footprint<R>, hash_scale: f64) -> Result<(), InvalidInput> {
    // In the order of their bits, positive finite numbers lie between 0 and infinity.
    if hash_scale.to_bits().wrapping_sub(1) >= f64::INFINITY.to_bits() - 1 {
        return Err(InvalidInput::HashScale(hash_scale));
    }
    if all_finite(footprint) { Ok(()) } else { not_finite(footprint) }
}

/// Whether nine numbers are finite, as their sum tells: NaN and the infinities stay in it. So may finite numbers of the largest
/// sizes; what is not found finite is looked at one by one.
#[inline(always)]
fn all_finite<R: Real>(footprint: &Footprint<R>) -> bool {
    let sum = |v: R::Vec3| {
        let [x, y, z] = v.into();
        x + y + z
    };
    (sum(footprint.position) + sum(footprint.dpdx) + sum(footprint.dpdy)).is_finite()
}

/// Names the first coordinate or derivative that is not finite, if there is one.
#[cold]
fn not_finite<R: Real>(footprint: &Footprint<R>) -> Result<(), InvalidInput> {
    let named: [([&'static str; 3], [R; 3]); 3] = [
        (["position.x", "position.y", "position.z"], footprint.position.into()),
        (["dpdx.x", "dpdx.y", "dpdx.z"], footprint.dpdx.into()),
        (["dpdy.x", "dpdy.y", "dpdy.z"], footprint.dpdy.into()),
    ];
    let mut all = named.into_iter().flat_map(|(names, values)| names.into_iter().zip(values));
    match all.find(|(_, value)| !value.is_finite()) {
        Some((what, value)) => Err(InvalidInput::NotFinite { what, value: value.to_f64() }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::super::hash::sine::Sine;
    use super::super::hashed::HashedAlpha;
    use super::*;
    use glam::{Vec3, dvec3, vec3};

    fn footprints() -> impl Iterator<Item = Footprint<f64>> {
        (0..4000).map(|i| {
            let t = f64::from(i);
            Footprint {
                position: dvec3(0.37 * t - 700.0, 3.0 - 0.011 * t, 0.013 * t * t),
                dpdx: dvec3(0.01 + 1e-4 * t, -0.003, 0.0007 * t),
                dpdy: dvec3(0.002, 0.02 - 7e-6 * t, 0.004),
            }
        })
    }

    #[test]
    fn without_repairs_it_is_the_listing_bit_for_bit() {
        for variant in [Variant::Isotropic, Variant::Anisotropic] {
            let robust = Robust {
                hash: Sine,
                join: Join::Interpolate,
                repairs: Repairs::NONE,
                variant,
                hash_scale: 1.0,
            };
            let listing = HashedAlpha::listing(variant);
            for footprint in footprints() {
                assert_eq!(robust.threshold(&footprint), Ok(listing.threshold(&footprint)));
                let single: Footprint<f32> = footprint.cast();
                assert_eq!(robust.threshold(&single), Ok(listing.threshold(&single)));
            }
        }
    }

    #[test]
    fn names_lead_back_and_every_preset_can_be_joined() {
        for preset in Preset::ALL {
            assert_eq!(preset.name().parse(), Ok(preset));
            let robust = Robust::recommended(preset);
            assert!(robust.tells_octaves_apart() && Preset::of(robust.variant) == preset);
        }
        assert_eq!(Robust::default(), Robust::recommended(Preset::Steady));
    }

    #[test]
    fn bad_input_is_named() {
        let good = Footprint::<f32> { position: Vec3::ONE, dpdx: Vec3::X, dpdy: Vec3::Y };
        let robust = Robust::new(Variant::Isotropic);
        let bad = Footprint { dpdx: vec3(0.0, f32::NAN, 0.0), ..good };
        assert!(matches!(robust.threshold(&bad), Err(InvalidInput::NotFinite { what: "dpdx.y", .. })));
        for hash_scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let error = Robust { hash_scale, ..robust }.threshold(&good);
            assert!(matches!(error, Err(InvalidInput::HashScale(_))), "{error:?}");
        }
    }

    #[test]
    fn no_derivative_at_all_still_gives_a_threshold() {
        let still = Footprint::<f32> { position: vec3(1e5, 3.0, -7.0), dpdx: Vec3::ZERO, dpdy: Vec3::ZERO };
        for variant in [Variant::Isotropic, Variant::Anisotropic] {
            let threshold = Robust::new(variant).threshold(&still).unwrap();
            assert!(threshold > 0.0 && threshold <= 1.0);
        }
        let origin = Footprint { position: Vec3::ZERO, ..still };
        assert!(Robust::new(Variant::Anisotropic).threshold(&origin).is_ok());
    }

    /// A join that switches takes the value of the coarse or of the fine cell, inherited or not.
    #[test]
    fn a_trace_shows_the_value_that_is_taken() {
        for join in [Join::Dithered, Join::Inherit] {
            let robust = Robust { join, ..Robust::new(Variant::Isotropic) };
            for footprint in footprints() {
                let RobustTrace { joined, threshold, .. } = robust.trace(&footprint).unwrap();
                assert!([joined.hash_coarse, joined.hash_fine].contains(&threshold), "{join}: {footprint:?}");
            }
        }
    }

    #[test]
    fn every_join_agrees_where_only_one_octave_counts() {
        // A derivative of 2^-6 exactly: all weight is on the coarse cell.
        let footprint = Footprint::<f64> {
            position: dvec3(0.31, -1.72, 2.43),
            dpdx: dvec3(0.015_625, 0.0, 0.0),
            dpdy: dvec3(0.0, 0.015_625, 0.0),
        };
        let of = |join| Robust { join, ..Robust::new(Variant::Isotropic) }.threshold(&footprint).unwrap();
        assert_eq!(of(Join::Interpolate), of(Join::Dithered));
        assert!((of(Join::Interpolate) - of(Join::Copula)).abs() < 1e-15);
    }
}
