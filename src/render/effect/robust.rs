//! The listings with every repair: [`robust`](crate::threshold::robust).

use super::kind::{
    About, Bound, Diagnostic, Effect, Plan, Role, Rules, Text, by_name, techniques, tell, two_scales,
};
use crate::threshold::hash::HashKind;
use crate::threshold::model::Model;
use crate::threshold::pipeline::Source;
use crate::threshold::robust::{Join, Robust};
use crate::threshold::two_scale::Variant;
use serde::{Deserialize, Deserializer};

/// The threshold with every repair.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RobustHash {
    /// How scales are chosen from derivatives.
    #[serde(deserialize_with = "by_name")]
    pub variant: Variant,
    /// The hash of a cell.
    #[serde(deserialize_with = "by_name")]
    pub hash: HashKind,
    /// Size of the noise, in pixels.
    pub hash_scale: f64,
    /// How the hashes of two octaves become one value; by default the copula with one scale an axis and the paper's
    /// interpolation with one for all.
    #[serde(deserialize_with = "if_any")]
    pub join: Option<Join>,
}

impl Default for RobustHash {
    fn default() -> Self {
        let Robust { variant, hash, hash_scale, .. } = Robust::new(Variant::Isotropic);
        Self { variant, hash, hash_scale, join: None }
    }
}

fn if_any<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Join>, D::Error> {
    by_name(deserializer).map(Some)
}

impl Effect for RobustHash {
    const ABOUT: About = About::new(
        "not in the paper",
        "Hashes a threshold with every repair",
        "hashes: 2 to 8 a fragment, by join and variant",
    )
    .bounds(&[("hash_scale", Bound::RATIO)])
    .techniques(techniques![
        "robust": "not in the paper", "axis-plane" / "robust anisotropic",
            "The listings with every repair: a threshold for every input, without jumps.";
        "noise-scale": "§7.2.1", "temporal-noise" / "noise of sqrt(1/8) pixels",
            "Noise of sqrt(1/n) pixels holds n values a pixel, and is less stable.";
    ]);

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Threshold, Role::Noise, Role::Hash, Role::Varied])
    }

    fn check(&self, _: &Plan) -> Result<(), Diagnostic> {
        two_scales(self.variant, "robust")?;
        let robust =
            Robust { hash: self.hash, join: self.join.unwrap_or(Join::Interpolate), ..Robust::default() };
        if robust.tells_octaves_apart() {
            return Ok(());
        }
        let needs =
            format!("`robust.join` = \"inherit\" needs a hash that reads the octave, as {}", Robust::HASH);
        Err(Diagnostic::new("hash", needs))
    }

    fn plan(&self, plan: &mut Plan) {
        let Self { variant, hash, hash_scale, .. } = *self;
        let preset = Robust::new(variant);
        let join = self.join.unwrap_or(preset.join);
        let says = format!("hash: robust {variant}, {hash} hash, {join} join, noise of {hash_scale} px");
        let model = Model::Robust(Robust { hash, hash_scale, join, ..preset });
        plan.before(tell(says, &[], Text::None), |setup| setup.source(Source::Hash(model)));
    }
}
