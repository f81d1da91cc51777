//! Anything that turns footprints into thresholds.

use crate::threshold::footprint::Footprint;
use crate::threshold::hash::{Hash, HashKind};
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::real::Real;
use crate::threshold::robust::scales::{self, Scales};
use crate::threshold::robust::{Join, Repair, Repairs, Robust};
use crate::threshold::two_scale::Variant;
use core::fmt;
use glam::DVec3;
use rayon::prelude::*;

/// The arithmetic in which a subject works.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Precision {
    /// 32 bits.
    F32,
    /// 64 bits.
    F64,
}

impl Precision {
    /// Both precisions.
    pub const ALL: [Self; 2] = [Self::F32, Self::F64];

    /// "f32" or "f64".
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::F32 => f32::NAME,
            Self::F64 => f64::NAME,
        }
    }

    /// Rounds a footprint to what a subject of this precision can be given.
    #[must_use]
    pub fn round(self, footprint: &Footprint<f64>) -> Footprint<f64> {
        match self {
            Self::F32 => footprint.cast::<f32>().cast(),
            Self::F64 => *footprint,
        }
    }
}

impl fmt::Display for Precision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A function of a footprint that can be asked from several threads.
type Evaluation<'a> = Box<dyn Fn(&Footprint<f64>) -> Option<f64> + Send + Sync + 'a>;

/// A threshold on trial.
pub struct Subject<'a> {
    /// The name in reports, as in "paper:isotropic".
    pub name: String,
    /// The arithmetic in which it works; it is given footprints that are exact in it.
    pub precision: Precision,
    /// Which listing it claims to follow: fixes the cells by which samples are told apart and stability is predicted.
    pub variant: Variant,
    /// How it claims to join the hashes of two octaves.
    pub join: Join,
    /// Whether its cells begin between whole numbers ([`Repair::NestedPhase`]).
    pub nested_phase: bool,
    /// The size of the noise in pixels that it claims to have.
    pub hash_scale: f64,
    threshold: Evaluation<'a>,
    interpolated: Option<Evaluation<'a>>,
}

/// The cells that a subject claims to have at a footprint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nominal {
    /// Coarse cells per object unit along each axis, a power of two.
    pub coarse_scale: [f64; 3],
    /// Fine cells per object unit along each axis, twice as many.
    pub fine_scale: [f64; 3],
    /// Index of the coarse cell.
    pub coarse_cell: DVec3,
    /// Index of the fine cell.
    pub fine_cell: DVec3,
    /// Where the scale lies between the two along each axis, in [0, 1).
    pub fraction: [f64; 3],
    /// Weight between the two hashes: the fraction, or the weight of Listing 2 where each axis has a scale of its own.
    pub lerp_factor: f64,
}

impl fmt::Debug for Subject<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Subject({} {})", self.name, self.precision)
    }
}

impl<'a> Subject<'a> {
    /// Puts a function on trial that follows `variant` with the paper's join and a noise of one pixel.
    ///
    /// The function returns a threshold, or an `Option` that is `None` where it refuses its input.
    ///
    /// ```
    /// use hashed_alpha::check::{Subject, subject::Precision};
    /// use hashed_alpha::threshold::{named::listing_1_f32, two_scale::Variant};
    ///
    /// let mine = Subject::new("mine", Precision::F32, Variant::Isotropic, |footprint| {
    ///     f64::from(listing_1_f32(&footprint.cast(), 1.0))
    /// });
    /// assert_eq!(mine.precision.name(), "f32");
    /// ```
    #[must_use]
    pub fn new<T: Into<Option<f64>>>(
        name: impl Into<String>,
        precision: Precision,
        variant: Variant,
        threshold: impl Fn(&Footprint<f64>) -> T + Send + Sync + 'a,
    ) -> Self {
        Self {
            name: name.into(),
            precision,
            variant,
            join: Join::Interpolate,
            nested_phase: false,
            hash_scale: 1.0,
            threshold: Box::new(move |footprint| threshold(footprint).into()),
            interpolated: None,
        }
    }

    /// Puts a literal listing on trial.
    #[must_use]
    pub fn hashed<H>(name: impl Into<String>, precision: Precision, hashed: HashedAlpha<H>) -> Self
    where
        H: Hash<f32> + Hash<f64> + Copy + Send + 'a,
    {
        let evaluate = move |footprint: &Footprint<f64>| match precision {
            Precision::F32 => {
                let trace = hashed.trace::<f32>(&footprint.cast());
                (trace.threshold.to_f64(), trace.interpolated.to_f64())
            }
            Precision::F64 => {
                let trace = hashed.trace(footprint);
                (trace.threshold, trace.interpolated)
            }
        };
        Self {
            hash_scale: hashed.hash_scale,
            interpolated: Some(Box::new(move |footprint| Some(evaluate(footprint).1))),
            ..Self::new(name, precision, hashed.variant, move |footprint| evaluate(footprint).0)
        }
    }

    /// Puts a robust threshold on trial; it refuses what [`Robust::threshold`] refuses.
    #[must_use]
    pub fn robust<H>(name: impl Into<String>, precision: Precision, robust: Robust<H>) -> Self
    where
        H: Hash<f32> + Hash<f64> + Copy + Send + 'a,
    {
        let evaluate = move |footprint: &Footprint<f64>| match precision {
            Precision::F32 => {
                let trace = robust.trace::<f32>(&footprint.cast()).ok()?;
                Some((trace.threshold.to_f64(), trace.joined.interpolated.to_f64()))
            }
            Precision::F64 => {
                let trace = robust.trace(footprint).ok()?;
                Some((trace.threshold, trace.joined.interpolated))
            }
        };
        // Only the paper's join has a value that Eq. 2 makes uniform.
        let interpolated: Option<Evaluation<'a>> = (robust.join == Join::Interpolate)
            .then(|| Box::new(move |footprint: &Footprint<f64>| Some(evaluate(footprint)?.1)) as _);
        Self {
            hash_scale: robust.hash_scale,
            join: robust.join,
            nested_phase: robust.repairs.contains(Repair::NestedPhase),
            interpolated,
            ..Self::new(name, precision, robust.variant, move |footprint| Some(evaluate(footprint)?.0))
        }
    }

    /// The paper's Listings 1 and 2 to the letter, in both precisions.
    #[must_use]
    pub fn paper() -> Vec<Self> {
        Self::both_variants("paper", |name, precision, variant| {
            Self::hashed(name, precision, HashedAlpha::listing(variant))
        })
    }

    /// The robust threshold with every repair, in both variants and precisions.
    #[must_use]
    pub fn all_repairs() -> Vec<Self> {
        Self::both_variants("robust", |name, precision, variant| {
            Self::robust::<HashKind>(name, precision, Robust::new(variant))
        })
    }

    fn both_variants(family: &str, subject: impl Fn(String, Precision, Variant) -> Self) -> Vec<Self> {
        let mut subjects = Vec::new();
        for variant in [Variant::Isotropic, Variant::Anisotropic] {
            for precision in Precision::ALL {
                subjects.push(subject(format!("{family}:{variant}"), precision, variant));
            }
        }
        subjects
    }

    /// Evaluates one footprint, which must be exact in the subject's precision (see [`Precision::round`]); `None` where
    /// the subject refuses it.
    #[must_use]
    pub fn threshold(&self, footprint: &Footprint<f64>) -> Option<f64> {
        (self.threshold)(footprint)
    }

    /// Evaluates many footprints on all threads, NaN where the subject refuses one; the order and the bits do not
    /// depend on the number of threads.
    #[must_use]
    pub fn thresholds(&self, footprints: &[Footprint<f64>]) -> Vec<f64> {
        evaluated(&self.threshold, footprints)
    }

    /// Evaluates the value before Eq. 2 of many footprints; `None` for a subject that has none.
    #[must_use]
    pub fn interpolated(&self, footprints: &[Footprint<f64>]) -> Option<Vec<f64>> {
        self.interpolated.as_ref().map(|interpolated| evaluated(interpolated, footprints))
    }

    /// Returns the cells that the subject claims to have at a footprint, computed in its precision.
    ///
    /// Total: where the listings divide by zero these are the cells of the robust threshold.
    #[must_use]
    pub fn nominal(&self, footprint: &Footprint<f64>) -> Nominal {
        match self.precision {
            Precision::F32 => self.nominal_in::<f32>(&footprint.cast()),
            Precision::F64 => self.nominal_in(footprint),
        }
    }

    fn nominal_in<R: Real>(&self, footprint: &Footprint<R>) -> Nominal {
        let hash_scale = R::from_f64(self.hash_scale);
        let found: Scales<R> = scales::scales(self.variant, footprint, hash_scale, Repairs::ALL);
        let grid = if self.nested_phase { Repairs::ALL } else { Repairs::ALL.without(Repair::NestedPhase) };
        let cell = |octave: [i32; 3]| {
            let index: [R; 3] = scales::cell::<R>(footprint.position, octave, grid).index.into();
            DVec3::from_array(index.map(R::to_f64))
        };
        let per_unit = |octave: [i32; 3]| octave.map(|k| libm::exp2(f64::from(k)));
        let lerp_factor = if self.variant == Variant::Anisotropic {
            scales::corner_weight(found.fraction)
        } else {
            found.fraction[0]
        };
        Nominal {
            coarse_scale: per_unit(found.octave),
            fine_scale: per_unit(found.next_octave),
            coarse_cell: cell(found.octave),
            fine_cell: cell(found.next_octave),
            fraction: found.fraction.map(R::to_f64),
            lerp_factor: lerp_factor.to_f64(),
        }
    }
}

fn evaluated(evaluation: &Evaluation<'_>, footprints: &[Footprint<f64>]) -> Vec<f64> {
    let value = |footprint: &Footprint<f64>| evaluation(footprint).unwrap_or(f64::NAN);
    footprints.par_iter().with_min_len(1024).map(value).collect()
}
