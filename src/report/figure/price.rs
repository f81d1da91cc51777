//! What accuracy costs in time: one row a threshold, its nanoseconds beside its distance to the uniform law.

use super::style::{
    Axis, BLUE, Canvas, Chart, Drawn, FRAME, INK, Key, LABEL_SIZE, TITLE_STRIP, VERMILLION, WIDTH, chart,
    curve, legend, legend_height, picture, plain, shorten,
};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use std::ops::Range;

/// One way to a threshold.
#[derive(Clone, Debug, PartialEq)]
pub struct Priced {
    /// Its name.
    pub name: String,
    /// Its time in nanoseconds a threshold, above 0.
    pub ns: f64,
    /// The greatest distance of its law to the uniform one, above 0.
    pub distance: f64,
}

const ROW: i32 = 50;
const NAMES: i32 = 640;

/// Draws rows from top to bottom. A law farther from the uniform one than `chance`, which is drawn as a line, is marked.
#[must_use]
pub fn price(title: &str, rows: &[Priced], chance: f64) -> String {
    let entries = [
        (Key::Field(BLUE), "uniform, as far as the samples tell"),
        (Key::Field(VERMILLION), "not uniform"),
        (Key::Line(INK), "chance stays to the left of the line, but once in a million"),
    ];
    let strip = legend_height(&entries, WIDTH as i32 - 60);
    let count = rows.len() as i32;
    picture(title, TITLE_STRIP + strip + ROW * count.max(1) + 130, |area| {
        let (top, body) = area.split_vertically(strip);
        legend(&top.margin(0, 0, 30, 30), &entries)?;
        let (names, charts) = body.split_horizontally(NAMES);
        let (times, distances) = charts.split_horizontally((WIDTH as i32 - NAMES) * 11 / 20);
        let y = Axis { numbered: false, ..Axis::new("", -0.5..f64::from(count.max(1)) - 0.5, 1) };
        let axis = |title, values: &[f64]| Axis::logarithmic(title, range(values));
        let x = axis("nanoseconds a threshold", &rows.iter().map(|row| row.ns).collect::<Vec<_>>());
        named(&names, rows, x.bottom_room())?;
        let marks = |chart: &mut Chart<'_>, value: fn(&Priced) -> f64| -> Drawn {
            rows.iter().enumerate().try_for_each(|(at, row)| {
                let height = f64::from(count) - 1.0 - at as f64;
                let place = (libm::log10(value(row)), height);
                let start = chart.x_range().start;
                curve(chart, [(start, height), place], FRAME, 2)?;
                let colour = if row.distance > chance { VERMILLION } else { BLUE };
                chart.plotting_area().draw(&Circle::new(place, 11, colour.filled()))
            })
        };
        marks(&mut chart(&times, "", &x, &y)?, |row| row.ns)?;
        let x = axis(
            "distance to the uniform law",
            &rows.iter().map(|row| row.distance).chain([chance]).collect::<Vec<_>>(),
        );
        let mut chart = chart(&distances, "", &x, &y)?;
        marks(&mut chart, |row| row.distance)?;
        let line = libm::log10(chance);
        curve(&mut chart, [(line, -0.5), (line, f64::from(count) - 0.5)], INK, 3)
    })
}

/// Writes the names to the left of their rows.
fn named(area: &Canvas<'_>, rows: &[Priced], bottom: i32) -> Drawn {
    const TOP: i32 = 18;
    let height = area.dim_in_pixel().1 as i32 - TOP - bottom;
    rows.iter().enumerate().try_for_each(|(at, row)| {
        let middle = TOP + height * (2 * at as i32 + 1) / (2 * rows.len() as i32);
        let text = shorten(&row.name, LABEL_SIZE, NAMES - 30);
        area.draw_text(&text, &plain(LABEL_SIZE, HPos::Right, VPos::Center), (NAMES - 10, middle))
    })
}

/// The range of the logarithms of values, with room on both sides.
fn range(values: &[f64]) -> Range<f64> {
    let logs = values.iter().map(|&value| libm::log10(value)).filter(|log| log.is_finite());
    let (low, high) =
        logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), log| (low.min(log), high.max(log)));
    if low > high { 0.0..1.0 } else { low - 0.15..high + 0.15 }
}

#[cfg(test)]
mod tests {
    use super::super::style::tests::is_sound;
    use super::*;

    #[test]
    fn rows_are_named_and_those_beyond_chance_are_marked() {
        let row = |name: &str, ns, distance| Priced { name: name.to_owned(), ns, distance };
        let rows = [row("fast", 2.1, 0.001), row("linear", 30.0, 0.08)];
        let svg = price("prices", &rows, 0.005);
        is_sound(&svg, &["fast", "linear", "nanoseconds a threshold", "distance to the uniform law", "0.01"]);
        let marks = |rows: &[Priced]| price("prices", rows, 0.005).matches("<circle").count();
        assert_eq!(marks(&rows), 4);
        let colours = svg.matches("#D55E00").count();
        let sound = price("prices", &rows[..1], 0.005).matches("#D55E00").count();
        assert_eq!(colours, sound + 2, "two marks of one row");
    }

    #[test]
    fn nothing_to_draw_gives_an_empty_picture() {
        is_sound(&price("nothing", &[], 0.005), &["nothing"]);
    }
}
