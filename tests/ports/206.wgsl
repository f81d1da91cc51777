const SCALE: f32 = 1.0;

fn h2(x: f32, y: f32) -> f32 {
    return fract(1.0e4 * sin(17.0 * x + 0.1 * y) * (0.1 + abs(sin(13.0 * y + x))));
}

fn noise(cell: vec3f) -> f32 {
    return h2(h2(cell.x, cell.y), cell.z);
}

fn cumulative(x: f32, a: f32) -> f32 {
    let b = 1.0 - a;
    if (x < a) {
        return x * x / (2.0 * a * b);
    }
    if (x < b) {
        return (x - 0.5 * a) / b;
    }
    return 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * b);
}

fn hashed_alpha(P: vec3f) -> f32 {
    let dx = length(dpdx(P));
    let dy = length(dpdy(P));
    let s = log2(1.0 / (SCALE * max(dx, dy)));

    let s0 = floor(s);
    let w = s - s0;

    var x = (1.0 - w) * noise(floor(exp2(s0) * P));
    x += w * noise(floor(exp2(s0 + 1.0) * P));

    let u = cumulative(x, min(w, 1.0 - w));
    let t = pow(clamp(u, 0.0, 1.0), 2.2);
    return clamp(t, 1.0e-6, 1.0);
}
