//! Thresholds before and after the step that makes them uniform (Eq. 2, §5.4.2).

use super::style::{
    Axis, Canvas, Drawn, Key, VERMILLION, WIDTH, block, chart, curve, grid, legend, legend_height, picture,
};
use crate::threshold::cdf::density;

/// Histograms of one weight.
#[derive(Clone, Debug, PartialEq)]
pub struct LerpHistograms {
    /// The weight between the two octaves (`lerpFactor`), in [0, 1].
    pub lerp_factor: f64,
    /// Counts of the joined hashes before Eq. 2, in equal bins over [0, 1].
    pub before: Vec<u64>,
    /// Counts of the thresholds after it, in equal bins over [0, 1].
    pub after: Vec<u64>,
}

/// Draws a column a weight: above the histogram before Eq. 2 under its trapezoid, below the one after it under 1.
#[must_use]
pub fn before_and_after(columns: &[LerpHistograms]) -> String {
    const PANEL: i32 = 390;
    let entries = [(Key::Field(FILL), "measured"), (Key::Line(VERMILLION), "expected density")];
    let strip = legend_height(&entries, WIDTH as i32 - 120);
    let title = "The CDF of Eq. 2 makes interpolated hashes uniform again";
    picture(title, super::style::TITLE_STRIP + strip + 2 * PANEL + 48, |area| {
        let (top, panels) = area.split_vertically(strip);
        legend(&top.margin(0, 0, 100, 20), &entries)?;
        let (upper, lower) = panels.split_vertically(PANEL);
        row(&upper, columns, false)?;
        row(&lower, columns, true)
    })
}

const FILL: plotters::style::RGBColor = plotters::style::RGBColor(150, 199, 230);

fn row(area: &Canvas<'_>, columns: &[LerpHistograms], after: bool) -> Drawn {
    // The room of the numbers and the title of the vertical axis, which only the first panel carries.
    const FIRST: i32 = 92;
    let panels = grid(area, [1, columns.len().max(1)], [FIRST, 0]);
    for (index, (column, here)) in columns.iter().zip(panels).enumerate() {
        let first = index == 0;
        let title = match (first, after) {
            (false, _) => "",
            (true, false) => "density before",
            (true, true) => "density after",
        };
        let mut y = Axis::new(title, 0.0..2.25, 5);
        y.numbered = first;
        let mut x = Axis::unit(if after { "threshold" } else { "" }, 2);
        x.numbered = after;
        let heading = if after { String::new() } else { format!("t = {}", column.lerp_factor) };
        let mut chart = chart(&here, &heading, &x, &y)?;
        let counts = if after { &column.after } else { &column.before };
        let (bins, total) = (counts.len() as f64, counts.iter().sum::<u64>().max(1) as f64);
        for (bin, &bin_count) in counts.iter().enumerate() {
            let edge = |at: usize| at as f64 / bins;
            let height = bin_count as f64 / total * bins;
            block(&mut chart, [(edge(bin), 0.0), (edge(bin + 1), height.min(2.25))], FILL)?;
        }
        let lerp_factor = if after { 0.0 } else { column.lerp_factor };
        let line = (0..=200).map(|i| f64::from(i) / 200.0).map(|x| (x, density(x, lerp_factor)));
        curve(&mut chart, line, VERMILLION, 4)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::style::tests::is_sound;
    use super::*;

    #[test]
    fn every_weight_has_a_panel() {
        let column =
            |lerp_factor| LerpHistograms { lerp_factor, before: vec![1, 3, 3, 1], after: vec![2; 4] };
        let columns = [0.05, 0.2, 0.35, 0.5, 0.8].map(column);
        let svg = before_and_after(&columns);
        is_sound(&svg, &["t = 0.05", "t = 0.8", "density before", "density after", "threshold"]);
        assert_eq!(svg, before_and_after(&columns));
    }
}
