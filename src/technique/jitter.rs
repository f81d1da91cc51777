//! The camera's offsets within a pixel, frame by frame (§7.2; Karis 2014).

use crate::threshold::stage::order::radical_inverse;
use core::num::NonZeroU32;

/// Returns the offset of the camera in frame `i` of `n`, in pixels along screen x and y: the point `i mod n + 1` of the
/// Halton sequence to the bases 2 and 3, less one half. Each component is in (-1/2, 1/2).
///
/// The paper says only that the camera jitters; the sequence is what engines use.
#[must_use]
pub fn camera_jitter(i: u32, n: NonZeroU32) -> [f64; 2] {
    let index = i % n + 1;
    [radical_inverse(index, 2) - 0.5, radical_inverse(index, 3) - 0.5]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eight_frames_spread_over_the_pixel() {
        let n = NonZeroU32::new(8).unwrap();
        let points: Vec<_> = (0..8).map(|i| camera_jitter(i, n)).collect();
        assert!(points.iter().flatten().all(|c| c.abs() < 0.5));
        assert_eq!(points[0], [0.0, 1.0 / 3.0 - 0.5]);
        assert_eq!(camera_jitter(8, n), points[0]);
        for axis in [0, 1] {
            let mean = points.iter().map(|p| p[axis]).sum::<f64>() / 8.0;
            assert!(mean.abs() < 0.1, "{mean}");
        }
        // No two nearer than an eighth of a pixel; eight points at random are, more often than not.
        for (i, a) in points.iter().enumerate() {
            assert!(points[..i].iter().all(|b| libm::hypot(a[0] - b[0], a[1] - b[1]) > 0.125));
        }
    }
}
