//! Alphas scaled by level (Castano 2010): [`scaled_alpha`](crate::technique::prior_work::scaled_alpha).

use super::kind::{About, Effect, Plan, Role, Rules, Text, techniques, tell};
use crate::render::draw::texture::{Change, REFERENCE, Texture};
use crate::technique::prior_work::scaled_alpha::{alpha_scale, scaled};
use serde::Deserialize;

/// Alphas scaled by level.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScaledAlpha {}

impl Effect for ScaledAlpha {
    const ABOUT: About = About::new(
        "§3 (Castano 2010)",
        "Scales the stored alphas of each level to that effect",
        "nothing; a pass over the texture beforehand",
    )
    .techniques(techniques![
        "scaled-alpha": "§3 (Castano 2010)", "castano" / "scaled alpha",
            "Scaled alphas are equivalent to a threshold for each level, and dilate thin geometry.";
    ]);

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Scale])
    }

    fn plan(&self, plan: &mut Plan) {
        let told = tell("adjust alpha: scaled for each level, beforehand", &[], Text::None);
        plan.before(told, |setup| {
            let change = Change { name: "scaled alpha", parameter: 0, run: |texture, _| scale(texture) };
            setup.textures.changes.push(change);
        });
    }
}

fn scale(texture: &mut Texture) {
    let share = texture.levels[0].alphas().passing_share(REFERENCE);
    for level in texture.levels.iter_mut().skip(1) {
        level.alpha = scaled(level.alphas(), alpha_scale(level.alphas(), share, REFERENCE));
    }
}
