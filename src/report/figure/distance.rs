//! Coverage against distance: what each take keeps of the surfaces as the viewer goes away from them.

use super::style::{
    Axis, CURVE, Canvas, Drawn, FRAME, Key, TITLE_STRIP, WIDTH, chart, colour, curve, legend, legend_height,
    marker, picture, share_range,
};

/// Distance as a multiple of the scene's, above 0, and coverage in [0, 1].
pub type Point = [f64; 2];

/// One take over all distances.
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    /// Its name in the legend.
    pub name: String,
    /// What it covers, in ascending order of distance.
    pub points: Vec<Point>,
}

/// Draws the coverage of the image, and below it that coverage as a share of the truth's at the same distances, unless
/// `truth` is empty.
#[must_use]
pub fn distance(title: &str, takes: &[Kept], truth: &[Point]) -> String {
    let mut entries: Vec<(Key, &str)> =
        takes.iter().enumerate().map(|(index, take)| (Key::Series(index), take.name.as_str())).collect();
    if !truth.is_empty() {
        entries.push((Key::Line(FRAME), "truth"));
    }
    let strip = legend_height(&entries, WIDTH as i32 - 120);
    let panels = if truth.is_empty() { 1 } else { 2 };
    picture(title, TITLE_STRIP + strip + 560 * panels, |area| {
        let (top, body) = area.split_vertically(strip);
        legend(&top.margin(0, 0, 100, 20), &entries)?;
        let rows = body.split_evenly((panels as usize, 1));
        let lines: Vec<&[Point]> = takes.iter().map(|take| &take.points[..]).collect();
        panel(&rows[0], "coverage of the image", &lines, truth)?;
        let Some(below) = rows.get(1) else { return Ok(()) };
        let shares: Vec<Vec<Point>> = lines.iter().map(|line| over(line, truth)).collect();
        let shares: Vec<&[Point]> = shares.iter().map(Vec::as_slice).collect();
        panel(below, "share of the truth's", &shares, &over(truth, truth))
    })
}

/// A line in units of the truth, where that has something at the same distance.
fn over(line: &[Point], truth: &[Point]) -> Vec<Point> {
    let unit = |x: f64| truth.iter().find(|point| point[0] == x && point[1] > 0.0);
    line.iter().filter_map(|&[x, y]| Some([x, y / unit(x)?[1]])).collect()
}

fn panel(area: &Canvas<'_>, title: &str, lines: &[&[Point]], truth: &[Point]) -> Drawn {
    let all = || lines.iter().copied().chain([truth]).flatten();
    let ends = |axis: usize, of: fn(f64) -> f64| {
        let values = all().map(|point| of(point[axis]));
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
    };
    let (near, far) = ends(0, libm::log2);
    // Room at both ends, so that markers stand off the frame.
    let range = if near <= far { near - 0.25..far + 0.25 } else { 0.0..1.0 };
    let (_, most) = ends(1, |share| share);
    let y = Axis::new(title, if most > 1.0 { 0.0..1.08 * most } else { share_range(most) }, 5);
    let mut chart = chart(area, "", &Axis::new("distance, times the scene's (log2)", range, 4), &y)?;
    let points =
        |line: &[Point]| -> Vec<(f64, f64)> { line.iter().map(|&[x, y]| (libm::log2(x), y)).collect() };
    curve(&mut chart, points(truth), FRAME, CURVE)?;
    lines.iter().enumerate().try_for_each(|(index, line)| {
        curve(&mut chart, points(line), colour(index), CURVE)?;
        points(line).into_iter().try_for_each(|point| marker(&mut chart, point, index))
    })
}

#[cfg(test)]
mod tests {
    use super::super::style::tests::is_sound;
    use super::*;

    fn kept() -> [Kept; 2] {
        [("fixed", 0.1), ("hashed", 0.2)]
            .map(|(name, far)| Kept { name: name.to_owned(), points: vec![[1.0, 0.4], [4.0, far]] })
    }

    #[test]
    fn takes_stand_beside_the_truth_and_as_a_share_of_it() {
        let svg = distance("a fence", &kept(), &[[1.0, 0.4], [4.0, 0.25]]);
        is_sound(&svg, &["fixed", "hashed", "truth", "coverage of the image", "share of the truth"]);
        assert_eq!(over(&kept()[1].points, &[[1.0, 0.4], [4.0, 0.25]]), [[1.0, 1.0], [4.0, 0.8]]);
        // What the truth does not have has no share.
        assert_eq!(over(&kept()[1].points, &[[1.0, 0.0], [2.0, 0.25]]), Vec::<Point>::new());
    }

    #[test]
    fn without_a_truth_there_is_one_panel() {
        let svg = distance("a fence", &kept(), &[]);
        is_sound(&svg, &["fixed", "coverage of the image"]);
        assert!(!svg.contains("share of the truth") && !svg.contains(">truth<"));
        is_sound(&distance("nothing", &[], &[]), &["nothing"]);
    }
}
