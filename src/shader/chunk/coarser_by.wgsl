// Levels by which textures are read more coarsely at a pixel, at least 0; `radius` in pixels, `slope` in pixels a pixel.
// Fig. 15.
fn coarser_by(pixel: vec2<f32>, gaze: vec2<f32>, radius: f32, slope: f32) -> f32 {
    return log2(1.0 + max(slope, 0.0) * max(distance(pixel, gaze) - radius, 0.0));
}
