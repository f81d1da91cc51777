// Brings a threshold into [2^-24, 1], last of all, so that alpha 0 never passes and alpha 1 always does.
fn clamp_last(threshold_value: f32) -> f32 {
    return clamp(threshold_value, 0x1p-24f, 1.0);
}
