//! Image files as the finest level of a texture.

use super::bound::LARGEST_IMAGE_SIDE;
use crate::render::draw::texture::Level;
use image::{DynamicImage, ImageReader, Limits};
use serde::Deserialize;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

/// The most pixels of an image: those of a square of 8192.
const MOST_PIXELS: u64 = 1 << 26;

/// An image file.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImageFile {
    /// The file, relative to the scene file.
    pub file: PathBuf,
    /// Where alpha is taken from; by default the alpha channel, which must be there then.
    #[serde(default)]
    pub alpha: Channel,
}

/// Where the alpha of an image file is taken from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Channel {
    /// Its alpha channel.
    #[default]
    Alpha,
    /// Its luminance.
    Luminance,
}

/// An image that cannot cover a surface.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// It cannot be opened.
    #[error("cannot open {path}")]
    Open {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// It is no image, or a broken one.
    #[error("cannot read {path} as an image")]
    Decode {
        /// The file.
        path: PathBuf,
        /// What the decoder says.
        source: image::ImageError,
    },
    /// It has no pixels or too many.
    #[error(
        "{path} is {width} x {height} pixels; from 1 to 65535 along each side and 67 million in all are allowed"
    )]
    Size {
        /// The file.
        path: PathBuf,
        /// Its width in pixels.
        width: u32,
        /// Its height in pixels.
        height: u32,
    },
    /// It has no alpha channel.
    #[error("{path} has no alpha channel; write `alpha = \"luminance\"` to take its luminance")]
    NoAlpha {
        /// The file.
        path: PathBuf,
    },
}

/// Reads an image file.
///
/// # Errors
///
/// [`ImageError`], which names the file.
pub fn read(path: &Path, channel: Channel) -> Result<Level, ImageError> {
    let file = File::open(path).map_err(|source| ImageError::Open { path: path.into(), source })?;
    let decode = |source| ImageError::Decode { path: path.into(), source };
    let mut reader = ImageReader::new(BufReader::new(file))
        .with_guessed_format()
        .map_err(|source| ImageError::Open { path: path.into(), source })?;
    let mut limits = Limits::default();
    limits.max_image_width = Some(LARGEST_IMAGE_SIDE);
    limits.max_image_height = Some(LARGEST_IMAGE_SIDE);
    // Eight bytes a pixel, the most that a decoder asks for.
    limits.max_alloc = Some(MOST_PIXELS * 8 + (1 << 20));
    reader.limits(limits);
    level(&reader.decode().map_err(decode)?, channel, path)
}

/// Makes a level of a decoded image; `path` is for messages.
///
/// # Errors
///
/// [`ImageError::Size`] and [`ImageError::NoAlpha`].
pub fn level(image: &DynamicImage, channel: Channel, path: &Path) -> Result<Level, ImageError> {
    let (width, height) = (image.width(), image.height());
    let pixels = u64::from(width) * u64::from(height);
    if !(1..=MOST_PIXELS).contains(&pixels) || width.max(height) > LARGEST_IMAGE_SIDE {
        return Err(ImageError::Size { path: path.into(), width, height });
    }
    if channel == Channel::Alpha && !image.color().has_alpha() {
        return Err(ImageError::NoAlpha { path: path.into() });
    }
    let share = |word: u16| f32::from(word) / 65_535.0;
    let (alpha, colour) = match channel {
        Channel::Alpha => {
            image.to_rgba16().pixels().map(|p| (share(p.0[3]), [p.0[0], p.0[1], p.0[2]])).unzip()
        }
        // What is opaque is drawn in the dark colour of foliage: the luminance is no colour.
        Channel::Luminance => (image.to_luma16().pixels().map(|p| share(p.0[0])).collect(), Vec::new()),
    };
    Ok(Level { size: [width, height], alpha, colour })
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{GrayImage, RgbaImage};

    #[test]
    fn alpha_comes_from_its_channel_or_from_luminance() {
        let path = Path::new("leaf.png");
        let mut rgba = RgbaImage::new(2, 1);
        rgba.put_pixel(1, 0, image::Rgba([255, 0, 0, 51]));
        let found = level(&rgba.into(), Channel::Alpha, path).unwrap();
        assert_eq!((found.alpha, found.colour), (vec![0.0, 0.2], vec![[0, 0, 0], [65_535, 0, 0]]));
        let grey = DynamicImage::from(GrayImage::from_pixel(1, 1, image::Luma([255])));
        assert!(matches!(level(&grey, Channel::Alpha, path), Err(ImageError::NoAlpha { .. })));
        assert_eq!(level(&grey, Channel::Luminance, path).unwrap().alpha, [1.0]);
        let empty = DynamicImage::from(GrayImage::new(0, 3));
        assert!(matches!(level(&empty, Channel::Luminance, path), Err(ImageError::Size { .. })));
    }
}
