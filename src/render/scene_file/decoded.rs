//! Decoded images, and why one cannot be.

use image::DynamicImage;
use std::path::{Path, PathBuf};
use std::{fs, io};

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
    /// It is of a kind that is not read here, or not what it says.
    #[error("{path} {what}")]
    Kind {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        what: String,
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
    /// It has more pixels than its model may still have.
    #[error(
        "{path} is {width} x {height} pixels: with it the images of the model are more than 134 million, counted once for each material that has one"
    )]
    Total {
        /// The file.
        path: PathBuf,
        /// Its width in pixels.
        width: u32,
        /// Its height in pixels.
        height: u32,
    },
    /// It has no alpha channel.
    #[error(
        "{path} has no alpha channel; write `alpha = \"luminance\"` to take its luminance, `alpha = \"red\"` to take one channel, or \
         `alpha_file` to take another image"
    )]
    NoAlpha {
        /// The file.
        path: PathBuf,
    },
}

/// A decoded image.
#[derive(Clone, Debug)]
pub(super) struct Decoded {
    /// Its levels, the finest first; one for files that have no others.
    pub(super) levels: Vec<DynamicImage>,
    /// Whether the file says that its colours are multiplied by its alpha.
    pub(super) premultiplied: bool,
}

/// Reads a file as a whole. What is no regular file, as a device, might never end.
pub(super) fn read_file(path: &Path) -> io::Result<Vec<u8>> {
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is no regular file"));
    }
    fs::read(path)
}
