//! Alpha from no level coarser than a given one (§3): [`finest_level`](crate::technique::prior_work::finest_level).

use super::kind::{About, Bound, Effect, Plan, Role, Rules, Text, techniques, tell};
use serde::Deserialize;

/// Alpha from no coarser level.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LimitedLevel {
    /// The coarsest level that is read.
    pub level: f32,
}

impl Effect for LimitedLevel {
    const ABOUT: About = About::new(
        "§3",
        "Reads alpha from no level coarser than a given one",
        "texels: as many, but further apart",
    )
    .bounds(&[("level", Bound::From(0.0, 64.0))])
    .techniques(techniques![
        "limited-level": "§3", "mips-and-wires" / "no coarser than level 3",
            "Levels beyond a limit are not read; the cost is that of the finest level, put off.";
    ]);

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
