//! Noise below the size of a pixel, averaged by the jitter of temporal antialiasing (§7.2.1).

use core::num::NonZeroU32;

/// Returns the hash scale for `n` temporal samples: `sqrt(1 / n)`, in pixels. §7.2.1.
#[must_use]
pub fn noise_scale(n: NonZeroU32) -> f64 {
    (1.0 / f64::from(n.get())).sqrt()
}

/// Returns how many cells of the coarse and of the fine octave a pixel of a frontal surface covers:
/// `4^-lerp_factor / hash_scale^2` and four times that.
///
/// `lerp_factor` is in [0, 1), `hash_scale` above 0. For `sqrt(1 / n)` the paper calls n the ideal number: the coarse
/// octave has it at a lerp factor of 0, the fine one comes near it towards 1, and between them one has less and the
/// other more.
#[must_use]
pub fn cells_per_pixel(hash_scale: f64, lerp_factor: f64) -> [f64; 2] {
    let coarse = libm::exp2(-2.0 * lerp_factor) / (hash_scale * hash_scale);
    [coarse, 4.0 * coarse]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eight_samples_meet_eight_cells_of_one_octave_at_the_ends_only() {
        let scale = noise_scale(NonZeroU32::new(8).unwrap());
        let near = |[a, b]: [f64; 2], [c, d]: [f64; 2]| (a - c).abs() < 1e-9 && (b - d).abs() < 1e-9;
        assert!(near(cells_per_pixel(scale, 0.0), [8.0, 32.0]));
        assert!(near(cells_per_pixel(scale, 0.5), [4.0, 16.0]));
        assert!(near(cells_per_pixel(scale, 1.0), [2.0, 8.0]));
        assert!(near(cells_per_pixel(1.0, 0.0), [1.0, 4.0]));
    }
}
