//! Transparent layers one behind the other: each lets its own share through, whatever the others do.

use super::uniform::reject_outsiders;
use super::{Attempt, Claim, Conclusion, Promise, Trial};
use crate::check::sample::{UsedCells, placement, sighting};
use crate::check::tolerance::{
    DRAWS_A_SAMPLE, LAYER_PAIRS, LAYER_SAMPLES, LEAST_LAYER_DISTANCE, PAIR_BINS, PLACEMENT,
};
use crate::check::{Draw, Evidence, Subject, Verdict};
use crate::scene::{Fragment, Scene};
use crate::stats::chi_square::{self, ChiSquare};
use crate::stats::correlation;
use crate::stats::seed::uniform01;
use rand::rngs::Xoshiro256PlusPlus;

/// Pairs of thresholds at the same x and y on two planes of constant z.
pub const PARALLEL: Claim = Claim {
    id: "layers.parallel",
    anchor: "§5.3 (including z in the hash removes correlations)",
    statement: "thresholds at the same x and y on two planes of constant z are uniform and independent, so that two \
                half-transparent layers are both kept at a quarter of the pixels",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.015)),
    run: parallel,
};

fn parallel(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(PARALLEL.id);
    let Some(wall) = Scene::all().into_iter().find(|scene| scene.name == "wall") else {
        return Ok(Trial::without(Conclusion::Inconclusive, "there is no scene of that name"));
    };
    let mut pooled = vec![0; PAIR_BINS * PAIR_BINS];
    let (mut squares, mut visible): (Vec<ChiSquare>, Vec<ChiSquare>) = (Vec::new(), Vec::new());
    let mut worst = 0.0_f64;
    for _ in 0..LAYER_PAIRS {
        let samples = samples(subject, &wall, draw.samples(LAYER_SAMPLES), &mut rng);
        let values = subject.thresholds(&samples);
        reject_outsiders(&samples, &values)?;
        let pairs = || values.chunks_exact(2).map(|pair| (pair[0], pair[1]));
        let table = correlation::pair_table(pairs(), PAIR_BINS);
        pooled.iter_mut().zip(&table).for_each(|(sum, count)| *sum += count);
        squares.extend(chi_square::uniform(&table));
        let n = pairs().count() as u64;
        // A fragment is kept where its alpha is not below the threshold.
        let both = pairs().filter(|&(near, far)| near <= 0.5 && far <= 0.5).count() as u64;
        visible.extend(chi_square::against(&[both, n - both], &[0.25, 0.75]));
        let error = both as f64 / n as f64 - 0.25;
        if error.abs() > worst.abs() {
            worst = error;
        }
    }
    // Summed over the pairs of layers: what is wrong with one adds up with what is wrong with the next.
    let sum =
        |a: ChiSquare, b: ChiSquare| ChiSquare::new(a.statistic + b.statistic, a.dof + b.dof, a.n + b.n);
    let tests: Vec<ChiSquare> =
        [squares, visible].into_iter().filter_map(|of| of.into_iter().reduce(sum)).collect();
    let per_dof: Vec<String> =
        tests.iter().map(|test| format!("{:.2}", test.statistic / test.dof as f64)).collect();
    let seen = format!(
        "the share of pixels that keep both of two half-transparent layers is off from a quarter by up to {:+.2} %; \
         chi-square per dof of the pairs, and of that share: {}",
        100.0 * worst,
        per_dof.join(", ")
    );
    Ok(Trial::worst_of(
        &tests,
        pooled.iter().sum(),
        seen,
        Evidence::Pairs { side: PAIR_BINS, counts: pooled },
    ))
}

/// Fragments in twos, at the same place on two planes of constant z; no two pairs touch the same cell.
fn samples(subject: &Subject<'_>, wall: &Scene, n: usize, rng: &mut Xoshiro256PlusPlus) -> Vec<Fragment> {
    let place = placement(rng);
    let mut height = || (2.0 * uniform01(rng) - 1.0) * PLACEMENT;
    let near = height();
    let far = loop {
        let far = height();
        if (far - near).abs() >= LEAST_LAYER_DISTANCE {
            break far;
        }
    };
    let mut used = UsedCells::default();
    let mut samples = Vec::with_capacity(2 * n);
    for _ in 0..n * DRAWS_A_SAMPLE {
        if samples.len() == 2 * n {
            break;
        }
        let found = sighting(wall, rng);
        // The camera looks along -z, from far enough away that both are seen at the same pixel.
        let pair = [(near, far), (far, near)].map(|(z, other)| {
            let mut fragment = found.placed(place.with_z(z), subject.precision).fragment;
            fragment.world.z += z;
            fragment.eye.z -= z;
            fragment.layer = u32::from(other > z);
            fragment
        });
        if used.claim(subject, &pair) {
            samples.extend(pair);
        }
    }
    samples
}
