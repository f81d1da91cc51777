//! A rectangle as a GPU draws it: two triangles, and positions interpolated in `f32` between their corners.
//!
//! A position that is computed pixel by pixel in `f64` and rounded once is kinder than what a shader is given. A
//! rasteriser weighs the three corners of a triangle in `f32`, and the weights add up to one only up to rounding: on a
//! plane of constant z the coordinate comes out as z at some pixels and a unit or two in the last place beside it at
//! others, and which pixels these are changes from frame to frame. The model, in the order of its operations:
//!
//! 1. Corners are projected in `f64`; their place in the image and their inverse depth are rounded to `f32`.
//! 2. All that follows is `f32` without contraction. The corners are taken relative to the pixel's centre; a corner's
//!    barycentric weight is the cross product of the other two, times its inverse depth.
//! 3. Weights are multiplied by the inverse of their sum; the position is the weighted sum of the corners.
//! 4. Derivatives are differences within the aligned 2x2 quad of the pixel. The other pixels of the quad are
//!    evaluated in the same triangle, even where they lie outside it (helper invocations).
//!
//! Left out: corners snapped to fractions of a pixel, clipping, and the rule that gives a pixel on an edge to exactly
//! one triangle. GPUs that interpolate differences to one corner return a constant coordinate exactly; this is the
//! other kind. Not in the paper.

use super::{Camera, Rectangle};
use crate::threshold::footprint::Footprint;
use glam::{DVec2, DVec3, Vec2, Vec3, vec2};

/// A corner after projection.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Vertex {
    /// In pixels from the upper left corner of the image.
    pixel: Vec2,
    /// Inverse of the distance along the optical axis.
    inverse_depth: f32,
    /// In object units.
    position: Vec3,
}

/// A rectangle in front of a camera, ready to be asked for its footprints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Raster {
    triangles: [[Vertex; 3]; 2],
}

impl Raster {
    /// Projects a rectangle, and moves its image by `shift` pixels; `None` unless all corners are in front of the
    /// camera.
    #[must_use]
    pub fn new(camera: &Camera, rectangle: &Rectangle, shift: DVec2) -> Option<Self> {
        let (u, v) = (rectangle.half_u, rectangle.half_v);
        let corner = |offset: DVec3| project(camera, rectangle.centre + offset, shift);
        let [a, b, c, d] = [corner(-u - v)?, corner(u - v)?, corner(u + v)?, corner(v - u)?];
        Some(Self { triangles: [[a, b, c], [a, c, d]] })
    }

    /// Returns the footprint of a pixel, or `None` where its centre does not see the rectangle.
    #[must_use]
    pub fn footprint(&self, pixel: [u32; 2]) -> Option<Footprint<f32>> {
        let centre = |[x, y]: [u32; 2]| vec2(x as f32 + 0.5, y as f32 + 0.5);
        let triangle = self.triangles.iter().find(|triangle| covers(triangle, centre(pixel)))?;
        let [x, y] = pixel;
        let at = |pixel: [u32; 2]| interpolate(triangle, centre(pixel));
        let here = at(pixel);
        let forward = |other: Vec3, odd: bool| if odd { here - other } else { other - here };
        Some(Footprint {
            position: here,
            dpdx: forward(at([x ^ 1, y]), x & 1 == 1),
            dpdy: forward(at([x, y ^ 1]), y & 1 == 1),
        })
    }
}

fn project(camera: &Camera, position: DVec3, shift: DVec2) -> Option<Vertex> {
    let depth = (position - camera.eye).dot(camera.forward);
    Some(Vertex {
        pixel: (camera.project(position)? + shift).as_vec2(),
        inverse_depth: (1.0 / depth) as f32,
        position: position.as_vec3(),
    })
}

/// Twice the signed areas of the triangles that a point forms with the sides opposite to each corner.
fn areas(triangle: &[Vertex; 3], point: Vec2) -> [f32; 3] {
    let [a, b, c] = triangle.map(|vertex| vertex.pixel - point);
    let cross = |p: Vec2, q: Vec2| p.x * q.y - p.y * q.x;
    [cross(b, c), cross(c, a), cross(a, b)]
}

fn covers(triangle: &[Vertex; 3], point: Vec2) -> bool {
    let areas = areas(triangle, point);
    areas.iter().all(|&area| area >= 0.0) || areas.iter().all(|&area| area <= 0.0)
}

fn interpolate(triangle: &[Vertex; 3], point: Vec2) -> Vec3 {
    let [a, b, c] = areas(triangle, point);
    let [p, q, r] = triangle;
    let [a, b, c] = [a * p.inverse_depth, b * q.inverse_depth, c * r.inverse_depth];
    let inverse_sum = 1.0 / (a + b + c);
    p.position * (a * inverse_sum) + q.position * (b * inverse_sum) + r.position * (c * inverse_sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{dvec2, dvec3};

    fn wall(z: f64) -> (Camera, Rectangle) {
        let camera =
            Camera::look_at(dvec3(2.1, 1.3, 4.2), dvec3(0.1, 0.2, z), dvec3(0.2, 1.0, 0.3), 0.4, [128, 96]);
        let rectangle =
            Rectangle { centre: dvec3(0.31, 0.17, z), half_u: DVec3::X * 1.5, half_v: DVec3::Y * 1.5 };
        (camera, rectangle)
    }

    fn footprints(z: f64) -> Vec<([u32; 2], Footprint<f32>)> {
        let (camera, rectangle) = wall(z);
        let raster = Raster::new(&camera, &rectangle, DVec2::ZERO).unwrap();
        (0..96)
            .flat_map(|y| (0..128).map(move |x| [x, y]))
            .filter_map(|pixel| Some((pixel, raster.footprint(pixel)?)))
            .collect()
    }

    #[test]
    fn positions_and_derivatives_are_those_of_the_surface_up_to_rounding() {
        let (camera, rectangle) = wall(0.5);
        let found = footprints(0.5);
        assert!(found.len() > 128 * 96 / 2, "{}", found.len());
        for ([x, y], footprint) in found {
            // On the outermost pixels the exact ray may miss by a rounding.
            let Some(exact) = rectangle.footprint(&camera, dvec2(f64::from(x) + 0.5, f64::from(y) + 0.5))
            else {
                continue;
            };
            assert!((footprint.position.as_dvec3() - exact.position).length() < 2e-6);
            let error = (footprint.dpdx.as_dvec3() - exact.dpdx).length() / exact.dpdx.length();
            assert!(error < 0.02, "{error}");
        }
    }

    #[test]
    fn a_constant_coordinate_is_constant_up_to_rounding() {
        let found = footprints(0.5);
        let exactly = found.iter().filter(|(_, f)| f.position.z == 0.5).count();
        let share = exactly as f64 / found.len() as f64;
        assert!(share > 0.5 && share < 0.99, "{share}");
        // Two units in the last place of one half.
        assert!(found.iter().all(|(_, f)| (f.position.z - 0.5).abs() <= f32::EPSILON));
    }

    #[test]
    fn zero_stays_zero() {
        assert!(footprints(0.0).iter().all(|(_, f)| f.position.z == 0.0 && f.dpdx.z == 0.0));
    }

    #[test]
    fn a_shifted_image_shows_what_was_beside() {
        let (camera, rectangle) = wall(0.3);
        let [still, shifted] =
            [DVec2::ZERO, dvec2(1.0, 0.0)].map(|shift| Raster::new(&camera, &rectangle, shift).unwrap());
        let (before, after) = (still.footprint([60, 40]).unwrap(), shifted.footprint([61, 40]).unwrap());
        assert!((before.position - after.position).length() < 1e-5);
    }

    #[test]
    fn what_is_behind_the_camera_is_not_drawn() {
        let (camera, rectangle) = wall(0.3);
        assert!(
            Raster::new(&camera, &Rectangle { half_u: DVec3::Z * 9.0, ..rectangle }, DVec2::ZERO).is_none()
        );
        let raster =
            Raster::new(&camera, &Rectangle { centre: dvec3(0.0, 0.0, -900.0), ..rectangle }, DVec2::ZERO);
        assert!(raster.unwrap().footprint([1, 1]).is_none());
    }
}
