//! The alpha test, and then what it left out, blended (§3, Moore & Jefferies 2009):
//! [`test_then_blend`](crate::technique::prior_work::test_then_blend).

use super::kind::{About, Cost, Effect, Per, Phase, Plan, Role, Rules, Text, techniques, tell};
use crate::technique::prior_work::test_then_blend::test_then_blend;
use crate::threshold::fixed::FIXED_THRESHOLD;
use crate::threshold::pipeline::Source;
use serde::Deserialize;

/// The alpha test, and then what it left out, blended.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TestThenBlend {}

impl Effect for TestThenBlend {
    const ABOUT: About = About::new(
        "§3 (Moore & Jefferies 2009)",
        "Draws what fails the test once more, blended",
        "passes, fragments, texels: twice; blends: 1 a fragment",
    )
    .techniques(techniques![
        "test-then-blend": "§3 (Moore & Jefferies 2009)", "blending" / "test, then blend",
            "Transparent fragments never hide opaque ones; everything is drawn twice.";
    ]);

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Test, Role::Pixels, Role::SecondPass])
            .never(Role::Varied, "the first works with one threshold for all")
    }

    fn plan(&self, plan: &mut Plan) {
        // The second pass knows one threshold for all, which the first must share.
        plan.setup.yields_to_material = false;
        let threshold = match plan.setup.pipeline.map(|pipeline| pipeline.source) {
            Some(Source::Fixed(threshold)) => f64::from(threshold),
            // No other source goes with it.
            None | Some(_) => FIXED_THRESHOLD,
        };
        let price = [
            (Per::Frame, Cost::passes(1)),
            (Per::Fragment, Cost::fragments(1) + Cost::blends(1)),
            (Per::Texel, Cost::texels(1)),
        ];
        let says = format!("blend: all is drawn once more, what failed at {threshold} over what passed");
        plan.shade(Phase::Blend, tell(says, &price, Text::None), move |shading, work, result| {
            shading.sample(work);
            shading.blend(work, |layers, behind| test_then_blend(layers, behind, threshold), result);
        });
    }
}
