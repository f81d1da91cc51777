//! Cells in odd places: around the origin, far away, and in the mirror.

use crate::check::evidence::NamedHistogram;
use crate::check::input::{UsedCells, at_scale, draw_cell};
use crate::check::judge::uncorrelated;
use crate::check::tolerance::{BINS, DRAWS_A_SAMPLE, FAMILY_LEVEL, POWER, SINGLE_LEVEL};
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::stats::chi_square::{self, ChiSquare};
use crate::stats::histogram::Histogram;
use crate::stats::{correlation, ecdf, power, seed};
use crate::threshold::footprint::Footprint;
use glam::{DVec3, dvec3};
use rand::rngs::Xoshiro256PlusPlus;

/// Octaves in which the surroundings of the origin are seen: as many as leave the squares of `f32` derivatives finite.
const ORIGIN_OCTAVES: core::ops::Range<i32> = -32..32;

/// Cells between the origin and a window: from 2^24 on `f32` has no neighbouring cells.
const WINDOW_OFFSETS: [f64; 5] = [0.0, 4096.0, 65_536.0, 1_048_576.0, 8_388_608.0];

/// Cells of a window along each axis: flat enough that a bias of single layers of z shows where it grows.
const WINDOW_SIZE: [f64; 3] = [2048.0, 2048.0, 16.0];

/// Samples in each window: 2048 a layer, which shows when the layers have fewer than 750 different values each.
const WINDOW_SAMPLES: usize = 1 << 15;

/// Pairs of a cell and its image: sees a correlation of 0.035.
const MIRROR_PAIRS: usize = 1 << 16;

/// The law around the object's origin, over its distances.
pub const ORIGIN: Claim = Claim {
    id: "cells.origin",
    anchor: "§5.1 (hash3D at the origin), not in the paper",
    statement: "next to the object's origin, in every octant, thresholds at different scales are uniform",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.7)),
    run: origin,
};

/// The law far from the object's origin.
pub const WINDOW: Claim = Claim {
    id: "cells.window",
    anchor: "§5.1 (hash inputs of any size), not in the paper",
    statement: "thresholds are uniform in windows of cells up to 2^23 cells away from the origin",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.03)),
    run: window,
};

/// Symmetries of the grid.
pub const MIRROR: Claim = Claim {
    id: "cells.mirror",
    anchor: "§5.1 (hash outputs replace uniform random numbers), not in the paper",
    statement: "thresholds of mirrored cells and of cells with two coordinates exchanged are uncorrelated",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.1)),
    run: mirror,
};

/// Draws a place within an octave along each axis.
fn fractions(rng: &mut Xoshiro256PlusPlus) -> [f64; 3] {
    // Away from the ends, so that rounding does not lead into another octave.
    [0; 3].map(|_| 0.01 + 0.98 * seed::uniform01(rng))
}

fn origin(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(ORIGIN.id);
    let mut worst: Option<(ecdf::KolmogorovSmirnov, String)> = None;
    for octant in 0..8_u32 {
        let sign = DVec3::from_array([1, 2, 4].map(|bit| if octant & bit == 0 { 1.0 } else { -1.0 }));
        // All weight on one octave, so that no two of the thresholds share a hash.
        let samples: Vec<Footprint<f64>> = ORIGIN_OCTAVES
            .map(|octave| {
                let side = libm::exp2(f64::from(-octave));
                let mut part = || side * (seed::uniform01(&mut rng) + 1.0) / 1024.0;
                let position = dvec3(part(), part(), part()) * sign;
                let scale = [f64::from(octave); 3];
                subject.precision.round(&at_scale(subject.variant, subject.hash_scale, position, scale))
            })
            .collect();
        let mut values = subject.thresholds(&samples);
        reject_outsiders(subject, &samples, &values)?;
        let Ok(distance) = ecdf::kolmogorov_smirnov(&mut values) else { continue };
        if worst.as_ref().is_none_or(|(w, _)| distance.d > w.d) {
            let range = format!("from {:.6} to {:.6}", values[0], values[values.len() - 1]);
            values.dedup();
            let signs = sign.to_array().map(|s| if s > 0.0 { '+' } else { '-' });
            let seen = format!(
                "octant {}: {} different thresholds in {} octaves, {range}",
                signs.iter().collect::<String>(),
                values.len(),
                distance.n
            );
            worst = Some((distance, seen));
        }
    }
    let Some((distance, seen)) = worst else {
        return Ok(Trial::without(Conclusion::Inconclusive, "no octave was tried"));
    };
    Ok(Trial {
        conclusion: Conclusion::Probability((8.0 * distance.dkwm).min(1.0)),
        statistic: Some(distance.d),
        statistic_name: "Kolmogorov-Smirnov distance, worst of 8".into(),
        n: 8 * distance.n,
        effect: Some(distance.d),
        effect_name: "largest error in coverage",
        detectable: Some(power::detectable_distance_ks(distance.n, SINGLE_LEVEL / 8.0, POWER)),
        seen,
        evidence: Evidence::None,
    })
}

fn window(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(WINDOW.id);
    let directions = [("x", DVec3::X), ("all axes", DVec3::ONE)];
    let mut tests: Vec<ChiSquare> = Vec::new();
    let mut evidence = Vec::new();
    for offset in WINDOW_OFFSETS {
        for (along, direction) in directions {
            let n = draw.stream(WINDOW_SAMPLES);
            let mut used = UsedCells::of(draw, 2 * n);
            let mut counts = Histogram::new(BINS);
            for chunk in draw.chunks(n) {
                let samples = window_samples(subject, direction * offset, chunk, &mut used, &mut rng);
                let values = subject.thresholds(&samples);
                reject_outsiders(subject, &samples, &values)?;
                counts.extend(values);
            }
            let name = format!("{offset} cells along {along}");
            let Ok(test) = chi_square::uniform(counts.counts()) else { continue };
            tests.push(test);
            evidence.push(NamedHistogram::new(name, &counts));
        }
    }
    let failed = tests.iter().position(|test| test.p * (tests.len() as f64) < FAMILY_LEVEL);
    let seen = failed.map_or_else(String::new, |first| {
        format!(
            "the first window that is not uniform is {}: chi-square {:.0} over {} dof",
            evidence[first].name, tests[first].statistic, tests[first].dof
        )
    });
    let n = tests.iter().map(|test| test.n).sum();
    Ok(Trial::worst_of(&tests, n, seen, Evidence::Histograms(evidence)))
}

/// Draws `n` footprints whose cells lie in a window that begins at `offset`, none of which touches a cell that is used; fewer
/// when the window has not enough cells.
///
/// At a scale of 1: all weight is on one octave, and positions are exact as far out as the indices of the cells are.
fn window_samples(
    subject: &Subject<'_>,
    offset: DVec3,
    n: usize,
    used: &mut UsedCells,
    rng: &mut Xoshiro256PlusPlus,
) -> Vec<Footprint<f64>> {
    let mut samples = Vec::with_capacity(n);
    for _ in 0..n * DRAWS_A_SAMPLE {
        if samples.len() == n {
            break;
        }
        let within = WINDOW_SIZE.map(|size| (seed::uniform01(rng) * size).floor());
        let position = offset + DVec3::from_array(within);
        let sample = at_scale(subject.variant, subject.hash_scale, position, [0.0; 3]);
        let sample = subject.precision.round(&sample);
        if used.claim(subject, &[sample]) {
            samples.push(sample);
        }
    }
    samples
}

fn mirror(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    type Symmetry = fn(DVec3) -> DVec3;
    const SYMMETRIES: [(&str, Symmetry); 3] = [
        ("opposite cells", |v| -v),
        ("cells opposite in x and y", |v| dvec3(-v.x, -v.y, v.z)),
        ("cells with x and y exchanged", |v| dvec3(v.y, v.x, v.z)),
    ];
    let mut rng = draw.rng(MIRROR.id);
    let pairs = draw.stream(MIRROR_PAIRS);
    let mut used = UsedCells::of(draw, 8 * pairs);
    let mut moments = [correlation::Moments::default(); SYMMETRIES.len()];
    for chunk in draw.chunks(pairs) {
        let mut samples: Vec<Footprint<f64>> = Vec::with_capacity(4 * chunk);
        for _ in 0..chunk * DRAWS_A_SAMPLE {
            if samples.len() == 4 * chunk {
                break;
            }
            let cell = draw_cell(&mut rng);
            // Corners of cells, so that the mirrored position is the corner of the mirrored cell.
            let first = at_scale(subject.variant, subject.hash_scale, cell, fractions(&mut rng));
            // All cells that are their own image have x = y.
            let on_a_mirror = cell.x == cell.y;
            let image = |map: Symmetry| {
                let [position, dpdx, dpdy] = [first.position, first.dpdx, first.dpdy].map(map);
                subject.precision.round(&Footprint { position, dpdx, dpdy })
            };
            let group =
                [image(|v| v), image(SYMMETRIES[0].1), image(SYMMETRIES[1].1), image(SYMMETRIES[2].1)];
            if !on_a_mirror && used.claim(subject, &group) {
                samples.extend(group);
            }
        }
        let values = subject.thresholds(&samples);
        reject_outsiders(subject, &samples, &values)?;
        let column = |which: usize| values.iter().skip(which).step_by(4).copied().collect::<Vec<f64>>();
        let first = column(0);
        for (index, sums) in moments.iter_mut().enumerate() {
            sums.merge(&correlation::Moments::of(&first, &column(index + 1)));
        }
    }
    let worst = SYMMETRIES
        .iter()
        .zip(moments)
        .filter_map(|((name, _), sums)| Some((sums.correlation().ok()?, *name)))
        .max_by(|a, b| a.0.r.abs().total_cmp(&b.0.r.abs()));
    let Some((found, name)) = worst else {
        return Ok(Trial::without(Conclusion::Exact { holds: false }, "the threshold is a constant"));
    };
    let seen = format!("thresholds of {name} have a correlation of {:+.4}", found.r);
    Ok(uncorrelated(&found, SYMMETRIES.len(), seen))
}
