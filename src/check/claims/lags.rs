//! Repeats of the hash at any distance, by all lags of whole blocks of cells.

use crate::check::input::{BETWEEN, Block, cube};
use crate::check::tolerance::{POWER, SINGLE_LEVEL, TOLERATED_TIE, VIEW};
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::stats::lags::{self, Relation, WorstLag};
use crate::stats::power;

/// Cells of the compact block, 128 x 128 x 64: a correlation of 0.031 shows at every lag up to 64 (32) cells along its axes.
const COMPACT_CELLS: usize = 1 << 20;

/// Cells of each of the three bars, whatever budget: a correlation of 0.051 shows at every lag below [`VIEW`] along an axis.
const BAR_CELLS: usize = 1 << 17;

/// Most cells of a block, whatever budget and round: transforms hold a few times 16 bytes a cell.
const MOST_CELLS: usize = 1 << 22;

/// Blocks of cells against themselves at all lags.
pub const LAGS: Claim = Claim {
    id: "hash.lags",
    anchor: "§5 (hash outputs replace uniform random numbers); not in the paper",
    statement: "no distance between cells, up to 32 in all directions and below 4096 along each axis, ties thresholds by more than \
                0.02: neither are they correlated, nor does their difference or sum modulo 1 prefer a value",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.06)),
    run: lags,
};

/// A compact block at two scales, and three bars around the axes, each in an octave of its own.
fn blocks(draw: &Draw) -> Vec<(String, Block)> {
    let mut rng = draw.rng(LAGS.id);
    let compact = draw.samples(COMPACT_CELLS).min(MOST_CELLS);
    let bar = draw.samples_at_least(BAR_CELLS).min(MOST_CELLS);
    let compact = Block::draw(cube(compact.ilog2(), &mut rng), &mut rng);
    let mut blocks = vec![
        ("a compact block".to_owned(), compact),
        ("a compact block between two octaves".to_owned(), compact.seen_at(BETWEEN)),
    ];
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let length = 2 * VIEW as usize;
        let across = bar.ilog2() - length.ilog2();
        let mut size = [length, 1 << across.div_ceil(2), 1 << (across / 2)];
        size.rotate_right(axis);
        let mut bar = Block::draw(size, &mut rng);
        for beside in (0..3).filter(|beside| *beside != axis) {
            bar.corner[beside] = -((size[beside] / 2) as f64);
        }
        blocks.push((format!("a bar along {name}"), bar));
    }
    blocks
}

fn lags(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let (mut worst, mut tests, mut n, mut fewest): (Option<(WorstLag, String, Block)>, _, _, _) =
        (None, 0, 0, u64::MAX);
    for (name, block) in blocks(draw) {
        let values = block.thresholds(subject)?;
        let Ok(found) = lags::worst_lag(&values, block.size, TOLERATED_TIE) else {
            let seen = format!("{name} of cells has one threshold");
            return Ok(Trial::without(Conclusion::Exact { holds: false }, seen));
        };
        tests += found.tests;
        n += values.len() as u64;
        fewest = fewest.min(values.len() as u64);
        if worst.as_ref().is_none_or(|(least, ..)| found.p < least.p) {
            worst = Some((found, name, block));
        }
    }
    let Some((found, name, block)) = worst else {
        return Ok(Trial::without(Conclusion::Inconclusive, "no block was drawn"));
    };
    let tied = match found.relation {
        Relation::Correlation => "are correlated".to_owned(),
        Relation::Difference { harmonic: 1 } => "differ by one amount more often than by others".to_owned(),
        Relation::Sum { harmonic: 1 } => "add up to one amount more often than to others".to_owned(),
        Relation::Difference { harmonic } => format!("differ, {harmonic} times and modulo 1, by one amount"),
        Relation::Sum { harmonic } => format!("add up, {harmonic} times and modulo 1, to one amount"),
    };
    let [x, y, z] = found.lag;
    let tests = tests as f64;
    Ok(Trial {
        conclusion: Conclusion::Probability((tests * found.p).min(1.0)),
        statistic: Some(found.strength),
        statistic_name: format!("correlation or mean phase, worst of {tests}"),
        n,
        effect: Some(found.strength),
        effect_name: "correlation at a lag",
        detectable: Some(
            TOLERATED_TIE
                + power::detectable_shift_z(1.0 / (fewest as f64).sqrt(), SINGLE_LEVEL / tests, POWER),
        ),
        seen: format!(
            "in {name}, octave {}, thresholds of cells that are ({x}, {y}, {z}) apart, around a block of ({}, {}, {}) \
             cells, {tied}: {:.3}",
            block.octave, block.size[0], block.size[1], block.size[2], found.strength
        ),
        evidence: Evidence::None,
    })
}
