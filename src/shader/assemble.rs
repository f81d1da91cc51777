//! The threshold as WGSL text, put together out of chunks: only those that are asked for.
//!
//! Each chunk is the twin of the function of the same name in the `threshold` wing. With an integer hash the literal
//! and the robust text agree with it in all but the last bits of `log2` and of the divisions; the copula join, which
//! Rust computes in `f64`, and the sine hash are stated apart where they are tested.

use crate::threshold::cdf::CdfForm;
use crate::threshold::hash::HashKind;
use crate::threshold::robust::Join;
use crate::threshold::stage::order::Order;
use crate::threshold::stage::stipple::Density;
use crate::threshold::two_scale::Variant;
use core::fmt::Write as _;
use core::num::NonZeroU16;

/// Where the threshold comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// Listings 1 and 2 and their ablations (§5, §6); `Literal` to the letter, see [`HashedAlpha::form`].
    ///
    /// [`HashedAlpha::form`]: crate::threshold::hashed::HashedAlpha::form
    Listing(CdfForm),
    /// Listings 1 and 2 with every repair, see [`Robust`](crate::threshold::robust::Robust). An input that is no finite
    /// number, an error in Rust, gives the traditional 1/2.
    Robust(Join),
    /// A fresh random number in every pixel, frame and layer (§4).
    Stochastic,
    /// The traditional alpha test, 1/2 (§1).
    Fixed,
    /// The fixed dither of so many samples (Eq. 7).
    Regular(NonZeroU16),
    /// Regular thresholds of so many samples, turned by one value of the pixel (Humus 2009).
    PixelMask(NonZeroU16),
    /// Strata over tiles of pixels (§3, §8.1).
    ScreenDoor(ScreenDoor),
    /// The traditional alpha test with holes of one pixel, or of three (Ols 2009).
    Stipple(Density),
}

/// Which threshold a pixel of a tile of 4 x 4 has, see [`screen_door`](crate::threshold::stage::screen_door).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ScreenDoor {
    /// The ordered dither, the same in every tile and for every layer.
    Fixed,
    /// An order that this seed draws, the same in every tile and for every layer.
    RandomMask(u32),
    /// Strata that are permuted and jittered for each tile and layer.
    Randomised,
}

/// Fading noise in with distance (Eqs. 3 to 5).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FadeIn {
    /// Level of detail from which on all is noise (`n` of Eq. 5), above 0.
    pub full_noise_lod: f32,
    /// Whether the level is multiplied by the degree of anisotropy of the texture access (§7.1.1).
    pub anisotropy: bool,
}

/// Dividing [0, 1) among frames (Eq. 6).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Stratify {
    /// Number of frames that belong together.
    pub frames: NonZeroU16,
    /// Which stratum a frame takes (§7.2.3).
    pub order: Order,
}

/// Several thresholds in one fragment (Eqs. 8 and 9).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Coverage {
    /// Number of samples in a pixel.
    pub samples: NonZeroU16,
    /// In which order the samples have the strata.
    pub strata: Strata,
}

/// The order of the strata of a pixel's samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Strata {
    /// The same in every pixel and layer (Eq. 8).
    InOrder,
    /// An offset and a step for each pixel and layer, and for each frame if the threshold reads it (Eq. 9).
    Decorrelated,
    /// The same with any permutation (§3, Enderton et al. 2010).
    Shuffled,
}

/// What the text is to do. Stages act in the order of the fields from `source` on; what is `None` leaves no trace.
///
/// The effects are literal where the source is literal, and in their stable form with every other.
///
/// ```
/// use hashed_alpha::shader::assemble::{ShaderOptions, assemble};
/// use hashed_alpha::threshold::two_scale::Variant;
///
/// let text = assemble(&ShaderOptions::robust(Variant::Isotropic)).unwrap();
/// assert!(text.contains("fn threshold(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>) -> f32"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShaderOptions {
    /// How scales come from derivatives. The robust source reads every variant but the anisotropic as isotropic.
    pub variant: Variant,
    /// The hash of a cell.
    pub hash: HashKind,
    /// Size of the noise in pixels, finite and above 0, written into the text; `None` makes it a parameter.
    pub hash_scale: Option<f32>,
    /// Where the threshold comes from. Only the first two read the fields above.
    pub source: Source,
    /// Strata of frames.
    pub stratify: Option<Stratify>,
    /// Strata of samples.
    pub coverage: Option<Coverage>,
    /// Noise that fades in.
    pub fade_in: Option<FadeIn>,
}

impl ShaderOptions {
    /// The paper's threshold to the letter, as [`HashedAlpha::listing`](crate::threshold::hashed::HashedAlpha::listing).
    #[must_use]
    pub const fn listing(variant: Variant) -> Self {
        Self {
            variant,
            hash: HashKind::Sine,
            hash_scale: Some(1.0),
            source: Source::Listing(CdfForm::Literal),
            stratify: None,
            coverage: None,
            fade_in: None,
        }
    }

    /// The threshold with every repair, as [`Robust::new`](crate::threshold::robust::Robust::new).
    #[must_use]
    pub const fn robust(variant: Variant) -> Self {
        let join = if matches!(variant, Variant::Anisotropic) { Join::Copula } else { Join::Interpolate };
        Self { hash: HashKind::Mm4, source: Source::Robust(join), ..Self::listing(variant) }
    }

    /// Returns the parameters of the function `threshold`, in their order.
    #[must_use]
    pub fn parameters(&self) -> Vec<Parameter> {
        let footprint = matches!(self.source, Source::Listing(_) | Source::Robust(_));
        let permuted = self.coverage.is_some_and(|coverage| coverage.strata != Strata::InOrder);
        let fresh = self.source == Source::Stochastic || permuted;
        let changes = self.source == Source::Stochastic || self.stratify.is_some();
        let by_pixel =
            matches!(self.source, Source::ScreenDoor(_) | Source::PixelMask(_) | Source::Stipple(_));
        let random_door = self.source == Source::ScreenDoor(ScreenDoor::Randomised);
        let sampled =
            self.coverage.is_some() || matches!(self.source, Source::Regular(_) | Source::PixelMask(_));
        let anisotropy = self.fade_in.is_some_and(|fade_in| fade_in.anisotropy);
        let all = [
            (footprint, POSITION),
            (footprint, DPDX),
            (footprint, DPDY),
            (footprint && self.hash_scale.is_none(), HASH_SCALE),
            (fresh || by_pixel, PIXEL),
            (changes, FRAME),
            (fresh || random_door, LAYER),
            (sampled, SAMPLE_INDEX),
            (self.fade_in.is_some(), LOD),
            (anisotropy, TEXEL_DX),
            (anisotropy, TEXEL_DY),
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

/// An option that cannot be written as shader text.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{what} is {value}; a finite number above 0 is needed")]
pub struct InvalidOption {
    /// Which one.
    pub what: &'static str,
    /// Its value.
    pub value: f32,
}

/// Returns WGSL text that ends in `fn threshold(...) -> f32` with the parameters of [`ShaderOptions::parameters`].
///
/// # Errors
///
/// [`InvalidOption`] for a `hash_scale` or `full_noise_lod` that is not a finite number above 0.
pub fn assemble(options: &ShaderOptions) -> Result<String, InvalidOption> {
    positive("the hash scale", options.hash_scale)?;
    positive("the level of full noise", options.fade_in.map(|fade_in| fade_in.full_noise_lod))?;
    let mut text = Text::default();
    let stages = text.stages(options);
    text.finish(&options.parameters(), &stages);
    Ok(text.written)
}

fn positive(what: &'static str, value: Option<f32>) -> Result<(), InvalidOption> {
    match value {
        Some(value) if !(value.is_finite() && value > 0.0) => Err(InvalidOption { what, value }),
        _ => Ok(()),
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
    fn stages(&mut self, options: &ShaderOptions) -> Vec<String> {
        let literal = options.source == Source::Listing(CdfForm::Literal);
        let mut stages = vec![self.source(options)];
        if options.source == Source::Listing(CdfForm::Stable)
            && matches!(options.variant, Variant::Linear | Variant::Single)
        {
            stages.push("clamp(value, 1.0e-6, 1.0)".to_owned());
        }
        if let Some(Stratify { frames, order }) = options.stratify {
            stages.push(self.stratified(literal, order, frames));
        }
        if let Some(Coverage { samples, strata }) = options.coverage {
            self.stable_or_literal(literal, JITTERED);
            // Hashed thresholds stay from frame to frame, or repeat after some, and so must the strata of their samples.
            let frame = match options.stratify {
                Some(Stratify { frames, .. }) if options.source != Source::Stochastic => {
                    format!("frame % {frames}u")
                }
                _ if options.parameters().contains(&FRAME) => "frame".to_owned(),
                _ => "0u".to_owned(),
            };
            if strata != Strata::InOrder {
                add!(self, "integral_word", "pcg_4d", "fragment_words");
            }
            let sample = match strata {
                Strata::InOrder => "sample_index".to_owned(),
                Strata::Decorrelated => {
                    add!(self, "open_lattice", "fragment_pair");
                    self.stable_or_literal(literal, DECORRELATED);
                    format!("decorrelated(fragment_pair(pixel, {frame}, layer), sample_index, {samples}u)")
                }
                Strata::Shuffled => {
                    add!(self, "pcg", "mask/shuffled");
                    format!("shuffled(fragment_words(pixel, {frame}, layer).w, sample_index, {samples}u)")
                }
            };
            stages.push(format!("jittered(value, {sample}, {samples}u)"));
        }
        if let Some(FadeIn { full_noise_lod, anisotropy }) = options.fade_in {
            if !literal {
                add!(self, "finite");
            }
            self.stable_or_literal(literal, FADE_IN);
            let mut lod = "lod";
            if anisotropy {
                self.stable_or_literal(literal, ANISOTROPY);
                lod = "lod * anisotropy(texel_dx, texel_dy)";
            }
            stages.push(format!("fade_in(value, blend({lod}, {full_noise_lod:?}f))"));
        }
        stages
    }

    /// Adds the chunks of an order of strata and returns the expression of its threshold.
    fn stratified(&mut self, literal: bool, order: Order, n: NonZeroU16) -> String {
        if order == Order::VanDerCorputLiteral {
            add!(
                self,
                "clamp_last",
                "order/mirrored",
                "order/radical_inverse",
                "order/van_der_corput_literal"
            );
            return format!("van_der_corput(value, frame % {n}u)");
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
                format!("alternating({frame}, {n}u)")
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
        format!("{}(value, {stratum}, {n}u)", if is_rotated { "rotated" } else { "stratified" })
    }

    fn stable_or_literal(&mut self, literal: bool, [stable_form, literal_form]: [&'static str; 2]) {
        if !literal && stable_form.contains("clamp_last(") {
            add!(self, "clamp_last");
        }
        self.add(&[if literal { literal_form } else { stable_form }]);
    }

    /// Adds the chunks of the source and returns its expression.
    fn source(&mut self, options: &ShaderOptions) -> String {
        let scale = options.hash_scale.map_or_else(|| "hash_scale".to_owned(), |scale| format!("{scale:?}f"));
        match options.source {
            Source::Listing(form) => {
                self.listing(options.variant, options.hash, form);
                format!("hashed(position, dpdx, dpdy, {scale})")
            }
            Source::Robust(join) => {
                self.robust(options.variant == Variant::Anisotropic, options.hash, join);
                format!("robust(position, dpdx, dpdy, {scale})")
            }
            Source::Stochastic => {
                add!(self, "integral_word", "pcg_4d", "fragment_words", "stochastic");
                "stochastic(fragment_words(pixel, frame, layer).x)".to_owned()
            }
            Source::Fixed => "0.5".to_owned(),
            Source::Regular(samples) => {
                add!(self, "coverage_regular");
                format!("regular(sample_index, {samples}u)")
            }
            Source::ScreenDoor(ScreenDoor::Fixed) => {
                add!(self, "coverage_regular", "screen_door/ordered");
                "regular(ordered(vec2<u32>(pixel)), 16u)".to_owned()
            }
            Source::ScreenDoor(ScreenDoor::RandomMask(seed)) => {
                add!(self, "coverage_regular", "rotate", "murmur", "murmur_words", "screen_door/random_mask");
                format!("regular(random_mask(vec2<u32>(pixel), {seed}u), 16u)")
            }
            Source::ScreenDoor(ScreenDoor::Randomised) => {
                add!(self, "clamp_last", "coverage_jittered", "coverage_decorrelated", "rotate", "murmur");
                add!(self, "murmur_words", "open_lattice", "screen_door/ordered", "screen_door/randomised");
                "randomised(vec2<u32>(pixel), layer)".to_owned()
            }
            Source::PixelMask(samples) => {
                add!(self, "clamp_last", "rotate", "murmur", "murmur_words", "open_lattice", "mask/pixel");
                format!("turned(pixel_value(vec2<u32>(pixel)), sample_index, {samples}u)")
            }
            Source::Stipple(density) => {
                add!(self, "stipple");
                let [kept, apart] = if density == Density::High { ["0.5", "1.0"] } else { ["1.0", "0.5"] };
                format!("select({kept}, {apart}, is_apart(vec2<u32>(pixel)))")
            }
        }
    }

    fn listing(&mut self, variant: Variant, hash: HashKind, form: CdfForm) {
        if matches!(hash, HashKind::Sine | HashKind::SineChi2 | HashKind::Pcg3d) {
            add!(self, "cell_plain");
        } else {
            add!(self, "cell", "cell_at");
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
            (Join::Dithered, false) => add!(self, "robust/dithered_isotropic"),
            (Join::Dithered, true) => add!(self, "robust/dithered_anisotropic"),
        }
        add!(self, "finite", "robust/robust");
    }

    fn hash(&mut self, hash: HashKind) {
        if !matches!(hash, HashKind::Sine | HashKind::SineChi2) {
            add!(self, "integral_word", "open_lattice");
        }
        match hash {
            HashKind::Sine => add!(self, "hash/sine", "hash/chi_1"),
            HashKind::SineChi2 => add!(self, "hash/sine", "hash/chi_2"),
            HashKind::Mm4 => add!(self, "rotate", "murmur", "hash/mm4"),
            HashKind::Xxhash32 => add!(self, "rotate", "hash/xxhash32"),
            HashKind::Pcg3d => add!(self, "hash/pcg3d"),
            HashKind::Pcg4d => add!(self, "pcg_4d", "hash/pcg4d"),
            HashKind::PcgNested => add!(self, "pcg", "hash/pcg_nested"),
        }
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
