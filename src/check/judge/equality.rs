//! Thresholds that should be equal, bit for bit.

use crate::check::Evidence;
use crate::check::trial::{Conclusion, Trial, describe, detectable_share};
use crate::scene::Fragment;

/// Whether two answers are one: the same bits, or refused twice.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// What is told of thresholds that should be equal: how many of `n` points have one that is not, and the first of them.
pub(crate) fn equality(n: usize, different: usize, first: Option<String>, when: &str) -> Trial {
    let share = different as f64 / n as f64;
    Trial {
        conclusion: Conclusion::Exact { holds: different == 0 },
        statistic: Some(different as f64),
        statistic_name: "points with two thresholds".into(),
        n: n as u64,
        effect: Some(share),
        effect_name: "share of points",
        detectable: Some(detectable_share(n as f64)),
        seen: format!(
            "{:.2} % of points have another threshold {when}; first {}",
            100.0 * share,
            first.unwrap_or_default()
        ),
        evidence: Evidence::None,
    }
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
