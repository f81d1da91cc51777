//! What becomes of two hashes: the sound way and the wrong ones, as functions of what a threshold shows of single cells.

use super::law::Distribution;
use super::slip::{Slip, named};
use crate::threshold::cdf;

/// What is known of one threshold: those of the cells that its point lies in, each where one octave has all weight.
#[derive(Clone, Copy)]
pub(super) struct Sight {
    /// From the octave below the coarse one to the one above the fine one.
    pub alone: [f64; 4],
    /// Weight of the fine octave, in [0, 1).
    pub weight: f64,
    /// The octave that is nearest along each axis, and the one above it.
    pub nearest: [f64; 2],
    /// The same where it is taken of the scale and not of its logarithm.
    pub of_scale: f64,
}

/// A way of joining.
#[derive(Clone, Copy)]
pub(super) struct Form {
    pub slip: Option<Slip>,
    /// One value, and the weight that the CDF is given.
    pub of: fn(&Sight) -> (f64, f64),
    /// Whether one value of a cell is all that it takes, whatever the weight.
    pub is_weightless: bool,
    /// Whether the weight grows towards the coarser cell.
    pub is_reversed: bool,
}

const fn form(slip: &'static str, of: fn(&Sight) -> (f64, f64)) -> Form {
    Form { slip: Some(named(slip)), of, is_weightless: false, is_reversed: false }
}

fn mixed(coarse: f64, fine: f64, t: f64) -> f64 {
    (1.0 - t) * coarse + t * fine
}

/// Joins by name of the slip; the first is sound.
pub(super) const FORMS: &[Form] = &[
    Form {
        slip: None,
        of: |s| (mixed(s.alone[1], s.alone[2], s.weight), s.weight),
        is_weightless: false,
        is_reversed: false,
    },
    // Of these two the cells tell which: the finer cell is seen alone in the one, the coarser one in the other.
    Form {
        is_reversed: true,
        ..form("coarser-for-finer", |s| (mixed(s.alone[1], s.alone[0], s.weight), s.weight))
    },
    form("octave-skipped", |s| (mixed(s.alone[1], s.alone[3], s.weight), s.weight)),
    Form { is_weightless: true, ..form("one-octave-for-both", |s| (s.alone[1], s.weight)) },
    Form { is_weightless: true, ..form("coarse-octave-alone", |s| (s.alone[1], 0.0)) },
    form("nearest-octave", |s| (if s.weight < 0.5 { s.alone[1] } else { s.alone[2] }, 0.0)),
    form("nearest-octave", |s| (if s.weight < 0.5 { s.alone[1] } else { s.alone[2] }, s.weight)),
    form("octave-rounded", |s| (mixed(s.nearest[0], s.nearest[1], s.weight), s.weight)),
    form("linear-weight", |s| (mixed(s.alone[1], s.alone[2], libm::exp2(s.weight) - 1.0), s.weight)),
    form("linear-weight", |s| {
        let linear = libm::exp2(s.weight) - 1.0;
        (mixed(s.alone[1], s.alone[2], linear), linear)
    }),
    form("weight-of-the-scale", |s| (mixed(s.alone[1], s.alone[2], s.of_scale), s.of_scale)),
    form("weight-of-the-scale", |s| (mixed(s.alone[1], s.alone[2], s.of_scale), s.weight)),
    form("smoothstep-weight", |s| {
        let smooth = s.weight * s.weight * (3.0 - 2.0 * s.weight);
        (mixed(s.alone[1], s.alone[2], smooth), s.weight)
    }),
    form("second-hash-from-the-first", |s| (mixed(s.alone[1], 1.0 - s.alone[1], s.weight), s.weight)),
    form("weights-that-add-up-to-more", |s| ((s.alone[1] + s.weight * s.alone[2]).min(1.0), s.weight)),
    form("geometric-mean", |s| {
        let [coarse, fine] = [s.alone[1], s.alone[2]];
        (libm::pow(coarse, 1.0 - s.weight) * libm::pow(fine, s.weight), s.weight)
    }),
];

/// What stands in for Eq. 2.
#[derive(Clone, Copy)]
pub(super) struct Correction {
    pub slip: Option<Slip>,
    /// Of a value and a weight.
    pub of: fn(f64, f64) -> f64,
}

const fn correction(slip: &'static str, of: fn(f64, f64) -> f64) -> Correction {
    Correction { slip: Some(named(slip)), of }
}

/// The three cases of Eq. 2 with other parts.
fn cases(x: f64, a: f64, [first, middle, last]: [f64; 3]) -> f64 {
    if x < a {
        first
    } else if x < 1.0 - a {
        middle
    } else {
        last
    }
}

fn minor(t: f64) -> f64 {
    t.min(1.0 - t)
}

fn first(x: f64, a: f64) -> f64 {
    x * x / (2.0 * a * (1.0 - a))
}

fn middle(x: f64, a: f64) -> f64 {
    (x - 0.5 * a) / (1.0 - a)
}

fn last(x: f64, a: f64) -> f64 {
    1.0 - first(1.0 - x, a)
}

/// Corrections by name of the slip; the first is Eq. 2.
pub(super) const CORRECTIONS: &[Correction] = &[
    Correction { slip: None, of: cdf::cdf },
    correction("no-cdf", |x, _| x),
    correction("case-by-lerp-factor", |x, t| {
        let a = minor(t);
        cases(t, a, [first(x, a), middle(x, a), last(x, a)])
    }),
    correction("case-by-lerp-factor", |x, t| {
        let a = minor(t);
        if t < a || t <= 0.0 {
            first(x, a)
        } else if t > 1.0 - a {
            last(x, a)
        } else {
            middle(x, a)
        }
    }),
    correction("case-by-lerp-factor", |x, t| {
        let a = minor(t);
        cases(x, a, [middle(x, a), middle(x, a), last(x, a)])
    }),
    correction("divisor-without-two", |x, t| {
        let a = minor(t);
        cases(x, a, [2.0 * first(x, a), middle(x, a), 1.0 - 2.0 * first(1.0 - x, a)])
    }),
    correction("a-without-min", |x, a| {
        if x < 1.0 - a { if x < a { first(x, a) } else { middle(x, a) } } else { last(x, a) }
    }),
    correction("a-without-min", |x, a| cases(x, a, [first(x, a), middle(x, a), last(x, a)])),
    correction("max-for-min-in-a", |x, t| {
        let a = t.max(1.0 - t);
        cases(x, a, [first(x, a), middle(x, a), last(x, a)])
    }),
    correction("max-for-min-in-a", |x, t| {
        let a = t.max(1.0 - t);
        if x < 1.0 - a { first(x, a) } else { last(x, a) }
    }),
    correction("first-cases-swapped", |x, t| {
        let a = minor(t);
        cases(x, a, [middle(x, a), first(x, a), last(x, a)])
    }),
    correction("last-case-missing", |x, t| {
        let a = minor(t);
        cases(x, a, [first(x, a), middle(x, a), middle(x, a)])
    }),
    correction("middle-case-unshifted", |x, t| {
        let a = minor(t);
        cases(x, a, [first(x, a), x / (1.0 - a), last(x, a)])
    }),
    correction("last-case-unmirrored", |x, t| {
        let a = minor(t);
        cases(x, a, [first(x, a), middle(x, a), 1.0 - first(x, a)])
    }),
    correction("last-case-unmirrored", |x, t| {
        let a = minor(t);
        cases(x, a, [first(x, a), middle(x, a), first(1.0 - x, a)])
    }),
    correction("cdf-of-equal-weights", |x, _| cdf::cdf(x, 0.5)),
    correction("inverse-for-cdf", cdf::quantile),
    correction("density-for-cdf", cdf::density),
    correction("smoothstep-for-cdf", |x, _| x * x * (3.0 - 2.0 * x)),
    correction("cdf-twice", |x, t| cdf::cdf(cdf::cdf(x, t), t)),
];

/// One case of Eq. 2 alone is another formula: in the order of the cases.
pub(super) const CASES: [Slip; 3] =
    [named("first-case-wrong"), named("middle-case-wrong"), named("last-case-wrong")];

/// The case of Eq. 2 that a value at a weight is of; none within `near` of where two meet.
pub(super) fn case_of(x: f64, t: f64, near: f64) -> Option<usize> {
    let a = minor(t);
    let is_apart = (x - a).abs() >= near && (x - (1.0 - a)).abs() >= near;
    is_apart.then(|| cases(x, a, [0.0, 1.0, 2.0]) as usize)
}

/// Joins whose value does not follow the weight show two cells at every view, each with its own law of single cells: the
/// distribution function of the value of two hashes. One hash of the finer cell, as of two ceilings, looks like a sum that wraps
/// around.
pub(super) const WEIGHTLESS: &[(Slip, Distribution)] = &[
    (named("larger-of-two"), |x| x * x),
    (named("product-of-two"), |x| if x > 0.0 { x - x * libm::log(x) } else { 0.0 }),
    (named("mean-of-two"), |x| cdf::cdf(x, 0.5)),
    (named("sum-that-wraps"), |x| x),
];
