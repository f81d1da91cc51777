//! The listings to the letter (§5, §6): [`hashed`](crate::threshold::hashed).

use super::kind::{About, Bound, Effect, Plan, Role, Rules, Text, by_name, techniques, tell};
use crate::threshold::cdf::CdfForm;
use crate::threshold::hash::HashKind;
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::model::Model;
use crate::threshold::pipeline::Source;
use crate::threshold::two_scale::Variant;
use serde::Deserialize;

/// A listing to the letter, or one of its ablations.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Hashed {
    /// How scales are chosen from derivatives.
    #[serde(deserialize_with = "by_name")]
    pub variant: Variant,
    /// The hash of a cell.
    #[serde(deserialize_with = "by_name")]
    pub hash: HashKind,
    /// Size of the noise, in pixels.
    pub hash_scale: f64,
    /// Eq. 2 to the letter, or without a division by zero.
    #[serde(deserialize_with = "by_name")]
    pub form: CdfForm,
}

impl Default for Hashed {
    /// Listing 1.
    fn default() -> Self {
        let HashedAlpha { variant, hash_scale, form, .. } = HashedAlpha::listing(Variant::Isotropic);
        Self { variant, hash: HashKind::Sine, hash_scale, form }
    }
}

impl Effect for Hashed {
    const ABOUT: About = About::new(
        "§5, §6, Listings 1 and 2",
        "Hashes a threshold from the place on the surface, to the letter",
        "hashes: 2 a fragment (1 for the single scale)",
    )
    .bounds(&[("hash_scale", Bound::RATIO)])
    .techniques(techniques![
        "single-scale": "§5.4.1", "octaves" / "one scale",
            "Noise of one pixel is stable under shifts within a pixel, and not along the view.";
        "linear-scales": "§5.4.2", "octaves" / "linear",
            "Two linear scales change slowly, and fail for derivatives below one.";
        "hashed-isotropic": "§5, Listing 1", "vanishing-foliage" / "hashed",
            "Coverage of stochastic alpha testing, stability of the traditional test.";
        "hashed-anisotropic": "§6, Listing 2", "grazing-fence" / "anisotropic",
            "Noise keeps the size of a pixel along both screen axes at grazing angles.";
    ]);

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Threshold, Role::Noise, Role::Hash, Role::Varied])
    }

    fn plan(&self, plan: &mut Plan) {
        let Self { variant, hash, hash_scale, form } = *self;
        let says = format!("hash: {variant} listing, {hash} hash, noise of {hash_scale} px");
        let model = Model::Hashed(HashedAlpha { variant, hash, hash_scale, form });
        plan.before(tell(says, &[], Text::None), |setup| setup.source(Source::Hash(model)));
    }
}
