// Threshold of a surface that covers the share `coverage` of its pixel, in (0, 1]; above 1 where nothing may pass. Fig. 4.
fn corrected(value: f32, coverage: f32) -> f32 {
    return value / coverage;
}
