//! What a join that is nested makes of the children of a cell: which of them keep its threshold, and what the others have.
//!
//! The thresholds of a whole block of cells are seen where one octave has all weight, and those of their parents an octave
//! above. Of a threshold that claims no such join nothing is asked here; of one that does, the claims on cells that know nothing
//! of each other are not ([`not_of_kin`](super::not_of_kin)).

use crate::check::input::block::{Block, cube};
use crate::check::tolerance::{POWER, SINGLE_LEVEL};
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::stats::chi_square::{self, ChiSquare};
use crate::stats::histogram::bin_of;
use crate::stats::{binomial, power};
use crate::threshold::robust::Join;
use crate::threshold::robust::nested::LEVELS;
use glam::DVec3;

/// Children in the blocks of a claim: 2^16 parents, so that a quarter of them shows what is promised.
const CHILDREN_SEEN: usize = 1 << 19;

/// Children of one block: no side of it is below 16 cells.
const BLOCK_CHILDREN: usize = 1 << 15;

/// How far a threshold may be from where its share puts it, in units: some roundings of an `f32` near 1.
const ROUNDING: f64 = 1.0 / 1_048_576.0;

/// Parts of a third by which neighbouring parents are compared.
const FILL_BINS: usize = 8;

/// The law of the children of one parent.
pub const CHILDREN: Claim = Claim {
    id: "nested.children",
    anchor: "not in the paper (docs/joins.md)",
    statement: "of the four pairs of opposite children of a cell one has one threshold, and each of the others a third of [0, 1] \
                of its own, filled alike in all of them and half of it apart within a pair",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(1.0e-3)),
    run: children,
};

/// What is kept from octave to octave.
pub const KEPT: Claim = Claim {
    id: "nested.kept",
    anchor: "not in the paper (docs/joins.md)",
    statement: "the pair of children with one threshold has that of its parent, but for at most one in 64, whose parent has asked farther",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.02)),
    run: kept,
};

/// Chance among parents.
pub const ORDER: Claim = Claim {
    id: "nested.order",
    anchor: "not in the paper (docs/joins.md)",
    statement: "any pair of children has any share equally often, and neighbouring cells order and fill their children \
                independently of each other",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.05)),
    run: order,
};

/// A parent and its children.
struct Parent {
    /// Its own threshold.
    threshold: f64,
    /// The thresholds of each pair: of the child in the lower half along z, and of the other one.
    pairs: [[f64; 2]; 4],
}

impl Parent {
    /// The pair that has one threshold; nothing where none has, or several.
    fn keeper(&self) -> Option<usize> {
        let mut all = (0..4).filter(|&pair| self.pairs[pair][0] == self.pairs[pair][1]);
        all.next().filter(|_| all.next().is_none())
    }

    /// The third in which the lower child of a pair lies, and the part of that third.
    fn third(&self, pair: usize) -> (usize, f64) {
        let thirds = 3.0 * self.pairs[pair][0];
        (thirds as usize, thirds - thirds.floor())
    }

    /// Whether the other pairs have the three thirds, filled alike.
    fn shares_fairly(&self, keeper: usize) -> bool {
        let others = || (0..4).filter(move |&pair| pair != keeper);
        let (_, fill) = others().next().map_or((0, 0.0), |pair| self.third(pair));
        let is_filled = |pair: usize| {
            let [low, high] = self.pairs[pair];
            // From the fill of the first: next to the end of a third, rounding puts a threshold on either side.
            let above = 3.0 * low - fill;
            let is_alike = (above - above.round()).abs() <= 3.0 * ROUNDING;
            let is_half_apart = (3.0 * (high - low).abs() - 0.5).abs() <= 3.0 * ROUNDING;
            (is_alike && is_half_apart).then_some(above.round() as i64)
        };
        let mut thirds: Vec<i64> = others().filter_map(is_filled).collect();
        thirds.sort_unstable();
        matches!(thirds[..], [low, middle, high] if middle == low + 1 && high == low + 2)
    }
}

/// Parents in a block, the first axis the fastest, and the sides of the block.
struct Family {
    parents: Vec<Parent>,
    size: [usize; 3],
}

/// Sees blocks of cells and of their parents; nothing where the subject claims no such cells.
fn families(subject: &Subject<'_>, draw: &Draw, claim: &str) -> Attempt<Vec<Family>> {
    if !subject.has_kin() {
        let reason = if subject.join == Join::Inherit {
            "its cells inherit along each axis alone: none has a parent along all three"
        } else {
            "no cell of it inherits: the octaves of its join are independent"
        };
        return Err(Box::new(Trial::without(Conclusion::NotApplicable, reason)));
    }
    let mut rng = draw.rng(claim);
    let blocks = draw.samples(CHILDREN_SEEN).div_ceil(BLOCK_CHILDREN);
    (0..blocks)
        .map(|_| {
            let drawn = Block::draw(cube(BLOCK_CHILDREN.ilog2(), &mut rng), &mut rng);
            let is_shifted = subject.nested_phase && drawn.octave.rem_euclid(2) == 0;
            let begin = DVec3::splat(f64::from(u8::from(is_shifted)));
            let parents = Block {
                size: drawn.size.map(|side| side / 2),
                corner: ((drawn.corner + begin) * 0.5).floor(),
                octave: drawn.octave - 1,
                ..drawn
            };
            let children = Block { corner: parents.corner * 2.0 - begin, ..drawn };
            let (above, below) = (parents.thresholds(subject)?, children.thresholds(subject)?);
            let [width, height, _] = drawn.size;
            let size @ [nx, ny, _] = parents.size;
            let of = |(at, &threshold): (usize, &f64)| {
                let place = [at % nx, at / nx % ny, at / (nx * ny)];
                let child = |corner: [usize; 3]| {
                    let [x, y, z] = [0, 1, 2].map(|axis| 2 * place[axis] + corner[axis]);
                    below[(z * height + y) * width + x]
                };
                let pair = |pair: usize| {
                    [child([pair & 1, pair >> 1, 0]), child([1 - (pair & 1), 1 - (pair >> 1), 1])]
                };
                Parent { threshold, pairs: [0, 1, 2, 3].map(pair) }
            };
            Ok(Family { parents: above.iter().enumerate().map(of).collect(), size })
        })
        .collect()
}

fn children(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let families = families(subject, draw, CHILDREN.id)?;
    let parents = || families.iter().flat_map(|family| &family.parents);
    let unfair = |parent: &&Parent| !parent.keeper().is_some_and(|keeper| parent.shares_fairly(keeper));
    let (bad, n) = (parents().filter(unfair).count() as u64, parents().count() as u64);
    let example = parents().find(unfair).map_or(String::new(), |parent| {
        let pair = |[low, high]: [f64; 2]| format!("{low:.6} and {high:.6}");
        format!(", as that whose pairs have {}", parent.pairs.map(pair).join(", "))
    });
    let seen = format!("the children of {bad} of {n} cells share [0, 1] otherwise{example}");
    Ok(Trial::counted(bad, n, "cells whose children share otherwise", "share of cells", seen))
}

fn kept(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let families = families(subject, draw, KEPT.id)?;
    let keepers = families.iter().flat_map(|family| &family.parents).filter_map(|parent| {
        let pair = parent.keeper()?;
        Some(parent.pairs[pair][0] == parent.threshold)
    });
    let (mut n, mut others) = (0_u64, 0_u64);
    for keeps in keepers {
        n += 1;
        others += u64::from(!keeps);
    }
    if n == 0 {
        return Ok(Trial::without(Conclusion::Inconclusive, "no pair of children has one threshold"));
    }
    let expected = libm::pow(0.25, f64::from(LEVELS) - 1.0);
    let share = others as f64 / n as f64;
    let sigma = (expected / n as f64).sqrt();
    Ok(Trial {
        conclusion: Conclusion::Probability(binomial::poisson_upper_p(others, expected * n as f64)),
        statistic: Some(others as f64),
        statistic_name: format!(
            "pairs without the threshold of their parent, {:.1} expected",
            expected * n as f64
        ),
        n,
        effect: Some((share - expected).max(0.0)),
        effect_name: "excess share of pairs",
        detectable: Some(power::detectable_shift_z(sigma, SINGLE_LEVEL, POWER)),
        seen: format!("{:.2} % of the pairs with one threshold have not that of their parent", 100.0 * share),
        evidence: Evidence::None,
    })
}

fn order(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let families = families(subject, draw, ORDER.id)?;
    let mut shares = [0_u64; 16];
    let mut turns = [0_u64; 3];
    let mut keepers = [[0_u64; 16]; 3];
    let mut fills = [[0_u64; FILL_BINS * FILL_BINS]; 3];
    let mut n = 0;
    for Family { parents, size: [nx, ny, nz] } in &families {
        let seen = |at: usize| {
            let parent = &parents[at];
            let keeper = parent.keeper()?;
            let (_, fill) = parent.third(if keeper == 0 { 1 } else { 0 });
            Some((keeper, bin_of(fill, FILL_BINS)?))
        };
        for (at, parent) in parents.iter().enumerate() {
            let Some((keeper, fill)) = seen(at) else { continue };
            n += 1;
            for pair in 0..4 {
                let share = if pair == keeper { 3 } else { parent.third(pair).0.min(2) };
                shares[4 * pair + share] += 1;
            }
            turns[parent.third(keeper ^ 1).0.min(2)] += 1;
            // Of two neighbours each is in one comparison along an axis.
            let place = [at % nx, at / nx % ny, at / (nx * ny)];
            for (axis, step) in [1, *nx, nx * ny].into_iter().enumerate() {
                let has_next = place[axis] % 2 == 0 && place[axis] + 1 < [*nx, *ny, *nz][axis];
                if let Some((next, next_fill)) = has_next.then(|| seen(at + step)).flatten() {
                    keepers[axis][4 * keeper + next] += 1;
                    fills[axis][FILL_BINS * fill + next_fill] += 1;
                }
            }
        }
    }
    // One pair after the other: the four shares of a parent are not independent.
    let of_pairs =
        shares.chunks(4).enumerate().map(|(pair, counts)| (format!("which share pair {pair} has"), counts));
    let axes = ["x", "y", "z"];
    let of_keepers = axes.iter().zip(&keepers);
    let of_keepers = of_keepers
        .map(|(axis, counts)| (format!("which pairs keep in neighbours along {axis}"), &counts[..]));
    let of_fills = axes.iter().zip(&fills);
    let of_fills = of_fills
        .map(|(axis, counts)| (format!("how neighbours along {axis} fill their thirds"), &counts[..]));
    let of_turns = [("in which order the other pairs follow that which keeps".to_owned(), &turns[..])];
    let all: Vec<(String, ChiSquare)> = of_pairs
        .chain(of_keepers)
        .chain(of_fills)
        .chain(of_turns)
        .filter_map(|(name, counts)| Some((name, chi_square::uniform(counts).ok()?)))
        .collect();
    let worst = all.iter().min_by(|a, b| a.1.p.total_cmp(&b.1.p));
    let seen = worst.map_or(String::new(), |(name, test)| {
        format!("farthest from chance: {name} (chi-square {:.1} per dof)", test.statistic / test.dof as f64)
    });
    let tests: Vec<ChiSquare> = all.into_iter().map(|(_, test)| test).collect();
    Ok(Trial::worst_of(&tests, n, seen, Evidence::None))
}
