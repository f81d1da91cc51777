//! Thresholds of different cells have nothing to do with each other.

use crate::check::input::{Sighting, UsedCells, general_scenes, placement, sighting};
use crate::check::tolerance::{DRAWS_A_PLACE, DRAWS_A_SAMPLE, FAR_PAIRS, PAIR_BINS};
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::scene::Fragment;
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
    let rng = draw.rng(NEIGHBOURS.id);
    independent_pairs(
        subject,
        &pairings,
        draw.samples(NEIGHBOUR_PAIRS),
        rng,
        "thresholds of neighbouring cells",
    )
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
    let rng = draw.rng(DIAGONALS.id);
    independent_pairs(
        subject,
        &pairings,
        draw.samples_at_least(FAR_PAIRS),
        rng,
        "thresholds of cells that touch in an edge or corner",
    )
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
    let rng = draw.rng(ACROSS_ZERO.id);
    independent_pairs(
        subject,
        &[0, 1, 2].map(pairing),
        draw.samples_at_least(FAR_PAIRS),
        rng,
        "thresholds on the two sides of zero",
    )
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
    let rng = draw.rng(OCTAVES.id);
    let seen = "thresholds of two octaves";
    independent_pairs(subject, &[half_the_size, descendant], draw.samples_at_least(FAR_PAIRS), rng, seen)
}

/// Tests `n` pairs of each kind for independence, no two pairs touching the same cell.
fn independent_pairs(
    subject: &Subject<'_>,
    pairings: &[Pairing<'_>],
    n: usize,
    mut rng: Xoshiro256PlusPlus,
    what: &str,
) -> Attempt<Trial> {
    let scenes = general_scenes();
    let mut used = UsedCells::default();
    let mut tests = Vec::new();
    let mut pooled = vec![0; PAIR_BINS * PAIR_BINS];
    for pairing in pairings {
        let mut pairs: Vec<Fragment> = Vec::with_capacity(2 * n);
        let mut place = DVec3::ZERO;
        for draw in 0..n * DRAWS_A_SAMPLE {
            if pairs.len() == 2 * n {
                break;
            }
            if draw % DRAWS_A_PLACE == 0 {
                place = placement(&mut rng);
            }
            let found = sighting(&scenes[draw % scenes.len()], &mut rng);
            let pair = pairing(found.placed(place, subject.precision));
            if used.claim(subject, &pair) {
                pairs.extend(pair);
            }
        }
        let values = subject.thresholds(&pairs);
        reject_outsiders(subject, &pairs, &values)?;
        let table = correlation::pair_table(values.chunks_exact(2).map(|pair| (pair[0], pair[1])), PAIR_BINS);
        pooled.iter_mut().zip(&table).for_each(|(sum, count)| *sum += count);
        tests.extend(chi_square::independence(&table, PAIR_BINS));
    }
    let n = pooled.iter().sum();
    let seen = format!("{what} depend on each other");
    Ok(Trial::worst_of(&tests, n, seen, Evidence::Pairs { side: PAIR_BINS, counts: pooled }))
}
