//! A camera that moves within a pixel (§7.2): [`jitter`](crate::technique::jitter).

use super::kind::{About, Effect, Rules, Technique};
use crate::render::draw::plan::{Plan, Text, tell};
use crate::render::scene_file::bound::Bound;
use core::num::NonZeroU32;
use serde::Deserialize;

/// A camera that moves within a pixel.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Jitter {
    /// Number of frames that belong together.
    pub frames: NonZeroU32,
}

impl Effect for Jitter {
    const ABOUT: About = About {
        citation: "§7.2",
        does: "Moves the camera within a pixel from frame to frame",
        costs: "nothing",
        bounds: &[("frames", Bound::CYCLE)],
        techniques: &[Technique {
            name: "camera-jitter",
            source: "§7.2",
            claim: "Averaged frames see different places within a pixel.",
            shown: ["temporal-noise", "noise of 1 pixel"],
        }],
    };

    fn rules(&self) -> Rules {
        Rules::default()
    }

    fn plan(&self, plan: &mut Plan) {
        let says = format!("jitter: the camera at another of {} places in the pixel each frame", self.frames);
        plan.before(tell(says, &[], Text::None), |setup| {
            setup.jitter = Some(self.frames);
            setup.needs.frame = true;
        });
    }
}
