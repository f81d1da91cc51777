//! What is done to textures before anything is drawn: the remedies of §3 that bake coverage into the levels.

use super::texture::Scaling;
use super::texture::{Level, Texture, TextureNeeds};
use crate::render::scene_file::load::Scene;
use crate::technique::prior_work;
use crate::technique::prior_work::level_threshold::level_threshold;
use crate::technique::prior_work::scaled_alpha::{alpha_scale, scaled, scaled_by_texel};

/// The threshold of the finest level, of which the other levels keep the share.
const REFERENCE: f32 = 0.5;

/// Builds the textures that a plan needs.
#[must_use]
pub fn textures(scene: &Scene, needs: TextureNeeds) -> Vec<Texture> {
    let mut textures = scene.textures(needs.premultiplied);
    for texture in &mut textures {
        let share = view(&texture.levels[0]).passing_share(REFERENCE);
        if needs.thresholds {
            texture.thresholds =
                texture.levels.iter().map(|level| level_threshold(view(level), share)).collect();
            // The share of the finest level is that of the reference itself.
            texture.thresholds[0] = REFERENCE;
        }
        if let Some(scaling) = needs.scaling {
            let base = texture.levels[0].clone();
            for level in texture.levels.iter_mut().skip(1) {
                level.alpha = scale(view(level), view(&base), share, scaling);
            }
        }
    }
    textures
}

fn scale(
    level: prior_work::Level<'_>,
    base: prior_work::Level<'_>,
    share: f64,
    scaling: Scaling,
) -> Vec<f32> {
    match scaling {
        // A map whose sides are no powers of two has no whole number of base texels under each texel.
        Scaling::Texels(radius)
            if base.width.is_multiple_of(level.width) && base.height.is_multiple_of(level.height) =>
        {
            scaled_by_texel(level, base, REFERENCE, radius)
        }
        _ => scaled(level, alpha_scale(level, share, REFERENCE)),
    }
}

fn view(level: &Level) -> prior_work::Level<'_> {
    let [width, height] = level.size.map(|side| side as usize);
    prior_work::Level { texels: &level.alpha, width, height }
}
