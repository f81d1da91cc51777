//! A surface that is not where its object coordinates are: moved, turned, skinned or deformed.
//!
//! Object coordinates and texture coordinates stay with the point, as vertex attributes do; what the motion changes is
//! where the point is in the world, and so its pixel, and how the object coordinates change from pixel to pixel.

use super::{Camera, Fragment, Rectangle};
use crate::threshold::footprint::Footprint;
use glam::DVec3;

/// Half the distance over which the motion is differentiated, in object units: its square is below the roundings of
/// `f64` positions, a thousandth of which are left in a derivative.
const STEP: f64 = 1.0e-6;

/// Returns the fragment of the `point` of a rectangle (object coordinates) that a motion has taken to `to_world(point)`,
/// in frame 0 and layer 0; `None` where the camera does not see that side of space, or sees the surface edge-on.
///
/// `to_world` is smooth on the scale of a pixel. Surfaces do not hide each other or themselves.
#[must_use]
pub fn fragment(
    camera: &Camera,
    rectangle: &Rectangle,
    to_world: impl Fn(DVec3) -> DVec3,
    point: DVec3,
) -> Option<Fragment> {
    let world = to_world(point);
    let pixel = camera.project(world)?;
    let eye = camera.to_eye(world);
    let sides = [rectangle.half_u, rectangle.half_v].map(DVec3::normalize);
    let moved = sides.map(|side| {
        let step = side * STEP;
        (to_world(point + step) - to_world(point - step)) / (2.0 * STEP)
    });
    let normal = moved[0].cross(moved[1]);
    let ray = camera.ray(pixel);
    let facing = ray.direction.dot(normal);
    // From a turn of the ray to the motion along the surface, and back to the object by the sides.
    let derivative = |turn: DVec3| {
        let along = (turn - ray.direction * (turn.dot(normal) / facing)) * eye.z;
        let part = |other: DVec3, sign: f64| sign * along.cross(other).dot(normal) / normal.length_squared();
        sides[0] * part(moved[1], 1.0) + sides[1] * part(moved[0], -1.0)
    };
    let footprint = Footprint::<f64> {
        position: point,
        dpdx: derivative(ray.direction_dx),
        dpdy: derivative(ray.direction_dy),
    };
    (footprint.dpdx.is_finite() && footprint.dpdy.is_finite()).then(|| Fragment {
        footprint,
        world,
        eye,
        pixel,
        texcoord: rectangle.texcoord(point),
        lod: rectangle.lod(&footprint),
        frame: 0,
        layer: 0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use glam::{DQuat, DVec2, dvec2, dvec3};

    #[test]
    fn where_nothing_moves_it_is_the_fragment_of_the_rectangle() {
        for scene in Scene::all() {
            let (camera, surface) = (&scene.camera, &scene.surfaces[0]);
            let pixel = scene.camera.size() * 0.5 + dvec2(17.3, 21.9);
            let Some(exact) = surface.fragment(camera, pixel) else { panic!("{}", scene.name) };
            let posed = fragment(camera, surface, |p| p, exact.world).unwrap();
            let size = exact.footprint.dpdx.length();
            assert!((posed.footprint.dpdx - exact.footprint.dpdx).length() < 1e-7 * size, "{}", scene.name);
            assert!((posed.footprint.dpdy - exact.footprint.dpdy).length() < 1e-7 * size, "{}", scene.name);
            assert!((posed.pixel - exact.pixel).length() < 1e-9 && (posed.lod - exact.lod).abs() < 1e-6);
            assert!((posed.eye - exact.eye).length() < 1e-12 && posed.texcoord == exact.texcoord);
        }
    }

    #[test]
    fn derivatives_are_those_of_object_coordinates_on_the_screen() {
        let scene = &Scene::all()[1];
        let surface = &scene.surfaces[0];
        let turn = DQuat::from_axis_angle(dvec3(0.3, 0.5, 0.8).normalize(), 0.3);
        // Turned, stretched and bent.
        let to_world = |p: DVec3| {
            let q = turn * (p * dvec3(1.2, 0.9, 1.0));
            q + DVec3::Y * 0.05 * libm::sin(2.0 * p.x)
        };
        let here = fragment(&scene.camera, surface, to_world, surface.centre).unwrap();
        let seen_at = |p: DVec3| scene.camera.project(to_world(p)).unwrap();
        let step = 1e-4;
        let along = |d: DVec3| {
            (seen_at(surface.centre + d * step) - seen_at(surface.centre - d * step)) / (2.0 * step)
        };
        assert!((along(here.footprint.dpdx) - DVec2::X).length() < 1e-5);
        assert!((along(here.footprint.dpdy) - DVec2::Y).length() < 1e-5);
    }
}
