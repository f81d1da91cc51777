//! Image files as the levels of a texture.

use super::bound::LARGEST_IMAGE_SIDE;
use super::compressed;
pub use super::decoded::ImageError;
use super::decoded::{Decoded, read_file};
use crate::render::draw::texture::Level;
use image::imageops::FilterType;
use image::{DynamicImage, GenericImageView, ImageDecoder, ImageFormat, ImageReader, Limits};
use serde::Deserialize;
use std::io::Cursor;
use std::path::{Path, PathBuf};

/// The most pixels of an image: those of a square of 8192.
const MOST_PIXELS: u64 = 1 << 26;

/// An image file.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImageFile {
    /// The file, relative to the scene file: PNG, JPEG, WebP, TGA, DDS or KTX2.
    pub file: PathBuf,
    /// Where alpha is taken from; by default the alpha channel, which must be there then.
    pub alpha: Option<Channel>,
    /// Another image that alpha is taken from, relative to the scene file; by default from its alpha channel, or from its luminance
    /// where it has none.
    pub alpha_file: Option<PathBuf>,
    /// Whether its colours are multiplied by its alpha already.
    #[serde(default)]
    pub premultiplied: bool,
}

/// Where the alpha of an image file is taken from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Channel {
    /// Its alpha channel.
    Alpha,
    /// Its luminance.
    Luminance,
    /// Its red channel.
    Red,
    /// Its green channel.
    Green,
    /// Its blue channel.
    Blue,
}

impl Decoded {
    /// Decodes the bytes of a file; `path` is for messages, and tells TGA, which has no mark of its own. Of the finest level no more
    /// than `most` pixels are decoded.
    ///
    /// # Errors
    ///
    /// [`ImageError`], which names the file.
    pub(super) fn new(bytes: &[u8], path: &Path, most: u64) -> Result<Self, ImageError> {
        if let Some(decoded) = compressed::decode(bytes, path, &|size| check_size(size, path, most)) {
            return decoded;
        }
        let failed = |source| ImageError::Decode { path: path.into(), source };
        let mut reader = ImageReader::new(Cursor::new(bytes));
        let is_tga = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("tga"));
        reader =
            reader.with_guessed_format().map_err(|source| ImageError::Open { path: path.into(), source })?;
        if is_tga && reader.format().is_none() {
            reader.set_format(ImageFormat::Tga);
        }
        let mut decoder = reader.into_decoder().map_err(failed)?;
        let (width, height) = decoder.dimensions();
        check_size([width, height], path, most)?;
        let mut limits = Limits::default();
        limits.max_image_width = Some(LARGEST_IMAGE_SIDE);
        limits.max_image_height = Some(LARGEST_IMAGE_SIDE);
        // Eight bytes a pixel, the most that a decoder asks for.
        limits.max_alloc = Some(MOST_PIXELS * 8 + (1 << 20));
        decoder.set_limits(limits).map_err(failed)?;
        let image = DynamicImage::from_decoder(decoder).map_err(failed)?;
        Ok(Self { levels: vec![image], premultiplied: false })
    }

    /// The same with an alpha channel, opaque where it had none.
    pub(super) fn with_alpha(mut self) -> Self {
        if !self.levels[0].color().has_alpha() {
            self.levels =
                self.levels.iter().map(|level| DynamicImage::ImageRgba16(level.to_rgba16())).collect();
        }
        self
    }

    /// Its levels with the alpha of a channel.
    ///
    /// # Errors
    ///
    /// [`ImageError::NoAlpha`].
    pub(super) fn levels(&self, channel: Channel, path: &Path) -> Result<Vec<Level>, ImageError> {
        self.levels.iter().map(|image| level(image, channel, self.premultiplied, path)).collect()
    }
}

/// Reads the levels of an image file, and tells in `notes` what looks like a mistake in it.
///
/// # Errors
///
/// [`ImageError`], which names the file.
pub(super) fn read(
    file: &ImageFile,
    folder: &Path,
    notes: &mut Vec<String>,
) -> Result<Vec<Level>, ImageError> {
    let open = |path: &Path| -> Result<Decoded, ImageError> {
        let bytes = read_file(path).map_err(|source| ImageError::Open { path: path.into(), source })?;
        Decoded::new(&bytes, path, MOST_PIXELS)
    };
    let path = folder.join(&file.file);
    let mut image = open(&path)?;
    image.premultiplied |= file.premultiplied;
    let (levels, channel, shown) = match &file.alpha_file {
        None => {
            let channel = file.alpha.unwrap_or(Channel::Alpha);
            tell_weighted(&image, channel, &file.file, notes);
            (image.levels(channel, &path)?, channel, &file.file)
        }
        Some(alpha_file) => {
            let alpha_path = folder.join(alpha_file);
            let alpha = open(&alpha_path)?;
            let without =
                if alpha.levels[0].color().has_alpha() { Channel::Alpha } else { Channel::Luminance };
            let channel = file.alpha.unwrap_or(without);
            tell_weighted(&alpha, channel, alpha_file, notes);
            (beside(alpha.levels(channel, &alpha_path)?, &image), channel, alpha_file)
        }
    };
    if levels[0].alpha.iter().all(|&alpha| alpha == 1.0) {
        notes.push(format!("{}: {} is opaque everywhere", shown.display(), channel.says()));
    }
    Ok(levels)
}

impl Channel {
    const fn says(self) -> &'static str {
        match self {
            Self::Alpha => "its alpha channel",
            Self::Luminance => "its luminance",
            Self::Red => "its red channel",
            Self::Green => "its green channel",
            Self::Blue => "its blue channel",
        }
    }
}

/// Puts the colours of another image, fitted to their sizes, beside alphas.
fn beside(mut levels: Vec<Level>, image: &Decoded) -> Vec<Level> {
    for level in &mut levels {
        let [width, height] = level.size;
        let finest = &image.levels[0];
        let is_fitting = finest.dimensions() == (width, height);
        let fitted = (!is_fitting).then(|| finest.resize_exact(width, height, FilterType::Triangle));
        let colours = fitted.as_ref().unwrap_or(finest).to_rgb16();
        level.colour =
            colours.pixels().zip(&level.alpha).map(|(p, &a)| divided(p.0, a, image.premultiplied)).collect();
    }
    levels
}

/// Tells where luminance is not what any channel holds, as of a mask that is packed in one of them.
fn tell_weighted(image: &Decoded, channel: Channel, file: &Path, notes: &mut Vec<String>) {
    if channel != Channel::Luminance || !image.levels[0].color().has_color() {
        return;
    }
    let mean = |channel| {
        let level = level(&image.levels[0], channel, false, file).ok()?;
        Some(level.alphas().mean())
    };
    let channels = [Channel::Luminance, Channel::Red, Channel::Green, Channel::Blue].map(mean);
    if let [Some(luminance), Some(red), Some(green), Some(blue)] = channels
        && [red, green, blue].iter().any(|mean| (mean - luminance).abs() > 0.05)
    {
        notes.push(format!(
            "{}: its luminance is {luminance:.2} in the mean, its red, green and blue {red:.2}, {green:.2} and {blue:.2}; for a mask \
             that is packed in one channel write `alpha = \"red\"`, \"green\" or \"blue\"",
            file.display()
        ));
    }
}

/// Finds an image of no pixels or of too many.
fn check_size([width, height]: [u32; 2], path: &Path, most: u64) -> Result<(), ImageError> {
    let pixels = u64::from(width) * u64::from(height);
    if !(1..=MOST_PIXELS).contains(&pixels) || width.max(height) > LARGEST_IMAGE_SIDE {
        return Err(ImageError::Size { path: path.into(), width, height });
    }
    if pixels > most {
        return Err(ImageError::Total { path: path.into(), width, height });
    }
    Ok(())
}

/// Makes a level of a decoded image; `path` is for messages.
fn level(
    image: &DynamicImage,
    channel: Channel,
    premultiplied: bool,
    path: &Path,
) -> Result<Level, ImageError> {
    if channel == Channel::Alpha && !image.color().has_alpha() {
        return Err(ImageError::NoAlpha { path: path.into() });
    }
    let share = |word: u16| f32::from(word) / 65_535.0;
    let of_rgb = |c: usize| image.to_rgb16().pixels().map(|p| share(p.0[c])).collect();
    // Where alpha is a channel of colour, that is no colour: what is opaque is drawn in the dark colour of foliage.
    let alpha = match channel {
        Channel::Alpha => {
            let (alpha, colour) = image
                .to_rgba16()
                .pixels()
                .map(|p| (share(p.0[3]), divided([p.0[0], p.0[1], p.0[2]], share(p.0[3]), premultiplied)))
                .unzip();
            return Ok(Level { size: image.dimensions().into(), alpha, colour });
        }
        Channel::Luminance => image.to_luma16().pixels().map(|p| share(p.0[0])).collect(),
        Channel::Red => of_rgb(0),
        Channel::Green => of_rgb(1),
        Channel::Blue => of_rgb(2),
    };
    Ok(Level { size: image.dimensions().into(), alpha, colour: Vec::new() })
}

/// A colour divided by its alpha if it is multiplied by it.
fn divided(colour: [u16; 3], alpha: f32, premultiplied: bool) -> [u16; 3] {
    if !premultiplied || alpha <= 0.0 {
        return colour;
    }
    colour.map(|c| (f32::from(c) / alpha).round().min(65_535.0) as u16)
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{GrayImage, Rgb, RgbImage, RgbaImage};

    #[test]
    fn alpha_comes_from_its_channel_or_from_luminance() {
        let path = Path::new("leaf.png");
        let mut rgba = RgbaImage::new(2, 1);
        rgba.put_pixel(1, 0, image::Rgba([255, 0, 0, 51]));
        let rgba = DynamicImage::from(rgba);
        let found = level(&rgba, Channel::Alpha, false, path).unwrap();
        assert_eq!((found.alpha, found.colour), (vec![0.0, 0.2], vec![[0, 0, 0], [65_535, 0, 0]]));
        let grey = DynamicImage::from(GrayImage::from_pixel(1, 1, image::Luma([255])));
        assert!(matches!(level(&grey, Channel::Alpha, false, path), Err(ImageError::NoAlpha { .. })));
        assert_eq!(level(&grey, Channel::Luminance, false, path).unwrap().alpha, [1.0]);
        let packed = DynamicImage::from(RgbImage::from_pixel(1, 1, Rgb([51, 102, 204])));
        for (channel, alpha) in [(Channel::Red, 0.2), (Channel::Green, 0.4), (Channel::Blue, 0.8)] {
            let found = level(&packed, channel, false, path).unwrap();
            assert_eq!((found.alpha, found.colour), (vec![alpha], vec![]), "{channel:?}");
        }
    }

    #[test]
    fn colours_that_are_multiplied_by_alpha_are_divided_by_it() {
        let rgba = DynamicImage::from(RgbaImage::from_pixel(1, 1, image::Rgba([51, 102, 0, 102])));
        let found = |premultiplied| {
            level(&rgba, Channel::Alpha, premultiplied, Path::new("leaf.png")).unwrap().colour
        };
        assert_eq!(found(false), [[13_107, 26_214, 0]]);
        assert_eq!(found(true), [[32_768, 65_535, 0]]);
        // What nothing is left of stays.
        assert_eq!(divided([9, 0, 0], 0.0, true), [9, 0, 0]);
    }
}
