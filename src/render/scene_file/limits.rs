//! The numbers that a scene file may have: one bound for each key, and what all of them may come to together, so that
//! whatever is asked for fits into memory and into the whole numbers that count it.

use super::bound::Bound::{self, From, UpTo};
use super::bound::{LARGEST, LARGEST_SIDE};
use super::diagnostic::Diagnostic;
use super::schema::{SceneFile, Takes};
use super::spans::{Number, Span, Spans};
use crate::render::effect::ALL;
use crate::render::effect::plan::plan;

/// Parts of a surface, and of a texture, which reads all of them for each texel.
const PARTS: Bound = From(1.0, (1 << 21) as f64);
const STROKES: Bound = From(1.0, 4096.0);
/// Surfaces one behind the other: every pixel keeps a fragment of each.
const LAYERS: Bound = From(1.0, 4096.0);
const SIDE: Bound = From(1.0, LARGEST_SIDE as f64);
const CORNER: Bound = From(0.0, LARGEST_SIDE as f64);

/// The bound of each key; [`LARGEST`] for the others.
const BOUNDS: &[(&str, Bound)] = &[
    ("resolution", SIDE),
    ("frames", From(1.0, 100_000.0)),
    ("seed", From(0.0, u64::MAX as f64)),
    ("camera.half_height", Bound::RATIO),
    ("camera.motion.translate", From(-1.0e6, 1.0e6)),
    ("camera.motion.zoom", From(1.0e-3, 1.0e3)),
    ("texture.size", From(1.0, 4096.0)),
    ("texture.opaque", From(0.0, 1.0)),
    ("texture.leaves.count", STROKES),
    ("texture.leaves.length", UpTo(1.0)),
    ("texture.wire.thickness", UpTo(1.0)),
    ("texture.wire.meshes", STROKES),
    ("texture.hair.strands", STROKES),
    ("texture.hair.thickness", UpTo(1.0)),
    ("texture.checkerboard.squares", STROKES),
    ("texture.constant.alpha", From(0.0, 1.0)),
    ("texture.constant.colour", From(0.0, 1.0)),
    ("surface.card.size", Bound::LENGTH),
    ("surface.card.repeat", From(-1.0e6, 1.0e6)),
    ("surface.plane.size", Bound::LENGTH),
    ("surface.plane.repeat", From(-1.0e6, 1.0e6)),
    ("surface.fence.panels", PARTS),
    ("surface.fence.size", Bound::LENGTH),
    ("surface.fence.repeat", From(-1.0e6, 1.0e6)),
    ("surface.foliage.cards", PARTS),
    ("surface.foliage.card", Bound::LENGTH),
    ("surface.foliage.radii", From(0.0, LARGEST)),
    ("surface.instances.count", PARTS),
    ("surface.instances.size", Bound::LENGTH),
    ("surface.instances.ground", From(0.0, LARGEST)),
    ("surface.hair.strips", PARTS),
    ("surface.hair.size", Bound::LENGTH),
    ("surface.hair.radius", From(0.0, LARGEST)),
    ("surface.stack.cards", LAYERS),
    ("surface.stack.size", Bound::LENGTH),
    ("surface.checkerboard.size", Bound::LENGTH),
    ("surface.checkerboard.square", Bound::LENGTH),
    ("surface.mesh.scale", Bound::LENGTH),
    ("target.samples", Bound::SAMPLES),
    ("target.history", Bound::CYCLE),
    ("truth.samples", From(1.0, 64.0)),
    ("distance.factors", Bound::RATIO),
    ("depth.ratio", SIDE),
    ("region.corner", CORNER),
    ("region.size", SIDE),
    ("inset.corner", CORNER),
    ("inset.size", SIDE),
    ("inset.times", From(1.0, 64.0)),
];

/// Triangles of a scene.
pub(in crate::render) const MOST_TRIANGLES: u64 = 1 << 22;
/// Pixels of a picture, counted at every place within them.
const MOST_PIXELS: u64 = 1 << 26;
/// Pixels of all frames of all takes, which are kept until the pictures are written.
const MOST_KEPT: u64 = 1 << 30;

/// Finds a number beyond the bound of its key.
pub(in crate::render) fn numbers(spans: &Spans<'_>) -> Result<(), (Option<Span>, String)> {
    let wrong = |&Number { ref key, value, .. }: &Number<'_>| {
        let of_effect = || {
            let (table, key) = key.strip_prefix("effects.")?.split_once('.')?;
            let known = ALL.iter().find(|known| known.name == table)?;
            known.about.bounds.iter().find(|(known, _)| *known == key)
        };
        let bound = BOUNDS.iter().find(|(known, _)| known == key).or_else(of_effect);
        let bound = bound.map_or(Bound::ANY, |&(_, bound)| bound);
        (!bound.holds(value)).then_some(bound)
    };
    let found = spans.numbers();
    match found.iter().find_map(|number| Some((number, wrong(number)?))) {
        None => Ok(()),
        Some((Number { key, span, text, .. }, bound)) => {
            let allowed = match bound {
                From(low, high) => format!("must be from {} to {}", short(low), short(high)),
                UpTo(high) => format!("must be above 0 and at most {}", short(high)),
            };
            Err((Some(span.clone()), format!("`{key}` is {text}; it {allowed}")))
        }
    }
}

/// A bound as a person would write it.
fn short(number: f64) -> String {
    let [plain, power] = [format!("{number}"), format!("{number:e}")];
    if power.len() < plain.len() && power.len() < 6 && plain.len() > 6 { power } else { plain }
}

/// Finds what comes to too much together.
pub(in crate::render) fn totals(scene: &SceneFile) -> Result<(), Diagnostic> {
    let wrong = |key: &str, message: String| Err(Diagnostic::new(key, message));
    let mut triangles = 0_u64;
    for (index, surface) in scene.surface.iter().enumerate() {
        triangles = triangles.saturating_add(surface.triangles());
        if triangles > MOST_TRIANGLES {
            return wrong(
                &format!("surface.{index}"),
                format!(
                    "up to surface {} there are {triangles} triangles; at most {MOST_TRIANGLES} are drawn",
                    index + 1
                ),
            );
        }
    }
    let [width, height] = scene.resolution.map(u64::from);
    if width.max(height) > u64::from(LARGEST_SIDE) {
        return wrong(
            "resolution",
            format!("`resolution` must be from 1 to {LARGEST_SIDE} pixels along each side"),
        );
    }
    let sets = match &scene.effects {
        Takes::Auto => &[][..],
        Takes::Sets(sets) => sets,
    };
    let truth = scene.truth.as_ref().map(|truth| ("truth.samples".to_owned(), truth.samples.get()));
    let sampled =
        sets.iter().enumerate().map(|(index, set)| (format!("effects.{index}"), plan(set).setup.places));
    let one = ("resolution".to_owned(), 1);
    for (key, side) in [one].into_iter().chain(truth).chain(sampled) {
        let side = u64::from(side);
        if width * height * side * side > MOST_PIXELS {
            let what = format!("{width} x {height} pixels with {side} x {side} places each");
            return wrong(&key, format!("{what} are more than the {MOST_PIXELS} that are drawn at once"));
        }
    }
    // Each take and the truth stand side by side, in rows: one a distance, an inset, a depth buffer and differences.
    let columns = sets.len().max(1) as u64 + u64::from(scene.truth.is_some());
    let rows = scene.distance.as_ref().map_or(0, |distance| distance.factors.len()) as u64 + 3;
    let enlarged = scene
        .inset
        .as_ref()
        .map_or([0; 2], |inset| inset.size.map(|side| u64::from(side) * u64::from(inset.times.get())));
    let across = columns * (width.max(enlarged[0]) + 4);
    let down = rows * (height + 4) + enlarged[1] + 4;
    if across.saturating_mul(down) > MOST_PIXELS {
        let key = if scene.inset.is_some() {
            "inset"
        } else if rows > 3 {
            "distance.factors"
        } else {
            "effects"
        };
        return wrong(
            key,
            format!("the pictures beside each other have {across} x {down} pixels, more than {MOST_PIXELS}"),
        );
    }
    let frames = u64::from(scene.frames.get());
    if (frames * sets.len().max(1) as u64).saturating_mul(width * height) > MOST_KEPT {
        let message =
            format!("`frames` is {frames}: those of all takes have more than {MOST_KEPT} pixels together");
        return wrong("frames", message);
    }
    Ok(())
}
