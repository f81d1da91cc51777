//! In which coordinates a threshold may be hashed: the table of GDC 2017, measured cell by cell.
//!
//! Noise stays on a surface if each of its points keeps its threshold while camera and object move. A point is
//! followed over one frame of a motion, and one threshold is asked in each kind of coordinates, with the derivatives of
//! those coordinates. It is kept if it changes by no more than the change of its scale explains; points whose scale
//! explains much are left out.

use crate::check::input::{Motion, general_scenes, placement, sighting};
use crate::check::predict::largest_change;
use crate::check::{Draw, Precision, Subject};
use crate::scene::Fragment;
use crate::threshold::footprint::Footprint;
use crate::threshold::hash::HashKind;
use crate::threshold::robust::Robust;
use crate::threshold::two_scale::Variant;
use glam::{DVec2, DVec3};

/// Points that are followed for one cell of the table of coordinates: a share is known to a hundredth.
const TABLE_POINTS: usize = 1 << 11;

/// The largest change of a threshold that the change of its scale may explain in that table: two thresholds that have
/// nothing to do with each other are nearer than this in one case of four.
const EXPLAINED: f64 = 0.125;

/// A kind of coordinates, a row of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Coordinates {
    /// Pixels.
    Screen,
    /// Those of the camera.
    Eye,
    /// Normalized device coordinates with depth.
    Device,
    /// Texture coordinates.
    Texture,
    /// Those of the world.
    World,
    /// Those of the object before any skinning or deformation.
    Object,
}

/// What the slides say of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stated {
    /// A check mark.
    Stable,
    /// A check mark with a star: "somewhat generous".
    Generous,
    /// A cross.
    Unstable,
    /// A question mark: stable if the coordinates are those before the deformation, as they are here. Those after it are
    /// the world's.
    BeforeDeformation,
}

/// One cell of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TableCell {
    /// Its row.
    pub coordinates: Coordinates,
    /// Its column.
    pub motion: Motion,
    /// What the slides say.
    pub stated: Stated,
    /// The share of points that keep their threshold, in [0, 1]; 1 for a hash that stays on the surface.
    pub kept: f64,
    /// Points that were followed.
    pub points: u64,
}

impl TableCell {
    /// Returns whether the measurement agrees with the slides: all points keep their threshold where they say so, and
    /// fewer than half where they do not.
    #[must_use]
    pub fn is_confirmed(&self) -> bool {
        match self.stated {
            Stated::Stable | Stated::BeforeDeformation => self.kept == 1.0,
            Stated::Generous => self.kept >= 0.5,
            Stated::Unstable => self.kept < 0.5,
        }
    }
}

impl Coordinates {
    /// Every kind, in the order of the slides.
    pub const ALL: [Self; 6] =
        [Self::Screen, Self::Eye, Self::Device, Self::Texture, Self::World, Self::Object];

    /// The words by which reports name it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Screen => "screen",
            Self::Eye => "eye",
            Self::Device => "normalized device",
            Self::Texture => "texture",
            Self::World => "world",
            Self::Object => "object",
        }
    }

    /// Returns the place of a fragment in these coordinates; those of an image of `size` pixels.
    #[must_use]
    pub fn of(self, fragment: &Fragment, size: DVec2) -> DVec3 {
        match self {
            Self::Screen => fragment.pixel.extend(0.0),
            Self::Eye => fragment.eye,
            // An infinite far plane, and a near plane at a tenth of a unit.
            Self::Device => (fragment.pixel / size * 2.0 - 1.0).extend(1.0 - 0.1 / fragment.eye.z),
            Self::Texture => fragment.texcoord.extend(0.0),
            Self::World => fragment.world,
            Self::Object => fragment.footprint.position,
        }
    }
}

/// What the slides say: rows and columns in the order of [`Coordinates::ALL`] and [`Motion::ALL`].
const STATED: [[Stated; 6]; 6] = {
    use Stated::{BeforeDeformation as Before, Generous, Stable as Yes, Unstable as No};
    [
        [Generous, No, No, No, No, No],
        [Generous, No, No, No, No, No],
        [Generous, No, No, No, No, No],
        [Yes, Yes, Yes, Yes, Yes, Before],
        [Yes, Yes, No, No, No, No],
        [Yes, Yes, Yes, Yes, Yes, Before],
    ]
};

/// Measures the table of GDC 2017 ("Key: Coordinate Choice For Hash Input"), row by row, on the scenes in general
/// position.
#[must_use]
pub fn table(draw: &Draw) -> Vec<TableCell> {
    let mut entries = Vec::new();
    for (coordinates, row) in Coordinates::ALL.into_iter().zip(STATED) {
        for (motion, stated) in Motion::ALL.into_iter().zip(row) {
            let (kept, points) = measured(coordinates, motion, draw);
            entries.push(TableCell {
                coordinates,
                motion,
                stated,
                kept: kept as f64 / points as f64,
                points,
            });
        }
    }
    entries
}

/// The points that keep their threshold, and all that were followed.
fn measured(coordinates: Coordinates, motion: Motion, draw: &Draw) -> (u64, u64) {
    let subject = Subject::robust::<HashKind>("table", Precision::F64, Robust::new(Variant::Isotropic));
    let mut rng = draw.rng(&format!("coordinates.table, {}, {}", coordinates.name(), motion.name()));
    let scenes = general_scenes();
    let mut pairs = Vec::new();
    for index in 0..draw.samples(TABLE_POINTS) {
        let scene = &scenes[index % scenes.len()];
        let place = placement(&mut rng);
        let found = sighting(scene, &mut rng);
        let surface = found.surface();
        let seen = |frames: f64| {
            let at = |point| motion.fragment(&scene.camera, surface, frames, point);
            let here = at(found.fragment.world)?;
            let position = |fragment: &Fragment| coordinates.of(fragment, scene.camera.size());
            // The coordinates at a point a small way along the surface, for their derivatives.
            let derivative = |along: DVec3| {
                let beside = at(here.footprint.position + along * BESIDE)?;
                Some((position(&beside) - position(&here)) / BESIDE)
            };
            Some(Footprint {
                position: position(&here) + place,
                dpdx: derivative(here.footprint.dpdx)?,
                dpdy: derivative(here.footprint.dpdy)?,
            })
        };
        pairs.extend(seen(0.0).zip(seen(1.0)));
    }
    let [before, after] = [0, 1].map(|frame| {
        let of = |pair: &(Footprint<f64>, Footprint<f64>)| if frame == 0 { pair.0 } else { pair.1 };
        subject.thresholds(&pairs.iter().map(of).collect::<Vec<_>>())
    });
    let (mut kept, mut points) = (0, 0);
    for ((earlier, later), (old, new)) in pairs.iter().zip(before.iter().zip(&after)) {
        let by_scale = largest_change(&subject, &subject.nominal(earlier), &subject.nominal(later));
        if by_scale <= EXPLAINED {
            points += 1;
            kept += u64::from((new - old).abs() <= by_scale);
        }
    }
    (kept, points)
}

/// Pixels to the neighbour from which coordinates are differentiated.
const BESIDE: f64 = 1.0e-3;
