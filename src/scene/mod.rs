//! What is looked at: a pinhole camera, surfaces with a closed form, and the footprints that the two make.
//!
//! What never lives here: thresholds and their statistics, drawing, files.

pub mod camera;
pub mod fragment;
pub mod gallery;
pub mod posed;
pub mod raster;
pub mod rectangle;

pub use camera::{Camera, Ray};
pub use fragment::Fragment;
pub use gallery::Scene;
pub use raster::Raster;
pub use rectangle::Rectangle;
