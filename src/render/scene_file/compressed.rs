//! Images as devices keep them, with their own levels: DDS and KTX2, uncompressed and BC1 to BC7.
//!
//! What is packed once more (Basis, Zstandard, zlib) is refused in words: a device reads none of it before it is unpacked.

use super::decoded::{Decoded, ImageError};
use image::{DynamicImage, ImageBuffer, RgbImage};
use image_dds::ddsfile::{self, Dds};
use image_dds::{ImageFormat, Surface, mip_dimension};
use std::path::Path;

/// What a level is made of.
#[derive(Clone, Copy)]
enum Format {
    /// A format that the decoder knows.
    Known(ImageFormat),
    /// The same, whose alpha has no meaning.
    Opaque(ImageFormat),
    /// Three bytes a pixel, which the decoder does not know.
    Rgb8,
}

/// Decodes a DDS or a KTX2 file; `None` for another. `check` finds sizes that are not allowed.
pub(super) fn decode(
    bytes: &[u8],
    path: &Path,
    check: &dyn Fn([u32; 2]) -> Result<(), ImageError>,
) -> Option<Result<Decoded, ImageError>> {
    const KTX1: &[u8] = b"\xabKTX 11\xbb";
    if bytes.starts_with(b"DDS ") {
        Some(dds(bytes, path, check))
    } else if bytes.starts_with(b"\xabKTX 20\xbb") {
        Some(ktx2(bytes, path, check))
    } else if bytes.starts_with(KTX1) {
        Some(Err(wrong(path, "is KTX of version 1, which is not read here; KTX2 is".to_owned())))
    } else {
        None
    }
}

fn wrong(path: &Path, what: String) -> ImageError {
    ImageError::Kind { path: path.into(), what }
}

fn dds(
    bytes: &[u8],
    path: &Path,
    check: &dyn Fn([u32; 2]) -> Result<(), ImageError>,
) -> Result<Decoded, ImageError> {
    let file = Dds::read(bytes).map_err(|error| wrong(path, format!("is no sound DDS file: {error}")))?;
    // The decoder multiplies the count of layers by the faces of a cube.
    if let Some(header) = &file.header10 {
        flat(path, 1, header.array_size.max(1), header.misc_flag == ddsfile::MiscFlag::TEXTURECUBE)?;
    }
    let mut surface = Surface::from_dds(&file)
        .map_err(|error| wrong(path, format!("is DDS of a kind that is not read here: {error}")))?;
    let is_cube = file.header.caps2.contains(ddsfile::Caps2::CUBEMAP);
    flat(path, surface.depth, surface.layers, is_cube)?;
    let size = [surface.width, surface.height];
    check(size)?;
    // The decoder takes the count for granted.
    surface.mipmaps = surface.mipmaps.clamp(1, most_levels(size));
    let levels = (0..surface.mipmaps).map(|level| {
        let ends = || wrong(path, format!("ends before its level {level}"));
        let size = size.map(|side| mip_dimension(side, level));
        one(size, Format::Known(surface.image_format), surface.get(0, 0, level).ok_or_else(ends)?, path)
    });
    let premultiplied =
        file.header10.as_ref().is_some_and(|header| header.alpha_mode == ddsfile::AlphaMode::PreMultiplied)
            || file
                .header
                .spf
                .fourcc
                .as_ref()
                .is_some_and(|code| [*b"DXT2", *b"DXT4"].contains(&code.0.to_le_bytes()));
    Ok(Decoded { levels: levels.collect::<Result<_, _>>()?, premultiplied })
}

fn ktx2(
    bytes: &[u8],
    path: &Path,
    check: &dyn Fn([u32; 2]) -> Result<(), ImageError>,
) -> Result<Decoded, ImageError> {
    if !has_sound_blocks(bytes) {
        return Err(wrong(path, "is no sound KTX2 file: its description of the data is broken".to_owned()));
    }
    let file =
        ktx2::Reader::new(bytes).map_err(|error| wrong(path, format!("is no sound KTX2 file: {error}")))?;
    let header = file.header();
    let packed = |how: &str| {
        wrong(
            path,
            format!(
                "is KTX2 that is packed once more ({how}), which is not read here; unpack it, or give it as PNG"
            ),
        )
    };
    if let Some(scheme) = header.supercompression_scheme {
        return Err(packed(match scheme {
            ktx2::SupercompressionScheme::BasisLZ => "Basis",
            ktx2::SupercompressionScheme::Zstandard => "Zstandard",
            ktx2::SupercompressionScheme::ZLIB => "zlib",
            _ => "a scheme of its own",
        }));
    }
    let Some(kind) = header.format else { return Err(packed("Basis")) };
    let format = of_vulkan(kind).ok_or_else(|| {
        wrong(
            path,
            format!("is KTX2 of a kind that is not read here ({kind:?}); uncompressed and BC1 to BC7 are"),
        )
    })?;
    flat(path, header.pixel_depth.max(1), header.layer_count.max(1), header.face_count > 1)?;
    let size = [header.pixel_width, header.pixel_height.max(1)];
    check(size)?;
    let levels = file
        .levels()
        .zip(0..most_levels(size))
        .map(|(level, index)| one(size.map(|side| mip_dimension(side, index)), format, level.data, path));
    let levels: Vec<DynamicImage> = levels.collect::<Result<_, _>>()?;
    if levels.is_empty() {
        return Err(wrong(path, "has no level".to_owned()));
    }
    Ok(Decoded { levels, premultiplied: file.is_alpha_premultiplied().unwrap_or(false) })
}

/// Whether the blocks of the data format descriptor of a KTX2 file have sizes of texel blocks that the reader can count: it adds one to
/// a byte.
fn has_sound_blocks(bytes: &[u8]) -> bool {
    let word = |at: usize| {
        let word = bytes.get(at..at.checked_add(4)?)?;
        Some(u32::from_le_bytes([word[0], word[1], word[2], word[3]]) as usize)
    };
    // Offset and length stand behind the magic and nine numbers.
    let (Some(first), Some(length)) = (word(48), word(52)) else { return true };
    let end = first.saturating_add(length);
    let mut at = first.saturating_add(4);
    while at < end {
        let Some(size) = word(at.saturating_add(4)).map(|word| word >> 16) else { return true };
        let sides = bytes.get(at.saturating_add(12)..at.saturating_add(16)).unwrap_or_default();
        if sides.contains(&0xff) {
            return false;
        }
        at = at.saturating_add(size.max(4));
    }
    true
}

/// Levels down to one texel.
fn most_levels([width, height]: [u32; 2]) -> u32 {
    u32::BITS - width.max(height).leading_zeros()
}

/// Refuses what is no picture on a plane.
fn flat(path: &Path, depth: u32, layers: u32, is_cube: bool) -> Result<(), ImageError> {
    let what = match (depth, layers, is_cube) {
        (1, 1, false) => return Ok(()),
        (_, _, true) => "a cube map".to_owned(),
        (1, layers, _) => format!("an array of {layers} images"),
        (depth, ..) => format!("a volume of {depth} slices"),
    };
    Err(wrong(path, format!("is {what}; one flat image can cover a surface")))
}

fn of_vulkan(format: ktx2::Format) -> Option<Format> {
    use ImageFormat as I;
    use ktx2::Format as V;
    Some(Format::Known(match format {
        V::R8_UNORM | V::R8_SRGB => I::R8Unorm,
        V::R8G8_UNORM | V::R8G8_SRGB => I::Rg8Unorm,
        V::R8G8B8_UNORM | V::R8G8B8_SRGB => return Some(Format::Rgb8),
        V::B8G8R8_UNORM | V::B8G8R8_SRGB => I::Bgr8Unorm,
        V::R8G8B8A8_UNORM | V::R8G8B8A8_SRGB => I::Rgba8Unorm,
        V::B8G8R8A8_UNORM | V::B8G8R8A8_SRGB => I::Bgra8Unorm,
        V::R16_UNORM => I::R16Unorm,
        V::R16G16_UNORM => I::Rg16Unorm,
        V::R16G16B16A16_UNORM => I::Rgba16Unorm,
        V::R16_SFLOAT => I::R16Float,
        V::R16G16_SFLOAT => I::Rg16Float,
        V::R16G16B16A16_SFLOAT => I::Rgba16Float,
        V::R32_SFLOAT => I::R32Float,
        V::R32G32_SFLOAT => I::Rg32Float,
        V::R32G32B32_SFLOAT => I::Rgb32Float,
        V::R32G32B32A32_SFLOAT => I::Rgba32Float,
        V::BC1_RGB_UNORM_BLOCK | V::BC1_RGB_SRGB_BLOCK => return Some(Format::Opaque(I::BC1RgbaUnorm)),
        V::BC1_RGBA_UNORM_BLOCK | V::BC1_RGBA_SRGB_BLOCK => I::BC1RgbaUnorm,
        V::BC2_UNORM_BLOCK | V::BC2_SRGB_BLOCK => I::BC2RgbaUnorm,
        V::BC3_UNORM_BLOCK | V::BC3_SRGB_BLOCK => I::BC3RgbaUnorm,
        V::BC4_UNORM_BLOCK => I::BC4RUnorm,
        V::BC5_UNORM_BLOCK => I::BC5RgUnorm,
        V::BC6H_UFLOAT_BLOCK => I::BC6hRgbUfloat,
        V::BC7_UNORM_BLOCK | V::BC7_SRGB_BLOCK => I::BC7RgbaUnorm,
        _ => return None,
    }))
}

/// How many channels mean something, from 1 to 4, and whether they have more than 8 bits; `None` for signed ones.
fn channels(format: ImageFormat) -> Option<(u8, bool)> {
    use ImageFormat as I;
    Some(match format {
        I::R8Unorm | I::BC4RUnorm => (1, false),
        I::R16Unorm | I::R16Float | I::R32Float => (1, true),
        I::Rg8Unorm | I::BC5RgUnorm | I::Bgr8Unorm => (3, false),
        I::Rg16Unorm | I::Rg16Float | I::Rg32Float | I::Rgb32Float => (3, true),
        I::BC6hRgbUfloat => (3, true),
        I::Rgba8Unorm
        | I::Rgba8UnormSrgb
        | I::Bgra8Unorm
        | I::Bgra8UnormSrgb
        | I::Bgra4Unorm
        | I::Bgr5A1Unorm => (4, false),
        I::BC1RgbaUnorm | I::BC1RgbaUnormSrgb | I::BC2RgbaUnorm | I::BC2RgbaUnormSrgb => (4, false),
        I::BC3RgbaUnorm | I::BC3RgbaUnormSrgb | I::BC7RgbaUnorm | I::BC7RgbaUnormSrgb => (4, false),
        I::Rgba16Unorm | I::Rgba16Float | I::Rgba32Float => (4, true),
        _ => return None,
    })
}

/// Decodes one level.
fn one(
    [width, height]: [u32; 2],
    format: Format,
    data: &[u8],
    path: &Path,
) -> Result<DynamicImage, ImageError> {
    let ends = || wrong(path, format!("has too few bytes for a level of {width} x {height} pixels"));
    let (image_format, is_opaque) = match format {
        Format::Rgb8 => {
            let bytes = data.get(..3 * width as usize * height as usize).ok_or_else(ends)?;
            return RgbImage::from_raw(width, height, bytes.to_vec()).map(Into::into).ok_or_else(ends);
        }
        Format::Known(image_format) => (image_format, false),
        Format::Opaque(image_format) => (image_format, true),
    };
    let Some((channels, is_deep)) = channels(image_format) else {
        return Err(wrong(
            path,
            format!("has signed or unusual numbers ({image_format:?}), which are no colours"),
        ));
    };
    let surface = Surface { width, height, depth: 1, layers: 1, mipmaps: 1, image_format, data };
    let failed = |error| wrong(path, format!("cannot be decoded: {error}"));
    let rgba = if is_deep {
        let decoded = surface.decode_rgbaf32().map_err(failed)?.data;
        let words = decoded.iter().map(|share| (share.clamp(0.0, 1.0) * 65_535.0).round() as u16).collect();
        ImageBuffer::from_raw(width, height, words).map(DynamicImage::ImageRgba16)
    } else {
        let decoded = surface.decode_rgba8().map_err(failed)?.data;
        ImageBuffer::from_raw(width, height, decoded).map(DynamicImage::ImageRgba8)
    };
    let rgba = rgba.ok_or_else(ends)?;
    Ok(match channels {
        // A single channel is decoded as red, and is no luminance of red.
        1 => {
            let red = rgba.to_rgb16().pixels().map(|p| p.0[0]).collect();
            DynamicImage::ImageLuma16(ImageBuffer::from_raw(width, height, red).ok_or_else(ends)?)
        }
        _ if is_opaque => DynamicImage::ImageRgb16(rgba.to_rgb16()),
        3 => DynamicImage::ImageRgb16(rgba.to_rgb16()),
        _ => rgba,
    })
}
