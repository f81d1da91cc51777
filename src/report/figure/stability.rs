//! How many thresholds a shift of the surface by a part of a pixel changes.

use super::style::{
    Axis, CURVE, Drawn, Key, TITLE_STRIP, WIDTH, chart, colour, curve, grid, legend, legend_height, marker,
    picture, share_range, whisker,
};

/// A measured share with its standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredShare {
    /// Shift in pixels.
    pub shift: f64,
    /// Share of thresholds that changed, in [0, 1].
    pub share: f64,
    /// Standard deviation of that share.
    pub sigma: f64,
}

/// A closed-form curve and what was measured of it.
#[derive(Clone, Debug, PartialEq)]
pub struct StabilitySeries {
    /// Its name in the legend; series of several panels with one name and place share an entry.
    pub name: String,
    /// The closed form: shift in pixels, share in [0, 1].
    pub curve: Vec<[f64; 2]>,
    /// The measurements, drawn with bars of three standard deviations.
    pub measured: Vec<MeasuredShare>,
}

/// One chart of the figure.
#[derive(Clone, Debug, PartialEq)]
pub struct StabilityPanel {
    /// What its series have in common; empty for none.
    pub title: String,
    /// The series, in the order of the legend.
    pub series: Vec<StabilitySeries>,
}

/// Draws panels side by side over one scale.
#[must_use]
pub fn stability(title: &str, panels: &[StabilityPanel]) -> String {
    let mut entries: Vec<(Key, &str)> = Vec::new();
    for (index, series) in panels.iter().flat_map(|panel| panel.series.iter().enumerate()) {
        if !entries.iter().any(|(_, name)| *name == series.name) {
            entries.push((Key::Series(index), &series.name));
        }
    }
    entries.push((Key::Note, "points: measured ± 3σ, lines: closed form"));
    let all = || panels.iter().flat_map(|panel| &panel.series);
    let curves = || all().flat_map(|series| &series.curve);
    let measured = || all().flat_map(|series| &series.measured);
    let furthest = curves().map(|p| p[0]).chain(measured().map(|m| m.shift)).fold(0.0, f64::max);
    let highest =
        curves().map(|p| p[1]).chain(measured().map(|m| m.share + 3.0 * m.sigma)).fold(0.0, f64::max);
    let strip = legend_height(&entries, WIDTH as i32 - 120);
    picture(title, TITLE_STRIP + strip + 860, |area| {
        let (top, body) = area.split_vertically(strip);
        legend(&top.margin(0, 0, 100, 20), &entries)?;
        let range = 0.0..if furthest > 0.0 { furthest } else { 1.0 };
        let x = Axis { terse: true, ..Axis::new("shift of the surface [pixels]", range, 5) };
        let sides = grid(&body, [1, panels.len().max(1)], [112, 0]);
        for (index, (panel, side)) in panels.iter().zip(sides).enumerate() {
            let title = if index == 0 { "share of changed thresholds" } else { "" };
            let y = Axis { numbered: index == 0, ..Axis::new(title, share_range(highest), 5) };
            let mut chart = chart(&side, &panel.title, &x, &y)?;
            panel.series.iter().enumerate().try_for_each(|(series_index, series)| -> Drawn {
                let colour = colour(series_index);
                curve(&mut chart, series.curve.iter().map(|&[x, y]| (x, y)), colour, CURVE)?;
                series.measured.iter().try_for_each(|m| {
                    whisker(&mut chart, m.shift, m.share - 3.0 * m.sigma, m.share + 3.0 * m.sigma, colour)?;
                    marker(&mut chart, (m.shift, m.share), series_index)
                })
            })?;
        }
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::super::style::tests::is_sound;
    use super::*;

    fn panel(title: &str) -> StabilityPanel {
        let series = |name: &str| StabilitySeries {
            name: name.to_owned(),
            curve: vec![[0.0, 0.0], [0.5, 0.4], [1.0, 0.9]],
            measured: vec![MeasuredShare { shift: 0.5, share: 0.41, sigma: 0.01 }],
        };
        StabilityPanel { title: title.to_owned(), series: vec![series("along x"), series("along y")] }
    }

    #[test]
    fn panels_share_their_legend() {
        let panels = [panel("isotropic"), panel("anisotropic")];
        let svg = stability("grazing", &panels);
        is_sound(
            &svg,
            &["isotropic", "anisotropic", "shift of the surface [pixels]", "share of changed thresholds"],
        );
        assert_eq!(svg.matches("along x").count(), 1);
        assert_eq!(svg, stability("grazing", &panels));
    }

    #[test]
    fn nothing_to_draw_gives_an_empty_picture() {
        is_sound(&stability("nothing", &[]), &["nothing"]);
        is_sound(&stability("no series", &[StabilityPanel { title: String::new(), series: vec![] }]), &[]);
    }
}
