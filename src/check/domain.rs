//! The domain of a claim: what of all footprints, frames and layers it has sampled, as it was measured.

use crate::scene::Fragment;
use crate::threshold::real::Real;
use core::fmt;
use core::ops::RangeInclusive;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Frames that are kept; further ones are not.
const FRAMES_LIMIT: usize = 4096;

/// A set of whole numbers from -64 to 63; what lies beyond counts as its nearest end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Levels(u128);

impl Levels {
    const LEAST: i32 = -64;

    /// Adds a number.
    pub fn add(&mut self, level: i32) {
        self.0 |= 1 << (level.clamp(Self::LEAST, 63) - Self::LEAST);
    }

    /// Adds all numbers of another set.
    pub fn extend(&mut self, other: Self) {
        self.0 |= other.0;
    }

    /// Returns whether a number is in the set.
    #[must_use]
    pub fn contains(self, level: i32) -> bool {
        (Self::LEAST..64).contains(&level) && self.0 >> (level - Self::LEAST) & 1 == 1
    }

    /// Returns the numbers as ranges without gaps, both ends included, the smallest first.
    #[must_use]
    pub fn ranges(self) -> Vec<RangeInclusive<i32>> {
        let mut ranges: Vec<RangeInclusive<i32>> = Vec::new();
        for level in (Self::LEAST..64).filter(|&level| self.contains(level)) {
            match ranges.last_mut() {
                Some(last) if *last.end() == level - 1 => *last = *last.start()..=level,
                _ => ranges.push(level..=level),
            }
        }
        ranges
    }
}

/// As in "-3..5, 8": ranges with both ends; a dash for none.
impl fmt::Display for Levels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ranges = self.ranges();
        let words: Vec<String> = ranges
            .iter()
            .map(|range| {
                let (first, last) = (range.start(), range.end());
                if first == last { first.to_string() } else { format!("{first}..{last}") }
            })
            .collect();
        f.pad(&if words.is_empty() { "-".to_owned() } else { words.join(", ") })
    }
}

/// What one claim has asked a subject for, over all its samples: measured where the subject is called, so that it says what
/// was sampled and not what was meant to be.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Domain {
    /// Thresholds that were asked for.
    pub n: u64,
    /// Octaves of the cells: floor(log2(1 / (hash scale * longer derivative))), so that 2^octave cells of the claimed size
    /// fit into an object unit.
    pub octaves: Levels,
    /// Distance from the object's origin: floor(log2) of the largest coordinate, in object units.
    pub distances: Levels,
    /// Octants in which positions lie, one bit each: bit 0 for negative x, 1 for negative y, 2 for negative z.
    octants: u8,
    /// Half axes on which positions lie: all other coordinates below 2^-10 of the largest one. Bits 0, 1, 2 for positive x, y, z,
    /// then negative ones.
    half_axes: u8,
    /// Ratio of the derivatives: log2(|dpdx| / |dpdy|), towards 0.
    pub ratios: Levels,
    /// Which components of dpdx (x, y, z) and dpdy are zero, as a number of six bits: a set of such numbers.
    zeros: u64,
    /// Levels of detail, rounded down.
    pub lods: Levels,
    /// Indices of layers.
    pub layers: Levels,
    /// Frames, up to 4096 of them.
    pub frames: BTreeSet<u32>,
    /// The one that was added last: most fragments have that of the one before.
    last_frame: Option<u32>,
    /// Hash scales, as bits of `f64`.
    hash_scales: BTreeSet<u64>,
    /// Smallest and largest pixel coordinate along both axes.
    pub pixels: Option<[f64; 2]>,
    /// Smallest and largest texture coordinate along both axes.
    pub texcoords: Option<[f64; 2]>,
}

/// Fragments that one thread looks at in turn. Which frames are kept where there are too many depends on it, and on nothing else.
const AT_ONCE: usize = 1 << 14;

impl Domain {
    /// Adds what a subject of a hash scale is asked for; the same on any number of threads.
    pub(crate) fn add_all<F: Copy + Into<Fragment> + Sync>(&mut self, fragments: &[F], hash_scale: f64) {
        let of = |fragments: &[F]| {
            let mut domain = Self::default();
            domain.hash_scales.insert(hash_scale.to_bits());
            fragments.iter().for_each(|&fragment| domain.add(&fragment.into(), hash_scale));
            domain
        };
        let parts: Vec<Self> = fragments.par_chunks(AT_ONCE).map(of).collect();
        parts.iter().for_each(|part| self.extend(part));
    }

    #[inline(always)]
    fn add(&mut self, fragment: &Fragment, hash_scale: f64) {
        self.n += 1;
        let footprint = &fragment.footprint;
        let lengths = [footprint.dpdx.length(), footprint.dpdy.length()];
        let longer = hash_scale * lengths[0].max(lengths[1]);
        if longer > 0.0 && longer.is_finite() {
            self.octaves.add(floor_log2(1.0 / longer));
        }
        if lengths[0] > 0.0 && lengths[1] > 0.0 {
            let ratio = lengths[0] / lengths[1];
            if ratio.is_finite() && ratio > 0.0 {
                self.ratios.add(if ratio < 1.0 { -floor_log2(1.0 / ratio) } else { floor_log2(ratio) });
            }
        }
        let zeros = |v: DVec3| u64::from(v.cmpeq(DVec3::ZERO).bitmask());
        self.zeros |= 1 << (zeros(footprint.dpdx) | zeros(footprint.dpdy) << 3);
        let position = footprint.position.abs();
        let distance = position.max_element();
        if distance > 0.0 && distance.is_finite() {
            self.distances.add(floor_log2(distance));
            let signs = footprint.position.cmplt(DVec3::ZERO).bitmask();
            self.octants |= 1 << signs;
            let large = (position * 1024.0).cmpge(DVec3::splat(distance)).bitmask();
            if large.is_power_of_two() {
                let axis = large.trailing_zeros();
                self.half_axes |= 1 << (axis + 3 * (signs >> axis & 1));
            }
        }
        if fragment.lod.is_finite() {
            self.lods.add(Real::floor(fragment.lod) as i32);
        }
        self.layers.add(i32::try_from(fragment.layer).unwrap_or(i32::MAX));
        if self.last_frame != Some(fragment.frame) {
            self.last_frame = Some(fragment.frame);
            self.add_frame(fragment.frame);
        }
        widen(&mut self.pixels, fragment.pixel.to_array());
        widen(&mut self.texcoords, fragment.texcoord.to_array());
    }

    fn add_frame(&mut self, frame: u32) {
        if self.frames.len() < FRAMES_LIMIT {
            self.frames.insert(frame);
        }
    }

    /// Adds what another part of the same claim, or the same claim on another subject, has sampled.
    pub fn extend(&mut self, other: &Self) {
        self.n += other.n;
        self.octaves.extend(other.octaves);
        self.distances.extend(other.distances);
        self.octants |= other.octants;
        self.half_axes |= other.half_axes;
        self.ratios.extend(other.ratios);
        self.zeros |= other.zeros;
        self.lods.extend(other.lods);
        self.layers.extend(other.layers);
        other.frames.iter().for_each(|&frame| self.add_frame(frame));
        self.hash_scales.extend(&other.hash_scales);
        other.pixels.into_iter().for_each(|ends| widen(&mut self.pixels, ends));
        other.texcoords.into_iter().for_each(|ends| widen(&mut self.texcoords, ends));
    }

    /// The number of octants in which positions lie, up to 8.
    #[must_use]
    pub fn octants(&self) -> u32 {
        self.octants.count_ones()
    }

    /// The number of half axes on which positions lie, up to 6.
    #[must_use]
    pub fn half_axes(&self) -> u32 {
        self.half_axes.count_ones()
    }

    /// The hash scales, the smallest first.
    #[must_use]
    pub fn hash_scales(&self) -> Vec<f64> {
        self.hash_scales.iter().map(|&bits| f64::from_bits(bits)).collect()
    }

    /// Which derivatives are zero in some sample: a whole one ("dpdx", "dpdy", "both"), both along one axis ("along x"), or one
    /// component alone ("dpdx.y").
    #[must_use]
    pub fn zero_derivatives(&self) -> Vec<&'static str> {
        const NAMES: [&str; 12] = [
            "dpdx", "dpdy", "both", "along x", "along y", "along z", "dpdx.x", "dpdx.y", "dpdx.z", "dpdy.x",
            "dpdy.y", "dpdy.z",
        ];
        let seen = (0..64_u32).filter(|mask| self.zeros >> mask & 1 == 1);
        let is_named = |mask: u32, name: usize| {
            let (dpdx, dpdy) = (mask & 7, mask >> 3);
            match name {
                0 => dpdx == 7 && dpdy != 7,
                1 => dpdx != 7 && dpdy == 7,
                2 => mask == 63,
                3..6 => dpdx != 7 && dpdy != 7 && dpdx & dpdy == 1 << (name - 3),
                _ => mask == 1 << (name - 6),
            }
        };
        let named = |name: &usize| seen.clone().any(|mask| is_named(mask, *name));
        (0..NAMES.len()).filter(named).map(|name| NAMES[name]).collect()
    }

    /// The frames in words: those that follow each other from the first one, and how many others, as in "0..63 +64".
    #[must_use]
    pub fn frames_in_words(&self) -> String {
        let first = (0..).take_while(|frame| self.frames.contains(frame)).count();
        let consecutive = match first {
            0 => String::new(),
            1 => "0".to_owned(),
            _ => format!("0..{}", first - 1),
        };
        match self.frames.len() - first {
            0 => consecutive,
            others if first == 0 => format!("+{others}"),
            others => format!("{consecutive} +{others}"),
        }
    }
}

/// The domain in one line, as in "octaves -3..5; |p| 2^-1..2^9 in 8 octants; ...".
impl fmt::Display for Domain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "octaves {}; |p| 2^({}), {} octants", self.octaves, self.distances, self.octants())?;
        if self.half_axes > 0 {
            write!(f, " and {} half axes", self.half_axes())?;
        }
        write!(f, "; ratios 2^({})", self.ratios)?;
        let zero = self.zero_derivatives();
        if !zero.is_empty() {
            write!(f, ", zero {}", zero.join(", "))?;
        }
        write!(f, "; lod {}; layers {}; frames {}", self.lods, self.layers, self.frames_in_words())?;
        let scales: Vec<String> = self.hash_scales().iter().map(ToString::to_string).collect();
        write!(f, "; hash scale {}", scales.join(", "))
    }
}

fn widen(ends: &mut Option<[f64; 2]>, values: [f64; 2]) {
    let [low, high] = ends.unwrap_or([f64::INFINITY, f64::NEG_INFINITY]);
    let finite = values.into_iter().filter(|value| value.is_finite());
    let found = finite.fold([low, high], |[low, high], value| [low.min(value), high.max(value)]);
    *ends = (found[0] <= found[1]).then_some(found);
}

/// The greatest whole number not above log2 of a positive finite number.
fn floor_log2(x: f64) -> i32 {
    const MANTISSA: u32 = f64::MANTISSA_DIGITS - 1;
    if x < f64::MIN_POSITIVE {
        libm::frexp(x).1 - 1
    } else {
        (x.to_bits() >> MANTISSA) as i32 - f64::MAX_EXP + 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::threshold::footprint::Footprint;
    use glam::dvec3;

    #[test]
    fn the_exponent_is_that_of_the_logarithm() {
        for x in [1.0, 1.9, 2.0, 0.75, 3e300, 1e-300, 4e-320, f64::MIN_POSITIVE] {
            assert_eq!(floor_log2(x), libm::frexp(x).1 - 1, "{x:e}");
        }
    }

    #[test]
    fn levels_are_told_as_ranges() {
        let mut levels = Levels::default();
        assert_eq!(levels.to_string(), "-");
        [-100, -3, -2, 5, 6, 7, 9, 1000].into_iter().for_each(|level| levels.add(level));
        assert_eq!(levels.to_string(), "-64, -3..-2, 5..7, 9, 63");
    }

    #[test]
    fn what_was_asked_for_is_what_is_told() {
        let mut domain = Domain::default();
        let footprint =
            Footprint { position: dvec3(-300.0, 0.01, 0.02), dpdx: DVec3::X * 0.125, dpdy: DVec3::Z * 0.02 };
        domain.add_all(&[Fragment { lod: -0.5, layer: 2, ..Fragment::from(footprint) }], 1.0);
        let still = Footprint { dpdx: DVec3::ZERO, ..footprint };
        domain.add_all(&[Fragment { frame: 9, ..Fragment::from(still) }], 2.0);
        assert_eq!(
            domain.to_string(),
            "octaves 3..4; |p| 2^(8), 1 octants and 1 half axes; ratios 2^(2), zero dpdx, along y; lod -1..0; layers 0, 2; \
             frames 0 +1; hash scale 1, 2"
        );
    }
}
