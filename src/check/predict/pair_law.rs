//! What two thresholds have in common, from the cells that a subject claims to have.
//!
//! Two points of a surface with the same derivatives lie in the same octaves. With the place of the object uniform,
//! the faces of the cells are at uniform places too, so the probabilities of sharing a cell are products of
//! `max(0, 1 - |v_i| s_i)` over the axes; what is shared then tells how alike the thresholds are. Not in the paper.

use super::nested::{
    CORRELATION_IN_HALVES, correlation_in_thirds, reach, visible_in_halves, visible_in_thirds,
};
use super::shared_cell::{
    copula_correlation, copula_joint_visibility, interpolated_correlation, interpolated_joint_visibility,
};
use crate::check::Subject;
use crate::check::subject::Nominal;
use crate::threshold::robust::Join;
use crate::threshold::robust::nested::LEVELS;
use crate::threshold::two_scale::Variant;
use glam::DVec3;

/// How two thresholds are related, given which cells the two points share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Relation {
    /// They are equal.
    Same,
    /// They are mixtures of Eq. 2 at this lerp factor, of one coarse hash and two fine ones.
    Interpolated(f64),
    /// They are images of normal values with this correlation.
    Normal(f64),
    /// They come from two children of one parent, each with a third of [0, 1] of its own, which one hash fills alike or half of
    /// it apart.
    Thirds {
        /// Whether half of it apart.
        opposite: bool,
    },
    /// They come from two opposite children of one parent that share a third of [0, 1], half of it apart.
    Halves,
}

/// How two thresholds are related: the relations that can occur with their probabilities; for the rest they are
/// independent.
#[derive(Clone, Debug, PartialEq)]
pub struct PairLaw(pub Vec<(f64, Relation)>);

impl PairLaw {
    /// Returns how the thresholds are related at two points `lag` apart, in object units, where the cells are `nominal`.
    #[must_use]
    pub fn new(subject: &Subject<'_>, nominal: &Nominal, lag: DVec3) -> Self {
        let lag = lag.to_array();
        let kept = |scale: [f64; 3]| [0, 1, 2].map(|axis| (1.0 - (lag[axis] * scale[axis]).abs()).max(0.0));
        let (coarse, fine) = (kept(nominal.coarse_scale), kept(nominal.fine_scale));
        let all = |kept: [f64; 3]| kept.iter().product::<f64>();
        let (same_coarse, same_fine) = (all(coarse), all(fine));
        let fraction = nominal.fraction;
        // A coarse cell is a union of fine ones.
        let coarse_only =
            |relation| Self(vec![(same_fine, Relation::Same), (same_coarse - same_fine, relation)]);
        match (subject.join, subject.variant) {
            (Join::Interpolate, _) => coarse_only(Relation::Interpolated(nominal.lerp_factor)),
            (Join::Copula, Variant::Anisotropic) => Self::of_corners(coarse, fine, fraction),
            (Join::Copula, _) => coarse_only(Relation::Normal(coarse_share(fraction[0]))),
            // Cells beside each other have different names.
            (Join::Dithered | Join::Inherit, Variant::Anisotropic) => {
                // Each axis chooses its octave, the same wherever it shares the interval by which it chooses.
                let chosen =
                    [0, 1, 2].map(|axis| coarse[axis] + fraction[axis] * (fine[axis] - coarse[axis]));
                Self(vec![(all(chosen), Relation::Same)])
            }
            (Join::Dithered | Join::Inherit, _) => {
                let mut all = vec![(same_coarse + fraction[0] * (same_fine - same_coarse), Relation::Same)];
                if subject.has_kin() {
                    let same =
                        |above: i32| kept(nominal.coarse_scale.map(|s| s * libm::exp2(f64::from(-above))));
                    all.extend(kin(same, fraction[0]));
                }
                Self(all)
            }
        }
    }

    /// The eight corners of the copula join: a corner is shared where each axis shares what the corner reads of it. Their
    /// weights are products over the axes, and so are the sums of the squares of those shared.
    fn of_corners(coarse: [f64; 3], fine: [f64; 3], fraction: [f64; 3]) -> Self {
        let relation = |bits: u32| {
            let (mut probability, mut correlation) = (1.0, 1.0);
            for axis in 0..3 {
                if bits >> axis & 1 == 1 {
                    probability *= coarse[axis] - fine[axis];
                    correlation *= coarse_share(fraction[axis]);
                } else {
                    probability *= fine[axis];
                }
            }
            (probability, if bits == 0 { Relation::Same } else { Relation::Normal(correlation) })
        };
        Self((0..8).map(relation).filter(|(probability, _)| *probability > 0.0).collect())
    }

    /// Returns the probability that the thresholds are equal.
    #[must_use]
    pub fn same(&self) -> f64 {
        self.mean(|relation| f64::from(u8::from(relation == Relation::Same)))
    }

    /// Returns the correlation of the two thresholds, in [-1, 1].
    #[must_use]
    pub fn correlation(&self) -> f64 {
        self.mean(|relation| match relation {
            Relation::Same => 1.0,
            Relation::Interpolated(lerp_factor) => interpolated_correlation(lerp_factor),
            Relation::Normal(correlation) => copula_correlation(correlation),
            Relation::Thirds { opposite } => correlation_in_thirds(opposite),
            Relation::Halves => CORRELATION_IN_HALVES,
        })
    }

    /// Returns the correlation of two fragments of the same `alpha` being kept, in [-1, 1]. `alpha` in (0, 1).
    #[must_use]
    pub fn visibility_correlation(&self, alpha: f64) -> f64 {
        let excess = |both: f64| (both - alpha * alpha) / (alpha * (1.0 - alpha));
        self.mean(|relation| match relation {
            Relation::Same => 1.0,
            Relation::Interpolated(lerp_factor) => excess(interpolated_joint_visibility(lerp_factor, alpha)),
            Relation::Normal(correlation) => excess(copula_joint_visibility(correlation, alpha)),
            Relation::Thirds { .. } => excess(visible_in_thirds(alpha)),
            Relation::Halves => excess(visible_in_halves(alpha)),
        })
    }

    fn mean(&self, of: impl Fn(Relation) -> f64) -> f64 {
        self.0.iter().filter(|(p, _)| *p > 0.0).map(|&(p, relation)| p * of(relation)).sum()
    }
}

/// The relations of two points of an isotropic threshold beyond those of cells that are shared. `same` returns the probability, along each
/// axis, that both points lie in one interval so many octaves above the coarse one; -1 for the fine one. `fraction` as in
/// [`Nominal`].
fn kin(same: impl Fn(i32) -> [f64; 3], fraction: f64) -> Vec<(f64, Relation)> {
    let mut found = Vec::new();
    // Children of one coarse cell, which has chosen the finer octave.
    of_children(fraction, same(-1), same(0), &mut found);
    let mut reach = reach(fraction);
    for above in 0..LEVELS as i32 {
        // Each of two coarse cells has chosen for itself.
        of_children(reach * reach, same(above), same(above + 1), &mut found);
        reach *= 0.25;
    }
    found
}

/// Two cells with one parent: the probability of each relation, from those that both points lie in one interval of the cells and in
/// one of the parent.
fn of_children(
    weight: f64,
    in_one_cell: [f64; 3],
    in_one_parent: [f64; 3],
    found: &mut Vec<(f64, Relation)>,
) {
    for apart in 1..8_u32 {
        let along = |axis: usize| {
            let in_one_cell = in_one_cell[axis];
            if apart >> axis & 1 == 1 { in_one_parent[axis] - in_one_cell } else { in_one_cell }
        };
        let probability = weight * along(0) * along(1) * along(2);
        if apart == 7 {
            found.push((0.25 * probability, Relation::Same));
            found.push((0.75 * probability, Relation::Halves));
        } else {
            // In one of two cases one of the pairs is that which keeps.
            found.push((0.5 * probability, Relation::Thirds { opposite: apart >> 2 & 1 == 1 }));
        }
    }
}

/// The share of the variance of a normal mixture that comes from the coarse octave.
fn coarse_share(fraction: f64) -> f64 {
    let (coarse, fine) = ((1.0 - fraction) * (1.0 - fraction), fraction * fraction);
    coarse / (coarse + fine)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::subject::Precision;
    use crate::stats::seed::{self, uniform01};
    use crate::threshold::footprint::Footprint;
    use crate::threshold::hash::HashKind;
    use crate::threshold::robust::Robust;
    use glam::dvec3;

    /// The closed forms against a million pairs of the robust threshold.
    #[test]
    fn every_join_is_as_alike_as_predicted() {
        let [dpdx, dpdy] = [dvec3(0.031, -0.007, 0.012), dvec3(-0.004, 0.021, 0.019)];
        let lag = 0.6 * dpdx + 0.3 * dpdy;
        let mut rng = seed::rng("pair.tests", 0);
        for join in Join::ALL {
            for variant in [Variant::Isotropic, Variant::Anisotropic] {
                for hash_scale in [1.0, 1.37] {
                    let robust = Robust { join, hash_scale, ..Robust::new(variant) };
                    let subject = Subject::robust::<HashKind>("robust", Precision::F64, robust);
                    let mut place = || 1e4 * (uniform01(&mut rng) - 0.5);
                    let near: Vec<Footprint<f64>> = (0..1 << 18)
                        .map(|_| Footprint { position: dvec3(place(), place(), place()), dpdx, dpdy })
                        .collect();
                    let far: Vec<Footprint<f64>> =
                        near.iter().map(|f| Footprint { position: f.position + lag, ..*f }).collect();
                    let pair = PairLaw::new(&subject, &subject.nominal(&near[0]), lag);
                    let (a, b) = (subject.thresholds(&near), subject.thresholds(&far));
                    let mean = |of: &dyn Fn(f64, f64) -> f64| {
                        a.iter().zip(&b).map(|(a, b)| of(*a, *b)).sum::<f64>() / a.len() as f64
                    };
                    let correlation = mean(&|a, b| 12.0 * (a - 0.5) * (b - 0.5));
                    let predicted = pair.correlation();
                    // Five standard errors.
                    let name = format!("{join} {variant} {hash_scale}");
                    assert!((correlation - predicted).abs() < 0.01, "{name}: {correlation} {predicted}");
                    for alpha in [0.3, 0.9] {
                        let kept = |t: f64| f64::from(t <= alpha) - alpha;
                        let found = mean(&|a, b| kept(a) * kept(b)) / (alpha * (1.0 - alpha));
                        let predicted = pair.visibility_correlation(alpha);
                        assert!((found - predicted).abs() < 0.03, "{name} {alpha}: {found} {predicted}");
                    }
                }
            }
        }
    }
}
