//! Thresholds of different cells have nothing to do with each other.

use super::uniform::reject_outsiders;
use super::{Attempt, Claim, Trial};
use crate::check::sample::{UsedCells, footprint, general_scenes, moved, placement};
use crate::check::tolerance::{DRAWS_A_PLACE, DRAWS_A_SAMPLE, NEIGHBOUR_PAIRS, PAIR_BINS};
use crate::check::{Evidence, Subject, Verdict};
use crate::stats::{chi_square, correlation, seed};
use crate::threshold::footprint::Footprint;
use glam::DVec3;

/// Serial test of neighbouring coarse cells.
pub const NEIGHBOURS: Claim = Claim {
    id: "independence.neighbours",
    anchor: "§5 (hash outputs replace uniform random numbers)",
    statement: "thresholds in neighbouring coarse cells along x, y and z are independent",
    expected: Verdict::Consistent,
    run: neighbours,
};

fn neighbours(subject: &Subject<'_>, seed: u64) -> Attempt<Trial> {
    let mut rng = seed::rng(NEIGHBOURS.id, seed);
    let scenes = general_scenes();
    let mut used = UsedCells::default();
    let mut tests = Vec::new();
    let mut pooled = vec![0; PAIR_BINS * PAIR_BINS];
    for (axis, direction) in DVec3::AXES.into_iter().enumerate() {
        let mut pairs: Vec<Footprint<f64>> = Vec::with_capacity(2 * NEIGHBOUR_PAIRS);
        let mut place = DVec3::ZERO;
        for draw in 0..NEIGHBOUR_PAIRS * DRAWS_A_SAMPLE {
            if pairs.len() == 2 * NEIGHBOUR_PAIRS {
                break;
            }
            if draw % DRAWS_A_PLACE == 0 {
                place = placement(&mut rng);
            }
            let found = footprint(&scenes[draw % scenes.len()], &mut rng);
            let first = moved(&found, place, subject.precision);
            // One coarse cell further along the axis, wherever the surface goes.
            let cell = 1.0 / subject.nominal(&first).coarse_scale[axis];
            let second = moved(&first, direction * cell, subject.precision);
            if used.claim(subject, &[first, second]) {
                pairs.extend([first, second]);
            }
        }
        let values = subject.thresholds(&pairs);
        reject_outsiders(&pairs, &values)?;
        let table = correlation::pair_table(values.chunks_exact(2).map(|pair| (pair[0], pair[1])), PAIR_BINS);
        pooled.iter_mut().zip(&table).for_each(|(sum, count)| *sum += count);
        tests.extend(chi_square::independence(&table, PAIR_BINS));
    }
    let n = pooled.iter().sum();
    let seen = "thresholds of neighbouring cells depend on each other".into();
    Ok(Trial::worst_of(&tests, n, seen, Evidence::Pairs { side: PAIR_BINS, counts: pooled }))
}
