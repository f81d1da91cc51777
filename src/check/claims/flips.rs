//! How often a fragment appears or disappears while its view changes, against the closed forms of each join.
//!
//! How many thresholds change says nothing about how far. A flip is a threshold that passes alpha: by a soft change
//! fewer than by a hard one, by a continuous change as many as the join has to have. E |d tau| is the integral of the
//! flips over alpha, and so is no claim of its own.

use crate::check::evidence::ComparedShare;
use crate::check::input::{
    Motion, general_scenes, placed, placement, sighting, tangents, tilted, turned, zoomed,
};
use crate::check::judge::detectable_error;
use crate::check::predict::{PairLaw, flip_between};
use crate::check::tolerance::{ALPHAS, POWER, SINGLE_LEVEL, TILT_OCTAVES, WIDE};
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::scene::Fragment;
use crate::stats::{normal, poisson_binomial, power};
use crate::threshold::footprint::Footprint;
use core::f64::consts::FRAC_PI_2;
use glam::DVec3;
use rand::rngs::Xoshiro256PlusPlus;

/// Shifts in pixels after which flips are counted: one at which half of the changes are soft, one beyond the fine cell.
const FLIP_SHIFTS: [f64; 2] = [0.125, 0.6];

/// Samples at each shift, screen axis and scene: a soft change that is counted as a hard one doubles a share of 0.1.
const FLIP_SAMPLES: usize = 1 << 15;

/// How much smaller the cells are than those of [`FINEST_VIEW`] where only the view of a point changes: again 10^5
/// intervals. Much smaller ones would be so for the coordinates that the robust threshold raises them.
const FINE_VIEWS: f64 = 256.0;

/// Points whose flips are counted over a whole motion: a flip more in 25 points and octaves shows; leaving out Eq. 2
/// takes away one in 12 at an alpha of 0.1.
const FLIP_POINTS: usize = 1 << 14;

/// Views of a point less one: few passages of alpha fall between two of them in twos. The prediction is about the views
/// themselves and does not count those either.
const FLIP_STEPS: usize = 16;

/// Frames over which a skinned surface bends: 0.32 radians of its bone, half an octave and more where it bends most.
const SKINNED_FRAMES: f64 = 16.0;

/// Flips under a shift by a part of a pixel: soft and hard changes.
pub const TRANSLATION: Claim = Claim {
    id: "flips.translation",
    anchor: "§5 (sub-pixel translations); closed form not in the paper",
    statement: "a sub-pixel shift makes the predicted share of fragments of one alpha appear or disappear: half of the \
                changes are soft, with the hash of the coarse cell in common",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.06)),
    run: translation,
};

/// Flips while the camera comes closer by an octave.
pub const ZOOM: Claim = Claim {
    id: "flips.zoom",
    anchor: "§5.4.2 (interpolating between two scales); closed form not in the paper",
    statement: "while the camera comes closer by an octave, fragments of one alpha appear or disappear as often as the \
                join has it: 0.26, 0.45 and 0.5 times at an alpha of 0.1, 0.3 and 0.5 in the paper",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.2)),
    run: |subject, draw| sweep(subject, draw, ZOOM.id, |rng| views(subject, rng, zoomed)),
};

/// Flips while the object turns about the line of sight.
pub const ROTATION: Claim = Claim {
    id: "flips.rotation",
    anchor: "§5.4, §6.2 (maximum over the derivatives); closed form not in the paper",
    statement: "while the object turns about the line of sight by a quarter, fragments of one alpha appear or disappear \
                as often as the change of the scales predicts",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.25)),
    run: |subject, draw| {
        sweep(subject, draw, ROTATION.id, |rng| views(subject, rng, |t, at| turned(t, FRAC_PI_2 * at)))
    },
};

/// Flips while the surface tilts.
pub const TILT: Claim = Claim {
    id: "flips.tilt",
    anchor: "§6 (surfaces at grazing angles); closed form not in the paper",
    statement: "while the surface tilts to 85 degrees, fragments of one alpha appear or disappear as often as the change \
                of the scales predicts",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.3)),
    run: |subject, draw| {
        sweep(subject, draw, TILT.id, |rng| views(subject, rng, |t, at| tilted(t, TILT_OCTAVES * at)))
    },
};

/// Flips of a skinned surface, whose object coordinates are those of the bind pose.
pub const SKINNING: Claim = Claim {
    id: "flips.skinning",
    anchor: "GDC 2017 (object skinning); closed form not in the paper",
    statement: "while a skinned surface bends, fragments of one alpha appear or disappear only as often as the change of \
                the scales predicts: the cells of a point stay those of the bind pose",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.15)),
    run: |subject, draw| sweep(subject, draw, SKINNING.id, |rng| skinned(subject, rng)),
};

fn translation(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(TRANSLATION.id);
    let mut points = Vec::new();
    let mut worst = (1.0, 0.0);
    let (mut n, mut seen, mut effect) = (0, String::new(), 0.0_f64);
    for scene in general_scenes() {
        for along_x in [true, false] {
            for shift in FLIP_SHIFTS {
                let (mut before, mut after) = (Vec::new(), Vec::new());
                let mut expected = [[0.0; 2]; ALPHAS.len()];
                for _ in 0..draw.samples(FLIP_SAMPLES) {
                    let place = placement(&mut rng) * WIDE;
                    let here = sighting(&scene, &mut rng).placed(place, subject.precision);
                    let footprint = here.fragment.footprint;
                    let motion = if along_x { footprint.dpdx } else { footprint.dpdy } * shift;
                    let pair = PairLaw::new(subject, &subject.nominal(&footprint), motion);
                    for (alpha, [mean, variance]) in ALPHAS.into_iter().zip(&mut expected) {
                        let probability =
                            2.0 * alpha * (1.0 - alpha) * (1.0 - pair.visibility_correlation(alpha));
                        *mean += probability;
                        *variance += probability * (1.0 - probability);
                    }
                    before.push(here.fragment);
                    after.push(here.moved(motion, subject.precision).fragment);
                }
                let (old, new) = (subject.thresholds(&before), subject.thresholds(&after));
                reject_outsiders(subject, &before, &old)?;
                reject_outsiders(subject, &after, &new)?;
                let count = before.len() as f64;
                for (alpha, [mean, variance]) in ALPHAS.into_iter().zip(expected) {
                    let flips =
                        old.iter().zip(&new).filter(|(a, b)| (**a <= alpha) != (**b <= alpha)).count();
                    let test = poisson_binomial::sum_of_events(flips as u64, mean, variance);
                    let series =
                        format!("{}, {shift} px along {}", scene.name, if along_x { "x" } else { "y" });
                    let point = ComparedShare {
                        series,
                        x: alpha,
                        measured: flips as f64 / count,
                        predicted: mean / count,
                        sigma: variance.sqrt() / count,
                    };
                    if test.p < worst.0 {
                        worst = (test.p, test.z);
                        seen = format!(
                            "{}: {:.4} of fragments of alpha {alpha} flip, {:.4} are predicted",
                            point.series, point.measured, point.predicted
                        );
                    }
                    effect = effect.max((point.measured - point.predicted).abs());
                    points.push(point);
                }
                n += before.len() as u64;
            }
        }
    }
    Ok(Trial {
        conclusion: Conclusion::Probability((worst.0 * points.len() as f64).min(1.0)),
        statistic: Some(worst.1),
        statistic_name: format!("z, worst of {}", points.len()),
        n,
        effect: Some(effect),
        effect_name: "error in the share that flips",
        detectable: detectable_error(&points),
        seen,
        evidence: Evidence::Quantity { abscissa: "alpha", ordinate: "share that flips", points },
    })
}

/// Draws a point, and its views while its derivatives change.
fn views(
    subject: &Subject<'_>,
    rng: &mut Xoshiro256PlusPlus,
    derivatives: fn([DVec3; 2], f64) -> [DVec3; 2],
) -> Vec<Fragment> {
    let position = placement(rng);
    let tangents = tangents(rng).map(|tangent| tangent / FINE_VIEWS);
    let view = |step: usize| {
        let [dpdx, dpdy] = derivatives(tangents, step as f64 / FLIP_STEPS as f64);
        subject.precision.round(&Footprint { position, dpdx, dpdy }).into()
    };
    (0..=FLIP_STEPS).map(view).collect()
}

/// Draws a point of a surface, and its views while the surface bends.
fn skinned(subject: &Subject<'_>, rng: &mut Xoshiro256PlusPlus) -> Vec<Fragment> {
    let scene = &general_scenes()[0];
    loop {
        let found = sighting(scene, rng);
        let place = placement(rng) * WIDE;
        let view = |step: usize| {
            let frames = SKINNED_FRAMES * step as f64 / FLIP_STEPS as f64;
            let bent =
                Motion::Skinning.fragment(&scene.camera, found.surface(), frames, found.fragment.world)?;
            Some(placed(&bent, place, subject.precision))
        };
        if let Some(views) = (0..=FLIP_STEPS).map(view).collect() {
            return views;
        }
    }
}

/// Flips of one alpha, point by point, beside those that are predicted.
struct Tally {
    alpha: f64,
    flips: u64,
    expected: f64,
    /// Squares of the differences: points are independent, the flips of a point are not.
    squares: f64,
}

/// Compares the flips of points over their views with those that the change of the scales predicts.
fn sweep(
    subject: &Subject<'_>,
    draw: &Draw,
    claim: &str,
    mut views: impl FnMut(&mut Xoshiro256PlusPlus) -> Vec<Fragment>,
) -> Attempt<Trial> {
    let mut rng = draw.rng(claim);
    let mut tallies = ALPHAS.map(|alpha| Tally { alpha, flips: 0, expected: 0.0, squares: 0.0 });
    let points = draw.samples(FLIP_POINTS);
    let mut left = points;
    while left > 0 {
        let batch = left.min(1024);
        left -= batch;
        let fragments: Vec<Fragment> = (0..batch).flat_map(|_| views(&mut rng)).collect();
        let thresholds = subject.thresholds(&fragments);
        reject_outsiders(subject, &fragments, &thresholds)?;
        for (views, thresholds) in
            fragments.chunks_exact(FLIP_STEPS + 1).zip(thresholds.chunks_exact(FLIP_STEPS + 1))
        {
            let nominal: Vec<_> = views.iter().map(|view| subject.nominal(&view.footprint)).collect();
            for tally in &mut tallies {
                let alpha = tally.alpha;
                let flips = thresholds.windows(2).filter(|t| (t[0] <= alpha) != (t[1] <= alpha)).count();
                let between = |pair: &[_]| flip_between(subject, &pair[0], &pair[1], alpha);
                let expected: f64 = nominal.windows(2).map(between).sum();
                tally.flips += flips as u64;
                tally.expected += expected;
                tally.squares += (flips as f64 - expected) * (flips as f64 - expected);
            }
        }
    }
    Ok(trial(&tallies, points as f64))
}

fn trial(tallies: &[Tally], points: f64) -> Trial {
    let tests = tallies.len() as f64;
    let (mut worst, mut seen, mut effect, mut sigma) = (0.0_f64, String::new(), 0.0_f64, 0.0_f64);
    let mut shares = Vec::new();
    for Tally { alpha, flips, expected, squares } in tallies {
        let difference = *flips as f64 - expected;
        let z = if difference == 0.0 { 0.0 } else { difference / squares.sqrt() };
        if seen.is_empty() || z.abs() > worst.abs() {
            worst = z;
            seen = format!(
                "a fragment of alpha {} flips {:.4} times, {:.4} are predicted",
                alpha,
                *flips as f64 / points,
                expected / points
            );
        }
        effect = effect.max((difference / points).abs());
        sigma = sigma.max(squares.sqrt() / points);
        shares.push(ComparedShare {
            series: "views of one point".into(),
            x: *alpha,
            measured: *flips as f64 / points,
            predicted: expected / points,
            sigma: squares.sqrt() / points,
        });
    }
    Trial {
        conclusion: Conclusion::Probability((tests * normal::two_sided_p(worst)).min(1.0)),
        statistic: Some(worst),
        statistic_name: format!("z, worst of {tests}"),
        n: points as u64,
        effect: Some(effect),
        effect_name: "error in the flips of a fragment",
        detectable: Some(power::detectable_shift_z(sigma, SINGLE_LEVEL / tests, POWER)),
        seen,
        evidence: Evidence::Quantity { abscissa: "alpha", ordinate: "flips of a fragment", points: shares },
    }
}
