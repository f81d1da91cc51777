// A MISTAKE is in here, one that real ports make: the hash is one of the pixel and the frame. The thresholds are uniform,
// but they do not stay on the surface: they change with every move of the camera, and with every frame.

fn pcg(word: u32) -> u32 {
    let state = word * 747796405u + 2891336453u;
    let mixed = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (mixed >> 22u) ^ mixed;
}

fn threshold(pixel: vec2<f32>, frame: u32, layer: u32) -> f32 {
    let h = pcg(u32(pixel.x) + pcg(u32(pixel.y) + pcg(frame + pcg(layer))));
    return (f32(h >> 9u) + 0.5) / 8388608.0;
}
