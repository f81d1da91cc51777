//! Alphas scaled by texel (§3): [`scaled_alpha`](crate::technique::prior_work::scaled_alpha).

use super::kind::{About, Bound, Effect, Plan, Role, Rules, Text, techniques, tell};
use crate::render::draw::texture::{Change, Texture};
use crate::technique::prior_work::scaled_alpha::{alpha_scale, scaled, scaled_by_texel};
use serde::Deserialize;

/// Alphas scaled by texel.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScaledTexels {
    /// How far around a texel the share is taken, in texels of its level.
    #[serde(default)]
    pub radius: usize,
}

impl Effect for ScaledTexels {
    const ABOUT: About = About::new(
        "§3",
        "Scales each stored alpha by the share of the texels around it",
        "nothing; passes over the texture beforehand",
    )
    .bounds(&[("radius", Bound::From(0.0, 64.0))])
    .techniques(techniques![
        "texel-threshold": "§3", "castano" / "scaled texels",
            "A threshold for each texel needs a rule that is not obvious, and may only dilate boundaries.";
    ]);

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Scale])
    }

    fn plan(&self, plan: &mut Plan) {
        let radius = self.radius;
        let says = format!("adjust alpha: scaled for each texel by those within {radius}, beforehand");
        plan.before(tell(says, &[], Text::None), |setup| {
            setup.textures.changes.push(Change { name: "scaled texels", parameter: radius, run: scale });
        });
    }
}

fn scale(texture: &mut Texture, radius: usize) {
    let (base, reference) = (texture.levels[0].clone(), texture.reference());
    let (base, share) = (base.alphas(), base.alphas().passing_share(reference));
    for level in texture.levels.iter_mut().skip(1) {
        let view = level.alphas();
        let is_whole = base.width.is_multiple_of(view.width) && base.height.is_multiple_of(view.height);
        level.alpha = if is_whole {
            scaled_by_texel(view, base, reference, radius)
        } else {
            // A map whose sides are no powers of two has no whole number of base texels under each texel.
            scaled(view, alpha_scale(view, share, reference))
        };
    }
}
