//! The exponent of a number, by its bits.

/// Takes a positive normal number apart: 2^exponent times a mantissa in [1, 2).
#[inline(always)]
pub(super) fn exponent_and_mantissa(x: f32) -> (i32, f32) {
    let bits = x.to_bits();
    ((bits >> 23) as i32 - 127, f32::from_bits((bits & 0x007f_ffff) | 0x3f80_0000))
}
