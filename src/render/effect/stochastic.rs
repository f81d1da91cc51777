//! A threshold drawn anew every time (§4): [`stochastic`](crate::threshold::stochastic).

use super::kind::{About, Effect, Plan, Role, Rules, Text, techniques, tell};
use crate::threshold::pipeline::Source;
use serde::Deserialize;

/// A fresh threshold every time.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stochastic {}

impl Effect for Stochastic {
    const ABOUT: About = About::new(
        "§4",
        "Draws a threshold anew in every fragment and frame",
        "random numbers: 1 a threshold",
    )
    .techniques(techniques![
        "stochastic": "§4", "subpixel-motion" / "stochastic",
            "The expected visibility is alpha; every frame flickers.";
    ]);

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Threshold, Role::Noise, Role::Fresh, Role::Varied])
    }

    fn plan(&self, plan: &mut Plan) {
        let told = tell("threshold: drawn anew in every fragment and frame", &[], Text::None);
        plan.before(told, |setup| setup.source(Source::Stochastic));
    }
}
