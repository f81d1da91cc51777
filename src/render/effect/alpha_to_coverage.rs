//! Several tests of alpha in a pixel (§3, §8, Eqs. 7 to 9): [`coverage`](crate::threshold::stage::coverage).

use super::kind::{About, Effect, Role, Rules, Technique, one_of};
use crate::render::draw::plan::{Plan, Text, tell};
use crate::render::scene_file::bound::Bound;
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
    const ABOUT: About = About {
        citation: "§3, §8, Eqs. 7 to 9, Humus 2009",
        does: "Tests alpha at every sample of a pixel",
        costs: "tests: samples a fragment; hashes: 1 more a fragment if decorrelated, random or by pixel",
        bounds: &[("samples", Bound::SAMPLES)],
        techniques: &[
            Technique {
                name: "stochastic-transparency",
                source: "§10 (Enderton et al. 2010)",
                claim: "More random tests a pixel converge to ground truth.",
                shown: ["samples-converge", "64 samples"],
            },
            Technique {
                name: "alpha-to-coverage",
                source: "§8, Eq. 7",
                claim: "n regular tests in a pixel; layers of equal alpha cover the same samples.",
                shown: ["vanishing-foliage", "alpha to coverage"],
            },
            Technique {
                name: "hardware-alpha-to-coverage",
                source: "§3, §8",
                claim: "floor(n alpha) samples in a fixed pattern.",
                shown: ["multisample", "as hardware"],
            },
            Technique {
                name: "jittered-alpha-to-coverage",
                source: "§8, Eq. 8",
                claim: "Thresholds jittered within their strata; layers still share samples.",
                shown: ["checkerboard", "isotropic to coverage"],
            },
            Technique {
                name: "permuted-alpha-to-coverage",
                source: "§8, Eq. 9",
                claim: "Strata permuted for each fragment; layers multiply.",
                shown: ["vanishing-foliage", "hashed to coverage"],
            },
            Technique {
                name: "random-masks",
                source: "§3 (Enderton et al. 2010)",
                claim: "Random sets of samples; layers multiply.",
                shown: ["layers", "hashed, random"],
            },
            Technique {
                name: "pixel-masks",
                source: "Humus 2009",
                claim: "A pseudo-random value of the pixel breaks up the repetitive dither of hardware.",
                shown: ["pixel-masks", "by pixel"],
            },
        ],
    };

    fn rules(&self) -> Rules {
        let rules = Rules::of(&[Role::Test, Role::Samples, Role::Varied]).samples(self.samples);
        match self.pattern {
            SamplePattern::Independent => rules.needs(Role::Fresh),
            pattern if pattern.uses_source() => rules.needs(Role::Noise),
            _ => rules.never(Role::Threshold, "that pattern needs no threshold"),
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
