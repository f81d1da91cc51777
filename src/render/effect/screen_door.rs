//! Masks over tiles of pixels (§3, §8.1): [`screen_door`](crate::threshold::stage::screen_door).

use super::kind::{About, Effect, Role, Rules, Technique, one_of};
use crate::render::draw::plan::{Plan, Text, tell};
use crate::threshold::pipeline::Source;
use crate::threshold::stage::screen_door::ScreenDoor as Mask;
use serde::{Deserialize, Deserializer};

/// A mask over tiles of pixels.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScreenDoor {
    /// Which one.
    #[serde(deserialize_with = "mask")]
    pub mask: Mask,
}

fn mask<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Mask, D::Error> {
    one_of(deserializer, "mask", Mask::ALL, Mask::name)
}

impl Effect for ScreenDoor {
    const ABOUT: About = About {
        citation: "§3, §8.1",
        does: "Compares with thresholds that lie over tiles of pixels",
        costs: "hashes: 3 a fragment if hashed",
        bounds: &[],
        techniques: &[
            Technique {
                name: "screen-door",
                source: "§3, §8.1",
                claim: "Samples lie in several pixels; layers and tiles repeat.",
                shown: ["screen-door", "fixed mask"],
            },
            Technique {
                name: "random-screen-door",
                source: "§3 (Mulder et al. 1998)",
                claim: "Even a random mask correlates layers.",
                shown: ["screen-door", "random mask"],
            },
            Technique {
                name: "hashed-screen-door",
                source: "§8.1",
                claim: "Permuted for each tile and layer, layers multiply.",
                shown: ["screen-door", "hashed masks"],
            },
        ],
    };

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Threshold, Role::Varied])
    }

    fn plan(&self, plan: &mut Plan) {
        let says = format!("threshold: that of the pixel in a {} mask of 4 x 4", self.mask.name());
        plan.before(tell(says, &[], Text::None), |setup| setup.source(Source::ScreenDoor(self.mask)));
    }
}
