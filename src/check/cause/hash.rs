//! What the hash of a cell depends on.

use super::law::{follows, laws, mean_of_three, occupied, unique};
use super::probe::{Probe, SAME};
use super::slip::{Found, Slip, found, named};
use crate::stats::seed;
use crate::threshold::real::Real;
use glam::{DVec3, dvec3};
use rand::rngs::Xoshiro256PlusPlus;

/// Pairs of cells that a relation is tried on.
const PAIRS: usize = 192;

/// Cells whose values are counted.
const CELLS: usize = 4096;

/// A share of pairs with a relation that all have.
const MOST: f64 = 0.95;

/// The place within a cell at which it is asked: inside of it wherever cells begin.
const INSIDE: f64 = 0.45;

fn cell(rng: &mut Xoshiro256PlusPlus, reach: f64) -> DVec3 {
    let mut index = || ((2.0 * seed::uniform01(rng) - 1.0) * reach).floor();
    dvec3(index(), index(), index())
}

/// Makes one cell of two at the origin, too.
pub(super) const MIRRORED: Slip = named("mirrored-coordinates");

const OPPOSITE: Slip = named("opposite-of-its-mirror");
const BAYER: Slip = named("bayer-matrix");
const EIGHT_BITS: Slip = named("eight-bit-indices");
const SIXTEEN_BITS: Slip = named("sixteen-bit-indices");
const LOWEST_BIT: Slip = named("lowest-bit-dropped");
const EIGHT_BIT_HASH: Slip = named("eight-bit-hash");

/// A relation between cells that a slip makes one.
struct Relation {
    slip: Slip,
    shown: &'static str,
    /// A cell.
    one: fn(&mut Xoshiro256PlusPlus) -> DVec3,
    /// The other, given the first.
    other: fn(DVec3, &mut Xoshiro256PlusPlus) -> DVec3,
}

/// A relation of any cell around the origin.
const fn relation(
    slip: Slip,
    shown: &'static str,
    other: fn(DVec3, &mut Xoshiro256PlusPlus) -> DVec3,
) -> Relation {
    Relation { slip, shown, one: around, other }
}

/// A cell around the origin.
fn around(rng: &mut Xoshiro256PlusPlus) -> DVec3 {
    cell(rng, 100.0)
}

fn step(rng: &mut Xoshiro256PlusPlus) -> f64 {
    (seed::uniform01(rng) * 40.0).floor() + 1.0
}

/// A cell with the same exclusive or of x and y.
fn exclusive(cell: DVec3, bits: i64) -> DVec3 {
    let exchanged = |index: f64| ((index as i64) ^ bits) as f64;
    dvec3(exchanged(cell.x), exchanged(cell.y), cell.z)
}

/// The first of two cells that differ in the last bit along an axis; the second.
fn neighbour(cell: DVec3, axis: DVec3) -> DVec3 {
    let index = cell.dot(axis);
    cell + axis * (1.0 - 2.0 * (index - 2.0 * (0.5 * index).floor()))
}

/// The first that holds is told.
const RELATIONS: &[Relation] = &[
    relation(named("one-threshold-an-object"), "any two cells have one threshold", |_, rng| around(rng)),
    relation(named("without-x"), "cells that differ in x alone have one threshold", |cell, rng| {
        cell + DVec3::X * step(rng)
    }),
    relation(named("without-y"), "cells that differ in y alone have one threshold", |cell, rng| {
        cell + DVec3::Y * step(rng)
    }),
    relation(
        BAYER,
        "cells that are multiples of 16 apart along x and y have one threshold, whatever z is",
        |cell, rng| cell + dvec3(16.0, 16.0 * step(rng), step(rng)),
    ),
    relation(
        named("two-dimensional-hash"),
        "cells that differ in z alone have one threshold",
        |cell, rng| cell + DVec3::Z * step(rng),
    ),
    relation(named("sum-of-coordinates"), "cells of one sum x + y + z have one threshold", |cell, rng| {
        let by = step(rng);
        cell + dvec3(by, -by - 1.0, 1.0)
    }),
    relation(
        named("xor-of-coordinates"),
        "cells of one exclusive or of x and y have one threshold",
        |cell, rng| exclusive(cell, step(rng) as i64),
    ),
    relation(MIRRORED, "places that are opposite across the origin have one threshold", |cell, _| {
        -cell - 2.0 * INSIDE
    }),
    relation(MIRRORED, "cells with indices of opposite sign have one threshold", |cell, _| -cell),
    relation(named("commuting-coordinates"), "the cells x, y and y, x have one threshold", |cell, _| {
        dvec3(cell.y, cell.x, cell.z)
    }),
    Relation {
        one: |rng| around(rng).abs() + 600.0,
        ..relation(EIGHT_BITS, "cells beyond 500 along every axis have one threshold", |_, rng| {
            around(rng).abs() + 600.0
        })
    },
    relation(EIGHT_BITS, "cells that are 256 apart along every axis have one threshold", |cell, _| {
        cell + 256.0
    }),
    Relation {
        one: |rng| around(rng).abs() + 80_000.0,
        ..relation(SIXTEEN_BITS, "cells beyond 80,000 along every axis have one threshold", |_, rng| {
            around(rng).abs() + 80_000.0
        })
    },
    relation(SIXTEEN_BITS, "cells that are 65,536 apart along every axis have one threshold", |cell, _| {
        cell + 65_536.0
    }),
    relation(LOWEST_BIT, "cells 2 i and 2 i + 1 along x have one threshold", |cell, _| {
        neighbour(cell, DVec3::X)
    }),
    relation(LOWEST_BIT, "cells 2 i and 2 i + 1 along y have one threshold", |cell, _| {
        neighbour(cell, DVec3::Y)
    }),
    relation(LOWEST_BIT, "cells 2 i and 2 i + 1 along z have one threshold", |cell, _| {
        neighbour(cell, DVec3::Z)
    }),
];

/// Looks at what the hash makes of indices.
///
/// `is_bent`: the law of single cells is not uniform because of their hash. `has_steps`: thresholds have few values anyway.
pub(super) fn look(
    probe: &Probe<'_>,
    is_bent: bool,
    has_steps: bool,
    rng: &mut Xoshiro256PlusPlus,
) -> Vec<Found> {
    let relation = RELATIONS.iter().find_map(|Relation { slip, shown, one, other }| {
        let pair = |_| {
            let cell = one(rng);
            [cell, other(cell, rng)].map(|cell| cell + INSIDE)
        };
        let pairs: Vec<[DVec3; 2]> = (0..PAIRS).map(pair).collect();
        let share = probe.share(&pairs);
        (share >= MOST).then(|| found(*slip, format!("{shown}: {:.0} % of {PAIRS} pairs", 100.0 * share)))
    });
    let relation = relation
        .or_else(|| small_factor(probe, rng))
        .or_else(|| added(probe, rng))
        .or_else(|| opposite(probe, rng));
    let law = law(probe, is_bent, has_steps, rng);
    // The law of a mean is that of its relation.
    let is_told = |law: &Found| relation.as_ref().is_some_and(|relation| relation.slip == law.slip);
    let law = law.filter(|law| !is_told(law));
    // Odd hashes are often the smaller part of what is wrong with a hash.
    let relation = relation.filter(|relation| law.is_none() || relation.slip != OPPOSITE);
    let mut all: Vec<Found> = relation.into_iter().chain(law).collect();
    if let [relation, law] = &mut all[..]
        && (relation.slip == EIGHT_BITS || relation.slip == BAYER)
        && law.slip == EIGHT_BIT_HASH
    {
        const TABLE: Slip = named("permutation-table");
        let slip = if relation.slip == BAYER { BAYER } else { TABLE };
        return vec![found(slip, format!("{}; {}", relation.shown, law.shown))];
    }
    // Coordinates that end do so at a place, and indices at a number.
    if let [relation] = &mut all[..]
        && relation.slip == EIGHT_BITS
    {
        const END: Slip = named("coordinates-end");
        let far = |rng: &mut Xoshiro256PlusPlus| around(rng).abs() + 600.0 + INSIDE;
        let places: Vec<DVec3> = (0..PAIRS).map(|_| far(rng)).collect();
        let [large, small] = [0, 3].map(|octave| unique(&probe.cells_at(octave, &places)).len());
        if large == 1 && small > PAIRS / 2 {
            relation.slip = END;
        }
    }
    all
}

/// Whether the hash is fract(43758.5453 sin(dot)), of three coordinates or of two and once more of that and the third, or another
/// one of which opposite cells add up to one.
fn opposite(probe: &Probe<'_>, rng: &mut Xoshiro256PlusPlus) -> Option<Found> {
    const ODD: Slip = named("fract-sin-dot");
    const TEN: Slip = named("sine-times-ten");
    /// What the third coordinate is multiplied by in the copies of this hash.
    const THIRD: [f64; 6] = [37.719, 45.164, 45.5432, 144.7272, 53.539, 94.673];
    let cells: Vec<DVec3> = (0..PAIRS).map(|_| around(rng)).collect();
    let places: Vec<DVec3> = cells.iter().map(|&cell| cell + INSIDE).collect();
    let values = probe.cells(&places);
    let like = |hash: &dyn Fn([f64; 3]) -> f64| {
        let is_so = |(cell, value): &(&DVec3, &f64)| {
            let difference = (hash(cell.to_array()) - **value).abs();
            difference.min(1.0 - difference).abs() < SAME
        };
        cells.iter().zip(&values).filter(is_so).count()
    };
    for factor in [43_758.545_3, 43_758.545_312_3, 10.0] {
        let of_two = |x: f32, y: f32| Real::fract(Real::sin(x * 12.9898 + y * 78.233) * factor as f32);
        let nested = like(&|cell| {
            let [x, y, z] = cell.map(|index| index as f32);
            f64::from(of_two(of_two(x, y), z))
        });
        let flat = THIRD.map(|third| {
            let in_f32 = like(&|cell| {
                let [x, y, z] = cell.map(|index| index as f32);
                let dot = x * 12.9898 + y * 78.233 + z * third as f32;
                f64::from(Real::fract(Real::sin(dot) * factor as f32))
            });
            let in_f64 =
                like(&|[x, y, z]| Real::fract(Real::sin(x * 12.9898 + y * 78.233 + z * third) * factor));
            in_f32.max(in_f64)
        });
        let count = flat.into_iter().fold(nested, usize::max);
        if 2 * count > PAIRS {
            let shown = format!("{count} of {PAIRS} cells have the value of fract({factor} sin(dot))");
            return Some(found(if factor < 100.0 { TEN } else { ODD }, shown));
        }
    }
    let pairs: Vec<_> = cells.iter().map(|&cell| [cell + INSIDE, INSIDE - cell]).collect();
    let share = probe.share_of(&pairs, |a, b| (a + b - 1.0).abs() < SAME);
    let shown =
        format!("the thresholds of opposite cells add up to 1: {:.0} % of {PAIRS} pairs", 100.0 * share);
    (share >= MOST).then(|| found(OPPOSITE, shown))
}

/// Whether each coordinate has a hash of its own that is added to those of the others.
fn added(probe: &Probe<'_>, rng: &mut Xoshiro256PlusPlus) -> Option<Found> {
    const SUM: Slip = named("sum-of-three-hashes");
    const MEAN: Slip = named("mean-of-three-hashes");
    const CONGRUENCE: Slip = named("congruential-hash");
    let mut places = Vec::new();
    for _ in 0..PAIRS {
        let (cell, by_x, by_y) = (around(rng) + INSIDE, DVec3::X * step(rng), DVec3::Y * step(rng));
        places.extend([cell, cell + by_x, cell + by_y, cell + by_x + by_y]);
    }
    let values = probe.cells(&places);
    let share = |holds: fn(f64) -> bool| {
        let holding = values.chunks_exact(4).filter(|v| holds(v[1] - v[0] - (v[3] - v[2]))).count();
        holding as f64 / PAIRS as f64
    };
    let plainly = share(|difference| difference.abs() < SAME);
    let wrapped = share(|difference| (difference - difference.round()).abs() < SAME);
    let shown = |share: f64| {
        format!(
            "a step in x changes the threshold by as much whatever y is: {:.0} % of {PAIRS} pairs",
            100.0 * share
        )
    };
    if plainly >= MOST {
        return Some(found(MEAN, shown(plainly)));
    }
    if wrapped < MOST {
        return None;
    }
    // A step of one along x is the same number everywhere.
    let pairs: Vec<_> = (0..PAIRS)
        .map(|_| {
            let cell = around(rng) + INSIDE;
            [cell, cell + DVec3::X]
        })
        .collect();
    let values = probe.cells(pairs.as_flattened());
    let step = |pair: &[f64]| {
        let difference = pair[1] - pair[0];
        difference - difference.floor()
    };
    let first = step(&values[..2]);
    let alike = values.chunks_exact(2).filter(|pair| (step(pair) - first).abs() < 2.0 * SAME).count();
    if alike as f64 >= 0.9 * PAIRS as f64 {
        return Some(found(
            CONGRUENCE,
            format!("a step of one in x adds {first:.3}: {alike} of {PAIRS} pairs"),
        ));
    }
    Some(found(SUM, shown(wrapped)))
}

/// Whether there are few values, or a law that shows through.
fn law(probe: &Probe<'_>, is_bent: bool, has_steps: bool, rng: &mut Xoshiro256PlusPlus) -> Option<Found> {
    const SIGNED: Slip = named("signed-hash");
    const MEAN: Slip = named("mean-of-three-hashes");
    let places: Vec<_> = (0..CELLS).map(|_| cell(rng, 1000.0) + INSIDE).collect();
    let values = probe.cells(&places);
    // A negative value is clamped from below, or its square by the weight of an octave that has none from above.
    let inner: Vec<f64> = values.iter().copied().filter(|value| (2.0e-6..1.0).contains(value)).collect();
    let ends = CELLS - inner.len();
    let is_half = (0.4..0.6).contains(&(ends as f64 / CELLS as f64)) && follows(&inner, |value| value);
    if is_half || values.iter().any(|&value| value < -0.2) {
        let shown = format!("{ends} of {CELLS} cells have no threshold inside of (0, 1)");
        return Some(found(SIGNED, shown));
    }
    let count = occupied(&values);
    if !has_steps && count <= 600 {
        return Some(found(
            EIGHT_BIT_HASH,
            format!("{CELLS} cells have thresholds in {count} of 4096 steps"),
        ));
    }
    if !is_bent {
        return None;
    }
    if follows(&values, mean_of_three) {
        return Some(found(MEAN, "thresholds of single cells have the law of a mean of three".to_owned()));
    }
    laws(&values).into_iter().find_map(|law| Some(found(law.slip?, law.shown)))
}

/// Whether the hash is the paper's, with a smaller factor before the fraction is taken.
fn small_factor(probe: &Probe<'_>, rng: &mut Xoshiro256PlusPlus) -> Option<Found> {
    const TEN: Slip = named("sine-times-ten");
    let cells: Vec<DVec3> = (0..PAIRS).map(|_| around(rng)).collect();
    let places: Vec<DVec3> = cells.iter().map(|&cell| cell + INSIDE).collect();
    let values = probe.cells(&places);
    [1.0, 10.0, 100.0].into_iter().find_map(|factor: f32| {
        let of_two = |x: f32, y: f32| {
            let sines = Real::sin(17.0 * x + 0.1 * y) * (0.1 + Real::sin(13.0 * y + x).abs());
            Real::fract(factor * sines)
        };
        let is_so = |(cell, value): &(&DVec3, &f64)| {
            let [x, y, z] = cell.to_array().map(|index| index as f32);
            (f64::from(of_two(of_two(x, y), z)) - **value).abs() < SAME
        };
        let count = cells.iter().zip(&values).filter(is_so).count();
        let shown = format!("{count} of {PAIRS} cells have the value of a sine times {factor}");
        (2 * count > PAIRS).then(|| found(TEN, shown))
    })
}
