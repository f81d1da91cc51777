//! The error of every stage against an independent evaluation of higher precision, held in one table.
//!
//! `f32` stages are compared with `f64` and double-double arithmetic; `f64` stages with double-double arithmetic and
//! the correctly rounded functions of CORE-MATH, which add up to half an ULP of their own.
#![allow(clippy::print_stdout)] // What was measured, for those who ask with --nocapture.

use crate::budget::{Budget, budget};
use crate::exact::Exact;
use hashed_alpha::stats::seed::{rng, uniform01};
use hashed_alpha::threshold::cdf::{cdf, cdf_literal, density, quantile};
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::normal::{normal_cdf, normal_quantile};
use hashed_alpha::threshold::real::Real;
use hashed_alpha::threshold::robust::scales::corner_weight;
use hashed_alpha::threshold::two_scale::Variant;
use rand::Rng;
use rand::rngs::Xoshiro256PlusPlus;
use rayon::prelude::*;

/// A row of the table may allow this many times the error that is measured, and no more: a better stage tightens its
/// row.
const SLACK: f64 = 1.25;

/// One stage in one precision.
struct Stage {
    name: &'static str,
    precision: &'static str,
    /// Largest error in ULP, of the exact value unless the reason says otherwise.
    allowed: f64,
    reason: &'static str,
    case: fn(&mut Xoshiro256PlusPlus) -> Case,
}

/// One evaluation of a stage.
struct Case {
    arguments: Vec<f64>,
    value: f64,
    exact: Exact,
    /// Size of one ULP.
    ulp: f64,
}

impl Case {
    fn new<R: Real>(arguments: &[R], value: R, exact: Exact) -> Self {
        let arguments = arguments.iter().map(|x| x.to_f64()).collect();
        Self { arguments, value: value.to_f64(), exact, ulp: ulp::<R>(exact.high) }
    }

    fn error(&self) -> f64 {
        let difference = Exact::from(self.value) - self.exact;
        let error = (difference.high / self.ulp).abs();
        // A value that is not a number is wrong by more than any row allows.
        if error.is_nan() { f64::INFINITY } else { error }
    }
}

/// The distance between neighbouring numbers of a precision at `x`.
fn ulp<R: Real>(x: f64) -> f64 {
    let (bits, least) = if R::NAME == f32::NAME { (23, -149.0) } else { (52, -1074.0) };
    let exponent = f64::from(libm::ilogb(x) - bits);
    libm::exp2(exponent.max(least))
}

macro_rules! stage {
    ($name:literal, $real:ident, $allowed:literal, $reason:literal, $case:expr) => {
        Stage { name: $name, precision: stringify!($real), allowed: $allowed, reason: $reason, case: $case }
    };
}

const STAGES: [Stage; 23] = [
    stage!("sin", f32, 0.51, "correctly rounded: half an ULP", sine::<f32>),
    stage!("sin", f64, 1.0, "libm: the correctly rounded value or its neighbour", sine::<f64>),
    stage!("log2", f32, 0.51, "correctly rounded: half an ULP", logarithm::<f32>),
    stage!("log2", f64, 1.0, "libm: the correctly rounded value or its neighbour", logarithm::<f64>),
    stage!("exp2", f32, 0.51, "correctly rounded: half an ULP", power::<f32>),
    stage!("exp2", f64, 1.0, "libm: the correctly rounded value or its neighbour", power::<f64>),
    stage!("max_derivative", f32, 1.6, "three squares, two sums, one root", max_derivative::<f32>),
    stage!("max_derivative", f64, 1.6, "three squares, two sums, one root", max_derivative::<f64>),
    stage!("pixel_scale", f32, 3.2, "max_derivative, one product, one quotient", pixel_scale::<f32>),
    stage!("pixel_scale", f64, 3.2, "max_derivative, one product, one quotient", pixel_scale::<f64>),
    stage!("lerp_factor", f32, 2.3, "in ULP of log2, whose whole part is taken off", lerp_factor::<f32>),
    stage!("lerp_factor", f64, 2.3, "in ULP of log2, whose whole part is taken off", lerp_factor::<f64>),
    stage!("corner_weight", f32, 3.2, "two lengths, a sum, a quotient", corner::<f32>),
    stage!("cdf", f32, 3.2, "two quotients, two products, one difference", law::<f32>),
    stage!("cdf", f64, 3.2, "two quotients, two products, one difference", law::<f64>),
    stage!("cdf_literal", f32, 3.0, "like cdf, with a >= 2^-20 so that no square underflows", literal::<f32>),
    stage!("cdf_literal", f64, 3.0, "like cdf, with a >= 2^-20 so that no square underflows", literal::<f64>),
    stage!("density", f32, 2.1, "two differences, one product, one quotient", slope::<f32>),
    stage!("density", f64, 2.1, "two differences, one product, one quotient", slope::<f64>),
    stage!("quantile", f32, 1.7, "four products, one root, one difference", inverse::<f32>),
    stage!("quantile", f64, 1.7, "four products, one root, one difference", inverse::<f64>),
    stage!("normal_cdf", f64, 38.0, "the rounded z / sqrt 2 is amplified by z^2, here up to 30", normal_law),
    stage!(
        "normal_quantile",
        f64,
        7.2,
        "AS 241: two polynomials of degree 7 and their quotient",
        normal_inverse
    ),
];

/// Returns the worst error of a stage over `samples` cases, and its case.
fn worst(stage: &Stage, samples: u64) -> (f64, Case) {
    const TASKS: u64 = 64;
    let task = |task: u64| {
        let mut rng = rng(&format!("oracle.{}.{}", stage.name, stage.precision), task);
        let cases = (0..samples / TASKS).map(|_| (stage.case)(&mut rng));
        cases.map(|case| (case.error(), case)).max_by(|a, b| a.0.total_cmp(&b.0)).expect("there are samples")
    };
    (0..TASKS).into_par_iter().map(task).max_by(|a, b| a.0.total_cmp(&b.0)).expect("there are tasks")
}

#[test]
fn every_stage_is_as_accurate_as_its_row_says_and_no_more() {
    let mut faults = Vec::new();
    for stage in &STAGES {
        let (error, case) = worst(stage, budget().pick(1 << 14, 1 << 20, 1 << 24));
        let hex: Vec<_> = case.arguments.iter().map(|x| format!("0x{:016x}", x.to_bits())).collect();
        let row = format!(
            "{:15} {} {error:6.3} ULP of {:5} allowed at ({}) as f64 bits, value {:e}: {}",
            stage.name,
            stage.precision,
            stage.allowed,
            hex.join(", "),
            case.value,
            stage.reason
        );
        println!("{row}");
        // A small sample does not find the worst case.
        let loose = budget() != Budget::Quick && stage.allowed > SLACK * error;
        if error > stage.allowed || loose {
            faults.push(row);
        }
    }
    assert!(
        faults.is_empty(),
        "too inaccurate, or more than {SLACK} times as accurate:\n{}",
        faults.join("\n")
    );
}

/// The table must notice a stage that is a little worse than it says.
#[test]
fn a_worse_polynomial_is_noticed() {
    fn worse(rng: &mut Xoshiro256PlusPlus) -> Case {
        let x: f32 = between(rng, -3.0, 3.0);
        Case::new(&[x], Real::sin(x) * (1.0 + f32::EPSILON), Exact::from(core_math::sin(f64::from(x))))
    }
    let (error, _) = worst(&stage!("worse", f32, 0.51, "", worse), 1 << 14);
    assert!(error > 0.51, "{error}");
}

fn between<R: Real>(rng: &mut Xoshiro256PlusPlus, low: f64, high: f64) -> R {
    R::from_f64(low + (high - low) * uniform01(rng))
}

/// A number in [2^low, 2^high), its logarithm evenly spread.
fn scaled<R: Real>(rng: &mut Xoshiro256PlusPlus, low: f64, high: f64) -> R {
    let exponent: f64 = between(rng, low, high);
    R::from_f64(libm::exp2(exponent))
}

/// A number with a random sign.
fn signed<R: Real>(rng: &mut Xoshiro256PlusPlus, low: f64, high: f64) -> R {
    let magnitude = scaled(rng, low, high);
    if rng.next_u32() & 1 == 0 { magnitude } else { -magnitude }
}

/// A number in [0, 1], a third of them each near 0, near 1 and between.
fn unit<R: Real>(rng: &mut Xoshiro256PlusPlus) -> R {
    match rng.next_u32() % 3 {
        0 => scaled(rng, -20.0, 0.0),
        1 => R::from_f64(1.0 - scaled::<f64>(rng, -20.0, 0.0)),
        _ => between(rng, 0.0, 1.0),
    }
}

/// The arguments of the sine hash: up to 2^24.
fn sine<R: Real>(rng: &mut Xoshiro256PlusPlus) -> Case {
    let x: R = signed(rng, -20.0, 24.0);
    Case::new(&[x], x.sin(), Exact::from(core_math::sin(x.to_f64())))
}

fn logarithm<R: Real>(rng: &mut Xoshiro256PlusPlus) -> Case {
    let x: R = scaled(rng, -100.0, 100.0);
    Case::new(&[x], x.log2(), Exact::from(core_math::log2(x.to_f64())))
}

fn power<R: Real>(rng: &mut Xoshiro256PlusPlus) -> Case {
    let x: R = between(rng, -100.0, 100.0);
    Case::new(&[x], x.exp2(), Exact::from(core_math::exp2(x.to_f64())))
}

/// A footprint whose derivatives are a thousandth to a tenth of a unit, and its longest derivative.
fn footprint<R: Real>(rng: &mut Xoshiro256PlusPlus) -> (Footprint<R>, Exact) {
    let mut derivative = || [0; 3].map(|_| signed::<R>(rng, -10.0, -3.0));
    let (dx, dy) = (derivative(), derivative());
    let length = |v: [R; 3]| {
        let square = |c: R| Exact::from(c.to_f64()) * Exact::from(c.to_f64());
        (square(v[0]) + square(v[1]) + square(v[2])).sqrt()
    };
    let (along_x, along_y) = (length(dx), length(dy));
    let longest = if along_x.high > along_y.high { along_x } else { along_y };
    let origin = [R::from_f64(0.0); 3];
    (Footprint { position: origin.into(), dpdx: dx.into(), dpdy: dy.into() }, longest)
}

fn components<R: Real>(footprint: &Footprint<R>) -> Vec<R> {
    [footprint.dpdx.into(), footprint.dpdy.into()].concat()
}

fn max_derivative<R: Real>(rng: &mut Xoshiro256PlusPlus) -> Case {
    let (footprint, longest) = footprint::<R>(rng);
    let found = Variant::Isotropic.two_scale(&footprint, R::from_f64(1.0));
    Case::new(&components(&footprint), found.max_derivative[0], longest)
}

/// Noise of 1.3 pixels.
fn noise<R: Real>() -> R {
    R::from_f64(1.3)
}

fn exact_scale<R: Real>(longest: Exact) -> Exact {
    Exact::from(1.0) / (Exact::from(noise::<R>().to_f64()) * longest)
}

fn pixel_scale<R: Real>(rng: &mut Xoshiro256PlusPlus) -> Case {
    let (footprint, longest) = footprint::<R>(rng);
    let found = Variant::Isotropic.two_scale(&footprint, noise());
    Case::new(&components(&footprint), found.pixel_scale[0], exact_scale::<R>(longest))
}

fn lerp_factor<R: Real>(rng: &mut Xoshiro256PlusPlus) -> Case {
    let (footprint, longest) = footprint::<R>(rng);
    let found = Variant::Isotropic.two_scale(&footprint, noise());
    let scale = exact_scale::<R>(longest);
    let correction = scale.low / (scale.high * core::f64::consts::LN_2);
    let logarithm = Exact::from(core_math::log2(scale.high)) + Exact::from(correction);
    // The octave that was found may be the next one where the scale lies at its border.
    let exact = logarithm - Exact::from(f64::from(found.octave[0]));
    let ulp = ulp::<R>(logarithm.high);
    Case { ulp, ..Case::new(&components(&footprint), found.lerp_factor, exact) }
}

fn corner<R: Real>(rng: &mut Xoshiro256PlusPlus) -> Case {
    let fraction = [0; 3].map(|_| unit::<R>(rng));
    let length = |v: [Exact; 3]| (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    let wide = fraction.map(|f| Exact::from(f.to_f64()));
    let (floor, ceil) = (length(wide), length(wide.map(|f| Exact::from(1.0) - f)));
    Case::new(&fraction, corner_weight(fraction), floor / (floor + ceil))
}

/// Eq. 2 on two numbers, without rounding.
fn exact_cdf(x: Exact, t: Exact) -> Exact {
    let [half, one] = [0.5, 1.0].map(Exact::from);
    let a = if t.high <= 0.5 { t } else { one - t };
    let (b, from_top) = (one - a, one - x);
    if (x - a).high < 0.0 {
        half * x * x / (a * b)
    } else if (from_top - a).high < 0.0 {
        one - half * from_top * from_top / (a * b)
    } else {
        (x - half * a) / b
    }
}

fn law<R: Real>(rng: &mut Xoshiro256PlusPlus) -> Case {
    let [x, t] = [unit::<R>(rng), unit::<R>(rng)];
    Case::new(&[x, t], cdf(x, t), exact_cdf(Exact::from(x.to_f64()), Exact::from(t.to_f64())))
}

fn literal<R: Real>(rng: &mut Xoshiro256PlusPlus) -> Case {
    let [x, t] = [unit::<R>(rng), between::<R>(rng, 1e-6, 1.0 - 1e-6)];
    Case::new(&[x, t], cdf_literal(x, t), exact_cdf(Exact::from(x.to_f64()), Exact::from(t.to_f64())))
}

fn slope<R: Real>(rng: &mut Xoshiro256PlusPlus) -> Case {
    let [x, t] = [unit::<R>(rng), unit::<R>(rng)];
    let one = Exact::from(1.0);
    let (wide_x, wide_t) = (Exact::from(x.to_f64()), Exact::from(t.to_f64()));
    let edge = if x.to_f64() <= 0.5 { wide_x } else { one - wide_x };
    let a = if t.to_f64() <= 0.5 { wide_t } else { one - wide_t };
    let exact = if (edge - a).high < 0.0 { edge / (a * (one - a)) } else { one / (one - a) };
    Case::new(&[x, t], density(x, t), exact)
}

fn inverse<R: Real>(rng: &mut Xoshiro256PlusPlus) -> Case {
    let [p, t] = [unit::<R>(rng), unit::<R>(rng)];
    let [half, one, two] = [0.5, 1.0, 2.0].map(Exact::from);
    let (wide_p, wide_t) = (Exact::from(p.to_f64()), Exact::from(t.to_f64()));
    let a = if t.to_f64() <= 0.5 { wide_t } else { one - wide_t };
    let b = one - a;
    let (corner, from_top) = (half * a / b, one - wide_p);
    let exact = if (wide_p - corner).high < 0.0 {
        (two * a * b * wide_p).sqrt()
    } else if (from_top - corner).high < 0.0 {
        one - (two * a * b * from_top).sqrt()
    } else {
        b * wide_p + half * a
    };
    Case::new(&[p, t], quantile(p, t), exact)
}

/// The distribution function of the normal law: the complementary error function at the rounded argument, and one
/// step along its slope for what the rounding took off.
fn exact_normal_cdf(z: f64) -> Exact {
    let argument = Exact::from(-z) / Exact::from(2.0).sqrt();
    let slope = -core::f64::consts::FRAC_2_SQRT_PI * core_math::exp(-argument.high * argument.high);
    Exact::from(0.5) * (Exact::from(core_math::erfc(argument.high)) + Exact::from(slope * argument.low))
}

/// The normal quantiles of the open lattice reach 5.4.
fn normal_law(rng: &mut Xoshiro256PlusPlus) -> Case {
    let z = between::<f64>(rng, -5.5, 5.5);
    Case::new(&[z], normal_cdf(z), exact_normal_cdf(z))
}

fn normal_inverse(rng: &mut Xoshiro256PlusPlus) -> Case {
    // The open lattice, on which the copula join asks.
    let k = f64::from(rng.next_u32() >> 9);
    let p = (2.0 * k + 1.0) / 16_777_216.0;
    let z = normal_quantile(p);
    // One step of Newton's method from the value itself; p - 1/2 is exact, and erf keeps its digits near 0.
    let argument = Exact::from(z) / Exact::from(2.0).sqrt();
    let slope = core_math::exp(-argument.high * argument.high);
    let residue = if p.min(1.0 - p) < 0.1 {
        let tail = exact_normal_cdf(-z.abs()) - Exact::from(p.min(1.0 - p));
        if p < 0.5 { tail } else { Exact::from(0.0) - tail }
    } else {
        let erf = Exact::from(core_math::erf(argument.high))
            + Exact::from(core::f64::consts::FRAC_2_SQRT_PI * slope * argument.low);
        Exact::from(0.5) * erf - Exact::from(p - 0.5)
    };
    let density = 0.398_942_280_401_432_7 * slope;
    Case::new(&[p], z, Exact::from(z) - Exact::from(residue.high / density))
}
