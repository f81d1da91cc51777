//! An exponential average of frames (§7.2, Karis 2014): [`history`].

use super::kind::{About, Bound, Cost, Effect, Per, Plan, Role, Rules, Text, techniques, tell};
use crate::render::draw::plan::Moment;
use crate::render::measure::depth::Depth;
use crate::render::measure::picture::Picture;
use crate::technique::history::{self, way_back};
use glam::{DVec2, dvec2};
use serde::Deserialize;

/// An exponential average of frames.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct History {
    /// Weight of the newest frame, in (0, 1].
    pub weight: f32,
    /// Whether the average is brought into the range of the newest frame around each pixel.
    #[serde(default)]
    pub clamp: bool,
    /// Whether the average is looked up where the motion of the camera has left it; without, pixels stay where they are.
    #[serde(default)]
    pub reproject: bool,
}

impl Effect for History {
    const ABOUT: About = About::new(
        "§7.2 (Karis 2014)",
        "Averages frames exponentially, as temporal antialiasing does",
        "blends: 1 a pixel and frame; projections: 1 a pixel and frame if reprojected",
    )
    .bounds(&[("weight", Bound::UpTo(1.0))])
    .techniques(techniques![
        "temporal-antialiasing": "§7.2 (Karis 2014)", "temporal-ghosts" / "phase-rotated",
            "An exponential average weighs the latest frames most.";
        "reprojected-history": "§7.2 (Karis 2014)", "temporal-ghosts" / "phase-rotated, reprojected",
            "The average is looked up where the motion of the camera has left it, and follows surfaces; what they uncover keeps a ghost.";
    ]);

    fn rules(&self) -> Rules {
        if self.reproject {
            Rules::default()
                .never(Role::Blends, "the first reprojects one depth a pixel, the second shows several")
        } else {
            Rules::default()
        }
    }

    fn plan(&self, plan: &mut Plan) {
        let table = *self;
        plan.setup.mixes = true;
        plan.setup.needs.depth |= table.reproject;
        let clamped = if table.clamp { ", clamped to its neighbourhood" } else { "" };
        let moved = if table.reproject { " where the camera has left them" } else { "" };
        let says = format!(
            "history: {} of the newest frame, the rest of those before{moved}{clamped}",
            table.weight
        );
        let price = [(Per::Pixel, Cost::blends(1) + Cost::projections(u64::from(table.reproject)))];
        plan.after(tell(says, &price, Text::None), move |frame, moment, memory| {
            if let Some(before) = memory.pop_front() {
                let depth = frame.depth.as_ref().filter(|_| table.reproject);
                let moved = depth.map(|depth| Moved { moment, depth });
                frame.picture = accumulate(&before, &frame.picture, &table, moved.as_ref());
            }
            memory.push_back(frame.picture.clone());
        });
    }
}

/// What tells where the surfaces of a frame were in the one before. Surfaces that move by themselves are taken as still.
struct Moved<'a> {
    /// The cameras, and how far the image is moved within a pixel: history is kept without.
    moment: &'a Moment,
    /// The depth of what the frame shows, at one place or several along each side of a pixel.
    depth: &'a Depth,
}

impl Moved<'_> {
    /// Where the history of a pixel is, in pixels of the frame before.
    fn history(&self, pixel: [u32; 2]) -> Option<DVec2> {
        let centre = dvec2(f64::from(pixel[0]) + 0.5, f64::from(pixel[1]) + 0.5);
        let Moment { now, before, offset } = self.moment;
        Some(centre + way_back(now, before, centre - offset, self.nearest(pixel))?)
    }

    /// The depth of what is nearest in a pixel and the eight around it: edges, and what shows through holes, go with the
    /// surface in front (Karis 2014).
    fn nearest(&self, pixel: [u32; 2]) -> f64 {
        let [width, height] = self.depth.size;
        let places = width / self.moment.now.resolution[0];
        let [columns, rows] =
            [0, 1].map(|axis| pixel[axis].saturating_sub(1) * places..(pixel[axis] + 2) * places);
        let [columns, rows] = [columns.start..columns.end.min(width), rows.start..rows.end.min(height)];
        let depths =
            rows.flat_map(|y| columns.clone().map(move |x| self.depth.values[(y * width + x) as usize]));
        f64::from(depths.fold(f32::INFINITY, f32::min))
    }
}

/// Returns the average after a frame, from that before it; pixels stay where they are unless something has `moved`. What was
/// outside of the image has no history.
fn accumulate(before: &Picture, current: &Picture, table: &History, moved: Option<&Moved<'_>>) -> Picture {
    let mut average = current.clone();
    let [width, height] = current.size;
    let weight = f64::from(table.weight);
    for y in 0..height {
        for x in 0..width {
            let here = (y * width + x) as usize;
            let history = match moved {
                None => Some((before.colour[here], before.coverage[here])),
                Some(moved) => moved.history([x, y]).and_then(|place| before.at(place)),
            };
            let Some((colour, coverage)) = history else { continue };
            let rows = y.saturating_sub(1)..(y + 2).min(height);
            let columns = || x.saturating_sub(1)..(x + 2).min(width);
            let around: Vec<usize> =
                rows.flat_map(|y| columns().map(move |x| (y * width + x) as usize)).collect();
            let mix = |before: f32, value: &dyn Fn(usize) -> f32| {
                let mut before = f64::from(before);
                if table.clamp {
                    let range: Vec<f64> = around.iter().map(|&at| f64::from(value(at))).collect();
                    before = history::clamp_history(before, &range);
                }
                history::accumulate(before, f64::from(value(here)), weight) as f32
            };
            average.colour[here] = [0, 1, 2].map(|c| mix(colour[c], &|at| current.colour[at][c]));
            average.coverage[here] = mix(coverage, &|at| current.coverage[at]);
        }
    }
    average
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Camera;
    use glam::DVec3;

    /// Dots on a plane that the camera passes by three pixels a frame, and the average after two frames.
    fn after_two(moves: f64, offset: DVec2) -> Picture {
        let size = [24, 12];
        let camera = |eye: f64| {
            let eye = DVec3::new(eye, 0.0, 5.0);
            Camera::look_at(eye, eye + DVec3::NEG_Z, DVec3::Y, 0.3, size)
        };
        let dots = |shift: u32| {
            let mut picture = Picture::sky(size);
            for at in (0..picture.coverage.len()).filter(|at| (at % 24 + shift as usize).is_multiple_of(5)) {
                picture.coverage[at] = 1.0;
            }
            picture
        };
        let depth = Depth { size: size.map(|side| 2 * side), values: vec![5.0; 4 * 24 * 12] };
        let pixel = 5.0 * 2.0 * 0.3 / 12.0;
        let moment = Moment { now: camera(moves * pixel), before: camera(0.0), offset };
        let moved = Moved { moment: &moment, depth: &depth };
        let table = History { weight: 0.5, clamp: false, reproject: true };
        accumulate(&dots(0), &dots(3), &table, Some(&moved))
    }

    #[test]
    fn history_is_found_where_the_camera_has_left_it() {
        let error = |average: &Picture| -> f32 {
            let right = |at: usize| if (at % 24 + 3).is_multiple_of(5) { 1.0 } else { 0.0 };
            (0..24 * 12).map(|at| (average.coverage[at] - right(at)).abs()).fold(0.0, f32::max)
        };
        assert!(error(&after_two(3.0, DVec2::ZERO)) < 1e-6);
        // Motion within the pixel is not the camera's.
        assert!(error(&after_two(3.0, dvec2(0.4, -0.3))) < 1e-6);
        // No motion, the wrong way, and another speed are seen.
        for moves in [0.0, -3.0, 2.0] {
            assert!((error(&after_two(moves, DVec2::ZERO)) - 0.5).abs() < 1e-6, "{moves}");
        }
        // Where there is no history, the frame stands alone.
        let average = after_two(3.0, DVec2::ZERO);
        assert_eq!((average.coverage[22], average.coverage[21]), (1.0, 0.0));
    }

    #[test]
    fn edges_go_with_what_is_in_front() {
        let camera = Camera::look_at(DVec3::Z, DVec3::ZERO, DVec3::Y, 0.5, [4, 3]);
        let mut depth = Depth { size: [8, 6], values: vec![f32::INFINITY; 48] };
        depth.values[8 + 3] = 2.0;
        let moment = Moment { now: camera, before: camera, offset: DVec2::ZERO };
        let moved = Moved { moment: &moment, depth: &depth };
        assert_eq!(
            [[0, 0], [2, 1], [1, 2], [3, 0]].map(|pixel| moved.nearest(pixel)),
            [2.0, 2.0, f64::INFINITY, f64::INFINITY]
        );
    }
}
