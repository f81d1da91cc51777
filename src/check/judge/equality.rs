//! Thresholds that should be equal, bit for bit.

use crate::check::Trial;
use crate::check::trial::describe;
use crate::scene::Fragment;

/// Whether two answers are one: the same bits, or refused twice.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// A trial of points whose thresholds should be those that they had at first; `when` says what has changed since.
pub(crate) fn equality(points: &[Fragment], first: &[f64], others: &[Vec<f64>], when: &str) -> Trial {
    let changed = |at: usize| {
        let other = others.iter().map(|values| values[at]).find(|&value| !same(first[at], value))?;
        Some((at, other))
    };
    let found: Vec<(usize, f64)> = (0..points.len()).filter_map(changed).collect();
    let example = found.first().map_or_else(String::new, |&(at, value)| {
        format!("{value:?}, at first {}", describe(&points[at].footprint, first[at]))
    });
    let (different, n) = (found.len() as u64, points.len() as u64);
    let share = 100.0 * (different as f64 / n as f64);
    let seen = format!("{share:.2} % of points have another threshold {when}; first {example}");
    Trial::counted(different, n, "points with two thresholds", "share of points", seen)
}
