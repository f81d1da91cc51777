//! Textures: an alpha map with its mip chain, the colours that go with it, and how they are filtered.

pub use super::level::Level;
use super::level::{half, premultiply};
use crate::threshold::real::Real;
use glam::{Vec2, vec2};
use serde::Deserialize;

/// What lies beyond the edge of a texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Wrap {
    /// The texture again.
    Repeat,
    /// Its outermost texel.
    #[default]
    Clamp,
}

/// How texels become one value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Filter {
    /// The nearest texel of the nearest level.
    Nearest,
    /// Four texels of the nearest level.
    Bilinear,
    /// Four texels of each of the two nearest levels.
    #[default]
    Trilinear,
    /// Up to 16 trilinear probes along the longer axis of the footprint.
    Anisotropic,
}

/// The greatest number of probes of [`Filter::Anisotropic`]: what hardware goes to.
const MOST_PROBES: f32 = 16.0;

/// A texture before its mip chain is built.
#[derive(Clone, Debug)]
pub struct TextureSource {
    /// Its finest level.
    pub finest: Level,
    /// What lies beyond its edge.
    pub wrap: Wrap,
    /// How texels become one value.
    pub filter: Filter,
}

/// What a plan needs of textures.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TextureNeeds {
    /// Colours multiplied by alpha (§7.3).
    pub premultiplied: bool,
    /// What is done to them before the first frame, in this order.
    pub changes: Vec<Change>,
}

/// A change of textures before the first frame; two are the same if they are called so and have one parameter.
#[derive(Clone, Copy, Debug)]
pub struct Change {
    /// What it is called.
    pub name: &'static str,
    /// What it depends on.
    pub parameter: usize,
    /// Changes a texture by the parameter.
    pub run: fn(&mut Texture, usize),
}

impl PartialEq for Change {
    fn eq(&self, other: &Self) -> bool {
        (self.name, self.parameter) == (other.name, other.parameter)
    }
}

/// The threshold of the finest level, of which changes of the other levels keep the share.
pub const REFERENCE: f32 = 0.5;

/// A texture with every level down to one texel.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// The levels, the finest first; never empty.
    pub levels: Vec<Level>,
    /// What lies beyond the edge.
    pub wrap: Wrap,
    /// How texels become one value.
    pub filter: Filter,
    /// A threshold for each level (Eq. 1); empty unless asked for.
    pub thresholds: Vec<f32>,
}

/// Where and how coarsely a texture is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Access {
    /// Texture coordinate, [0, 1] across the texture.
    pub texcoord: Vec2,
    /// Level of detail that the filter reads, log2 of texels per probe; not yet limited to the levels that exist.
    pub lod: f32,
    /// Number of probes.
    pub probes: u32,
    /// From one probe to the next, in texture coordinates.
    pub step: Vec2,
}

impl Texture {
    /// Builds the mip chain of a finest level by area averages, which keep the mean at every size.
    ///
    /// Colours are averaged as they are, so that those of transparent texels bleed in, or weighted by alpha where they are
    /// multiplied by it (§7.3).
    #[must_use]
    pub fn new(source: &TextureSource, needs: &TextureNeeds) -> Self {
        let TextureSource { finest, wrap, filter } = source.clone();
        let mut levels = vec![if needs.premultiplied { premultiply(finest) } else { finest }];
        while let Some(next) = levels.last().and_then(half) {
            levels.push(next);
        }
        let mut texture = Self { levels, wrap, filter, thresholds: Vec::new() };
        needs.changes.iter().for_each(|change| (change.run)(&mut texture, change.parameter));
        texture
    }

    /// Returns where to read for a texture coordinate with its two screen derivatives (texture coordinates per pixel).
    #[must_use]
    pub fn access(&self, texcoord: Vec2, dtdx: Vec2, dtdy: Vec2) -> Access {
        let [width, height] = self.levels[0].size.map(|side| side as f32);
        let size = vec2(width, height);
        let (along_x, along_y) = ((dtdx * size).length(), (dtdy * size).length());
        let (long, short, axis) =
            if along_x < along_y { (along_y, along_x, dtdy) } else { (along_x, along_y, dtdx) };
        // A footprint without extent reads the finest level.
        let lod = |texels: f32| libm::log2f(texels.max(f32::MIN_POSITIVE));
        if self.filter != Filter::Anisotropic {
            return Access { texcoord, lod: lod(long), probes: 1, step: Vec2::ZERO };
        }
        let ratio = long / short;
        // A quotient of zeros is no anisotropy.
        let probes = if ratio.is_nan() { 1.0 } else { ratio.ceil().clamp(1.0, MOST_PROBES) };
        Access { texcoord, lod: lod(long / probes), probes: probes as u32, step: axis / probes }
    }

    /// Returns the number of texels that [`Texture::alpha`] reads for an access.
    #[must_use]
    pub fn texels(&self, access: &Access) -> u64 {
        let each = match self.filter {
            Filter::Nearest => 1,
            Filter::Bilinear => 4,
            Filter::Trilinear | Filter::Anisotropic => {
                if self.blend(access.lod).1 > 0.0 {
                    8
                } else {
                    4
                }
            }
        };
        each * u64::from(access.probes)
    }

    /// Returns the filtered alpha, in [0, 1], and adds to `texels` the number of texels that were read.
    #[must_use]
    pub fn alpha(&self, access: &Access, texels: &mut u64) -> f32 {
        let [alpha] = self.probe(access, |level, at| {
            *texels += 1;
            [level.alpha[at]]
        });
        alpha
    }

    /// Returns the filtered colour, or `None` for a texture that has none; multiplied by alpha if the texture is.
    #[must_use]
    pub fn colour(&self, access: &Access) -> Option<[f32; 3]> {
        if self.levels[0].colour.is_empty() {
            return None;
        }
        Some(self.probe(access, |level, at| level.colour[at].map(|share| f32::from(share) / 65535.0)))
    }

    /// Returns the threshold of an access: that of its level, mixed between two as alpha is; infinite where nothing may
    /// pass.
    ///
    /// Without thresholds it is one half.
    #[must_use]
    pub fn level_threshold(&self, access: &Access) -> f32 {
        let (finer, weight) = self.blend(access.lod);
        let of = |level: usize| self.thresholds.get(level).copied().unwrap_or(0.5);
        if weight > 0.0 { (1.0 - weight) * of(finer) + weight * of(finer + 1) } else { of(finer) }
    }

    /// Filters what `texel` says of a level and the index of a texel.
    fn probe<const N: usize>(
        &self,
        access: &Access,
        mut texel: impl FnMut(&Level, usize) -> [f32; N],
    ) -> [f32; N] {
        let mut sum = [0.0; N];
        for probe in 0..access.probes {
            let place = access.texcoord + access.step * (probe as f32 - (access.probes - 1) as f32 * 0.5);
            let value = self.filtered(place, access.lod, &mut texel);
            sum.iter_mut().zip(value).for_each(|(sum, value)| *sum += value);
        }
        sum.map(|component| component / access.probes as f32)
    }

    /// The finer level of a trilinear access and the weight of the coarser one.
    #[inline]
    fn blend(&self, lod: f32) -> (usize, f32) {
        let last = (self.levels.len() - 1) as f32;
        let lod = lod.clamp(0.0, last);
        let finer = lod as usize;
        (finer, lod - finer as f32)
    }

    #[inline(always)]
    fn filtered<const N: usize>(
        &self,
        place: Vec2,
        lod: f32,
        texel: &mut impl FnMut(&Level, usize) -> [f32; N],
    ) -> [f32; N] {
        let nearest = || self.blend(lod.max(0.0) + 0.5).0.min(self.levels.len() - 1);
        match self.filter {
            Filter::Nearest => {
                let level = &self.levels[nearest()];
                let [x, y] = [0, 1].map(|axis| {
                    let along = Real::floor(place[axis] * level.size[axis] as f32);
                    self.wrap.texel(along as i64, level.size[axis])
                });
                texel(level, level.index(x, y))
            }
            Filter::Bilinear => self.bilinear(nearest(), place, texel),
            Filter::Trilinear | Filter::Anisotropic => {
                let (finer, weight) = self.blend(lod);
                let fine = self.bilinear(finer, place, texel);
                if weight > 0.0 {
                    let coarse = self.bilinear(finer + 1, place, texel);
                    mix(fine, coarse, weight)
                } else {
                    fine
                }
            }
        }
    }

    #[inline(always)]
    fn bilinear<const N: usize>(
        &self,
        level: usize,
        place: Vec2,
        texel: &mut impl FnMut(&Level, usize) -> [f32; N],
    ) -> [f32; N] {
        let level = &self.levels[level];
        let (left, right, across) = self.wrap.between(place.x, level.size[0]);
        let (top, bottom, down) = self.wrap.between(place.y, level.size[1]);
        let mut at = |x, y| texel(level, level.index(x, y));
        let upper = mix(at(left, top), at(right, top), across);
        let lower = mix(at(left, bottom), at(right, bottom), across);
        mix(upper, lower, down)
    }
}

impl Wrap {
    /// The texel that is read for a place along a side of so many, inside the texture or not.
    fn texel(self, at: i64, side: u32) -> usize {
        let side = i64::from(side);
        if (0..side).contains(&at) {
            return at as usize;
        }
        let inside = match self {
            Self::Repeat => at.rem_euclid(side),
            Self::Clamp => at.clamp(0, side - 1),
        };
        inside as usize
    }

    /// The two texels along a side of so many between whose middles a place lies, [0, 1] across the texture, and how far it is
    /// from the first.
    #[inline(always)]
    fn between(self, place: f32, side: u32) -> (usize, usize, f32) {
        let along = place * side as f32 - 0.5;
        // Most places lie between two texels that are there, where rounding is towards zero.
        if along >= 0.0 && along < (side - 1) as f32 {
            let first = along as i32;
            return (first as usize, first as usize + 1, along - first as f32);
        }
        let first = Real::floor(along);
        (self.texel(first as i64, side), self.texel(first as i64 + 1, side), along - first)
    }
}

#[inline]
fn mix<const N: usize>(mut a: [f32; N], b: [f32; N], weight: f32) -> [f32; N] {
    for (a, b) in a.iter_mut().zip(b) {
        *a += (b - *a) * weight;
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texture(size: [u32; 2], filter: Filter) -> Texture {
        let alpha = (0..size[0] * size[1]).map(|i| f32::from((i * 7 % 11) as u8) / 10.0).collect();
        let finest = Level { size, alpha, colour: Vec::new() };
        Texture::new(&TextureSource { finest, wrap: Wrap::Repeat, filter }, &TextureNeeds::default())
    }

    #[test]
    fn every_level_keeps_the_mean_and_the_last_is_one_texel() {
        for size in [[64, 64], [7, 5], [65_535, 1], [1, 3]] {
            let texture = texture(size, Filter::Trilinear);
            let mean = texture.levels[0].alphas().mean();
            assert!(
                texture.levels.iter().all(|level| (level.alphas().mean() - mean).abs() < 1e-6),
                "{size:?}"
            );
            assert_eq!(texture.levels.last().map(|level| level.size), Some([1, 1]));
        }
    }

    #[test]
    fn the_texels_that_are_announced_are_read() {
        for filter in [Filter::Nearest, Filter::Bilinear, Filter::Trilinear, Filter::Anisotropic] {
            let texture = texture([64, 32], filter);
            for step in 0..200 {
                let dtdx = vec2(0.001 * step as f32, 0.002);
                let access = texture.access(vec2(0.3, 0.7 + dtdx.x), dtdx, vec2(0.0, 0.01));
                let mut read = 0;
                let alpha = texture.alpha(&access, &mut read);
                assert!((0.0..=1.0).contains(&alpha));
                assert_eq!(read, texture.texels(&access), "{filter:?} {access:?}");
            }
        }
    }

    #[test]
    fn anisotropic_probes_read_finer_levels() {
        let [plain, probing] =
            [Filter::Trilinear, Filter::Anisotropic].map(|filter| texture([256, 256], filter));
        let (dtdx, dtdy) = (vec2(0.1, 0.0), vec2(0.0, 0.01));
        let [coarse, fine] = [&plain, &probing].map(|texture| texture.access(Vec2::ZERO, dtdx, dtdy));
        assert!((coarse.lod - libm::log2f(25.6)).abs() < 1e-5);
        assert!((fine.lod - coarse.lod + libm::log2f(10.0)).abs() < 1e-5 && fine.probes == 10, "{fine:?}");
    }

    #[test]
    fn colours_of_transparent_texels_bleed_unless_premultiplied() {
        let finest =
            Level { size: [2, 1], alpha: vec![1.0, 0.0], colour: vec![[0, 60_000, 0], [60_000, 0, 0]] };
        let source = TextureSource { finest, wrap: Wrap::Clamp, filter: Filter::Trilinear };
        let of =
            |premultiplied| Texture::new(&source, &TextureNeeds { premultiplied, ..TextureNeeds::default() });
        let (straight, multiplied) = (of(false), of(true));
        assert_eq!(straight.levels[1].colour, [[30_000, 30_000, 0]]);
        assert_eq!(multiplied.levels[1].colour, [[0, 30_000, 0]]);
    }
}
