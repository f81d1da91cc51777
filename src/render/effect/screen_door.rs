//! Masks over tiles of pixels (§3, §8.1): [`screen_door`](crate::threshold::stage::screen_door).

use super::kind::{About, Effect, Plan, Role, Rules, Text, one_of, techniques, tell};
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
    const ABOUT: About = About::new(
        "§3, §8.1",
        "Compares with thresholds that lie over tiles of pixels",
        "hashes: 3 a fragment if hashed",
    )
    .techniques(techniques![
        "screen-door": "§3, §8.1", "screen-door" / "fixed mask",
            "Samples lie in several pixels; layers and tiles repeat.";
        "bayer-screen-door": "not in the paper (Bayer 1973)", "screen-door" / "8 x 8 mask",
            "Finer steps of coverage than 4 x 4 pixels give, and layers look like one all the same.";
        "random-screen-door": "§3 (Mulder et al. 1998)", "screen-door" / "random mask",
            "Even a random mask correlates layers.";
        "hashed-screen-door": "§8.1", "screen-door" / "hashed masks",
            "Permuted for each tile and layer, layers multiply.";
    ]);

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Threshold, Role::Varied])
    }

    fn plan(&self, plan: &mut Plan) {
        let (name, side) = (self.mask.name(), self.mask.tile());
        let says = format!("threshold: that of the pixel in a {name} mask of {side} x {side}");
        plan.before(tell(says, &[], Text::None), |setup| setup.source(Source::ScreenDoor(self.mask)));
    }
}
