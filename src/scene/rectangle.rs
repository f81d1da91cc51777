//! A flat rectangle: wall, floor, fence panel and card are all this.

use super::Fragment;
use super::camera::{Camera, Ray};
use crate::threshold::footprint::Footprint;
use glam::{DVec2, DVec3, dvec2};

/// Texels along each side of the alpha map that covers a rectangle: a common size for foliage.
const TEXELS: f64 = 1024.0;

/// A rectangle in object coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// Its middle, in object units.
    pub centre: DVec3,
    /// From the middle to the middle of one side, in object units.
    pub half_u: DVec3,
    /// From the middle to the middle of the next side, orthogonal to `half_u`.
    pub half_v: DVec3,
}

impl Rectangle {
    /// Returns the distance along `ray`, in units of its direction, at which it meets the rectangle in front of its
    /// origin; `None` where it misses or runs within the plane.
    #[must_use]
    pub fn hit(&self, ray: &Ray) -> Option<f64> {
        let normal = self.half_u.cross(self.half_v);
        let distance = (self.centre - ray.origin).dot(normal) / ray.direction.dot(normal);
        let place = ray.origin + ray.direction * distance - self.centre;
        let inside = |half: DVec3| place.dot(half).abs() <= half.length_squared();
        (distance.is_finite() && distance > 0.0 && inside(self.half_u) && inside(self.half_v))
            .then_some(distance)
    }

    /// Returns the footprint at a point of the image (pixels from the upper left corner) with analytic derivatives,
    /// or `None` where the rectangle is not seen.
    #[must_use]
    pub fn footprint(&self, camera: &Camera, pixel: DVec2) -> Option<Footprint<f64>> {
        let ray = camera.ray(pixel);
        let distance = self.hit(&ray)?;
        let normal = self.half_u.cross(self.half_v);
        let facing = ray.direction.dot(normal);
        let derivative = |turn: DVec3| (turn - ray.direction * (turn.dot(normal) / facing)) * distance;
        Some(Footprint {
            position: ray.origin + ray.direction * distance,
            dpdx: derivative(ray.direction_dx),
            dpdy: derivative(ray.direction_dy),
        })
    }

    /// Returns the fragment at a point of the image (pixels from the upper left corner), in frame 0 and layer 0, of an
    /// object whose coordinates are those of the world; `None` where the rectangle is not seen.
    #[must_use]
    pub fn fragment(&self, camera: &Camera, pixel: DVec2) -> Option<Fragment> {
        let footprint = self.footprint(camera, pixel)?;
        let world = footprint.position;
        Some(Fragment {
            footprint,
            world,
            eye: camera.to_eye(world),
            pixel,
            texcoord: self.texcoord(world),
            lod: self.lod(&footprint),
            frame: 0,
            layer: 0,
        })
    }

    /// Returns the texture coordinates of a point: from (0, 0) in the corner behind both half sides to (1, 1) in the one
    /// before them.
    #[must_use]
    pub fn texcoord(&self, point: DVec3) -> DVec2 {
        let from_centre = point - self.centre;
        let along = |half: DVec3| 0.5 + 0.5 * from_centre.dot(half) / half.length_squared();
        dvec2(along(self.half_u), along(self.half_v))
    }

    /// Returns the level of detail of the texture at a footprint, log2 of texels per pixel along the longer axis.
    #[must_use]
    pub fn lod(&self, footprint: &Footprint<f64>) -> f64 {
        // A texture coordinate is linear on the surface.
        let texels =
            |along: DVec3| (self.texcoord(self.centre + along) - DVec2::splat(0.5)).length() * TEXELS;
        libm::log2(texels(footprint.dpdx).max(texels(footprint.dpdy)))
    }

    /// Returns the footprint of a pixel as a GPU finds it: `f32` positions, and their differences within the aligned
    /// 2x2 quad of that pixel as derivatives.
    ///
    /// `None` unless all three pixels that take part see the rectangle.
    #[must_use]
    pub fn quad_footprint(&self, camera: &Camera, pixel: [u32; 2]) -> Option<Footprint<f32>> {
        let position = |x: u32, y: u32| {
            let centre = dvec2(f64::from(x) + 0.5, f64::from(y) + 0.5);
            self.footprint(camera, centre).map(|found| found.position.as_vec3())
        };
        let [x, y] = pixel;
        let here = position(x, y)?;
        let (beside, below) = (position(x ^ 1, y)?, position(x, y ^ 1)?);
        let forward = |other: glam::Vec3, odd: bool| if odd { here - other } else { other - here };
        Some(Footprint {
            position: here,
            dpdx: forward(beside, x & 1 == 1),
            dpdy: forward(below, y & 1 == 1),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    fn tilted() -> (Camera, Rectangle) {
        let camera = Camera::look_at(dvec3(0.3, -0.2, 4.0), DVec3::ZERO, DVec3::Y, 0.4, [64, 64]);
        let half_u = dvec3(2.0, 0.3, 0.7);
        let rectangle =
            Rectangle { centre: DVec3::ZERO, half_u, half_v: half_u.cross(dvec3(0.1, -0.2, 1.0)) };
        (camera, rectangle)
    }

    #[test]
    fn analytic_derivatives_are_the_limit_of_differences() {
        let (camera, rectangle) = tilted();
        let (pixel, step) = (dvec2(20.0, 41.0), 1e-4);
        let here = rectangle.footprint(&camera, pixel).unwrap();
        let at = |offset: DVec2| rectangle.footprint(&camera, pixel + offset).unwrap().position;
        let dx = (at(dvec2(step, 0.0)) - at(dvec2(-step, 0.0))) / (2.0 * step);
        let dy = (at(dvec2(0.0, step)) - at(dvec2(0.0, -step))) / (2.0 * step);
        assert!((dx - here.dpdx).length() < 1e-9 && (dy - here.dpdy).length() < 1e-9);
    }

    #[test]
    fn pixels_of_a_quad_share_the_derivatives_of_their_row_and_column() {
        let (camera, rectangle) = tilted();
        let quad = |x, y| rectangle.quad_footprint(&camera, [x, y]).unwrap();
        assert_eq!(quad(20, 40).dpdx, quad(21, 40).dpdx);
        assert_eq!(quad(20, 40).dpdy, quad(20, 41).dpdy);
        let analytic = rectangle.footprint(&camera, dvec2(20.5, 40.5)).unwrap();
        let relative = (quad(20, 40).dpdx.as_dvec3() - analytic.dpdx).length() / analytic.dpdx.length();
        assert!(relative < 0.02, "{relative}");
    }

    #[test]
    fn rays_that_miss_give_nothing() {
        let (camera, rectangle) = tilted();
        let small =
            Rectangle { half_u: rectangle.half_u * 0.01, half_v: rectangle.half_v * 0.01, ..rectangle };
        assert!(small.footprint(&camera, dvec2(1.0, 1.0)).is_none());
        let behind = Rectangle { centre: dvec3(0.6, -0.4, 8.0), ..rectangle };
        assert!(behind.footprint(&camera, dvec2(32.0, 32.0)).is_none());
    }

    #[test]
    fn a_fragment_is_one_place_in_every_coordinate() {
        let (camera, rectangle) = tilted();
        let pixel = dvec2(20.0, 41.0);
        let here = rectangle.fragment(&camera, pixel).unwrap();
        assert_eq!(Some(here.footprint), rectangle.footprint(&camera, pixel));
        assert!((camera.project(here.world).unwrap() - pixel).length() < 1e-10);
        let [u, v] = (here.texcoord * 2.0 - 1.0).to_array();
        let point = rectangle.centre + rectangle.half_u * u + rectangle.half_v * v;
        assert!((point - here.world).length() < 1e-12);
        // Twice as near, twice as large: one level of detail less.
        let near = Camera { eye: here.world.midpoint(camera.eye), ..camera };
        let nearer = rectangle.fragment(&near, pixel).unwrap();
        assert!((here.lod - nearer.lod - 1.0).abs() < 1e-9 && (here.eye * 0.5 - nearer.eye).length() < 1e-12);
    }
}
