//! A camera that moves within a pixel (§7.2): [`jitter`](crate::technique::jitter).

use super::kind::{About, Bound, Effect, Plan, Rules, Text, techniques, tell};
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
    const ABOUT: About = About::new("§7.2", "Moves the camera within a pixel from frame to frame", "nothing")
        .bounds(&[("frames", Bound::CYCLE)])
        .techniques(techniques![
            "camera-jitter": "§7.2", "temporal-noise" / "noise of 1 pixel",
                "Averaged frames see different places within a pixel.";
        ]);

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
