//! One threshold for all: [`fixed`](crate::threshold::fixed).

use super::kind::{About, Bound, Effect, Plan, Role, Rules, Text, techniques, tell};
use crate::threshold::pipeline::Source;
use serde::Deserialize;

/// One threshold for all.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fixed {
    /// That threshold, in (0, 1]. Without, it is that of each material that has a test of its own, and one half elsewhere.
    pub threshold: Option<f32>,
}

impl Effect for Fixed {
    const ABOUT: About = About::new("§1", "Compares alpha with one threshold", "nothing but the test")
        .bounds(&[("threshold", Bound::THRESHOLD)])
        .techniques(techniques![
            "fixed": "§1", "vanishing-foliage" / "alpha test",
                "Geometry vanishes with distance where the mean alpha is below the threshold.";
        ]);

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Threshold])
    }

    fn plan(&self, plan: &mut Plan) {
        plan.before(tell("fixed: no noise", &[], Text::None), |setup| {
            if let Some(threshold) = self.threshold {
                setup.source(Source::Fixed(threshold));
                setup.yields_to_material = false;
            }
        });
    }
}
