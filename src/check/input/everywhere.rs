//! Inputs from the whole domain in which a threshold is used: cells of every octave, near and far, at every angle, on every
//! level of detail, layer and frame, at several noise sizes.
//!
//! The domain is a product of [`Dimension`]s, each cut into levels. A [`Setting`] is one level of each. Settings are drawn so that
//! every level of every dimension comes up as often as any other (a Latin hypercube); which levels come together depends on the
//! seed. Two things are not evenly spread: the first settings are corners, where octave, distance and ratio are at their ends, in every
//! direction; and half of the settings have no derivative that is zero.

use crate::check::Subject;
use crate::check::draw::{Draw, Reach};
use crate::check::input::{numerator, rotation};
use crate::check::subject::Nominal;
use crate::scene::Fragment;
use crate::stats::seed::uniform01;
use crate::threshold::footprint::Footprint;
use crate::threshold::robust::Join;
use crate::threshold::robust::nested::named;
use crate::threshold::two_scale::Variant;
use glam::{DMat3, DVec2, DVec3, dvec2};
use rand::Rng;
use rand::rngs::Xoshiro256PlusPlus;
use rustc_hash::{FxHashSet, FxHasher};
use std::hash::{Hash, Hasher};

/// Octaves of the cells: from cells of a million units to those of a millionth.
const OCTAVES: [i32; 2] = [-20, 20];

/// Octaves of the largest coordinate in object units: from 1 to 2^20.
const DISTANCES: [i32; 2] = [0, 19];

/// Octaves of the ratio of the two derivatives: from 1024 along screen y to 1024 along screen x.
const RATIOS: [i32; 2] = [-10, 10];

/// Levels of detail: magnified by a factor of two, to a texture of 16384 texels seen as one.
const LODS: [i32; 2] = [-1, 14];

/// Layers one behind the other.
const LAYERS: [i32; 2] = [0, 15];

/// Frames: so many that follow each other, from one in the first hour at 60 frames a second, and as many at random, every octave
/// of a number of 32 bits alike.
const FRAMES: i32 = 64;

/// Frames of an hour.
const HOUR: u32 = 60 * 3600;

/// Noise sizes in pixels beside the claimed one, where the subject has that parameter: half and twice a pixel, and one that is no
/// power of two.
const HASH_SCALES: [f64; 4] = [0.5, 1.0, 2.0, 3.7];

/// Repetitions of the texture to both sides of its origin: a wall of bricks.
const TILES: f64 = 8.0;

/// Octants and half axes from which positions come.
const DIRECTIONS: i32 = 14;

/// Ways in which derivatives are zero: none; dpdx, dpdy or both; both along x, y or z; one of the six components.
const ZEROS: i32 = 13;

/// Settings at [`Budget::Ci`]: a hundred of each octave.
const SETTINGS: usize = 4096;

/// No object axis has less than this share of the longer derivative where the listings are asked: twice the share to which the robust
/// threshold raises it.
const LEAST_AXIS_SHARE: f64 = 1.0 / 16.0;

/// Tries in a row that find no cell of their own, after which a setting has no more.
const TRIES: usize = 24;

/// Cells along an axis to both sides of a half axis.
const BESIDE: f64 = 8.0;

/// Share of the largest coordinate beyond which a place is not on a half axis any more.
const BESIDE_SHARE: f64 = 1.0 / 2048.0;

/// Octaves by which the largest coordinate is larger than a cell where [`BESIDE`] cells are that share: log2(8 * 2048).
const HALF_AXIS_OCTAVES: i32 = 14;

/// A dimension of the domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Dimension {
    /// Octave of the cells.
    Octave,
    /// Octave of the largest coordinate.
    Distance,
    /// Octant or half axis.
    Direction,
    /// Octave of the ratio of the derivatives.
    Ratio,
    /// Level of detail.
    Lod,
    /// Index of the layer.
    Layer,
    /// Place among the frames.
    Frame,
    /// Place among the noise sizes.
    HashScale,
    /// Which derivatives are zero.
    Zero,
}

impl Dimension {
    pub(crate) const ALL: [Self; 9] = [
        Self::Octave,
        Self::Distance,
        Self::Direction,
        Self::Ratio,
        Self::Lod,
        Self::Layer,
        Self::Frame,
        Self::HashScale,
        Self::Zero,
    ];

    /// The first and the last level, for a subject that can be tried at so many noise sizes.
    fn ends(self, scales: usize) -> [i32; 2] {
        match self {
            Self::Octave => OCTAVES,
            Self::Distance => DISTANCES,
            Self::Direction => [0, DIRECTIONS - 1],
            Self::Ratio => RATIOS,
            Self::Lod => LODS,
            Self::Layer => LAYERS,
            Self::Frame => [0, 2 * FRAMES - 1],
            Self::HashScale => [0, scales as i32 - 1],
            Self::Zero => [0, ZEROS - 1],
        }
    }
}

/// One level of each dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Setting {
    levels: [i32; 9],
    /// The frame.
    pub frame: u32,
    /// Where the surface begins on the screen, in pixels.
    pixel: [f64; 2],
    /// Whether no axis is nearly without derivative, where a listing has cells of its own.
    general: bool,
    /// The repetition of the texture, along both axes.
    tile: [f64; 2],
    /// World coordinates of the object's origin.
    world: DVec3,
}

impl Setting {
    pub fn level(&self, dimension: Dimension) -> i32 {
        self.levels[dimension as usize]
    }

    /// Whether positions lie anywhere within their cells alike: they come from a whole number of cells along every axis.
    pub fn has_uniform_phases(&self) -> bool {
        let cells = self.level(Dimension::Octave) + self.level(Dimension::Distance);
        let is_half_axis = self.level(Dimension::Direction) >= 8;
        cells >= if is_half_axis { HALF_AXIS_OCTAVES } else { 0 }
    }

    /// All levels in words, for the noise sizes of a [`Settings`].
    pub fn words(&self, scales: &[f64]) -> String {
        Dimension::ALL.map(|dimension| self.told(dimension, scales)).join(", ")
    }

    /// The level of a dimension in words, for the noise sizes of a [`Settings`].
    pub fn told(&self, dimension: Dimension, scales: &[f64]) -> String {
        let level = self.level(dimension);
        let axis = |axis: i32| ["x", "y", "z"][axis as usize % 3];
        match dimension {
            Dimension::Octave => format!("octave {level}"),
            Dimension::Distance => format!("|p| from {} to {} units", 1 << level, 2 << level),
            Dimension::Direction if level < 8 => {
                let sign = |bit: i32| if level >> bit & 1 == 1 { '-' } else { '+' };
                format!("octant {}x {}y {}z", sign(0), sign(1), sign(2))
            }
            Dimension::Direction => {
                format!("along {}{}", if level < 11 { '+' } else { '-' }, axis(level - 8))
            }
            Dimension::Ratio if level == 0 => "derivatives of one length".to_owned(),
            Dimension::Ratio => {
                let longer = if level > 0 { "dpdx" } else { "dpdy" };
                format!("{longer} {} times the other", 1 << level.abs())
            }
            Dimension::Lod => format!("lod {level}"),
            Dimension::Layer => format!("layer {level}"),
            Dimension::Frame => format!("frame {}", self.frame),
            Dimension::HashScale => format!("hash scale {}", scales[level as usize]),
            Dimension::Zero => match level {
                0 => "no derivative zero".to_owned(),
                1 => "dpdx zero".to_owned(),
                2 => "dpdy zero".to_owned(),
                3 => "both derivatives zero".to_owned(),
                4..7 => format!("both derivatives zero along {}", axis(level - 4)),
                7..10 => format!("dpdx.{} zero", axis(level - 7)),
                _ => format!("dpdy.{} zero", axis(level - 10)),
            },
        }
    }
}

/// Largest index of a cell of the listings, along any axis: beyond it 17 times an index takes more digits than `f32` has.
const LISTINGS_INDEX: f64 = 524_288.0;

/// Whether a threshold is asked anything at a setting.
fn is_within(reach: Reach, setting: &Setting) -> bool {
    match reach {
        Reach::Whole => true,
        Reach::Listings => {
            let cells = setting.level(Dimension::Octave) + 2 + setting.level(Dimension::Distance) + 1;
            setting.level(Dimension::Zero) == 0 && libm::exp2(f64::from(cells)) <= LISTINGS_INDEX
        }
    }
}

/// Settings for a subject, and the noise sizes that they name.
pub(crate) struct Settings {
    pub scales: Vec<f64>,
    pub all: Vec<Setting>,
}

impl Settings {
    /// Draws the settings of a claim.
    pub fn draw(subject: &Subject<'_>, draw: &Draw, rng: &mut Xoshiro256PlusPlus) -> Self {
        let mut scales = vec![subject.hash_scale];
        if subject.at_hash_scale(subject.hash_scale).is_some() {
            scales.extend(HASH_SCALES.into_iter().filter(|scale| *scale != subject.hash_scale));
        }
        // Of the whole domain the listings claim a fifth.
        let n = draw.samples(SETTINGS * if draw.reach == Reach::Listings { 4 } else { 1 });
        let mut columns = Dimension::ALL.map(|dimension| levels(dimension, n, scales.len(), rng));
        corners(&mut columns);
        let first = rng.next_u32() % HOUR;
        let frames: Vec<u32> = (0..2 * FRAMES as u32)
            .map(|place| if place < FRAMES as u32 { first + place } else { any_frame(rng) })
            .collect();
        let all = (0..n).map(|at| {
            let levels = columns.each_ref().map(|column| column[at]);
            let mut between = |low: f64, high: f64| low + (high - low) * uniform01(rng);
            Setting {
                levels,
                frame: frames[levels[Dimension::Frame as usize] as usize],
                general: draw.reach == Reach::Listings,
                tile: [between(-TILES, TILES).floor(), between(-TILES, TILES).floor()],
                pixel: [between(0.0, 3840.0).floor() + 0.5, between(0.0, 2160.0).floor() + 0.5],
                world: DVec3::from_array([(); 3].map(|()| between(-64.0, 64.0))),
            }
        });
        Self { scales, all: all.filter(|setting| is_within(draw.reach, setting)).collect() }
    }

    /// Calls a function with the settings of each noise size, a few thousand samples' worth at a time, and the subject at that size.
    pub fn each(
        &self,
        subject: &Subject<'_>,
        mut each: impl FnMut(&Subject<'_>, &[Setting]) -> crate::check::Attempt<()>,
    ) -> crate::check::Attempt<()> {
        for (place, &scale) in self.scales.iter().enumerate() {
            let is_here = |setting: &&Setting| setting.level(Dimension::HashScale) == place as i32;
            let here: Vec<Setting> = self.all.iter().filter(is_here).copied().collect();
            let rescaled = (place > 0).then(|| subject.at_hash_scale(scale)).flatten();
            for some in here.chunks(SETTINGS / 16) {
                each(rescaled.as_ref().unwrap_or(subject), some)?;
            }
        }
        Ok(())
    }
}

/// Draws a frame of which every octave is alike.
pub(crate) fn any_frame(rng: &mut Xoshiro256PlusPlus) -> u32 {
    libm::exp2(32.0 * uniform01(rng)) as u32
}

/// `n` levels of a dimension, each as often as any other, in random order. Half of them have no derivative that is zero.
fn levels(dimension: Dimension, n: usize, scales: usize, rng: &mut Xoshiro256PlusPlus) -> Vec<i32> {
    let [first, last] = dimension.ends(scales);
    let count = (last - first + 1) as usize;
    let level = |at: usize| match dimension {
        Dimension::Zero if at.is_multiple_of(2) => 0,
        Dimension::Zero => 1 + (at / 2 % (count - 1)) as i32,
        _ => first + (at % count) as i32,
    };
    let mut levels: Vec<i32> = (0..n).map(level).collect();
    for at in (1..n).rev() {
        levels.swap(at, (rng.next_u64() % (at as u64 + 1)) as usize);
    }
    levels
}

/// Makes corners of the first settings: octave, distance and ratio at their ends, in every direction.
fn corners(columns: &mut [Vec<i32>; 9]) {
    let ends = [(Dimension::Octave, OCTAVES), (Dimension::Distance, DISTANCES), (Dimension::Ratio, RATIOS)];
    for direction in 0..DIRECTIONS {
        for corner in 0..8 {
            let at = (8 * direction + corner) as usize;
            for (bit, (dimension, ends)) in ends.into_iter().enumerate() {
                if let Some(level) = columns[dimension as usize].get_mut(at) {
                    *level = ends[(corner >> bit & 1) as usize];
                }
            }
            if let Some(level) = columns[Dimension::Direction as usize].get_mut(at) {
                *level = direction;
            }
        }
    }
}

/// Draws fragments of one setting.
pub(crate) struct Sampler<'a> {
    subject: &'a Subject<'a>,
    setting: &'a Setting,
}

impl<'a> Sampler<'a> {
    pub fn new(subject: &'a Subject<'a>, setting: &'a Setting) -> Self {
        Self { subject, setting }
    }

    /// Draws a fragment: a place of the setting, a surface of any direction through it, a scale between two octaves.
    pub fn fragment(&self, rng: &mut Xoshiro256PlusPlus) -> Fragment {
        let octave = f64::from(self.setting.level(Dimension::Octave)) + uniform01(rng);
        let [dpdx, dpdy] = self.derivatives(octave, rng);
        self.at(self.position(rng), dpdx, dpdy, rng)
    }

    /// The fragment of a place and its derivatives, at a pixel of the setting's surface.
    pub fn at(&self, position: DVec3, dpdx: DVec3, dpdy: DVec3, rng: &mut Xoshiro256PlusPlus) -> Fragment {
        let footprint = self.subject.precision.round(&Footprint { position, dpdx, dpdy });
        let step = rng.next_u64();
        let away = dvec2((step & 63) as f64, (step >> 6 & 63) as f64);
        let depth = 1024.0 * footprint.dpdx.length().max(footprint.dpdy.length());
        let pixel = dvec2(self.setting.pixel[0], self.setting.pixel[1]) + away;
        Fragment {
            footprint,
            world: footprint.position + self.setting.world,
            eye: ((pixel - dvec2(1920.0, 1080.0)) / 1024.0 * depth).extend(depth),
            pixel,
            texcoord: dvec2((step >> 12 & 0xffff) as f64, (step >> 28 & 0xffff) as f64) / 65536.0
                + DVec2::from_array(self.setting.tile),
            lod: f64::from(self.setting.level(Dimension::Lod)) + (step >> 44 & 0xff) as f64 / 256.0,
            frame: self.setting.frame,
            layer: self.setting.level(Dimension::Layer) as u32,
        }
    }

    /// Draws a place of the setting.
    pub fn position(&self, rng: &mut Xoshiro256PlusPlus) -> DVec3 {
        let largest = libm::exp2(f64::from(self.setting.level(Dimension::Distance)));
        let mut coordinate = |low: f64, high: f64| low + (high - low) * uniform01(rng);
        let direction = self.setting.level(Dimension::Direction);
        if direction < 8 {
            let mut position = DVec3::from_array([(); 3].map(|()| coordinate(0.0, 2.0 * largest)));
            let axis = coordinate(0.0, 3.0) as usize;
            position[axis] = coordinate(largest, 2.0 * largest);
            let sign = |bit: i32| if direction >> bit & 1 == 1 { -1.0 } else { 1.0 };
            return position * DVec3::new(sign(0), sign(1), sign(2));
        }
        let side = libm::exp2(f64::from(-self.setting.level(Dimension::Octave)));
        let beside = (BESIDE * side).min(largest * BESIDE_SHARE);
        let mut position = DVec3::from_array([(); 3].map(|()| coordinate(-beside, beside)));
        let sign = if direction < 11 { 1.0 } else { -1.0 };
        position[(direction - 8) as usize % 3] = sign * coordinate(largest, 2.0 * largest);
        position
    }

    /// Draws the derivatives of a surface whose cells lie so many octaves above one a unit.
    pub fn derivatives(&self, octave: f64, rng: &mut Xoshiro256PlusPlus) -> [DVec3; 2] {
        let ratio = self.setting.level(Dimension::Ratio);
        let longer_axis = |turn: &DMat3| if ratio >= 0 { turn.x_axis.abs() } else { turn.y_axis.abs() };
        let mut turn = rotation(rng);
        while self.setting.general
            && longer_axis(&turn).min_element() < LEAST_AXIS_SHARE * longer_axis(&turn).max_element()
        {
            turn = rotation(rng);
        }
        let mut axes = [turn.x_axis, turn.y_axis];
        let zero = self.setting.level(Dimension::Zero);
        let mut blank = |derivatives: &[usize], axis: i32| {
            for &derivative in derivatives {
                axes[derivative][axis as usize] = 0.0;
            }
        };
        match zero {
            4..7 => blank(&[0, 1], zero - 4),
            7..10 => blank(&[0], zero - 7),
            10..13 => blank(&[1], zero - 10),
            _ => {}
        }
        let [x, y] = axes.map(|axis| axis.try_normalize().unwrap_or(DVec3::ZERO));
        let longer = numerator(self.subject.variant) * libm::exp2(-octave) / self.subject.hash_scale;
        // From half of the level's ratio up to it.
        let shorter = longer * libm::exp2(-(f64::from(ratio.abs()) - uniform01(rng)).max(0.0));
        let [x, y] = if ratio >= 0 { [x * longer, y * shorter] } else { [x * shorter, y * longer] };
        match zero {
            1 => [DVec3::ZERO, y],
            2 => [x, DVec3::ZERO],
            3 => [DVec3::ZERO; 2],
            _ => [x, y],
        }
    }
}

/// The cells of samples so far, so that no two samples share one.
pub(crate) struct DistinctCells {
    /// Whether cells of different octaves with equal indices are one.
    regardless_of_octave: bool,
    /// Whether a threshold comes from the names of its intervals, and then whether cells begin between whole numbers.
    named: Option<bool>,
    /// The same where the children of a cell know of each other.
    has_kin: Option<bool>,
    used: FxHashSet<u64>,
}

impl DistinctCells {
    /// No cell yet. The hash of the listings does not tell octaves apart.
    pub fn new(subject: &Subject<'_>, draw: &Draw) -> Self {
        let has_names = subject.join == Join::Inherit && subject.variant == Variant::Anisotropic;
        Self {
            regardless_of_octave: draw.reach == Reach::Listings,
            named: has_names.then_some(subject.nested_phase),
            has_kin: subject.has_kin().then_some(subject.nested_phase),
            used: FxHashSet::default(),
        }
    }

    /// Claims the cells of a group of footprints that belong together; returns false, and claims none, if an earlier group, or
    /// another of the group, has one of them.
    pub fn claim(&mut self, group: &[Nominal]) -> bool {
        let mut keys = Vec::with_capacity(2 * group.len());
        for nominal in group {
            if let Some(nested_phase) = self.named {
                keys.extend(keys_of_names(nominal, nested_phase));
                continue;
            }
            let cells = match self.has_kin {
                Some(nested_phase) => [
                    (nominal.parent(nested_phase), nominal.coarse_scale.map(|scale| 0.5 * scale)),
                    (nominal.coarse_cell, nominal.coarse_scale),
                ],
                None => {
                    [(nominal.coarse_cell, nominal.coarse_scale), (nominal.fine_cell, nominal.fine_scale)]
                }
            };
            for (cell, scale) in cells {
                let mut hasher = FxHasher::default();
                cell.to_array().map(|index| index as i64).hash(&mut hasher);
                if !self.regardless_of_octave {
                    scale.map(f64::to_bits).hash(&mut hasher);
                }
                keys.push(hasher.finish());
            }
        }
        // A cell of one member may be that of another, as both octaves of one point in the cell around the origin.
        let fresh = !keys.iter().any(|key| self.used.contains(key));
        if fresh {
            self.used.extend(keys);
        }
        fresh
    }
}

/// Keys of the eight cells that a footprint may have by the names of its intervals, coarse or fine along each axis.
fn keys_of_names(nominal: &Nominal, nested_phase: bool) -> [u64; 8] {
    let name = |cell: DVec3, scale: [f64; 3], axis: usize| {
        named(cell[axis] as i32, libm::ilogb(scale[axis]), nested_phase)
    };
    let names = [0, 1, 2].map(|axis| {
        [
            name(nominal.coarse_cell, nominal.coarse_scale, axis),
            name(nominal.fine_cell, nominal.fine_scale, axis),
        ]
    });
    [0, 1, 2, 3, 4, 5, 6, 7].map(|corner: usize| {
        let mut hasher = FxHasher::default();
        [names[0][corner & 1], names[1][corner >> 1 & 1], names[2][corner >> 2]].hash(&mut hasher);
        hasher.finish()
    })
}

/// Draws up to `n` groups of fragments of a setting that share no cells with each other or with earlier ones; `group` makes a group
/// and says what cells it touches.
pub(crate) fn distinct<const N: usize>(
    n: usize,
    cells: &mut DistinctCells,
    mut group: impl FnMut() -> Option<([Fragment; N], [Nominal; N])>,
) -> Vec<[Fragment; N]> {
    let mut found = Vec::new();
    let mut tries = 0;
    while found.len() < n && tries < TRIES {
        tries += 1;
        if let Some((fragments, nominal)) = group()
            && cells.claim(&nominal)
        {
            found.push(fragments);
            tries = 0;
        }
    }
    found
}
