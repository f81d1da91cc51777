//! Inputs of stages: drawn by index, and carried by Rust up to the stage that is fed.

use crate::shader::gpu::program::drawn_word;
use crate::threshold::footprint::Footprint;
use crate::threshold::hash::{Hash, HashKind};
use crate::threshold::real::Real;
use crate::threshold::robust::Repairs;
use crate::threshold::robust::scales::{Scales, robust_scales};
use crate::threshold::two_scale::{TwoScale, Variant};
use glam::Vec3;

/// The stream of all inputs.
const SEED: u32 = 0x5ca1_ab1e;

fn word(index: u32, k: u32) -> u32 {
    drawn_word(SEED, index, k)
}

/// A number in (0, 1) with 23 bits.
fn unit(index: u32, k: u32) -> f32 {
    crate::threshold::hash::open_lattice(word(index, k))
}

/// A place in [-8, 8)^3; derivatives in general direction, from 2^-12 to 2^-4 object units per pixel.
pub(super) fn footprint(index: u32) -> Footprint<f32> {
    let signed = |k: u32| 2.0 * unit(index, k) - 1.0;
    let vector = |k: u32| Vec3::new(signed(k), signed(k + 1), signed(k + 2));
    let pixel = libm::exp2f(-4.0 - 7.0 * unit(index, 9));
    Footprint { position: 8.0 * vector(0), dpdx: pixel * vector(3), dpdy: pixel * vector(6) }
}

pub(super) fn push(words: &mut Vec<u32>, numbers: &[f32]) {
    words.extend(numbers.iter().map(|number| number.to_bits()));
}

/// Position and both derivatives.
pub(super) fn nine(index: u32, words: &mut Vec<u32>) {
    let Footprint { position, dpdx, dpdy } = footprint(index);
    for vector in [position, dpdx, dpdy] {
        push(words, &vector.to_array());
    }
}

/// A footprint at which a threshold does not jump: that of Rust moves by less than 1/1000 where the derivatives change by
/// four times what the accuracy of `log2` leaves open.
pub(super) fn steady_nine(index: u32, words: &mut Vec<u32>, threshold: &dyn Fn(&[u32], &mut Vec<f32>)) {
    const CHANGE: f32 = 3.2e-5;
    // Other attempts are far from the indices that are asked for.
    for attempt in (0..16).map(|attempt| index.wrapping_add(attempt << 28)) {
        let Footprint { position, dpdx, dpdy } = footprint(attempt);
        let mut made = Vec::with_capacity(3);
        let mut given = Vec::with_capacity(9);
        for factor in [1.0 - CHANGE, 1.0 + CHANGE, 1.0] {
            given.clear();
            for vector in [position, dpdx * factor, dpdy * factor] {
                push(&mut given, &vector.to_array());
            }
            threshold(&given, &mut made);
        }
        if made.iter().all(|value| (value - made[2]).abs() < 0.001) {
            words.extend(given);
            return;
        }
    }
    nine(index, words);
}

/// Reads back what [`nine`] wrote.
pub(super) fn read_footprint(words: &[u32]) -> Footprint<f32> {
    let vector = |k: usize| Vec3::from_array([0, 1, 2].map(|i| number(words, k + i)));
    Footprint { position: vector(0), dpdx: vector(3), dpdy: vector(6) }
}

pub(super) fn number(words: &[u32], k: usize) -> f32 {
    f32::from_bits(words[k])
}

pub(super) fn numbers<const N: usize>(words: &[u32], first: usize) -> [f32; N] {
    core::array::from_fn(|k| number(words, first + k))
}

fn isotropic(index: u32) -> TwoScale<f32> {
    Variant::Isotropic.two_scale(&footprint(index), 1.0)
}

fn anisotropic(index: u32) -> TwoScale<f32> {
    Variant::Anisotropic.two_scale(&footprint(index), 1.0)
}

fn robust(index: u32) -> Scales<f32> {
    robust_scales(Variant::Anisotropic, &footprint(index), 1.0, Repairs::ALL)
}

/// Hash scale and longest derivative.
pub(super) fn derivative(index: u32, words: &mut Vec<u32>) {
    push(words, &[0.5 + unit(index, 20), isotropic(index).max_derivative[0]]);
}

/// Hash scale and the derivative along each axis.
pub(super) fn derivatives(index: u32, words: &mut Vec<u32>) {
    push(words, &[0.5 + unit(index, 20)]);
    push(words, &anisotropic(index).max_derivative);
}

/// Cells per object unit.
pub(super) fn pixel_scale(index: u32, words: &mut Vec<u32>) {
    push(words, &isotropic(index).pixel_scale[..1]);
}

/// Cells per object unit along each axis.
pub(super) fn pixel_scales(index: u32, words: &mut Vec<u32>) {
    push(words, &robust(index).pixel_scale);
}

/// The logarithm of the scale.
pub(super) fn log_scale(index: u32, words: &mut Vec<u32>) {
    push(words, &[Real::log2(isotropic(index).pixel_scale[0])]);
}

/// A whole octave.
pub(super) fn octave(index: u32, words: &mut Vec<u32>) {
    push(words, &[(word(index, 21) % 253) as f32 - 126.0]);
}

/// Where the scale lies within its octave along each axis.
pub(super) fn fractions(index: u32, words: &mut Vec<u32>) {
    push(words, &robust(index).fraction);
}

/// Position, scales and octaves of the coarse cell.
pub(super) fn place(index: u32, words: &mut Vec<u32>) {
    let octave = anisotropic(index).octave.map(|octave| octave as f32);
    push(words, &footprint(index).position.to_array());
    push(words, &octave.map(Real::exp2));
    push(words, &octave);
}

/// Position, and octaves as whole numbers.
pub(super) fn nested_place(index: u32, words: &mut Vec<u32>) {
    push(words, &footprint(index).position.to_array());
    words.extend(robust(index).octave.map(|octave| octave as u32));
}

/// Index and octave of a cell, within 2^20 of the origin.
pub(super) fn cell(index: u32, words: &mut Vec<u32>) {
    cell_within(20, index, words);
}

/// As [`cell`], within 2^10: where the paper's hash holds whatever the device's sine.
pub(super) fn near_cell(index: u32, words: &mut Vec<u32>) {
    cell_within(10, index, words);
}

fn cell_within(bits: u32, index: u32, words: &mut Vec<u32>) {
    let coordinate = |k: u32| (word(index, 22 + k) >> (31 - bits)) as f32 - (1_u32 << bits) as f32;
    push(words, &[coordinate(0), coordinate(1), coordinate(2)]);
    words.push(word(index, 25) % 24);
}

/// Two hashes and a weight.
pub(super) fn hashes(index: u32, words: &mut Vec<u32>) {
    push(words, &[unit(index, 26), unit(index, 27), isotropic(index).lerp_factor]);
}

/// A mixture and its weight.
pub(super) fn mixture(index: u32, words: &mut Vec<u32>) {
    let found = isotropic(index);
    let weight = found.lerp_factor;
    let coarse: f32 = HashKind::Mm4.hash(&found.floor_cell);
    let fine: f32 = HashKind::Mm4.hash(&found.ceil_cell);
    push(words, &[(1.0 - weight) * coarse + weight * fine, weight]);
}

/// A number in (0, 1).
pub(super) fn value(index: u32, words: &mut Vec<u32>) {
    push(words, &[unit(index, 28)]);
}

/// A number about zero, beyond [-6, 6] never.
pub(super) fn deviation(index: u32, words: &mut Vec<u32>) {
    push(words, &[11.0 * unit(index, 29) - 5.5]);
}

/// A number in (0, 1), an index and a number of strata above it, at most 16.
pub(super) fn stratum(index: u32, words: &mut Vec<u32>) {
    let strata = word(index, 30) % 16 + 1;
    push(words, &[unit(index, 31)]);
    words.extend([word(index, 32) % strata, strata]);
}

/// As [`stratum`], but where the sum of number and share of strata is near a whole number, at which its fraction jumps.
pub(super) fn stratum_off_jumps(index: u32, words: &mut Vec<u32>) {
    stratum(index, words);
    if let [.., chi, i, strata] = words.as_mut_slice() {
        let sum = f32::from_bits(*chi) + *i as f32 / *strata as f32;
        if (sum - sum.round()).abs() < 1.0e-6 {
            *chi = 0.3_f32.to_bits();
        }
    }
}

/// As [`stratum`], where the sum of the number and the share of the stratum that the van der Corput order takes does not
/// jump.
pub(super) fn stratum_of_order(index: u32, words: &mut Vec<u32>) {
    stratum(index, words);
    if let [.., chi, _, strata] = words.as_mut_slice() {
        let scaled = f32::from_bits(*chi) * *strata as f32;
        if (scaled - scaled.round()).abs() < 1.0e-5 {
            *chi = 0.2718_f32.to_bits();
        }
    }
}

/// Two numbers in (0, 1), an index and a number of strata above it, at most 16.
pub(super) fn two_and_stratum(index: u32, words: &mut Vec<u32>) {
    push(words, &[unit(index, 33)]);
    stratum(index, words);
}

/// As [`two_and_stratum`], with a power of two of strata.
pub(super) fn two_and_power(index: u32, words: &mut Vec<u32>) {
    let strata = 1 << (word(index, 30) % 5);
    push(words, &[unit(index, 33), unit(index, 31)]);
    words.extend([word(index, 32) % strata, strata]);
}

/// A level of detail about [0, 6], and the level of full noise.
pub(super) fn lod(index: u32, words: &mut Vec<u32>) {
    push(words, &[10.0 * unit(index, 34) - 2.0, 6.0]);
}

/// A threshold and a share of noise.
pub(super) fn faded(index: u32, words: &mut Vec<u32>) {
    push(words, &[unit(index, 35), unit(index, 36)]);
}

/// Two lengths, up to a factor of 64 apart.
pub(super) fn lengths(index: u32, words: &mut Vec<u32>) {
    push(words, &[unit(index, 37), unit(index, 38) * libm::exp2f(-6.0 * unit(index, 39))]);
}
