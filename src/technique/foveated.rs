//! Foveated shading: coarser levels and fewer shaded pixels away from where the viewer looks (§11, Fig. 15; Guenter et
//! al. 2012).

/// Where the viewer looks, and how fast detail falls off around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gaze {
    /// The point looked at, in pixels.
    pub centre: [f64; 2],
    /// Up to this distance everything is drawn in full, in pixels (the yellow circle of Fig. 15).
    pub radius: f64,
    /// Growth of the size of a shaded sample beyond the radius, in pixels a pixel. The paper gives none; the eye's own is
    /// linear.
    pub slope: f64,
}

impl Gaze {
    /// Returns whether a pixel lies within the radius, where everything is drawn in full.
    #[must_use]
    pub fn is_near(&self, [x, y]: [f64; 2]) -> bool {
        libm::hypot(x - self.centre[0], y - self.centre[1]) <= self.radius
    }

    /// Returns the size of a shaded sample at a pixel, in pixels, at least 1: `1 + slope max(0, distance - radius)`.
    #[must_use]
    pub fn sample_size(&self, [x, y]: [f64; 2]) -> f64 {
        let distance = libm::hypot(x - self.centre[0], y - self.centre[1]);
        1.0 + self.slope.max(0.0) * (distance - self.radius).max(0.0)
    }

    /// Returns by how many levels the mip level at a pixel becomes coarser: the base-2 logarithm of the sample's size.
    #[must_use]
    pub fn coarser_by(&self, pixel: [f64; 2]) -> f64 {
        libm::log2(self.sample_size(pixel))
    }

    /// Returns the side of the block of pixels that is shaded once, a power of two no larger than the sample, as variable
    /// rate shading has it; at most 2^30.
    #[must_use]
    pub fn block_side(&self, pixel: [f64; 2]) -> u32 {
        1 << self.coarser_by(pixel).floor().clamp(0.0, 30.0) as u32
    }
}

#[cfg(test)]
mod tests {
    use super::super::prior_work::tests::leaves;
    use super::*;

    const GAZE: Gaze = Gaze { centre: [400.0, 300.0], radius: 100.0, slope: 0.05 };

    #[test]
    fn detail_is_full_in_the_circle_and_falls_off_outside() {
        assert_eq!(GAZE.coarser_by([400.0, 300.0]), 0.0);
        assert!(GAZE.is_near([400.0, 399.0]) && !GAZE.is_near([400.0, 401.0]));
        assert_eq!(GAZE.coarser_by([400.0, 399.0]), 0.0);
        assert_eq!(GAZE.sample_size([520.0, 300.0]), 2.0);
        assert_eq!(GAZE.coarser_by([700.0, 300.0]), libm::log2(11.0));
        assert_eq!([420.0, 520.0, 560.0, 700.0].map(|x| GAZE.block_side([x, 300.0])), [1, 2, 4, 8]);
    }

    /// "Low resolution shading uses coarser mipmap levels, causing traditional alpha tests to fail. With hashed alpha
    /// testing, the foliage maintains its aggregate appearance" (Fig. 15): its mean is that of the finest level.
    #[test]
    fn the_periphery_loses_its_foliage_under_a_fixed_test_only() {
        let chain = leaves(256).chain();
        let in_level = |x: f64| chain[GAZE.coarser_by([x, 300.0]).round() as usize].level();
        let (gaze, edge) = (in_level(400.0), in_level(1900.0));
        assert!(edge.passing_share(0.5) < 0.7 * gaze.passing_share(0.5));
        assert!((edge.mean() - gaze.mean()).abs() < 1e-5);
    }
}
