//! The hash of single cells, seen through thresholds at whole octaves, where the other octave has no weight.

use crate::check::draw::KEPT_LIMIT;
use crate::check::evidence::NamedHistogram;
use crate::check::input::{UsedCells, draw_cell, in_cell};
use crate::check::judge::{detectable_factor, uncorrelated};
use crate::check::tolerance::{BINS, DRAWS_A_SAMPLE, FAR_PAIRS, PAIR_BINS};
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::stats::histogram::Histogram;
use crate::stats::{binomial, chi_square, correlation};
use crate::threshold::footprint::Footprint;
use glam::{DVec3, dvec3};
use rand::rngs::Xoshiro256PlusPlus;

/// Pairs of neighbours whose difference is taken, along each of four directions: 1024 expected in every bin.
const DIFFERENCE_PAIRS: usize = 1 << 16;

/// Cells whose thresholds are compared with each other: 512 pairs meet at [`MEETING_VALUES`].
const VALUE_CELLS: usize = 1 << 16;

/// Share of pairs of cells that may have one threshold: four times that of a lattice of 2^24 values.
const MEETING_VALUES: f64 = 1.0 / 4_194_304.0;

/// Cells in x and y between which both phases of the sine hash, 17 x + 0.1 y and 13 y + x, advance by all but a whole
/// number of half turns; its two-dimensional form has correlations up to 0.2 there.
const RESONANCES: [[i32; 2]; 5] = [[355, 0], [710, 0], [3726, -232], [3460, -785], [2750, -785]];

/// Pairs of cells at each resonance: shows a correlation of 0.03.
const RESONANCE_PAIRS: usize = 1 << 16;

/// A cell and the eight cells of the next octave that lie in it.
pub const CHILDREN: Claim = Claim {
    id: "hash.children",
    anchor: "§5.4.2 (two scales an octave apart); not in the paper",
    statement: "the threshold of a cell and that of each of the eight cells in it, one octave down, are independent",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.02)),
    run: children,
};

/// Differences of neighbouring thresholds.
pub const DIFFERENCES: Claim = Claim {
    id: "hash.differences",
    anchor: "§5.1 (hash outputs replace uniform random numbers); not in the paper",
    statement: "from a cell to its neighbour the threshold moves, around the unit interval, by any amount alike",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.015)),
    run: differences,
};

/// The number of different values.
pub const VALUES: Claim = Claim {
    id: "hash.values",
    anchor: "§5.1; not in the paper",
    statement: "two cells have the same threshold no more often than among four million values",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(1.0e-6)),
    run: values,
};

/// Cells at the distances at which the sine hash resonates.
pub const RESONANCE: Claim = Claim {
    id: "hash.resonance",
    anchor: "§5.1 (sin(17 x + 0.1 y), sin(13 y + x)); not in the paper",
    statement: "thresholds of cells whose distance is all but a whole number of half periods of both sines are uncorrelated",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.1)),
    run: resonance,
};

/// Draws `n` groups of footprints out of a cell each, no two groups touching the same cell, and hands over their thresholds
/// chunk by chunk.
fn groups<const N: usize>(
    subject: &Subject<'_>,
    draw: &Draw,
    n: usize,
    rng: &mut Xoshiro256PlusPlus,
    group: impl Fn(DVec3) -> [Footprint<f64>; N],
    mut each: impl FnMut(&[f64]),
) -> Attempt<()> {
    let mut used = UsedCells::of(draw, 2 * N * n);
    for chunk in draw.chunks(n) {
        let mut samples = Vec::with_capacity(N * chunk);
        for _ in 0..chunk.saturating_mul(DRAWS_A_SAMPLE) {
            if samples.len() == N * chunk {
                break;
            }
            let group = group(draw_cell(rng));
            if used.claim(subject, &group) {
                samples.extend(group);
            }
        }
        let values = subject.thresholds(&samples);
        reject_outsiders(subject, &samples, &values)?;
        each(&values);
    }
    Ok(())
}

fn children(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(CHILDREN.id);
    let mut tests = Vec::new();
    let mut pooled = vec![0; PAIR_BINS * PAIR_BINS];
    for child in 0..8_u32 {
        let within = DVec3::from_array([1, 2, 4].map(|bit| f64::from(u32::from(child & bit != 0))));
        let mut table = vec![0; PAIR_BINS * PAIR_BINS];
        let pair = |cell| [in_cell(subject, cell, 0), in_cell(subject, 2.0 * cell + within, 1)];
        groups(subject, draw, draw.stream_at_least(FAR_PAIRS, FAR_PAIRS), &mut rng, pair, |values| {
            let twos = values.chunks_exact(2).map(|pair| (pair[0], pair[1]));
            let counts = correlation::pair_table(twos, PAIR_BINS);
            table.iter_mut().zip(&counts).for_each(|(sum, count)| *sum += count);
        })?;
        pooled.iter_mut().zip(&table).for_each(|(sum, count)| *sum += count);
        tests.extend(chi_square::independence(&table, PAIR_BINS));
    }
    let n = pooled.iter().sum();
    let seen = "the threshold of a cell tells that of a cell in it".into();
    Ok(Trial::worst_of(&tests, n, seen, Evidence::Pairs { side: PAIR_BINS, counts: pooled }))
}

fn differences(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(DIFFERENCES.id);
    let mut tests = Vec::new();
    let mut evidence = Vec::new();
    for (name, step) in [("x", DVec3::X), ("y", DVec3::Y), ("z", DVec3::Z), ("the diagonal", DVec3::ONE)] {
        let mut counts = Histogram::new(BINS);
        let pair = |cell| [in_cell(subject, cell, 0), in_cell(subject, cell + step, 0)];
        groups(subject, draw, draw.stream(DIFFERENCE_PAIRS), &mut rng, pair, |values| {
            counts.extend(values.chunks_exact(2).map(|pair| {
                let difference = pair[1] - pair[0];
                difference - difference.floor()
            }));
        })?;
        tests.extend(chi_square::uniform(counts.counts()));
        evidence.push(NamedHistogram::new(format!("along {name}"), &counts));
    }
    let n = tests.iter().map(|test| test.n).sum();
    let seen = "some steps between neighbouring thresholds come up more often than others".into();
    Ok(Trial::worst_of(&tests, n, seen, Evidence::Histograms(evidence)))
}

fn values(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(VALUES.id);
    let mut bits: Vec<u64> = Vec::new();
    // They are sorted, so all of them have to be in memory.
    let n = draw.stream(VALUE_CELLS).min(KEPT_LIMIT);
    groups(
        subject,
        draw,
        n,
        &mut rng,
        |cell| [in_cell(subject, cell, 0)],
        |values| bits.extend(values.iter().map(|value| value.to_bits())),
    )?;
    bits.sort_unstable();
    let n = bits.len() as u64;
    let runs = bits.chunk_by(|a, b| a == b).map(|run| run.len() as u64);
    let (distinct, meetings) = runs.fold((0, 0), |(d, m), run| (d + 1, m + run * (run - 1) / 2));
    let pairs = n as f64 * (n as f64 - 1.0) / 2.0;
    let expected = pairs * MEETING_VALUES;
    let share = meetings as f64 / pairs;
    Ok(Trial {
        conclusion: Conclusion::Probability(binomial::poisson_upper_p(meetings, expected)),
        statistic: Some(meetings as f64),
        statistic_name: format!("pairs of cells with one threshold, {expected:.1} expected at most"),
        n,
        effect: Some(share),
        effect_name: "share of pairs of cells with one threshold",
        detectable: Some(detectable_factor(expected) * MEETING_VALUES),
        seen: format!(
            "{n} cells have {distinct} different thresholds, as if drawn from {:.0} values",
            1.0 / share
        ),
        evidence: Evidence::None,
    })
}

fn resonance(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(RESONANCE.id);
    let mut worst: Option<(correlation::Correlation, [i32; 2])> = None;
    for lag in RESONANCES {
        let step = dvec3(f64::from(lag[0]), f64::from(lag[1]), 0.0);
        let mut moments = correlation::Moments::default();
        let pair = |cell| [in_cell(subject, cell, 0), in_cell(subject, cell + step, 0)];
        groups(subject, draw, draw.stream(RESONANCE_PAIRS), &mut rng, pair, |values| {
            let column = |which: usize| values.iter().skip(which).step_by(2).copied().collect::<Vec<f64>>();
            moments.merge(&correlation::Moments::of(&column(0), &column(1)));
        })?;
        let Ok(found) = moments.correlation() else {
            return Ok(Trial::without(Conclusion::Exact { holds: false }, "the threshold is a constant"));
        };
        if worst.as_ref().is_none_or(|(least, _)| found.p < least.p) {
            worst = Some((found, lag));
        }
    }
    let Some((found, [x, y])) = worst else {
        return Ok(Trial::without(Conclusion::Inconclusive, "no distance was tried"));
    };
    let seen = format!("thresholds of cells that are ({x}, {y}) apart have a correlation of {:+.4}", found.r);
    Ok(uncorrelated(&found, RESONANCES.len(), seen))
}
