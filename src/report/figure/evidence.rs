//! What a claim saw, drawn so that a reader can judge the verdict by eye.

use super::raster::Raster;
use super::style::{
    Axis, BAND, BLUE, CURVE, Canvas, Drawn, FRAME, INK, Key, LABEL_SIZE, TICK_SIZE, TITLE_STRIP, VERMILLION,
    WIDTH, block, chart, colour, curve, grid, legend, legend_height, marker, on_top, picture, plain,
    share_range, whisker,
};
use crate::check::evidence::{ComparedShare, NamedHistogram};
use crate::check::{Evidence, Outcome};
use core::ops::Range;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

/// Draws the evidence of an outcome; `None` where there is nothing to draw.
#[must_use]
pub fn evidence(outcome: &Outcome) -> Option<String> {
    let Outcome { check, subject, precision, .. } = outcome;
    let title = format!("{check} on {subject} in {precision}: {}", outcome.answer());
    match &outcome.evidence {
        Evidence::None => None,
        Evidence::Histograms(groups) => Some(histograms(&title, groups)),
        Evidence::Pairs { side, counts } => Some(pairs(&title, *side, counts)),
        Evidence::Shares { abscissa, points } => {
            Some(comparison(&title, abscissa, Axis::new("share", shares_range(points), 5), points))
        }
        Evidence::Quantity { abscissa, ordinate, points } => {
            Some(comparison(&title, abscissa, Axis::new(ordinate, value_range(points), 5), points))
        }
    }
}

/// Draws one panel a group: how far each bin is from its share under U(0, 1), with the band of three standard
/// deviations around it. Bars outside the band stand out.
#[must_use]
pub fn histograms(title: &str, groups: &[NamedHistogram]) -> String {
    let columns = match groups.len() {
        0 | 1 => 1,
        2 | 4 => 2,
        3 | 5 | 6 | 9 => 3,
        _ => 4,
    };
    let rows = groups.len().div_ceil(columns).max(1);
    let height = if rows == 1 { 640 } else { 360 };
    let bars: Vec<_> = groups.iter().map(|group| RelativeBars::new(&group.counts)).collect();
    let reach = bars.iter().map(RelativeBars::reach).fold(0.01, f64::max);
    let entries = [
        (Key::Field(BLUE), "within 3 standard deviations"),
        (Key::Field(VERMILLION), "outside"),
        (Key::Field(BAND), "±3 standard deviations"),
    ];
    let strip = legend_height(&entries, WIDTH as i32 - 120);
    picture(title, TITLE_STRIP + strip + (rows as i32) * height + X_TITLE_ROOM, |area| {
        let (top, body) = area.split_vertically(strip);
        legend(&top.margin(0, 0, 100, 20), &entries)?;
        let y = Axis::new("count / expected", (1.0 - reach).max(0.0)..1.0 + reach, 4);
        let panels = grid(&body, [rows, columns], [y.left_room() - Y_INNER_ROOM, X_TITLE_ROOM]);
        for (index, ((group, bars), panel)) in groups.iter().zip(&bars).zip(panels).enumerate() {
            let x = Axis::unit(if index / columns == rows - 1 { "threshold" } else { "" }, 4);
            let outer = index % columns == 0;
            let y = Axis { title: if outer { y.title } else { "" }, numbered: outer, ..y.clone() };
            bars.draw(&panel, &group.name, &x, &y)?;
        }
        Ok(())
    })
}

/// What the vertical axis takes up in panels where it has no numbers and no title.
const Y_INNER_ROOM: i32 = 14;
/// What the title of the horizontal axis takes up.
const X_TITLE_ROOM: i32 = 48;

/// Counts relative to equal shares of their sum.
struct RelativeBars {
    ratios: Vec<f64>,
    sigma: f64,
}

impl RelativeBars {
    fn new(counts: &[u64]) -> Self {
        let (bins, total) = (counts.len().max(1) as f64, counts.iter().sum::<u64>() as f64);
        if total == 0.0 {
            return Self { ratios: Vec::new(), sigma: 0.0 };
        }
        let expected = total / bins;
        let ratios = counts.iter().map(|&count| count as f64 / expected).collect();
        Self { ratios, sigma: ((1.0 - 1.0 / bins) / expected).sqrt() }
    }

    /// The distance from 1 that the axis must show.
    fn reach(&self) -> f64 {
        let furthest = self.ratios.iter().map(|ratio| (ratio - 1.0).abs()).fold(0.0, f64::max);
        1.15 * furthest.max(3.0 * self.sigma)
    }

    fn draw(&self, panel: &Canvas<'_>, name: &str, x: &Axis<'_>, y: &Axis<'_>) -> Drawn {
        let heading = if self.ratios.is_empty() { format!("{name} (no samples)") } else { name.to_owned() };
        let mut chart = chart(panel, &heading, x, y)?;
        let floor = y.scale.range.start;
        block(&mut chart, [(0.0, (1.0 - 3.0 * self.sigma).max(floor)), (1.0, 1.0 + 3.0 * self.sigma)], BAND)?;
        let edge = |bin: usize| bin as f64 / self.ratios.len() as f64;
        for (bin, &ratio) in self.ratios.iter().enumerate() {
            let colour = if (ratio - 1.0).abs() > 3.0 * self.sigma { VERMILLION } else { BLUE };
            block(&mut chart, [(edge(bin), 1.0), (edge(bin + 1), ratio.max(floor))], colour)?;
        }
        curve(&mut chart, [(0.0, 1.0), (1.0, 1.0)], INK, 3)
    }
}

/// Shades between blue (too few) and vermillion (too many).
const SHADES: usize = 41;

fn shade(level: usize) -> RGBColor {
    let weight = 2.0 * level as f64 / (SHADES - 1) as f64 - 1.0;
    let RGBColor(red, green, blue) = if weight < 0.0 { BLUE } else { VERMILLION };
    let mix = |full: u8| (255.0 + weight.abs() * (f64::from(full) - 255.0)).round() as u8;
    RGBColor(mix(red), mix(green), mix(blue))
}

/// Draws `side` x `side` counts, row by row with the first threshold selecting the row, as their distance from equal
/// shares in standard deviations.
#[must_use]
pub fn pairs(title: &str, side: usize, counts: &[u64]) -> String {
    const MAP: i32 = 1000;
    const LEFT: i32 = 330;
    const BAR: i32 = 60;
    let expected = counts.iter().sum::<u64>() as f64 / counts.len().max(1) as f64;
    let deviation =
        |&count: &u64| if expected > 0.0 { (count as f64 - expected) / expected.sqrt() } else { 0.0 };
    let furthest = counts.iter().map(|count| deviation(count).abs()).fold(0.0, f64::max);
    // Chance alone reaches 4 in a table of thousands of cells.
    let limit = furthest.max(4.0).ceil();
    let bar_left = LEFT + MAP + 110;
    let top = 20;
    let frame = picture(title, TITLE_STRIP + top + MAP + 130, |area| {
        let map = area.margin(top, 0, LEFT - 130, 0);
        let width = (130 + MAP) as u32;
        let (map, _) = map.split_horizontally(width);
        axes(&map, MAP, 130)?;
        let bottom = top + MAP;
        let style = plain(TICK_SIZE, HPos::Left, VPos::Center);
        area.draw(&Rectangle::new(
            [(bar_left - 1, top - 1), (bar_left + BAR, bottom)],
            FRAME.stroke_width(2),
        ))?;
        for quarter in 0..=4 {
            let value = limit * f64::from(quarter - 2) / 2.0;
            let y = bottom - MAP * quarter / 4;
            area.draw(&PathElement::new(
                [(bar_left + BAR, y), (bar_left + BAR + 8, y)],
                FRAME.stroke_width(2),
            ))?;
            area.draw_text(&signed(value), &style, (bar_left + BAR + 16, y))?;
        }
        let turned = plain(LABEL_SIZE, HPos::Center, VPos::Center).transform(FontTransform::Rotate270);
        area.draw_text("(count - expected) / √expected", &turned, (bar_left + BAR + 190, top + MAP / 2))
    });
    // The first row of counts is the lowest of the picture.
    let rows = counts.chunks(side.max(1)).rev();
    let level = |count| (((deviation(count) / limit + 1.0) / 2.0) * (SHADES - 1) as f64).round() as usize;
    let levels: Vec<usize> = rows.flat_map(|row| row.iter().map(level)).collect();
    let palette: Vec<_> = (0..SHADES).map(shade).collect();
    let corner = [LEFT, TITLE_STRIP + top];
    let map = Raster { corner, size: [MAP, MAP], columns: side, levels: &levels, palette: &palette };
    let ramp: Vec<usize> = (0..SHADES).rev().collect();
    let corner = [bar_left, TITLE_STRIP + top];
    let bar = Raster { corner, size: [BAR, MAP], columns: 1, levels: &ramp, palette: &palette };
    on_top(frame, &(map.svg() + &bar.svg()))
}

fn signed(value: f64) -> String {
    let decimals = usize::from(value != value.round());
    if value > 0.0 { format!("+{value:.decimals$}") } else { format!("{:.decimals$}", value + 0.0) }
}

/// Draws the axes of the map: the square itself is painted later.
fn axes(area: &Canvas<'_>, side: i32, left: i32) -> Drawn {
    area.draw(&Rectangle::new([(left - 1, -1), (left + side, side)], FRAME.stroke_width(2)))?;
    let tick = FRAME.stroke_width(2);
    for quarter in 0..=4 {
        let at = side * quarter / 4;
        let label = format!("{:.2}", f64::from(quarter) / 4.0);
        area.draw(&PathElement::new([(left + at, side), (left + at, side + 8)], tick))?;
        area.draw_text(&label, &plain(TICK_SIZE, HPos::Center, VPos::Top), (left + at, side + 16))?;
        area.draw(&PathElement::new([(left - 8, side - at), (left, side - at)], tick))?;
        area.draw_text(&label, &plain(TICK_SIZE, HPos::Right, VPos::Center), (left - 16, side - at))?;
    }
    let title = plain(LABEL_SIZE, HPos::Center, VPos::Center);
    area.draw_text("second threshold", &title, (left + side / 2, side + 85))?;
    area.draw_text("first threshold", &title.transform(FontTransform::Rotate270), (16, side / 2))
}

/// Draws measured values with bars of three standard deviations on the predicted curve of their series, and below
/// their distance from it in standard deviations.
#[must_use]
pub(super) fn comparison(title: &str, x_title: &str, y: Axis<'_>, shares: &[ComparedShare]) -> String {
    let series = by_series(shares);
    let note = (Key::Note, "points: measured ± 3σ, lines: predicted");
    let keys = series.iter().enumerate().map(|(i, (name, _))| (Key::Series(i), *name));
    let entries: Vec<_> = keys.chain([note]).collect();
    let strip = legend_height(&entries, WIDTH as i32 - 120);
    let (low, high) = shares.iter().fold((1.0_f64, 0.0_f64), |(low, high), s| (low.min(s.x), high.max(s.x)));
    let margin = if high > low.min(0.0) { 0.03 * (high - low.min(0.0)) } else { 1.0 };
    let range = if low <= 0.0 { low - margin } else { 0.0 }..high + margin;
    let reach =
        shares.iter().map(|s| standardised(s).abs()).filter(|z| z.is_finite()).fold(4.0, f64::max) * 1.1;
    picture(title, TITLE_STRIP + strip + 620 + 380, |area| {
        let (top, body) = area.split_vertically(strip);
        legend(&top.margin(0, 0, 100, 20), &entries)?;
        let (upper, lower) = body.split_vertically(620);
        let mut x = Axis { terse: true, numbered: false, ..Axis::new("", range, 8) };
        let residual = Axis::new("distance [σ]", -reach..reach, 4);
        // Both charts begin at the same place, whatever the length of their numbers.
        let lefts = [&y, &residual].map(Axis::left_room);
        let widest = lefts.into_iter().max().unwrap_or(0);
        let mut shown = chart(&upper.margin(0, 0, widest - lefts[0], 0), "", &x, &y)?;
        for (index, (_, points)) in series.iter().enumerate() {
            curve(&mut shown, points.iter().map(|s| (s.x, s.predicted)), colour(index), CURVE)?;
            for s in points {
                whisker(
                    &mut shown,
                    s.x,
                    s.measured - 3.0 * s.sigma,
                    s.measured + 3.0 * s.sigma,
                    colour(index),
                )?;
                marker(&mut shown, (s.x, s.measured), index)?;
            }
        }
        (x.title, x.numbered) = (x_title, true);
        let mut shown = chart(&lower.margin(0, 0, widest - lefts[1], 0), "", &x, &residual)?;
        block(&mut shown, [(x.scale.range.start, -3.0), (x.scale.range.end, 3.0)], BAND)?;
        curve(&mut shown, [(x.scale.range.start, 0.0), (x.scale.range.end, 0.0)], INK, 3)?;
        for (index, (_, points)) in series.iter().enumerate() {
            // Side by side, since all lie around zero.
            let aside = (index as f64 - (series.len() - 1) as f64 / 2.0) * 0.2 * margin;
            for s in points {
                marker(&mut shown, (s.x + aside, standardised(s).clamp(-reach, reach)), index)?;
            }
        }
        Ok(())
    })
}

/// Returns the range of all shares with their bars, from 0.
fn shares_range(shares: &[ComparedShare]) -> Range<f64> {
    share_range(shares.iter().map(|s| s.predicted.max(s.measured + 3.0 * s.sigma)).fold(0.0, f64::max))
}

/// Returns the range of all values with their bars, and a little more.
fn value_range(points: &[ComparedShare]) -> Range<f64> {
    let ends = |s: &ComparedShare| [s.measured - 3.0 * s.sigma, s.measured + 3.0 * s.sigma, s.predicted];
    let finite = || points.iter().flat_map(ends).filter(|value| value.is_finite());
    let (low, high) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    if low > high {
        return 0.0..1.0;
    }
    let room = (0.08 * (high - low)).max(1e-6);
    low - room..high + room
}

/// Returns the distance from the prediction in standard deviations; infinite where none was allowed.
fn standardised(share: &ComparedShare) -> f64 {
    let difference = share.measured - share.predicted;
    if difference == 0.0 { 0.0 } else { difference / share.sigma }
}

/// Returns the series in order of appearance, each sorted by abscissa.
fn by_series(shares: &[ComparedShare]) -> Vec<(&str, Vec<&ComparedShare>)> {
    let mut series: Vec<(&str, Vec<&ComparedShare>)> = Vec::new();
    for share in shares {
        match series.iter_mut().find(|(name, _)| *name == share.series) {
            Some((_, points)) => points.push(share),
            None => series.push((&share.series, vec![share])),
        }
    }
    for (_, points) in &mut series {
        points.sort_by(|a, b| a.x.total_cmp(&b.x));
    }
    series
}

#[cfg(test)]
mod tests {
    use super::super::style::tests::is_sound;
    use super::*;

    #[test]
    fn histograms_mark_the_bins_that_chance_does_not_explain() {
        let group =
            |name: &str, counts: &[u64]| NamedHistogram { name: name.to_owned(), counts: counts.to_vec() };
        let fair = group("frontal wall", &[1000, 1010, 990, 1000]);
        let svg = histograms("fair", std::slice::from_ref(&fair));
        is_sound(&svg, &["frontal wall", "count / expected", "threshold"]);
        let marked = |svg: &str| svg.matches("fill=\"#D55E00\"").count();
        // One in the legend.
        assert_eq!(marked(&svg), 1);
        let bad = histograms("bad", &[fair, group("fence & floor", &[2000, 0, 1000, 1000])]);
        is_sound(&bad, &["fence &amp; floor"]);
        assert_eq!(marked(&bad), 3);
        assert_eq!(svg, histograms("fair", &[group("frontal wall", &[1000, 1010, 990, 1000])]));
    }

    #[test]
    fn groups_without_samples_are_named_so() {
        let empty = NamedHistogram { name: "nothing seen".to_owned(), counts: vec![0; 8] };
        is_sound(&histograms("empty", &[empty]), &["nothing seen (no samples)"]);
        is_sound(&histograms("none", &[]), &[]);
    }

    #[test]
    fn pairs_have_a_colour_bar_and_both_axes() {
        let svg = pairs(
            "pairs",
            4,
            &[100, 90, 110, 100, 100, 100, 100, 100, 130, 100, 70, 100, 100, 100, 100, 100],
        );
        is_sound(&svg, &["first threshold", "second threshold", "+4", "-4", "√expected"]);
        is_sound(&pairs("none", 0, &[]), &[]);
        assert_eq!(signed(2.5), "+2.5");
        assert_eq!(signed(-0.0), "0");
    }

    #[test]
    fn comparison_keeps_series_apart_and_survives_exact_predictions() {
        let share = |series: &str, x, measured, sigma| ComparedShare {
            series: series.to_owned(),
            x,
            measured,
            predicted: 0.25,
            sigma,
        };
        let shares = [
            share("fence, along x", 0.5, 0.26, 0.01),
            share("fence, along y", 0.1, 0.25, 0.0),
            share("fence, along x", 0.1, 0.3, 0.0),
        ];
        let svg =
            comparison("comparison", "shift [pixels]", Axis::new("share", shares_range(&shares), 5), &shares);
        is_sound(&svg, &["fence, along x", "fence, along y", "shift [pixels]", "share", "distance [σ]"]);
        assert_eq!(by_series(&shares)[0].1[0].x, 0.1);
        is_sound(&comparison("none", "x", Axis::new("variance", value_range(&[]), 5), &[]), &[]);
        let range = value_range(&[share("a", 0.0, 0.25, 0.1)]);
        assert!(range.start < -0.05 && range.end > 0.55, "{range:?}");
    }
}
