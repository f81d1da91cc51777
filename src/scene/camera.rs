//! A pinhole camera: from a pixel to a ray and to how the ray turns from pixel to pixel, and back from a point to its
//! pixel.

use glam::{DVec2, DVec3, dvec3};

/// A pinhole camera in object coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The pinhole, in object units.
    pub eye: DVec3,
    /// Unit vector along the optical axis.
    pub forward: DVec3,
    /// Change of the ray's direction to the next pixel on the right, per pixel.
    pub direction_dx: DVec3,
    /// Change of the ray's direction to the next pixel below, per pixel.
    pub direction_dy: DVec3,
    /// Width and height of the image in pixels.
    pub resolution: [u32; 2],
}

/// A half-line through a pixel with its screen derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts, in object units.
    pub origin: DVec3,
    /// Where it goes; not a unit vector, one unit along the optical axis.
    pub direction: DVec3,
    /// Change of `direction` to the next pixel on the right, per pixel.
    pub direction_dx: DVec3,
    /// Change of `direction` to the next pixel below, per pixel.
    pub direction_dy: DVec3,
}

impl Camera {
    /// Places a camera at `eye` that looks at `target`, with `up` upwards in the image and a vertical field of view of
    /// `2 atan(half_height)`; `half_height` is half the image's height at distance one.
    ///
    /// # Panics
    ///
    /// If `target` is at `eye`, if `up` is parallel to the line of sight, or if the resolution has a zero.
    #[must_use]
    pub fn look_at(eye: DVec3, target: DVec3, up: DVec3, half_height: f64, resolution: [u32; 2]) -> Self {
        let forward = (target - eye).normalize();
        let right = forward.cross(up).normalize();
        let down = forward.cross(right);
        assert!(forward.is_finite() && right.is_finite() && !resolution.contains(&0), "degenerate camera");
        let pixel = 2.0 * half_height / f64::from(resolution[1]);
        Self { eye, forward, direction_dx: right * pixel, direction_dy: down * pixel, resolution }
    }

    /// Returns the ray through a point of the image, in pixels from the upper left corner; the centre of the first
    /// pixel is (0.5, 0.5).
    #[must_use]
    pub fn ray(&self, pixel: DVec2) -> Ray {
        let centred = pixel - self.size() / 2.0;
        let direction = self.forward + self.direction_dx * centred.x + self.direction_dy * centred.y;
        Ray { origin: self.eye, direction, direction_dx: self.direction_dx, direction_dy: self.direction_dy }
    }

    /// Returns a point in eye coordinates: x to the right, y down, z along the line of sight, in object units.
    #[must_use]
    pub fn to_eye(&self, point: DVec3) -> DVec3 {
        let to = point - self.eye;
        let [right, down] = [self.direction_dx, self.direction_dy].map(DVec3::normalize);
        dvec3(to.dot(right), to.dot(down), to.dot(self.forward))
    }

    /// Returns where a point is seen, in pixels from the upper left corner, inside the image or not; `None` unless the
    /// point is in front of the camera.
    #[must_use]
    pub fn project(&self, point: DVec3) -> Option<DVec2> {
        let to = point - self.eye;
        let depth = to.dot(self.forward);
        let along = |turn: DVec3| to.dot(turn) / (depth * turn.length_squared());
        let centred = DVec2::new(along(self.direction_dx), along(self.direction_dy));
        (depth > 0.0).then(|| centred + self.size() / 2.0)
    }

    /// Returns width and height in pixels.
    #[must_use]
    pub fn size(&self) -> DVec2 {
        DVec2::new(f64::from(self.resolution[0]), f64::from(self.resolution[1]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    #[test]
    fn the_middle_of_the_image_looks_forward_and_y_runs_down() {
        let camera = Camera::look_at(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 0.5, [200, 100]);
        assert_eq!(camera.ray(dvec2(100.0, 50.0)).direction, DVec3::NEG_Z);
        let corner = camera.ray(dvec2(0.0, 0.0)).direction;
        assert!((corner - dvec3(-1.0, 0.5, -1.0)).length() < 1e-15, "{corner}");
    }

    #[test]
    fn a_point_on_a_ray_is_seen_at_its_pixel() {
        let camera = Camera::look_at(dvec3(1.0, 2.0, 3.0), dvec3(-0.3, 0.2, 0.1), DVec3::Y, 0.4, [200, 100]);
        let pixel = dvec2(31.7, 80.2);
        let ray = camera.ray(pixel);
        let point = ray.origin + ray.direction * 2.5;
        assert!((camera.project(point).unwrap() - pixel).length() < 1e-10);
        assert!((camera.to_eye(point).z - 2.5).abs() < 1e-12);
        assert!(camera.to_eye(point).x < 0.0 && camera.to_eye(point).y > 0.0);
        assert_eq!(camera.project(ray.origin - ray.direction), None);
    }
}
