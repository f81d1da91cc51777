// The digits of i to base 2 mirrored at the point, in [0, 1), for i below 2^24: the van der Corput sequence of section 7.2.3.
fn radical_inverse(i: u32) -> f32 {
    return f32(mirrored(i) >> 8u) * 0x1p-24f;
}
