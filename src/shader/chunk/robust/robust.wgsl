fn all_finite(v: vec3<f32>) -> bool {
    return is_finite(v.x) && is_finite(v.y) && is_finite(v.z);
}

// The threshold with every repair, in [2^-24, 1]. An input that is no number has none and gets that of the
// traditional alpha test, 1/2. Not in the paper.
fn robust(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>, hash_scale: f32) -> f32 {
    let has_footprint = all_finite(position) && all_finite(dpdx) && all_finite(dpdy);
    if !(has_footprint && is_finite(hash_scale) && hash_scale > 0.0) {
        return 0.5;
    }
    let scales = robust_scales(position, dpdx, dpdy, hash_scale);
    return clamp(joined(position, scales), 0x1p-24f, 1.0);
}
