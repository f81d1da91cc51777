//! Thresholds that should be equal, bit for bit.

use crate::check::shrink::{number, row, shrunk};
use crate::check::{Subject, Trial};
use crate::scene::Fragment;

/// Whether two answers are one: the same bits, or refused twice.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// The first answer to a point that is not the one of the first time.
fn changed(at: usize, asked: &[Vec<f64>]) -> Option<f64> {
    let (first, others) = asked.split_first()?;
    others.iter().map(|values| values[at]).find(|&value| !same(first[at], value))
}

/// A trial of points whose thresholds should be those that they had when they were asked for the first time; `when` says what
/// has changed since.
///
/// `asked` are the thresholds of every time; `again` asks, in the same ways, for points that are like the one of an index.
pub(crate) fn equality(
    subject: &Subject<'_>,
    points: &[Fragment],
    asked: &[Vec<f64>],
    again: impl Fn(usize, &[Fragment]) -> Vec<Vec<f64>>,
    when: &str,
) -> Trial {
    let found: Vec<usize> = (0..points.len()).filter(|&at| changed(at, asked).is_some()).collect();
    let example = found.first().map_or_else(String::new, |&first| {
        let [shown] = shrunk(subject, &[points[first]], |candidates| {
            let candidates = candidates.as_flattened();
            let asked = again(first, candidates);
            (0..candidates.len()).map(|at| changed(at, &asked).is_some()).collect()
        });
        let asked = subject.unnoticed(|| again(first, &[shown]));
        let (old, new) = (asked[0][0], changed(0, &asked).unwrap_or(asked[0][0]));
        let [old, new] = [old, new].map(|value| number(value, subject.precision));
        format!("{old} at {}, and then {new}", row(&shown, subject.precision))
    });
    let (different, n) = (found.len() as u64, points.len() as u64);
    let share = 100.0 * (different as f64 / n as f64);
    let seen = format!("{share:.2} % of points have another threshold {when}; as in {example}");
    Trial::counted(different, n, "points with two thresholds", "share of points", seen)
}
