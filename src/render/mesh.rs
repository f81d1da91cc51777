//! Triangles: what every surface becomes before it is drawn.

use glam::{DAffine3, DVec2, DVec3};
use rustc_hash::FxHashMap;

/// A corner of a triangle, in every frame of reference that a hash may be anchored to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Position in the coordinates of the whole object, in object units.
    pub object: DVec3,
    /// Position in the coordinates of the part (leaf card, instance) that it belongs to, in object units.
    pub part: DVec3,
    /// Texture coordinate, [0, 1] across the texture.
    pub texcoord: DVec2,
}

/// A triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle {
    /// Its corners, as indices of [`Mesh::vertices`].
    pub corners: [u32; 3],
    /// The object that it belongs to.
    pub object: u32,
    /// The texture that covers it.
    pub texture: u32,
}

/// How an object stands in the world and moves from frame to frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Object {
    /// From object to world coordinates in frame 0.
    pub to_world: DAffine3,
    /// Change of its place in the world, in object units per frame.
    pub drift: DVec3,
    /// Turn about its own y axis, in radians per frame.
    pub spin: f64,
    /// Sideways sway of the points at height one, in object units, and its length in frames; none where that is 0.
    pub sway: [f64; 2],
}

/// Every triangle of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corners.
    pub vertices: Vec<Vertex>,
    /// Triangles, in the order in which they are drawn.
    pub triangles: Vec<Triangle>,
    /// The objects that they belong to.
    pub objects: Vec<Object>,
}

impl Object {
    /// Returns the transformation from object to world coordinates in a frame.
    #[must_use]
    pub fn to_world(&self, frame: f64) -> DAffine3 {
        DAffine3::from_translation(self.drift * frame)
            * self.to_world
            * DAffine3::from_rotation_y(self.spin * frame)
    }

    /// Returns a point of the object in a frame after its deformation, in object coordinates.
    #[must_use]
    pub fn deform(&self, point: DVec3, frame: f64) -> DVec3 {
        let [amplitude, period] = self.sway;
        if period <= 0.0 {
            return point;
        }
        let phase = core::f64::consts::TAU * frame / period;
        // Higher points follow later and go further.
        point + DVec3::X * (amplitude * point.y.max(0.0) * libm::sin(phase - 0.7 * point.y))
    }
}

impl Mesh {
    /// Returns for each triangle the number of the part that it belongs to: triangles of an object that share a corner are
    /// of one part, however many vertices that corner has.
    #[must_use]
    pub fn parts(&self) -> Vec<u32> {
        /// Corners nearer than this are one, in object units.
        const WELD: f64 = 1.0e-6;
        let mut corners: FxHashMap<(u32, [i64; 3]), u32> = FxHashMap::default();
        // Each triangle points to one of its part that came earlier, or to itself.
        let mut parents: Vec<u32> = (0..self.triangles.len() as u32).collect();
        fn root(parents: &mut [u32], mut of: u32) -> u32 {
            while parents[of as usize] != of {
                let grandparent = parents[parents[of as usize] as usize];
                parents[of as usize] = grandparent;
                of = grandparent;
            }
            of
        }
        for (index, triangle) in self.triangles.iter().enumerate() {
            for corner in triangle.corners {
                let place = self.vertices[corner as usize].object / WELD;
                let key = (triangle.object, place.to_array().map(|c| c.round() as i64));
                let met = *corners.entry(key).or_insert(index as u32);
                let [a, b] = [met, index as u32].map(|triangle| root(&mut parents, triangle));
                parents[a.max(b) as usize] = a.min(b);
            }
        }
        (0..parents.len() as u32).map(|triangle| root(&mut parents, triangle)).collect()
    }

    /// Adds a quadrilateral as two triangles; corners in turn around it.
    pub fn quad(&mut self, corners: [Vertex; 4], object: u32, texture: u32) {
        let first = self.vertices.len() as u32;
        self.vertices.extend(corners);
        for corners in [[0, 1, 2], [0, 2, 3]] {
            self.triangles.push(Triangle { corners: corners.map(|c| first + c), object, texture });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{dvec2, dvec3};

    #[test]
    fn triangles_that_share_a_corner_are_of_one_part() {
        let mut mesh = Mesh::default();
        let corner = |x: f64, y: f64| {
            let object = dvec3(x, y, 0.1);
            Vertex { object, part: object, texcoord: dvec2(x, y) }
        };
        // Two panels side by side, up to rounding; one apart; one in the same place of another object.
        for (left, object) in [(0.0, 0), (0.1 + 0.2, 0), (5.0, 0), (0.0, 1)] {
            let right = if left == 0.0 { 0.3 } else { left + 0.3 };
            mesh.quad(
                [corner(left, 0.0), corner(right, 0.0), corner(right, 1.0), corner(left, 1.0)],
                object,
                0,
            );
        }
        assert_eq!(mesh.parts(), [0, 0, 0, 0, 4, 4, 6, 6]);
    }
}
