//! Every pixel that a surface touches, and thresholds by the share that it covers (§2, Fig. 4):
//! [`conservative`](crate::technique::conservative).

use super::kind::{About, Effect, Phase, Plan, Role, Rules, Text, techniques, tell};
use crate::render::draw::fragments::Fragments;
use crate::render::draw::work::PIXELS;
use crate::shader::beside;
use crate::technique::conservative::corrected;
use serde::Deserialize;

/// Every pixel that a surface touches.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Conservative {
    /// Whether thresholds are divided by the share of the pixel that the surface covers; without, surfaces grow by half a
    /// pixel on every side.
    #[serde(default = "yes")]
    pub corrected: bool,
}

fn yes() -> bool {
    true
}

impl Effect for Conservative {
    const ABOUT: About = About::new(
        "§2, Fig. 4",
        "Draws every pixel that a surface touches, and corrects the threshold by the share that it covers",
        "fragments: one for every pixel and triangle that touch",
    )
    .techniques(techniques![
        "conservative": "§2, Fig. 4", "sub-pixel-cards" / "touching, corrected",
            "Every card draws; the threshold must allow for its share of the pixel.";
    ]);

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Test, Role::Pixels])
            .never(Role::SecondPass, "the first corrects thresholds and the second blends without")
    }

    fn plan(&self, plan: &mut Plan) {
        let told = tell("rasterise: every pixel that a triangle touches", &[], Text::None);
        plan.before(told, |setup| setup.needs.coverage = true);
        if self.corrected {
            let says = "correct: thresholds over the share of the pixel, those above 1 too";
            plan.shade(
                Phase::Correct,
                tell(says, &[], Text::Beside(beside::CORRECTED)),
                |shading, work, _| {
                    let samples = work.threshold.len() / work.fragments.len();
                    correct(&work.fragments, shading.parts, samples, &mut work.threshold);
                },
            );
        }
    }
}

/// What the latest surface of a pixel has covered of it.
#[derive(Clone, Copy)]
struct Covered {
    part: u32,
    /// Its first fragment, whose thresholds the others share.
    first: usize,
    share: f64,
}

/// Shares of one pixel that add up to more than this cannot lie side by side.
const WHOLE: f64 = 1.0 + 1.0e-9;

/// Divides thresholds by the share of the pixel that the surface covers; `samples` of them a fragment, each in (0, 1].
///
/// Triangles of one part (see [`Mesh::parts`](crate::render::draw::mesh::Mesh::parts)) that lie side by side in a pixel share the
/// thresholds of the first and divide (0, 1] among them: tested each with its own, the two halves of a card
/// would be lost together or kept together, and a whole pixel of alpha 1 could have a hole. The paper has no such rule.
fn correct(fragments: &Fragments, parts: &[u32], samples: usize, thresholds: &mut [f32]) {
    let mut pixels: Vec<Option<Covered>> = vec![None; PIXELS];
    // Those of the first fragments are needed as they were.
    let given = thresholds.to_vec();
    for at in 0..fragments.len() {
        let (part, share) = (parts[fragments.triangle[at] as usize], fragments.coverage[at]);
        let pixel = &mut pixels[usize::from(fragments.pixel[at])];
        let beside = pixel.filter(|covered| covered.part == part && covered.share + share <= WHOLE);
        let Covered { first, share: before, .. } = beside.unwrap_or(Covered { part, first: at, share: 0.0 });
        for sample in 0..samples {
            let left = f64::from(given[first * samples + sample]) - before;
            let own = if left > 0.0 { left } else { left + 1.0 };
            thresholds[at * samples + sample] = corrected(own, share) as f32;
        }
        *pixel = Some(Covered { part, first, share: before + share });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fragments of one pixel: triangle and share.
    fn pixel(of: &[(u32, f64)]) -> Fragments {
        Fragments {
            pixel: vec![3; of.len()],
            triangle: of.iter().map(|(triangle, _)| *triangle).collect(),
            coverage: of.iter().map(|(_, share)| *share).collect(),
            ..Fragments::default()
        }
    }

    /// The share of uniform thresholds for which some fragment passes.
    fn kept(fragments: &Fragments, parts: &[u32], alpha: f32, own: impl Fn(usize, u32) -> u32) -> f64 {
        let n = 2000;
        let passes = |i: &u32| {
            let lattice = |i: u32| (f64::from(i % n) + 0.5) as f32 / n as f32;
            let mut thresholds: Vec<f32> = (0..fragments.len()).map(|at| lattice(own(at, *i))).collect();
            correct(fragments, parts, 1, &mut thresholds);
            thresholds.iter().any(|&threshold| alpha >= threshold)
        };
        (0..n).filter(passes).count() as f64 / f64::from(n)
    }

    #[test]
    fn parts_side_by_side_keep_the_sum_of_their_shares() {
        let halves = pixel(&[(0, 0.25), (1, 0.35)]);
        let same: fn(usize, u32) -> u32 = |_, i| i;
        let other: fn(usize, u32) -> u32 = |at, i| i + 977 * at as u32;
        // Whatever threshold the second had of its own.
        for own in [same, other] {
            assert!((kept(&halves, &[0, 0], 0.8, own) - 0.8 * 0.6).abs() < 1e-3);
        }
        // Of two parts with the same thresholds the larger hides the other.
        assert!((kept(&halves, &[0, 1], 0.8, same) - 0.8 * 0.35).abs() < 1e-3);
    }

    #[test]
    fn a_whole_pixel_of_alpha_1_has_no_hole_and_alpha_0_never_shows() {
        let third = 1.0 / 3.0;
        let thirds = pixel(&[(0, third), (1, third), (2, 1.0 - 2.0 * third)]);
        assert_eq!(kept(&thirds, &[7; 3], 1.0, |at, i| i + 331 * at as u32), 1.0);
        assert_eq!(kept(&thirds, &[7; 3], 0.0, |_, i| i), 0.0);
        // A part that folds back over itself is tested anew.
        let folded = pixel(&[(0, 1.0), (1, 0.5)]);
        let mut thresholds = [0.25, 0.75];
        correct(&folded, &[0, 0], 1, &mut thresholds);
        assert_eq!(thresholds, [0.25, 1.5]);
    }
}
