//! The two transcendentals of the listings over whole slices.

use super::isa::{Isa, Job};
use super::lane::Kernel;
use super::{BLOCK, Block};
use crate::threshold::real::{SIN_F32_DOMAIN, exp2_f32, log2_everywhere, sin_f32, sin_in_domain};

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

/// Two to the power of a block, bit for bit what [`exp2_f32`] gives: of octaves, which are whole, by their exponent, of
/// anything else one by one.
#[inline(always)]
pub(crate) fn exp2_block(x: &Block<f32>, out: &mut Block<f32>) {
    let mut all_octaves = true;
    for i in 0..BLOCK {
        out[i] = f32::power(x[i].word() as i32);
        all_octaves &= is_octave(x[i]);
    }
    if !all_octaves {
        for i in 0..BLOCK {
            if !is_octave(x[i]) {
                out[i] = exp2_f32(x[i]);
            }
        }
    }
}

/// Returns whether two to the power of `x` is a normal number with nothing but an exponent; false for NaN.
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
