//! Several tests of alpha in a pixel (§3, §8, Eqs. 7 to 9): [`coverage`](crate::threshold::stage::coverage).

use super::kind::{About, Bound, Effect, Plan, Role, Rules, Text, one_of, techniques, tell};
use crate::threshold::stage::coverage::{SamplePattern, SampleStrata};
use core::num::NonZeroU32;
use serde::{Deserialize, Deserializer};

/// Several tests in a pixel.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AlphaToCoverage {
    /// Number of samples in a pixel, at most 64.
    pub samples: NonZeroU32,
    /// Which thresholds they have.
    #[serde(deserialize_with = "pattern")]
    pub pattern: SamplePattern,
}

fn pattern<'de, D: Deserializer<'de>>(deserializer: D) -> Result<SamplePattern, D::Error> {
    one_of(deserializer, "pattern", SamplePattern::ALL, SamplePattern::name)
}

impl Effect for AlphaToCoverage {
    const ABOUT: About = About::new(
        "§3, §8, Eqs. 7 to 9, Humus 2009",
        "Tests alpha at every sample of a pixel",
        "tests: samples a fragment; hashes: 1 more a fragment if decorrelated, random or by pixel",
    )
    .bounds(&[("samples", Bound::SAMPLES)])
    .techniques(techniques![
        "stochastic-transparency": "§10 (Enderton et al. 2010)", "samples-converge" / "64 samples",
            "More random tests a pixel converge to ground truth.";
        "alpha-to-coverage": "§8, Eq. 7", "vanishing-foliage" / "alpha to coverage",
            "n regular tests in a pixel; layers of equal alpha cover the same samples.";
        "hardware-alpha-to-coverage": "§3, §8", "multisample" / "as hardware",
            "floor(n alpha) samples in a fixed pattern.";
        "jittered-alpha-to-coverage": "§8, Eq. 8", "checkerboard" / "isotropic to coverage",
            "Thresholds jittered within their strata; layers still share samples.";
        "permuted-alpha-to-coverage": "§8, Eq. 9", "vanishing-foliage" / "hashed to coverage",
            "Strata permuted for each fragment; layers multiply.";
        "random-masks": "§3 (Enderton et al. 2010)", "layers" / "hashed, random",
            "Random sets of samples; layers multiply.";
        "pixel-masks": "Humus 2009", "pixel-masks" / "by pixel",
            "A pseudo-random value of the pixel breaks up the repetitive dither of hardware.";
    ]);

    fn rules(&self) -> Rules {
        let rules = Rules::of(&[Role::Test, Role::Samples, Role::Varied]).samples(self.samples);
        match self.pattern {
            SamplePattern::Independent => rules.needs(Role::Fresh, "thresholds that are drawn anew"),
            SamplePattern::Jittered | SamplePattern::Decorrelated | SamplePattern::Shuffled => {
                rules.needs(Role::Noise, "a hashed or random threshold")
            }
            SamplePattern::Regular | SamplePattern::Hardware | SamplePattern::ByPixel => {
                rules.never(Role::Threshold, "that pattern needs no threshold")
            }
        }
    }

    fn plan(&self, plan: &mut Plan) {
        let Self { samples, pattern } = *self;
        let says = format!("coverage: {samples} samples a pixel, {} pattern", pattern.name());
        plan.before(tell(says, &[], Text::None), |setup| {
            setup.samples = samples;
            setup.thresholds(|pipeline| pipeline.sample_strata = Some(SampleStrata { samples, pattern }));
        });
    }
}
