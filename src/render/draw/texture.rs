//! Textures: an alpha map with its mip chain, the colours that go with it, and how they are filtered.

pub use super::level::Level;
use super::level::{half, premultiply, tested};
pub use super::sampler::{Filter, Sampler, Wrap};
use crate::threshold::real::Real;
use glam::{Vec2, vec2};

/// The greatest number of probes of [`Filter::Anisotropic`]: what hardware goes to.
const MOST_PROBES: f32 = 16.0;

/// A texture before its mip chain is built.
#[derive(Clone, Debug)]
pub struct TextureSource {
    /// The levels that it comes with, the finest first; the others are made of it where it comes alone. Never empty.
    pub levels: Vec<Level>,
    /// How it is read.
    pub sampler: Sampler,
    /// The least alpha that its material's own test keeps; `None` for a material without a test, whose alpha is coverage.
    pub cutoff: Option<f32>,
}

impl TextureSource {
    /// One whose levels are made, of a material whose alpha is coverage.
    #[must_use]
    pub fn new(finest: Level, wrap: Wrap, filter: Filter) -> Self {
        Self { levels: vec![finest], sampler: Sampler::new(wrap, filter), cutoff: None }
    }
}

/// What a plan needs of textures.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TextureNeeds {
    /// What they should show, in place of what a device reads: a material's own test acts on the finest level alone, each
    /// texel of which becomes the share of it that is kept, and every coarser level is the mean of that.
    pub ideal: bool,
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

/// The threshold of the finest level, of which changes of the other levels keep the share, where a material has none of its
/// own.
const REFERENCE: f32 = 0.5;

/// A texture with every level down to one texel.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// The levels, the finest first; never empty.
    pub levels: Vec<Level>,
    /// How it is read.
    pub sampler: Sampler,
    /// The least alpha that its material's own test keeps, if it has one.
    pub cutoff: Option<f32>,
    /// The finest level as it was before its material's own test, where the levels show what that keeps.
    untested: Option<Level>,
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
    /// Builds the mip chain of a finest level by area averages, which keep the mean at every size; a texture that comes with
    /// levels of its own keeps those.
    ///
    /// Colours are averaged as they are, so that those of transparent texels bleed in, or weighted by alpha where they are
    /// multiplied by it (§7.3).
    #[must_use]
    pub fn new(source: &TextureSource, needs: &TextureNeeds) -> Self {
        let TextureSource { levels, mut sampler, cutoff } = source.clone();
        let (mut levels, untested) = match cutoff {
            Some(cutoff) if needs.ideal => {
                let shown = tested(&levels[0], cutoff, &sampler);
                (vec![shown], levels.into_iter().next())
            }
            Some(_) | None => (levels, None),
        };
        if needs.ideal && !sampler.has_levels {
            (sampler.has_levels, sampler.filter) = (true, Filter::Trilinear);
        }
        if needs.ideal || !sampler.has_levels {
            levels.truncate(1);
        }
        if needs.premultiplied {
            levels = levels.into_iter().map(premultiply).collect();
        }
        if sampler.has_levels && levels.len() == 1 {
            while let Some(next) = levels.last().and_then(half) {
                levels.push(next);
            }
        }
        let mut texture = Self { levels, sampler, cutoff, untested, thresholds: Vec::new() };
        needs.changes.iter().for_each(|change| (change.run)(&mut texture, change.parameter));
        texture
    }

    /// Returns the threshold of which changes of levels keep the share: that of its material's own test, else one half.
    #[must_use]
    pub fn reference(&self) -> f32 {
        self.cutoff.unwrap_or(REFERENCE)
    }

    /// Returns the share of a level, as this texture reads it where it is magnified, on which alpha is at least `cutoff`; [0, 1].
    #[must_use]
    pub fn share_kept(&self, level: &Level, cutoff: f32) -> f64 {
        tested(level, cutoff, &self.sampler).alphas().mean()
    }

    /// Returns what a material's own test makes of a place where a vertex colour multiplies alpha, [0, 1]: whether the finest level is
    /// kept there. `None` where the share that is kept around the place is to be read instead: of a texture that has no test or
    /// does not show it, and of one whose texels are smaller than a pixel, but for alphas that a vertex colour has changed.
    #[must_use]
    pub fn kept(&self, access: &Access, tint: f32, texels: &mut u64) -> Option<bool> {
        let (untested, cutoff) = (self.untested.as_ref()?, self.cutoff?);
        if tint == 1.0 && access.lod > 0.0 {
            return None;
        }
        let mut read = |level: &Level, at| {
            *texels += 1;
            [level.alpha[at]]
        };
        let [alpha] = match self.sampler.filter(0.0) {
            Filter::Nearest | Filter::NearestLinear => self.nearest(untested, access.texcoord, &mut read),
            Filter::Bilinear | Filter::Trilinear | Filter::Anisotropic => {
                self.bilinear(untested, access.texcoord, &mut read)
            }
        };
        Some(alpha * tint >= cutoff)
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
        if self.sampler.filter != Filter::Anisotropic {
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
        let between = |one: u64| if self.blend(access.lod).1 > 0.0 { 2 * one } else { one };
        let each = match self.sampler.filter(access.lod) {
            Filter::Nearest => 1,
            Filter::NearestLinear => between(1),
            Filter::Bilinear => 4,
            Filter::Trilinear | Filter::Anisotropic => between(4),
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
        match self.sampler.filter(lod) {
            Filter::Nearest => self.nearest(&self.levels[nearest()], place, texel),
            Filter::NearestLinear => {
                let (finer, weight) = self.blend(lod);
                let fine = self.nearest(&self.levels[finer], place, texel);
                if weight > 0.0 {
                    mix(fine, self.nearest(&self.levels[finer + 1], place, texel), weight)
                } else {
                    fine
                }
            }
            Filter::Bilinear => self.bilinear(&self.levels[nearest()], place, texel),
            Filter::Trilinear | Filter::Anisotropic => {
                let (finer, weight) = self.blend(lod);
                let fine = self.bilinear(&self.levels[finer], place, texel);
                if weight > 0.0 {
                    let coarse = self.bilinear(&self.levels[finer + 1], place, texel);
                    mix(fine, coarse, weight)
                } else {
                    fine
                }
            }
        }
    }

    fn nearest<const N: usize>(
        &self,
        level: &Level,
        place: Vec2,
        texel: &mut impl FnMut(&Level, usize) -> [f32; N],
    ) -> [f32; N] {
        let [x, y] = [0, 1].map(|axis| {
            let along = Real::floor(place[axis] * level.size[axis] as f32);
            self.sampler.wrap[axis].texel(along as i64, level.size[axis])
        });
        texel(level, level.index(x, y))
    }

    #[inline(always)]
    fn bilinear<const N: usize>(
        &self,
        level: &Level,
        place: Vec2,
        texel: &mut impl FnMut(&Level, usize) -> [f32; N],
    ) -> [f32; N] {
        let [columns, rows] = self.sampler.wrap;
        let (left, right, across) = columns.between(place.x, level.size[0]);
        let (top, bottom, down) = rows.between(place.y, level.size[1]);
        let mut at = |x, y| texel(level, level.index(x, y));
        let upper = mix(at(left, top), at(right, top), across);
        let lower = mix(at(left, bottom), at(right, bottom), across);
        mix(upper, lower, down)
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
        Texture::new(&TextureSource::new(finest, Wrap::Repeat, filter), &TextureNeeds::default())
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
        let filters = [
            Filter::Nearest,
            Filter::NearestLinear,
            Filter::Bilinear,
            Filter::Trilinear,
            Filter::Anisotropic,
        ];
        for (filter, magnified) in filters.into_iter().flat_map(|f| [(f, None), (f, Some(Filter::Nearest))]) {
            let mut texture = texture([64, 32], filter);
            texture.sampler.magnified = magnified;
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
        let source = TextureSource::new(finest, Wrap::Clamp, Filter::Trilinear);
        let of =
            |premultiplied| Texture::new(&source, &TextureNeeds { premultiplied, ..TextureNeeds::default() });
        let (straight, multiplied) = (of(false), of(true));
        assert_eq!(straight.levels[1].colour, [[30_000, 30_000, 0]]);
        assert_eq!(multiplied.levels[1].colour, [[0, 30_000, 0]]);
    }

    #[test]
    fn a_mirror_turns_round_at_every_edge() {
        let read = |at| Wrap::Mirror.texel(at, 3);
        assert_eq!((-4..8).map(read).collect::<Vec<_>>(), [2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0, 1]);
    }

    /// A ramp that is kept from a quarter on: where its interpolated alpha passes, not where a texel does.
    #[test]
    fn what_a_material_tests_is_shown_as_the_share_that_it_keeps() {
        let finest = Level { size: [2, 1], alpha: vec![0.0, 1.0], colour: Vec::new() };
        let source = |wrap| TextureSource {
            cutoff: Some(0.25),
            ..TextureSource::new(finest.clone(), wrap, Filter::Trilinear)
        };
        let ideal = TextureNeeds { ideal: true, ..TextureNeeds::default() };
        let of = |wrap, needs| Texture::new(&source(wrap), needs).levels;
        // Between the middles of the two texels, at 1/4 and 3/4, alpha is 0.25 at 3/8: all right of that is kept.
        assert_eq!(of(Wrap::Clamp, &ideal)[0].alpha, [0.25, 1.0]);
        // Repeated, the ramp rises on both sides of the clear texel.
        assert_eq!(of(Wrap::Repeat, &ideal)[0].alpha, [0.5, 1.0]);
        assert_eq!(of(Wrap::Repeat, &ideal)[1].alpha, [0.75]);
        // What a device reads is what was stored.
        assert_eq!(of(Wrap::Repeat, &TextureNeeds::default())[0].alpha, [0.0, 1.0]);
    }

    #[test]
    fn levels_of_a_file_stay_and_a_sampler_without_has_the_finest() {
        let level =
            |size, alpha| Level { size: [size, 1], alpha: vec![alpha; size as usize], colour: Vec::new() };
        let mut source = TextureSource::new(level(4, 0.5), Wrap::Clamp, Filter::Bilinear);
        source.levels.push(level(2, 0.9));
        let sides = |source: &TextureSource, needs: &TextureNeeds| -> Vec<(u32, f32)> {
            let texture = Texture::new(source, needs);
            texture.levels.iter().map(|level| (level.size[0], level.alpha[0])).collect()
        };
        let ideal = TextureNeeds { ideal: true, ..TextureNeeds::default() };
        assert_eq!(sides(&source, &TextureNeeds::default()), [(4, 0.5), (2, 0.9)]);
        assert_eq!(sides(&source, &ideal), [(4, 0.5), (2, 0.5), (1, 0.5)]);
        source.sampler.has_levels = false;
        assert_eq!(sides(&source, &TextureNeeds::default()), [(4, 0.5)]);
        assert_eq!(sides(&source, &ideal), [(4, 0.5), (2, 0.5), (1, 0.5)]);
    }
}
