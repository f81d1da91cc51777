//! The threshold as WGSL text, put together out of chunks: only those that are asked for.
//!
//! Each chunk is the twin of the function of the same name in the `threshold` wing. With an integer hash the literal
//! and the robust text agree with it in all but the last bits of `log2`, roots and divisions, and of products that a device lets into
//! sums unrounded; the sine hash is stated apart where it is tested.

use crate::threshold::cdf::CdfForm;
use crate::threshold::fixed::FIXED_THRESHOLD;
use crate::threshold::hash::HashKind;
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::model::Model;
use crate::threshold::pipeline::{
    FadeIn, FrameStrata, Pipeline, SamplePattern, SampleStrata, ScreenDoor, Source,
};
use crate::threshold::robust::{Join, Repairs, Robust};
use crate::threshold::stage::order::Order;
use crate::threshold::stage::stipple::Density;
use crate::threshold::two_scale::Variant;
use core::fmt::Write as _;

/// What the text is to do.
///
/// In the text [`Source::Stochastic`] hashes pixel, frame and layer, and a robust threshold without a finite footprint, an
/// error in Rust, is the traditional 1/2.
///
/// ```
/// use hashed_alpha::shader::assemble::assemble;
/// use hashed_alpha::threshold::pipeline::Pipeline;
///
/// let text = assemble(Pipeline::default()).unwrap();
/// assert!(text.contains("fn threshold(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>) -> f32"));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ShaderOptions {
    /// Source and stages.
    pub pipeline: Pipeline,
    /// Whether the size of the noise is written into the text, or asked of who calls.
    pub hash_scale: HashScale,
}

/// Where a text has the size of the noise from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum HashScale {
    /// From the pipeline: it is written into the text.
    #[default]
    Written,
    /// From a parameter of the function.
    Parameter,
}

impl<P: Into<Pipeline>> From<P> for ShaderOptions {
    fn from(pipeline: P) -> Self {
        Self { pipeline: pipeline.into(), hash_scale: HashScale::Written }
    }
}

impl ShaderOptions {
    /// Returns the parameters of the function `threshold`, in their order.
    #[must_use]
    pub fn parameters(&self) -> Vec<Parameter> {
        let reads = self.pipeline.reads();
        let drawn = reads.random;
        let all = [
            (reads.footprint, POSITION),
            (reads.footprint, DPDX),
            (reads.footprint, DPDY),
            (reads.footprint && self.hash_scale == HashScale::Parameter, HASH_SCALE),
            (reads.pixel || drawn, PIXEL),
            (reads.frame || drawn, FRAME),
            (reads.layer || drawn, LAYER),
            (self.pipeline.sample_strata.is_some(), SAMPLE_INDEX),
            (reads.lod, LOD),
            (reads.texel, TEXEL_DX),
            (reads.texel, TEXEL_DY),
        ];
        all.into_iter().filter(|&(is_read, _)| is_read).map(|(_, parameter)| parameter).collect()
    }
}

/// A parameter of the function `threshold`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// Its type in WGSL.
    pub wgsl_type: &'static str,
    /// What it holds.
    pub meaning: &'static str,
}

macro_rules! parameters {
    ($($constant:ident = $name:literal: $type:literal, $meaning:literal;)*) => {
        $(
            #[doc = $meaning]
            pub const $constant: Parameter = Parameter { name: $name, wgsl_type: $type, meaning: $meaning };
        )*
    };
}

parameters! {
    POSITION = "position": "vec3<f32>", "position on the surface, object units";
    DPDX = "dpdx": "vec3<f32>", "its change to the next pixel on the right, object units per pixel";
    DPDY = "dpdy": "vec3<f32>", "its change to the next pixel along screen y, object units per pixel";
    HASH_SCALE = "hash_scale": "f32", "size of the noise in pixels, above 0";
    PIXEL = "pixel": "vec2<f32>", "centre of the pixel, in pixels";
    FRAME = "frame": "u32", "index of the frame";
    LAYER = "layer": "u32", "index of the surface along the line of sight";
    SAMPLE_INDEX = "sample_index": "u32", "index of the sample within the pixel";
    LOD = "lod": "f32", "level of detail of the texture, log2 of texels per pixel";
    TEXEL_DX = "texel_dx": "f32", "length of the texture coordinate's change along screen x, texels per pixel";
    TEXEL_DY = "texel_dy": "f32", "length of the texture coordinate's change along screen y, texels per pixel";
}

/// A pipeline that cannot be written as shader text.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AssembleError {
    /// A number without a meaning.
    #[error("{what} is {value}; a finite number above 0 is needed")]
    Number {
        /// Which one.
        what: &'static str,
        /// Its value.
        value: f32,
    },
    /// Something that no shader computes, or none of these texts.
    #[error("no shader text has {0}")]
    NoText(&'static str),
}

/// Returns WGSL text that ends in `fn threshold(...) -> f32` with the parameters of [`ShaderOptions::parameters`].
///
/// # Errors
///
/// [`AssembleError`]: a hash scale or level of full noise that is not a finite number above 0 in `f32`; thresholds of the
/// caller, samples of the hardware, independent frames and draws, robust thresholds without all repairs, and other authored
/// thresholds than 1/2, of which there is no text.
pub fn assemble(options: impl Into<ShaderOptions>) -> Result<String, AssembleError> {
    let options = options.into();
    let mut text = Text::default();
    let stages = text.stages(&options)?;
    text.finish(&options.parameters(), &stages);
    Ok(text.written)
}

fn positive(what: &'static str, value: f32) -> Result<f32, AssembleError> {
    if value.is_finite() && value > 0.0 { Ok(value) } else { Err(AssembleError::Number { what, value }) }
}

/// Only the traditional threshold is in the text.
fn traditional(what: &'static str, threshold: f32) -> Result<(), AssembleError> {
    let is_half = (f64::from(threshold) - FIXED_THRESHOLD).abs() < f64::EPSILON;
    if is_half { Ok(()) } else { Err(AssembleError::NoText(what)) }
}

/// Whether the last clamp changes anything of a source that nothing follows.
fn can_be_zero(source: Source) -> bool {
    match source {
        Source::Stochastic => true,
        Source::Hash(Model::Hashed(hashed)) => matches!(hashed.variant, Variant::Linear | Variant::Single),
        Source::Hash(Model::BeforeCdf(_) | Model::Robust(_)) | Source::Fixed(_) | Source::Given => false,
        Source::ScreenDoor(_) | Source::Stipple { .. } => false,
    }
}

/// Text under construction; a chunk that is asked for twice is written once.
#[derive(Default)]
struct Text {
    written: String,
    chunks: Vec<&'static str>,
}

/// Adds chunks by the path of their file below `chunk/`, without the ending.
macro_rules! add {
    ($text:expr, $($path:literal),+ $(,)?) => {
        $text.add(&[$(include_str!(concat!("chunk/", $path, ".wgsl"))),+])
    };
}

impl Text {
    fn add(&mut self, chunks: &[&'static str]) {
        for chunk in chunks {
            if !self.chunks.contains(chunk) {
                self.chunks.push(chunk);
                self.written.push_str(chunk);
                self.written.push('\n');
            }
        }
    }

    /// Adds the chunks of every stage and returns the expression of each; `value` is that of the one before.
    fn stages(&mut self, options: &ShaderOptions) -> Result<Vec<String>, AssembleError> {
        let pipeline = &options.pipeline;
        let literal = pipeline.form == CdfForm::Literal;
        let mut stages = Vec::new();
        if pipeline.uses_source() {
            self.source(options, &mut stages)?;
            if pipeline.independence.is_some() {
                return Err(AssembleError::NoText("hashes of their own for frames"));
            }
            if let Some(strata) = pipeline.frame_strata {
                stages.push(self.stratified(literal, strata));
            }
        }
        if let Some(strata) = pipeline.sample_strata {
            stages.push(self.sampled(literal, strata, options)?);
        }
        if let Some(FadeIn { authored, full_noise_lod, anisotropy }) = pipeline.fade_in {
            let full_noise_lod = positive("the level of full noise", full_noise_lod)?;
            traditional("noise that fades in from another threshold than 1/2", authored)?;
            if !literal {
                add!(self, "is_finite");
            }
            self.stable_or_literal(literal, FADE_IN);
            let form = if literal { "_literal" } else { "" };
            let mut lod = "lod".to_owned();
            if anisotropy {
                self.stable_or_literal(literal, ANISOTROPY);
                lod = format!("lod * anisotropy{form}(texel_dx, texel_dy)");
            }
            stages.push(format!("fade_in{form}(value, blend{form}({lod}, {full_noise_lod:?}f))"));
        }
        Ok(stages)
    }

    /// Adds the chunks of an order of strata and returns the expression of its threshold.
    fn stratified(&mut self, literal: bool, FrameStrata { frames: n, order }: FrameStrata) -> String {
        if order == Order::VanDerCorputLiteral {
            add!(
                self,
                "clamp_last",
                "order/mirrored",
                "order/radical_inverse",
                "order/van_der_corput_literal"
            );
            return format!("van_der_corput_literal(value, frame % {n}u)");
        }
        let is_rotated = matches!(order, Order::PhaseRotated | Order::PhaseRotatedVanDerCorput);
        if is_rotated {
            add!(self, "clamp_last", "order/rotated");
        } else {
            self.stable_or_literal(literal, STRATIFY);
        }
        let frame = if is_rotated { format!("entered(value, frame, {n}u)") } else { format!("frame % {n}u") };
        let stratum = match order {
            Order::Ascending | Order::VanDerCorputLiteral => frame,
            Order::AlternatingLiteral => {
                add!(self, "alternating_literal");
                format!("alternating_literal({frame}, {n}u)")
            }
            Order::Alternating | Order::PhaseRotated => {
                add!(self, "alternating");
                format!("alternating({frame}, {n}u)")
            }
            Order::VanDerCorput | Order::PhaseRotatedVanDerCorput => {
                add!(self, "order/mirrored", "order/radical_rank");
                format!("radical_rank({frame}, {n}u)")
            }
        };
        let function = match (is_rotated, literal) {
            (true, _) => "rotated",
            (false, true) => "stratified_literal",
            (false, false) => "stratified",
        };
        format!("{function}(value, {stratum}, {n}u)")
    }

    /// Adds the chunks of the samples' strata and returns the expression of their threshold.
    fn sampled(
        &mut self,
        literal: bool,
        SampleStrata { samples: n, pattern }: SampleStrata,
        options: &ShaderOptions,
    ) -> Result<String, AssembleError> {
        // Hashed thresholds stay from frame to frame, or repeat after some, and so must the strata of their samples.
        let frame = match options.pipeline.cycle() {
            None => "frame".to_owned(),
            Some(1) => "0u".to_owned(),
            Some(frames) => format!("frame % {frames}u"),
        };
        let form = if literal { "_literal" } else { "" };
        let sample = match pattern {
            SamplePattern::Regular => {
                add!(self, "coverage_regular");
                return Ok(format!("regular(sample_index, {n}u)"));
            }
            SamplePattern::ByPixel => {
                add!(
                    self,
                    "clamp_last",
                    "rotated_left",
                    "hash/murmur",
                    "hash/murmur_end",
                    "hash/murmur_words",
                    "open_lattice",
                    "mask/pixel"
                );
                return Ok(format!("turned(pixel_value(vec2<u32>(pixel)), sample_index, {n}u)"));
            }
            SamplePattern::Hardware => return Err(AssembleError::NoText("the samples of the hardware")),
            SamplePattern::Independent => {
                return Err(AssembleError::NoText("independent draws at every sample"));
            }
            SamplePattern::Jittered => {
                self.stable_or_literal(literal, JITTERED);
                "sample_index".to_owned()
            }
            SamplePattern::Decorrelated => {
                self.stable_or_literal(literal, JITTERED);
                add!(self, "to_word", "hash/pcg4d", "fragment_words", "open_lattice", "fragment_pair");
                self.stable_or_literal(literal, DECORRELATED);
                format!("decorrelated{form}(fragment_pair(pixel, {frame}, layer), sample_index, {n}u)")
            }
            SamplePattern::Shuffled => {
                self.stable_or_literal(literal, JITTERED);
                add!(self, "to_word", "hash/pcg4d", "fragment_words", "hash/pcg", "mask/shuffled");
                format!("shuffled(fragment_words(pixel, {frame}, layer).w, sample_index, {n}u)")
            }
        };
        Ok(format!("jittered{form}(value, {sample}, {n}u)"))
    }

    fn stable_or_literal(&mut self, literal: bool, [stable_form, literal_form]: [&'static str; 2]) {
        if !literal && stable_form.contains("clamp_last(") {
            add!(self, "clamp_last");
        }
        self.add(&[if literal { literal_form } else { stable_form }]);
    }

    /// Adds the chunks of the source and its expressions.
    fn source(&mut self, options: &ShaderOptions, stages: &mut Vec<String>) -> Result<(), AssembleError> {
        let scale = |scale: f64| {
            let scale = positive("the hash scale", scale as f32)?;
            let is_written = options.hash_scale == HashScale::Written;
            Ok(if is_written { format!("{scale:?}f") } else { "hash_scale".to_owned() })
        };
        stages.push(match options.pipeline.source {
            Source::Hash(Model::Hashed(HashedAlpha { variant, hash, hash_scale, form })) => {
                let scale = scale(hash_scale)?;
                self.listing(variant, hash, form);
                format!("hashed(position, dpdx, dpdy, {scale})")
            }
            Source::Hash(Model::Robust(Robust { variant, hash, hash_scale, join, repairs })) => {
                let scale = scale(hash_scale)?;
                if repairs != Repairs::ALL {
                    return Err(AssembleError::NoText("a robust threshold without a repair"));
                }
                self.robust(variant == Variant::Anisotropic, hash, join);
                format!("robust(position, dpdx, dpdy, {scale})")
            }
            Source::Hash(Model::BeforeCdf(_)) => {
                return Err(AssembleError::NoText("the mixture of two hashes before Eq. 2"));
            }
            Source::Stochastic => {
                add!(self, "to_word", "hash/pcg4d", "fragment_words", "stochastic");
                "stochastic(fragment_words(pixel, frame, layer).x)".to_owned()
            }
            Source::Fixed(threshold) => {
                traditional("another fixed threshold than 1/2", threshold)?;
                "0.5".to_owned()
            }
            Source::Given => return Err(AssembleError::NoText("a threshold of the caller")),
            Source::ScreenDoor(ScreenDoor::Fixed) => {
                add!(self, "coverage_regular", "screen_door/ordered");
                "regular(ordered(vec2<u32>(pixel)), 16u)".to_owned()
            }
            Source::ScreenDoor(ScreenDoor::Bayer) => {
                add!(self, "coverage_regular", "screen_door/bayer");
                "regular(bayer(vec2<u32>(pixel)), 64u)".to_owned()
            }
            Source::ScreenDoor(ScreenDoor::RandomMask(seed)) => {
                add!(
                    self,
                    "coverage_regular",
                    "rotated_left",
                    "hash/murmur",
                    "hash/murmur_end",
                    "hash/murmur_words",
                    "screen_door/random_mask"
                );
                format!("regular(random_mask(vec2<u32>(pixel), {seed}u), 16u)")
            }
            Source::ScreenDoor(ScreenDoor::Randomised) => {
                add!(
                    self,
                    "clamp_last",
                    "coverage_jittered",
                    "coverage_decorrelated",
                    "rotated_left",
                    "hash/murmur",
                    "hash/murmur_end"
                );
                add!(
                    self,
                    "hash/murmur_words",
                    "open_lattice",
                    "screen_door/ordered",
                    "screen_door/randomised"
                );
                "randomised(vec2<u32>(pixel), layer)".to_owned()
            }
            Source::Stipple { density, kept } => {
                traditional("a stipple of another threshold than 1/2", kept)?;
                add!(self, "stipple");
                let [kept, apart] = match density {
                    Density::High => ["0.5", "1.0"],
                    Density::Low => ["1.0", "0.5"],
                };
                format!("select({kept}, {apart}, is_apart(vec2<u32>(pixel)))")
            }
        });
        let Pipeline { source, .. } = options.pipeline;
        if let Source::Hash(Model::Hashed(hashed)) = source
            && matches!(hashed.variant, Variant::Linear | Variant::Single)
            && hashed.form == CdfForm::Stable
        {
            stages.push("clamp(value, 1.0e-6, 1.0)".to_owned());
        } else if options.pipeline.clamps() && can_be_zero(source) {
            add!(self, "clamp_last");
            stages.push("clamp_last(value)".to_owned());
        }
        Ok(())
    }

    fn listing(&mut self, variant: Variant, hash: HashKind, form: CdfForm) {
        if hash.reads_octave() {
            add!(self, "cell", "cell_at");
        } else {
            add!(self, "cell_plain");
        }
        self.hash(hash);
        add!(self, "length_of");
        if variant == Variant::Anisotropic {
            add!(self, "corner_weight");
        } else {
            add!(self, "two_scale/longest_derivative");
        }
        if variant == Variant::Single {
            add!(self, "hashed_single");
            return;
        }
        add!(self, "two_scale/two_scale");
        match variant {
            Variant::Isotropic => add!(self, "two_scale/isotropic"),
            Variant::Anisotropic => add!(self, "two_scale/anisotropic"),
            Variant::Linear | Variant::Single => {
                add!(self, "two_scale/linear", "hashed_linear");
                return;
            }
        }
        match form {
            CdfForm::Literal => add!(self, "cdf_literal"),
            CdfForm::Stable => add!(self, "cdf"),
        }
        add!(self, "hashed");
    }

    fn robust(&mut self, anisotropic: bool, hash: HashKind, join: Join) {
        add!(self, "cell");
        self.hash(hash);
        add!(self, "robust/scales");
        if anisotropic {
            add!(self, "robust/anisotropic");
        } else {
            add!(self, "length_of", "robust/isotropic");
        }
        match (join, anisotropic) {
            (Join::Interpolate, false) => {
                add!(self, "cdf", "robust/interpolate", "robust/interpolate_isotropic");
            }
            (Join::Interpolate, true) => {
                add!(self, "length_of", "corner_weight", "cdf");
                add!(self, "robust/interpolate", "robust/interpolate_anisotropic");
            }
            (Join::Copula, false) => add!(self, "normal", "robust/copula_isotropic"),
            (Join::Copula, true) => add!(self, "normal", "robust/copula_anisotropic"),
            (Join::Dithered, false) => {
                add!(self, "robust/switch_isotropic", "robust/dithered_isotropic");
            }
            (Join::Dithered, true) => {
                add!(self, "robust/switch_anisotropic", "robust/dithered_anisotropic");
            }
            (Join::Inherit, false) => {
                add!(self, "robust/switch_isotropic", "robust/nested", "robust/inherit_isotropic");
            }
            (Join::Inherit, true) => {
                add!(self, "robust/switch_anisotropic", "robust/nested", "robust/inherit_anisotropic");
            }
        }
        add!(self, "is_finite", "robust/robust");
    }

    fn hash(&mut self, hash: HashKind) {
        self.add(hash.entry().wgsl);
    }

    /// Writes the function that callers call.
    fn finish(&mut self, parameters: &[Parameter], stages: &[String]) {
        let list: Vec<_> = parameters.iter().map(|p| format!("{}: {}", p.name, p.wgsl_type)).collect();
        // Writing to a string cannot fail.
        let _ = writeln!(self.written, "fn threshold({}) -> f32 {{", list.join(", "));
        let [first, between @ ..] = stages else { return };
        if between.is_empty() {
            let _ = writeln!(self.written, "    return {first};\n}}");
        } else {
            let _ = writeln!(self.written, "    var value = {first};");
            for stage in between {
                let _ = writeln!(self.written, "    value = {stage};");
            }
            let _ = writeln!(self.written, "    return value;\n}}");
        }
    }
}

/// The stable and the literal form of a chunk.
macro_rules! forms {
    ($($constant:ident = $path:literal;)*) => {
        $(const $constant: [&str; 2] = [
            include_str!(concat!("chunk/", $path, ".wgsl")),
            include_str!(concat!("chunk/", $path, "_literal.wgsl")),
        ];)*
    };
}

forms! {
    STRATIFY = "stratify";
    JITTERED = "coverage_jittered";
    DECORRELATED = "coverage_decorrelated";
    FADE_IN = "fade_in";
    ANISOTROPY = "anisotropy";
}
