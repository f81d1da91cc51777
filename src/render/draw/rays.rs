//! Rays from surfaces, and whether something is in their way (§9, Fig. 8).

use super::extent::{Extent, Ray};
use super::hierarchy::Hierarchy;
use super::mesh::Mesh;
use crate::technique::occlusion::open;
use glam::DVec3;

/// Rays start this share of their distance to the viewer above the surface, so that it does not hide itself: more than
/// what an `f32` depth rounds off.
const LIFT: f64 = 1.0e-5;

/// The box of a triangle is larger by this share of the largest coordinate of the frame: more than what is rounded where a ray
/// is met with its box and with itself.
const MARGIN: f64 = 1.0e-9;

/// The triangles of a frame in world coordinates, all of them solid: a ray does not test alpha.
#[derive(Clone, Debug)]
pub struct Occluders {
    triangles: Vec<Occluder>,
    hierarchy: Hierarchy,
}

/// A triangle: a corner, and the edges from it.
#[derive(Clone, Copy, Debug)]
struct Occluder {
    corner: DVec3,
    edges: [DVec3; 2],
}

impl Occluders {
    /// Puts the triangles of a mesh where they are in a frame.
    #[must_use]
    pub fn new(mesh: &Mesh, frame: f64) -> Self {
        let corners: Vec<[DVec3; 3]> =
            mesh.triangles.iter().map(|triangle| mesh.place(triangle, frame)).collect();
        Self::of(&corners)
    }

    fn of(corners: &[[DVec3; 3]]) -> Self {
        let triangles = corners.iter().map(Occluder::new).collect();
        Self { triangles, hierarchy: Hierarchy::new(extents(corners).into_iter()) }
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
        open(normal, chi, |direction| self.is_hit(&Ray::new(origin, direction, reach)))
    }

    /// Returns whether a triangle is in the way of a ray, from either side.
    fn is_hit(&self, ray: &Ray) -> bool {
        self.hierarchy.any(ray, |triangle| self.triangles[triangle as usize].is_hit(ray))
    }
}

/// The box of each triangle, somewhat larger; none where one is not all numbers, which no ray hits.
fn extents(corners: &[[DVec3; 3]]) -> Vec<Option<Extent>> {
    let is_finite = |corners: &&[DVec3; 3]| corners.iter().all(|corner| corner.is_finite());
    let largest = corners.iter().filter(is_finite).flatten().map(|corner| corner.abs().max_element());
    let margin = MARGIN * largest.fold(0.0, f64::max);
    corners.iter().map(|of| is_finite(&of).then(|| Extent::around(of).widened(margin))).collect()
}

impl Occluder {
    fn new(&[a, b, c]: &[DVec3; 3]) -> Self {
        Self { corner: a, edges: [b - a, c - a] }
    }

    /// Moller & Trumbore 1997.
    fn is_hit(&self, ray: &Ray) -> bool {
        let across = ray.direction.cross(self.edges[1]);
        let determinant = self.edges[0].dot(across);
        let to_origin = ray.origin - self.corner;
        let u = to_origin.dot(across) / determinant;
        let along = to_origin.cross(self.edges[0]);
        let v = ray.direction.dot(along) / determinant;
        let distance = self.edges[1].dot(along) / determinant;
        // A determinant of 0, a ray along the triangle, makes one of them infinite or no number.
        u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0 && distance < ray.reach
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
            let corner =
                |object| Vertex { object, part: object, texcoord: DVec2::ZERO, tint: glam::DVec4::ONE };
            mesh.quad(corners.map(corner), 0, 0);
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

    /// Whether some triangle whose box a ray meets is in its way, by a look at each of them.
    fn is_hit_by_any(corners: &[[DVec3; 3]], ray: &Ray) -> bool {
        let boxes = extents(corners);
        let met = corners.iter().zip(&boxes).filter(|(_, extent)| extent.is_some_and(|of| ray.meets(&of)));
        met.into_iter().any(|(corners, _)| Occluder::new(corners).is_hit(ray))
    }

    /// A place in the unit cube, on a grid of sixteenths or not, so that coordinates are often equal.
    fn place(rng: &mut Xoshiro256PlusPlus, on_grid: bool) -> DVec3 {
        let place = DVec3::from([0; 3].map(|_| rng.random::<f64>()));
        if on_grid { (place * 16.0).round() / 16.0 } else { place }
    }

    /// Triangles of every kind: scattered, on a grid, without area, one over another, far away, no numbers.
    fn triangles(rng: &mut Xoshiro256PlusPlus, count: usize) -> Vec<[DVec3; 3]> {
        let mut found: Vec<[DVec3; 3]> = Vec::new();
        while found.len() < count {
            let kind = rng.random_range(0..12);
            let a = place(rng, kind % 2 == 0);
            let [u, v] = [0; 2].map(|_| (place(rng, kind % 2 == 0) - 0.5) * 0.6);
            found.push(match kind {
                0 => [a, a + u, a + u],
                1 => [a; 3],
                2 => [a, a + u, a + 2.0 * u],
                3 | 4 if !found.is_empty() => found[rng.random_range(0..found.len())],
                5 => [a * 1.0e6, a * 1.0e6 + u, a * 1.0e6 + v],
                6 => [a, a + u, DVec3::new(f64::NAN, f64::INFINITY, 0.0)],
                7 => [a, a + u.with_z(0.0), a + v.with_z(0.0)],
                _ => [a, a + u, a + v],
            });
        }
        found
    }

    #[test]
    fn the_hierarchy_finds_what_a_look_at_every_triangle_finds() {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(7);
        let (mut hits, mut rays) = (0, 0);
        for count in [0, 1, 2, 3, 5, 40, 300].repeat(6) {
            let corners = triangles(&mut rng, count);
            let occluders = Occluders::of(&corners);
            for _ in 0..100 {
                let (origin, reach) = (place(&mut rng, rays % 2 == 0), rng.random::<f64>() * 2.0);
                let ray = Ray::new(origin, (place(&mut rng, false) - 0.5).normalize(), reach);
                let by_any = corners.iter().any(|corners| Occluder::new(corners).is_hit(&ray));
                assert_eq!(occluders.is_hit(&ray), by_any, "{count}: {ray:?}");
                (hits, rays) = (hits + u32::from(by_any), rays + 1);
            }
            // From a corner of a triangle, or a point of its plane, along an edge, in its plane or along an axis.
            for &[a, b, c] in corners.iter().take(40) {
                for origin in [a, a + 0.7 * (a - b), a + 0.3 * (b - a) + 2.0 * (c - a)] {
                    let in_plane = [b - a, c - b, 0.4 * (b - a) + 0.3 * (c - a)];
                    for direction in in_plane.into_iter().chain(DVec3::AXES).flat_map(|d| [d, -d]) {
                        let ray = Ray::new(origin, direction.normalize_or_zero(), 1.0);
                        assert_eq!(occluders.is_hit(&ray), is_hit_by_any(&corners, &ray), "{count}: {ray:?}");
                    }
                }
            }
        }
        // Neither none nor all.
        assert!(hits > rays / 50 && hits < rays / 2, "{hits} of {rays}");
    }

    /// A ray that starts where nothing is, or is no number, meets nothing.
    #[test]
    fn rays_that_are_no_numbers_hit_nothing() {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(3);
        let occluders = Occluders::of(&triangles(&mut rng, 100));
        for (origin, direction) in
            [(DVec3::NAN, DVec3::X), (DVec3::ZERO, DVec3::NAN), (DVec3::INFINITY, DVec3::X)]
        {
            assert!(!occluders.is_hit(&Ray::new(origin, direction, 1.0e3)));
        }
    }

    /// A ray through a cloud of many triangles looks at few of them, even where it hits none.
    #[test]
    fn a_ray_looks_at_few_triangles() {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(5);
        let small = |rng: &mut Xoshiro256PlusPlus| {
            let a = place(rng, false);
            [a, a + place(rng, false) * 0.01, a + place(rng, false) * 0.01]
        };
        let corners: Vec<[DVec3; 3]> = (0..20_000).map(|_| small(&mut rng)).collect();
        let occluders = Occluders::of(&corners);
        let (mut looks, rays) = (0, 1000);
        for _ in 0..rays {
            let ray = Ray::new(place(&mut rng, false), (place(&mut rng, false) - 0.5).normalize(), 2.0);
            let is_met = occluders.hierarchy.any(&ray, |_| {
                looks += 1;
                false
            });
            assert!(!is_met);
        }
        // A box has a side of 0.007 in the mean, so that a ray goes through about one of 20 000.
        assert!(looks < 8 * rays, "{looks} looks for {rays} rays");
    }
}
