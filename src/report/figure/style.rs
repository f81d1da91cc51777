//! The common look of all pictures: paper, ink, palette, axes, legends.
//!
//! Sizes are in units of the picture, [`WIDTH`] of them across. Shown 900 pixels wide, a unit is half a pixel.

use plotters::coord::Shift;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::fmt::Write as _;
use std::ops::Range;

/// Width of every picture.
pub(super) const WIDTH: u32 = 1800;

pub(super) const PAPER: RGBColor = RGBColor(255, 255, 255);
pub(super) const INK: RGBColor = RGBColor(34, 34, 34);
pub(super) const FRAME: RGBColor = RGBColor(110, 110, 110);
pub(super) const GRID: RGBColor = RGBColor(226, 226, 226);
/// Background of a region that chance explains.
pub(super) const BAND: RGBColor = RGBColor(214, 232, 244);

pub(super) const BLUE: RGBColor = RGBColor(0, 114, 178);
pub(super) const VERMILLION: RGBColor = RGBColor(213, 94, 0);
/// Colours of series, told apart by people with any colour vision (Okabe & Ito), darkest first; no yellow, which
/// is lost on white.
pub(super) const SERIES: [RGBColor; 6] = [
    BLUE,
    VERMILLION,
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
];

/// Height of the title of a picture.
pub(super) const TITLE_SIZE: i32 = 38;
/// Height of titles of panels and axes, and of legends.
pub(super) const LABEL_SIZE: i32 = 33;
/// Height of the numbers along axes.
pub(super) const TICK_SIZE: i32 = 29;
/// Height of titles of panels that have no room for larger ones.
const SMALL_SIZE: i32 = 26;
/// Height of the strip that holds the title of a picture.
pub(super) const TITLE_STRIP: i32 = 70;
/// Height of the strip that holds the title of a panel.
pub(super) const PANEL_STRIP: i32 = 50;
/// Height of one row of a legend.
pub(super) const LEGEND_ROW: i32 = 50;

/// Room to the left of everything that belongs to a chart.
const LEFT_MARGIN: i32 = 10;
/// Room to the right of a chart, for half of its last number.
const RIGHT_MARGIN: i32 = 24;

/// Thickness of a curve.
pub(super) const CURVE: u32 = 4;

pub(super) type Canvas<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(super) type Drawn<T = ()> = Result<T, DrawingAreaErrorKind<std::io::Error>>;
pub(super) type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<Scale, Scale>>;

/// Paints a picture of [`WIDTH`] x `height` with `title` on top and returns it as SVG text.
///
/// `paint` gets the room below the title.
pub(super) fn picture(title: &str, height: i32, paint: impl FnOnce(&Canvas<'_>) -> Drawn) -> String {
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (WIDTH, height as u32)).into_drawing_area();
        let painted = root.fill(&PAPER).and_then(|()| {
            let centre = WIDTH as i32 / 2;
            let shown = shorten(title, TITLE_SIZE, WIDTH as i32 - 40);
            root.draw_text(&shown, &bold(TITLE_SIZE, HPos::Center, VPos::Center), (centre, TITLE_STRIP / 2))?;
            paint(&root.split_vertically(TITLE_STRIP).1)?;
            root.present()
        });
        painted.expect("drawing into memory cannot fail");
    }
    let head_end = svg.find('>').map_or(0, |at| at + 1);
    svg.insert_str(head_end, &format!("\n<title>{}</title>", escape(title)));
    svg
}

/// Puts SVG text on top of everything that was drawn.
pub(super) fn on_top(mut svg: String, layer: &str) -> String {
    let end = svg.rfind("</svg>").unwrap_or(svg.len());
    svg.insert_str(end, layer);
    svg
}

/// Replaces the characters that mean something in XML.
fn escape(text: &str) -> String {
    text.chars().fold(String::with_capacity(text.len()), |mut escaped, c| {
        match c {
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '&' => escaped.push_str("&amp;"),
            _ => escaped.push(c),
        }
        escaped
    })
}

/// Returns the width that a text of a size takes up at most in common sans-serif fonts.
pub(super) fn text_width(text: &str, size: i32) -> i32 {
    // The widest of them, DejaVu Sans and Verdana, average 0.6 of the nominal size over mixed text; plotters hands
    // 1/1.24 of the size on to SVG.
    (text.chars().count() as i32 * size * 6) / 12
}

/// Cuts a text that is wider than `width`, and says so with an ellipsis.
pub(super) fn shorten(text: &str, size: i32, width: i32) -> String {
    if text_width(text, size) <= width {
        return text.to_owned();
    }
    let kept = (width / text_width("x", size).max(1)).saturating_sub(1).max(0) as usize;
    text.chars().take(kept).chain(['…']).collect()
}

fn font<'a>(size: i32, style: FontStyle, horizontal: HPos, vertical: VPos) -> TextStyle<'a> {
    FontDesc::new(FontFamily::SansSerif, f64::from(size), style)
        .color(&INK)
        .pos(Pos::new(horizontal, vertical))
}

pub(super) fn plain<'a>(size: i32, horizontal: HPos, vertical: VPos) -> TextStyle<'a> {
    font(size, FontStyle::Normal, horizontal, vertical)
}

pub(super) fn bold<'a>(size: i32, horizontal: HPos, vertical: VPos) -> TextStyle<'a> {
    font(size, FontStyle::Bold, horizontal, vertical)
}

/// One axis of a chart.
#[derive(Clone)]
pub(super) struct Axis<'t> {
    /// What is counted along it, with the unit in brackets; empty for none.
    pub title: &'t str,
    /// Where it runs and where numbers stand.
    pub scale: Scale,
    /// Whether the numbers are written.
    pub numbered: bool,
    /// Whether zeros at the end of a number are left out, so that neighbouring charts can stand close.
    pub terse: bool,
}

/// A linear scale with round numbers.
#[derive(Clone)]
pub(super) struct Scale {
    /// From where to where it runs.
    pub range: Range<f64>,
    ticks: Vec<f64>,
    /// Digits after the point; `None` where values are logarithms to base ten, and numbers are written that have them.
    decimals: Option<usize>,
}

impl Ranged for Scale {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (low, high): (i32, i32)) -> i32 {
        let share = (value - self.range.start) / (self.range.end - self.range.start);
        low + (share * f64::from(high - low)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks.clone()
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

impl ValueFormatter<f64> for Scale {
    fn format(value: &f64) -> String {
        value.to_string()
    }

    fn format_ext(&self, value: &f64) -> String {
        match self.decimals {
            // Adding zero turns -0 into 0.
            Some(decimals) => format!("{:.*}", decimals, value + 0.0),
            // 1, 2 or 5 times a power of ten, but for the last digits of the power.
            None => {
                let exponent = (value + 1e-9).floor();
                let digits = (-exponent).max(0.0) as usize;
                format!("{:.digits$}", libm::pow(10.0, *value))
            }
        }
    }
}

impl<'t> Axis<'t> {
    /// Makes an axis with round numbers, about `count` of them.
    pub fn new(title: &'t str, range: Range<f64>, count: u32) -> Self {
        let step = round_step((range.end - range.start) / f64::from(count));
        let (first, last) = ((range.start / step - 1e-9).ceil(), (range.end / step + 1e-9).floor());
        let ticks = (0..=(last - first) as i32).map(|i| (first + f64::from(i)) * step).collect();
        let decimals = (0..9).find(|&d| whole(step * power_of_ten(d))).unwrap_or(9) as usize;
        Self { title, scale: Scale { range, ticks, decimals: Some(decimals) }, numbered: true, terse: false }
    }

    /// Makes an axis of rows, the first one on top at `count` - 1, without numbers.
    pub fn rows(count: usize) -> Self {
        let range = -0.5..count.max(1) as f64 - 0.5;
        Self {
            title: "",
            scale: Scale { range, ticks: Vec::new(), decimals: None },
            numbered: false,
            terse: false,
        }
    }

    /// Makes an axis for logarithms to base ten, on which 1, 2 and 5 times the powers of ten stand as plain numbers; the powers
    /// alone where that would be more than `most` numbers.
    pub fn logarithmic(title: &'t str, range: Range<f64>, most: usize) -> Self {
        let decades = range.start.floor() as i32..=range.end.ceil() as i32;
        let of = |leading: &[f64]| -> Vec<f64> {
            let all = decades
                .clone()
                .flat_map(|decade| leading.iter().map(move |l| f64::from(decade) + libm::log10(*l)));
            all.filter(|tick| range.contains(tick)).collect()
        };
        let ticks = of(&[1.0, 2.0, 5.0]);
        let ticks = if ticks.len() > most { of(&[1.0]) } else { ticks };
        Self { title, scale: Scale { range, ticks, decimals: None }, numbered: true, terse: false }
    }

    /// The axis from 0 to 1.
    pub fn unit(title: &'t str, count: u32) -> Self {
        Self { terse: true, ..Self::new(title, 0.0..1.0, count) }
    }

    /// Returns the room that it takes up below a chart.
    pub fn bottom_room(&self) -> i32 {
        self.room(44)
    }

    /// Returns the room that its numbers and title take up to the left of a chart.
    pub fn left_room(&self) -> i32 {
        let longest =
            self.scale.ticks.iter().map(|&tick| text_width(&self.label(tick), TICK_SIZE)).max().unwrap_or(0);
        self.room(longest + 24)
    }

    fn room(&self, numbers: i32) -> i32 {
        let title = if self.title.is_empty() { 0 } else { 48 };
        title + if self.numbered { numbers } else { 14 }
    }

    fn label(&self, value: f64) -> String {
        let number = self.scale.format_ext(&value);
        match (self.numbered, self.terse && number.contains('.')) {
            (false, _) => String::new(),
            (true, false) => number,
            (true, true) => number.trim_end_matches('0').trim_end_matches('.').to_owned(),
        }
    }
}

fn power_of_ten(exponent: i32) -> f64 {
    libm::pow(10.0, f64::from(exponent))
}

fn whole(value: f64) -> bool {
    (value - value.round()).abs() < 1e-6 * value.abs().max(1.0)
}

/// Returns 1, 2 or 5 times a power of ten, not far below `step`.
fn round_step(step: f64) -> f64 {
    if !(step.is_finite() && step > 0.0) {
        return 1.0;
    }
    let magnitude = power_of_ten(libm::log10(step).floor() as i32);
    [1.0, 2.0, 5.0].map(|m| m * magnitude).into_iter().find(|s| *s >= 0.8 * step).unwrap_or(10.0 * magnitude)
}

/// Returns the range from 0 to a little above `largest`, at most 1: the axis of a share.
pub(super) fn share_range(largest: f64) -> Range<f64> {
    let top = if largest.is_finite() { 1.08 * largest } else { 1.0 };
    0.0..if top > 0.9 { 1.02 } else { top.max(1e-6) }
}

/// Draws the frame of a chart: title, axes, grid.
pub(super) fn chart<'a>(area: &Canvas<'a>, title: &str, x: &Axis<'_>, y: &Axis<'_>) -> Drawn<Chart<'a>> {
    let (width, _) = area.dim_in_pixel();
    let left = y.left_room();
    let strip = if title.is_empty() { 18 } else { PANEL_STRIP };
    let plot = width as i32 - left - LEFT_MARGIN - RIGHT_MARGIN;
    // A title may overhang the plot a little on both sides, the same in all charts of a grid.
    let room = plot + 2 * LEFT_MARGIN + RIGHT_MARGIN;
    let sizes = [LABEL_SIZE, TICK_SIZE, SMALL_SIZE];
    let size = sizes.into_iter().find(|&size| text_width(title, size) <= room).unwrap_or(SMALL_SIZE);
    let heading = plain(size, HPos::Center, VPos::Center);
    let centre = LEFT_MARGIN + left + plot / 2;
    area.draw_text(&shorten(title, size, room), &heading, (centre, PANEL_STRIP / 2))?;
    let mut chart = ChartBuilder::on(area)
        .margin_top(strip)
        .margin_left(LEFT_MARGIN)
        .margin_right(RIGHT_MARGIN)
        .x_label_area_size(x.bottom_room())
        .y_label_area_size(left)
        .build_cartesian_2d(x.scale.clone(), y.scale.clone())?;
    let anywhere = |size| plain(size, HPos::Center, VPos::Center);
    chart
        .configure_mesh()
        .bold_line_style(GRID.stroke_width(2))
        .light_line_style(TRANSPARENT)
        .axis_style(FRAME.stroke_width(2))
        .set_all_tick_mark_size(7)
        .label_style(anywhere(TICK_SIZE))
        .axis_desc_style(anywhere(LABEL_SIZE))
        .x_desc(x.title)
        .y_desc(y.title)
        .x_label_formatter(&|value| x.label(*value))
        .y_label_formatter(&|value| y.label(*value))
        .draw()?;
    Ok(chart)
}

/// Cuts an area into `[rows, columns]` panels of equal size, row by row, but for the room `[left, bottom]` by which
/// the first column and the last row are larger, since they carry titles and numbers.
pub(super) fn grid<'a>(
    area: &Canvas<'a>,
    [rows, columns]: [usize; 2],
    [left, bottom]: [i32; 2],
) -> Vec<Canvas<'a>> {
    let (width, height) = area.dim_in_pixel();
    let (across, down) = ((width as i32 - left) / columns as i32, (height as i32 - bottom) / rows as i32);
    let edges = |extra: i32, step: i32, count: usize, first: bool| -> Vec<i32> {
        let inner = 1..count as i32;
        inner.map(|i| i * step + if first { extra } else { 0 }).collect()
    };
    area.split_by_breakpoints(edges(left, across, columns, true), edges(bottom, down, rows, false))
}

/// Draws a curve through points.
pub(super) fn curve(
    chart: &mut Chart<'_>,
    points: impl IntoIterator<Item = (f64, f64)>,
    colour: RGBColor,
    width: u32,
) -> Drawn {
    chart.draw_series(LineSeries::new(points, colour.stroke_width(width)))?;
    Ok(())
}

/// Draws a filled rectangle between two corners.
pub(super) fn block(chart: &mut Chart<'_>, corners: [(f64, f64); 2], colour: RGBColor) -> Drawn {
    chart.draw_series([Rectangle::new(corners, colour.filled())])?;
    Ok(())
}

/// Draws a vertical bar over `from..to`.
pub(super) fn whisker(chart: &mut Chart<'_>, x: f64, from: f64, to: f64, colour: RGBColor) -> Drawn {
    let Range { start, end } = chart.y_range();
    let within = |y: f64| y.clamp(start, end);
    curve(chart, [(x, within(from)), (x, within(to))], colour, 3)
}

/// Shapes by which series are told apart besides their colour: five, so that no shape comes twice in colours that are alike.
pub(super) fn marker(chart: &mut Chart<'_>, at: (f64, f64), series: usize) -> Drawn {
    let (area, colour) = (chart.plotting_area(), colour(series));
    let square = |half: i32| Rectangle::new([(-half, -half), (half, half)], colour.filled());
    match series % 5 {
        0 => area.draw(&Circle::new(at, 9, colour.filled())),
        1 => area.draw(&(EmptyElement::at(at) + square(8))),
        2 => area.draw(&TriangleMarker::new(at, 12, colour.filled())),
        3 => area.draw(&Cross::new(at, 8, colour.stroke_width(5))),
        _ => area.draw(&Circle::new(at, 9, colour.stroke_width(4))),
    }
}

/// Returns the colour of the series with a number.
pub(super) fn colour(series: usize) -> RGBColor {
    SERIES[series % SERIES.len()]
}

/// What stands before a name in a legend.
#[derive(Clone, Copy)]
pub(super) enum Key {
    /// A piece of curve.
    Line(RGBColor),
    /// A filled field.
    Field(RGBColor),
    /// The curve and the marker of a series.
    Series(usize),
    /// Nothing: the text explains marks that all series share.
    Note,
}

impl Key {
    /// Width of the key and the gap after it.
    fn room(self) -> i32 {
        if matches!(self, Self::Note) { 0 } else { 76 }
    }
}

/// Returns the height of a legend in a strip of some width.
pub(super) fn legend_height<S: AsRef<str>>(entries: &[(Key, S)], width: i32) -> i32 {
    places(entries, width).last().map_or(0, |place| place.1 + LEGEND_ROW)
}

/// Draws a legend in rows from left to right.
pub(super) fn legend<S: AsRef<str>>(area: &Canvas<'_>, entries: &[(Key, S)]) -> Drawn {
    let width = area.dim_in_pixel().0 as i32;
    for ((key, name), (x, y)) in entries.iter().zip(places(entries, width)) {
        let middle = y + LEGEND_ROW / 2;
        draw_key(area, *key, (x, middle))?;
        let text_left = x + key.room();
        let shown = shorten(name.as_ref(), LABEL_SIZE, width - text_left);
        area.draw_text(&shown, &plain(LABEL_SIZE, HPos::Left, VPos::Center), (text_left, middle))?;
    }
    Ok(())
}

/// Returns left and top of each entry.
fn places<S: AsRef<str>>(entries: &[(Key, S)], width: i32) -> Vec<(i32, i32)> {
    let (mut x, mut y) = (0, 0);
    let place = |(key, name): &(Key, S)| {
        let needed = key.room() + text_width(name.as_ref(), LABEL_SIZE);
        if x > 0 && x + needed > width {
            (x, y) = (0, y + LEGEND_ROW);
        }
        let here = (x, y);
        x += needed + 40;
        here
    };
    entries.iter().map(place).collect()
}

fn draw_key(area: &Canvas<'_>, key: Key, (x, middle): (i32, i32)) -> Drawn {
    let line =
        |colour: RGBColor| PathElement::new([(x, middle), (x + 60, middle)], colour.stroke_width(CURVE));
    match key {
        Key::Note => Ok(()),
        Key::Line(colour) => area.draw(&line(colour)),
        Key::Field(colour) => {
            area.draw(&Rectangle::new([(x, middle - 15), (x + 60, middle + 15)], colour.filled()))
        }
        Key::Series(series) => {
            area.draw(&line(colour(series)))?;
            let (at, colour) = ((x + 30, middle), colour(series));
            match series % 5 {
                0 => area.draw(&Circle::new(at, 9, colour.filled())),
                1 => {
                    area.draw(&Rectangle::new([(at.0 - 8, at.1 - 8), (at.0 + 8, at.1 + 8)], colour.filled()))
                }
                2 => area.draw(&TriangleMarker::new(at, 12, colour.filled())),
                3 => area.draw(&Cross::new(at, 8, colour.stroke_width(5))),
                _ => area.draw(&Circle::new(at, 9, colour.stroke_width(4))),
            }
        }
    }
}

/// Writes a colour as SVG does.
pub(super) fn hex(RGBColor(red, green, blue): RGBColor) -> String {
    let mut text = String::with_capacity(7);
    write!(text, "#{red:02x}{green:02x}{blue:02x}").expect("writing into memory cannot fail");
    text
}

/// Tests that hold for every picture.
#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Asserts that a picture is well-formed, says each of `texts`, and keeps numbers short and finite.
    pub fn is_sound(svg: &str, texts: &[&str]) {
        let mut open = Vec::new();
        for tag in svg.split('<').skip(1) {
            let (tag, text) = tag.split_once('>').expect("every tag ends");
            assert!(!text.contains('&') || text.contains(';'), "{text}");
            if let Some(name) = tag.strip_prefix('/') {
                assert_eq!(open.pop(), Some(name), "tags nest");
            } else if !tag.ends_with('/') {
                open.push(tag.split_whitespace().next().expect("a tag has a name"));
            }
        }
        assert!(open.is_empty(), "{open:?} not closed");
        assert!(svg.starts_with("<svg ") && !svg.contains("NaN") && !svg.contains("inf"), "{}", &svg[..200]);
        for text in texts {
            assert!(svg.contains(text), "{text} is not in the picture");
        }
    }

    #[test]
    fn ticks_are_round_and_inside() {
        let axis = Axis::new("x", -0.07..0.21, 3);
        assert_eq!(
            axis.scale.ticks.iter().map(|&t| axis.label(t)).collect::<Vec<_>>(),
            ["0.0", "0.1", "0.2"]
        );
        let axis = Axis::new("x", 0.0..30_000.0, 6);
        assert_eq!(axis.label(axis.scale.ticks[1]), "5000");
        assert_eq!([0.0, 0.25, 1.0].map(|x| Axis::new("y", 0.0..1.0, 4).label(x)), ["0.0", "0.2", "1.0"]);
        assert_eq!([0.0, 0.5, 1.0].map(|x| Axis::unit("x", 2).label(x)), ["0", "0.5", "1"]);
        assert_eq!(Axis::unit("x", 2).scale.ticks.len(), 3);
        assert_eq!(Axis::new("x", 0.0..0.0, 4).scale.ticks, [0.0]);
        let axis = Axis::logarithmic("ns", -2.1..1.4, 11);
        assert_eq!(
            axis.scale.ticks.iter().map(|&t| axis.label(t)).collect::<Vec<_>>(),
            ["0.01", "0.02", "0.05", "0.1", "0.2", "0.5", "1", "2", "5", "10", "20"]
        );
        assert_eq!(Axis::logarithmic("ns", -2.1..1.4, 10).scale.ticks, [-2.0, -1.0, 0.0, 1.0]);
    }

    #[test]
    fn text_is_escaped_and_cut() {
        let svg = picture("a < b & c", 200, |_| Ok(()));
        is_sound(&svg, &["<title>a &lt; b &amp; c</title>"]);
        assert_eq!(shorten("abcdefgh", 20, 40), "abc…");
        assert_eq!(shorten("abc", 20, 400), "abc");
    }

    #[test]
    fn legend_breaks_into_rows() {
        let entries = [(Key::Line(BLUE), "a name of some length"); 9];
        assert!(legend_height(&entries, 900) >= 4 * LEGEND_ROW);
        assert_eq!(legend_height(&entries[..1], 900), LEGEND_ROW);
    }
}
