const HASH_SCALE = 1.0;

fn hash2d(a: vec2<f32>) -> f32 {
    return fract(
        1.0e4 * sin(17.0 * a.x + 0.1 * a.y)
              * (0.1 + abs(sin(13.0 * a.y + a.x)))
    );
}

fn hash3d(a: vec3<f32>) -> f32 {
    return hash2d(vec2<f32>(hash2d(a.xy), a.z));
}

fn pixel_size(p: vec3<f32>) -> f32 {
    let u = dpdx(p);
    let v = dpdy(p);
    return sqrt(length(cross(u, v)));
}

fn threshold(position: vec3<f32>) -> f32 {
    let size = max(pixel_size(position), 1e-8);
    let pix_scale = 1.0 / (HASH_SCALE * size);

    // neighbouring powers of two
    let l = log2(pix_scale);
    let s0 = exp2(floor(l));
    let s1 = exp2(ceil(l));

    let h0 = hash3d(floor(s0 * position));
    let h1 = hash3d(floor(s1 * position));

    // threshold of this pixel
    let t = fract(h0 + h1);
    return clamp(t, 1.0e-6, 1.0);
}
