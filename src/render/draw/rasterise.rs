//! Triangles to fragments: perspective-correct attributes with analytic screen derivatives, tile by tile.
//!
//! Which pixels a triangle covers is decided on corners that are rounded to 1/256 of a pixel, as hardware does, so that
//! triangles which share an edge share no pixel and leave none out. Attributes are those of the exact corners. With several
//! samples the same is decided for each of them; attributes are those of the centre, or of a covered sample where the centre
//! is outside ("centroid"). Where the covered share of
//! pixels is needed, every pixel that an exact triangle touches is drawn, with the attributes in the middle of what is covered.

use super::fragments::{Fragments, Needs, Space};
use super::mesh::Mesh;
use super::project::{Plane, Projected, Sides, corners, cut_near, project};
use crate::scene::Camera;
use crate::technique::multisampling::sample_place;
use core::num::NonZeroU32;
use glam::{DVec2, DVec3, vec2};
use rayon::prelude::*;

/// Pixels along each side of a tile.
pub const TILE: u32 = 32;

/// Surfaces nearer than this are cut off, in units of the distance between camera and world origin or in object units,
/// whichever is more.
const NEAR: f64 = 1.0e-4;

/// The triangles of one frame, sorted into tiles.
pub struct Screen {
    size: [u32; 2],
    space: Space,
    needs: Needs,
    /// Where the samples of a pixel are, from its upper left corner; the centre if nobody needs them.
    places: Vec<DVec2>,
    projected: Vec<Projected>,
    tiles: Vec<Vec<u32>>,
    /// Colour factor of each triangle of the mesh, by the angle between its normal and the light.
    shade: Vec<f32>,
}

impl Screen {
    /// Projects every triangle of a mesh in a frame; `offset` moves the image to the right and down, in pixels.
    #[must_use]
    pub fn new(mesh: &Mesh, camera: &Camera, frame: f64, offset: DVec2, space: Space, needs: Needs) -> Self {
        let size = camera.resolution;
        let tinted = mesh.is_tinted();
        let near = NEAR * camera.eye.length().max(1.0);
        let found: Vec<(Vec<Projected>, f32)> = (0..mesh.triangles.len())
            .into_par_iter()
            .map(|index| {
                let triangle = &mesh.triangles[index];
                let (corners, shade) = corners(mesh, triangle, camera, frame, space);
                let polygon = cut_near(corners, near);
                let sides = Sides { both: !triangle.single_sided, tinted };
                let fan = (2..polygon.len()).filter_map(|last| {
                    let corners = [polygon[0], polygon[last - 1], polygon[last]];
                    project(&corners, camera, offset, index as u32, needs, sides)
                });
                (fan.collect(), shade)
            })
            .collect();
        let shade = found.iter().map(|(_, shade)| *shade).collect();
        let projected: Vec<Projected> = found.into_iter().flat_map(|(fan, _)| fan).collect();
        let across = size[0].div_ceil(TILE);
        let mut tiles = vec![Vec::new(); (across * size[1].div_ceil(TILE)) as usize];
        for (index, triangle) in projected.iter().enumerate() {
            let [[left, right], [top, bottom]] = triangle.bounds.map(|ends| ends.map(|pixel| pixel / TILE));
            for y in top..=bottom {
                for x in left..=right {
                    let of_tile = [x, y].map(|along| [along * TILE, along * TILE + TILE - 1]);
                    if triangle.may_cover(of_tile) {
                        tiles[(y * across + x) as usize].push(index as u32);
                    }
                }
            }
        }
        let samples = needs.samples.unwrap_or(NonZeroU32::MIN);
        let places = (0..samples.get()).map(|i| DVec2::from(sample_place(i, samples)) + 0.5).collect();
        Self { size, space, needs, places, projected, tiles, shade }
    }

    /// Returns the number of tiles.
    #[must_use]
    pub fn tiles(&self) -> usize {
        self.tiles.len()
    }

    /// Returns the upper left pixel of a tile, and its width and height in pixels.
    #[must_use]
    pub fn tile(&self, tile: usize) -> ([u32; 2], [u32; 2]) {
        let across = self.size[0].div_ceil(TILE);
        let corner = [tile as u32 % across * TILE, tile as u32 / across * TILE];
        (corner, [0, 1].map(|axis| TILE.min(self.size[axis] - corner[axis])))
    }

    /// Returns the colour factor of a triangle of the mesh, in [0.55, 1].
    #[must_use]
    pub fn shade(&self, triangle: u32) -> f32 {
        self.shade[triangle as usize]
    }

    /// Replaces `out` by the fragments of a tile.
    pub fn fragments(&self, tile: usize, out: &mut Fragments) {
        out.clear();
        let (corner, size) = self.tile(tile);
        for &index in &self.tiles[tile] {
            let triangle = &self.projected[index as usize];
            let [columns, rows] = [0, 1].map(|axis| {
                let [first, last] = triangle.bounds[axis];
                first.max(corner[axis])..(last + 1).min(corner[axis] + size[axis])
            });
            for y in rows {
                for x in columns.clone() {
                    if let Some(covered) = triangle.covers([x, y], &self.places) {
                        let pixel = (y - corner[1]) * TILE + (x - corner[0]);
                        self.add(triangle, pixel as u16, covered.place.extend(1.0), out);
                        if self.needs.coverage {
                            out.coverage.push(covered.share);
                        }
                        if self.needs.samples.is_some() {
                            out.covered.push(covered.samples);
                        }
                    }
                }
            }
        }
        if self.needs.layer {
            let mut seen = [0_u32; (TILE * TILE) as usize];
            out.layer.extend(out.pixel.iter().map(|&pixel| {
                seen[usize::from(pixel)] += 1;
                seen[usize::from(pixel)] - 1
            }));
        }
    }

    fn add(&self, triangle: &Projected, pixel: u16, centre: DVec3, out: &mut Fragments) {
        let depth = 1.0 / triangle.inverse_depth.dot(centre);
        let value = |plane: Plane| plane.dot(centre) * depth;
        // The quotient rule, with the numerator and the denominator affine.
        let derivative = |plane: Plane, value: f64, axis: usize| {
            (plane[axis] - value * triangle.inverse_depth[axis]) * depth
        };
        out.pixel.push(pixel);
        out.triangle.push(triangle.triangle);
        out.depth.push(depth as f32);
        let [u, v] = triangle.texcoord.map(value);
        out.texcoord.push(vec2(u as f32, v as f32));
        if let Some(tint) = triangle.tint {
            // The place may lie outside of the triangle, where a vertex colour goes on beyond its bounds.
            out.tint.push(tint.map(|plane| value(plane).clamp(0.0, 1.0) as f32));
        }
        if self.needs.texture_derivatives {
            let [s, t] = triangle.texcoord;
            out.dtdx.push(vec2(derivative(s, u, 0) as f32, derivative(t, v, 0) as f32));
            out.dtdy.push(vec2(derivative(s, u, 1) as f32, derivative(t, v, 1) as f32));
        }
        if self.needs.footprint {
            let mut push = |c: usize, place: f64, dx: f64, dy: f64| {
                out.footprint.position[c].push(place as f32);
                out.footprint.dpdx[c].push(dx as f32);
                out.footprint.dpdy[c].push(dy as f32);
            };
            match self.space {
                Space::Screen => {
                    push(0, centre.x, 1.0, 0.0);
                    push(1, centre.y, 0.0, 1.0);
                    push(2, 0.0, 0.0, 0.0);
                }
                Space::Device => {
                    let [width, height] = self.size.map(f64::from);
                    push(0, 2.0 * centre.x / width - 1.0, 2.0 / width, 0.0);
                    push(1, 1.0 - 2.0 * centre.y / height, 0.0, -2.0 / height);
                    push(2, 0.0, 0.0, 0.0);
                }
                Space::Object
                | Space::Deformed
                | Space::Part
                | Space::World
                | Space::Texture
                | Space::Eye => {
                    for (c, &plane) in triangle.place.iter().enumerate() {
                        let place = value(plane);
                        push(c, place, derivative(plane, place, 0), derivative(plane, place, 1));
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::draw::mesh::{Object, Triangle, Vertex};
    use crate::scene::Rectangle;
    use glam::{DAffine3, DVec4, Vec3, dvec2, dvec3};

    const ALL: Needs = Needs {
        footprint: true,
        texture_derivatives: true,
        layer: true,
        lod: true,
        frame: true,
        pixel: true,
        coverage: false,
        depth: false,
        samples: None,
    };

    fn tilted() -> (Camera, Rectangle, Mesh) {
        let camera = Camera::look_at(dvec3(0.3, -0.2, 4.0), DVec3::ZERO, DVec3::Y, 0.4, [70, 50]);
        let half_u = dvec3(2.0, 0.3, 0.7);
        let half_v = half_u.cross(dvec3(0.1, -0.2, 1.0));
        let rectangle = Rectangle { centre: DVec3::ZERO, half_u, half_v };
        let corner = |u: f64, v: f64| {
            let object = half_u * (2.0 * u - 1.0) + half_v * (2.0 * v - 1.0);
            Vertex { object, part: object, texcoord: dvec2(u, v), tint: DVec4::ONE }
        };
        let mut mesh = Mesh {
            objects: vec![Object {
                to_world: DAffine3::IDENTITY,
                drift: DVec3::ZERO,
                spin: 0.0,
                sway: [0.0; 2],
            }],
            ..Mesh::default()
        };
        mesh.quad([corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)], 0, 0);
        (camera, rectangle, mesh)
    }

    /// The number of pixels that a walk along the outline of [`tilted`] meets.
    fn cut(camera: &Camera, mesh: &Mesh) -> u32 {
        let corners: Vec<DVec3> = mesh.vertices.iter().map(|vertex| vertex.object).collect();
        let steps = 20_000;
        let sides = (0..4).map(|side| (corners[side], corners[(side + 1) % 4]));
        let points = sides.flat_map(|(from, to)| {
            (0..steps).map(move |step| from.lerp(to, f64::from(step) / f64::from(steps)))
        });
        let size = camera.size();
        let seen = points.filter_map(|point| camera.project(point));
        let inside = seen.filter(|place| place.cmpge(DVec2::ZERO).all() && place.cmplt(size).all());
        let mut pixels: Vec<[u32; 2]> = inside.map(|place| [place.x as u32, place.y as u32]).collect();
        pixels.sort_unstable();
        pixels.dedup();
        pixels.len() as u32
    }

    #[test]
    fn fragments_are_those_of_the_analytic_rectangle() {
        let (camera, rectangle, mesh) = tilted();
        let screen = Screen::new(&mesh, &camera, 0.0, DVec2::ZERO, Space::Object, ALL);
        let mut fragments = Fragments::default();
        let mut count = 0;
        for tile in 0..screen.tiles() {
            screen.fragments(tile, &mut fragments);
            let (corner, _) = screen.tile(tile);
            for at in 0..fragments.len() {
                count += 1;
                let pixel = u32::from(fragments.pixel[at]);
                let centre = dvec2(
                    f64::from(corner[0] + pixel % TILE) + 0.5,
                    f64::from(corner[1] + pixel / TILE) + 0.5,
                );
                let Some(exact) = rectangle.fragment(&camera, centre) else { continue };
                let found = fragments.footprint.columns().footprint(at);
                let close = |a: Vec3, b: DVec3| (a.as_dvec3() - b).length() < 1e-6;
                assert!(close(found.position, exact.footprint.position));
                assert!(close(found.dpdx, exact.footprint.dpdx) && close(found.dpdy, exact.footprint.dpdy));
                assert!((fragments.texcoord[at].as_dvec2() - exact.texcoord).length() < 1e-6);
                assert!((f64::from(fragments.depth[at]) - exact.eye.z).abs() < 1e-5);
                assert_eq!(fragments.layer[at], 0);
            }
        }
        let seen = (0..70 * 50)
            .filter(|i| {
                rectangle
                    .footprint(&camera, dvec2(f64::from(i % 70) + 0.5, f64::from(i / 70) + 0.5))
                    .is_some()
            })
            .count();
        assert!((count as i64 - seen as i64).abs() <= 4, "{count} of {seen}");
    }

    #[test]
    fn triangles_that_share_edges_share_no_pixel_and_leave_none_out() {
        // A fan around a point that lies on the centre of a pixel.
        let camera = Camera::look_at(dvec3(0.0, 0.0, 2.0), DVec3::ZERO, DVec3::Y, 0.5, [65, 65]);
        let rim: Vec<DVec3> = (0..24)
            .map(|i| f64::from(i) * core::f64::consts::TAU / 24.0)
            .map(|turn| dvec3(3.0 * libm::cos(turn), 3.0 * libm::sin(turn), 0.0))
            .collect();
        let (_, _, mut mesh) = tilted();
        mesh.vertices = [DVec3::ZERO]
            .into_iter()
            .chain(rim)
            .map(|object| Vertex { object, part: object, texcoord: DVec2::ZERO, tint: DVec4::ONE })
            .collect();
        mesh.triangles = (0..24)
            .map(|i| [0, 1 + i, 1 + (i + 1) % 24])
            .map(|corners| Triangle { corners, object: 0, texture: 0, single_sided: false })
            .collect();
        let screen = Screen::new(&mesh, &camera, 0.0, DVec2::ZERO, Space::Object, Needs::default());
        let mut fragments = Fragments::default();
        for tile in 0..screen.tiles() {
            screen.fragments(tile, &mut fragments);
            let (_, size) = screen.tile(tile);
            let mut pixels = fragments.pixel.clone();
            pixels.sort_unstable();
            pixels.dedup();
            assert_eq!(pixels.len(), fragments.len());
            assert_eq!(fragments.len(), (size[0] * size[1]) as usize);
            assert!(fragments.footprint.position[0].is_empty() && fragments.dtdx.is_empty());
        }
    }

    /// Every pixel gets the area that a fine grid of centres finds, and no pixel more than its own.
    #[test]
    fn touched_pixels_have_the_area_of_the_card() {
        let (camera, _, mesh) = tilted();
        let areas = |camera: &Camera, needs: Needs| {
            let screen = Screen::new(&mesh, camera, 0.0, DVec2::ZERO, Space::Object, needs);
            let (mut fragments, size) = (Fragments::default(), camera.resolution);
            let mut areas = vec![0.0; (size[0] * size[1]) as usize];
            for tile in 0..screen.tiles() {
                screen.fragments(tile, &mut fragments);
                let (corner, _) = screen.tile(tile);
                for at in 0..fragments.len() {
                    let pixel = u32::from(fragments.pixel[at]);
                    let place = (corner[1] + pixel / TILE) * size[0] + corner[0] + pixel % TILE;
                    areas[place as usize] += fragments.coverage.get(at).unwrap_or(&1.0);
                }
            }
            areas
        };
        let touched = areas(&camera, Needs { coverage: true, ..Needs::default() });
        let fine = Camera {
            direction_dx: camera.direction_dx / 32.0,
            direction_dy: camera.direction_dy / 32.0,
            resolution: camera.resolution.map(|side| 32 * side),
            ..camera
        };
        let centres = areas(&fine, Needs::default());
        let mut partial = 0;
        for (at, &area) in touched.iter().enumerate() {
            let [x, y] = [at % 70, at / 70];
            let rows = (32 * y..32 * y + 32).map(|row| &centres[row * 32 * 70 + 32 * x..][..32]);
            let wanted = rows.flatten().sum::<f64>() / 1024.0;
            assert!((area - wanted).abs() < 0.03 && area < 1.0 + 1e-12, "{x} {y}: {area} {wanted}");
            partial += u32::from(area > 0.0 && area < 1.0 - 1e-12);
        }
        // All pixels that a walk along the outline meets are among them.
        let cut = cut(&camera, &mesh);
        assert!(partial >= cut && cut > 0, "{partial} of {cut}");
    }

    #[test]
    fn triangles_that_share_edges_share_no_sample_and_cover_what_finer_pixels_do() {
        let (camera, _, mesh) = tilted();
        let n = NonZeroU32::new(16).unwrap();
        let needs = Needs { samples: Some(n), ..Needs::default() };
        let (mut fragments, mut fine) = (Fragments::default(), Fragments::default());
        let screen = Screen::new(&mesh, &camera, 0.0, DVec2::ZERO, Space::Object, needs);
        let centre = Screen::new(&mesh, &camera, 0.0, DVec2::ZERO, Space::Object, Needs::default());
        let (mut samples, mut whole, mut partial) = (0_u32, 0, 0);
        for tile in 0..screen.tiles() {
            screen.fragments(tile, &mut fragments);
            let mut pixels = vec![0_u64; (TILE * TILE) as usize];
            for (&pixel, &covered) in fragments.pixel.iter().zip(&fragments.covered) {
                assert_eq!(pixels[usize::from(pixel)] & covered, 0);
                pixels[usize::from(pixel)] |= covered;
            }
            samples += pixels.iter().map(|mask| mask.count_ones()).sum::<u32>();
            partial += pixels.iter().filter(|&&mask| mask != 0 && mask != 0xffff).count();
            centre.fragments(tile, &mut fine);
            whole += fine.len();
        }
        // The area of the card, by samples and by centres; its outline is 200 pixels long.
        assert!((f64::from(samples) / 16.0 - whole as f64).abs() < 20.0, "{samples} {whole}");
        // A line that meets a pixel parts its samples unless it misses their hull, which reaches 15/16 across and has at least
        // 3/4 of the outline of the pixel: by Crofton's formula three of four lines do, of which half are asked for.
        let cut = cut(&camera, &mesh);
        assert!(8 * partial > 3 * cut as usize && cut > 0, "{partial} of {cut}");
        // The first of the two has a corner at each place of the outline: one sample is the centre.
        let one = Needs { samples: NonZeroU32::new(1), ..Needs::default() };
        let one = Screen::new(&mesh, &camera, 0.0, DVec2::ZERO, Space::Object, one);
        for tile in 0..one.tiles() {
            one.fragments(tile, &mut fragments);
            centre.fragments(tile, &mut fine);
            assert_eq!((&fragments.pixel, &fragments.depth), (&fine.pixel, &fine.depth));
        }
    }

    #[test]
    fn what_is_behind_the_camera_is_cut_off() {
        let (camera, _, mut mesh) = tilted();
        // A floor that runs through the camera.
        mesh.objects[0].to_world = DAffine3::from_translation(dvec3(0.0, -1.0, 3.0));
        for vertex in &mut mesh.vertices {
            vertex.object = dvec3(vertex.texcoord.x * 20.0 - 10.0, 0.0, vertex.texcoord.y * 20.0 - 10.0);
        }
        let screen = Screen::new(&mesh, &camera, 0.0, DVec2::ZERO, Space::Eye, ALL);
        let mut fragments = Fragments::default();
        let mut count = 0;
        for tile in 0..screen.tiles() {
            screen.fragments(tile, &mut fragments);
            count += fragments.len();
            assert!(fragments.depth.iter().all(|&depth| depth > 0.0));
            assert!(
                fragments.footprint.position[2].iter().zip(&fragments.depth).all(|(z, depth)| z == depth)
            );
        }
        assert!(count > 70 * 50 / 4, "{count}");
    }
}
