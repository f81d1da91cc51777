//! The threshold is a function: of the fragment alone, and of its derivatives without order or sign.

use crate::check::input::fragments_everywhere;
use crate::check::judge::equality;
use crate::check::{Attempt, Claim, Draw, Promise, Subject, Trial, Verdict};
use crate::scene::Fragment;
use crate::threshold::footprint::Footprint;

/// Points that are evaluated one by one.
const ALONE: usize = 64;

/// Fragments of a second pass that are evaluated together: neither a power of two nor a row of the first.
const PIECE: usize = 37;

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

fn two_passes(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let points = fragments_everywhere(subject, draw, TWO_PASSES.id);
    let both_ways = |points: &[Fragment]| {
        let backwards: Vec<Fragment> = points.iter().rev().copied().collect();
        let mut reversed = subject.thresholds(&backwards);
        reversed.reverse();
        [subject.thresholds(points), reversed]
    };
    let [once, reversed] = both_ways(&points);
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
    let asked = [once, reversed, in_pieces, alone];
    // A pass among other fragments cannot be repeated for a fragment of fewer digits; in another order it can.
    let again = |_: usize, points: &[Fragment]| both_ways(points).to_vec();
    Ok(equality(subject, &points, &asked, again, "in a second pass"))
}

fn derivatives(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let points = fragments_everywhere(subject, draw, DERIVATIVES.id);
    const CHANGES: [fn(Footprint<f64>) -> Footprint<f64>; 4] = [
        |f| f,
        |f| Footprint { dpdx: f.dpdy, dpdy: f.dpdx, ..f },
        |f| Footprint { dpdx: -f.dpdx, ..f },
        |f| Footprint { dpdy: -f.dpdy, ..f },
    ];
    let asked = |points: &[Fragment]| {
        let with = |change: fn(Footprint<f64>) -> Footprint<f64>| {
            let changed = |point: &Fragment| Fragment { footprint: change(point.footprint), ..*point };
            subject.thresholds(&points.iter().map(changed).collect::<Vec<_>>())
        };
        CHANGES.map(with).to_vec()
    };
    let when = "with its derivatives exchanged or turned around";
    Ok(equality(subject, &points, &asked(&points), |_, points| asked(points), when))
}
