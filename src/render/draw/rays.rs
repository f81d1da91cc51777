//! Rays from surfaces, and whether something is in their way (§9, Fig. 8).

use super::mesh::Mesh;
use crate::technique::occlusion::open;
use glam::DVec3;

/// Rays start this share of their distance to the viewer above the surface, so that it does not hide itself: more than
/// what an `f32` depth rounds off.
const LIFT: f64 = 1.0e-5;

/// The triangles of a frame in world coordinates, all of them solid: a ray does not test alpha.
#[derive(Clone, Debug)]
pub struct Occluders {
    triangles: Vec<Occluder>,
}

/// A triangle: a corner, the edges from it, and a sphere around it.
#[derive(Clone, Copy, Debug)]
struct Occluder {
    corner: DVec3,
    edges: [DVec3; 2],
    middle: DVec3,
    radius_squared: f64,
}

impl Occluders {
    /// Puts the triangles of a mesh where they are in a frame.
    #[must_use]
    pub fn new(mesh: &Mesh, frame: f64) -> Self {
        let triangles = mesh.triangles.iter().map(|triangle| {
            let object = &mesh.objects[triangle.object as usize];
            let to_world = object.to_world(frame);
            let [a, b, c] = triangle.corners.map(|corner| {
                to_world.transform_point3(object.deform(mesh.vertices[corner as usize].object, frame))
            });
            let middle = (a + b + c) / 3.0;
            let radius_squared =
                [a, b, c].map(|corner| corner.distance_squared(middle)).into_iter().fold(0.0, f64::max);
            Occluder { corner: a, edges: [b - a, c - a], middle, radius_squared }
        });
        Self { triangles: triangles.collect() }
    }

    /// Returns whether a ray from a point of a triangle is open; `point` is seen from `eye`, and the ray leaves on that
    /// side.
    #[must_use]
    pub fn is_open(&self, triangle: u32, point: DVec3, eye: DVec3, chi: [f64; 2], reach: f64) -> bool {
        let [u, v] = self.triangles[triangle as usize].edges;
        let normal = u.cross(v).normalize_or_zero();
        let to_eye = eye - point;
        let normal = if normal.dot(to_eye) < 0.0 { -normal } else { normal };
        let origin = point + normal * (LIFT * to_eye.length());
        // A number that is none leads nowhere, where nothing is in the way.
        open(normal, chi, |direction| self.is_hit(origin, direction, reach))
    }

    /// Returns whether a triangle is in the way of a ray, from either side, within `reach`; `direction` has length one.
    fn is_hit(&self, origin: DVec3, direction: DVec3, reach: f64) -> bool {
        self.triangles.iter().any(|triangle| triangle.is_hit(origin, direction, reach))
    }
}

impl Occluder {
    /// Moller & Trumbore 1997, after a look at the sphere.
    fn is_hit(&self, origin: DVec3, direction: DVec3, reach: f64) -> bool {
        let to_middle = self.middle - origin;
        if to_middle.length_squared() - to_middle.dot(direction).powi(2) > self.radius_squared {
            return false;
        }
        let across = direction.cross(self.edges[1]);
        let determinant = self.edges[0].dot(across);
        let to_origin = origin - self.corner;
        let u = to_origin.dot(across) / determinant;
        let along = to_origin.cross(self.edges[0]);
        let v = direction.dot(along) / determinant;
        let distance = self.edges[1].dot(along) / determinant;
        // A determinant of 0, a ray along the triangle, makes one of them infinite or no number.
        u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0 && distance < reach
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::draw::mesh::{Object, Vertex};
    use glam::{DAffine3, DVec2, dvec3};
    use rand::rngs::Xoshiro256PlusPlus;
    use rand::{RngExt, SeedableRng};

    /// A floor at y = 0 and a wall at x = 0 of a height, both long.
    fn corner_of(height: f64) -> Occluders {
        let object = Object { to_world: DAffine3::IDENTITY, drift: DVec3::ZERO, spin: 0.0, sway: [0.0; 2] };
        let mut mesh = Mesh { objects: vec![object], ..Mesh::default() };
        let mut add = |corners: [DVec3; 4]| {
            mesh.quad(corners.map(|object| Vertex { object, part: object, texcoord: DVec2::ZERO }), 0, 0);
        };
        let far = 1.0e4;
        add([dvec3(0.0, 0.0, -far), dvec3(far, 0.0, -far), dvec3(far, 0.0, far), dvec3(0.0, 0.0, far)]);
        add([dvec3(0.0, 0.0, -far), dvec3(0.0, height, -far), dvec3(0.0, height, far), dvec3(0.0, 0.0, far)]);
        Occluders::new(&mesh, 0.0)
    }

    /// A long wall that rises by an angle hides (1 - cos angle) / 2 of the cosine-weighted sky.
    #[test]
    fn a_wall_hides_the_share_of_the_sky_that_it_must() {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(1);
        for (height, reach) in [(1.0, 1.0e3), (3.0, 1.0e3), (0.2, 1.0e3), (3.0, 0.5)] {
            let occluders = corner_of(height);
            let n = 20_000;
            let point = dvec3(1.0, 0.0, 0.3);
            let open = (0..n).filter(|_| {
                let chi = [rng.random(), rng.random()];
                occluders.is_open(0, point, dvec3(2.0, 5.0, 0.0), chi, reach)
            });
            let found = open.count() as f64 / f64::from(n);
            let hidden = if reach < 1.0 { 0.0 } else { 0.5 * (1.0 - 1.0 / libm::hypot(1.0, height)) };
            assert!((found - (1.0 - hidden)).abs() < 0.012, "{height}: {found}, {hidden} hidden");
        }
    }

    /// Rays leave on the side that is seen: below the floor there is no wall.
    #[test]
    fn rays_leave_towards_the_viewer() {
        let occluders = corner_of(1.0e3);
        let towards_wall = [0.9, 0.0];
        let seen = |eye: DVec3| {
            [0.0, 0.25, 0.5, 0.75]
                .map(|turn| occluders.is_open(0, dvec3(1.0, 0.0, 0.0), eye, [towards_wall[0], turn], 1.0e3))
        };
        assert!(seen(dvec3(2.0, 5.0, 0.0)).contains(&false));
        assert_eq!(seen(dvec3(2.0, -5.0, 0.0)), [true; 4]);
    }
}
