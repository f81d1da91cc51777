//! Thresholds of different cells have nothing to do with each other.

use crate::check::input::{Sighting, UsedCells, general_scenes, placement, sighting};
use crate::check::tolerance::{DRAWS_A_PLACE, DRAWS_A_SAMPLE, FAR_PAIRS, PAIR_BINS};
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::scene::{Fragment, Scene};
use crate::stats::{chi_square, correlation};
use glam::{DVec3, dvec3};
use rand::rngs::Xoshiro256PlusPlus;

/// Pairs of neighbours along each axis: 256 expected in every square.
const NEIGHBOUR_PAIRS: usize = 1 << 16;

/// Serial test of neighbouring coarse cells.
pub const NEIGHBOURS: Claim = Claim {
    id: "independence.neighbours",
    anchor: "§5 (hash outputs replace uniform random numbers)",
    statement: "thresholds in neighbouring coarse cells along x, y and z are independent",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.02)),
    run: neighbours,
};

/// Serial test of coarse cells that touch in an edge or a corner.
pub const DIAGONALS: Claim = Claim {
    id: "independence.diagonals",
    anchor: "§5 (hash outputs replace uniform random numbers)",
    statement: "thresholds in coarse cells that touch in an edge or a corner are independent",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.02)),
    run: diagonals,
};

/// Serial test of the cells on both sides of the planes x = 0, y = 0 and z = 0.
pub const ACROSS_ZERO: Claim = Claim {
    id: "independence.across_zero",
    anchor: "§5.4.1 (floor of the coordinates); not in the paper",
    statement: "thresholds on the two sides of a coordinate's zero are independent",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.02)),
    run: across_zero,
};

/// Serial test of cells of different octaves.
pub const OCTAVES: Claim = Claim {
    id: "independence.octaves",
    anchor: "§5.4.2 (two scales); not in the paper",
    statement: "the noise of one octave is no copy of another one's: neither at half the size, nor two octaves down",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.02)),
    run: octaves,
};

/// Makes a pair of fragments out of one, whose thresholds should have nothing to do with each other.
type Pairing<'a> = Box<dyn Fn(Sighting<'_>) -> [Fragment; 2] + 'a>;

/// The second of a pair lies `cells` coarse cells from the first, wherever the surface goes.
fn apart<'a>(subject: &'a Subject<'_>, cells: DVec3) -> Pairing<'a> {
    Box::new(move |first| {
        let nominal = subject.nominal(&first.fragment.footprint);
        let side = dvec3(1.0, 1.0, 1.0) / DVec3::from_array(nominal.coarse_scale);
        [first.fragment, first.moved(cells * side, subject.precision).fragment]
    })
}

fn neighbours(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let pairings = DVec3::AXES.map(|axis| apart(subject, axis));
    let n = draw.stream(NEIGHBOUR_PAIRS);
    independent_pairs(&NEIGHBOURS, subject, draw, &pairings, n, "thresholds of neighbouring cells")
}

fn diagonals(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    // One of each two opposite directions; those along an axis have a claim of their own.
    let steps = [-1.0, 0.0, 1.0];
    let all =
        steps.into_iter().flat_map(|x| steps.into_iter().flat_map(move |y| steps.map(|z| dvec3(x, y, z))));
    let pairings: Vec<Pairing<'_>> = all
        .skip(14)
        .filter(|cells| cells.abs().element_sum() > 1.0)
        .map(|cells| apart(subject, cells))
        .collect();
    let n = draw.stream_at_least(FAR_PAIRS, FAR_PAIRS);
    let what = "thresholds of cells that touch in an edge or corner";
    independent_pairs(&DIAGONALS, subject, draw, &pairings, n, what)
}

fn across_zero(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let pairing = |axis: usize| -> Pairing<'_> {
        Box::new(move |found| {
            let footprint = found.fragment.footprint;
            let side = 1.0 / subject.nominal(&footprint).coarse_scale[axis];
            let within = footprint.position[axis] / side;
            // From the last cell below zero to the first one above.
            let below = (within - within.floor() - 1.0) * side - footprint.position[axis];
            let first = found.placed(DVec3::AXES[axis] * below, subject.precision);
            [first.fragment, first.moved(DVec3::AXES[axis] * side, subject.precision).fragment]
        })
    };
    let n = draw.stream_at_least(FAR_PAIRS, FAR_PAIRS);
    let pairings = [0, 1, 2].map(pairing);
    independent_pairs(&ACROSS_ZERO, subject, draw, &pairings, n, "thresholds on the two sides of zero")
}

fn octaves(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let half_the_size: Pairing<'_> = Box::new(|found| {
        let to_half = -0.5 * found.fragment.footprint.position;
        [found.fragment, found.nearer(2.0).placed(to_half, subject.precision).fragment]
    });
    // At the same place two octaves down, where indices are whole multiples of those above.
    let descendant: Pairing<'_> = Box::new(|found| {
        let below = subject.nominal(&found.nearer(4.0).fragment.footprint);
        let scale = DVec3::from_array(below.coarse_scale);
        let index = below.coarse_cell;
        let beyond = index - (index / 4.0).floor() * 4.0;
        let first = found.placed(-beyond / scale, subject.precision);
        [first.fragment, first.nearer(4.0).fragment]
    });
    let n = draw.stream_at_least(FAR_PAIRS, FAR_PAIRS);
    let pairings = [half_the_size, descendant];
    independent_pairs(&OCTAVES, subject, draw, &pairings, n, "thresholds of two octaves")
}

/// Tests `n` pairs of each kind for independence, no two pairs touching the same cell.
fn independent_pairs(
    claim: &Claim,
    subject: &Subject<'_>,
    draw: &Draw,
    pairings: &[Pairing<'_>],
    n: usize,
    what: &str,
) -> Attempt<Trial> {
    let mut rng = draw.rng(claim.id);
    let scenes = general_scenes();
    let mut used = UsedCells::of(draw, 4 * n * pairings.len());
    let mut tests = Vec::new();
    let mut pooled = vec![0; PAIR_BINS * PAIR_BINS];
    for pairing in pairings {
        let mut table = vec![0; PAIR_BINS * PAIR_BINS];
        for chunk in draw.chunks(n) {
            let pairs = pairs(subject, pairing, &scenes, chunk, &mut used, &mut rng);
            let values = subject.thresholds(&pairs);
            reject_outsiders(subject, &pairs, &values)?;
            let twos = values.chunks_exact(2).map(|pair| (pair[0], pair[1]));
            let counts = correlation::pair_table(twos, PAIR_BINS);
            table.iter_mut().zip(&counts).for_each(|(sum, count)| *sum += count);
        }
        pooled.iter_mut().zip(&table).for_each(|(sum, count)| *sum += count);
        tests.extend(chi_square::independence(&table, PAIR_BINS));
    }
    let n = pooled.iter().sum();
    let seen = format!("{what} depend on each other");
    Ok(Trial::worst_of(&tests, n, seen, Evidence::Pairs { side: PAIR_BINS, counts: pooled }))
}

/// Draws `n` pairs of one kind, fragments in twos, that touch no cell of an earlier pair.
fn pairs(
    subject: &Subject<'_>,
    pairing: &Pairing<'_>,
    scenes: &[Scene],
    n: usize,
    used: &mut UsedCells,
    rng: &mut Xoshiro256PlusPlus,
) -> Vec<Fragment> {
    let mut pairs = Vec::with_capacity(2 * n);
    let mut place = DVec3::ZERO;
    for draw in 0..n * DRAWS_A_SAMPLE {
        if pairs.len() == 2 * n {
            break;
        }
        if draw % DRAWS_A_PLACE == 0 {
            place = placement(rng);
        }
        let found = sighting(&scenes[draw % scenes.len()], rng);
        let pair = pairing(found.placed(place, subject.precision));
        if used.claim(subject, &pair) {
            pairs.extend(pair);
        }
    }
    pairs
}
