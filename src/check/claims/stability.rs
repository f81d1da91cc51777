//! How many thresholds a motion below one pixel changes, against the closed form.

use super::uniform::reject_outsiders;
use super::{Attempt, Claim, Conclusion, Promise, Trial};
use crate::check::evidence::ComparedShare;
use crate::check::sample::{general_scenes, placement, sighting};
use crate::check::tolerance::{POWER, SHIFT_SAMPLES, SHIFTS, SINGLE_LEVEL};
use crate::check::{Draw, Evidence, Subject, Verdict};
use crate::scene::Scene;
use crate::stats::{poisson_binomial, power};
use crate::threshold::footprint::Footprint;
use crate::threshold::robust::Join;
use crate::threshold::stability::change_probability;
use crate::threshold::two_scale::Variant;

/// Share of thresholds that a translation along the screen changes.
pub const TRANSLATE: Claim = Claim {
    id: "stability.translate",
    anchor: "§5 (sub-pixel translations), §5.4.1; closed form not in the paper",
    statement: "a sub-pixel shift along screen x or y changes the share of thresholds that the size of the cells predicts",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.05)),
    run: translate,
};

/// The same on the surfaces that lie along the object's axes, as most models' do.
pub const TRANSLATE_ALIGNED: Claim = Claim {
    id: "stability.translate_aligned",
    anchor: "§5 (sub-pixel translations), §5.4.1; closed form not in the paper",
    statement: "a sub-pixel shift changes the predicted share on walls, floors and cards, which hold one coordinate constant",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.05)),
    run: translate_aligned,
};

fn translate(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    translate_over(subject, general_scenes(), draw, TRANSLATE.id)
}

fn translate_aligned(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let aligned = Scene::all().into_iter().filter(|scene| !scene.general_position).collect();
    translate_over(subject, aligned, draw, TRANSLATE_ALIGNED.id)
}

fn translate_over(subject: &Subject<'_>, scenes: Vec<Scene>, draw: &Draw, claim: &str) -> Attempt<Trial> {
    let mut rng = draw.rng(claim);
    let mut points = Vec::new();
    let mut worst = (1.0, 0.0);
    let (mut effect, mut n) = (0.0_f64, 0_u64);
    let mut tests = 0;
    for scene in scenes {
        for along_x in [true, false] {
            for shift in SHIFTS {
                let (mut before, mut after) = (Vec::new(), Vec::new());
                let (mut mean, mut variance) = (0.0, 0.0);
                for _ in 0..draw.samples(SHIFT_SAMPLES) {
                    // A fresh place for every sample: the closed form is about phases that are all equally likely.
                    let here = sighting(&scene, &mut rng).placed(placement(&mut rng), subject.precision);
                    let footprint = here.fragment.footprint;
                    let motion = if along_x { footprint.dpdx } else { footprint.dpdy } * shift;
                    let probability = predicted(subject, &footprint, motion);
                    mean += probability;
                    variance += probability * (1.0 - probability);
                    before.push(here.fragment);
                    after.push(here.moved(motion, subject.precision).fragment);
                }
                let (old, new) = (subject.thresholds(&before), subject.thresholds(&after));
                reject_outsiders(&before, &old)?;
                reject_outsiders(&after, &new)?;
                let changed = old.iter().zip(&new).filter(|(a, b)| a != b).count();
                let test = poisson_binomial::sum_of_events(changed as u64, mean, variance);
                if test.p < worst.0 {
                    worst = (test.p, test.z);
                }
                let count = before.len() as f64;
                let sigma = variance.sqrt() / count;
                points.push(ComparedShare {
                    series: format!("{}, along {}", scene.name, if along_x { "x" } else { "y" }),
                    x: shift,
                    measured: changed as f64 / count,
                    predicted: mean / count,
                    sigma,
                });
                effect = effect.max((changed as f64 - mean).abs() / count);
                n += before.len() as u64;
                tests += 1;
            }
        }
    }
    let largest = points
        .iter()
        .max_by(|a, b| (a.measured - a.predicted).abs().total_cmp(&(b.measured - b.predicted).abs()));
    let seen = largest.map_or_else(String::new, |point| {
        format!(
            "{} by {} px: {:.4} of thresholds change, {:.4} are predicted",
            point.series, point.x, point.measured, point.predicted
        )
    });
    Ok(Trial {
        conclusion: Conclusion::Probability((worst.0 * f64::from(tests)).min(1.0)),
        statistic: Some(worst.1),
        statistic_name: format!("z, worst of {tests}"),
        n,
        effect: Some(effect),
        effect_name: "error in the share that changes",
        detectable: detectable(&points),
        seen,
        evidence: Evidence::Comparison(points),
    })
}

/// The error in any of the shares that would be seen wherever it were: by the least certain of the trials, at its part
/// of the level.
pub(super) fn detectable(points: &[ComparedShare]) -> Option<f64> {
    let sigma = points.iter().map(|point| point.sigma).reduce(f64::max)?;
    Some(power::detectable_shift_z(sigma, SINGLE_LEVEL / points.len() as f64, POWER))
}

/// The probability that a motion changes the threshold, from the cells that the subject claims to have.
pub(super) fn predicted(subject: &Subject<'_>, here: &Footprint<f64>, motion: glam::DVec3) -> f64 {
    let nominal = subject.nominal(here);
    let motion = motion.to_array();
    let coarse = change_probability(nominal.coarse_scale, motion);
    let fine = change_probability(nominal.fine_scale, motion);
    match (subject.join, subject.variant) {
        // The finer of the two grids decides, since a coarse cell is a union of fine ones.
        (Join::Interpolate | Join::Copula, _) => fine,
        // The coarse cell chooses, and the fine one counts where it was chosen.
        (Join::Dithered, Variant::Anisotropic) => {
            let kept = |axis: usize| {
                let part = |scale: [f64; 3]| ((motion[axis] * scale[axis]).abs()).min(1.0);
                let (coarse, fine) = (part(nominal.coarse_scale), part(nominal.fine_scale));
                1.0 - (coarse + nominal.fraction[axis] * (fine - coarse))
            };
            1.0 - (0..3).map(kept).product::<f64>()
        }
        (Join::Dithered, _) => coarse + nominal.fraction[0] * (fine - coarse),
    }
}
