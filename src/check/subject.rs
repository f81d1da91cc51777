//! Anything that turns footprints into thresholds.

use crate::threshold::footprint::Footprint;
use crate::threshold::hash::{Cell, Hash};
use crate::threshold::hashed::{HashedAlpha, Trace};
use crate::threshold::real::Real;
use crate::threshold::two_scale::{TwoScale, Variant};
use core::fmt;
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

    /// Rounds a number to the nearest of this precision.
    #[must_use]
    pub fn round_scalar(self, value: f64) -> f64 {
        match self {
            Self::F32 => f64::from(value as f32),
            Self::F64 => value,
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
type Evaluation<'a> = Box<dyn Fn(&Footprint<f64>) -> f64 + Send + Sync + 'a>;

/// A threshold on trial.
pub struct Subject<'a> {
    /// The name in reports, as in "paper:isotropic".
    pub name: String,
    /// The arithmetic in which it works; it is given footprints that are exact in it.
    pub precision: Precision,
    /// Which listing it claims to follow: fixes the cells by which samples are told apart and stability is predicted.
    pub variant: Variant,
    /// The size of the noise in pixels that it claims to have.
    pub hash_scale: f64,
    threshold: Evaluation<'a>,
    interpolated: Option<Evaluation<'a>>,
}

impl fmt::Debug for Subject<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Subject({} {})", self.name, self.precision)
    }
}

impl<'a> Subject<'a> {
    /// Puts a function on trial that follows `variant` with a noise of one pixel.
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
    pub fn new(
        name: impl Into<String>,
        precision: Precision,
        variant: Variant,
        threshold: impl Fn(&Footprint<f64>) -> f64 + Send + Sync + 'a,
    ) -> Self {
        Self {
            name: name.into(),
            precision,
            variant,
            hash_scale: 1.0,
            threshold: Box::new(threshold),
            interpolated: None,
        }
    }

    /// Puts a threshold of this crate on trial.
    #[must_use]
    pub fn hashed<H>(name: impl Into<String>, precision: Precision, hashed: HashedAlpha<H>) -> Self
    where
        H: Hash<f32> + Hash<f64> + Copy + Send + 'a,
    {
        let evaluate = move |footprint: &Footprint<f64>, part: fn(Parts) -> f64| match precision {
            Precision::F32 => part(Parts::new(&hashed.trace::<f32>(&footprint.cast()))),
            Precision::F64 => part(Parts::new(&hashed.trace(footprint))),
        };
        let threshold = Self::new(name, precision, hashed.variant, move |footprint| {
            evaluate(footprint, |parts| parts.threshold)
        });
        Self {
            hash_scale: hashed.hash_scale,
            interpolated: Some(Box::new(move |footprint| evaluate(footprint, |parts| parts.interpolated))),
            ..threshold
        }
    }

    /// The paper's Listings 1 and 2 to the letter, in both precisions.
    #[must_use]
    pub fn paper() -> Vec<Self> {
        let mut subjects = Vec::new();
        for variant in [Variant::Isotropic, Variant::Anisotropic] {
            for precision in Precision::ALL {
                let name = format!("paper:{variant}");
                subjects.push(Self::hashed(name, precision, HashedAlpha::listing(variant)));
            }
        }
        subjects
    }

    /// Evaluates one footprint, which must be exact in the subject's precision (see [`Precision::round`]).
    #[must_use]
    pub fn threshold(&self, footprint: &Footprint<f64>) -> f64 {
        (self.threshold)(footprint)
    }

    /// Evaluates many footprints on all threads; the order and the bits do not depend on their number.
    #[must_use]
    pub fn thresholds(&self, footprints: &[Footprint<f64>]) -> Vec<f64> {
        footprints.par_iter().with_min_len(1024).map(&self.threshold).collect()
    }

    /// Evaluates the value before Eq. 2 of many footprints; `None` for a subject that does not tell it.
    #[must_use]
    pub fn interpolated(&self, footprints: &[Footprint<f64>]) -> Option<Vec<f64>> {
        let interpolated = self.interpolated.as_ref()?;
        Some(footprints.par_iter().with_min_len(1024).map(interpolated).collect())
    }

    /// Returns the scales, cells and weight that the listing which the subject follows has at a footprint, computed in
    /// the subject's precision.
    #[must_use]
    pub fn nominal(&self, footprint: &Footprint<f64>) -> TwoScale<f64> {
        match self.precision {
            Precision::F32 => {
                widen(&self.variant.two_scale::<f32>(&footprint.cast(), f32::from_f64(self.hash_scale)))
            }
            Precision::F64 => self.variant.two_scale(footprint, self.hash_scale),
        }
    }
}

/// The two values of a trace that a subject tells.
struct Parts {
    threshold: f64,
    interpolated: f64,
}

impl Parts {
    fn new<R: Real>(trace: &Trace<R>) -> Self {
        Self { threshold: trace.threshold.to_f64(), interpolated: trace.interpolated.to_f64() }
    }
}

fn widen(found: &TwoScale<f32>) -> TwoScale<f64> {
    let cell = |cell: Cell<f32>| Cell { index: cell.index.as_dvec3(), octave: cell.octave };
    TwoScale {
        max_derivative: found.max_derivative.map(f64::from),
        pixel_scale: found.pixel_scale.map(f64::from),
        octave: found.octave,
        floor_cell: cell(found.floor_cell),
        ceil_cell: cell(found.ceil_cell),
        lerp_factor: f64::from(found.lerp_factor),
    }
}
