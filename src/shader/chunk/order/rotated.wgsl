// The frame at which a permutation of n strata is entered, so that its first stratum is that of chi. Not in the paper.
fn entered(chi: f32, i: u32, n: u32) -> u32 {
    return (i + u32(floor(chi * f32(n))) % n) % n;
}

// The threshold of a stratum of n that keeps the place of chi within its own, in [2^-24, 1]. Not in the paper.
fn rotated(chi: f32, stratum: u32, n: u32) -> f32 {
    let scaled = chi * f32(n);
    return clamp_last((f32(stratum) + (scaled - floor(scaled))) / f32(n));
}
