//! Alphas scaled by level (Castano 2010): [`scaled_alpha`](crate::technique::prior_work::scaled_alpha).

use super::kind::{About, Effect, Role, Rules, Technique};
use crate::render::draw::plan::{Plan, Text, tell};
use crate::render::draw::texture::{Change, REFERENCE, Texture};
use crate::technique::prior_work::scaled_alpha::{alpha_scale, scaled};
use serde::Deserialize;

/// Alphas scaled by level.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScaledAlpha {}

impl Effect for ScaledAlpha {
    const ABOUT: About = About {
        citation: "§3 (Castano 2010)",
        does: "Scales the stored alphas of each level to that effect",
        costs: "nothing; a pass over the texture beforehand",
        bounds: &[],
        techniques: &[Technique {
            name: "scaled-alpha",
            source: "§3 (Castano 2010)",
            claim: "Scaled alphas are equivalent to a threshold for each level, and dilate thin geometry.",
            shown: ["castano", "scaled alpha"],
        }],
    };

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
