//! The stages of the listings over whole slices: sine, logarithm, hash.

use super::block::{BLOCK, Block};
use super::cells;
use super::isa::{Isa, Job};
use super::lane::Kernel;
use super::tier::Tier;
use crate::threshold::hash::HashKind;
use crate::threshold::real::{SIN_F32_DOMAIN, log2_everywhere, sin_f32, sin_in_domain};

impl Isa {
    /// Writes the sine of every element of `x` (radians) to `out`: bit for bit what
    /// [`sin_f32`] gives, special values too.
    ///
    /// Arguments beyond its domain are computed one by one.
    ///
    /// # Panics
    /// If the lengths differ.
    pub fn sin(self, x: &[f32], out: &mut [f32]) {
        assert_eq!(x.len(), out.len(), "as many values as arguments");
        self.run(Sin { x, out });
    }

    /// Writes the sine of every element of `x` (radians) to `out` as the hash of a tier takes it; [`Isa::sin`] for the
    /// exact one.
    ///
    /// # Panics
    /// If the lengths differ.
    pub fn sin_of(self, tier: Tier, x: &[f32], out: &mut [f32]) {
        assert_eq!(x.len(), out.len(), "as many values as arguments");
        match tier {
            Tier::BitExact => self.sin(x, out),
            _ => self.run(InexactSin { tier, x, out }),
        }
    }

    /// Writes the hash of every cell to `out`, as a batch of a tier has it: coordinates along each axis, and the word of
    /// the octaves. Coordinates are whole numbers below 2^20.
    ///
    /// # Panics
    /// If the lengths differ.
    pub fn hash(self, kind: HashKind, tier: Tier, index: [&[f32]; 3], word: &[u32], out: &mut [f32]) {
        let length = out.len();
        assert!(
            index.iter().all(|axis| axis.len() == length) && word.len() == length,
            "as many hashes as cells"
        );
        self.run(HashOfCells { kind, tier, index, word, out });
    }

    /// Writes the logarithm to base two of every element of `x` to `out`: bit for bit what
    /// [`log2_f32`](crate::threshold::real::log2_f32) gives, special values too.
    ///
    /// # Panics
    /// If the lengths differ.
    pub fn log2(self, x: &[f32], out: &mut [f32]) {
        assert_eq!(x.len(), out.len(), "as many values as arguments");
        self.run(Log2 { x, out });
    }
}

struct Sin<'a> {
    x: &'a [f32],
    out: &'a mut [f32],
}

impl Job for Sin<'_> {
    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        over_blocks(self.x, self.out, sin_block::<FUSED>);
    }
}

struct InexactSin<'a> {
    tier: Tier,
    x: &'a [f32],
    out: &'a mut [f32],
}

impl Job for InexactSin<'_> {
    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        match self.tier {
            Tier::Coarse => over_blocks(self.x, self.out, coarse_block),
            Tier::Fast => over_blocks(self.x, self.out, fast_block),
            Tier::TwoUlp | Tier::BitExact => over_blocks(self.x, self.out, two_ulp_block),
        }
    }
}

/// Defines the sine of a tier over a block; a closure would not be compiled for the instructions of its caller.
macro_rules! sine_of_block {
    ($block:ident, $sine:ident) => {
        #[inline(always)]
        fn $block(x: &Block<f32>, out: &mut Block<f32>) {
            for i in 0..BLOCK {
                out[i] = x[i].$sine();
            }
        }
    };
}
sine_of_block!(coarse_block, sine_coarse);
sine_of_block!(fast_block, sine_fast);
sine_of_block!(two_ulp_block, sine_two_ulp);

struct HashOfCells<'a> {
    kind: HashKind,
    tier: Tier,
    index: [&'a [f32]; 3],
    word: &'a [u32],
    out: &'a mut [f32],
}

impl Job for HashOfCells<'_> {
    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        let Self { kind, tier, index, word, out } = self;
        let (mut cells, mut words, mut values) = ([[0.0; BLOCK]; 3], [0; BLOCK], [0.0; BLOCK]);
        for (at, out) in out.chunks_mut(BLOCK).enumerate() {
            let range = at * BLOCK..at * BLOCK + out.len();
            for (axis, index) in cells.iter_mut().zip(index) {
                axis[..out.len()].copy_from_slice(&index[range.clone()]);
            }
            words[..out.len()].copy_from_slice(&word[range]);
            cells::hash::<f32, FUSED>(kind, tier, cells.each_ref(), &words, &mut values);
            out.copy_from_slice(&values[..out.len()]);
        }
    }
}

struct Log2<'a> {
    x: &'a [f32],
    out: &'a mut [f32],
}

impl Job for Log2<'_> {
    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        over_blocks(self.x, self.out, log2_block::<FUSED>);
    }
}

/// Applies a function of a block to a slice; the last block is filled up with zeros.
#[inline(always)]
fn over_blocks(x: &[f32], out: &mut [f32], block: impl Fn(&Block<f32>, &mut Block<f32>)) {
    let (whole, tail) = x.as_chunks::<BLOCK>();
    let (out_whole, out_tail) = out.as_chunks_mut::<BLOCK>();
    for (x, out) in whole.iter().zip(out_whole) {
        block(x, out);
    }
    if !tail.is_empty() {
        let (mut x, mut out) = ([0.0; BLOCK], [0.0; BLOCK]);
        x[..tail.len()].copy_from_slice(tail);
        block(&x, &mut out);
        out_tail.copy_from_slice(&out[..tail.len()]);
    }
}

/// The sine of a block; see [`Isa::sin`].
#[inline(always)]
pub(crate) fn sin_block<const FUSED: bool>(x: &Block<f32>, out: &mut Block<f32>) {
    let mut all_within = true;
    for i in 0..BLOCK {
        out[i] = sin_in_domain::<FUSED>(x[i]);
        all_within &= is_within(x[i]);
    }
    if !all_within {
        for i in 0..BLOCK {
            if !is_within(x[i]) {
                out[i] = sin_f32(x[i]);
            }
        }
    }
}

/// Returns whether an argument is in the domain of the polynomial; false for NaN.
#[inline(always)]
fn is_within(x: f32) -> bool {
    x.abs() <= SIN_F32_DOMAIN
}

/// Two to the power of a block, bit for bit what [`exp2_f32`](crate::threshold::real::exp2_f32) gives: of octaves, which are
/// whole, by their exponent, of anything else one by one. The interpreter of shaders alone calls it.
#[cfg(feature = "shader")]
#[inline(always)]
pub(crate) fn exp2_block(x: &Block<f32>, out: &mut Block<f32>) {
    let mut all_octaves = true;
    for i in 0..BLOCK {
        out[i] = f32::power(crate::threshold::real::Real::small_word(x[i]) as i32);
        all_octaves &= is_octave(x[i]);
    }
    if !all_octaves {
        for i in 0..BLOCK {
            if !is_octave(x[i]) {
                out[i] = crate::threshold::real::exp2_f32(x[i]);
            }
        }
    }
}

/// Returns whether two to the power of `x` is a normal number with nothing but an exponent; false for NaN.
#[cfg(feature = "shader")]
#[inline(always)]
fn is_octave(x: f32) -> bool {
    x.abs() <= 126.0 && x.floor() == x
}

/// The logarithm of a block; see [`Isa::log2`].
#[inline(always)]
pub(crate) fn log2_block<const FUSED: bool>(x: &Block<f32>, out: &mut Block<f32>) {
    for i in 0..BLOCK {
        out[i] = log2_everywhere::<FUSED>(x[i]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_polynomial_serves_its_domain_and_no_more() {
        assert!([0.0, -1.0, SIN_F32_DOMAIN, -SIN_F32_DOMAIN].into_iter().all(is_within));
        assert!(![SIN_F32_DOMAIN.next_up(), f32::INFINITY, f32::NAN].into_iter().any(is_within));
    }
}
