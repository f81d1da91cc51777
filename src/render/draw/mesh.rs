//! Triangles: what every surface becomes before it is drawn.

use glam::{DAffine3, DVec2, DVec3, DVec4};
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
    /// What the colour and the alpha of the texture are multiplied by: red, green, blue, alpha, [0, 1] each.
    pub tint: DVec4,
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
    /// Whether it is seen from one side only: from where its corners go round counter-clockwise.
    pub single_sided: bool,
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
    /// Returns where the corners of a triangle are in the world in a frame, after the deformation of its object.
    #[must_use]
    pub fn place(&self, triangle: &Triangle, frame: f64) -> [DVec3; 3] {
        let object = &self.objects[triangle.object as usize];
        let to_world = object.to_world(frame);
        triangle.corners.map(|corner| {
            to_world.transform_point3(object.deform(self.vertices[corner as usize].object, frame))
        })
    }

    /// Returns whether some vertex changes the colour or the alpha of its texture.
    #[must_use]
    pub fn is_tinted(&self) -> bool {
        self.vertices.iter().any(|vertex| vertex.tint != DVec4::ONE)
    }

    /// Returns for each triangle the number of the part that it belongs to: triangles of an object that share a corner are
    /// of one part, however many vertices that corner has, and whatever the unit of length.
    ///
    /// Corners are one that differ by no more than four spacings of `f32` at the object's largest coordinate, as rounding
    /// leaves them.
    #[must_use]
    pub fn parts(&self) -> Vec<u32> {
        /// Side of the cells that corners share, over the largest coordinate: what is at most half of it apart is in one
        /// cell of some grid below.
        const CELL: f64 = 8.0 * f32::EPSILON as f64;
        /// Grids that are half a cell apart, along each axis.
        const GRIDS: u32 = 8;
        let mut largest = vec![0.0_f64; self.objects.len()];
        let place = |corner: u32| self.vertices[corner as usize].object;
        for triangle in &self.triangles {
            let reach = triangle.corners.map(|corner| place(corner).abs().max_element());
            let of_object = &mut largest[triangle.object as usize];
            *of_object = reach.into_iter().fold(*of_object, f64::max);
        }
        let mut corners: FxHashMap<(u32, u32, [i32; 3]), u32> = FxHashMap::default();
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
            let side = (CELL * largest[triangle.object as usize]).max(f64::MIN_POSITIVE);
            for (corner, grid) in triangle.corners.into_iter().flat_map(|c| (0..GRIDS).map(move |g| (c, g))) {
                let shift = DVec3::from([0, 1, 2].map(|axis| 0.5 * f64::from(grid >> axis & 1)));
                let cell = (place(corner) / side + shift).floor().to_array().map(|c| c as i32);
                let met = *corners.entry((triangle.object, grid, cell)).or_insert(index as u32);
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
            let corners = corners.map(|c| first + c);
            self.triangles.push(Triangle { corners, object, texture, single_sided: false });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{dvec2, dvec3};

    /// Panels side by side up to rounding, one apart, one in the same place of another object.
    fn panels(scale: f64) -> Mesh {
        let mut mesh = Mesh::default();
        let still = Object { to_world: DAffine3::IDENTITY, drift: DVec3::ZERO, spin: 0.0, sway: [0.0; 2] };
        mesh.objects = vec![still; 2];
        let corner = |x: f64, y: f64| {
            let object = scale * dvec3(x, y, 0.1);
            Vertex { object, part: object, texcoord: dvec2(x, y), tint: DVec4::ONE }
        };
        let rounded = f64::from((0.3 * scale) as f32) / scale;
        for (left, right, object) in
            [(0.0, 0.3, 0), (rounded, 0.6, 0), (0.601, 0.9, 0), (5.0, 5.3, 0), (0.0, 0.3, 1)]
        {
            let corners = [[left, 0.0], [right, 0.0], [right, 1.0], [left, 1.0]].map(|[x, y]| corner(x, y));
            mesh.quad(corners, object, 0);
        }
        mesh
    }

    #[test]
    fn triangles_that_share_a_corner_are_of_one_part_in_every_unit() {
        for scale in [1e-30, 1e-4, 0.37, 1.0, 1e4, 1e30] {
            assert_eq!(panels(scale).parts(), [0, 0, 0, 0, 4, 4, 6, 6, 8, 8], "{scale}");
        }
    }

    /// Wherever the borders of cells are: corners that rounding has moved are one, those that lie apart are not.
    #[test]
    fn corners_are_one_as_far_as_rounding_goes() {
        let spacing = 1.0 / f64::from(1_u32 << 23);
        for start in 0..200 {
            let start = 0.3 + 0.37 * f64::from(start) * spacing;
            for (apart, is_one) in [(3.9, true), (-3.9, true), (8.1, false)] {
                let mut mesh = panels(1.0);
                mesh.triangles.truncate(4);
                for (index, vertex) in mesh.vertices.iter_mut().enumerate() {
                    vertex.object.x = match index {
                        1 | 2 => start,
                        4 | 7 => start + apart * spacing,
                        _ => vertex.object.x,
                    };
                }
                let parts = mesh.parts();
                assert_eq!(parts[0] == parts[2], is_one, "{start} {apart}");
            }
        }
    }
}
