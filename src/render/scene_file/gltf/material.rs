//! What covers a primitive of a glTF file: the alpha and the colour of its material as the standard computes them.

use super::{Cover, Covering, Failed, File};
use crate::render::draw::texture::{Filter, Level, Sampler, TextureSource, Wrap};
use crate::render::scene_file::decoded::Decoded;
use crate::render::scene_file::image::Channel;
use crate::render::scene_file::surface::AlphaMode;
use glam::{DMat2, DVec2};
use gltf::texture::{Info, MagFilter, MinFilter, WrappingMode};

impl File<'_> {
    /// Finds what a material is, and reads its texture.
    pub(super) fn cover_of(&mut self, material: &gltf::Material<'_>) -> Result<Cover, Failed> {
        if let Some(texture) = self.stands_in(material) {
            return Ok(Cover {
                texture: Covering::OfScene(texture),
                set: 0,
                transform: (DMat2::IDENTITY, DVec2::ZERO),
                is_opaque: false,
                takes_colours: false,
                has_image: true,
                cutoff: None,
                single_sided: !material.double_sided(),
            });
        }
        let metallic = material.pbr_metallic_roughness();
        let (factor, info) = match material.pbr_specular_glossiness() {
            Some(glossy) if metallic.base_color_texture().is_none() => {
                (glossy.diffuse_factor(), glossy.diffuse_texture())
            }
            Some(_) | None => (metallic.base_color_factor(), metallic.base_color_texture()),
        };
        let mode = self.wanted.alpha_mode.unwrap_or(match material.alpha_mode() {
            gltf::material::AlphaMode::Opaque => AlphaMode::Opaque,
            gltf::material::AlphaMode::Mask => AlphaMode::Mask,
            gltf::material::AlphaMode::Blend => AlphaMode::Blend,
        });
        let cutoff = (mode == AlphaMode::Mask).then(|| material.alpha_cutoff().unwrap_or(0.5));
        let mut source = match &info {
            Some(info) => of_texture(self, &info.texture())?,
            None => {
                let white = Level { size: [1, 1], alpha: vec![1.0], colour: vec![[u16::MAX; 3]] };
                TextureSource::new(white, Wrap::Repeat, Filter::Trilinear)
            }
        };
        for level in &mut source.levels {
            multiply(level, factor, mode);
        }
        source.cutoff = cutoff;
        if let Some(cutoff) = cutoff {
            compare(self, material, &source, cutoff);
        }
        let (set, transform) = coordinates(info.as_ref());
        let texture = Covering::OfFile(self.found.textures.len() as u32);
        self.found.textures.push(source);
        let is_opaque = mode == AlphaMode::Opaque;
        Ok(Cover {
            texture,
            set,
            transform,
            is_opaque,
            takes_colours: true,
            has_image: info.is_some(),
            cutoff,
            single_sided: !material.double_sided(),
        })
    }
}

/// Reads the image of a texture: that of an extension before the one that others fall back to, since it may come with levels of its own;
/// one that may be packed only where there is no other.
fn of_texture(file: &mut File<'_>, texture: &gltf::Texture<'_>) -> Result<TextureSource, Failed> {
    let named = |extension: &str| {
        let source = texture.extension_value(extension)?.get("source")?.as_u64()?;
        usize::try_from(source).ok()
    };
    let index = ["MSFT_texture_dds", "EXT_texture_webp"].into_iter().find_map(named);
    let index = index.or(texture.source().map(|image| image.index())).or_else(|| named("KHR_texture_basisu"));
    let index =
        index.ok_or_else(|| Failed::Content(format!("texture {} names no image", texture.index())))?;
    let levels = of_image(file, index)?;
    let sampler = texture.sampler();
    let wrap = |mode| match mode {
        WrappingMode::ClampToEdge => Wrap::Clamp,
        WrappingMode::MirroredRepeat => Wrap::Mirror,
        WrappingMode::Repeat => Wrap::Repeat,
    };
    // What is left to whoever draws is what they all take.
    let (filter, has_levels) = match sampler.min_filter() {
        None | Some(MinFilter::LinearMipmapLinear) => (Filter::Trilinear, true),
        Some(MinFilter::NearestMipmapLinear) => (Filter::NearestLinear, true),
        Some(MinFilter::LinearMipmapNearest) => (Filter::Bilinear, true),
        Some(MinFilter::NearestMipmapNearest) => (Filter::Nearest, true),
        Some(MinFilter::Linear) => (Filter::Bilinear, false),
        Some(MinFilter::Nearest) => (Filter::Nearest, false),
    };
    let magnified = Some(match sampler.mag_filter() {
        None | Some(MagFilter::Linear) => Filter::Bilinear,
        Some(MagFilter::Nearest) => Filter::Nearest,
    });
    let wrap = [sampler.wrap_s(), sampler.wrap_t()].map(wrap);
    Ok(TextureSource { levels, sampler: Sampler { wrap, filter, magnified, has_levels }, cutoff: None })
}

/// Decodes an image. It is read again for every material that uses it: each changes it in its own way.
fn of_image(file: &mut File<'_>, index: usize) -> Result<Vec<Level>, Failed> {
    let document = file.document;
    let image = document.as_json().images.get(index);
    let image = image.ok_or_else(|| Failed::Content(format!("image {index} is not there")))?;
    let held;
    let (name, bytes): (String, &[u8]) = match (&image.uri, image.buffer_view) {
        (Some(uri), _) => {
            let name = super::named("image", index, uri);
            held = file.bytes_of(uri).map_err(|source| Failed::Part { part: name.clone(), source })?;
            (name, &held)
        }
        (None, Some(view)) => {
            let name = format!("image {index}");
            let view = document.views().nth(view.value());
            let bytes = view.and_then(|view| super::accessor::view_bytes(&view, file.buffers));
            let ends = || Failed::Content(format!("{name} ends beyond its buffer"));
            (name.clone(), bytes.ok_or_else(ends)?)
        }
        (None, None) => {
            return Err(Failed::Content(format!("image {index} names neither a file nor a buffer view")));
        }
    };
    let of = file.path.file_name().unwrap_or_default().to_string_lossy();
    let shown = file.path.with_file_name(format!("{of}, {name}"));
    let texture = Failed::Texture;
    let decoded = Decoded::new(bytes, &shown, file.texels_left).map_err(texture)?;
    let levels: Vec<Level> = decoded.with_alpha().levels(Channel::Alpha, &shown).map_err(texture)?;
    // The other levels of a file are a third more than was asked for.
    let texels = levels.iter().map(|level| level.alpha.len() as u64).sum::<u64>();
    file.texels_left = file.texels_left.saturating_sub(texels);
    Ok(levels)
}

/// The set of texture coordinates of a texture, and what is done to them.
fn coordinates(info: Option<&Info<'_>>) -> (u32, (DMat2, DVec2)) {
    let Some(info) = info else { return (0, (DMat2::IDENTITY, DVec2::ZERO)) };
    let Some(transform) = info.texture_transform() else {
        return (info.tex_coord(), (DMat2::IDENTITY, DVec2::ZERO));
    };
    let [offset, scale] =
        [transform.offset(), transform.scale()].map(|pair| DVec2::from(pair.map(f64::from)));
    let (sine, cosine) =
        (libm::sin(f64::from(transform.rotation())), libm::cos(f64::from(transform.rotation())));
    // Scaled first, then turned, then moved; rows go down, so that the turn goes the other way round.
    let turn = DMat2::from_cols(DVec2::new(cosine, -sine), DVec2::new(sine, cosine));
    (transform.tex_coord().unwrap_or(info.tex_coord()), (turn * DMat2::from_diagonal(scale), offset))
}

/// Multiplies a texture by the factors of its material, which are those of light; colours are stored as sRGB.
fn multiply(level: &mut Level, [red, green, blue, alpha]: [f32; 4], mode: AlphaMode) {
    match mode {
        AlphaMode::Opaque => level.alpha.fill(1.0),
        AlphaMode::Mask | AlphaMode::Blend => {
            level.alpha.iter_mut().for_each(|a| *a *= alpha.clamp(0.0, 1.0))
        }
    }
    let factors = [red, green, blue].map(|factor| stored(f64::from(factor)));
    if factors != [1.0; 3] {
        for colour in &mut level.colour {
            *colour = [0, 1, 2].map(|c| (f64::from(colour[c]) * factors[c]).round() as u16);
        }
    }
}

/// What a stored colour is multiplied by where light is multiplied by a factor, [0, 1]: sRGB as a power of 2.2.
pub(super) fn stored(factor: f64) -> f64 {
    libm::pow(factor.clamp(0.0, 1.0), 1.0 / 2.2)
}

/// Share of a finest level by which what a test shows may differ from the mean of its alpha before that is told.
const TOLERANCE: f64 = 0.05;

/// Tells where a test shows something else than alpha as coverage does.
fn compare(file: &mut File<'_>, material: &gltf::Material<'_>, source: &TextureSource, cutoff: f32) {
    let finest = &source.levels[0];
    let texels = finest.alpha.len().max(1) as f64;
    let mean = finest.alpha.iter().map(|&a| f64::from(a)).sum::<f64>() / texels;
    let kept = finest.alpha.iter().filter(|&&a| a >= cutoff).count() as f64 / texels;
    if (mean - kept).abs() > TOLERANCE {
        let [mean, kept] = [mean, kept].map(|share| 100.0 * share);
        let name = match (material.name(), material.index()) {
            (Some(name), _) => format!("material `{name}`"),
            (None, Some(index)) => format!("material {index}"),
            (None, None) => "what has no material".to_owned(),
        };
        file.tell(format!(
            "{name} is tested at {cutoff}, which keeps {kept:.0} % of the texels of its finest level, while their mean \
             alpha is {mean:.0} %: the truth here is the former, a hashed threshold shows the latter; \
             `alpha_mode = \"blend\"` makes that the truth, too"
        ));
    }
}
