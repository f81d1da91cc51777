//! The mean of the latest frames (§7.2).

use super::kind::{About, Bound, Cost, Effect, Per, Plan, Rules, Text, tell};
use crate::render::measure::picture::Picture;
use core::num::NonZeroU32;
use serde::Deserialize;

/// The mean of frames.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Average {
    /// Number of frames that are averaged.
    pub frames: NonZeroU32,
}

impl Effect for Average {
    const ABOUT: About = About::new(
        "§7.2",
        "Averages frames, as temporal antialiasing does",
        "samples: one blend a pixel and frame",
    )
    .bounds(&[("frames", Bound::CYCLE)]);

    fn rules(&self) -> Rules {
        Rules::default()
    }

    fn plan(&self, plan: &mut Plan) {
        let frames = self.frames.get() as usize;
        plan.setup.mixes = true;
        let told = tell(
            format!("average: mean of the last {frames} frames"),
            &[(Per::Pixel, Cost::blends(1))],
            Text::None,
        );
        plan.after(told, move |frame, _, latest| {
            latest.push_back(core::mem::take(&mut frame.picture));
            if latest.len() > frames {
                latest.pop_front();
            }
            frame.picture = Picture::mean(latest.iter());
        });
    }
}
