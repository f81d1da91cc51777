//! Alpha from no level coarser than a given one (§3): [`finest_level`](crate::technique::prior_work::finest_level).

use super::kind::{About, Effect, Role, Rules, Technique};
use crate::render::draw::plan::{Plan, Text, tell};
use crate::render::scene_file::bound::Bound;
use serde::Deserialize;

/// Alpha from no coarser level.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LimitedLevel {
    /// The coarsest level that is read.
    pub level: f32,
}

impl Effect for LimitedLevel {
    const ABOUT: About = About {
        citation: "§3",
        does: "Reads alpha from no level coarser than a given one",
        costs: "texels: as many, but further apart",
        bounds: &[("level", Bound::From(0.0, 64.0))],
        techniques: &[Technique {
            name: "limited-level",
            source: "§3",
            claim: "Levels beyond a limit are not read; the cost is that of the finest level, put off.",
            shown: ["mips-and-wires", "no coarser than level 3"],
        }],
    };

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Level])
    }

    fn plan(&self, plan: &mut Plan) {
        let says = format!("sample alpha: no coarser than level {}", self.level);
        plan.before(tell(says, &[], Text::None), |setup| {
            setup.coarsest = Some(self.level);
            setup.needs.texture_derivatives = self.level > 0.0;
        });
    }
}
