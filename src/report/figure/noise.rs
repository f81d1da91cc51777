//! The thresholds themselves, as the grey levels of a picture.

use super::raster::Raster;
use super::style::{LABEL_SIZE, TITLE_STRIP, WIDTH, on_top, picture, plain, shorten};
use plotters::style::RGBColor;
use plotters::style::text_anchor::{HPos, VPos};

/// Thresholds of a rectangle of pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct NoisePanel {
    /// What it shows, as in "hash scale 1 pixel".
    pub title: String,
    /// Pixels in a row.
    pub columns: usize,
    /// Thresholds in [0, 1], row by row from the top; one that is not a number leaves its pixel white.
    pub thresholds: Vec<f64>,
}

const GREYS: usize = 32;
const STRIP: i32 = 60;
const GAP: i32 = 40;

/// Draws panels side by side: 0 is black, 1 is white, in 32 steps.
#[must_use]
pub fn noise(title: &str, panels: &[NoisePanel]) -> String {
    let count = panels.len().max(1) as i32;
    let width = (WIDTH as i32 - GAP * (count + 1)) / count;
    let height = |panel: &NoisePanel| {
        let columns = panel.columns.max(1);
        (panel.thresholds.len().div_ceil(columns) * width as usize / columns) as i32
    };
    let tallest = panels.iter().map(height).max().unwrap_or(0);
    let left = |index: usize| GAP + (width + GAP) * index as i32;
    let frame = picture(title, TITLE_STRIP + STRIP + tallest + GAP, |area| {
        panels.iter().enumerate().try_for_each(|(index, panel)| {
            let style = plain(LABEL_SIZE, HPos::Center, VPos::Center);
            let shown = shorten(&panel.title, LABEL_SIZE, width);
            area.draw_text(&shown, &style, (left(index) + width / 2, STRIP / 2))
        })
    });
    let greys = (0..GREYS).map(|level| (level * 255 / (GREYS - 1)) as u8);
    let palette: Vec<_> = greys.map(|grey| RGBColor(grey, grey, grey)).collect();
    let layer = panels.iter().enumerate().map(|(index, panel)| {
        let levels: Vec<_> = panel.thresholds.iter().map(|&threshold| level(threshold)).collect();
        let size = [width, height(panel)];
        let corner = [left(index), TITLE_STRIP + STRIP];
        Raster { corner, size, columns: panel.columns, levels: &levels, palette: &palette }.svg()
    });
    on_top(frame, &layer.collect::<String>())
}

fn level(threshold: f64) -> usize {
    if threshold.is_nan() { GREYS } else { ((threshold * GREYS as f64) as usize).min(GREYS - 1) }
}

#[cfg(test)]
mod tests {
    use super::super::style::tests::is_sound;
    use super::*;

    #[test]
    fn panels_stay_small() {
        // A poor generator will do: what counts is that neighbours differ.
        let thresholds =
            (0..96 * 96_u32).map(|i| f64::from(i.wrapping_mul(2_654_435_761) >> 8) / 16_777_216.0);
        let panel = NoisePanel { title: "1 pixel".to_owned(), columns: 96, thresholds: thresholds.collect() };
        let panels = [panel.clone(), panel.clone(), panel];
        let svg = noise("noise", &panels);
        is_sound(&svg, &["1 pixel", "noise"]);
        assert!(svg.len() < 500_000, "{}", svg.len());
        assert_eq!(svg, noise("noise", &panels));
    }

    #[test]
    fn levels_span_the_range() {
        assert_eq!([0.0, 1.0, 0.5, f64::NAN].map(level), [0, 31, 16, 32]);
    }
}
