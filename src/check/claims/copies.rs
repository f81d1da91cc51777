//! Cells that repeat others: equal thresholds under any shift, symmetry or change of octave, found and then confirmed elsewhere.
//!
//! A set of cells is evaluated and every two of one threshold are looked at, or of two that add up to 1: what takes the first
//! cell to the second? A relation that takes many cells to their copies comes up many times; the candidates that came up most are
//! tried on fresh cells, where the number of equal pairs is Poisson's. *Exploring and confirming are apart*, since sound
//! hashes of chained words have whole rows that are equal up to a shift, of one row and another: such rows come up in the search, but
//! what takes one to the other takes no other cell to a copy.

use crate::check::input::{draw_octave, seen_in_cell};
use crate::check::tolerance::{SPREAD, TOLERATED_TIE, VIEW, VIEW_DEPTH};
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::scene::Fragment;
use crate::stats::{binomial, seed};
use glam::DVec3;
use rand::rngs::Xoshiro256PlusPlus;
use rustc_hash::FxHashSet;

/// Cells of each of the four sets of one octave: every shift below [`VIEW`] in a plane of two axes, or below [`VIEW_DEPTH`] in
/// space, has sixteen pairs of them or more.
const SET_CELLS: usize = 1 << 16;

/// Most cells of such a set, whatever budget and round: pairs grow with the square.
const MOST_SET_CELLS: usize = 1 << 17;

/// Cells along each side of the cube around one place that is looked at in each octave.
const NEST_SIDE: usize = 20;

/// Octaves of the nest: to both sides of zero, so that a sign that is lost shows.
const NEST_OCTAVES: core::ops::RangeInclusive<i32> = -4..=4;

/// Octaves in which the same few cells are looked at: all of the domain.
const LADDER_OCTAVES: core::ops::RangeInclusive<i32> = -20..=20;

/// Cells that are looked at in all of these.
const LADDER_CELLS: i64 = 64;

/// Cells all of whose images under the symmetries about the origin are looked at.
const ORBITS: usize = 128;

/// Two thresholds are equal if they differ by no more: a device has no lerp factor of exactly 0.
const EQUAL: f64 = 1.0 / 1_048_576.0;

/// How far from the origin the cube of cells lies along each axis: it holds both sides of the mirrors that objects have, which go
/// through their middle or near it.
const DEEP_REACH: f64 = 32.0;

/// Relations that are tried on fresh cells.
const CANDIDATES: usize = 16;

/// Fresh pairs on which each is tried: a relation that holds for one cell in 25 shows, and one in 50 is no repeat
/// ([`TOLERATED_TIE`]).
const CONFIRMING_PAIRS: usize = 1 << 12;

/// Least probability of equal thresholds that is expected of independent cells: that of continuous ones, which are equal if they
/// are within [`EQUAL`] on either side.
const LEAST_MEETING: f64 = 2.0 * EQUAL;

/// Times that a candidate came up at least: chance brings two pairs of equal cells with one shift, but hardly three.
const LEAST_SEEN: usize = 3;

/// Expected pairs of a relation of all cells that one comes up [`LEAST_SEEN`] times of with power 0.999.
const SURE_PAIRS: f64 = 11.23;

/// Equal cells that are looked at for each cell, the next ones in an order of chance: all of them on a lattice of 2^16 values.
const EQUALS_A_CELL: usize = 2;

/// Cells around the origin along every axis, to both sides, among which relations are confirmed: the cube that was explored is a
/// fortieth of a per cent of them.
const FRESH: f64 = 8.0 * SPREAD;

/// Shifts within an octave.
pub const COPIES: Claim = Claim {
    id: "hash.copies",
    anchor: "§5 (hash outputs replace uniform random numbers); not in the paper",
    statement: "no shift takes more than one cell in 50 to a copy of itself, or to what is 1 less it: none below 4096 cells in a plane \
                of two axes, none up to 256 in space",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.75)),
    run: copies,
};

/// Symmetries within an octave.
pub const SYMMETRY: Claim = Claim {
    id: "cells.symmetry",
    anchor: "§5.1 (hash outputs replace uniform random numbers); not in the paper",
    statement: "no mirror in one, two or three axes and no exchange of axes takes more than one cell in 50 to a copy of itself, or to \
                what is 1 less it, whatever plane the mirror is",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.75)),
    run: symmetry,
};

/// Cells of different octaves.
pub const OCTAVE_COPIES: Claim = Claim {
    id: "hash.octave_copies",
    anchor: "§5.4.2 (two scales); not in the paper",
    statement: "no octave repeats more than one cell in 50 of another one, up to 256 cells away in space: neither cells of the same \
                index, from octave -20 to 20, nor those of twice, four times or eight times the index where the cells are as much \
                smaller, from -4 to 4",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.75)),
    run: octave_copies,
};

/// A cell of an octave and its threshold.
#[derive(Clone, Copy)]
struct Seen {
    cell: [i64; 3],
    octave: i32,
    value: f64,
}

/// A linear map of indices: axes exchanged, turned around and stretched.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Map {
    axes: [u8; 3],
    factors: [i8; 3],
}

impl Map {
    const IDENTITY: Self = Self { axes: [0, 1, 2], factors: [1; 3] };

    fn apply(self, cell: [i64; 3]) -> [i64; 3] {
        [0, 1, 2].map(|axis| i64::from(self.factors[axis]) * cell[usize::from(self.axes[axis])])
    }

    /// All symmetries of the grid but the identity.
    fn symmetries() -> impl Iterator<Item = Self> {
        let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
        let signs = (0..8).map(|signs| [1, 2, 4].map(|bit| if signs & bit == 0 { 1 } else { -1 }));
        let all =
            orders.into_iter().flat_map(move |axes| signs.clone().map(move |factors| Self { axes, factors }));
        all.filter(|map| *map != Self::IDENTITY)
    }

    /// Whether it leaves one coordinate as it is.
    fn keeps(self, axis: usize) -> bool {
        usize::from(self.axes[axis]) == axis && self.factors[axis] == 1
    }
}

/// What takes a cell to another one: small, since there are millions of them, and the shift first, which tells most apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Relation {
    shift: [i32; 3],
    map: Map,
    octaves: [i8; 2],
    /// Whether the thresholds add up to 1, and are not equal.
    complement: bool,
}

impl Relation {
    /// As in "(x + 37, y, z)".
    fn image(&self) -> String {
        let coordinate = |axis: usize| {
            let name = ["x", "y", "z"][usize::from(self.map.axes[axis])];
            let scaled = match self.map.factors[axis] {
                1 => name.to_owned(),
                -1 => format!("-{name}"),
                factor => format!("{factor} {name}"),
            };
            match self.shift[axis] {
                0 => scaled,
                shift if shift < 0 => format!("{scaled} - {}", -shift),
                shift => format!("{scaled} + {shift}"),
            }
        };
        format!("({}, {}, {})", coordinate(0), coordinate(1), coordinate(2))
    }

    fn seen(&self) -> String {
        let of = |octave: i8| format!("of octave {octave}");
        let tied = if self.complement { "thresholds that add up to 1" } else { "one threshold" };
        format!(
            "cells (x, y, z) {} and {} {} have {tied}",
            of(self.octaves[0]),
            self.image(),
            of(self.octaves[1])
        )
    }
}

/// Every relation, as often as it came up.
#[derive(Default)]
struct Found(Vec<Relation>);

impl Found {
    /// Looks at every two cells of a set that are equal, or add up to 1, for what takes one to the other; `maps` are those that are
    /// possible between two octaves.
    fn explore<'m>(&mut self, set: &[Seen], maps: impl Fn(i32, i32) -> &'m [Map]) {
        let mut sorted: Vec<&Seen> = set.iter().collect();
        sorted.sort_by(|a, b| a.value.total_cmp(&b.value));
        for (index, first) in sorted.iter().enumerate() {
            let next = sorted[index + 1..].iter().take_while(|other| other.value - first.value <= EQUAL);
            let opposite = 1.0 - first.value;
            // Each two once: from the lower to the higher threshold.
            let from = sorted.partition_point(|other| other.value < opposite - EQUAL).max(index + 1);
            let opposites = sorted[from..].iter().take_while(|other| other.value <= opposite + EQUAL);
            let tied = next.map(|other| (other, false)).take(EQUALS_A_CELL);
            for (other, complement) in tied.chain(opposites.map(|other| (other, true)).take(EQUALS_A_CELL)) {
                // Coarse cells first; within an octave in a fixed order, so that a shift and the one back are one.
                let later = |seen: &Seen| (seen.octave, seen.cell[2], seen.cell[1], seen.cell[0]);
                let [a, b] = if later(first) <= later(other) { [*first, *other] } else { [*other, *first] };
                let octaves = [a.octave, b.octave].map(|octave| octave as i8);
                let relation = |&map| Relation { shift: shift_of(map, a, b), map, octaves, complement };
                self.0.extend(maps(a.octave, b.octave).iter().map(relation));
            }
        }
    }

    /// The relations that came up most.
    fn candidates(mut self) -> Vec<Relation> {
        self.0.sort_unstable();
        let alike = self.0.chunk_by(|a, b| a == b).filter(|alike| alike.len() >= LEAST_SEEN);
        let mut often: Vec<(usize, Relation)> = alike.map(|alike| (alike.len(), alike[0])).collect();
        often.sort_by_key(|(times, _)| core::cmp::Reverse(*times));
        often.truncate(CANDIDATES);
        often.into_iter().map(|(_, relation)| relation).collect()
    }
}

/// The shift that, after a map, takes one cell to another.
fn shift_of(map: Map, first: &Seen, second: &Seen) -> [i32; 3] {
    let image = map.apply(first.cell);
    [0, 1, 2].map(|axis| (second.cell[axis] - image[axis]) as i32)
}

/// Evaluates cells where their octave has all weight.
fn evaluated(subject: &Subject<'_>, cells: &[([i64; 3], i32)]) -> Attempt<Vec<Seen>> {
    let fragments: Vec<Fragment> = cells
        .iter()
        .map(|(cell, octave)| seen_in_cell(subject, DVec3::from_array(cell.map(|c| c as f64)), *octave))
        .collect();
    let values = subject.thresholds(&fragments);
    reject_outsiders(subject, &fragments, &values)?;
    Ok(cells.iter().zip(values).map(|(&(cell, octave), value)| Seen { cell, octave, value }).collect())
}

/// Draws different cells of a box of one octave around a place up to `reach` from the origin along each axis; one axis, if any, has
/// a single layer.
fn set_in(
    subject: &Subject<'_>,
    sides: [i64; 3],
    reach: f64,
    cells: usize,
    rng: &mut Xoshiro256PlusPlus,
) -> Attempt<Vec<Seen>> {
    let octave = draw_octave(rng);
    let corner = sides.map(|side| {
        let place = (2.0 * seed::uniform01(rng) - 1.0) * reach;
        place.floor() as i64 - side / 2
    });
    let mut drawn = FxHashSet::default();
    let mut cell = || [0, 1, 2].map(|axis| corner[axis] + (seed::uniform01(rng) * sides[axis] as f64) as i64);
    let set: Vec<_> = core::iter::repeat_with(&mut cell)
        .filter(|cell| drawn.insert(*cell))
        .take(cells)
        .map(|cell| (cell, octave))
        .collect();
    evaluated(subject, &set)
}

/// Cells of a set.
fn set_cells(draw: &Draw) -> usize {
    draw.samples_at_least(SET_CELLS).min(MOST_SET_CELLS)
}

/// The sets of one octave each: a layer of each two axes, and a cube; with the axis of the layer.
fn sets(
    subject: &Subject<'_>,
    draw: &Draw,
    rng: &mut Xoshiro256PlusPlus,
) -> Attempt<Vec<(Option<usize>, Vec<Seen>)>> {
    let cells = set_cells(draw);
    let mut sets = Vec::new();
    for axis in 0..3 {
        let mut sides = [2 * i64::from(VIEW); 3];
        sides[axis] = 1;
        sets.push((Some(axis), set_in(subject, sides, SPREAD, cells, rng)?));
    }
    sets.push((None, set_in(subject, [2 * i64::from(VIEW_DEPTH); 3], DEEP_REACH, 2 * cells, rng)?));
    Ok(sets)
}

/// Whether a repeat at a shift cannot be tolerated.
fn is_in_view(shift: [i32; 3]) -> bool {
    let longest = shift.map(i32::unsigned_abs).into_iter().fold(0, u32::max);
    longest <= VIEW_DEPTH || shift.contains(&0) && longest < VIEW
}

fn copies(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(COPIES.id);
    let (mut found, mut n) = (Found::default(), 0);
    for (_, set) in sets(subject, draw, &mut rng)? {
        n += set.len();
        found.explore(&set, |_, _| &[Map::IDENTITY]);
    }
    found.0.retain(|relation| is_in_view(relation.shift));
    confirmed(subject, found, n, sure_share(draw), &mut rng)
}

fn symmetry(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(SYMMETRY.id);
    let (mut found, mut n) = (Found::default(), 0);
    for (layer, set) in sets(subject, draw, &mut rng)? {
        n += set.len();
        // What leaves an axis as it is shows best in a layer; the cube is for the others.
        let is_for_this = |map: &Map| match layer {
            Some(axis) => map.keeps(axis),
            None => !(0..3).any(|axis| map.keeps(axis)),
        };
        let maps: Vec<Map> = Map::symmetries().filter(is_for_this).collect();
        found.explore(&set, |_, _| &maps);
    }
    // What lies around the origin, and holds for some octants only, shows among images of few cells.
    let orbits = evaluated(subject, &orbits(&mut rng))?;
    n += orbits.len();
    let maps: Vec<Map> = Map::symmetries().collect();
    found.explore(&orbits, |_, _| &maps);
    confirmed(subject, found, n, sure_share(draw), &mut rng)
}

/// Cells of one octave with all their images: axes exchanged, and each mirrored in the middle of cell 0 or in its lower face.
fn orbits(rng: &mut Xoshiro256PlusPlus) -> Vec<([i64; 3], i32)> {
    let octave = draw_octave(rng);
    let mut cells = Vec::new();
    let mut seen = FxHashSet::default();
    for _ in 0..ORBITS {
        let cell = [0; 3].map(|_| libm::exp2(f64::from(VIEW.ilog2()) * seed::uniform01(rng)) as i64);
        for map in Map::symmetries().chain([Map::IDENTITY]) {
            let image = map.apply(cell);
            for shifted in 0..8 {
                let below = |axis: usize| i64::from(shifted >> axis & 1 == 1 && image[axis] < 0);
                let image = [0, 1, 2].map(|axis| image[axis] - below(axis));
                if seen.insert(image) {
                    cells.push((image, octave));
                }
            }
        }
    }
    cells
}

/// The share of cells that a relation within an octave has to hold for to be among the candidates, at the largest distance: there
/// a quarter of the cells of a layer, and an eighth of those of a cube, have their images in the set.
fn sure_share(draw: &Draw) -> f64 {
    let cells = set_cells(draw) as f64;
    let side = 2.0 * f64::from(VIEW);
    SURE_PAIRS / (0.25 * cells * cells / (side * side))
}

fn octave_copies(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(OCTAVE_COPIES.id);
    let (mut found, mut n) = (Found::default(), 0);
    let anywhere = [0; 3].map(|_| (2.0 * seed::uniform01(&mut rng) - 1.0) * SPREAD);
    // No map within an octave; the same index between any two; and that of the cell at the same place.
    let same = |_| vec![Map::IDENTITY];
    let mut between: Vec<Vec<Map>> = (0..NEST_OCTAVES.count()).map(same).collect();
    between[0].clear();
    for (finer, factor) in [(1, 2), (2, 4), (3, 8)] {
        between[finer].push(Map { factors: [factor; 3], ..Map::IDENTITY });
    }
    // At the origin the same indices come in at every octave; elsewhere those of one place.
    for place in [[0.0; 3], anywhere] {
        let mut cells = Vec::new();
        for octave in NEST_OCTAVES {
            let corner = place.map(|c| libm::ldexp(c, octave).floor() as i64 - NEST_SIDE as i64 / 2);
            cells.extend((0..NEST_SIDE.pow(3)).map(|at| {
                let within = [at % NEST_SIDE, at / NEST_SIDE % NEST_SIDE, at / (NEST_SIDE * NEST_SIDE)];
                ([0, 1, 2].map(|axis| corner[axis] + within[axis] as i64), octave)
            }));
        }
        let set = evaluated(subject, &cells)?;
        n += set.len();
        found.explore(&set, |coarse, fine| &between[(fine - coarse) as usize]);
    }
    // The same few cells in every octave.
    let few = [0; 3].map(|_| ((2.0 * seed::uniform01(&mut rng) - 1.0) * SPREAD) as i64);
    let ladder: Vec<_> = (0..LADDER_CELLS)
        .flat_map(|at| LADDER_OCTAVES.map(move |octave| ([few[0] + at, few[1] + at % 3, few[2]], octave)))
        .collect();
    let set = evaluated(subject, &ladder)?;
    n += set.len();
    found.explore(&set, |coarse, fine| if coarse == fine { &[] } else { &[Map::IDENTITY] });
    found.0.retain(|relation| is_in_view(relation.shift));
    // The nearest octaves whose cells are eight times as small have the fewest pairs.
    let pairs = (NEST_SIDE as f64 / 8.0).powi(3);
    confirmed(subject, found, n, SURE_PAIRS / pairs, &mut rng)
}

/// How probable it is that two independent cells are equal: as often as any two of those seen are.
fn meeting(seen: &[Seen]) -> f64 {
    let mut values: Vec<f64> = seen.iter().map(|seen| seen.value).collect();
    values.sort_by(f64::total_cmp);
    let mut first = 0;
    let mut equal = 0;
    for (index, value) in values.iter().enumerate() {
        while value - values[first] > EQUAL {
            first += 1;
        }
        equal += index - first;
    }
    let pairs = values.len() as f64 * (values.len() as f64 - 1.0) / 2.0;
    LEAST_MEETING.max(equal as f64 / pairs)
}

/// Tries the candidates on fresh cells.
fn confirmed(
    subject: &Subject<'_>,
    found: Found,
    explored: usize,
    sure_share: f64,
    rng: &mut Xoshiro256PlusPlus,
) -> Attempt<Trial> {
    let candidates = found.candidates();
    let tests = candidates.len().max(1) as f64;
    let pairs = CONFIRMING_PAIRS;
    let mut worst: Option<(f64, u64, Relation)> = None;
    for relation in candidates {
        let mut fresh = Vec::with_capacity(2 * pairs);
        while fresh.len() < 2 * pairs {
            let cell = [0; 3].map(|_| ((2.0 * seed::uniform01(rng) - 1.0) * FRESH).floor() as i64);
            let image = relation.map.apply(cell);
            let image = [0, 1, 2].map(|axis| image[axis] + i64::from(relation.shift[axis]));
            let [from, to] = relation.octaves.map(i32::from);
            let [first, second] = [(cell, from), (image, to)];
            // A cell on the mirror is its own image.
            if first != second {
                fresh.extend([first, second]);
            }
        }
        let seen = evaluated(subject, &fresh)?;
        let is_equal = |pair: &&[Seen]| {
            let second = if relation.complement { 1.0 - pair[1].value } else { pair[1].value };
            (pair[0].value - second).abs() <= EQUAL
        };
        let equal = seen.chunks_exact(2).filter(is_equal).count() as u64;
        let p = binomial::poisson_upper_p(equal, pairs as f64 * (meeting(&seen) + TOLERATED_TIE));
        if worst.is_none_or(|(least, ..)| p < least) {
            worst = Some((p, equal, relation));
        }
    }
    let (p, equal, seen) = match worst {
        None => (1.0, 0, String::new()),
        Some((p, equal, relation)) => (p, equal, format!("in {equal} of {pairs} pairs {}", relation.seen())),
    };
    Ok(Trial {
        conclusion: Conclusion::Probability((tests * p).min(1.0)),
        statistic: Some(equal as f64),
        statistic_name: format!("pairs of {pairs} that are copies, worst of {tests} relations"),
        n: explored as u64,
        effect: Some(equal as f64 / pairs as f64),
        effect_name: "share of cells that are copies",
        detectable: Some(sure_share),
        seen,
        evidence: Evidence::None,
    })
}
