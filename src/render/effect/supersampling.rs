//! Several places of each pixel at which everything is done, and their mean (§3).

use super::kind::{About, Bound, Effect, Plan, Rules, Text, techniques, tell};
use crate::render::draw::work::Frame;
use core::num::NonZeroU32;
use serde::Deserialize;

/// Tests at several places of each pixel.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Supersampling {
    /// Places along each side of a pixel.
    pub samples: NonZeroU32,
}

impl Effect for Supersampling {
    const ABOUT: About = About::new(
        "§3",
        "Tests at several places of each pixel and averages",
        "fragments and all that follows, samples^2 times",
    )
    .bounds(&[("samples", Bound::From(1.0, 16.0))])
    .techniques(techniques![
        "supersampling": "§3", "blending" / "supersampled",
            "Enough samples of binary alpha give accurate visibility; the number needed has no bound.";
    ]);

    fn rules(&self) -> Rules {
        Rules::default()
    }

    fn plan(&self, plan: &mut Plan) {
        let side = self.samples.get();
        let says = format!("supersample: {side} x {side} places in each pixel");
        plan.before(tell(says, &[], Text::None), |setup| setup.places = side);
        if side > 1 {
            let told = tell(format!("downsample: mean of {side} x {side}"), &[], Text::None);
            plan.after(told, move |frame, _, _| downsample(frame, side));
        }
    }
}

/// Makes one pixel of so many places along each side.
fn downsample(frame: &mut Frame, side: u32) {
    let width = frame.picture.size[0];
    let across = width / side;
    frame.picture = frame.picture.downsample(side);
    frame.touched = (0..frame.picture.coverage.len() as u32)
        .map(|at| frame.touched[((at / across * width + at % across) * side) as usize])
        .collect();
    if !frame.rays.is_empty() {
        let mut sums = vec![[0; 2]; frame.touched.len()];
        for (at, of_place) in (0_u32..).zip(&frame.rays) {
            let [x, y] = [at % width, at / width].map(|place| place / side);
            let sum = &mut sums[(y * across + x) as usize];
            *sum = [sum[0] + of_place[0], sum[1] + of_place[1]];
        }
        frame.rays = sums;
    }
}
