//! The threshold belongs to a point of the object, wherever that point is and whoever looks.

use crate::check::input::{Motion, general_scenes, placed, placement, sighting};
use crate::check::judge::equality;
use crate::check::tolerance::EXACT_POINTS;
use crate::check::{Attempt, Claim, Draw, Promise, Subject, Trial, Verdict};
use crate::scene::Fragment;

/// Camera and object move; the point of the object does not.
pub const OBJECT: Claim = Claim {
    id: "coordinates.object",
    anchor: "§5.2 (object-space coordinates), GDC 2017 (Coordinate Choice For Hash Input)",
    statement: "while camera and object move, turn, are skinned or deformed, a point with the same object coordinates and \
                derivatives has the same threshold, bit for bit",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(8.0e-3)),
    run: object,
};

fn object(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(OBJECT.id);
    let scenes = general_scenes();
    let (mut before, mut after): (Vec<Fragment>, Vec<Fragment>) = (Vec::new(), Vec::new());
    for index in 0..draw.samples(EXACT_POINTS) {
        let scene = &scenes[index % scenes.len()];
        let motion = Motion::ALL[index / scenes.len() % Motion::ALL.len()];
        let (found, place) = (sighting(scene, &mut rng), placement(&mut rng));
        let at = |frames| motion.fragment(&scene.camera, found.surface(), frames, found.fragment.world);
        if let (Some(earlier), Some(later)) = (at(0.0), at(1.0)) {
            let earlier = placed(&earlier, place, subject.precision);
            // What depends on the derivatives alone stays with them.
            after.push(Fragment { footprint: earlier.footprint, lod: earlier.lod, ..later });
            before.push(earlier);
        }
    }
    let asked = [&before, &after].map(|points| subject.thresholds(points));
    let again = |like: usize, points: &[Fragment]| {
        let moved = |point: &Fragment| Fragment { footprint: point.footprint, lod: point.lod, ..after[like] };
        let later: Vec<Fragment> = points.iter().map(moved).collect();
        vec![subject.thresholds(points), subject.thresholds(&later)]
    };
    Ok(equality(subject, &before, &asked, again, "after camera and object have moved"))
}
