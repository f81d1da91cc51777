//! Alpha from levels that are finer or coarser by a constant (not in the paper): engines read finer ones under temporal
//! antialiasing, and where they draw fewer pixels than they show.

use super::kind::{About, Bound, Effect, Plan, Rules, Text, techniques, tell};
use serde::Deserialize;

/// Alpha from finer or coarser levels.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LevelBias {
    /// What is added to the level of detail; finer levels are below 0.
    pub levels: f32,
}

impl Effect for LevelBias {
    const ABOUT: About = About::new(
        "not in the paper",
        "Reads alpha from levels that are finer or coarser by a constant",
        "texels: as many, but further apart for finer levels",
    )
    .bounds(&[("levels", Bound::From(-16.0, 16.0))])
    .techniques(techniques![
        "level-bias": "not in the paper", "mips-and-wires" / "two levels finer",
            "A bias of two levels puts off by four times the distance what the alpha test loses, and flickers.";
    ]);

    fn rules(&self) -> Rules {
        Rules::default()
    }

    fn plan(&self, plan: &mut Plan) {
        let says = format!("sample alpha: {:+} levels from that of the footprint", self.levels);
        plan.before(tell(says, &[], Text::None), |setup| setup.level_bias += self.levels);
    }
}

#[cfg(test)]
mod tests {
    use crate::render::draw::fragments::Fragments;
    use crate::render::draw::setup::Setup;
    use crate::render::draw::texture::{Filter, Level, Texture, TextureNeeds, TextureSource, Wrap};
    use glam::{Vec2, vec2};

    #[test]
    fn a_bias_moves_the_level_and_a_limit_still_holds() {
        let finest = Level { size: [64, 64], alpha: vec![0.5; 64 * 64], colour: Vec::new() };
        let source = TextureSource::new(finest, Wrap::Repeat, Filter::Trilinear);
        let texture = Texture::new(&source, &TextureNeeds::default());
        let fragments = Fragments {
            pixel: vec![0],
            texcoord: vec![Vec2::ZERO],
            dtdx: vec![vec2(8.0 / 64.0, 0.0)],
            dtdy: vec![vec2(0.0, 8.0 / 64.0)],
            ..Fragments::default()
        };
        for (level_bias, coarsest, wanted) in [
            (0.0, None, 3.0),
            (-1.5, None, 1.5),
            (2.0, None, 5.0),
            (2.0, Some(4.0), 4.0),
            (-1.0, Some(4.0), 2.0),
        ] {
            let setup = Setup { level_bias, coarsest, ..Setup::default() };
            let found = setup.access(&texture, &fragments, [0, 0], 0).lod;
            assert!((found - wanted).abs() < 1e-6, "{level_bias} {coarsest:?}: {found}");
        }
    }
}
