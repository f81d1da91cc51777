//! Scene files: TOML in, a checked scene with all that it names out.
//!
//! | module | holds |
//! |---|---|
//! | [`schema`] | what a file may have |
//! | [`read`] | a file's text, checked |
//! | `limits`, `spans`, `suggest` | bounds of its numbers, where its keys stand, what was likely meant |
//! | [`load`] | a file with all that it names |
//! | [`surface`], [`procedural`] | what surfaces and built-in textures are made of |
//! | [`mod@image`], [`mod@gltf`] | where other textures and meshes come from |

pub mod gltf;
pub mod image;
mod limits;
pub mod load;
pub mod procedural;
pub mod read;
pub mod schema;
mod spans;
pub(in crate::render) mod suggest;
pub mod surface;
