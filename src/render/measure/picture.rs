//! Pictures: colours and coverage of an image, and what is made of several.

use core::num::NonZeroU32;
use glam::DVec2;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{Rgb, RgbImage};
use serde::Deserialize;

/// An image with, at each pixel, a colour and the share of it that surfaces cover.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Colours, row by row, in [0, 1].
    pub colour: Vec<[f32; 3]>,
    /// Shares, row by row, in [0, 1].
    pub coverage: Vec<f32>,
}

/// A part of the picture whose coverage is a number of its own.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Region {
    /// What its numbers are called.
    pub name: String,
    /// Its upper left pixel.
    pub corner: [u32; 2],
    /// Its width and height in pixels.
    pub size: [u32; 2],
}

/// A part of the picture, enlarged.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Inset {
    /// Its upper left pixel.
    pub corner: [u32; 2],
    /// Its width and height in pixels.
    pub size: [u32; 2],
    /// How many times it is enlarged.
    pub times: NonZeroU32,
}

/// The colour of what no surface covers.
pub const SKY: [f32; 3] = [0.93, 0.95, 0.98];

/// The colour of a surface whose texture has none: dark green.
pub const LEAF: [f32; 3] = [0.1, 0.27, 0.08];

/// Room between pictures side by side, in pixels.
const GAP: u32 = 4;

impl Picture {
    /// Makes a picture of sky.
    #[must_use]
    pub fn sky(size: [u32; 2]) -> Self {
        let pixels = (size[0] * size[1]) as usize;
        Self { size, colour: vec![SKY; pixels], coverage: vec![0.0; pixels] }
    }

    /// Returns the mean coverage, in [0, 1].
    #[must_use]
    pub fn mean_coverage(&self) -> f64 {
        self.coverage.iter().map(|&share| f64::from(share)).sum::<f64>() / self.coverage.len().max(1) as f64
    }

    /// Returns colour and coverage at a place, in pixels from the upper left corner, mixed of the four pixels around it;
    /// `None` outside of the picture.
    #[must_use]
    pub fn at(&self, place: DVec2) -> Option<([f32; 3], f32)> {
        let inside = |axis: usize| (0.0..f64::from(self.size[axis])).contains(&place[axis]);
        if !(inside(0) && inside(1)) {
            return None;
        }
        let [across, down] = [0, 1].map(|axis| {
            // Half of the outermost pixels lies beyond the last centre.
            let last = self.size[axis] - 1;
            let along = (place[axis] - 0.5).clamp(0.0, f64::from(last));
            let first = along as u32;
            [(first, 1.0 - (along - f64::from(first))), ((first + 1).min(last), along - f64::from(first))]
        });
        let (mut colour, mut coverage) = ([0.0; 3], 0.0);
        for (y, of_row) in down {
            for (x, of_pixel) in across {
                let (at, share) = ((y * self.size[0] + x) as usize, (of_row * of_pixel) as f32);
                colour = [0, 1, 2].map(|c| colour[c] + share * self.colour[at][c]);
                coverage += share * self.coverage[at];
            }
        }
        Some((colour, coverage))
    }

    /// Returns the picture in which each pixel is the mean of a square of so many along each side.
    ///
    /// The size must be a multiple of `side`.
    #[must_use]
    pub fn downsample(&self, side: u32) -> Self {
        let size = self.size.map(|pixels| pixels / side);
        let mut small = Self::sky(size);
        let share = 1.0 / (side * side) as f32;
        for y in 0..size[1] {
            for x in 0..size[0] {
                let (mut colour, mut coverage) = ([0.0; 3], 0.0);
                for j in 0..side {
                    for i in 0..side {
                        let at = ((y * side + j) * self.size[0] + x * side + i) as usize;
                        colour = [0, 1, 2].map(|c| colour[c] + self.colour[at][c] * share);
                        coverage += self.coverage[at] * share;
                    }
                }
                let at = (y * size[0] + x) as usize;
                (small.colour[at], small.coverage[at]) = (colour, coverage);
            }
        }
        small
    }

    /// Returns the mean of pictures of one size; sky of no size for none.
    #[must_use]
    pub fn mean<'a>(pictures: impl ExactSizeIterator<Item = &'a Self>) -> Self {
        let share = 1.0 / pictures.len().max(1) as f32;
        let mut mean = Self::default();
        for (index, picture) in pictures.enumerate() {
            if index == 0 {
                mean = Self { colour: vec![[0.0; 3]; picture.colour.len()], ..Self::sky(picture.size) };
            }
            for (sum, colour) in mean.colour.iter_mut().zip(&picture.colour) {
                *sum = [0, 1, 2].map(|c| sum[c] + colour[c] * share);
            }
            for (sum, coverage) in mean.coverage.iter_mut().zip(&picture.coverage) {
                *sum += coverage * share;
            }
        }
        mean
    }

    /// Returns the colours as 8 bits a channel.
    #[must_use]
    pub fn to_rgb(&self) -> RgbImage {
        let bytes = |colour: &[f32; 3]| colour.map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8);
        let raw = self.colour.iter().flat_map(bytes).collect();
        RgbImage::from_raw(self.size[0], self.size[1], raw).unwrap_or_default()
    }
}

/// Returns the difference of two pictures of one size, inverted as in Fig. 13: white where they agree.
#[must_use]
pub fn difference(a: &Picture, b: &Picture) -> RgbImage {
    let inverted =
        a.colour.iter().zip(&b.colour).flat_map(|(a, b)| {
            [0, 1, 2].map(|c| (255.0 * (1.0 - (a[c] - b[c]).abs().min(1.0))).round() as u8)
        });
    RgbImage::from_raw(a.size[0], a.size[1], inverted.collect()).unwrap_or_default()
}

/// Enlarges a part of an image, each pixel to a square.
#[must_use]
pub fn enlarge(image: &RgbImage, inset: &Inset) -> RgbImage {
    let times = inset.times.get();
    let [left, top] = inset.corner;
    let [width, height] = inset.size;
    RgbImage::from_fn(width * times, height * times, |x, y| {
        let (x, y) = (left + x / times, top + y / times);
        image.get_pixel_checked(x, y).copied().unwrap_or(Rgb([255; 3]))
    })
}

/// Puts rows of images on white, each row from left to right.
#[must_use]
pub fn sheet(rows: &[Vec<RgbImage>]) -> RgbImage {
    let width_of =
        |row: &Vec<RgbImage>| row.iter().map(|image| image.width() + GAP).sum::<u32>().saturating_sub(GAP);
    let height_of = |row: &Vec<RgbImage>| row.iter().map(RgbImage::height).max().unwrap_or(0);
    let width = rows.iter().map(width_of).max().unwrap_or(0);
    let height = rows.iter().map(|row| height_of(row) + GAP).sum::<u32>().saturating_sub(GAP);
    let mut sheet = RgbImage::from_pixel(width, height, Rgb([255; 3]));
    let mut top = 0;
    for row in rows {
        let mut left = 0;
        for image in row {
            image::imageops::replace(&mut sheet, image, i64::from(left), i64::from(top));
            left += image.width() + GAP;
        }
        top += height_of(row) + GAP;
    }
    sheet
}

/// Encodes an image as PNG.
///
/// # Errors
///
/// What the encoder says, as of an image without pixels.
pub fn png(image: &RgbImage) -> Result<Vec<u8>, image::ImageError> {
    let mut bytes = Vec::new();
    image.write_with_encoder(PngEncoder::new_with_quality(
        &mut bytes,
        CompressionType::Best,
        FilterType::NoFilter,
    ))?;
    Ok(bytes)
}

/// Encodes images of one size as an animated PNG of so many images a second that repeats for ever.
///
/// # Errors
///
/// What the encoder says, as of no image at all or of images of several sizes.
pub fn animation(images: &[RgbImage], per_second: u16) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let (width, height) = images.first().map_or((0, 0), RgbImage::dimensions);
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_animated(images.len() as u32, 0)?;
    encoder.set_frame_delay(1, per_second)?;
    let mut writer = encoder.write_header()?;
    for image in images {
        writer.write_image_data(image.as_raw())?;
    }
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(size: [u32; 2], share: f32) -> Picture {
        let pixels = (size[0] * size[1]) as usize;
        Picture { size, colour: vec![[share; 3]; pixels], coverage: vec![share; pixels] }
    }

    #[test]
    fn means_are_means() {
        let mean = Picture::mean([grey([4, 2], 0.0), grey([4, 2], 0.5)].iter());
        assert_eq!(mean, grey([4, 2], 0.25));
        assert_eq!(mean.downsample(2), grey([2, 1], 0.25));
    }

    #[test]
    fn between_pixels_is_their_mixture() {
        let mut picture = grey([3, 2], 0.0);
        picture.coverage = vec![0.0, 1.0, 0.5, 0.0, 0.0, 0.5];
        let at = |x: f64, y: f64| picture.at(DVec2::new(x, y)).map(|(_, coverage)| coverage);
        assert_eq!([at(1.5, 0.5), at(1.0, 0.5), at(2.0, 1.0)], [Some(1.0), Some(0.5), Some(0.5)]);
        assert_eq!([at(0.0, 0.2), at(2.99, 1.9)], [Some(0.0), Some(0.5)]);
        assert_eq!([at(-0.01, 0.5), at(3.0, 0.5), at(1.0, 2.0), at(f64::NAN, 1.0)], [None; 4]);
    }

    #[test]
    fn equal_pictures_differ_by_white() {
        let [a, b] = [0.2, 0.7].map(|share| grey([2, 2], share));
        assert_eq!(difference(&a, &a).get_pixel(0, 0).0, [255; 3]);
        assert!(difference(&a, &b).get_pixel(0, 0).0[0].abs_diff(128) <= 1);
    }

    #[test]
    fn sheets_and_files_have_their_size() {
        let image = grey([3, 2], 0.5).to_rgb();
        let inset = Inset { corner: [2, 1], size: [2, 2], times: core::num::NonZeroU32::new(3).unwrap() };
        let large = enlarge(&image, &inset);
        assert_eq!((large.dimensions(), large.get_pixel(5, 5).0), ((6, 6), [255; 3]));
        let sheet = sheet(&[vec![image.clone(), image.clone()], vec![large]]);
        assert_eq!(sheet.dimensions(), (3 + GAP + 3, 2 + GAP + 6));
        let read = image::load_from_memory(&png(&sheet).unwrap()).unwrap();
        assert_eq!(read.to_rgb8(), sheet);
        let moving = animation(&[image.clone(), image.clone()], 10).unwrap();
        assert_eq!(image::load_from_memory(&moving).unwrap().to_rgb8(), image);
        assert!(animation(&[], 10).is_err());
    }
}
