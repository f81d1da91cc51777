//! Statements about every number: functions of one `f32` over their whole domain, the CDF at every junction, every
//! exponent. `HASHED_ALPHA_BUDGET` says how many of them are looked at (see `budget`).

use crate::budget::{Budget, budget};
use hashed_alpha::threshold::batch::Isa;
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::emulated::{Arithmetic, Emulated, Half};
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::open_lattice;
use hashed_alpha::threshold::real::{Real, SIN_F32_DOMAIN, exp2_f32, log2_f32, sin_f32};
use hashed_alpha::threshold::robust::{Repairs, scales::robust_scales};
use hashed_alpha::threshold::two_scale::Variant;
use rayon::prelude::*;
use std::ops::RangeInclusive;

/// A sign bit, to be added to the bits of a magnitude.
const MINUS: u32 = 1 << 31;
const INFINITY: u32 = 0x7f80_0000;

/// Runs `visit` over every `stride`-th number of a range on all cores; adds the counts.
fn over(range: RangeInclusive<u32>, stride: u32, visit: impl Fn(u32) -> u64 + Sync) -> u64 {
    /// Large enough that the cost of a task does not count.
    const TASK: u64 = 1 << 20;
    let (first, last) = (u64::from(*range.start()), u64::from(*range.end()));
    let steps = (last - first) / u64::from(stride) + 1;
    (0..steps.div_ceil(TASK))
        .into_par_iter()
        .map(|task| {
            let steps = task * TASK..steps.min((task + 1) * TASK);
            steps.map(|step| visit((first + step * u64::from(stride)) as u32)).sum::<u64>()
        })
        .sum()
}

/// Asserts that a function gives the correctly rounded value at every `stride`-th argument of a range of bits.
fn is_correctly_rounded(
    name: &str,
    range: RangeInclusive<u32>,
    stride: u32,
    ours: impl Fn(f32) -> f32 + Sync,
    correct: impl Fn(f32) -> f32 + Sync,
) {
    let differs = |bits: u32| {
        let (value, expected) = (ours(f32::from_bits(bits)), correct(f32::from_bits(bits)));
        value.to_bits() != expected.to_bits() && !(value.is_nan() && expected.is_nan())
    };
    let wrong = over(range.clone(), stride, |bits| u64::from(differs(bits)));
    if wrong > 0 {
        let distance = |bits: &u32| {
            let x = f32::from_bits(*bits);
            i64::from(ours(x).to_bits()).abs_diff(i64::from(correct(x).to_bits()))
        };
        let worst = range.step_by(stride as usize).filter(|bits| differs(*bits)).max_by_key(distance);
        let x = f32::from_bits(worst.expect("there is one"));
        panic!(
            "{name}: {wrong} values are not correctly rounded, worst at {x:e} (0x{:08x}): 0x{:08x}, not 0x{:08x}",
            x.to_bits(),
            ours(x).to_bits(),
            correct(x).to_bits()
        );
    }
}

/// A function over slices, and the instruction set that it is compiled for.
type OverSlices = fn(Isa, &[f32], &mut [f32]);

/// Asserts that a function over slices gives the correctly rounded value at every `stride`-th argument of a range of
/// bits, on every instruction set of the machine.
///
/// The sets take turns at the same arguments, so that each correct value is computed once.
fn is_correctly_rounded_on_every_isa(
    name: &str,
    range: RangeInclusive<u32>,
    stride: u32,
    ours: OverSlices,
    correct: fn(f32) -> f32,
) {
    const TASK: u64 = 1 << 14;
    let (first, last) = (u64::from(*range.start()), u64::from(*range.end()));
    let steps = (last - first) / u64::from(stride) + 1;
    let isas: Vec<Isa> = Isa::available().collect();
    let wrong = (0..steps.div_ceil(TASK)).into_par_iter().find_map_first(|task| {
        let steps = task * TASK..steps.min((task + 1) * TASK);
        let arguments: Vec<f32> =
            steps.map(|step| f32::from_bits((first + step * u64::from(stride)) as u32)).collect();
        let expected: Vec<f32> = arguments.iter().map(|&x| correct(x)).collect();
        let mut values = vec![0.0; arguments.len()];
        isas.iter().find_map(|&isa| {
            ours(isa, &arguments, &mut values);
            let differs = |i: &usize| {
                values[*i].to_bits() != expected[*i].to_bits()
                    && !(values[*i].is_nan() && expected[*i].is_nan())
            };
            let at = (0..values.len()).find(differs)?;
            Some(format!("{name} on {isa} at {:e}: {:e}, not {:e}", arguments[at], values[at], expected[at]))
        })
    });
    assert_eq!(wrong, None);
}

/// How many of the scalar values are looked at: the portable loop compiles the same body and runs over all of them.
fn scalar_stride() -> u32 {
    budget().pick(1009, 61, 1)
}

/// Up to here, 2^-12, the correctly rounded sine of a number is the number: it lies less than 2^-26.5 of it towards zero,
/// and half the way to the next number is 2^-25 of it at least.
const OWN_SINE: f32 = 1.0 / 4096.0;

fn correct_sine(x: f32) -> f32 {
    if x.abs() <= OWN_SINE { x } else { core_math::sinf(x) }
}

#[test]
fn small_numbers_are_their_own_sine() {
    let range = 0..=OWN_SINE.to_bits();
    is_correctly_rounded("x", range, budget().pick(100_003, 1009, 1), |x| x, core_math::sinf);
    assert_ne!(core_math::sinf(2.0 * OWN_SINE), 2.0 * OWN_SINE);
}

#[test]
fn the_sine_is_correctly_rounded_up_to_its_domain() {
    let largest = SIN_F32_DOMAIN.to_bits();
    for sign in [0, MINUS] {
        let range = sign..=sign + largest;
        is_correctly_rounded("sin_f32", range.clone(), scalar_stride(), sin_f32, correct_sine);
        is_correctly_rounded_on_every_isa("sin", range, budget().pick(1009, 1, 1), Isa::sin, correct_sine);
    }
}

#[test]
fn the_logarithm_is_correctly_rounded_everywhere() {
    let stride = budget().pick(1009, 1, 1);
    is_correctly_rounded("log2_f32", 0..=INFINITY, scalar_stride(), log2_f32, core_math::log2f);
    is_correctly_rounded_on_every_isa("log2", 0..=INFINITY, stride, Isa::log2, core_math::log2f);
    let negative = MINUS..=MINUS + INFINITY;
    is_correctly_rounded("log2_f32", negative.clone(), 9973, log2_f32, core_math::log2f);
    is_correctly_rounded_on_every_isa("log2", negative, 9973, Isa::log2, core_math::log2f);
}

#[test]
fn beyond_the_domain_the_sine_of_slices_is_the_scalar_one() {
    let beyond = SIN_F32_DOMAIN.to_bits() + 1..=u32::MAX >> 1;
    for sign in [0, MINUS] {
        let range = sign + *beyond.start()..=sign + *beyond.end();
        is_correctly_rounded_on_every_isa("sin", range, budget().pick(10_007, 1009, 101), Isa::sin, sin_f32);
    }
}

#[test]
#[should_panic(expected = "on portable at")]
fn one_wrong_value_in_a_million_is_found() {
    let wrong: OverSlices = |isa, x, out| {
        isa.log2(x, out);
        let at = x.iter().position(|x| x.to_bits() == 0x3f12_3456);
        at.into_iter().for_each(|i| out[i] = f32::from_bits(out[i].to_bits() + 1));
    };
    is_correctly_rounded_on_every_isa("log2", 0x3f10_0000..=0x3f20_0000, 1, wrong, core_math::log2f);
}

#[test]
fn the_power_is_correctly_rounded_everywhere() {
    // Below 2^-26 the power is 1, from 150 on it is 0 or infinite: few of those are looked at but at night.
    let [first, last] = [1.0_f32 / 67_108_864.0, 150.0].map(f32::to_bits);
    let (stride, elsewhere) = (budget().pick(1009, 1, 1), budget().pick(1009, 101, 1));
    for sign in [0, MINUS] {
        for (range, stride) in [(0..=first, elsewhere), (first..=last, stride), (last..=INFINITY, elsewhere)]
        {
            let range = sign + range.start()..=sign + range.end();
            is_correctly_rounded("exp2_f32", range, stride, exp2_f32, core_math::exp2f);
        }
    }
    // The two arguments at which a double-precision power rounds to the wrong side.
    for bits in [0x3b42_9d37, 0xbcf3_a937] {
        is_correctly_rounded("exp2_f32", bits..=bits, 1, exp2_f32, core_math::exp2f);
    }
}

/// What a form of the CDF does wrong around both of its junctions, for one weight.
fn faults_at_junctions(form: CdfForm, a: f32) -> Faults {
    let value = |x: f32| form.cdf(x, a);
    let step = |x: f32, by: i32| f32::from_bits(x.to_bits().saturating_add_signed(by).min(1.0_f32.to_bits()));
    let rising = |x: f32| {
        let around = [-2, -1, 0, 1, 2].map(|by| value(step(x, by)));
        !around.windows(2).any(|pair| pair[1] < pair[0])
    };
    let upper = 1.0 - a;
    let number = [a, upper].iter().all(|&x| (0.0..=1.0).contains(&value(x)));
    let ends = value(0.0) == 0.0 && value(1.0) == 1.0;
    Faults { backstep: !(rising(a) && rising(upper)), out_of_range: !number, ends: !ends }
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Faults {
    backstep: bool,
    /// NaN is out of range, too.
    out_of_range: bool,
    ends: bool,
}

const NO_FAULTS: Faults = Faults { backstep: false, out_of_range: false, ends: false };

/// Every `f32` in [0, 1/2]: 1 056 964 609 of them.
const WEIGHTS: RangeInclusive<u32> = 0..=0x3f00_0000;

/// Weights at which the literal form steps back; a random sample of a million does not find one in the range that a
/// logarithm can give.
fn pinned_weights() -> [f32; 2] {
    [0.5 - libm::exp2(-25.0) as f32, (1.4 * libm::exp2(-70.0)) as f32]
}

#[test]
fn the_stable_cdf_rises_through_every_junction() {
    assert_eq!(WEIGHTS.clone().count(), 1_056_964_609);
    let stride = budget().pick(10_007, 101, 1);
    let faults = over(WEIGHTS, stride, |a| {
        u64::from(faults_at_junctions(CdfForm::Stable, f32::from_bits(a)) != NO_FAULTS)
    });
    assert_eq!(faults, 0);
    let edges = [0.0, f32::from_bits(1), f32::MIN_POSITIVE, 0.25, 0.5];
    for a in pinned_weights().into_iter().chain(edges) {
        assert_eq!(faults_at_junctions(CdfForm::Stable, a), NO_FAULTS, "{a:e}");
    }
}

#[test]
fn the_literal_cdf_steps_back_where_it_is_pinned() {
    for a in pinned_weights() {
        assert!(faults_at_junctions(CdfForm::Literal, a).backstep, "{a:e}");
    }
    assert!(faults_at_junctions(CdfForm::Literal, 0.0).ends);
}

/// How many weights, by exhaustion, let the literal form step back; all but one lie below 2^-63.
const LITERAL_BACKSTEPS: u64 = 44_870_611;

#[test]
fn the_literal_cdf_steps_back_for_one_weight_that_a_logarithm_gives() {
    let backsteps = |range, stride| {
        over(range, stride, |a| u64::from(faults_at_junctions(CdfForm::Literal, f32::from_bits(a)).backstep))
    };
    let [near_half, _] = pinned_weights().map(f32::to_bits);
    let normal = (libm::exp2(-63.0) as f32).to_bits()..=near_half - 1;
    assert_eq!(backsteps(normal, budget().pick(10_007, 211, 1)), 0);
    assert_eq!(backsteps(near_half..=*WEIGHTS.end(), 1), 1);
    if budget() == Budget::Nightly {
        assert_eq!(backsteps(WEIGHTS, 1), LITERAL_BACKSTEPS);
    }
}

/// Every number in [0, 1] of half precision.
fn halves() -> impl Iterator<Item = Emulated<Half>> {
    (0..=half::f16::ONE.to_bits()).map(|bits| Emulated::from_f64(half::f16::from_bits(bits).to_f64()))
}

/// Evaluates a form of the CDF for every `x` of half precision at every `stride`-th weight; counts backsteps and NaN.
fn half_faults(form: CdfForm, stride: usize) -> [usize; 2] {
    let weights: Vec<_> = halves().step_by(stride).collect();
    let at_weight = |weight: &Emulated<Half>| {
        let values: Vec<_> = halves().map(|x| form.cdf(x, *weight)).collect();
        let backsteps = values.windows(2).filter(|pair| pair[1] < pair[0]).count();
        [backsteps, values.iter().filter(|value| value.is_nan()).count()]
    };
    weights.par_iter().map(at_weight).reduce(|| [0; 2], |a, b| [a[0] + b[0], a[1] + b[1]])
}

#[test]
fn half_precision_leaves_the_stable_cdf_whole_and_not_the_literal_one() {
    assert_eq!(half_faults(CdfForm::Stable, budget().pick(64, 1, 1)), [0, 0]);
    match budget() {
        Budget::Quick => assert_ne!(half_faults(CdfForm::Literal, 64)[0], 0),
        _ => assert_eq!(half_faults(CdfForm::Literal, 1), [2276, 2]),
    }
}

#[test]
fn emulated_half_precision_rounds_as_ieee_binary16() {
    let differs = |bits: u32| {
        let x = f32::from_bits(bits);
        let (ours, theirs) = (Half::round(f64::from(x)), half::f16::from_f32(x).to_f32());
        u64::from(ours.to_bits() != theirs.to_bits() && !(ours.is_nan() && theirs.is_nan()))
    };
    assert_eq!(over(0..=u32::MAX, budget().pick(10_007, 101, 1), differs), 0);
}

#[test]
fn the_open_lattice_is_symmetric_exact_and_never_repeats() {
    const VALUES: u32 = 1 << 23;
    let mut last = 0.0;
    for k in 0..VALUES {
        let word = k << 9 | k & 511;
        let value = open_lattice::<f64>(word);
        assert!(last < value && value < 1.0, "{word:08x}");
        assert_eq!(value + open_lattice::<f64>(!word), 1.0, "{word:08x}");
        assert_eq!(f64::from(open_lattice::<f32>(word)), value, "{word:08x}");
        last = value;
    }
}

/// Asserts that pixels of 2^-octave units have that octave and lie at its very beginning.
fn powers_of_two_begin_an_octave<R: Real>(octaves: RangeInclusive<i32>) {
    let [zero, one] = [0.0, 1.0].map(R::from_f64);
    for octave in octaves {
        let power = R::from_f64(libm::exp2(f64::from(octave)));
        assert_eq!(power.log2(), R::from_f64(f64::from(octave)), "{} 2^{octave}", R::NAME);
        assert_eq!(R::from_f64(f64::from(octave)).exp2(), power, "{} 2^{octave}", R::NAME);
        let side = one / power;
        let footprint = Footprint::<R> {
            position: [zero; 3].into(),
            dpdx: [side, zero, zero].into(),
            dpdy: [zero, side, zero].into(),
        };
        let found = robust_scales(Variant::Isotropic, &footprint, one, Repairs::ALL);
        assert_eq!(found.octave, [octave; 3], "{} 2^{octave}", R::NAME);
        assert_eq!(found.next_octave, [octave + 1; 3]);
        assert_eq!(found.fraction, [zero; 3], "{} 2^{octave}", R::NAME);
    }
}

#[test]
fn every_power_of_two_begins_its_octave() {
    powers_of_two_begin_an_octave::<f32>(-100..=100);
    powers_of_two_begin_an_octave::<f64>(-805..=805);
    powers_of_two_begin_an_octave::<Emulated<Half>>(-11..=11);
}
