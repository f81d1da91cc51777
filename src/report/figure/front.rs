//! What is gained by waiting: a cloud of points, less is better on both axes, and the front that no other point beats.

use super::style::{
    Axis, CURVE, Drawn, FRAME, INK, Key, TITLE_STRIP, WIDTH, chart, curve, legend, legend_height, marker,
    picture,
};
use plotters::prelude::*;

/// One way of doing it.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Its name in the legend.
    pub name: String,
    /// Its time in nanoseconds, above 0.
    pub ns: f64,
    /// What is bought with it; less is better.
    pub value: f64,
}

/// Returns the points that no other one beats: as fast with less, or faster with as little. The fastest comes first.
#[must_use]
pub fn best(points: &[Point]) -> Vec<&Point> {
    let mut sorted: Vec<&Point> = points.iter().filter(|p| p.ns.is_finite() && p.value.is_finite()).collect();
    sorted.sort_by(|a, b| a.ns.total_cmp(&b.ns).then(a.value.total_cmp(&b.value)));
    let mut least = f64::INFINITY;
    sorted.retain(|point| {
        let gains = point.value < least;
        least = least.min(point.value);
        gains
    });
    sorted
}

/// Draws a value against time, with the front drawn as steps and its points named.
#[must_use]
pub fn front(title: &str, value: &str, points: &[Point]) -> String {
    let best = best(points);
    let mut entries: Vec<(Key, &str)> =
        best.iter().enumerate().map(|(index, point)| (Key::Series(index), point.name.as_str())).collect();
    entries.push((Key::Note, "grey: beaten in both by a point of the front"));
    let at = |point: &Point| (libm::log10(point.ns), point.value);
    let places: Vec<(f64, f64)> =
        points.iter().filter(|p| p.ns > 0.0 && p.value.is_finite()).map(at).collect();
    let [x, y] = [|&(x, _): &(f64, f64)| x, |&(_, y): &(f64, f64)| y].map(|read| {
        let (low, high) = places
            .iter()
            .map(read)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        if low > high {
            return 0.0..1.0;
        }
        let room = (0.06 * (high - low)).max(1e-4);
        low - room..high + room
    });
    let strip = legend_height(&entries, WIDTH as i32 - 120);
    picture(title, TITLE_STRIP + strip + 860, |area| {
        let (top, body) = area.split_vertically(strip);
        legend(&top.margin(0, 0, 100, 20), &entries)?;
        let (x, y) = (Axis::logarithmic("nanoseconds a value", x, 14), Axis::new(value, y, 8));
        let mut chart = chart(&body, "", &x, &y)?;
        places.iter().try_for_each(|&place| {
            chart.plotting_area().draw(&Circle::new(place, 6, FRAME.mix(0.5).filled()))
        })?;
        let corners = best.windows(2).flat_map(|pair| {
            let (from, to) = (at(pair[0]), at(pair[1]));
            [from, (to.0, from.1), to]
        });
        curve(&mut chart, corners, INK, CURVE)?;
        best.iter()
            .enumerate()
            .try_for_each(|(index, point)| -> Drawn { marker(&mut chart, at(point), index) })
    })
}

#[cfg(test)]
mod tests {
    use super::super::style::tests::is_sound;
    use super::*;

    fn point(name: &str, ns: f64, value: f64) -> Point {
        Point { name: name.to_owned(), ns, value }
    }

    #[test]
    fn the_front_holds_what_no_other_point_beats() {
        let points = [
            point("slow", 9.0, 0.5),
            point("fast", 1.0, 3.0),
            point("good", 2.0, 1.0),
            point("bad", 2.5, 1.0),
            point("best", 8.0, 0.5),
            point("none", 1.5, f64::NAN),
        ];
        let names: Vec<_> = best(&points).iter().map(|point| point.name.as_str()).collect();
        assert_eq!(names, ["fast", "good", "best"]);
        let svg = front("a front", "error", &points);
        is_sound(&svg, &["fast", "good", "best", "error", "nanoseconds a value"]);
        assert!(!svg.contains("slow"));
    }

    #[test]
    fn nothing_to_draw_gives_an_empty_picture() {
        is_sound(&front("nothing", "error", &[]), &["nothing"]);
    }
}
