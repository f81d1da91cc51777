// The low 32 bits of an integral float in two's complement; saturates beyond 64 bits, and NaN gives 0.
fn to_word(x: f32) -> u32 {
    let bits = bitcast<u32>(x);
    let exponent = (bits >> 23u) & 0xffu;
    if exponent < 158u {
        return bitcast<u32>(i32(x));
    }
    // From 2^31 on conversions differ among devices, so the bits are shifted into place.
    let negative = (bits >> 31u) == 1u;
    let mantissa = (bits & 0x7fffffu) | 0x800000u;
    if exponent >= 190u {
        let is_nan = exponent == 255u && mantissa != 0x800000u;
        return select(0xffffffffu, 0u, negative || is_nan);
    }
    let places = exponent - 150u;
    let magnitude = select(0u, mantissa << (places & 31u), places < 32u);
    return select(magnitude, 0u - magnitude, negative);
}
