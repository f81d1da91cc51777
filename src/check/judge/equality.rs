//! Thresholds that should be equal, bit for bit.

use crate::check::Trial;
use crate::check::trial::describe;
use crate::scene::Fragment;

/// Whether two answers are one: the same bits, or refused twice.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// What is told of thresholds that should be equal: how many of `n` points have one that is not, and the first of them.
pub(crate) fn equality(n: usize, different: usize, first: Option<String>, when: &str) -> Trial {
    let seen = format!(
        "{:.2} % of points have another threshold {when}; first {}",
        100.0 * (different as f64 / n as f64),
        first.unwrap_or_default()
    );
    Trial::counted(different as u64, n as u64, "points with two thresholds", "share of points", seen)
}

/// Counts the points whose thresholds are not equal to the first, and describes the first of them.
pub(crate) fn differing(points: &[Fragment], first: &[f64], others: &[Vec<f64>]) -> (usize, Option<String>) {
    let found: Vec<(usize, f64)> = (0..points.len())
        .filter_map(|at| Some((at, others.iter().map(|values| values[at]).find(|&v| !same(first[at], v))?)))
        .collect();
    let told = found
        .first()
        .map(|&(at, value)| format!("{value:?}, at first {}", describe(&points[at].footprint, first[at])));
    (found.len(), told)
}
