//! Blending without a test (§3): [`test_then_blend`](crate::technique::prior_work::test_then_blend).

use super::kind::{About, Cost, Effect, Per, Phase, Plan, Role, Rules, Text, techniques, tell};
use crate::technique::prior_work::test_then_blend::naive;
use serde::Deserialize;

/// Blending without a test.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NaiveBlend {}

impl Effect for NaiveBlend {
    const ABOUT: About = About::new(
        "§3",
        "Blends every fragment as it comes, with depth and without a test",
        "blends: 1 a fragment; no tests",
    )
    .techniques(techniques![
        "naive-blend": "§3", "blending" / "naive blend",
            "Blending in any order with depth writes leaves halos.";
    ]);

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Blends])
            .never(Role::Test, "the first tests nothing and the second does")
            .never(Role::Threshold, "the first tests nothing and the second does")
    }

    fn plan(&self, plan: &mut Plan) {
        plan.before(tell("no test: no thresholds", &[], Text::Impossible("nothing is tested")), |setup| {
            setup.pipeline = None;
        });
        let says = "blend: every fragment as it comes, each hiding what comes later behind it";
        let told = tell(says, &[(Per::Fragment, Cost::blends(1))], Text::None);
        plan.shade(Phase::Blend, told, |shading, work, result| shading.blend(work, naive, result));
    }
}
