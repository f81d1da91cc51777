//! Where the surfaces of a frame were in the one before: what stability is measured along.
//!
//! A pixel that keeps its value while a surface moves below it is no stable surface: noise that is locked to the screen slides over
//! whatever it is drawn on. So changes are counted for points of the nearest surface, each followed back through the motion of the
//! camera and of its object.

use super::picture::Picture;
use crate::render::draw::fragments::{Fragments, Needs, Space};
use crate::render::draw::rasterise::{Screen, TILE};
use crate::render::draw::shot::Shot;
use crate::render::scene_file::load::Scene;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// A point is looked for in the frame before only where the surface there is as far as the point should be, up to this share:
/// elsewhere something else was in front of it.
const SAME_DEPTH: f64 = 0.05;

/// The nearest surface of each pixel of a frame, row by row, whatever its alpha.
#[derive(Clone, Debug)]
pub struct Motion {
    size: [u32; 2],
    /// Its distance along the line of sight; infinite without a surface.
    depth: Vec<f32>,
    /// Where the point in the middle of the pixel was in the frame before, in pixels, and its distance there; `None` where
    /// there is no surface, and for what was behind the camera.
    before: Vec<Option<(DVec2, f64)>>,
}

/// Two frames along which a take is measured.
#[derive(Clone, Copy, Debug)]
pub struct Along<'a> {
    /// The later frame.
    pub now: &'a Motion,
    /// The earlier one.
    pub before: &'a Motion,
    /// How far the image of the take is moved within a pixel, in pixels, in the earlier frame less in the later one.
    pub jitter: DVec2,
}

impl Motion {
    /// Finds the surfaces of a frame of a shot; in the first they were where they are.
    #[must_use]
    pub fn new(scene: &Scene, shot: &Shot, index: u32) -> Self {
        let (camera, earlier) = (shot.camera(scene, index, 1), index.saturating_sub(1));
        let camera_before = shot.camera(scene, earlier, 1);
        let needs = Needs { footprint: true, ..Needs::default() };
        let screen = Screen::new(&scene.mesh, &camera, f64::from(index), DVec2::ZERO, Space::Object, needs);
        let earlier = f64::from(earlier);
        let nearest = |fragments: &mut Fragments, tile: usize| {
            screen.fragments(tile, fragments);
            let mut nearest = vec![None; (TILE * TILE) as usize];
            for (at, (&pixel, &depth)) in fragments.pixel.iter().zip(&fragments.depth).enumerate() {
                let held: &mut Option<usize> = &mut nearest[usize::from(pixel)];
                if held.is_none_or(|held| depth < fragments.depth[held]) {
                    *held = Some(at);
                }
            }
            let found = |at: Option<usize>| {
                let Some(at) = at else { return (f32::INFINITY, None) };
                let triangle = &scene.mesh.triangles[fragments.triangle[at] as usize];
                let place = DVec3::from([0, 1, 2].map(|c| f64::from(fragments.footprint.position[c][at])));
                let corners = triangle.corners.map(|corner| scene.mesh.vertices[corner as usize].object);
                // Corners are deformed, and what lies between them goes with them.
                let world = carried(place, corners, scene.mesh.place(triangle, earlier));
                let before = camera_before.project(world);
                (fragments.depth[at], before.map(|place| (place, camera_before.to_eye(world).z)))
            };
            nearest.into_iter().map(found).collect::<Vec<_>>()
        };
        let tiles: Vec<_> =
            (0..screen.tiles()).into_par_iter().map_init(Fragments::default, nearest).collect();
        let size = camera.resolution;
        let pixels = size.map(|side| side as usize).iter().product();
        let mut motion = Self { size, depth: vec![f32::INFINITY; pixels], before: vec![None; pixels] };
        for (tile, found) in tiles.into_iter().enumerate() {
            let ([left, top], [width, height]) = screen.tile(tile);
            for y in 0..height {
                let (from, to) = ((y * TILE) as usize, ((top + y) * size[0] + left) as usize);
                for x in 0..width as usize {
                    (motion.depth[to + x], motion.before[to + x]) = found[from + x];
                }
            }
        }
        motion
    }

    /// Returns the pixels between whose middles a place lies, and the share of a pixel around the place that is of each; those that
    /// are in the image.
    fn shares(&self, place: DVec2) -> impl Iterator<Item = (usize, f64)> {
        let [width, height] = self.size.map(i64::from);
        let first = (place - 0.5).floor();
        let along = place - 0.5 - first;
        [[0, 0], [1, 0], [0, 1], [1, 1]].into_iter().filter_map(move |[right, down]: [i64; 2]| {
            let [x, y] = [(first.x as i64).saturating_add(right), (first.y as i64).saturating_add(down)];
            let share = |by: i64, along: f64| if by == 1 { along } else { 1.0 - along };
            let share = share(right, along.x) * share(down, along.y);
            let is_inside = (0..width).contains(&x) && (0..height).contains(&y) && share > 0.0;
            is_inside.then(|| ((y * width + x) as usize, share))
        })
    }
}

/// Where a point of a triangle is when its corners are elsewhere; the first corner of one that has no area.
fn carried(place: DVec3, from: [DVec3; 3], to: [DVec3; 3]) -> DVec3 {
    let [u, v, point] = [from[1] - from[0], from[2] - from[0], place - from[0]];
    let (uu, uv, vv) = (u.dot(u), u.dot(v), v.dot(v));
    let area = uu * vv - uv * uv;
    if area <= 0.0 {
        return to[0];
    }
    let (pu, pv) = (point.dot(u), point.dot(v));
    let [b, c] = [(vv * pu - uv * pv) / area, (uu * pv - uv * pu) / area];
    to[0] + b * (to[1] - to[0]) + c * (to[2] - to[0])
}

impl Along<'_> {
    /// Returns the change of coverage, summed over points of surfaces that are seen in both frames, and the number of these points, in
    /// pixels. All points of a pixel are followed: a pixel that was between others is compared with each by its share.
    #[must_use]
    pub fn changes(&self, now: &Picture, before: &[f32]) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for (at, found) in self.now.before.iter().enumerate() {
            let Some((place, depth)) = found else { continue };
            for (pixel, share) in self.before.shares(*place + self.jitter) {
                let seen = f64::from(self.before.depth[pixel]);
                if (seen - depth).abs() <= SAME_DEPTH * depth {
                    sums[0] += share * f64::from((now.coverage[at] - before[pixel]).abs());
                    sums[1] += share;
                }
            }
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::draw::view::Cause;
    use crate::render::scene_file::load::prepare;
    use crate::render::scene_file::read;
    use glam::dvec2;
    use std::path::Path;

    fn scene(camera: &str, surface: &str) -> Scene {
        let text = format!(
            "name = 's'\nresolution = [64, 64]\nframes = 3\n[camera]\neye = [0.0, 0.0, 5.0]\ntarget = [0.0, 0.0, 0.0]\n{camera}\n\
             [[texture]]\nname = 't'\nconstant = {{ alpha = 0.5 }}\n[[surface]]\ntexture = 't'\n{surface}\n"
        );
        prepare(read::read(&text, "s.toml").unwrap(), Path::new("")).unwrap()
    }

    const SHOT: Shot = Shot { cause: Cause::All, distance: 1.0 };
    const CARD: &str = "card = { size = [8.0, 8.0] }";

    fn way(scene: &Scene, pixel: [u32; 2]) -> DVec2 {
        let motion = Motion::new(scene, &SHOT, 2);
        let (place, _) = motion.before[(pixel[1] * 64 + pixel[0]) as usize].unwrap();
        place - dvec2(f64::from(pixel[0]) + 0.5, f64::from(pixel[1]) + 0.5)
    }

    /// The camera, its object, or both move; a pixel is a sixteenth of a unit wide.
    #[test]
    fn points_are_followed_through_the_motion_of_camera_and_object() {
        let (still, moved) = ("", "motion = { translate = [0.5, -0.25] }");
        let drifting = format!("{CARD}\ndrift = [0.125, 0.0, 0.0]");
        for (camera, surface, wanted) in [
            (still, CARD, [0.0, 0.0]),
            (moved, CARD, [-0.5, 0.25]),
            (still, drifting.as_str(), [-2.0, 0.0]),
            (moved, drifting.as_str(), [-2.5, 0.25]),
        ] {
            let found = way(&scene(camera, surface), [30, 40]);
            assert!((found - DVec2::from(wanted)).length() < 1e-4, "{camera} {surface}: {found}");
        }
        // A turn about its own axis leaves the axis where it is.
        let spinning = way(&scene(still, &format!("{CARD}\nspin = 5.0")), [31, 32]);
        assert!(spinning.x.abs() < 0.1, "{spinning}");
    }

    /// Between its corners a card that sways is flat: in the first frame every point is where it is.
    #[test]
    fn points_between_deformed_corners_go_with_them() {
        let scene = scene("", &format!("{CARD}\nsway = [0.5, 8.0]"));
        let motion = Motion::new(&scene, &SHOT, 0);
        let middles = (0..64 * 64).map(|at| dvec2(f64::from(at % 64) + 0.5, f64::from(at / 64) + 0.5));
        let mut seen = 0;
        for (middle, (place, _)) in middles.zip(&motion.before).filter_map(|(m, found)| Some((m, (*found)?)))
        {
            assert!((place - middle).length() < 1e-3, "{middle} {place}");
            seen += 1;
        }
        assert!(seen > 3000, "{seen}");
    }

    #[test]
    fn what_moves_with_the_surface_does_not_change_and_what_stays_on_the_screen_does() {
        let scene = scene("motion = { translate = [1.0, 0.0] }", CARD);
        let [before, now] = [1, 2].map(|index| Motion::new(&scene, &SHOT, index));
        let picture = |shift: usize| {
            let mut picture = Picture::sky([64, 64]);
            (0..64 * 64)
                .for_each(|at| picture.coverage[at] = f32::from(u8::from((at + shift).is_multiple_of(2))));
            picture
        };
        let share = |now_shift, jitter| {
            let along = Along { now: &now, before: &before, jitter };
            let [changed, all] = along.changes(&picture(now_shift), &picture(0).coverage);
            assert!(all > 60.0 * 60.0);
            changed / all
        };
        // Stripes that go with the surface, one pixel on, and those that stay.
        assert!(share(1, DVec2::ZERO) < 1e-4 && share(0, DVec2::ZERO) > 0.999);
        // Half a pixel between them shows half of each.
        assert!((share(0, dvec2(0.5, 0.0)) - 0.5).abs() < 0.01);
    }

    #[test]
    fn what_was_hidden_is_not_compared() {
        let text = format!(
            "{CARD}\n[[surface]]\ntexture = 't'\ncard = {{ size = [1.0, 1.0] }}\nposition = [0.0, 0.0, 1.0]\ndrift = [0.5, 0.0, 0.0]"
        );
        let scene = scene("", &text);
        let [before, now] = [0, 1].map(|index| Motion::new(&scene, &SHOT, index));
        let white = Picture { coverage: vec![1.0; 64 * 64], ..Picture::sky([64, 64]) };
        let along = Along { now: &now, before: &before, jitter: DVec2::ZERO };
        let [changed, all] = along.changes(&white, &white.coverage);
        assert_eq!(changed, 0.0);
        // The small card has a side of 20 pixels; it uncovers a strip of ten.
        assert!((f64::from(64 * 64) - all - 200.0).abs() < 30.0, "{all}");
    }
}
