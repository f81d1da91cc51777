//! Alpha from the finest level (§3): [`finest_level`](crate::technique::prior_work::finest_level).

use super::kind::{About, Effect, Plan, Role, Rules, Text, techniques, tell};
use serde::Deserialize;

/// Alpha from the finest level.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FinestLevel {}

impl Effect for FinestLevel {
    const ABOUT: About = About::new(
        "§3",
        "Reads alpha from the finest level, however far the surface",
        "texels: as many, but far apart",
    )
    .techniques(techniques![
        "finest-level": "§3", "mips-and-wires" / "finest level",
            "Alpha from the finest level keeps its variance, and costs a second fetch and temporal stability.";
    ]);

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
