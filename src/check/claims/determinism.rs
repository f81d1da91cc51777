//! The threshold is a function: of the fragment alone, and of its derivatives without order or sign.

use super::range::describe;
use super::{Attempt, Claim, Conclusion, Promise, Trial, detectable_share};
use crate::check::sample::{placement, sighting};
use crate::check::tolerance::{ALONE, EXACT_POINTS, PIECE};
use crate::check::{Draw, Evidence, Subject, Verdict};
use crate::scene::{Fragment, Scene};
use crate::threshold::footprint::Footprint;

/// A depth pass and the colour pass after it decide alike.
pub const TWO_PASSES: Claim = Claim {
    id: "determinism.two_passes",
    anchor: "§5 (a hash gives the same value again), GDC 2017 (Why Hashing?)",
    statement: "a fragment has the same threshold, bit for bit, in a second pass: in another order, among other \
                fragments, and alone",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(8.0e-3)),
    run: two_passes,
};

/// Turned by a quarter, or seen in a mirror, the derivatives say the same.
pub const DERIVATIVES: Claim = Claim {
    id: "symmetry.derivatives",
    anchor: "§5.4, §6.2, Listings 1 and 2 (the larger of the two derivatives)",
    statement: "exchanging the two screen derivatives or turning a sign in front of one changes no bit of the threshold",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(8.0e-3)),
    run: derivatives,
};

/// Fragments of all scenes, in no order.
pub(super) fn fragments(subject: &Subject<'_>, draw: &Draw, claim: &str) -> Vec<Fragment> {
    let mut rng = draw.rng(claim);
    let scenes = Scene::all();
    let count = draw.samples(EXACT_POINTS);
    (0..count)
        .map(|index| {
            let place = placement(&mut rng);
            sighting(&scenes[index % scenes.len()], &mut rng).placed(place, subject.precision).fragment
        })
        .collect()
}

/// Whether two answers are one: the same bits, or refused twice.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// What is told of thresholds that should be equal: how many of `n` points have one that is not, and the first of them.
pub(super) fn trial(n: usize, different: usize, first: Option<String>, when: &str) -> Trial {
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
pub(super) fn differing(points: &[Fragment], first: &[f64], others: &[Vec<f64>]) -> (usize, Option<String>) {
    let found: Vec<(usize, f64)> = (0..points.len())
        .filter_map(|at| Some((at, others.iter().map(|values| values[at]).find(|&v| !same(first[at], v))?)))
        .collect();
    let told = found
        .first()
        .map(|&(at, value)| format!("{value:?}, at first {}", describe(&points[at].footprint, first[at])));
    (found.len(), told)
}

fn two_passes(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let points = fragments(subject, draw, TWO_PASSES.id);
    let once = subject.thresholds(&points);
    let backwards: Vec<Fragment> = points.iter().rev().copied().collect();
    let mut reversed = subject.thresholds(&backwards);
    reversed.reverse();
    // Every other fragment is another's neighbour now, and those between are evaluated later, in small pieces.
    let mut in_pieces = vec![f64::NAN; points.len()];
    for parity in 0..2 {
        let places: Vec<usize> = (parity..points.len()).step_by(2).collect();
        for piece in places.chunks(PIECE) {
            let fragments: Vec<Fragment> = piece.iter().map(|&at| points[at]).collect();
            for (&at, value) in piece.iter().zip(subject.thresholds(&fragments)) {
                in_pieces[at] = value;
            }
        }
    }
    let mut alone = once.clone();
    for (value, point) in alone.iter_mut().zip(&points).take(ALONE) {
        *value = subject.threshold(*point).unwrap_or(f64::NAN);
    }
    let (different, first) = differing(&points, &once, &[reversed, in_pieces, alone]);
    Ok(trial(points.len(), different, first, "in a second pass"))
}

fn derivatives(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let points = fragments(subject, draw, DERIVATIVES.id);
    let with = |change: fn(Footprint<f64>) -> Footprint<f64>| {
        let changed = |point: &Fragment| Fragment { footprint: change(point.footprint), ..*point };
        subject.thresholds(&points.iter().map(changed).collect::<Vec<_>>())
    };
    let others = [
        with(|f| Footprint { dpdx: f.dpdy, dpdy: f.dpdx, ..f }),
        with(|f| Footprint { dpdx: -f.dpdx, ..f }),
        with(|f| Footprint { dpdy: -f.dpdy, ..f }),
    ];
    let (different, first) = differing(&points, &subject.thresholds(&points), &others);
    Ok(trial(points.len(), different, first, "with its derivatives exchanged or turned around"))
}
