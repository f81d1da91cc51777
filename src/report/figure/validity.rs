//! Where each arithmetic keeps the law of the hash: chi-square against the index of the cell.

use super::style::{
    Axis, BAND, CURVE, Drawn, Key, TITLE_STRIP, WIDTH, block, chart, colour, curve, legend, legend_height,
    marker, picture,
};
use std::ops::Range;

/// One arithmetic.
#[derive(Clone, Debug, PartialEq)]
pub struct ValiditySeries {
    /// Its name in the legend.
    pub name: String,
    /// Logarithm to base two of the index at which a window of cells begins, and chi-square over its degrees of freedom
    /// in that window, above 0.
    pub points: Vec<[f64; 2]>,
}

/// Draws chi-square over its degrees of freedom against the index, both as logarithms; `chance` is where a uniform
/// hash lies.
#[must_use]
pub fn validity(title: &str, series: &[ValiditySeries], chance: Range<f64>) -> String {
    let mut entries: Vec<(Key, &str)> =
        series.iter().enumerate().map(|(index, series)| (Key::Series(index), series.name.as_str())).collect();
    entries.push((Key::Field(BAND), "explained by chance"));
    let points = || series.iter().flat_map(|series| &series.points);
    let furthest = points().map(|p| p[0]).fold(1.0, f64::max);
    let highest = points().map(|p| libm::log10(p[1])).fold(1.0, f64::max);
    let strip = legend_height(&entries, WIDTH as i32 - 120);
    picture(title, TITLE_STRIP + strip + 860, |area| {
        let (top, body) = area.split_vertically(strip);
        legend(&top.margin(0, 0, 100, 20), &entries)?;
        let x = Axis::new("cell index [log2]", 0.0..furthest, 12);
        let y =
            Axis::new("chi-square a degree of freedom [log10]", -0.4..1.05 * highest, highest.ceil() as u32);
        let mut chart = chart(&body, "", &x, &y)?;
        let [low, high] = [chance.start, chance.end].map(libm::log10);
        block(&mut chart, [(0.0, low), (furthest, high)], BAND)?;
        series.iter().enumerate().try_for_each(|(index, series)| -> Drawn {
            let points = || series.points.iter().map(|&[x, y]| (x, libm::log10(y)));
            curve(&mut chart, points(), colour(index), CURVE)?;
            points().try_for_each(|point| marker(&mut chart, point, index))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::super::style::tests::is_sound;
    use super::*;

    #[test]
    fn every_arithmetic_has_a_curve() {
        let series = ["f32", "half"].map(|name| ValiditySeries {
            name: name.to_owned(),
            points: vec![[0.0, 1.02], [12.0, 0.9], [24.0, 65_536.0]],
        });
        let svg = validity("validity", &series, 0.6..1.5);
        is_sound(&svg, &["f32", "half", "cell index [log2]", "explained by chance"]);
        assert_eq!(svg, validity("validity", &series, 0.6..1.5));
    }

    #[test]
    fn nothing_to_draw_gives_an_empty_picture() {
        is_sound(&validity("nothing", &[], 0.6..1.5), &["nothing"]);
    }
}
