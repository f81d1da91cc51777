//! The range of the threshold, on every surface, with derivatives as they are and as a GPU takes them.

use crate::check::input::{placed, placement};
use crate::check::shrink::describe;
use crate::check::{Attempt, Claim, Draw, Promise, Subject, Trial, Verdict};
use crate::scene::{Fragment, Scene};

/// Pixels of the image over which the range is tried.
const RANGE_RESOLUTION: [u32; 2] = [256, 192];

/// Every threshold is a number in (0, 1], so that alpha 0 never passes and alpha 1 always does.
pub const RANGE: Claim = Claim {
    id: "range",
    anchor: "§5, Listings 1 and 2 (last line)",
    statement: "every threshold is a number in (0, 1], on every surface, with analytic and with quad derivatives",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(1.0e-5)),
    run: range,
};

fn range(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(RANGE.id);
    let (mut n, mut outside) = (0, 0);
    let mut seen = Vec::new();
    for scene in Scene::all() {
        let scene = scene.with_resolution(RANGE_RESOLUTION);
        let place = placement(&mut rng);
        let mut fragments: Vec<Fragment> =
            scene.fragments().map(|fragment| placed(&fragment, place, subject.precision)).collect();
        fragments.extend(scene.quad_fragments());
        let thresholds = subject.thresholds(&fragments);
        let bad = |threshold: f64| !(threshold > 0.0 && threshold <= 1.0);
        let count = thresholds.iter().filter(|&&threshold| bad(threshold)).count();
        if let Some(first) = thresholds.iter().position(|&threshold| bad(threshold)) {
            let share = 100.0 * count as f64 / thresholds.len() as f64;
            seen.push(format!(
                "{}: {share:.1} %, as in {}",
                scene.name,
                describe(subject, &fragments[first], |_, value| {
                    bad(value) && value.is_nan() == thresholds[first].is_nan()
                })
            ));
        }
        n += thresholds.len();
        outside += count;
    }
    let name = "thresholds outside (0, 1]";
    Ok(Trial::counted(outside as u64, n as u64, name, "share of footprints", seen.join("; ")))
}
