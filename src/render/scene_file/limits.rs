//! The numbers that a scene file may have: one bound for each key, and what all of them may come to together, so that
//! whatever is asked for fits into memory and into the whole numbers that count it.

/// The numbers that a key may have.
#[derive(Clone, Copy)]
enum Bound {
    /// Both ends are allowed.
    From(f64, f64),
    /// Above 0, up to an end that is allowed.
    UpTo(f64),
}

use super::schema::{SceneFile, Takes};
use super::spans::{Number, Places, Span};
use Bound::{From, UpTo};

/// The largest side of an image, in pixels.
pub(in crate::render) const LARGEST_SIDE: u32 = 16_384;

/// What no number exceeds, whatever its key: beyond, the positions of a mesh lose whole units.
const LARGEST: f64 = 1.0e15;
/// Lengths and scales of objects.
const LENGTH: Bound = From(1.0 / LARGEST, LARGEST);
/// Ratios: of distances, of noise to a pixel.
const RATIO: Bound = From(1.0e-6, 1.0e6);
/// The threshold of an alpha test.
const THRESHOLD: Bound = UpTo(1.0);
/// Samples in a pixel: bits of a word.
const SAMPLES: Bound = From(1.0, 64.0);
/// Frames that belong together.
const CYCLE: Bound = From(1.0, 1024.0);
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
    ("camera.half_height", RATIO),
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
    ("surface.card.size", LENGTH),
    ("surface.card.repeat", From(-1.0e6, 1.0e6)),
    ("surface.plane.size", LENGTH),
    ("surface.plane.repeat", From(-1.0e6, 1.0e6)),
    ("surface.fence.panels", PARTS),
    ("surface.fence.size", LENGTH),
    ("surface.fence.repeat", From(-1.0e6, 1.0e6)),
    ("surface.foliage.cards", PARTS),
    ("surface.foliage.card", LENGTH),
    ("surface.foliage.radii", From(0.0, LARGEST)),
    ("surface.instances.count", PARTS),
    ("surface.instances.size", LENGTH),
    ("surface.instances.ground", From(0.0, LARGEST)),
    ("surface.hair.strips", PARTS),
    ("surface.hair.size", LENGTH),
    ("surface.hair.radius", From(0.0, LARGEST)),
    ("surface.stack.cards", LAYERS),
    ("surface.stack.size", LENGTH),
    ("surface.checkerboard.size", LENGTH),
    ("surface.checkerboard.square", LENGTH),
    ("surface.mesh.scale", LENGTH),
    ("target.samples", SAMPLES),
    ("target.history", CYCLE),
    ("truth.samples", From(1.0, 64.0)),
    ("distance.factors", RATIO),
    ("depth.ratio", SIDE),
    ("region.corner", CORNER),
    ("region.size", SIDE),
    ("inset.corner", CORNER),
    ("inset.size", SIDE),
    ("inset.times", From(1.0, 64.0)),
    ("effects.supersampling.samples", From(1.0, 16.0)),
    ("effects.limited_level.level", From(0.0, 64.0)),
    ("effects.scaled_texels.radius", From(0.0, 64.0)),
    ("effects.foveated.gaze", From(-1.0e6, 1.0e6)),
    ("effects.foveated.radius", From(0.0, 1.0e6)),
    ("effects.foveated.slope", From(0.0, 1.0e6)),
    ("effects.fixed.threshold", THRESHOLD),
    ("effects.hashed.hash_scale", RATIO),
    ("effects.robust.hash_scale", RATIO),
    ("effects.independent.frames", CYCLE),
    ("effects.jitter.frames", CYCLE),
    ("effects.temporal.frames", CYCLE),
    ("effects.multisampling.samples", SAMPLES),
    ("effects.alpha_to_coverage.samples", SAMPLES),
    ("effects.fade_in.full_noise_lod", UpTo(1.0e6)),
    ("effects.fade_in.authored", THRESHOLD),
    ("effects.occlusion.reach", LENGTH),
    ("effects.history.weight", UpTo(1.0)),
    ("effects.average.frames", CYCLE),
];

/// Triangles of a scene.
pub(in crate::render) const MOST_TRIANGLES: u64 = 1 << 22;
/// Pixels of a picture, counted at every place within them.
const MOST_PIXELS: u64 = 1 << 26;
/// Pixels of all frames of all takes, which are kept until the pictures are written.
const MOST_KEPT: u64 = 1 << 30;

impl Bound {
    fn holds(self, value: f64) -> bool {
        match self {
            From(low, high) => (low..=high).contains(&value),
            UpTo(high) => value > 0.0 && value <= high,
        }
    }
}

/// Finds a number beyond the bound of its key.
pub(in crate::render) fn numbers(places: &Places<'_>) -> Result<(), (Option<Span>, String)> {
    let wrong = |&Number { ref key, value, .. }: &Number<'_>| {
        let bound = BOUNDS.iter().find(|(known, _)| known == key);
        let bound = bound.map_or(From(-LARGEST, LARGEST), |&(_, bound)| bound);
        (!bound.holds(value)).then_some(bound)
    };
    let found = places.numbers();
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

/// Finds what comes to too much together: the path of a key, and what is wrong.
pub(in crate::render) fn totals(scene: &SceneFile) -> Result<(), (String, String)> {
    let wrong = |key: &str, message: String| Err((key.to_owned(), message));
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
    let truth = scene.truth.as_ref().map(|truth| ("truth.samples".to_owned(), truth.samples));
    let sampled = sets.iter().enumerate().filter_map(|(index, set)| {
        Some((format!("effects.{index}.supersampling.samples"), set.supersampling.as_ref()?.samples))
    });
    let one = ("resolution".to_owned(), core::num::NonZeroU32::MIN);
    for (key, side) in [one].into_iter().chain(truth).chain(sampled) {
        let side = u64::from(side.get());
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
