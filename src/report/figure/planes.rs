//! What happens on planes that follow an axis: bias, flicker, and no threshold at all.

use super::raster::Raster;
use super::style::{
    Axis, BAND, CURVE, Key, LABEL_SIZE, PANEL_STRIP, TITLE_STRIP, VERMILLION, WIDTH, block, chart, colour,
    curve, grid, legend, legend_height, marker, on_top, picture, plain, share_range, shorten,
};
use plotters::style::RGBColor;
use plotters::style::text_anchor::{HPos, VPos};

/// The bias of one threshold on planes z = 0, 1, 2, ...
#[derive(Clone, Debug, PartialEq)]
pub struct PlaneBias {
    /// What is looked at, as in "Listing 1 in f32".
    pub name: String,
    /// Share of pixels of each plane that pass a test of some alpha, less that alpha.
    pub bias: Vec<f64>,
}

/// Draws one chart a threshold, one above the other over one scale; `sigma` is the standard deviation of the bias that
/// independent pixels would have.
#[must_use]
pub fn plane_bias(title: &str, panels: &[PlaneBias], sigma: f64) -> String {
    let entries = [
        (Key::Field(BAND), "3σ of independent pixels"),
        (Key::Line(colour(0)), "bias of one plane: coverage less alpha"),
    ];
    let largest = panels.iter().flat_map(|panel| &panel.bias).fold(3.0 * sigma, |m, b| f64::max(m, b.abs()));
    let count = panels.iter().map(|panel| panel.bias.len()).max().unwrap_or(0).max(1);
    let strip = legend_height(&entries, WIDTH as i32 - 120);
    let height = 340 * panels.len().max(1) as i32 + 100;
    picture(title, TITLE_STRIP + strip + height, |area| {
        let (top, body) = area.split_vertically(strip);
        legend(&top.margin(0, 0, 100, 20), &entries)?;
        let cells = grid(&body, [panels.len().max(1), 1], [0, 90]);
        for (index, (panel, cell)) in panels.iter().zip(cells).enumerate() {
            let last = index + 1 == panels.len();
            let z = if last { "z of the plane [cells]" } else { "" };
            let x = Axis { numbered: last, ..Axis::new(z, -1.0..count as f64, 8) };
            let y = Axis::new("bias", -1.08 * largest..1.08 * largest, 4);
            let mut chart = chart(&cell, &panel.name, &x, &y)?;
            block(&mut chart, [(-1.0, -3.0 * sigma), (count as f64, 3.0 * sigma)], BAND)?;
            panel.bias.iter().enumerate().try_for_each(|(z, &bias)| {
                curve(&mut chart, [(z as f64, 0.0), (z as f64, bias)], colour(0), CURVE)
            })?;
        }
        Ok(())
    })
}

/// How many thresholds of each plane a motion changes.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaneChanges {
    /// What is looked at, as in "Listing 1".
    pub name: String,
    /// Share of thresholds that changed, in [0, 1], plane by plane; NaN leaves a plane out.
    pub share: Vec<f64>,
}

/// Draws the share of changed thresholds over planes with names, one marker a plane and series.
#[must_use]
pub fn plane_changes(title: &str, planes: &[&str], series: &[PlaneChanges]) -> String {
    let entries: Vec<(Key, &str)> =
        series.iter().enumerate().map(|(index, series)| (Key::Series(index), series.name.as_str())).collect();
    let shares = || series.iter().flat_map(|series| &series.share).filter(|share| share.is_finite());
    let highest = shares().copied().fold(0.0, f64::max);
    let strip = legend_height(&entries, WIDTH as i32 - 120);
    picture(title, TITLE_STRIP + strip + 700, |area| {
        let (top, body) = area.split_vertically(strip);
        legend(&top.margin(0, 0, 100, 20), &entries)?;
        let x = Axis { numbered: false, ..Axis::new("", 0.0..series.len() as f64 + 1.0, 1) };
        let cells = grid(&body, [1, planes.len().max(1)], [112, 0]);
        for (place, (name, cell)) in planes.iter().zip(cells).enumerate() {
            let title = if place == 0 { "share of changed thresholds" } else { "" };
            let y = Axis { numbered: place == 0, ..Axis::new(title, share_range(highest), 5) };
            let mut chart = chart(&cell, name, &x, &y)?;
            for (index, series) in series.iter().enumerate() {
                let at = (index as f64 + 1.0, series.share.get(place).copied().unwrap_or(f64::NAN));
                if at.1.is_finite() {
                    curve(&mut chart, [(at.0, 0.0), at], colour(index), CURVE)?;
                    marker(&mut chart, at, index)?;
                }
            }
        }
        Ok(())
    })
}

/// Thresholds of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct ThresholdMap {
    /// What is shown, as in "Listing 2".
    pub title: String,
    /// Pixels in a row.
    pub columns: usize,
    /// Thresholds, row by row from the top; `None` where nothing is seen, NaN where the threshold is none.
    pub thresholds: Vec<Option<f64>>,
}

/// Draws maps side by side: grey levels from 0 (black) to 1 (white), vermillion where the threshold is not a number.
#[must_use]
pub fn threshold_maps(title: &str, maps: &[ThresholdMap]) -> String {
    const GAP: i32 = 40;
    const GREYS: usize = 16;
    let entries =
        [(Key::Field(VERMILLION), "not a number"), (Key::Note, "grey: threshold, 0 black, 1 white")];
    let count = maps.len().max(1) as i32;
    let width = (WIDTH as i32 - GAP * (count + 1)) / count;
    let height = |map: &ThresholdMap| {
        let columns = map.columns.max(1);
        (map.thresholds.len().div_ceil(columns) * width as usize / columns) as i32
    };
    let tallest = maps.iter().map(height).max().unwrap_or(0);
    let strip = legend_height(&entries, WIDTH as i32 - 120);
    let left = |index: usize| GAP + (width + GAP) * index as i32;
    let frame = picture(title, TITLE_STRIP + strip + PANEL_STRIP + tallest + GAP, |area| {
        let (top, body) = area.split_vertically(strip);
        legend(&top.margin(0, 0, GAP as u32, 20), &entries)?;
        maps.iter().enumerate().try_for_each(|(index, map)| {
            let style = plain(LABEL_SIZE, HPos::Center, VPos::Center);
            let shown = shorten(&map.title, LABEL_SIZE, width);
            body.draw_text(&shown, &style, (left(index) + width / 2, PANEL_STRIP / 2))
        })
    });
    let grey = |level: usize| (level * 255 / (GREYS - 1)) as u8;
    let greys = (0..GREYS).map(grey).map(|grey| RGBColor(grey, grey, grey));
    let palette: Vec<_> = greys.chain([VERMILLION]).collect();
    let level = |threshold: &Option<f64>| match threshold {
        None => GREYS + 1,
        Some(value) if value.is_nan() => GREYS,
        Some(value) => ((value * GREYS as f64) as usize).min(GREYS - 1),
    };
    let layer = maps.iter().enumerate().map(|(index, map)| {
        let levels: Vec<_> = map.thresholds.iter().map(level).collect();
        let corner = [left(index), TITLE_STRIP + strip + PANEL_STRIP];
        let size = [width, height(map)];
        Raster { corner, size, columns: map.columns, levels: &levels, palette: &palette }.svg()
    });
    on_top(frame, &layer.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::super::style::tests::is_sound;
    use super::*;

    #[test]
    fn every_threshold_has_a_chart_of_its_planes() {
        let panels =
            ["f32", "robust"].map(|name| PlaneBias { name: name.to_owned(), bias: vec![0.01, -0.02, 0.0] });
        let svg = plane_bias("bias", &panels, 0.002);
        is_sound(&svg, &["f32", "robust", "z of the plane [cells]", "coverage less alpha"]);
        assert_eq!(svg, plane_bias("bias", &panels, 0.002));
    }

    #[test]
    fn planes_are_named_and_missing_shares_left_out() {
        let series = [PlaneChanges { name: "Listing 2".to_owned(), share: vec![f64::NAN, 0.3] }];
        is_sound(&plane_changes("changes", &["z = 0", "z = 0.5"], &series), &["Listing 2", "z = 0.5"]);
    }

    #[test]
    fn a_map_tells_numbers_from_none() {
        let thresholds = vec![Some(0.0), Some(1.0), Some(f64::NAN), None];
        let map = ThresholdMap { title: "room".to_owned(), columns: 2, thresholds };
        let svg = threshold_maps("maps", &[map]);
        is_sound(&svg, &["room", "not a number", "M0 1h1v1h-1z", "#ffffff"]);
    }

    #[test]
    fn nothing_to_draw_gives_an_empty_picture() {
        is_sound(&plane_bias("nothing", &[], 0.1), &["nothing"]);
        is_sound(&plane_changes("nothing", &[], &[]), &["nothing"]);
        is_sound(&threshold_maps("nothing", &[]), &["nothing"]);
    }
}
