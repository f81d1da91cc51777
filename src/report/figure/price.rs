//! What accuracy costs in time: one row a threshold, its nanoseconds beside its exactness and its distance to the uniform law.

use super::style::{
    Axis, BLUE, Canvas, Chart, Drawn, FRAME, INK, Key, TICK_SIZE, TITLE_STRIP, VERMILLION, WIDTH, chart,
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
    /// The share of thresholds that have the bits of the reference.
    pub exact: f64,
    /// The greatest distance of its law to the uniform one, above 0.
    pub distance: f64,
}

const ROW: i32 = 46;
/// Width of the names and of the charts of times and shares; that of distances has the rest.
const WIDTHS: [i32; 3] = [710, 480, 250];

/// Draws rows from top to bottom: nanoseconds, share of exact thresholds, distance to the uniform law. A law farther from the uniform one than `chance`, which is drawn as a line, is marked.
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
        let edges = [WIDTHS[0], WIDTHS[0] + WIDTHS[1], WIDTHS.iter().sum()];
        let parts = body.split_by_breakpoints(edges, [0; 0]);
        let y = Axis::rows(rows.len());
        let axis = |title, values: &[f64], most| Axis::logarithmic(title, range(values), most);
        let values = |read: fn(&Priced) -> f64| rows.iter().map(read).collect::<Vec<f64>>();
        let x = axis("nanoseconds a threshold", &values(|row| row.ns), 9);
        named(&parts[0], rows, x.bottom_room())?;
        let marks = |chart: &mut Chart<'_>, value: &dyn Fn(&Priced) -> f64| -> Drawn {
            let start = chart.x_range().start;
            (0..count).rev().zip(rows).try_for_each(|(height, row)| {
                let place = (value(row), f64::from(height));
                curve(chart, [(start, place.1), place], FRAME, 2)?;
                let colour = if row.distance > chance { VERMILLION } else { BLUE };
                chart.plotting_area().draw(&Circle::new(place, 10, colour.filled()))
            })
        };
        let log = |read: fn(&Priced) -> f64| move |row: &Priced| libm::log10(read(row));
        marks(&mut chart(&parts[1], "", &x, &y)?, &log(|row| row.ns))?;
        let x = Axis { terse: true, ..Axis::new("exact bits", -0.08..1.08, 2) };
        marks(&mut chart(&parts[2], "", &x, &y)?, &|row| row.exact)?;
        let mut distances = values(|row| row.distance);
        distances.push(chance);
        let x = axis("distance to uniform law", &distances, 5);
        let mut chart = chart(&parts[3], "", &x, &y)?;
        marks(&mut chart, &log(|row| row.distance))?;
        let (line, ends) = (libm::log10(chance), y.scale.range);
        curve(&mut chart, [(line, ends.start), (line, ends.end)], INK, 3)
    })
}

/// Writes the names to the left of their rows.
fn named(area: &Canvas<'_>, rows: &[Priced], bottom: i32) -> Drawn {
    const TOP: i32 = 18;
    let height = area.dim_in_pixel().1 as i32 - TOP - bottom;
    rows.iter().enumerate().try_for_each(|(at, row)| {
        let middle = TOP + height * (2 * at as i32 + 1) / (2 * rows.len() as i32);
        let text = shorten(&row.name, TICK_SIZE, WIDTHS[0] - 20);
        area.draw_text(&text, &plain(TICK_SIZE, HPos::Right, VPos::Center), (WIDTHS[0] - 5, middle))
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
        let row = |name: &str, ns, distance| Priced { name: name.to_owned(), ns, exact: 1.0, distance };
        let rows = [row("fast", 2.1, 0.001), row("linear", 30.0, 0.08)];
        let svg = price("prices", &rows, 0.005);
        is_sound(
            &svg,
            &["fast", "linear", "nanoseconds a threshold", "distance to uniform law", "exact bits", "0.01"],
        );
        let marks = |rows: &[Priced]| price("prices", rows, 0.005).matches("<circle").count();
        assert_eq!(marks(&rows), 6);
        let colours = svg.matches("#D55E00").count();
        let sound = price("prices", &rows[..1], 0.005).matches("#D55E00").count();
        assert_eq!(colours, sound + 3, "three marks of one row");
    }

    #[test]
    fn nothing_to_draw_gives_an_empty_picture() {
        is_sound(&price("nothing", &[], 0.005), &["nothing"]);
    }
}
