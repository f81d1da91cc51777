//! The threshold is a function: of the fragment alone, and of its derivatives without order or sign.

use crate::check::input::fragments_everywhere;
use crate::check::judge::equality;
use crate::check::{Attempt, Claim, Conclusion, Draw, Promise, Subject, Trial, Verdict};
use crate::scene::Fragment;
use crate::stats::seed;
use crate::threshold::footprint::Footprint;
use glam::{DVec3, dvec2};
use rand::rngs::Xoshiro256PlusPlus;

/// Points that are evaluated one by one.
const ALONE: usize = 64;

/// Fragments of a second pass that are evaluated together: neither a power of two nor a row of the first.
const PIECE: usize = 37;

/// World and eye coordinates that are drawn in place of others lie up to this far from zero along every axis, in object units.
const ARGUMENT_REACH: f64 = 1024.0;

/// The pixels among which one is drawn in place of another, along each axis of the screen.
const ARGUMENT_PIXELS: [f64; 2] = [0.0, 8192.0];

/// The texture coordinates among which one is drawn: repeated and mirrored textures have those outside [0, 1].
const ARGUMENT_TEXCOORDS: [f64; 2] = [-8.0, 8.0];

/// The levels of detail among which one is drawn: magnified, and all levels of a texture of 16 384 texels.
const ARGUMENT_LODS: [f64; 2] = [-1.0, 14.0];

/// Layers among which one is drawn, from the nearest.
const ARGUMENT_LAYERS: f64 = 17.0;

/// Frames, or periods of the strata, of which one is drawn for half of the points; for the others all are alike.
const ARGUMENT_FRAMES: u32 = 64;

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

/// What a threshold is given beside the footprint says nothing.
pub const ARGUMENTS: Claim = Claim {
    id: "determinism.arguments",
    anchor: "§5 (object-space coordinates alone); not in the paper",
    statement: "layer, level of detail, texture coordinates, pixel, world and eye coordinates and the frame, each changed alone, \
                change no bit of the threshold; of the frames only those of one stratum are compared",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(8.0e-3)),
    run: arguments,
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

/// Takes one argument from another fragment.
type Taken = fn(&mut Fragment, &Fragment);

/// What a fragment has beside its footprint, by name: how to take it over from another one.
const BESIDE_FOOTPRINT: [(&str, Taken); 7] = [
    ("layer", |of, other| of.layer = other.layer),
    ("level of detail", |of, other| of.lod = other.lod),
    ("texture coordinates", |of, other| of.texcoord = other.texcoord),
    ("pixel", |of, other| of.pixel = other.pixel),
    ("world coordinates", |of, other| of.world = other.world),
    ("eye coordinates", |of, other| of.eye = other.eye),
    ("frame", |of, other| of.frame = other.frame),
];

/// A fragment of the same footprint with all else drawn anew, far beyond what the scenes have.
fn drawn_anew(subject: &Subject<'_>, point: &Fragment, rng: &mut Xoshiro256PlusPlus) -> Fragment {
    let mut part = || seed::uniform01(rng);
    let mut within = |[low, high]: [f64; 2]| low + (high - low) * part();
    let mut place = || DVec3::from_array([0; 3].map(|_| within([-ARGUMENT_REACH, ARGUMENT_REACH])));
    let (world, eye) = (place(), place());
    // One half among the first frames, the other anywhere.
    let last = if within([0.0, 1.0]) < 0.5 { ARGUMENT_FRAMES } else { u32::MAX };
    Fragment {
        footprint: point.footprint,
        world,
        eye,
        pixel: dvec2(within(ARGUMENT_PIXELS).floor() + 0.5, within(ARGUMENT_PIXELS).floor() + 0.5),
        texcoord: dvec2(within(ARGUMENT_TEXCOORDS), within(ARGUMENT_TEXCOORDS)),
        lod: within(ARGUMENT_LODS),
        frame: subject.frames.first_again((within([0.0, 1.0]) * f64::from(last)) as u32),
        layer: within([0.0, ARGUMENT_LAYERS]) as u32,
    }
}

fn arguments(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    // In a stratum of its own a threshold is another one.
    let first = |point: Fragment| Fragment { frame: 0, ..point };
    let points: Vec<Fragment> =
        fragments_everywhere(subject, draw, ARGUMENTS.id).into_iter().map(first).collect();
    let mut rng = draw.rng(ARGUMENTS.id);
    let others: Vec<Fragment> = points.iter().map(|point| drawn_anew(subject, point, &mut rng)).collect();
    let once = subject.thresholds(&points);
    let mut all = None;
    for (name, take) in BESIDE_FOOTPRINT {
        let with = |point: &Fragment, other: &Fragment| {
            let mut point = *point;
            take(&mut point, other);
            point
        };
        let changed: Vec<Fragment> =
            points.iter().zip(&others).map(|(point, other)| with(point, other)).collect();
        let again = |at: usize, points: &[Fragment]| {
            let changed: Vec<Fragment> = points.iter().map(|point| with(point, &others[at])).collect();
            vec![subject.thresholds(points), subject.thresholds(&changed)]
        };
        let asked = [once.clone(), subject.thresholds(&changed)];
        let trial = equality(subject, &points, &asked, again, &format!("where the {name} alone is another"));
        if trial.conclusion == (Conclusion::Exact { holds: false }) {
            return Ok(trial);
        }
        all = Some(trial);
    }
    Ok(all
        .unwrap_or_else(|| Trial::without(Conclusion::Inconclusive, "there is nothing beside the footprint")))
}
