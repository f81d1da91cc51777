//! Coverage, surface by surface: its mean, and how much it varies from place to place.
//!
//! A pooled test lets the errors of two surfaces cancel, and a mean says nothing of clumps: neighbouring pixels share
//! cells, so the coverage of a block of pixels varies more than that of as many coins, by the design effect.

use crate::check::evidence::ComparedShare;
use crate::check::input::{Patch, UsedCells, general_scenes, more_independent};
use crate::check::judge::detectable_error;
use crate::check::predict::PairLaw;
use crate::check::subject::Nominal;
use crate::check::tolerance::TILT_STRETCH;
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::scene::{Fragment, Scene};
use crate::stats::binomial;
use crate::stats::variance::Variance;
use glam::DVec2;

/// Samples of each surface on which coverage is measured: every share is known to 0.3 %.
const COVERAGE_SAMPLES: usize = 1 << 15;

/// Alphas at which coverage is measured on each surface, among them those of a thin and of a dense texture.
const COVERAGE_ALPHAS: [f64; 4] = [0.1, 0.3, 0.5, 0.9];

/// Blocks whose coverage is compared with each other: a variance is known to 3 % on either side of lerp factor 1/2.
const COVERAGE_BLOCKS: usize = 1 << 12;

/// Blocks that share a patch, each at a place of its own.
const BLOCKS_A_PATCH: usize = 16;

/// Places along a side of a block, half the claimed size of the noise apart: a block holds some thirty cells, so that its
/// mean is near normal.
const BLOCK_SIDE: usize = 12;

/// Alphas at which the variance is measured: the kurtosis of a kept cell is then negative, which errs on the safe side.
const VARIANCE_ALPHAS: [f64; 3] = [0.3, 0.5, 0.7];

/// Share kept on each surface in general position.
pub const MEAN: Claim = Claim {
    id: "coverage.mean",
    anchor: "§4 (expected visibility is alpha)",
    statement: "on each surface in general position, fragments of alpha 0.1, 0.3, 0.5 and 0.9 are kept with just that \
                probability",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.06)),
    run: |subject, draw| mean(&MEAN, general_scenes(), subject, draw),
};

/// The same on walls, floors and cards.
pub const MEAN_ALIGNED: Claim = Claim {
    id: "coverage.mean_aligned",
    anchor: "§4 (expected visibility is alpha)",
    statement: "on each wall, floor and card, fragments of alpha 0.1, 0.3, 0.5 and 0.9 are kept with just that \
                probability",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.06)),
    run: |subject, draw| {
        let aligned = Scene::all().into_iter().filter(|scene| !scene.general_position).collect();
        mean(&MEAN_ALIGNED, aligned, subject, draw)
    },
};

/// Variance of the coverage of blocks, on either side.
pub const VARIANCE: Claim = Claim {
    id: "coverage.variance",
    anchor: "§4, §5.4; closed form not in the paper",
    statement: "the coverage of blocks of a surface varies as much as cells of the claimed size make it: not more, as \
                clumps would, and not less, as white or ordered noise would",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.8)),
    run: variance,
};

fn mean(claim: &Claim, scenes: Vec<Scene>, subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(claim.id);
    let mut points = Vec::new();
    let (mut n, mut least_p) = (0, 1.0_f64);
    for scene in scenes {
        // A place for every sample: the law of one single plane is another claim.
        let name = scene.name;
        let scene = [scene];
        let samples = draw.stream(COVERAGE_SAMPLES);
        let mut used = UsedCells::of(draw, 2 * samples);
        let (mut count, mut passed) = (0, [0; COVERAGE_ALPHAS.len()]);
        for chunk in draw.chunks(samples) {
            let samples = more_independent(subject, &scene, chunk, 1, &mut used, &mut rng);
            let values = subject.thresholds(&samples);
            reject_outsiders(subject, &samples, &values)?;
            count += values.len() as u64;
            for (passed, alpha) in passed.iter_mut().zip(COVERAGE_ALPHAS) {
                *passed += values.iter().filter(|&&threshold| threshold <= alpha).count() as u64;
            }
        }
        if count == 0 {
            continue;
        }
        for (alpha, kept) in COVERAGE_ALPHAS.into_iter().zip(passed) {
            least_p = least_p.min(binomial::two_sided_p(kept, count, alpha));
            points.push(ComparedShare {
                series: name.to_owned(),
                x: alpha,
                measured: kept as f64 / count as f64,
                predicted: alpha,
                sigma: (alpha * (1.0 - alpha) / count as f64).sqrt(),
            });
        }
        n += count;
    }
    let z = |point: &ComparedShare| (point.measured - point.predicted) / point.sigma;
    let Some(worst) = points.iter().max_by(|a, b| z(a).abs().total_cmp(&z(b).abs())) else {
        return Ok(Trial::without(Conclusion::Inconclusive, "the scenes gave no samples"));
    };
    Ok(Trial {
        conclusion: Conclusion::Probability((least_p * points.len() as f64).min(1.0)),
        statistic: Some(z(worst)),
        statistic_name: format!("z, worst of {}", points.len()),
        n,
        effect: points.iter().map(|point| (point.measured - point.predicted).abs()).reduce(f64::max),
        effect_name: "error in coverage",
        detectable: detectable_error(&points),
        seen: format!("{}: {:.2} % are kept at alpha {}", worst.series, 100.0 * worst.measured, worst.x),
        evidence: Evidence::Quantity { abscissa: "alpha", ordinate: "share kept", points },
    })
}

/// The blocks of one kind: how far the coverage of each is from alpha, in predicted standard deviations.
struct Blocks {
    name: &'static str,
    scores: [Vec<f64>; VARIANCE_ALPHAS.len()],
}

fn variance(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(VARIANCE.id);
    // What is wrong with the weights of two octaves has another sign on the other side of 1/2.
    let mut groups = ["lerp factor below 1/2", "lerp factor above 1/2"]
        .map(|name| Blocks { name, scores: Default::default() });
    let patches = draw.samples(COVERAGE_BLOCKS).div_ceil(BLOCKS_A_PATCH);
    for index in 0..patches {
        let stretch = [1.0, TILT_STRETCH, 1.0 / TILT_STRETCH][index % 3];
        let patch = Patch::draw(subject, stretch, &mut rng);
        let spacing = 0.5 * subject.hash_scale;
        let blocks: Vec<Fragment> = (0..BLOCKS_A_PATCH)
            .flat_map(|_| patch.image(subject, [BLOCK_SIDE; 2], spacing, &mut rng))
            .collect();
        let values = subject.thresholds(&blocks);
        reject_outsiders(subject, &blocks, &values)?;
        let nominal = subject.nominal(&blocks[0].footprint);
        let above = nominal.lerp_factor >= 0.5;
        let predicted = predicted_variances(subject, &patch, &nominal, spacing);
        for ((alpha, predicted), scores) in
            VARIANCE_ALPHAS.into_iter().zip(predicted).zip(&mut groups[usize::from(above)].scores)
        {
            scores.extend(values.chunks_exact(BLOCK_SIDE * BLOCK_SIDE).map(|block| {
                let kept = block.iter().filter(|&&threshold| threshold <= alpha).count();
                (kept as f64 / block.len() as f64 - alpha) / predicted.sqrt()
            }));
        }
    }
    Ok(judged(&groups))
}

/// The variance of the coverage of a block at each alpha: that of independent fragments, times the design effect.
fn predicted_variances(
    subject: &Subject<'_>,
    patch: &Patch,
    nominal: &Nominal,
    spacing: f64,
) -> [f64; VARIANCE_ALPHAS.len()] {
    let side = BLOCK_SIDE as i32;
    let mut sums = [0.0; VARIANCE_ALPHAS.len()];
    for y in 1 - side..side {
        for x in 1 - side..side {
            let lag = patch.lag(DVec2::new(f64::from(x), f64::from(y)) * spacing);
            let pair = PairLaw::new(subject, nominal, lag);
            let pairs = f64::from((side - x.abs()) * (side - y.abs()));
            for (sum, alpha) in sums.iter_mut().zip(VARIANCE_ALPHAS) {
                *sum += pairs * pair.visibility_correlation(alpha);
            }
        }
    }
    let places = f64::from(side * side);
    [0, 1, 2].map(|i| VARIANCE_ALPHAS[i] * (1.0 - VARIANCE_ALPHAS[i]) * sums[i] / (places * places))
}

fn judged(groups: &[Blocks]) -> Trial {
    let (mut points, mut least_p, mut n) = (Vec::new(), 1.0_f64, 0);
    for Blocks { name, scores } in groups {
        n += scores[0].len() as u64;
        for (alpha, scores) in VARIANCE_ALPHAS.into_iter().zip(scores) {
            let Ok(found) = Variance::of(scores) else { continue };
            least_p = least_p.min(found.against(1.0).two_sided_p());
            points.push(ComparedShare {
                series: (*name).to_owned(),
                x: alpha,
                measured: found.variance,
                predicted: 1.0,
                sigma: (2.0 / found.dof as f64).sqrt(),
            });
        }
    }
    let error = |point: &ComparedShare| (point.measured - 1.0).abs();
    let Some(worst) = points.iter().max_by(|a, b| error(a).total_cmp(&error(b))) else {
        return Trial::without(Conclusion::Inconclusive, "there were no blocks");
    };
    Trial {
        conclusion: Conclusion::Probability((least_p * points.len() as f64).min(1.0)),
        statistic: Some(worst.measured),
        statistic_name: format!("variance / predicted, worst of {}", points.len()),
        n,
        effect: Some(error(worst)),
        effect_name: "relative error in the variance of coverage",
        detectable: detectable_error(&points),
        seen: format!(
            "{}, alpha {}: the coverage of blocks varies {:.2} times as much as predicted",
            worst.series, worst.x, worst.measured
        ),
        evidence: Evidence::Quantity { abscissa: "alpha", ordinate: "variance / predicted", points },
    }
}
