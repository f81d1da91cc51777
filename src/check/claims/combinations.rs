//! Linear relations among three, four and eight cells, of which any two may look independent.

use crate::check::evidence::NamedHistogram;
use crate::check::input::{BETWEEN, Block, cube};
use crate::check::judge::histogram;
use crate::check::tolerance::{POWER, SINGLE_LEVEL};
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::stats::forms::WorstForm;
use crate::stats::{chi_square, forms, normal};

/// Cells of the block in which all triples, or all squares, are looked at, 64 x 32 x 32: 1024 expected in every bin.
const COMBINED_CELLS: usize = 1 << 16;

/// Steps between the three cells of a line: to all 13 neighbours that come later in a block, and along each axis two
/// cells far.
const LINES: [[i64; 3]; 16] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
    [2, 0, 0],
    [0, 2, 0],
    [0, 0, 2],
    [1, 1, 0],
    [-1, 1, 0],
    [1, 0, 1],
    [-1, 0, 1],
    [0, 1, 1],
    [0, -1, 1],
    [1, 1, 1],
    [-1, 1, 1],
    [1, -1, 1],
    [-1, -1, 1],
];

/// Sides of the rectangles whose corners are combined: neighbours, and two that are no multiple of another.
const SIDES: [[i64; 2]; 3] = [[1, 1], [1, 2], [5, 3]];

/// Leading binary digits of thresholds whose parities are looked at together, as their number of combinations: as many as bins.
const PARITIES: f64 = 64.0;

/// Three cells of lines and right angles.
pub const TRIPLES: Claim = Claim {
    id: "hash.triples",
    anchor: "§5 (hash outputs replace uniform random numbers); not in the paper",
    statement: "no three cells in a line or at a right angle satisfy a linear relation modulo 1 with coefficients up to 12, nor \
                do two of them",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.1)),
    run: triples,
};

/// Corners of rectangles and of cubes.
pub const SQUARES: Claim = Claim {
    id: "hash.squares",
    anchor: "§5 (hash outputs replace uniform random numbers); not in the paper",
    statement: "three corners of a rectangle of cells do not tell the fourth, nor seven of a cube the eighth: their sum with \
                alternating signs is uniform modulo 1, and so are the parities of their leading digits",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.025)),
    run: squares,
};

/// The sum of two steps.
fn plus(a: [i64; 3], b: [i64; 3]) -> [i64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// The step along one axis.
fn along(axis: usize, cells: i64) -> [i64; 3] {
    let mut step = [0; 3];
    step[axis] = cells;
    step
}

/// The values at a cell of a block and at some others, as far from it as given, wherever all are in the block.
fn together<const N: usize>(
    block: &Block,
    values: &[f64],
    steps: [[i64; 3]; N],
) -> impl Iterator<Item = [f64; N]> {
    let size = block.size.map(|side| side as i64);
    let range = |axis: usize| {
        let at = steps.map(|step| step[axis]);
        let (least, most) = at.iter().fold((0, 0), |(low, high), &step| (step.min(low), step.max(high)));
        -least..size[axis] - most
    };
    let index = move |[x, y, z]: [i64; 3]| x + size[0] * (y + size[1] * z);
    let offsets = steps.map(index);
    let [xs, ys, zs] = [range(0), range(1), range(2)];
    let places = zs.flat_map(move |z| {
        let xs = xs.clone();
        ys.clone().flat_map(move |y| xs.clone().map(move |x| index([x, y, z])))
    });
    places.map(move |place| offsets.map(|offset| values[(place + offset) as usize]))
}

/// The second and third cell of every triple, in the order in which cells of a block are counted.
fn shapes() -> Vec<[[i64; 3]; 2]> {
    let lines = LINES.map(|step| [step, plus(step, step)]);
    let corners = [(0, 1), (0, 2), (1, 2)].into_iter().flat_map(|(first, second)| {
        let (a, b) = (along(first, 1), along(second, 1));
        [[a, b], [a, plus(a, b)], [b, plus(a, b)], [plus(b, along(first, -1)), b]]
    });
    lines.into_iter().chain(corners).collect()
}

/// A block of cells seen where its octave has all weight, the same between two octaves, and one of the next octave, with the thresholds.
fn blocks(subject: &Subject<'_>, draw: &Draw, claim: &str) -> Attempt<[(Block, Vec<f64>); 3]> {
    let mut rng = draw.rng(claim);
    let block = Block::draw(cube(draw.samples(COMBINED_CELLS).ilog2(), &mut rng), &mut rng);
    let (between, next) = (block.seen_at(BETWEEN), Block { octave: block.octave + 1, ..block });
    let seen = |block: Block| block.thresholds(subject).map(|values| (block, values));
    Ok([seen(block)?, seen(between)?, seen(next)?])
}

fn triples(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut worst: Option<(WorstForm, [[i64; 3]; 2], Block)> = None;
    let (mut tests, mut n) = (0_u64, 0);
    for (block, values) in blocks(subject, draw, TRIPLES.id)? {
        n += values.len() as u64;
        for shape in shapes() {
            let [second, third] = shape;
            let Ok(found) = forms::worst_form(together(&block, &values, [[0; 3], second, third])) else {
                continue;
            };
            tests += found.tests;
            if worst.as_ref().is_none_or(|(least, ..)| found.p < least.p) {
                worst = Some((found, shape, block));
            }
        }
    }
    let Some((found, shape, block)) = worst else {
        return Ok(Trial::without(Conclusion::Inconclusive, "the block has no triples"));
    };
    let tests = tests as f64;
    // The mean phase that exceeds the bound of a test but for a normal error on either side.
    let bound = libm::sqrt(libm::log(tests / SINGLE_LEVEL));
    let error = normal::quantile(POWER) * core::f64::consts::FRAC_1_SQRT_2;
    let [a, b, c] = found.coefficients;
    Ok(Trial {
        conclusion: Conclusion::Probability((tests * found.p).min(1.0)),
        statistic: Some(found.strength),
        statistic_name: format!("length of the mean phase, worst of {tests}"),
        n,
        effect: Some(found.strength),
        effect_name: "length of the mean phase",
        detectable: Some((bound + error) / (found.n as f64).sqrt()),
        seen: format!(
            "octave {}, lerp factor {}: {a} h + {b} h' + {c} h'' prefers some values modulo 1, h' and h'' being {:?} and \
             {:?} cells away from h: its mean phase is {:.3} long",
            block.octave, block.fraction, shape[0], shape[1], found.strength
        ),
        evidence: Evidence::None,
    })
}

fn squares(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let (mut evidence, mut n) = (Vec::new(), 0);
    let fraction = |sum: f64| sum - sum.floor();
    let blocks = blocks(subject, draw, SQUARES.id)?;
    for (block, values) in blocks {
        n += values.len() as u64;
        let at = match block.fraction {
            0.0 => format!("octave {}", block.octave),
            _ => format!("between octaves {} and {}", block.octave, block.octave + 1),
        };
        // Whether an even number of corners has a digit, for each of the leading ones at once.
        let parity = |corners: &[f64]| {
            let digits = |value: &f64| ((value * PARITIES) as u32).min(PARITIES as u32 - 1);
            (f64::from(corners.iter().map(digits).fold(0, |all, digits| all ^ digits)) + 0.5) / PARITIES
        };
        for (name, first, second) in [("xy", 0, 1), ("xz", 0, 2), ("yz", 1, 2)] {
            for [width, height] in SIDES {
                let (a, b) = (along(first, width), along(second, height));
                let corners = together(&block, &values, [[0; 3], a, b, plus(a, b)]);
                let (sums, parities): (Vec<f64>, Vec<f64>) = corners
                    .map(|corners @ [h, ha, hb, hab]| (fraction(h - ha - hb + hab), parity(&corners)))
                    .unzip();
                let of = format!("{width} x {height} cells in {name}, {at}");
                evidence.push(NamedHistogram::new(format!("sums of {of}"), &histogram(sums)));
                evidence.push(NamedHistogram::new(format!("parities of {of}"), &histogram(parities)));
            }
        }
        let [x, y, z] = [along(0, 1), along(1, 1), along(2, 1)];
        let corners = [[0; 3], x, y, z, plus(x, y), plus(x, z), plus(y, z), plus(x, plus(y, z))];
        let (sums, parities): (Vec<f64>, Vec<f64>) = together(&block, &values, corners)
            .map(|corners @ [h, x, y, z, xy, xz, yz, xyz]| {
                (fraction(h - x - y - z + xy + xz + yz - xyz), parity(&corners))
            })
            .unzip();
        evidence.push(NamedHistogram::new(format!("sums of cubes, {at}"), &histogram(sums)));
        evidence.push(NamedHistogram::new(format!("parities of cubes, {at}"), &histogram(parities)));
    }
    let tests: Vec<_> =
        evidence.iter().filter_map(|corners| chi_square::uniform(&corners.counts).ok()).collect();
    let worst = tests.iter().enumerate().min_by(|a, b| a.1.p.total_cmp(&b.1.p));
    let seen = worst.map_or_else(String::new, |(index, test)| {
        format!(
            "{}: the corners with alternating signs, or the parities of their digits, are not uniform modulo 1, chi-square \
             {:.0} over {} dof",
            evidence[index].name, test.statistic, test.dof
        )
    });
    Ok(Trial::worst_of(&tests, n, seen, Evidence::Histograms(evidence)))
}
