//! The robust threshold of one scale as somebody writes it by hand who needs nothing else: `f32`, no options, no checks, one
//! function. What the library takes for one threshold is measured beside it.

use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::real::log2_f32;

/// Returns the threshold of [`Robust::new`](hashed_alpha::threshold::robust::Robust) with one scale, bit for bit, for footprints of everyday
/// size: squares of derivatives neither over- nor underflow, and cells have between 2^-100 and 2^100 units.
pub fn robust(footprint: &Footprint<f32>) -> f32 {
    let position = footprint.position.to_array();
    let reach = position[0].abs().max(position[1].abs()).max(position[2].abs());
    let side = footprint.dpdx.length().max(footprint.dpdy.length()).max(reach * (1.0 / 2_097_152.0));
    let bits = (1.0 / side).to_bits();
    let octave = (bits >> 23) as i32 - 127;
    let weight = log2_f32(f32::from_bits(bits & 0x007f_ffff | 0x3f80_0000)).min(1.0 - 1.0 / 16_777_216.0);
    let mixture = (1.0 - weight) * value(position, octave) + weight * value(position, octave + 1);
    let minor = weight.min(1.0 - weight);
    let major = 1.0 - minor;
    let uniform = if mixture < minor {
        0.5 * mixture * ((mixture / minor) / major)
    } else if 1.0 - mixture < minor {
        1.0 - 0.5 * (1.0 - mixture) * (((1.0 - mixture) / minor) / major)
    } else {
        (mixture - 0.5 * minor) / major
    };
    uniform.clamp(1.0 / 16_777_216.0, 1.0)
}

/// `lowbias32` of the weighted cell of a position in an octave.
fn value(position: [f32; 3], octave: i32) -> f32 {
    let cells = f32::from_bits(((octave + 127) as u32) << 23);
    let edge = if octave & 1 == 0 { 2.0 / 3.0 } else { 1.0 / 3.0 };
    let index = |coordinate: f32| {
        let scaled = coordinate * cells;
        let cut = scaled as i32;
        let whole = if cut as f32 > scaled { cut - 1 } else { cut };
        (whole + i32::from(scaled - whole as f32 >= edge)) as u32
    };
    let mut h = index(position[0])
        .wrapping_mul(0xc71f_15df)
        .wrapping_add(index(position[1]).wrapping_mul(0xd288_1b55))
        .wrapping_add(index(position[2]).wrapping_mul(0x6290_e857))
        .wrapping_add((octave as u32).wrapping_mul(0x6a46_fe4f));
    h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d);
    h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    h ^= h >> 16;
    (2 * (h >> 9) + 1) as f32 * (1.0 / 16_777_216.0)
}
