//! Alphas scaled by level (Castano 2010): [`scaled_alpha`](crate::technique::prior_work::scaled_alpha).

use super::kind::{About, Effect, Plan, Role, Rules, Text, techniques, tell};
use crate::render::draw::texture::{Change, Level, Texture};
use crate::technique::prior_work::scaled_alpha::{alpha_scale, scaled};
use serde::Deserialize;

/// Alphas scaled by level.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ScaledAlpha {
    /// Whether the share that a level keeps is that of its interpolated alpha, as it is read; by default it is that of its texels.
    pub interpolated: bool,
}

impl Effect for ScaledAlpha {
    const ABOUT: About = About::new(
        "§3 (Castano 2010)",
        "Scales the stored alphas of each level to that effect",
        "nothing; a pass over the texture beforehand",
    )
    .techniques(techniques![
        "scaled-alpha": "§3 (Castano 2010)", "castano" / "scaled alpha",
            "Scaled alphas are equivalent to a threshold for each level, and dilate thin geometry.";
        "interpolated-scaled-alpha": "not in the paper (Castano 2010 in NVTT)", "castano" / "scaled, interpolated",
            "Factors for alpha as it is read, between texels: geometry thinner than a texel keeps its share.";
    ]);

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Scale])
    }

    fn plan(&self, plan: &mut Plan) {
        let by = if self.interpolated { ", by alpha between texels" } else { "" };
        let told = tell(format!("adjust alpha: scaled for each level{by}, beforehand"), &[], Text::None);
        let change = if self.interpolated {
            Change {
                name: "scaled interpolated alpha",
                parameter: 0,
                run: |texture, _| scale_interpolated(texture),
            }
        } else {
            Change { name: "scaled alpha", parameter: 0, run: |texture, _| scale(texture) }
        };
        plan.before(told, |setup| setup.textures.changes.push(change));
    }
}

/// Steps of the search for a factor: halvings of 8 octaves down to a thousandth of one.
const STEPS: u32 = 13;

/// Scales each level so that its interpolated alpha passes over the share of the surface that the finest level's does. No formula
/// gives that factor; the share only grows with it. Of several that keep the share it is the one nearest to 1.
fn scale_interpolated(texture: &mut Texture) {
    let reference = texture.reference();
    let wanted = texture.share_kept(&texture.levels[0], reference);
    for index in 1..texture.levels.len() {
        let level = &texture.levels[index];
        let by =
            |octaves: f32| Level { alpha: scaled(level.alphas(), libm::exp2f(octaves)), ..level.clone() };
        let share = |octaves: f32| texture.share_kept(&by(octaves), reference);
        let unscaled = texture.share_kept(level, reference);
        if unscaled == wanted {
            continue;
        }
        let grows = unscaled < wanted;
        // From a factor that is not enough towards one that is too much.
        let [mut near, mut far] = [0.0, if grows { 8.0 } else { -8.0 }];
        for _ in 0..STEPS {
            let middle = 0.5 * (near + far);
            let is_reached = if grows { share(middle) >= wanted } else { share(middle) <= wanted };
            *(if is_reached { &mut far } else { &mut near }) = middle;
        }
        // Of the two the one that is nearer to what is wanted: a level of few texels jumps.
        let apart = |octaves: f32| (share(octaves) - wanted).abs();
        let alpha = by(if apart(near) < apart(far) { near } else { far }).alpha;
        texture.levels[index].alpha = alpha;
    }
}

fn scale(texture: &mut Texture) {
    let reference = texture.reference();
    let share = texture.levels[0].alphas().passing_share(reference);
    for level in texture.levels.iter_mut().skip(1) {
        level.alpha = scaled(level.alphas(), alpha_scale(level.alphas(), share, reference));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::draw::texture::{Filter, TextureNeeds, TextureSource, Wrap};
    use crate::render::scene_file::procedural::Hair;

    /// Strands thinner than a texel of levels 2 and 3: by their texels they keep a part of their share where alpha is
    /// interpolated, by interpolated alpha all of it, as far as a level of few texels can.
    #[test]
    fn interpolated_alpha_keeps_the_share_of_thin_strands() {
        let finest = Hair { strands: 14, thickness: 0.012 }.draw(256, 1.0, 5);
        let source = TextureSource::new(finest, Wrap::Repeat, Filter::Trilinear);
        let of = |change: fn(&mut Texture)| {
            let mut texture = Texture::new(&source, &TextureNeeds::default());
            change(&mut texture);
            let shares = [0, 2, 3, 4].map(|level| texture.share_kept(&texture.levels[level], 0.5));
            shares.map(|share| share / shares[0])
        };
        let (texels, interpolated) = (of(scale), of(scale_interpolated));
        assert!(texels[1..3].iter().all(|share| *share < 0.9), "{texels:?}");
        assert!(interpolated.iter().all(|share| (share - 1.0).abs() < 0.02), "{interpolated:?}");
    }

    /// What passes already, or never can, stays as it is: other tests than that at one half read it, too.
    #[test]
    fn a_factor_is_no_further_from_one_than_it_must_be() {
        for alpha in [0.0, 0.3, 0.5, 0.8, 1.0] {
            let finest = Level { size: [8, 8], alpha: vec![alpha; 64], colour: Vec::new() };
            let mut texture = Texture::new(
                &TextureSource::new(finest, Wrap::Repeat, Filter::Trilinear),
                &TextureNeeds::default(),
            );
            let before = texture.clone();
            scale_interpolated(&mut texture);
            assert_eq!(texture, before, "{alpha}");
        }
    }
}
