//! Holes of one pixel of four, or of three (Ols 2009): [`stipple`](crate::threshold::stage::stipple).

use super::kind::{About, Effect, Plan, Role, Rules, Text, one_of, techniques, tell};
use crate::threshold::fixed::FIXED_THRESHOLD;
use crate::threshold::pipeline::Source;
use crate::threshold::stage::stipple::Density;
use serde::{Deserialize, Deserializer};

/// Holes of one pixel, or of three.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stipple {
    /// How much of a surface is kept.
    #[serde(deserialize_with = "density")]
    pub density: Density,
}

fn density<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Density, D::Error> {
    one_of(deserializer, "density", [Density::High, Density::Low], Density::name)
}

impl Effect for Stipple {
    const ABOUT: About = About::new(
        "Ols 2009",
        "Leaves out one pixel of four, or three, wherever a surface is not opaque",
        "nothing",
    )
    .techniques(techniques![
        "stipple": "Ols 2009", "stipple" / "high density",
            "One of four pixels is left out; only one layer of translucency is possible.";
    ]);

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Test])
            .never(Role::Varied, "the first works with one threshold for all")
            .never(Role::SecondPass, "the second would fill the holes of the first")
    }

    fn plan(&self, plan: &mut Plan) {
        let holes = match self.density {
            Density::High => "one pixel",
            Density::Low => "three pixels",
        };
        plan.before(tell(format!("stipple: a hole in {holes} of 2 x 2"), &[], Text::None), |setup| {
            let kept = match setup.pipeline.map(|pipeline| pipeline.source) {
                Some(Source::Fixed(threshold)) => threshold,
                // No other source goes with it.
                None | Some(_) => FIXED_THRESHOLD as f32,
            };
            setup.source(Source::Stipple { density: self.density, kept });
        });
    }
}
