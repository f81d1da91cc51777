//! What claims look at: the inputs of each claim are recorded, and the places, frames, octaves and lags that it is about are
//! among them. A list that is cut short by mistake still passes on every sound threshold.

use hashed_alpha::check::specimen::ideal;
use hashed_alpha::check::{Budget, Conclusion, Draw, Precision, Subject, Verdict, claims};
use hashed_alpha::scene::Fragment;
use hashed_alpha::threshold::robust::Join;
use hashed_alpha::threshold::two_scale::Variant;
use std::collections::BTreeSet;
use std::sync::{Arc, Mutex};

/// Pixels of a claim that looks at a handful of points, each followed through thousands of views.
const FEWEST_PIXELS: usize = 10;

/// Tries a claim on a sound threshold and returns everything that it asked, in order.
fn asked(claim: &str) -> Vec<Fragment> {
    let sound = ideal(11, Variant::Isotropic, Precision::F64, Join::Copula);
    let (nested_phase, join) = (sound.nested_phase, sound.join);
    let record: Arc<Mutex<Vec<Fragment>>> = Arc::default();
    let recorded = record.clone();
    let mut subject = Subject::batched("recorded", sound.precision, sound.variant, move |fragments| {
        recorded.lock().expect("no test panics in here").extend_from_slice(fragments);
        Ok(sound.thresholds(fragments))
    });
    (subject.nested_phase, subject.join) = (nested_phase, join);
    let claim = claims::ALL.iter().find(|known| known.id == claim).expect("a claim of that name");
    let trial = (claim.run)(&subject, &Draw { budget: Budget::Quick, ..Draw::seeded(4) });
    let conclusion = trial.unwrap_or_else(|ended| *ended).conclusion;
    assert!(!matches!(conclusion, Conclusion::Inconclusive | Conclusion::Unavailable), "{}", claim.id);
    drop(subject);
    record.lock().expect("no test panics in here").clone()
}

/// The logarithm of the cells per unit along the longer derivative.
fn log_scale(at: &Fragment) -> f64 {
    -libm::log2(at.footprint.dpdx.length().max(at.footprint.dpdy.length()))
}

fn whole(numbers: impl IntoIterator<Item = f64>) -> BTreeSet<i64> {
    numbers.into_iter().map(|x| x.round() as i64).collect()
}

#[test]
fn no_claim_looks_at_one_pixel_only() {
    for claim in claims::ALL.iter().filter(|claim| claim.expected == Verdict::Consistent) {
        let fragments = asked(claim.id);
        let pixels: BTreeSet<[u64; 2]> =
            fragments.iter().map(|at| at.pixel.to_array().map(f64::to_bits)).collect();
        let is_silent = fragments.is_empty();
        assert!(is_silent || pixels.len() >= FEWEST_PIXELS, "{}: {} pixels", claim.id, pixels.len());
    }
}

#[test]
fn static_thresholds_are_asked_in_every_frame_of_the_list() {
    let frames: BTreeSet<u32> = asked("frames.static").iter().map(|at| at.frame).collect();
    // Those of the list, the first 64, and nearly as many at random.
    assert!(frames.is_superset(&BTreeSet::from([1024, u32::MAX])) && frames.is_superset(&(0..64).collect()));
    assert!(frames.len() >= 100, "{}", frames.len());
    let frames: BTreeSet<u32> = asked("frames.serial").iter().map(|at| at.frame).collect();
    assert_eq!(frames, BTreeSet::from([0, 1, 2, 5, 16]));
}

#[test]
fn degenerate_footprints_are_a_table() {
    let fragments = asked("range.degenerate");
    assert_eq!(fragments.len(), 16 * 20);
    // Each of nine components is NaN alone, and all are together.
    let numbers = |at: &Fragment| {
        [at.footprint.position, at.footprint.dpdx, at.footprint.dpdy].map(|v| v.to_array()).concat()
    };
    let bad: BTreeSet<Vec<bool>> =
        fragments.iter().map(|at| numbers(at).iter().map(|x| x.is_nan()).collect()).collect();
    for alone in 0..9 {
        assert!(bad.contains(&(0..9).map(|at| at == alone).collect::<Vec<bool>>()), "{alone}");
    }
    assert!(bad.contains(&vec![true; 9]));
}

#[test]
fn octaves_are_those_of_the_statement() {
    let octaves = whole(asked("continuity.octave_boundary").iter().map(log_scale));
    assert_eq!(octaves, (-2..=6).collect());
    let octaves = whole(asked("cells.origin").iter().map(log_scale));
    assert_eq!(octaves, (-32..32).collect());
}

#[test]
fn cells_are_followed_at_all_but_every_lerp_factor() {
    let fractions: Vec<f64> =
        asked("exact.cells").iter().map(log_scale).map(|scale| scale - scale.floor()).collect();
    let [low, high] = [f64::min, f64::max].map(|of| fractions.iter().copied().fold(0.5, of));
    assert!(low < 0.02 && high > 0.98, "{low} {high}");
}

#[test]
fn windows_reach_as_far_as_floats_have_neighbours() {
    let fragments = asked("cells.window");
    let offset = |x: f64| [0.0, 4096.0, 65_536.0, 1_048_576.0, 8_388_608.0].iter().rposition(|&o| x >= o);
    let along = |axis: usize| -> BTreeSet<Option<usize>> {
        fragments.iter().map(|at| offset(at.footprint.position[axis])).collect()
    };
    for axis in 0..3 {
        assert_eq!(along(axis), (0..5).map(Some).collect(), "{axis}");
    }
}

#[test]
fn relations_are_tried_at_every_lag() {
    let steps = |claim: &str| -> BTreeSet<[i64; 3]> {
        let fragments = asked(claim);
        let step = |pair: &[Fragment]| {
            let [a, b] = [0, 1].map(|at| pair[at].footprint.position);
            (b - a).to_array().map(|x| x.round() as i64)
        };
        fragments.chunks_exact(2).map(step).collect()
    };
    let lags = [[355, 0, 0], [710, 0, 0], [3726, -232, 0], [3460, -785, 0], [2750, -785, 0]];
    assert_eq!(steps("hash.resonance"), BTreeSet::from(lags));
    let unit = BTreeSet::from([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]);
    assert_eq!(steps("hash.differences"), unit);
    // A cell of side 1 holds the corners of eight cells of half the side.
    let children: BTreeSet<[i64; 3]> = asked("hash.children")
        .chunks_exact(2)
        .map(|pair| {
            let [parent, child] = [0, 1].map(|at| pair[at].footprint.position);
            let corner = child - 0.125 - (parent - 0.25);
            (corner * 2.0).to_array().map(|x| x.round() as i64)
        })
        .collect();
    assert_eq!(children.len(), 8, "{children:?}");
}

#[test]
fn planes_lie_where_models_have_them() {
    for (claim, offsets) in
        [("planes.axis_aligned", &[0.0, 0.1, 0.3][..]), ("planes.dyadic", &[0.5, 1.0, 2.0, 3.0])]
    {
        let fragments = asked(claim);
        for axis in [1, 2] {
            for &offset in offsets {
                let on = fragments.iter().filter(|at| (at.footprint.position[axis] - offset).abs() < 1.0e-5);
                assert!(on.count() > 1000, "{claim}: axis {axis} at {offset}");
            }
        }
    }
}
