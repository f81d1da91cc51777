//! Eq. 2 and its density for several weights.

use super::style::{
    Axis, CURVE, Key, TITLE_STRIP, WIDTH, chart, colour, curve, legend, legend_height, picture,
};
use crate::threshold::cdf::{cdf, density};

/// Draws the distribution function and the density of the joined hashes for each `a = min(t, 1 - t)` in [0, 1/2].
#[must_use]
pub fn cdf_family(minor_weights: &[f64]) -> String {
    let entries: Vec<_> =
        minor_weights.iter().enumerate().map(|(i, a)| (Key::Line(colour(i)), format!("a = {a}"))).collect();
    let strip = legend_height(&entries, WIDTH as i32 - 120);
    let title = "The law of (1 - t) U0 + t U1 for a = min(t, 1 - t)";
    picture(title, TITLE_STRIP + strip + 780, |area| {
        let (top, panels) = area.split_vertically(strip);
        legend(&top.margin(0, 0, 100, 20), &entries)?;
        let (left, right) = panels.split_horizontally(WIDTH / 2);
        let x = Axis::unit("interpolated hash x", 5);
        let sides = [
            (
                left,
                "distribution function (Eq. 2)",
                Axis::new("CDF(x)", 0.0..1.02, 5),
                cdf as fn(f64, f64) -> f64,
            ),
            (right, "density", Axis::new("density", 0.0..2.1, 5), density),
        ];
        for (side, heading, y, function) in sides {
            let mut chart = chart(&side, heading, &x, &y)?;
            for (index, &a) in minor_weights.iter().enumerate() {
                curve(&mut chart, abscissae(a).map(|x| (x, function(x, a))), colour(index), CURVE)?;
            }
        }
        Ok(())
    })
}

/// Even steps, and the two corners of the trapezoid.
fn abscissae(a: f64) -> impl Iterator<Item = f64> {
    let mut all: Vec<f64> = (0..=160).map(|i| f64::from(i) / 160.0).chain([a, 1.0 - a]).collect();
    all.sort_by(f64::total_cmp);
    all.into_iter()
}

#[cfg(test)]
mod tests {
    use super::super::style::tests::is_sound;
    use super::*;

    #[test]
    fn every_weight_has_a_curve() {
        let weights = [0.0, 0.1, 0.25, 0.5];
        let svg = cdf_family(&weights);
        is_sound(&svg, &["a = 0.25", "CDF(x)", "density", "interpolated hash x"]);
        // Twice in the panels.
        let curves = svg.matches("<polyline").count();
        assert!(curves >= 2 * weights.len(), "{curves}");
        assert_eq!(svg, cdf_family(&weights));
    }
}
