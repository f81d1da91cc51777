// True for every f32 but NaN and the infinities. By bits: compilers may fold `x != x` to false.
fn is_finite(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7f800000u) != 0x7f800000u;
}
