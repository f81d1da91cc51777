//! How many thresholds a motion below one pixel changes, against the closed form.

use crate::check::evidence::ComparedShare;
use crate::check::input::{general_scenes, placement, sighting};
use crate::check::judge::detectable_error;
use crate::check::predict::Changes;
use crate::check::tolerance::WIDE;
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::scene::Scene;

/// Samples at each shift, screen axis and scene: tells a change of 0.01 in any share at the single level and power.
const SHIFT_SAMPLES: usize = 1 << 16;

/// Shifts in pixels at which stability is tried; all sub-pixel, two of them below the fine cell at every lerp factor.
const SHIFTS: [f64; 4] = [0.05, 0.125, 0.25, 0.5];

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
                let samples = draw.stream(SHIFT_SAMPLES);
                let mut changed = 0;
                let mut expected = Changes::default();
                for chunk in draw.chunks(samples) {
                    let (mut before, mut after) = (Vec::new(), Vec::new());
                    for _ in 0..chunk {
                        // A fresh place for every sample: the closed form is about phases that are all equally likely.
                        let place = placement(&mut rng) * WIDE;
                        let here = sighting(&scene, &mut rng).placed(place, subject.precision);
                        let footprint = here.fragment.footprint;
                        let motion = if along_x { footprint.dpdx } else { footprint.dpdy } * shift;
                        expected.add(subject, &footprint, motion);
                        before.push(here.fragment);
                        after.push(here.moved(motion, subject.precision).fragment);
                    }
                    let (old, new) = (subject.thresholds(&before), subject.thresholds(&after));
                    reject_outsiders(subject, &before, &old)?;
                    reject_outsiders(subject, &after, &new)?;
                    changed += old.iter().zip(&new).filter(|(a, b)| a != b).count();
                }
                let test = expected.compared(changed as u64);
                if test.p < worst.0 {
                    worst = (test.p, test.z);
                }
                let count = samples as f64;
                let (mean, sigma) = (expected.mean, expected.variance().sqrt() / count);
                points.push(ComparedShare {
                    series: format!("{}, along {}", scene.name, if along_x { "x" } else { "y" }),
                    x: shift,
                    measured: changed as f64 / count,
                    predicted: mean / count,
                    sigma,
                });
                effect = effect.max((changed as f64 - mean).abs() / count);
                n += samples as u64;
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
        detectable: detectable_error(&points),
        seen,
        evidence: Evidence::Shares { abscissa: "shift [pixels]", points },
    })
}
