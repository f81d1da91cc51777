//! Screen-door transparency: strata of a threshold over a tile of pixels in place of the samples of one (§3, §8.1).

use super::coverage::{Permutation, jittered, regular};
use crate::threshold::hash::mm4::murmur3;
use crate::threshold::hash::open_lattice;
use crate::threshold::real::Real;
use core::num::NonZeroU32;

/// Pixels along each side of a tile.
pub const TILE: u32 = 4;
/// The same of [`bayer`].
const BAYER_TILE: u32 = 8;
const STRATA: NonZeroU32 = NonZeroU32::new(TILE * TILE).unwrap();

/// Which threshold a pixel of a tile of 4 x 4 has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ScreenDoor {
    /// The ordered dither, the same in every tile and for every layer, [`fixed`].
    Fixed,
    /// The same over 8 x 8 pixels, [`bayer`].
    Bayer,
    /// An order that this seed draws, the same in every tile and for every layer, [`random_mask`].
    RandomMask(u32),
    /// Strata that are permuted and jittered for each tile and layer, [`randomised`].
    Randomised,
}

impl ScreenDoor {
    /// Every pattern, in the order in which they are listed to users; the random order is that of seed 0.
    pub const ALL: [Self; 4] = [Self::Fixed, Self::Bayer, Self::RandomMask(0), Self::Randomised];

    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Bayer => "bayer",
            Self::RandomMask(_) => "random",
            Self::Randomised => "hashed",
        }
    }

    /// Pixels along each side of a tile.
    #[must_use]
    pub const fn tile(self) -> u32 {
        match self {
            Self::Fixed | Self::RandomMask(_) | Self::Randomised => TILE,
            Self::Bayer => BAYER_TILE,
        }
    }

    /// The number of hashes of one threshold: two for the order of the tile's strata, one within the pixel's own.
    #[must_use]
    pub const fn hashes(self) -> u64 {
        match self {
            Self::Fixed | Self::Bayer | Self::RandomMask(_) => 0,
            Self::Randomised => 3,
        }
    }

    pub(in crate::threshold) fn threshold<R: Real>(self, pixel: [u32; 2], layer: u32) -> R {
        match self {
            Self::Fixed => fixed(pixel),
            Self::Bayer => bayer(pixel),
            Self::RandomMask(seed) => random_mask(pixel, seed),
            Self::Randomised => randomised(pixel, layer),
        }
    }

    /// Writes the thresholds of many pixels; only one of the patterns reads their layers.
    pub(in crate::threshold) fn thresholds<R: Real>(self, pixel: &[[u32; 2]], layer: &[u32], out: &mut [R]) {
        assert_eq!(pixel.len(), out.len(), "columns of unequal length");
        let pixels = out.iter_mut().zip(pixel);
        match self {
            Self::Fixed => pixels.for_each(|(out, &pixel)| *out = fixed(pixel)),
            Self::Bayer => pixels.for_each(|(out, &pixel)| *out = bayer(pixel)),
            Self::RandomMask(seed) => {
                // One mask for the whole screen.
                let mask: [R; STRATA.get() as usize] =
                    core::array::from_fn(|k| random_mask([k as u32 % TILE, k as u32 / TILE], seed));
                pixels.for_each(|(out, &pixel)| *out = mask[place(pixel) as usize]);
            }
            Self::Randomised => {
                assert_eq!(pixel.len(), layer.len(), "columns of unequal length");
                pixels.zip(layer).for_each(|((out, &pixel), &layer)| *out = randomised(pixel, layer));
            }
        }
    }
}

/// Returns the threshold of a pixel under a fixed mask: the ordered dither of 4 x 4 pixels, `(k + 1/2) / 16` (Mulder et
/// al. 1998). The same in every tile and for every layer.
#[must_use]
pub fn fixed<R: Real>(pixel: [u32; 2]) -> R {
    regular(ordered(pixel), STRATA)
}

/// Returns the threshold of a pixel under the ordered dither of 8 x 8 pixels, `(k + 1/2) / 64` (Bayer 1973): what many engines
/// call a dithered fade. Finer steps of coverage than [`fixed`], and the same fault: one mask for every layer. Not in the paper.
#[must_use]
pub fn bayer<R: Real>(pixel: [u32; 2]) -> R {
    const STRATA: NonZeroU32 = NonZeroU32::new(BAYER_TILE * BAYER_TILE).unwrap();
    regular(interleaved(pixel, BAYER_TILE.ilog2()), STRATA)
}

/// Returns the threshold of a pixel under one random mask for the whole screen: the strata of the tile in an order that
/// `seed` draws. §3: "even random mask patterns lead to correlation between composited layers".
#[must_use]
pub fn random_mask<R: Real>(pixel: [u32; 2], seed: u32) -> R {
    let word = |k: u32| murmur3([k, seed, 0, 0]);
    let own = place(pixel);
    // The rank of the own word among all: a permutation but for equal words, of which the earlier goes first.
    let rank = (0..STRATA.get()).filter(|&k| (word(k), k) < (word(own), own)).count();
    regular(rank as u32, STRATA)
}

/// Returns the threshold of a pixel with strata permuted and jittered for each tile and layer, Eqs. 8 and 9 between
/// pixels; in [2^-24, 1]. §8.1.
///
/// `layer` is any word that tells overlapping surfaces apart, as a hash of their place does.
#[must_use]
pub fn randomised<R: Real>(pixel: [u32; 2], layer: u32) -> R {
    let tile = pixel.map(|c| c / TILE);
    let hash = |which: u32| open_lattice::<R>(murmur3([tile[0], tile[1], layer, which]));
    let stratum = Permutation::drawn([hash(0), hash(1)], STRATA).stratum(ordered(pixel));
    jittered(hash(2 + place(pixel)), stratum, STRATA)
}

/// Returns the number of a pixel within its tile, row after row.
fn place(pixel: [u32; 2]) -> u32 {
    pixel[1] % TILE * TILE + pixel[0] % TILE
}

/// Returns the place of a pixel in the ordered dither of 4 x 4.
fn ordered(pixel: [u32; 2]) -> u32 {
    interleaved(pixel, TILE.ilog2())
}

/// Returns the place of a pixel in the ordered dither over so many bits of each coordinate: the bits of x xor y and of y,
/// interleaved from the lowest.
fn interleaved([x, y]: [u32; 2], bits: u32) -> u32 {
    let mixed = x ^ y;
    (0..bits).fold(0, |place, bit| place << 2 | (mixed >> bit & 1) << 1 | (y >> bit & 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixels() -> impl Iterator<Item = [u32; 2]> {
        (0..64 * 64).map(|i| [i % 64, i / 64])
    }

    fn union(layers: u32, threshold: impl Fn([u32; 2], u32) -> f64) -> f64 {
        let covered = pixels().filter(|&p| (0..layers).any(|layer| 0.5 >= threshold(p, layer)));
        covered.count() as f64 / 4096.0
    }

    #[test]
    fn each_tile_holds_each_stratum_once() {
        for layer in 0..3 {
            let of = |i: u32| [4 + i % TILE, 8 + i / TILE];
            let thresholds: [fn([u32; 2], u32) -> f64; 3] =
                [|p, _| fixed(p), |p, _| random_mask(p, 7), randomised];
            for threshold in thresholds {
                let mut strata: Vec<_> = (0..16).map(|i| (threshold(of(i), layer) * 16.0) as u32).collect();
                strata.sort_unstable();
                assert!(strata.into_iter().eq(0..16));
            }
        }
        assert_eq!((0..4).map(|x| ordered([x, 0])).collect::<Vec<_>>(), [0, 8, 2, 10]);
    }

    /// The matrix of Bayer 1973, in its first row and its first column, and each of its steps once.
    #[test]
    fn the_larger_dither_is_that_of_bayer() {
        let step = |x, y| (64.0 * bayer::<f64>([x, y])) as u32;
        assert_eq!([0, 1, 2, 3, 4, 5, 6, 7].map(|x| step(x, 0)), [0, 32, 8, 40, 2, 34, 10, 42]);
        assert_eq!([0, 1, 2, 3, 4, 5, 6, 7].map(|y| step(0, y)), [0, 48, 12, 60, 3, 51, 15, 63]);
        let mut steps: Vec<u32> = (0..64).map(|k| step(16 + k % 8, 24 + k / 8)).collect();
        steps.sort_unstable();
        assert!(steps.into_iter().eq(0..64));
    }

    /// "Even random mask patterns lead to correlation between composited layers": two layers look like one; with a
    /// permutation of each tile and layer they follow the product.
    #[test]
    fn only_tiles_of_their_own_make_layers_multiply() {
        for layers in [2, 4, 8] {
            assert_eq!(union(layers, |p, _| fixed(p)), 0.5);
            assert_eq!(union(layers, |p, _| random_mask(p, 3)), 0.5);
            let product = 1.0 - libm::exp2(-f64::from(layers));
            let covered = union(layers, randomised);
            assert!((covered - product).abs() < 0.02, "{layers} layers: {covered}");
        }
    }

    /// "Repeated dither patterns visible over the screen."
    #[test]
    fn fixed_and_random_masks_repeat_from_tile_to_tile() {
        let repeats = |threshold: &dyn Fn([u32; 2]) -> f64| {
            pixels().filter(|&[x, y]| threshold([x, y]) == threshold([x + TILE, y])).count()
        };
        assert_eq!(repeats(&fixed), 4096);
        assert_eq!(repeats(&|p| random_mask(p, 3)), 4096);
        assert!(repeats(&|p| randomised(p, 0)) < 10);
    }
}
