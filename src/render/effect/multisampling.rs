//! Geometry tested at several places of each pixel (§1, §2, §8):
//! [`multisampling`](crate::technique::multisampling).

use super::kind::{About, Bound, Effect, Plan, Role, Rules, Text, techniques, tell};
use core::num::NonZeroU32;
use serde::Deserialize;

/// Several places of a pixel, at which geometry is tested.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Multisampling {
    /// Number of places, at most 64; all effects with samples must have the same number.
    pub samples: NonZeroU32,
}

impl Effect for Multisampling {
    const ABOUT: About = About::new(
        "§1, §2, §8",
        "Tests geometry at several places of each pixel, and reads alpha once",
        "fragments: one for every pixel and triangle that meet in a sample",
    )
    .bounds(&[("samples", Bound::SAMPLES)])
    .techniques(techniques![
        "multisampling": "§1, §2, §8", "multisample" / "multisampled test",
            "Edges of geometry are smoothed; edges of alpha, which is read once a pixel, are not.";
    ]);

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Test])
            .samples(self.samples)
            .never(Role::Pixels, "the first knows places in a pixel, the second whole pixels")
    }

    fn plan(&self, plan: &mut Plan) {
        let says = format!("multisample: geometry at {} places of each pixel, alpha at one", self.samples);
        plan.before(tell(says, &[], Text::None), |setup| {
            setup.samples = self.samples;
            setup.needs.samples = Some(self.samples);
        });
    }
}
