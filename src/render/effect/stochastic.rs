//! A threshold drawn anew every time (§4): [`stochastic`](crate::threshold::stochastic).

use super::kind::{About, Effect, Role, Rules, Technique};
use crate::render::draw::plan::{Plan, Text, tell};
use crate::threshold::pipeline::Source;
use serde::Deserialize;

/// A fresh threshold every time.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stochastic {}

impl Effect for Stochastic {
    const ABOUT: About = About {
        citation: "§4",
        does: "Draws a threshold anew in every fragment and frame",
        costs: "random numbers: 1 a threshold",
        bounds: &[],
        techniques: &[Technique {
            name: "stochastic",
            source: "§4",
            claim: "The expected visibility is alpha; every frame flickers.",
            shown: ["subpixel-motion", "stochastic"],
        }],
    };

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Threshold, Role::Noise, Role::Fresh, Role::Varied])
    }

    fn plan(&self, plan: &mut Plan) {
        let told = tell("threshold: drawn anew in every fragment and frame", &[], Text::None);
        plan.before(told, |setup| setup.source(Source::Stochastic));
    }
}
