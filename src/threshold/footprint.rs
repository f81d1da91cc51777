//! What a fragment knows of its place: the inputs of Listings 1 and 2.

use super::real::{Real, length_of};

/// A position on a surface and its two screen derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint<R: Real> {
    /// Position in object units (`objCoord` in the paper).
    pub position: R::Vec3,
    /// Change of the position to the next pixel on the right, in object units per pixel (`dFdx(objCoord)`).
    pub dpdx: R::Vec3,
    /// Change of the position to the next pixel along screen y, in object units per pixel (`dFdy(objCoord)`).
    pub dpdy: R::Vec3,
}

impl<R: Real> Footprint<R> {
    /// Makes a footprint of whatever is three numbers: arrays, or vectors of this crate's glam; those of another version by
    /// their `to_array`.
    ///
    /// ```
    /// use hashed_alpha::Footprint;
    ///
    /// let footprint = Footprint::<f32>::new([0.31, -1.72, 2.43], [0.012, 0.0, -0.001], [0.0, 0.009, 0.003]);
    /// assert_eq!(footprint.position, glam::vec3(0.31, -1.72, 2.43));
    /// ```
    #[must_use]
    pub fn new(position: impl Into<[R; 3]>, dpdx: impl Into<[R; 3]>, dpdy: impl Into<[R; 3]>) -> Self {
        let [position, dpdx, dpdy] = [position.into(), dpdx.into(), dpdy.into()].map(R::Vec3::from);
        Self { position, dpdx, dpdy }
    }

    /// Makes the footprint of a ray or cone that hits a surface, for a tracer that has no derivatives: as a rasteriser would have it whose
    /// screen x runs across the direction of view. Not in the paper.
    ///
    /// `normal` and `direction` are of length 1, in object space and of either sign; `width` is that of the ray at the hit in object units:
    /// the angle of a pixel times the distance, or the width of the cone. A pixel is at most 64 times as long as wide, so that a ray along
    /// the surface has a footprint, too.
    ///
    /// ```
    /// use hashed_alpha::{Footprint, Robust};
    ///
    /// // 12 units away, in a picture 1080 pixels high with a field of view of one radian.
    /// let width = 12.0 * 1.0 / 1080.0;
    /// let footprint = Footprint::<f32>::of_ray([0.3, 0.4, 0.5], [0.0, 0.0, 1.0], [0.6, 0.0, -0.8], width);
    /// let is_hit = 0.7 >= Robust::default().threshold(&footprint).expect("finite numbers");
    /// ```
    #[must_use]
    pub fn of_ray(
        position: impl Into<[R; 3]>,
        normal: impl Into<[R; 3]>,
        direction: impl Into<[R; 3]>,
        width: R,
    ) -> Self {
        let (normal, direction) = (normal.into(), direction.into());
        let [zero, one, least_sine, least_cosine] = [0.0, 1.0, 1.0 / 1024.0, 1.0 / 64.0].map(R::from_f64);
        let sideways = cross(normal, direction);
        let sine = length_of(sideways);
        // Seen from the front any direction along the surface will do.
        let sideways = if sine > least_sine {
            sideways
        } else if normal[0].abs() < R::from_f64(0.5) {
            cross(normal, [one, zero, zero])
        } else {
            cross(normal, [zero, one, zero])
        };
        let length = length_of(sideways);
        let across = sideways.map(|c| c / length);
        let [x, y, z] = [0, 1, 2].map(|axis| normal[axis] * direction[axis]);
        let cosine = Real::max((x + y + z).abs(), least_cosine);
        Self::new(position, across.map(|c| c * width), cross(normal, across).map(|c| c * (width / cosine)))
    }

    /// Rounds every component to the nearest value of another precision.
    #[must_use]
    pub fn cast<S: Real>(&self) -> Footprint<S> {
        let cast = |v: R::Vec3| S::Vec3::from(v.into().map(|c: R| S::from_f64(c.to_f64())));
        Footprint { position: cast(self.position), dpdx: cast(self.dpdx), dpdy: cast(self.dpdy) }
    }
}

/// The vector that is perpendicular to two others.
fn cross<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    let of = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [of(1, 2), of(2, 0), of(0, 1)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, dvec3};

    #[test]
    fn a_ray_has_the_footprint_of_a_pixel_at_its_angle() {
        let normal = dvec3(2.0, -3.0, 6.0) / 7.0;
        let side = normal.any_orthonormal_vector();
        for (degrees, stretch) in [(0.0, 1.0), (60.0, 2.0), (-60.0, 2.0), (80.0, 5.758_770_483), (90.0, 64.0)]
        {
            let angle = f64::to_radians(degrees);
            let direction = side * libm::sin(angle) - normal * libm::cos(angle);
            let found = Footprint::of_ray([1.0, 2.0, 3.0], normal.to_array(), direction.to_array(), 0.01);
            let [dpdx, dpdy]: [DVec3; 2] = [found.dpdx, found.dpdy];
            assert!((dpdx.length() - 0.01).abs() < 1e-12, "{degrees}");
            assert!((dpdy.length() / 0.01 - stretch).abs() < 1e-6, "{degrees}: {}", dpdy.length());
            let skew = [dpdx.dot(normal), dpdy.dot(normal), dpdx.dot(dpdy)];
            assert!(skew.iter().all(|dot| dot.abs() < 1e-12), "{degrees}: {skew:?}");
            if degrees != 0.0 {
                assert!(dpdx.dot(direction).abs() < 1e-12, "{degrees}");
            }
        }
    }
}
