//! Anything that turns footprints into thresholds.

use crate::check::domain::Domain;
use crate::scene::Fragment;
use crate::threshold::batch::{BLOCK, Batch, ColumnBuffer, Lane, Model};
use crate::threshold::footprint::Footprint;
use crate::threshold::hash::{Hash, HashKind};
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::real::{Real, power_of_two};
use crate::threshold::robust::scales::{self, Scales};
use crate::threshold::robust::{Join, Preset, Repair, Repairs, Robust};
use crate::threshold::stage::stratify::{alternating, stratified};
use crate::threshold::two_scale::Variant;
use core::fmt;
use core::num::NonZeroU32;
use core::str::FromStr;
use glam::DVec3;
use rayon::prelude::*;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

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

/// A function of a fragment that can be asked from several threads.
type OneByOne<'a> = Box<dyn Fn(&Fragment) -> Option<f64> + Send + Sync + 'a>;

/// A function of many fragments at once, which may fail as a whole.
type AllAtOnce<'a> = Box<dyn Fn(&[Fragment]) -> Result<Vec<f64>, String> + Send + Sync + 'a>;

enum Evaluation<'a> {
    OneByOne(OneByOne<'a>),
    AllAtOnce(AllAtOnce<'a>),
    /// In vector instructions, with the bits of one by one.
    Batch(Model),
    /// That of another subject.
    Of(&'a Subject<'a>),
}

/// Fewer fragments than this are evaluated one by one: a batch fills a block of [`BLOCK`] in any case.
const WORTH_A_BATCH: usize = BLOCK / 8;

/// Fragments of which a thread evaluates a batch.
const BATCH: usize = 16 * BLOCK;

/// The same threshold with a noise so many times as large, for many fragments at once.
type Rescaled<'a> = Box<dyn Fn(f64, &[Fragment]) -> Result<Vec<f64>, String> + Send + Sync + 'a>;

/// What a subject has to say of itself.
type Remarks<'a> = Box<dyn Fn() -> Vec<String> + Send + Sync + 'a>;

/// What the threshold of a point does from frame to frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Frames {
    /// It stays what it is.
    #[default]
    Static,
    /// It goes through as many strata, beginning with stratum 0 in frame 0 (Eq. 6), and begins again.
    Strata(NonZeroU32),
    /// It goes through the frames by steps that all points have in common, as fract(threshold + frame * 0.618034) does, and that
    /// fill the unit interval evenly. Not in the paper.
    Sequence,
}

impl Frames {
    /// Returns the frame that is `times` periods after the first one, or as many as can be counted; the first one where there is no
    /// period.
    #[must_use]
    pub fn period_start(self, times: u32) -> u32 {
        match self {
            Self::Static => times,
            Self::Strata(n) => times.min(u32::MAX / n) * n.get(),
            Self::Sequence => 0,
        }
    }

    /// Returns the last frame up to `frame` in which the threshold is that of frame 0.
    #[must_use]
    pub fn first_again(self, frame: u32) -> u32 {
        match self {
            Self::Static => frame,
            Self::Strata(n) => frame - frame % n,
            Self::Sequence => 0,
        }
    }
}

impl fmt::Display for Frames {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Static => f.write_str("static"),
            Self::Strata(n) => write!(f, "{n} strata"),
            Self::Sequence => f.write_str("a sequence"),
        }
    }
}

impl FromStr for Frames {
    type Err = String;

    /// Reads a number of strata, 1 to 1024, or the word `sequence`; one stratum is [`Frames::Static`].
    ///
    /// # Errors
    ///
    /// For everything else, in words that say what is asked for.
    fn from_str(typed: &str) -> Result<Self, String> {
        if typed == "sequence" {
            return Ok(Self::Sequence);
        }
        match typed.parse().map(NonZeroU32::new) {
            Ok(Some(NonZeroU32::MIN)) => Ok(Self::Static),
            Ok(Some(n)) if n.get() <= MOST_STRATA => Ok(Self::Strata(n)),
            Ok(_) | Err(_) => Err(format!("a number of frames, 1 to {MOST_STRATA}, or the word sequence")),
        }
    }
}

/// Most strata that a shader file may claim.
const MOST_STRATA: u32 = 1024;

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
    /// What it claims of its thresholds in other frames.
    pub frames: Frames,
    /// Whether it is the hash of one cell and no more: no second octave, no join, no Eq. 2. Claims about those say nothing
    /// about it.
    pub bare_hash: bool,
    threshold: Evaluation<'a>,
    interpolated: Option<OneByOne<'a>>,
    rescaled: Option<Rescaled<'a>>,
    /// What it is asked for, where somebody wants to know.
    asked: Option<Arc<Mutex<Domain>>>,
    failure: OnceLock<String>,
    remarks: Option<Remarks<'a>>,
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

impl Nominal {
    /// The cell that holds the coarse one, an octave above, where one octave is that of all axes.
    pub(crate) fn parent(&self, nested_phase: bool) -> DVec3 {
        parent(self.coarse_cell, libm::ilogb(self.coarse_scale[0]), nested_phase)
    }
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
    /// use hashed_alpha::threshold::{names::listing_1_f32, two_scale::Variant};
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
        Self::of_fragments(name, precision, variant, move |fragment| threshold(&fragment.footprint))
    }

    /// Puts an `f32` function on trial, as [`Subject::new`] does.
    #[must_use]
    pub fn of_f32(
        name: impl Into<String>,
        variant: Variant,
        threshold: impl Fn(&Footprint<f32>) -> f32 + Send + Sync + 'a,
    ) -> Self {
        Self::new(name, Precision::F32, variant, move |footprint| f64::from(threshold(&footprint.cast())))
    }

    /// Puts a function on trial that reads more of a fragment than its footprint, as [`Subject::new`] does.
    #[must_use]
    pub fn of_fragments<T: Into<Option<f64>>>(
        name: impl Into<String>,
        precision: Precision,
        variant: Variant,
        threshold: impl Fn(&Fragment) -> T + Send + Sync + 'a,
    ) -> Self {
        let evaluation = Evaluation::OneByOne(Box::new(move |fragment| threshold(fragment).into()));
        Self::evaluated_by(name.into(), precision, variant, evaluation)
    }

    /// Adds what the subject has before Eq. 2, so that claims can look at both.
    #[must_use]
    pub fn with_interpolated<T: Into<Option<f64>>>(
        self,
        interpolated: impl Fn(&Fragment) -> T + Send + Sync + 'a,
    ) -> Self {
        let interpolated = move |fragment: &Fragment| interpolated(fragment).into();
        Self { interpolated: Some(Box::new(interpolated)), ..self }
    }

    /// Puts a function of many fragments on trial, as [`Subject::new`] does: one threshold a fragment, NaN where it refuses
    /// one.
    ///
    /// An error is a subject that could not be run; every claim that it meets ends without a verdict.
    #[must_use]
    pub fn batched(
        name: impl Into<String>,
        precision: Precision,
        variant: Variant,
        thresholds: impl Fn(&[Fragment]) -> Result<Vec<f64>, String> + Send + Sync + 'a,
    ) -> Self {
        Self::evaluated_by(name.into(), precision, variant, Evaluation::AllAtOnce(Box::new(thresholds)))
    }

    fn evaluated_by(name: String, precision: Precision, variant: Variant, threshold: Evaluation<'a>) -> Self {
        Self {
            name,
            precision,
            variant,
            join: Join::Interpolate,
            nested_phase: false,
            hash_scale: 1.0,
            frames: Frames::Static,
            bare_hash: false,
            threshold,
            interpolated: None,
            rescaled: None,
            asked: None,
            failure: OnceLock::new(),
            remarks: None,
        }
    }

    /// Adds how the subject is at other hash scales, so that claims try it at several: the function is given a factor to the
    /// subject's own hash scale and fragments, and returns what that of [`Subject::batched`] does.
    ///
    /// Without it only [`Subject::hash_scale`] is tried. The subjects of this crate have it, and shader files with a parameter
    /// `hash_scale`.
    #[must_use]
    pub fn with_hash_scales(
        self,
        rescaled: impl Fn(f64, &[Fragment]) -> Result<Vec<f64>, String> + Send + Sync + 'a,
    ) -> Self {
        Self { rescaled: Some(Box::new(rescaled)), ..self }
    }

    /// Returns the same threshold with a noise of so many pixels; nothing where the subject has no such parameter.
    #[must_use]
    pub fn at_hash_scale(&self, hash_scale: f64) -> Option<Subject<'_>> {
        let rescaled = match &self.threshold {
            Evaluation::Of(subject) => subject.rescaled.as_ref()?,
            Evaluation::OneByOne(_) | Evaluation::AllAtOnce(_) | Evaluation::Batch(_) => {
                self.rescaled.as_ref()?
            }
        };
        let thresholds = move |fragments: &[Fragment]| {
            let found = rescaled(hash_scale / self.hash_scale, fragments);
            found.inspect_err(|reason| {
                self.failure.get_or_init(|| reason.clone());
            })
        };
        let evaluation = Evaluation::AllAtOnce(Box::new(thresholds));
        Some(Subject { hash_scale, ..self.like(evaluation, self.asked.clone()) })
    }

    /// A subject that claims what this one does.
    fn like<'b>(&self, threshold: Evaluation<'b>, asked: Option<Arc<Mutex<Domain>>>) -> Subject<'b> {
        Subject {
            join: self.join,
            nested_phase: self.nested_phase,
            hash_scale: self.hash_scale,
            frames: self.frames,
            bare_hash: self.bare_hash,
            asked,
            ..Subject::evaluated_by(self.name.clone(), self.precision, self.variant, threshold)
        }
    }

    /// Returns a view of the subject that answers as it does and keeps what it is asked for ([`Subject::domain`]).
    pub(crate) fn observed(&self) -> Subject<'_> {
        self.like(Evaluation::Of(self), Some(Arc::default()))
    }

    /// Returns what an observed subject was asked for so far; nothing for any other.
    pub(crate) fn domain(&self) -> Domain {
        let asked =
            self.asked.as_ref().map(|asked| asked.lock().unwrap_or_else(PoisonError::into_inner).clone());
        asked.unwrap_or_default()
    }

    /// Asks an observed subject for what is no sample of a claim.
    pub(crate) fn unnoticed<T>(&self, ask: impl FnOnce() -> T) -> T {
        let before = self.domain();
        let answer = ask();
        if let Some(asked) = &self.asked {
            *asked.lock().unwrap_or_else(PoisonError::into_inner) = before;
        }
        answer
    }

    fn note<F: Copy + Into<Fragment> + Sync>(&self, fragments: &[F]) {
        if let Some(asked) = &self.asked {
            let mut domain = Domain::default();
            domain.add_all(fragments, self.hash_scale);
            asked.lock().unwrap_or_else(PoisonError::into_inner).extend(&domain);
        }
    }

    /// Adds what the subject has to say of itself when it has run ([`Subject::remarks`]).
    #[must_use]
    pub fn with_remarks(self, remarks: impl Fn() -> Vec<String> + Send + Sync + 'a) -> Self {
        Self { remarks: Some(Box::new(remarks)), ..self }
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
            interpolated: Some(Box::new(move |fragment| Some(evaluate(&fragment.footprint).1))),
            ..Self::new(name, precision, hashed.variant, move |footprint| evaluate(footprint).0)
        }
        .with_hash_scales(move |times, fragments| {
            let hash_scale = hashed.hash_scale * times;
            Ok(Self::hashed("", precision, HashedAlpha { hash_scale, ..hashed }).thresholds(fragments))
        })
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
        let interpolated: Option<OneByOne<'a>> = (robust.join == Join::Interpolate)
            .then(|| Box::new(move |fragment: &Fragment| Some(evaluate(&fragment.footprint)?.1)) as _);
        Self {
            hash_scale: robust.hash_scale,
            join: robust.join,
            nested_phase: robust.repairs.contains(Repair::NestedPhase),
            interpolated,
            ..Self::new(name, precision, robust.variant, move |footprint| Some(evaluate(footprint)?.0))
        }
        .with_hash_scales(move |times, fragments| {
            let hash_scale = robust.hash_scale * times;
            Ok(Self::robust("", precision, Robust { hash_scale, ..robust }).thresholds(fragments))
        })
    }

    /// Puts a threshold on trial whose hash was chosen by name, as [`Subject::hashed`] and [`Subject::robust`] do with the
    /// same bits, in vector instructions: checking it takes longer than evaluating it.
    #[must_use]
    pub fn of_model(name: impl Into<String>, precision: Precision, model: impl Into<Model>) -> Self {
        let model = model.into();
        let described = match model {
            Model::Hashed(hashed) => Self::hashed(name, precision, hashed),
            Model::BeforeCdf(hashed) => Self { interpolated: None, ..Self::hashed(name, precision, hashed) },
            Model::Robust(robust) => Self::robust(name, precision, robust),
        };
        let own = described.hash_scale;
        let rescaled = move |times: f64, fragments: &[Fragment]| {
            Ok(evaluated_in_batches(precision, model.with_hash_scale(own * times), fragments))
        };
        Self { threshold: Evaluation::Batch(model), ..described }.with_hash_scales(rescaled)
    }

    /// Puts a hash on trial alone: its threshold is the hash of [the coarse cell](scales::only_cell), wherever the footprint
    /// lies between two octaves.
    ///
    /// ```
    /// use hashed_alpha::check::{Subject, subject::Precision};
    /// use hashed_alpha::threshold::hash::HashKind;
    ///
    /// assert!(Subject::of_hash("hash:mm4", Precision::F32, HashKind::Mm4).bare_hash);
    /// ```
    #[must_use]
    pub fn of_hash<H>(name: impl Into<String>, precision: Precision, hash: H) -> Self
    where
        H: Hash<f32> + Hash<f64> + Copy + Send + 'a,
    {
        let value = move |footprint: &Footprint<f64>| match precision {
            Precision::F32 => hash.hash(&scales::only_cell::<f32>(&footprint.cast())).to_f64(),
            Precision::F64 => hash.hash(&scales::only_cell(footprint)),
        };
        Self { bare_hash: true, ..Self::new(name, precision, Variant::Isotropic, value) }
    }

    /// Spreads the thresholds over `n` frames: frame i has stratum i of the alternating order, each of width 1 / n. Eq. 6
    /// with the clamp after it, §7.2.3.
    ///
    /// The value before Eq. 2 stays that of the first frame.
    #[must_use]
    pub fn stratified(self, n: NonZeroU32) -> Self {
        let precision = self.precision;
        let spread = move |chi: f64, frame: u32| match precision {
            Precision::F32 => stratified(chi as f32, alternating(frame, n), n).to_f64(),
            Precision::F64 => stratified(chi, alternating(frame, n), n),
        };
        let first = |fragment: &Fragment| Fragment { frame: 0, ..*fragment };
        let all_first = move |fragments: &[Fragment]| fragments.iter().map(first).collect::<Vec<_>>();
        let spread_all = move |chis: Vec<f64>, fragments: &[Fragment]| -> Vec<f64> {
            chis.into_iter().zip(fragments).map(|(chi, fragment)| spread(chi, fragment.frame)).collect()
        };
        let threshold = match self.threshold {
            Evaluation::OneByOne(threshold) => Evaluation::OneByOne(Box::new(move |fragment| {
                threshold(&first(fragment)).map(|chi| spread(chi, fragment.frame))
            })),
            Evaluation::AllAtOnce(thresholds) => Evaluation::AllAtOnce(Box::new(move |fragments| {
                Ok(spread_all(thresholds(&all_first(fragments))?, fragments))
            })),
            Evaluation::Of(subject) => Evaluation::AllAtOnce(Box::new(move |fragments| {
                Ok(spread_all(subject.thresholds(&all_first(fragments)), fragments))
            })),
            Evaluation::Batch(model) => Evaluation::AllAtOnce(Box::new(move |fragments| {
                Ok(spread_all(evaluated_in_batches(precision, model, fragments), fragments))
            })),
        };
        let rescaled = self.rescaled.map(|rescaled| -> Rescaled<'a> {
            Box::new(move |times, fragments| {
                Ok(spread_all(rescaled(times, &all_first(fragments))?, fragments))
            })
        });
        Self {
            name: format!("{}, {n} frames", self.name),
            frames: Frames::Strata(n),
            threshold,
            rescaled,
            ..self
        }
    }

    /// The paper's Listings 1 and 2 to the letter, in both precisions.
    #[must_use]
    pub fn paper() -> Vec<Self> {
        Self::both_variants("paper", |name, precision, variant| {
            let HashedAlpha { variant, hash_scale, form, .. } = HashedAlpha::listing(variant);
            Self::of_model(name, precision, HashedAlpha { hash: HashKind::Sine, variant, hash_scale, form })
        })
    }

    /// The robust threshold with every repair, in both variants and precisions.
    #[must_use]
    pub fn all_repairs() -> Vec<Self> {
        Self::both_variants("robust", |name, precision, variant| {
            Self::of_model(name, precision, Robust::new(variant))
        })
    }

    /// The recommended threshold, in both presets and precisions: `recommended:steady` and `recommended:smooth`.
    #[must_use]
    pub fn recommended() -> Vec<Self> {
        let of = |preset: Preset| {
            Precision::ALL.map(|precision| {
                Self::of_model(format!("recommended:{preset}"), precision, Robust::recommended(preset))
            })
        };
        Preset::ALL.into_iter().flat_map(of).collect()
    }

    /// Whether cells of one octave know of each other, as the children of one parent do.
    #[must_use]
    pub fn has_kin(&self) -> bool {
        self.join == Join::Inherit && self.variant != Variant::Anisotropic
    }

    /// The same with a join of octaves that is named.
    #[must_use]
    pub fn all_repairs_by(join: Join) -> Vec<Self> {
        Self::both_variants("robust", |name, precision, variant| {
            Self::of_model(format!("{name}:{join}"), precision, Robust { join, ..Robust::new(variant) })
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

    /// Evaluates one fragment, whose footprint must be exact in the subject's precision (see [`Precision::round`]);
    /// `None` where the subject refuses it or could not be run.
    #[must_use]
    pub fn threshold(&self, fragment: impl Into<Fragment>) -> Option<f64> {
        let fragment = fragment.into();
        self.note(&[fragment]);
        match &self.threshold {
            Evaluation::Of(subject) => subject.threshold(fragment),
            Evaluation::OneByOne(threshold) => threshold(&fragment),
            Evaluation::Batch(model) => {
                let value = model_threshold(self.precision, model, &fragment.footprint);
                // A listing answers NaN; the robust threshold refuses.
                (!value.is_nan() || !matches!(model, Model::Robust(_))).then_some(value)
            }
            Evaluation::AllAtOnce(_) => self.thresholds(&[fragment]).first().copied().filter(|t| !t.is_nan()),
        }
    }

    /// Evaluates many fragments or footprints on all threads, NaN where the subject refuses one; the order and the bits do
    /// not depend on the number of threads.
    ///
    /// Where the subject could not be run ([`Subject::failure`]) all are NaN.
    #[must_use]
    pub fn thresholds<F: Copy + Into<Fragment> + Sync>(&self, fragments: &[F]) -> Vec<f64> {
        self.note(fragments);
        match &self.threshold {
            Evaluation::Of(subject) => subject.thresholds(fragments),
            Evaluation::OneByOne(threshold) => evaluated(threshold, fragments),
            &Evaluation::Batch(model) => evaluated_in_batches(self.precision, model, fragments),
            // What has failed is not run again: it may have taken its time.
            Evaluation::AllAtOnce(_) if self.failure().is_some() => vec![f64::NAN; fragments.len()],
            Evaluation::AllAtOnce(thresholds) => {
                let fragments: Vec<Fragment> = fragments.iter().map(|&fragment| fragment.into()).collect();
                thresholds(&fragments).unwrap_or_else(|reason| {
                    self.failure.get_or_init(|| reason);
                    vec![f64::NAN; fragments.len()]
                })
            }
        }
    }

    /// Returns why the subject could not be run, where that came up.
    #[must_use]
    pub fn failure(&self) -> Option<&str> {
        let own = self.failure.get().map(String::as_str);
        own.or_else(|| if let Evaluation::Of(subject) = self.threshold { subject.failure() } else { None })
    }

    /// Returns what the subject has to say of itself so far: nothing that is wrong, but hardly meant.
    #[must_use]
    pub fn remarks(&self) -> Vec<String> {
        self.remarks.as_ref().map_or_else(Vec::new, |remarks| remarks())
    }

    /// Evaluates the value before Eq. 2 of many fragments or footprints; `None` for a subject that has none.
    #[must_use]
    pub fn interpolated<F: Copy + Into<Fragment> + Sync>(&self, fragments: &[F]) -> Option<Vec<f64>> {
        self.note(fragments);
        match &self.threshold {
            Evaluation::Of(subject) => subject.interpolated(fragments),
            Evaluation::OneByOne(_) | Evaluation::AllAtOnce(_) | Evaluation::Batch(_) => {
                self.interpolated.as_ref().map(|interpolated| evaluated(interpolated, fragments))
            }
        }
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
        let found: Scales<R> = scales::robust_scales(self.variant, footprint, hash_scale, Repairs::ALL);
        let grid = if self.nested_phase { Repairs::ALL } else { Repairs::ALL.without(Repair::NestedPhase) };
        let cell = |octave: [i32; 3]| {
            let index: [R; 3] = scales::nested_cell::<R>(footprint.position, octave, grid).index.into();
            DVec3::from_array(index.map(R::to_f64))
        };
        let per_unit = |octave: [i32; 3]| octave.map(power_of_two);
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

/// The parent of a cell, one octave above the cell's own.
pub(crate) fn parent(cell: DVec3, octave: i32, nested_phase: bool) -> DVec3 {
    let begin = if nested_phase && octave & 1 == 0 { 1.0 } else { 0.0 };
    ((cell + begin) * 0.5).floor()
}

fn model_threshold(precision: Precision, model: &Model, footprint: &Footprint<f64>) -> f64 {
    match precision {
        Precision::F32 => model.threshold::<f32>(&footprint.cast()).to_f64(),
        Precision::F64 => model.threshold(footprint),
    }
}

fn evaluated_in_batches<F: Copy + Into<Fragment> + Sync>(
    precision: Precision,
    model: Model,
    fragments: &[F],
) -> Vec<f64> {
    if fragments.len() < WORTH_A_BATCH {
        let one = |&fragment: &F| model_threshold(precision, &model, &fragment.into().footprint);
        return fragments.iter().map(one).collect();
    }
    let batch = Batch::new(model);
    let of_chunk = |chunk: &[F]| match precision {
        Precision::F32 => batch_thresholds::<f32, F>(&batch, chunk),
        Precision::F64 => batch_thresholds::<f64, F>(&batch, chunk),
    };
    fragments.par_chunks(BATCH).flat_map_iter(of_chunk).collect()
}

fn batch_thresholds<R: Lane, F: Copy + Into<Fragment>>(batch: &Batch, fragments: &[F]) -> Vec<f64> {
    let footprints = fragments.iter().map(|&fragment| fragment.into().footprint.cast());
    let columns: ColumnBuffer<R> = footprints.collect();
    let mut thresholds = vec![R::from_f64(0.0); fragments.len()];
    batch.thresholds(&columns.columns(), &mut thresholds);
    thresholds.into_iter().map(R::to_f64).collect()
}

fn evaluated<F: Copy + Into<Fragment> + Sync>(evaluation: &OneByOne<'_>, fragments: &[F]) -> Vec<f64> {
    let value = |&fragment: &F| evaluation(&fragment.into()).unwrap_or(f64::NAN);
    fragments.par_iter().with_min_len(1024).map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn a_batch_has_the_bits_of_one_by_one() {
        let fragments: Vec<Fragment> = Scene::all().iter().flat_map(Scene::fragments).step_by(37).collect();
        let four_frames = NonZeroU32::new(4).expect("four is not zero");
        let spread = Subject::paper().into_iter().map(|subject| subject.stratified(four_frames));
        for subject in Subject::paper().into_iter().chain(Subject::all_repairs()).chain(spread) {
            let rounded = |fragment: &Fragment| Fragment {
                footprint: subject.precision.round(&fragment.footprint),
                ..*fragment
            };
            let fragments: Vec<Fragment> = fragments.iter().map(rounded).collect();
            let few = &fragments[..WORTH_A_BATCH - 1];
            let (many, few_of_them) = (subject.thresholds(&fragments), subject.thresholds(few));
            for (i, (fragment, value)) in fragments.iter().zip(&many).enumerate() {
                let alone = subject.threshold(*fragment).unwrap_or(f64::NAN);
                let same =
                    |other: &f64| other.to_bits() == alone.to_bits() || other.is_nan() && alone.is_nan();
                assert!(same(value), "{subject:?}: {value} and not {alone} at {fragment:?}");
                assert!(few_of_them.get(i).is_none_or(same), "{subject:?}: {fragment:?}");
            }
        }
    }
}
