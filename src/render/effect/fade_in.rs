//! Noise that fades in with distance (§7.1, Eqs. 3 to 5): [`fade_in`].

use super::kind::{About, Bound, Effect, Plan, Role, Rules, Text, techniques, tell};
use crate::threshold::stage::fade_in;
use serde::Deserialize;

/// Noise that fades in.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FadeIn {
    /// Level of detail from which on all is noise, above 0.
    pub full_noise_lod: f32,
    /// Whether the level is multiplied by the anisotropy of the texture access (§7.1.1).
    pub anisotropy: bool,
    /// The threshold without noise, in (0, 1]: one half in Eq. 4, or what an artist set.
    pub authored: f32,
}

impl Default for FadeIn {
    fn default() -> Self {
        let fade_in::FadeIn { full_noise_lod, anisotropy, authored } = fade_in::FadeIn::default();
        Self { full_noise_lod, anisotropy, authored }
    }
}

impl Effect for FadeIn {
    const ABOUT: About =
        About::new("§7.1, Eqs. 3 to 5", "Fades noise in with distance", "nothing but a mixture")
            .bounds(&[("full_noise_lod", Bound::UpTo(1.0e6)), ("authored", Bound::THRESHOLD)])
            .techniques(techniques![
                "fade-in": "§7.1, Eqs. 3-5", "fade-in" / "faded in",
                    "Noise fades in with distance, near surfaces stay crisp.";
                "anisotropy-factor": "§7.1.1", "grazing-fence" / "faded in by anisotropy",
                    "Noise fades in earlier at grazing angles, where fine levels are read.";
                "blend-towards": "not in the paper", "fade-in" / "faded in from 0.25",
                    "Noise fades in from a threshold of the artist's.";
            ]);

    fn rules(&self) -> Rules {
        Rules::default().needs(Role::Noise, "a hashed or random threshold")
    }

    fn plan(&self, plan: &mut Plan) {
        let Self { full_noise_lod, anisotropy, authored } = *self;
        let scaled = if anisotropy { ", scaled by anisotropy" } else { "" };
        let says =
            format!("fade in: from {authored} at level 0 to full noise at level {full_noise_lod}{scaled}");
        plan.before(tell(says, &[], Text::None), |setup| {
            setup.needs.texture_derivatives = true;
            setup.thresholds(|pipeline| {
                pipeline.fade_in = Some(fade_in::FadeIn { authored, full_noise_lod, anisotropy });
            });
        });
    }
}
