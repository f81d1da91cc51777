//! Frames mixed with those before, as temporal antialiasing mixes them. Pixels stay where they are: nothing is reprojected.

use super::picture::Picture;
use super::tables::History;
use crate::technique::history;

/// Returns the average after a frame, from that before it.
#[must_use]
pub fn accumulate(before: &Picture, current: &Picture, table: &History) -> Picture {
    let mut average = current.clone();
    let [width, height] = current.size.map(i64::from);
    let weight = f64::from(table.weight);
    for y in 0..height {
        for x in 0..width {
            let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| [x + dx, y + dy]));
            let around: Vec<usize> = around
                .filter(|[x, y]| (0..width).contains(x) && (0..height).contains(y))
                .map(|[x, y]| (y * width + x) as usize)
                .collect();
            let mix = |before: f32, value: &dyn Fn(usize) -> f32, here: usize| {
                let mut before = f64::from(before);
                if table.clamp {
                    let range: Vec<f64> = around.iter().map(|&at| f64::from(value(at))).collect();
                    before = history::clamp_history(before, &range);
                }
                history::accumulate(before, f64::from(value(here)), weight) as f32
            };
            let here = (y * width + x) as usize;
            average.colour[here] =
                [0, 1, 2].map(|c| mix(before.colour[here][c], &|at| current.colour[at][c], here));
            average.coverage[here] = mix(before.coverage[here], &|at| current.coverage[at], here);
        }
    }
    average
}
