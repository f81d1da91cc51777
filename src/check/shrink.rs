//! From a footprint at which a subject fails to one of few digits at which it fails, too: what a report prints.
//!
//! Every step is tried on the subject: what is printed was run. The steps are always the same, and taken only where something
//! is rejected.

use super::subject::{Precision, Subject};
use crate::scene::Fragment;
use crate::threshold::footprint::Footprint;
use glam::{DVec2, DVec3};

/// Digits of a decimal that is tried in place of a number: one more would hardly be shorter than an `f32` in full.
const MOST_DIGITS: usize = 6;

/// Times that all numbers are gone through: what one number needs may depend on the others, and seldom twice.
const PASSES: usize = 3;

/// What a power of two costs, in digits: it is exact where a decimal of two digits is not.
const POWER_OF_TWO: usize = 2;

/// Numbers of a footprint, in a row.
const COLUMNS: usize = 9;

/// Returns numbers as simple as possible that fail together as the first ones do: zeros, powers of two and short decimals near
/// them, each rounded to a precision. Where the first ones do not fail, they are what it returns.
///
/// `fails` is asked for several candidates at once, some three hundred in all for nine numbers.
pub(crate) fn simplest(
    first: Vec<f64>,
    precision: Precision,
    fails: impl Fn(&[Vec<f64>]) -> Vec<bool>,
) -> Vec<f64> {
    let first_that_fails = |mut candidates: Vec<Vec<f64>>| {
        let place = fails(&candidates).into_iter().position(|failed| failed)?;
        Some(candidates.swap_remove(place))
    };
    if first_that_fails(vec![first.clone()]).is_none() {
        return first;
    }
    let shorter = |digits| first.iter().map(|&x| decimal(x, digits, precision)).collect();
    let mut found = first_that_fails((1..=MOST_DIGITS).map(shorter).collect()).unwrap_or(first);
    for _ in 0..PASSES {
        let before = found.clone();
        // The smallest first: of several, one of which has to stay, the largest stays.
        let mut order: Vec<usize> = (0..found.len()).collect();
        order.sort_by(|&a, &b| found[a].abs().total_cmp(&found[b].abs()));
        for at in order {
            let with = |x: f64| {
                let mut numbers = found.clone();
                numbers[at] = x;
                numbers
            };
            let candidates: Vec<Vec<f64>> = simpler(found[at], precision).into_iter().map(with).collect();
            if let Some(better) = first_that_fails(candidates) {
                found = better;
            }
        }
        if found == before {
            break;
        }
    }
    found
}

/// What is tried in place of a number: all that costs less than it does, the simplest first.
fn simpler(x: f64, precision: Precision) -> Vec<f64> {
    let mut candidates = vec![0.0];
    if x.is_finite() && x != 0.0 {
        let power = libm::exp2(libm::log2(x.abs()).round()).copysign(x);
        candidates.push(rounded(power, precision));
        for digits in 1..=MOST_DIGITS {
            let nearest = decimal(x, digits, precision);
            let last_digit = libm::pow(10.0, libm::log10(x.abs()).floor() - (digits as f64 - 1.0));
            let beyond = nearest + last_digit.copysign(x - nearest);
            candidates.extend([nearest, decimal(beyond, digits, precision)]);
        }
    }
    let most = cost(x, precision);
    candidates.retain(|&candidate| candidate.is_finite() && cost(candidate, precision) < most);
    candidates.sort_by_key(|&candidate| cost(candidate, precision));
    candidates
}

/// How hard a number is to read: its digits, fewer for powers of two, none for zero without a sign.
fn cost(x: f64, precision: Precision) -> usize {
    if x == 0.0 {
        return usize::from(x.is_sign_negative());
    }
    let text = match precision {
        Precision::F32 => format!("{:e}", x as f32),
        Precision::F64 => format!("{x:e}"),
    };
    let digits = text.split('e').next().map_or(0, |mantissa| mantissa.matches(char::is_numeric).count());
    let is_power_of_two = libm::frexp(x.abs()).0 == 0.5;
    if is_power_of_two { digits.min(POWER_OF_TWO) } else { digits }
}

/// The decimal of so many digits that is nearest to a number, in a precision.
fn decimal(x: f64, digits: usize, precision: Precision) -> f64 {
    rounded(format!("{x:.*e}", digits - 1).parse().unwrap_or(x), precision)
}

fn rounded(x: f64, precision: Precision) -> f64 {
    match precision {
        Precision::F32 => f64::from(x as f32),
        Precision::F64 => x,
    }
}

/// The numbers of a footprint, in the order of a row.
fn numbers(footprint: &Footprint<f64>) -> [f64; COLUMNS] {
    let [[px, py, pz], [dxx, dxy, dxz], [dyx, dyy, dyz]] =
        [footprint.position, footprint.dpdx, footprint.dpdy].map(|v| v.to_array());
    [px, py, pz, dxx, dxy, dxz, dyx, dyy, dyz]
}

/// The footprint of the numbers of a row.
fn of_numbers(&[px, py, pz, dxx, dxy, dxz, dyx, dyy, dyz]: &[f64; COLUMNS]) -> Footprint<f64> {
    Footprint::new([px, py, pz], [dxx, dxy, dxz], [dyx, dyy, dyz])
}

/// Whether every derivative and every axis that was not zero still is not: a degenerate footprint would be another failure.
fn is_as_regular(before: &Footprint<f64>, after: &Footprint<f64>) -> bool {
    let lost = |moved: [bool; 5], moves: [bool; 5]| moved.into_iter().zip(moves).any(|(a, b)| a && !b);
    let moves = |f: &Footprint<f64>| {
        let [x, y, z] = f.dpdx.abs().max(f.dpdy.abs()).to_array().map(|axis| axis != 0.0);
        [x, y, z, f.dpdx != DVec3::ZERO, f.dpdy != DVec3::ZERO]
    };
    !lost(moves(before), moves(after))
}

/// Shrinks fragments as long as they fail together; numbers that are the same in the first and in another stay so. None
/// becomes more degenerate than it is. What `fails` asks the subject for is no sample.
pub(crate) fn shrunk<const N: usize>(
    subject: &Subject<'_>,
    first: &[Fragment; N],
    fails: impl Fn(&[[Fragment; N]]) -> Vec<bool>,
) -> [Fragment; N] {
    subject.unnoticed(|| shrunk_in(subject.precision, first, fails))
}

fn shrunk_in<const N: usize>(
    precision: Precision,
    first: &[Fragment; N],
    fails: impl Fn(&[[Fragment; N]]) -> Vec<bool>,
) -> [Fragment; N] {
    let take_away: [fn(&mut Fragment); 8] = [
        |fragment| *fragment = fragment.footprint.into(),
        |fragment| fragment.frame = 0,
        |fragment| fragment.layer = 0,
        |fragment| fragment.lod = 0.0,
        |fragment| fragment.pixel = DVec2::ZERO,
        |fragment| fragment.texcoord = DVec2::ZERO,
        |fragment| fragment.eye = DVec3::ZERO,
        |fragment| fragment.world = DVec3::ZERO,
    ];
    let mut rest = *first;
    for take_away in take_away {
        let mut fewer = rest;
        fewer.iter_mut().for_each(take_away);
        if fewer != rest && fails(&[fewer]) == [true] {
            rest = fewer;
        }
    }
    let all: [[f64; COLUMNS]; N] = first.map(|fragment| numbers(&fragment.footprint));
    let free: Vec<(usize, usize)> = (0..N)
        .flat_map(|of| (0..COLUMNS).map(move |at| (of, at)))
        .filter(|&(of, at)| of == 0 || all[of][at].to_bits() != all[0][at].to_bits())
        .collect();
    let made = |values: &[f64]| -> [Fragment; N] {
        let mut of_the_first = [0.0; COLUMNS];
        // The numbers of the first are all free, and come first.
        of_the_first.copy_from_slice(&values[..COLUMNS]);
        let mut all = [of_the_first; N];
        for (&(of, at), &value) in free.iter().zip(values) {
            all[of][at] = value;
        }
        let mut fragments = rest;
        for (fragment, numbers) in fragments.iter_mut().zip(&all) {
            fragment.footprint = of_numbers(numbers);
        }
        fragments
    };
    let start = free.iter().map(|&(of, at)| all[of][at]).collect();
    let found = simplest(start, precision, |candidates| {
        let candidates: Vec<[Fragment; N]> = candidates.iter().map(|values| made(values)).collect();
        let keeps = |candidate: &[Fragment; N]| {
            first.iter().zip(candidate).all(|(a, b)| is_as_regular(&a.footprint, &b.footprint))
        };
        fails(&candidates).into_iter().zip(&candidates).map(|(failed, all)| failed && keeps(all)).collect()
    });
    made(&found)
}

/// Writes a fragment so that it can be tried again: a row as the command `eval` reads it, then what else of the fragment is
/// not zero.
pub(crate) fn row(fragment: &Fragment, precision: Precision) -> String {
    let list = |numbers: &[f64]| {
        let words: Vec<String> = numbers.iter().map(|&x| number(x, precision)).collect();
        words.join(",")
    };
    let &Fragment { footprint, world, eye, pixel, texcoord, lod, frame, layer } = fragment;
    let mut text = list(&numbers(&footprint));
    let counts = [f64::from(frame)].into_iter().zip(["frame"]).chain([(f64::from(layer), "layer")]);
    for (value, name) in counts.chain([(lod, "lod")]).filter(|(value, _)| *value != 0.0) {
        text.push_str(&format!(", {name} {}", list(&[value])));
    }
    let places: [(&[f64], &str); 4] = [
        (&pixel.to_array(), "pixel"),
        (&texcoord.to_array(), "texcoord"),
        (&eye.to_array(), "eye"),
        (&world.to_array(), "world"),
    ];
    for (place, name) in places.into_iter().filter(|(place, _)| place.iter().any(|&x| x != 0.0)) {
        text.push_str(&format!(", {name} ({})", list(place)));
    }
    text
}

/// Writes a number in the fewest digits that read back to the same bits of a precision.
pub(crate) fn number(x: f64, precision: Precision) -> String {
    let text = match precision {
        Precision::F32 => format!("{:?}", x as f32),
        Precision::F64 => format!("{x:?}"),
    };
    text.strip_suffix(".0").map(str::to_owned).unwrap_or(text)
}

/// Shrinks a fragment with a threshold that is bad, and writes its threshold and its row.
pub(crate) fn describe(
    subject: &Subject<'_>,
    fragment: &Fragment,
    is_bad: impl Fn(&Fragment, f64) -> bool,
) -> String {
    let [found] = shrunk(subject, &[*fragment], |candidates| {
        let candidates = candidates.as_flattened();
        candidates.iter().zip(subject.thresholds(candidates)).map(|(at, value)| is_bad(at, value)).collect()
    });
    at(subject, &found)
}

/// Shrinks two fragments whose thresholds are bad together, and writes the thresholds and rows of both.
pub(crate) fn describe_pair(
    subject: &Subject<'_>,
    pair: &[Fragment; 2],
    are_bad: impl Fn(&[Fragment; 2], [f64; 2]) -> bool,
) -> String {
    let [first, second] = shrunk(subject, pair, |candidates| {
        let values = subject.thresholds(candidates.as_flattened());
        candidates.iter().zip(values.chunks_exact(2)).map(|(pair, v)| are_bad(pair, [v[0], v[1]])).collect()
    });
    format!("{} and {}", at(subject, &first), at(subject, &second))
}

/// Writes the threshold and the row of a fragment.
pub(crate) fn at(subject: &Subject<'_>, fragment: &Fragment) -> String {
    let threshold = subject.unnoticed(|| subject.threshold(*fragment)).unwrap_or(f64::NAN);
    format!("{} at {}", number(threshold, subject.precision), row(fragment, subject.precision))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::threshold::two_scale::Variant;
    use core::cell::Cell;

    #[test]
    fn numbers_become_as_simple_as_their_failure_allows() {
        let simplest_of = |first: [f64; 2], precision, fails: fn(&[f64]) -> bool| {
            simplest(first.to_vec(), precision, |all| all.iter().map(|n| fails(n)).collect())
        };
        let precision = Precision::F32;
        assert_eq!(simplest_of([31.417_f32.into(), -7.23], precision, |n| n[0] > 30.0), [40.0, 0.0]);
        assert_eq!(simplest_of([0.77, 1.9], precision, |n| n[0] + n[1] > 2.6), [0.8_f32.into(), 2.0]);
        // A power of two that no decimal of few digits is.
        assert_eq!(simplest_of([0.03125, 3.0], precision, |n| n[0] == 0.03125), [0.03125, 0.0]);
        let third = f64::from(1.0_f32 / 3.0);
        assert_eq!(simplest_of([third, 1.0], precision, |n| n[0] == f64::from(1.0_f32 / 3.0)), [third, 0.0]);
        // What does not fail is left as it is.
        assert_eq!(simplest_of([0.123, 4.56], precision, |_| false), [0.123, 4.56]);
    }

    #[test]
    fn few_are_asked_and_always_the_same() {
        let first: Vec<f64> = (1..=9_u8).map(|i| f64::from(1.0 / f32::from(i))).collect();
        let asked = Cell::new(0);
        let found = || {
            asked.set(0);
            simplest(first.clone(), Precision::F32, |all| {
                asked.set(asked.get() + all.len());
                all.iter().map(|n| n.iter().sum::<f64>() > 2.8).collect()
            })
        };
        assert_eq!(found(), found());
        assert!(asked.get() < 500, "{}", asked.get());
    }

    #[test]
    fn only_what_matters_of_a_fragment_is_told() {
        let subject =
            Subject::of_fragments("s", Precision::F32, Variant::Isotropic, |fragment: &Fragment| {
                let far = fragment.footprint.position.x > 30.0;
                if far && fragment.frame > 2 { f64::NAN } else { 0.5 }
            });
        let footprint = Footprint::new([31.3, 0.7, 0.1], [0.0121, 0.0003, 0.0], [0.0002, 0.0094, 0.0]);
        let fragment =
            Fragment { frame: 3, layer: 1, lod: 0.3, ..subject.precision.round(&footprint).into() };
        let seen = describe(&subject, &fragment, |_, value| value.is_nan());
        assert_eq!(seen, "NaN at 40,0,0,0.01,0,0,0,0.009,0, frame 3");
    }
}
