//! How a cost grows with a size: panels with logarithms on both axes.

use super::style::{
    Axis, CURVE, Drawn, Key, TITLE_STRIP, WIDTH, chart, colour, curve, legend, legend_height, marker, picture,
};

/// One line of a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// Its name in the legend.
    pub name: String,
    /// Size and cost, both above 0.
    pub points: Vec<[f64; 2]>,
}

/// Draws two costs against one size; both panels have the same lines.
#[must_use]
pub fn growth(title: &str, panels: [(&str, &[Growth]); 2]) -> String {
    let entries: Vec<(Key, &str)> = panels[0]
        .1
        .iter()
        .enumerate()
        .map(|(index, line)| (Key::Series(index), line.name.as_str()))
        .collect();
    let strip = legend_height(&entries, WIDTH as i32 - 120);
    picture(title, TITLE_STRIP + strip + 760, |area| {
        let (top, body) = area.split_vertically(strip);
        legend(&top.margin(0, 0, 100, 20), &entries)?;
        let halves = body.split_evenly((1, 2));
        halves.iter().zip(panels).try_for_each(|(half, (cost, lines))| -> Drawn {
            let range = |axis: usize| {
                let logs = lines.iter().flat_map(|line| &line.points).map(|point| libm::log10(point[axis]));
                let (low, high) =
                    logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
                if low > high { 0.0..1.0 } else { low.floor()..high.ceil().max(low.floor() + 1.0) }
            };
            let y_title = format!("{cost} [log10]");
            let (x, y) = (Axis::new("samples [log10]", range(0), 6), Axis::new(&y_title, range(1), 6));
            let mut chart = chart(half, "", &x, &y)?;
            lines.iter().enumerate().try_for_each(|(index, line)| -> Drawn {
                let points = || line.points.iter().map(|&[x, y]| (libm::log10(x), libm::log10(y)));
                curve(&mut chart, points(), colour(index), CURVE)?;
                points().try_for_each(|point| marker(&mut chart, point, index))
            })
        })
    })
}

#[cfg(test)]
mod tests {
    use super::super::style::tests::is_sound;
    use super::*;

    #[test]
    fn every_line_stands_in_both_panels() {
        let lines = [Growth { name: "1 thread".to_owned(), points: vec![[1e4, 1e-4], [1e6, 1e-2]] }];
        let svg = growth("growth", [("seconds", &lines), ("MiB", &lines)]);
        is_sound(&svg, &["1 thread", "seconds [log10]", "MiB [log10]", "samples [log10]"]);
    }

    #[test]
    fn nothing_to_draw_gives_an_empty_picture() {
        is_sound(&growth("nothing", [("seconds", &[]), ("MiB", &[])]), &["nothing"]);
    }
}
