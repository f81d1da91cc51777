//! The figures of the sources as scenes, each with the sentence that it must show.

use super::scene_file::read::read;

pub use super::effect::{BuiltIn, GALLERY};

/// Returns the scene file of a name.
#[must_use]
pub fn find(name: &str) -> Option<&'static BuiltIn> {
    GALLERY.iter().find(|scene| scene.name == name)
}

/// Returns the sentence that a scene must show; empty where it has none.
#[must_use]
pub fn sentence(scene: &BuiltIn) -> String {
    read(scene.text, scene.name).ok().and_then(|scene| scene.sentence).unwrap_or_default()
}
