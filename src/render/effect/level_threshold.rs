//! A threshold for each level (§3, Eq. 1): [`level_threshold`](crate::technique::prior_work::level_threshold).

use super::kind::{About, Effect, Phase, Plan, Role, Rules, Text, techniques, tell};
use crate::render::draw::texture::{Change, Texture};
use crate::technique::prior_work::level_threshold::level_threshold;
use crate::threshold::pipeline::Source;
use serde::Deserialize;

/// A threshold a level.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LevelThreshold {}

impl Effect for LevelThreshold {
    const ABOUT: About = About::new(
        "§3, Eq. 1",
        "Compares with a threshold for each level, so that all pass the share of the finest",
        "nothing but the test; a pass over the texture beforehand",
    )
    .techniques(techniques![
        "level-threshold": "§3, Eq. 1", "mips-and-wires" / "a threshold a level",
            "A threshold for each level keeps the share of passing texels; geometry can still vanish.";
    ]);

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Threshold, Role::Varied])
    }

    fn plan(&self, plan: &mut Plan) {
        plan.before(tell("threshold: that of the level, found beforehand", &[], Text::None), |setup| {
            let change = Change { name: "level threshold", parameter: 0, run: |texture, _| find(texture) };
            setup.textures.changes.push(change);
            setup.source(Source::Given);
        });
        let told = tell("read threshold: mixed between levels as alpha is", &[], Text::None);
        plan.shade(Phase::Alpha, told, |shading, work, _| {
            let triangles = work.fragments.triangle.iter().zip(&work.access);
            let given =
                triangles.map(|(&triangle, access)| shading.texture(triangle).level_threshold(access));
            work.given.clear();
            work.given.extend(given);
        });
    }
}

fn find(texture: &mut Texture) {
    let share = texture.levels[0].alphas().passing_share(texture.reference());
    texture.thresholds = texture.levels.iter().map(|level| level_threshold(level.alphas(), share)).collect();
    // The share of the finest level is that of the reference itself.
    texture.thresholds[0] = texture.reference();
}
