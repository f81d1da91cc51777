//! Alpha from the finest level (§3): [`finest_level`](crate::technique::prior_work::finest_level).

use super::kind::{About, Effect, Role, Rules, Technique};
use crate::render::draw::plan::{Plan, Text, tell};
use serde::Deserialize;

/// Alpha from the finest level.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FinestLevel {}

impl Effect for FinestLevel {
    const ABOUT: About = About {
        citation: "§3",
        does: "Reads alpha from the finest level, however far the surface",
        costs: "texels: as many, but far apart",
        bounds: &[],
        techniques: &[Technique {
            name: "finest-level",
            source: "§3",
            claim: "Alpha from the finest level keeps its variance, and costs a second fetch and temporal stability.",
            shown: ["mips-and-wires", "finest level"],
        }],
    };

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Level, Role::Finest])
    }

    fn plan(&self, plan: &mut Plan) {
        plan.before(tell("sample alpha: at level 0", &[], Text::None), |setup| {
            setup.coarsest = Some(0.0);
            // Who reads one level alone needs no derivatives to choose it.
            setup.needs.texture_derivatives = false;
        });
    }
}
