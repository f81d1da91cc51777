//! Scene files: TOML in, a checked scene with all that it names out.
//!
//! | module | holds |
//! |---|---|
//! | [`schema`] | what a file may have |
//! | [`read`] | a file's text, checked |
//! | [`bound`], `limits` | bounds of its numbers, one by one and together |
//! | [`diagnostic`], `spans` | what is wrong at which key, and where that stands |
//! | [`load`] | a file with all that it names |
//! | [`surface`], [`procedural`] | what surfaces and built-in textures are made of |
//! | [`mod@image`], `compressed`, `decoded`, [`mod@gltf`] | where other textures and meshes come from |

pub mod bound;
mod compressed;
mod decoded;
pub mod diagnostic;
pub mod gltf;
pub mod image;
mod limits;
pub mod load;
pub mod procedural;
pub mod read;
pub mod schema;
mod spans;
pub mod surface;
