//! One row a thing, and beside its name a chart for each of its numbers.

use super::style::{
    Axis, Canvas, Chart, Drawn, FRAME, INK, Key, TICK_SIZE, TITLE_STRIP, WIDTH, chart, curve, legend,
    legend_height, picture, plain, shorten,
};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use std::ops::Range;

/// A number of every row, as it is drawn.
pub(super) struct Column<'t> {
    /// Its axis; logarithms where the axis is logarithmic.
    pub axis: Axis<'t>,
    /// How wide its chart is; the last one has what is left.
    pub width: i32,
    /// The value of each row and the colour of its mark.
    pub marks: Vec<(f64, RGBColor)>,
    /// Where a line is drawn from top to bottom.
    pub line: Option<f64>,
}

const ROW: i32 = 46;

/// Draws rows from top to bottom, their names in so much room to the left.
pub(super) fn rows(
    title: &str,
    entries: &[(Key, &str)],
    names: (&[&str], i32),
    columns: &[Column<'_>],
) -> String {
    let (names, room) = names;
    let strip = legend_height(entries, WIDTH as i32 - 60);
    let count = names.len() as i32;
    picture(title, TITLE_STRIP + strip + ROW * count.max(1) + 130, |area| {
        let (top, body) = area.split_vertically(strip);
        legend(&top.margin(0, 0, 30, 30), entries)?;
        let widths = columns.iter().map(|column| column.width);
        let edges: Vec<i32> = std::iter::once(room)
            .chain(widths)
            .scan(0, |edge, width| {
                *edge += width;
                Some(*edge)
            })
            .take(columns.len())
            .collect();
        let parts = body.split_by_breakpoints(edges, [0; 0]);
        if let Some(first) = columns.first() {
            named(&parts[0], names, room, first.axis.bottom_room())?;
        }
        let y = Axis::rows(names.len());
        columns.iter().zip(&parts[1..]).try_for_each(|(column, part)| {
            let mut chart = chart(part, "", &column.axis, &y)?;
            marks(&mut chart, &column.marks)?;
            column.line.map_or(Ok(()), |line| {
                let ends = &y.scale.range;
                curve(&mut chart, [(line, ends.start), (line, ends.end)], INK, 3)
            })
        })
    })
}

fn marks(chart: &mut Chart<'_>, marks: &[(f64, RGBColor)]) -> Drawn {
    let start = chart.x_range().start;
    (0..marks.len() as i32).rev().zip(marks).try_for_each(|(height, &(value, colour))| {
        let place = (value, f64::from(height));
        curve(chart, [(start, place.1), place], FRAME, 2)?;
        chart.plotting_area().draw(&Circle::new(place, 10, colour.filled()))
    })
}

/// Writes the names to the left of their rows.
fn named(area: &Canvas<'_>, names: &[&str], room: i32, bottom: i32) -> Drawn {
    const TOP: i32 = 18;
    let height = area.dim_in_pixel().1 as i32 - TOP - bottom;
    names.iter().enumerate().try_for_each(|(at, name)| {
        let middle = TOP + height * (2 * at as i32 + 1) / (2 * names.len() as i32);
        let text = shorten(name, TICK_SIZE, room - 20);
        area.draw_text(&text, &plain(TICK_SIZE, HPos::Right, VPos::Center), (room - 5, middle))
    })
}

/// The range of values, with so much room on both sides.
pub(super) fn range_of(values: impl Iterator<Item = f64>, room: f64) -> Range<f64> {
    let (low, high) = values
        .filter(|value| value.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    if low > high { 0.0..1.0 } else { low - room..high + room }
}
