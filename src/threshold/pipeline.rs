//! From a fragment to its thresholds: a source, and the stages after it in their order.
//!
//! One description for all who compute thresholds: this file one at a time and over columns, `shader::assemble` as text,
//! `render` over the fragments of a scene, `cost` for the price list.

use super::batch::{Batch, Columns, Lane, Tier};
use super::cdf::CdfForm;
use super::footprint::Footprint;
use super::hash::{HashKind, pcg4d::pcg4d};
use super::hashed::HashedAlpha;
use super::model::Model;
use super::real::Real;
use super::robust::Robust;
use super::stage::clamp::clamp_last;
use super::stage::stipple::{self, Density};
use super::stochastic::stochastic;
use super::two_scale::Variant;
use core::num::NonZeroU32;

pub use super::stage::coverage::{SamplePattern, SampleStrata};
pub use super::stage::fade_in::FadeIn;
pub use super::stage::independent::{Independence, IndependentBy};
pub use super::stage::order::FrameStrata;
pub use super::stage::screen_door::ScreenDoor;

/// Where the threshold of a fragment comes from, and what becomes of it. Stages act in the order of the fields; what is
/// `None` does nothing, and `form` is that of all of them.
///
/// ```
/// use hashed_alpha::threshold::pipeline::{FadeIn, Inputs, Pipeline};
/// use hashed_alpha::threshold::{footprint::Footprint, two_scale::Variant};
///
/// let pipeline = Pipeline { fade_in: Some(FadeIn::default()), ..Pipeline::robust(Variant::Anisotropic) };
/// let footprint = Footprint::<f32> {
///     position: glam::vec3(0.3, 0.4, 0.5),
///     dpdx: glam::vec3(0.1, 0.0, 0.0),
///     dpdy: glam::vec3(0.0, 0.1, 0.0),
/// };
/// let near = Inputs { lod: -1.0, ..Inputs::from(footprint) };
/// assert_eq!(pipeline.threshold(&near, 0, &mut || 0), 0.5);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pipeline {
    /// Where the threshold comes from.
    pub source: Source,
    /// Frames with hashes of their own; for sources that hash.
    pub independence: Option<Independence>,
    /// The threshold divided among frames.
    pub frame_strata: Option<FrameStrata>,
    /// Several thresholds in one fragment.
    pub sample_strata: Option<SampleStrata>,
    /// Noise that fades in.
    pub fade_in: Option<FadeIn>,
    /// Literal: every stage to the letter, and no clamp after it. Stable: without their holes, and with the clamp to
    /// [2^-24, 1] last, for all sources but [`Source::Fixed`], [`Source::Stipple`] and [`Source::Given`].
    pub form: CdfForm,
}

/// Where the threshold of a fragment comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Source {
    /// One for all fragments; 1/2 is the traditional alpha test (§1).
    Fixed(f32),
    /// Found by the caller, as one for each level of detail is (§3, Eq. 1).
    Given,
    /// A fresh random number in every fragment and frame (§4).
    Stochastic,
    /// A hash of the place on the surface (§5, §6).
    Hash(Model),
    /// A mask over tiles of pixels (§3, §8.1).
    ScreenDoor(ScreenDoor),
    /// One for all fragments, `kept`, but for pixels that only opaque ones show (Ols 2009).
    Stipple {
        /// How much of a surface is kept.
        density: Density,
        /// The threshold of the others, in (0, 1].
        kept: f32,
    },
}

macro_rules! from_source {
    ($($from:ty => |$it:ident| $source:expr;)*) => {$(
        /// The source alone, in the form that it has itself.
        impl From<$from> for Pipeline {
            fn from($it: $from) -> Self {
                Self::of($source)
            }
        }
    )*};
}

from_source! {
    Source => |source| source;
    Model => |model| Source::Hash(model);
    HashedAlpha => |hashed| Source::Hash(Model::Hashed(hashed));
    Robust => |robust| Source::Hash(Model::Robust(robust));
}

impl Default for Pipeline {
    /// The recommended threshold, [`Robust::default`].
    fn default() -> Self {
        Robust::default().into()
    }
}

/// What a pipeline reads of one fragment; what it does not read is of no account.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs<R: Real> {
    /// Position on the surface and its screen derivatives.
    pub footprint: Footprint<R>,
    /// Column and row of the pixel.
    pub pixel: [u32; 2],
    /// Index of the frame.
    pub frame: u32,
    /// Index of the surface along the line of sight, or any word that tells overlapping surfaces apart.
    pub layer: u32,
    /// Level of detail of the texture, log2 of texels per pixel.
    pub lod: R,
    /// Lengths of the texture coordinate's changes along screen x and y, in texels per pixel.
    pub texel: [R; 2],
    /// The threshold of [`Source::Given`].
    pub given: R,
}

/// All else is zero, and the derivatives of the texture coordinate are of one length.
impl<R: Real> From<Footprint<R>> for Inputs<R> {
    fn from(footprint: Footprint<R>) -> Self {
        let [zero, one] = [0.0, 1.0].map(R::from_f64);
        Self { footprint, pixel: [0; 2], frame: 0, layer: 0, lod: zero, texel: [one; 2], given: zero }
    }
}

/// The same of many fragments of one frame, column by column. A column that the pipeline does not read ([`Reads`]) may be
/// empty; the others are as long as there are fragments.
#[derive(Clone, Copy, Debug)]
pub struct InputColumns<'a, R> {
    /// Positions and screen derivatives.
    pub footprint: Columns<'a, R>,
    /// Column and row of each pixel.
    pub pixel: &'a [[u32; 2]],
    /// Index of the frame of all.
    pub frame: u32,
    /// Index of each surface along its line of sight.
    pub layer: &'a [u32],
    /// Levels of detail.
    pub lod: &'a [R],
    /// Lengths of the texture coordinates' changes.
    pub texel: &'a [[R; 2]],
    /// Thresholds of [`Source::Given`].
    pub given: &'a [R],
}

/// Which [`Inputs`] a pipeline reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reads {
    /// Position and screen derivatives.
    pub footprint: bool,
    /// The pixel.
    pub pixel: bool,
    /// The frame.
    pub frame: bool,
    /// The layer.
    pub layer: bool,
    /// The level of detail.
    pub lod: bool,
    /// The lengths of the texture coordinate's changes.
    pub texel: bool,
    /// The threshold of the caller.
    pub given: bool,
    /// Random words.
    pub random: bool,
}

impl Pipeline {
    /// A source without stages; to the letter where it is a listing to the letter, and stochastic.
    #[must_use]
    pub const fn of(source: Source) -> Self {
        let form = match source {
            Source::Hash(Model::Hashed(hashed) | Model::BeforeCdf(hashed)) => hashed.form,
            Source::Hash(Model::Robust(_))
            | Source::Fixed(_)
            | Source::Given
            | Source::ScreenDoor(_)
            | Source::Stipple { .. } => CdfForm::Stable,
            Source::Stochastic => CdfForm::Literal,
        };
        Self { source, independence: None, frame_strata: None, sample_strata: None, fade_in: None, form }
    }

    /// The paper's threshold to the letter.
    #[must_use]
    pub const fn listing(variant: Variant) -> Self {
        let listing = HashedAlpha { variant, hash: HashKind::Sine, hash_scale: 1.0, form: CdfForm::Literal };
        Self::of(Source::Hash(Model::Hashed(listing)))
    }

    /// The threshold with every repair, [`Robust::new`].
    #[must_use]
    pub const fn robust(variant: Variant) -> Self {
        Self::of(Source::Hash(Model::Robust(Robust::new(variant))))
    }

    /// The same with another hash in place of that of its source, if it has one.
    #[must_use]
    pub const fn with_hash(self, hash: HashKind) -> Self {
        let model = match self.source {
            Source::Hash(Model::Hashed(hashed)) => Model::Hashed(HashedAlpha { hash, ..hashed }),
            Source::Hash(Model::BeforeCdf(hashed)) => Model::BeforeCdf(HashedAlpha { hash, ..hashed }),
            Source::Hash(Model::Robust(robust)) => Model::Robust(Robust { hash, ..robust }),
            Source::Fixed(_) | Source::Given | Source::Stochastic | Source::ScreenDoor(_) => return self,
            Source::Stipple { .. } => return self,
        };
        Self { source: Source::Hash(model), ..self }
    }

    /// Returns the threshold of a sample of a fragment. `random` draws a fresh word; it is called by [`Source::Stochastic`]
    /// and [`SamplePattern::Independent`] alone.
    ///
    /// In [2^-24, 1] where [`form`](Self::form) is stable, but for the sources named there, and NaN where the source has no
    /// threshold: a listing, or a robust one without a finite footprint or with a hash scale that is no size.
    #[must_use]
    pub fn threshold<R: Real>(&self, inputs: &Inputs<R>, sample: u32, random: &mut impl FnMut() -> u32) -> R {
        let mut out = [R::from_f64(0.5)];
        if self.uses_source() {
            out = [self.in_frame(self.of_source(inputs, random), inputs.frame)];
        }
        if let Some(strata) = self.sample_strata {
            let words = || fragment_words(inputs.pixel, self.frame_in_cycle(inputs.frame), inputs.layer);
            strata.thresholds(self.form, inputs.pixel, words, random, sample, &mut out);
        }
        self.finish(&mut out, || (inputs.lod, inputs.texel));
        out[0]
    }

    /// Writes the thresholds of all samples of all fragments: those of a fragment side by side, [`Self::samples`] of them.
    ///
    /// The bits of [`Self::threshold`] where `tier` is exact. `random` is called in the order of the fragments, first by the
    /// source for all of them.
    ///
    /// # Panics
    ///
    /// If `out` does not hold that many thresholds for each fragment, or a column that is read is of another length.
    pub fn thresholds<R: Lane>(
        &self,
        tier: Tier,
        inputs: &InputColumns<'_, R>,
        random: &mut impl FnMut() -> u32,
        out: &mut [R],
    ) {
        let samples = self.samples().get() as usize;
        let fragments = out.len() / samples;
        assert!(
            out.len().is_multiple_of(samples),
            "{} thresholds for {samples} samples a fragment",
            out.len()
        );
        inputs.expect_length(fragments, self.reads());
        if self.uses_source() {
            let chi = &mut out[..fragments];
            self.columns_of_source(tier, inputs, random, chi);
            if self.frame_strata.is_some() {
                chi.iter_mut().for_each(|chi| *chi = self.in_frame(*chi, inputs.frame));
            }
        }
        if let Some(strata) = self.sample_strata {
            // From the last to the first, so that none is overwritten before it is moved.
            (0..fragments).rev().for_each(|at| out[at * samples] = out[at]);
            let (reads_pixel, frame) = (self.reads().pixel, self.frame_in_cycle(inputs.frame));
            for (at, out) in out.chunks_exact_mut(samples).enumerate() {
                let pixel = if reads_pixel { inputs.pixel[at] } else { [0; 2] };
                let words = || fragment_words(pixel, frame, inputs.layer[at]);
                strata.thresholds(self.form, pixel, words, random, 0, out);
            }
        }
        if let Some(fade_in) = self.fade_in {
            let texel = |at| if fade_in.anisotropy { inputs.texel[at] } else { [R::from_f64(1.0); 2] };
            for (at, out) in out.chunks_exact_mut(samples).enumerate() {
                self.finish(out, || (inputs.lod[at], texel(at)));
            }
        } else if self.clamps() {
            out.iter_mut().for_each(|threshold| *threshold = clamp_last(*threshold));
        }
    }

    fn of_source<R: Real>(&self, inputs: &Inputs<R>, random: &mut impl FnMut() -> u32) -> R {
        match self.source {
            Source::Fixed(threshold) => R::from_f64(f64::from(threshold)),
            Source::Given => inputs.given,
            Source::Stochastic => stochastic(random()),
            Source::Hash(model) => self.hashed(model, &inputs.footprint, inputs.frame),
            Source::ScreenDoor(door) => door.threshold(inputs.pixel, inputs.layer),
            Source::Stipple { density, kept } => {
                stipple::threshold(density, inputs.pixel, R::from_f64(f64::from(kept)))
            }
        }
    }

    fn columns_of_source<R: Lane>(
        &self,
        tier: Tier,
        inputs: &InputColumns<'_, R>,
        random: &mut impl FnMut() -> u32,
        out: &mut [R],
    ) {
        match self.source {
            Source::Fixed(threshold) => out.fill(R::from_f64(f64::from(threshold))),
            Source::Given => out.copy_from_slice(inputs.given),
            Source::Stochastic => out.fill_with(|| stochastic(random())),
            // Batches know the hashes of the catalogue only.
            Source::Hash(model) if self.independence.is_some() => {
                for (at, threshold) in out.iter_mut().enumerate() {
                    *threshold = self.hashed(model, &inputs.footprint.footprint(at), inputs.frame);
                }
            }
            Source::Hash(model) => Batch { tier, ..Batch::new(model) }.thresholds(&inputs.footprint, out),
            Source::ScreenDoor(door) => door.thresholds(inputs.pixel, inputs.layer, out),
            Source::Stipple { density, kept } => {
                let kept = R::from_f64(f64::from(kept));
                for (at, threshold) in out.iter_mut().enumerate() {
                    *threshold = stipple::threshold(density, inputs.pixel[at], kept);
                }
            }
        }
    }

    fn hashed<R: Real>(&self, model: Model, footprint: &Footprint<R>, frame: u32) -> R {
        match self.independence {
            None => model.threshold(footprint),
            Some(independence) => independence.threshold(model, footprint, frame),
        }
    }

    fn in_frame<R: Real>(&self, chi: R, frame: u32) -> R {
        self.frame_strata.map_or(chi, |strata| strata.threshold(self.form, chi, frame))
    }

    /// Fading, and the clamp that is last; `place` is level of detail and lengths.
    fn finish<R: Real>(&self, thresholds: &mut [R], place: impl FnOnce() -> (R, [R; 2])) {
        if let Some(fade_in) = self.fade_in {
            let (lod, texel) = place();
            let share = fade_in.share(self.form, lod, texel);
            thresholds.iter_mut().for_each(|t| *t = fade_in.threshold(self.form, *t, share));
        }
        if self.clamps() {
            thresholds.iter_mut().for_each(|t| *t = clamp_last(*t));
        }
    }

    /// Whether the clamp has something left to do: stable stages end with it.
    pub(crate) fn clamps(&self) -> bool {
        let is_fresh = self.sample_strata.is_some_and(|strata| strata.pattern == SamplePattern::Independent);
        let is_kept = matches!(self.source, Source::Fixed(_) | Source::Stipple { .. } | Source::Given);
        let is_clamped = self.fade_in.is_some()
            || match self.sample_strata {
                Some(_) => !is_fresh,
                None => self.frame_strata.is_some(),
            };
        self.form == CdfForm::Stable && (is_fresh || !is_kept) && !is_clamped
    }

    /// Whether anything comes of the source: the samples of some patterns have thresholds without it.
    #[must_use]
    pub fn uses_source(&self) -> bool {
        self.sample_strata.is_none_or(|strata| strata.pattern.uses_source())
    }

    /// The frames with hashes of their own, if there is a hash.
    fn independence_of_hash(&self) -> Option<Independence> {
        self.independence.filter(|_| self.uses_source() && matches!(self.source, Source::Hash(_)))
    }

    /// Returns what is read of a fragment.
    #[must_use]
    pub fn reads(&self) -> Reads {
        let source = self.uses_source();
        let pattern = self.sample_strata.map(|strata| strata.pattern);
        let permuted = pattern.is_some_and(SamplePattern::is_permuted);
        let is = |matches: bool| source && matches;
        let door = is(matches!(self.source, Source::ScreenDoor(_) | Source::Stipple { .. }));
        let stochastic = is(self.source == Source::Stochastic);
        Reads {
            footprint: is(matches!(self.source, Source::Hash(_))),
            pixel: door || permuted || pattern == Some(SamplePattern::ByPixel),
            frame: is(self.frame_strata.is_some() || self.independence_of_hash().is_some())
                || (stochastic && permuted),
            layer: permuted || is(self.source == Source::ScreenDoor(ScreenDoor::Randomised)),
            lod: self.fade_in.is_some(),
            texel: self.fade_in.is_some_and(|fade_in| fade_in.anisotropy),
            given: is(self.source == Source::Given),
            random: stochastic || pattern == Some(SamplePattern::Independent),
        }
    }

    /// Returns the number of thresholds of a fragment, which is that of its tests.
    #[must_use]
    pub fn samples(&self) -> NonZeroU32 {
        self.sample_strata.map_or(NonZeroU32::MIN, |strata| strata.samples)
    }

    /// Returns the number of hashes that the thresholds of one fragment take.
    #[must_use]
    pub fn hashes(&self) -> u64 {
        let source = match self.source {
            _ if !self.uses_source() => 0,
            Source::Hash(model) => model.hashes(),
            Source::ScreenDoor(door) => door.hashes(),
            Source::Fixed(_) | Source::Given | Source::Stochastic | Source::Stipple { .. } => 0,
        };
        source + self.sample_strata.map_or(0, |strata| strata.pattern.hashes())
    }

    /// Returns the number of random numbers that the thresholds of one fragment take.
    #[must_use]
    pub fn randoms(&self) -> u64 {
        let of_source = u64::from(self.uses_source() && self.source == Source::Stochastic);
        let is_independent =
            self.sample_strata.is_some_and(|strata| strata.pattern == SamplePattern::Independent);
        // The first of them is the one of the source.
        of_source + if is_independent { u64::from(self.samples().get() - 1) } else { 0 }
    }

    /// The index of a frame among those that thresholds repeat after.
    fn frame_in_cycle(&self, frame: u32) -> u32 {
        self.cycle().map_or(frame, |frames| (u64::from(frame) % frames) as u32)
    }

    /// Returns the number of frames after which the thresholds of a still scene repeat; `None` where they never do.
    #[must_use]
    pub fn cycle(&self) -> Option<u64> {
        if self.randoms() > 0 {
            return None;
        }
        let strata = self.frame_strata.filter(|_| self.uses_source()).map(|strata| strata.frames);
        let hashes = self.independence_of_hash().map(|independence| independence.frames);
        let [a, b] = [strata, hashes].map(|frames| frames.map_or(1, NonZeroU32::get));
        let (mut divisor, mut rest) = (a, b);
        while rest != 0 {
            (divisor, rest) = (rest, divisor % rest);
        }
        // The least number that both divide.
        Some(u64::from(a / divisor) * u64::from(b))
    }
}

impl<R: Lane> InputColumns<'_, R> {
    /// Panics if a column that is read does not have as many entries as there are fragments.
    fn expect_length(&self, fragments: usize, reads: Reads) {
        for (what, is_read, length) in [
            ("footprints", reads.footprint, self.footprint.len()),
            ("pixels", reads.pixel, self.pixel.len()),
            ("layers", reads.layer, self.layer.len()),
            ("levels of detail", reads.lod, self.lod.len()),
            ("changes of texture coordinates", reads.texel, self.texel.len()),
            ("given thresholds", reads.given, self.given.len()),
        ] {
            assert!(!is_read || length == fragments, "{length} {what} for {fragments} fragments");
        }
    }
}

/// Four words that belong to one fragment of a frame.
#[inline(always)]
fn fragment_words([x, y]: [u32; 2], frame: u32, layer: u32) -> [u32; 4] {
    pcg4d([x, y, frame, layer])
}
