//! Triangles of the world on the screen: which pixels they cover, and attributes as functions of the place.

use super::fragments::{Needs, Space};
use super::mesh::{Mesh, Triangle};
use crate::scene::Camera;
use crate::technique::conservative::covered;
use glam::{DVec2, DVec3, DVec4, dvec2, dvec3};

/// A function that is affine over the screen: value = x * pixel.x + y * pixel.y + z.
pub(in crate::render) type Plane = DVec3;

/// A triangle on the screen.
#[derive(Clone, Debug)]
pub(in crate::render) struct Projected {
    /// First and last pixel that it may cover, along each axis.
    pub(in crate::render) bounds: [[u32; 2]; 2],
    shape: Shape,
    pub(in crate::render) inverse_depth: Plane,
    /// Texture coordinate over depth.
    pub(in crate::render) texcoord: [Plane; 2],
    /// What is hashed, over depth.
    pub(in crate::render) place: [Plane; 3],
    /// What colour and alpha are multiplied by, over depth; `None` where no vertex of the mesh changes them.
    pub(in crate::render) tint: Option<[Plane; 4]>,
    pub(in crate::render) triangle: u32,
}

/// What is drawn of a triangle.
#[derive(Clone, Copy)]
pub(in crate::render) struct Sides {
    /// Whether it is seen from both sides.
    pub(in crate::render) both: bool,
    /// Whether its vertices may change colour and alpha.
    pub(in crate::render) tinted: bool,
}

/// What a triangle covers of a pixel.
pub(in crate::render) struct Covered {
    pub(in crate::render) share: f64,
    /// A bit for each sample.
    pub(in crate::render) samples: u64,
    /// The place that is shaded, in pixels.
    pub(in crate::render) place: DVec2,
}

/// Which pixels a triangle covers.
#[derive(Clone, Debug)]
enum Shape {
    /// Those whose centre is inside: signed distances from the edges, positive inside; and whether a pixel on the edge
    /// belongs to it.
    Edges([(Plane, bool); 3]),
    /// Those that it touches: its corners.
    Outline([DVec2; 3]),
}

/// A corner after projection.
#[derive(Clone, Copy)]
pub(in crate::render) struct Corner {
    eye: DVec3,
    texcoord: DVec2,
    place: DVec3,
    tint: DVec4,
}

impl Projected {
    /// Returns whether it may cover a place within a rectangle of pixels, of which the first and the last along each axis are
    /// given.
    ///
    /// It is never wrong about a place that is covered: along each axis, what an edge says of a place only grows or only falls,
    /// rounded or not, so that it says most at a corner.
    pub(in crate::render) fn may_cover(&self, [[left, right], [top, bottom]]: [[u32; 2]; 2]) -> bool {
        let along = |slope: f64, first: u32, last: u32| f64::from(if slope > 0.0 { last + 1 } else { first });
        match &self.shape {
            Shape::Edges(edges) => edges.iter().all(|(edge, _)| {
                let most = dvec3(along(edge.x, left, right), along(edge.y, top, bottom), 1.0);
                edge.dot(most) >= 0.0
            }),
            Shape::Outline(_) => true,
        }
    }

    /// What it covers of a pixel that has its samples at `places`; `None` for a pixel without fragment.
    #[inline]
    pub(in crate::render) fn covers(&self, [x, y]: [u32; 2], places: &[DVec2]) -> Option<Covered> {
        let corner = dvec2(f64::from(x), f64::from(y));
        match &self.shape {
            Shape::Edges(edges) => {
                let is_inside = |place: DVec2| {
                    edges.iter().all(|(edge, inclusive)| {
                        let inside = edge.dot((corner + place).extend(1.0));
                        inside > 0.0 || (inside == 0.0 && *inclusive)
                    })
                };
                if let [only] = places {
                    // The centre.
                    return is_inside(*only).then(|| Covered {
                        share: 1.0,
                        samples: 1,
                        place: corner + *only,
                    });
                }
                let inside = (0_u32..).zip(places).filter(|(_, place)| is_inside(**place));
                let samples = inside.fold(0_u64, |mask, (i, _)| mask | 1 << i);
                let first = places.get(samples.trailing_zeros() as usize)?;
                let centre = DVec2::splat(0.5);
                let place = corner + if is_inside(centre) { centre } else { *first };
                Some(Covered { share: 1.0, samples, place })
            }
            Shape::Outline(corners) => {
                let (share, middle) = covered(corners, [x as i32, y as i32])?;
                Some(Covered { share, samples: u64::MAX, place: corner + middle })
            }
        }
    }
}

/// The corners of a triangle in a frame, and its colour factor.
pub(in crate::render) fn corners(
    mesh: &Mesh,
    triangle: &Triangle,
    camera: &Camera,
    frame: f64,
    space: Space,
) -> ([Corner; 3], f32) {
    let object = &mesh.objects[triangle.object as usize];
    let worlds = mesh.place(triangle, frame);
    let mut corners = [0, 1, 2].map(|c| {
        let vertex = &mesh.vertices[triangle.corners[c] as usize];
        let eye = camera.to_eye(worlds[c]);
        let place = match space {
            Space::Object => vertex.object,
            Space::Deformed => object.deform(vertex.object, frame),
            Space::Part => vertex.part,
            Space::World => worlds[c],
            Space::Texture => vertex.texcoord.extend(0.0),
            Space::Eye => eye,
            Space::Screen | Space::Device => DVec3::ZERO,
        };
        Corner { eye, texcoord: vertex.texcoord, place, tint: vertex.tint }
    });
    // Light from the upper left, on both sides alike.
    let normal = (worlds[1] - worlds[0]).cross(worlds[2] - worlds[0]).normalize_or_zero();
    let shade = 0.55 + 0.45 * normal.dot(dvec3(-0.4, 0.8, 0.45)).abs();
    if corners.iter().any(|corner| !corner.eye.is_finite()) {
        // Cut away as a whole.
        corners.iter_mut().for_each(|corner| corner.eye = DVec3::NEG_Z);
    }
    (corners, shade.min(1.0) as f32)
}

/// Cuts off what is nearer than `near`.
pub(in crate::render) fn cut_near(corners: [Corner; 3], near: f64) -> Vec<Corner> {
    let mut polygon = Vec::with_capacity(4);
    for (index, &here) in corners.iter().enumerate() {
        let next = corners[(index + 1) % 3];
        if here.eye.z >= near {
            polygon.push(here);
        }
        if (here.eye.z >= near) != (next.eye.z >= near) {
            let share = (near - here.eye.z) / (next.eye.z - here.eye.z);
            polygon.push(Corner {
                eye: here.eye.lerp(next.eye, share),
                texcoord: here.texcoord.lerp(next.texcoord, share),
                place: here.place.lerp(next.place, share),
                tint: here.tint.lerp(next.tint, share),
            });
        }
    }
    polygon
}

/// Twice the signed area of the triangle of two corners and a point, as a function of that point.
fn edge(from: DVec2, to: DVec2) -> Plane {
    dvec3(from.y - to.y, to.x - from.x, from.x * to.y - from.y * to.x)
}

/// Puts a triangle on the screen; `None` if it covers no pixel.
pub(in crate::render) fn project(
    corners: &[Corner; 3],
    camera: &Camera,
    offset: DVec2,
    triangle: u32,
    needs: Needs,
    sides: Sides,
) -> Option<Projected> {
    let pixels = 1.0 / camera.direction_dx.length();
    let rows = 1.0 / camera.direction_dy.length();
    let mut corners = *corners;
    let place = |corner: &Corner| {
        let eye = corner.eye;
        dvec2(eye.x / eye.z * pixels, eye.y / eye.z * rows) + camera.size() / 2.0 + offset
    };
    let area = |[a, b, c]: [DVec2; 3]| edge(a, b).dot(c.extend(1.0));
    let mut exact = corners.each_ref().map(place);
    let mut rounded =
        if needs.coverage { exact } else { exact.map(|corner| (corner * 256.0).round() / 256.0) };
    // Rows go down, so that what goes round counter-clockwise has a negative area.
    let is_front = area(rounded) < 0.0;
    if !(is_front || sides.both) {
        return None;
    }
    if is_front {
        corners.swap(1, 2);
        exact.swap(1, 2);
        rounded.swap(1, 2);
    }
    let whole = area(exact);
    if area(rounded).is_nan() || area(rounded) <= 0.0 || whole <= 0.0 {
        return None;
    }
    let bounds = [0, 1].map(|axis| {
        let low = rounded.iter().map(|corner| corner[axis]).fold(f64::INFINITY, f64::min);
        let high = rounded.iter().map(|corner| corner[axis]).fold(f64::NEG_INFINITY, f64::max);
        let last = f64::from(camera.resolution[axis]) - 1.0;
        // Pixels that may be touched or have a sample inside, or whose centre may be inside.
        let [first, end] = if needs.coverage || needs.samples.is_some() {
            [low.floor(), high.ceil() - 1.0]
        } else {
            [(low - 0.5).ceil(), (high - 0.5).floor()]
        };
        [first.max(0.0), end.min(last)]
    });
    if bounds.iter().any(|[first, last]| first > last) {
        return None;
    }
    let edges = [[1, 2], [2, 0], [0, 1]].map(|[from, to]| {
        let plane = edge(rounded[from], rounded[to]);
        // The upper and the left edge belong to the triangle.
        let inclusive = plane.x > 0.0 || (plane.x == 0.0 && plane.y > 0.0);
        (plane, inclusive)
    });
    let weights = [[1, 2], [2, 0], [0, 1]].map(|[from, to]| edge(exact[from], exact[to]) / whole);
    let plane = |value: &dyn Fn(&Corner) -> f64| -> Plane {
        (0..3).map(|c| weights[c] * (value(&corners[c]) / corners[c].eye.z)).sum()
    };
    Some(Projected {
        bounds: bounds.map(|ends| ends.map(|pixel| pixel as u32)),
        shape: if needs.coverage { Shape::Outline(exact) } else { Shape::Edges(edges) },
        inverse_depth: plane(&|_| 1.0),
        texcoord: [plane(&|corner| corner.texcoord.x), plane(&|corner| corner.texcoord.y)],
        place: [
            plane(&|corner| corner.place.x),
            plane(&|corner| corner.place.y),
            plane(&|corner| corner.place.z),
        ],
        tint: sides.tinted.then(|| [0, 1, 2, 3].map(|c| plane(&|corner| corner.tint[c]))),
        triangle,
    })
}
