//! One bit of what a hash reads, turned over: each bit of the threshold turns over in half of the cases.

use crate::check::evidence::ComparedShare;
use crate::check::input::seen_in_cell;
use crate::check::tolerance::{INDEX_LIMIT, POWER, SINGLE_LEVEL, VIEW};
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Reach, Subject, Trial, Verdict};
use crate::scene::Fragment;
use crate::stats::{binomial, power, seed};
use glam::DVec3;

/// Cells in which each bit is turned over: an error of 0.056 in a share of turned bits shows.
const TURNED_CELLS: usize = 1 << 13;

/// Most of those cells, whatever budget and round: each has 60 others.
const MOST_TURNED_CELLS: usize = 1 << 16;

/// Bits of an index that are turned over: all that cells of an `f32` position have ([`INDEX_LIMIT`]). One that is lost makes every
/// object of that size repeat along an axis, which no counting asks of a hash.
const INDEX_BITS: u32 = INDEX_LIMIT.ilog2();

/// The same for a listing: as far as it holds.
const LISTING_BITS: u32 = VIEW.ilog2();

/// Bits of the octave that are turned over, in two's complement.
const OCTAVE_BITS: u32 = 4;

/// Octaves of the cells: those that stay among themselves when a bit of them is turned over.
const TURNED_OCTAVES: [f64; 2] = [-16.0, 16.0];

/// Leading bits of a threshold that are looked at: those that the coarsest grid of the `f32` sine hash has, and half
/// precision everywhere.
const THRESHOLD_BITS: u32 = 10;

/// Bits of indices.
pub const INDEX: Claim = Claim {
    id: "hash.avalanche",
    anchor: "§5 (hash outputs replace uniform random numbers); not in the paper",
    statement: "turning over one bit of an index, up to 524,288 cells, turns over each of the first ten bits of the threshold in half \
                of the cells, and leaves it where it is no more often than another cell would",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.15)),
    run: |subject, draw| {
        let most = match draw.reach {
            Reach::Whole => INDEX_BITS,
            Reach::Listings => LISTING_BITS,
        };
        let bits = (0..3).flat_map(|axis| (0..most).map(move |bit| Turned::Index { axis, bit }));
        avalanche(subject, draw, INDEX.id, &bits.collect::<Vec<_>>())
    },
};

/// Bits of the octave.
pub const OCTAVE: Claim = Claim {
    id: "hash.octave_avalanche",
    anchor: "§5.4.2 (two scales); not in the paper",
    statement: "turning over one bit of the octave, between -16 and 15, turns over each of the first ten bits of the threshold \
                in half of the cells, and leaves it where it is no more often than another cell would",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.15)),
    run: |subject, draw| {
        let bits: Vec<_> = (0..OCTAVE_BITS).map(|bit| Turned::Octave { bit }).collect();
        avalanche(subject, draw, OCTAVE.id, &bits)
    },
};

/// A bit that is turned over.
#[derive(Clone, Copy, Debug)]
enum Turned {
    Index { axis: usize, bit: u32 },
    Octave { bit: u32 },
}

impl Turned {
    fn turn(self, cell: [i64; 3], octave: i32) -> ([i64; 3], i32) {
        match self {
            Self::Index { axis, bit } => {
                let mut cell = cell;
                cell[axis] ^= 1 << bit;
                (cell, octave)
            }
            Self::Octave { bit } => (cell, octave ^ (1 << bit)),
        }
    }

    const fn bit(self) -> u32 {
        match self {
            Self::Index { bit, .. } | Self::Octave { bit } => bit,
        }
    }

    const fn of(self) -> &'static str {
        match self {
            Self::Index { axis, .. } => ["x", "y", "z"][axis],
            Self::Octave { .. } => "the octave",
        }
    }
}

/// The leading bits of a threshold, the first the highest.
fn leading_bits(threshold: f64) -> u32 {
    let levels = 1 << THRESHOLD_BITS;
    ((threshold * f64::from(levels)) as u32).min(levels - 1)
}

/// How often two of many values are as near as one level.
fn nearness(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let (mut first, mut near) = (0, 0);
    for (index, value) in sorted.iter().enumerate() {
        while value - sorted[first] > level() {
            first += 1;
        }
        near += index - first;
    }
    near as f64 / (0.5 * sorted.len() as f64 * (sorted.len() as f64 - 1.0))
}

/// The width of a level.
fn level() -> f64 {
    1.0 / f64::from(1 << THRESHOLD_BITS)
}

/// What is seen of one bit that is turned over and one that may follow.
struct Cell {
    turned: Turned,
    p: f64,
    share: f64,
    expected: f64,
    what: String,
}

fn avalanche(subject: &Subject<'_>, draw: &Draw, claim: &str, bits: &[Turned]) -> Attempt<Trial> {
    let mut rng = draw.rng(claim);
    let n = draw.samples(TURNED_CELLS).min(MOST_TURNED_CELLS);
    let mut fragments: Vec<Fragment> = Vec::with_capacity(n * (bits.len() + 1));
    for _ in 0..n {
        let mut within = |[low, high]: [f64; 2]| (low + (high - low) * seed::uniform01(&mut rng)).floor();
        let reach = f64::from(VIEW);
        let cell = [0; 3].map(|_| within([-reach, reach]) as i64);
        let octave = within(TURNED_OCTAVES) as i32;
        let turned = bits.iter().map(|bit| bit.turn(cell, octave));
        let all = core::iter::once((cell, octave)).chain(turned);
        fragments.extend(all.map(|(cell, octave)| {
            seen_in_cell(subject, DVec3::from_array(cell.map(|index| index as f64)), octave)
        }));
    }
    let values = subject.thresholds(&fragments);
    reject_outsiders(subject, &fragments, &values)?;
    let near = nearness(&values);
    // Bits of a coarse lattice may be constant or lean to one side: two independent ones differ in 2 q (1 - q).
    let differ: Vec<f64> = (0..THRESHOLD_BITS)
        .map(|bit| {
            let ones = values.iter().filter(|value| leading_bits(**value) >> bit & 1 == 1).count();
            let q = ones as f64 / values.len() as f64;
            2.0 * q * (1.0 - q)
        })
        .collect();
    let mut cells = Vec::new();
    for (index, &turned) in bits.iter().enumerate() {
        let pairs = || values.chunks_exact(bits.len() + 1).map(|group| [group[0], group[index + 1]]);
        for (bit, &expected) in (0..THRESHOLD_BITS).zip(&differ) {
            let follows = |[a, b]: &[f64; 2]| (leading_bits(*a) ^ leading_bits(*b)) >> bit & 1 == 1;
            let count = pairs().filter(follows).count() as u64;
            let p = match expected {
                0.0 => 1.0,
                expected => binomial::two_sided_p(count, n as u64, expected),
            };
            let share = count as f64 / n as f64;
            let what = format!("turns over bit {} of the threshold", THRESHOLD_BITS - bit);
            cells.push(Cell { turned, p, share, expected, what });
        }
        let stay = pairs().filter(|[a, b]| (a - b).abs() <= level()).count() as u64;
        let p = binomial::poisson_upper_p(stay, n as f64 * near);
        let what = "leaves the threshold where it is".to_owned();
        cells.push(Cell { turned, p, share: stay as f64 / n as f64, expected: near, what });
    }
    Ok(judged(&cells, n as u64))
}

fn judged(cells: &[Cell], n: u64) -> Trial {
    let tests = cells.len() as f64;
    let sigma = 0.5 / (n as f64).sqrt();
    let error = |cell: &Cell| (cell.share - cell.expected).abs();
    let Some(worst) =
        cells.iter().min_by(|a, b| a.p.total_cmp(&b.p).then_with(|| error(b).total_cmp(&error(a))))
    else {
        return Trial::without(Conclusion::Inconclusive, "no bit was turned over");
    };
    let per_bit = cells.chunk_by(|a, b| a.turned.bit() == b.turned.bit() && a.turned.of() == b.turned.of());
    let points = per_bit
        .filter_map(|cells| cells.iter().max_by(|a, b| error(a).total_cmp(&error(b))))
        .map(|cell| ComparedShare {
            series: format!("bit of {}", cell.turned.of()),
            x: f64::from(cell.turned.bit()),
            measured: cell.share,
            predicted: cell.expected,
            sigma: (cell.expected * (1.0 - cell.expected) / n as f64).sqrt(),
        })
        .collect();
    Trial {
        conclusion: Conclusion::Probability((worst.p * tests).min(1.0)),
        statistic: Some(worst.share),
        statistic_name: format!("share of cells, worst of {tests}"),
        n,
        effect: Some(error(worst)),
        effect_name: "error in a share of turned bits",
        detectable: Some(power::detectable_shift_z(sigma, SINGLE_LEVEL / tests, POWER)),
        seen: format!(
            "turning over bit {} of {} {} in {:.3} of the cells, {:.4} are expected",
            worst.turned.bit(),
            worst.turned.of(),
            worst.what,
            worst.share,
            worst.expected
        ),
        evidence: Evidence::Shares { abscissa: "bit that is turned over", points },
    }
}
