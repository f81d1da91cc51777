//! What a threshold reads of a fragment that it should not, and whether it reads the position at all.

use super::law::{bent_steps, laws, unique};
use super::probe::{SAME, places};
use super::slip::{Found, Slip, found, named};
use crate::check::{Frames, Subject};
use crate::scene::Fragment;
use crate::stats::seed;
use glam::{DVec2, DVec3};
use rand::rngs::Xoshiro256PlusPlus;

/// Fragments of which one part is exchanged.
const FRAGMENTS: usize = 192;

/// A share of them that changes where the threshold depends on that part.
const SOME: f64 = 0.1;

/// Fragments whose law is looked at.
const CELLS: usize = 4096;

/// What was seen.
pub(super) struct Reading {
    pub found: Vec<Found>,
    /// Whether another position has another threshold.
    pub follows_position: bool,
}

/// A part of a fragment that no threshold should read, and another value for it.
struct Part {
    /// What it is to read this part and no position, and to read it beside the position.
    slips: [Slip; 2],
    name: &'static str,
    other: fn(Fragment, f64) -> Fragment,
    /// Whether a threshold may read it where it claims to change from frame to frame.
    is_frame: bool,
}

const fn part(slips: [&'static str; 2], name: &'static str, other: fn(Fragment, f64) -> Fragment) -> Part {
    Part { slips: [named(slips[0]), named(slips[1])], name, other, is_frame: false }
}

const PARTS: &[Part] = &[
    part(["screen-space", "reads-the-pixel"], "the pixel", |f, by| {
        let pixel = f.pixel + DVec2::new((by * 31.0).floor() + 1.0, (by * 17.0).floor());
        Fragment { pixel, ..f }
    }),
    part(["texture-space", "reads-the-texture-coordinates"], "the texture coordinates", |f, by| Fragment {
        texcoord: (f.texcoord + 0.1 + 0.8 * by).fract(),
        ..f
    }),
    part(["noise-by-level-of-detail"; 2], "the level of detail", |f, by| Fragment {
        lod: f.lod + 1.0 + 4.0 * by,
        ..f
    }),
    part(["layer-in-the-seed"; 2], "the layer", |f, by| Fragment {
        layer: f.layer + 1 + (by * 6.0) as u32,
        ..f
    }),
    Part {
        is_frame: true,
        ..part(["frame-seed"; 2], "the frame", |f, by| Fragment {
            frame: f.frame + 1 + (by * 60.0) as u32,
            ..f
        })
    },
];

/// Exchanges the parts of fragments one by one.
pub(super) fn look(subject: &Subject<'_>, rng: &mut Xoshiro256PlusPlus) -> Reading {
    let fragments = places(FRAGMENTS, subject.hash_scale, rng);
    let before = subject.thresholds(&fragments);
    let share = |others: Vec<Fragment>| {
        let after = subject.thresholds(&others);
        let changed = before.iter().zip(&after).filter(|(a, b)| (*a - *b).abs() >= SAME).count();
        changed as f64 / FRAGMENTS as f64
    };
    let moved = |fragment: &Fragment, by: DVec3| {
        let footprint = fragment.footprint;
        let position = footprint.position + by;
        let footprint =
            subject.precision.round(&crate::threshold::footprint::Footprint { position, ..footprint });
        Fragment { footprint, world: fragment.world + by, eye: fragment.eye + by, ..*fragment }
    };
    let elsewhere: Vec<Fragment> = fragments
        .iter()
        .map(|fragment| {
            let by = DVec3::new(3.3, -2.7, 4.1) * (0.5 + seed::uniform01(rng));
            moved(fragment, by)
        })
        .collect();
    let by_position = share(elsewhere);
    let follows_position = by_position >= SOME;
    let mut all = Vec::new();
    for &Part { slips, name, other, is_frame } in PARTS {
        if is_frame && subject.frames != Frames::Static {
            continue;
        }
        let others = fragments.iter().map(|&fragment| other(fragment, seed::uniform01(rng))).collect();
        let by_part = share(others);
        if by_part >= SOME {
            let shown = format!(
                "another value for {name} changes {:.0} % of {FRAGMENTS} thresholds, another position {:.0} %",
                100.0 * by_part,
                100.0 * by_position
            );
            all.push(found(slips[usize::from(follows_position)], shown));
            break;
        }
    }
    if !follows_position {
        // No cell is left to look at: what is done to all values is.
        let values = subject.thresholds(&places(CELLS, subject.hash_scale, rng));
        if all.is_empty() {
            const OBJECT: Slip = named("one-threshold-an-object");
            let shown = match unique(&values)[..] {
                [only] => format!("all of {CELLS} thresholds are {only}"),
                _ => {
                    format!("another position changes {:.0} % of {FRAGMENTS} thresholds", 100.0 * by_position)
                }
            };
            all.push(found(OBJECT, shown));
        }
        let laws = laws(&values);
        if let Some((slip, shown)) = bent_steps(&values) {
            all.push(found(slip, shown));
        } else if laws.iter().all(|law| law.slip.is_some()) {
            all.extend(laws.into_iter().filter_map(|law| Some(found(law.slip?, law.shown))).take(1));
        }
    }
    Reading { found: all, follows_position }
}
