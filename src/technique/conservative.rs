//! Cards smaller than a pixel: conservative coverage with a corrected threshold (§2, Fig. 4).

use crate::threshold::real::Real;
use glam::{DVec2, dvec2};

/// A rectangle on the screen, in pixels: `[left, top, right, bottom]`.
pub type Rectangle = [f64; 4];

/// Returns the area of a pixel that a rectangle covers, in [0, 1].
///
/// Conservative rasterisation draws the pixel wherever it is above 0.
#[must_use]
pub fn sub_pixel_coverage([left, top, right, bottom]: Rectangle, [x, y]: [i32; 2]) -> f64 {
    let overlap = |from: f64, to: f64, pixel: i32| {
        (to.min(f64::from(pixel) + 1.0) - from.max(f64::from(pixel))).max(0.0)
    };
    overlap(left, right, x) * overlap(top, bottom, y)
}

/// Returns the area of a pixel that a convex polygon covers, in (0, 1], and the middle of what it covers there, in pixels
/// from the pixel's upper left corner; `None` where it covers nothing. Corners are in pixels and in turn around the
/// polygon, either way. Not in the paper.
///
/// Attributes of a surface are read at that middle: the centre of the pixel may lie outside.
#[must_use]
pub fn covered(polygon: &[DVec2], [x, y]: [i32; 2]) -> Option<(f64, DVec2)> {
    let corner = dvec2(f64::from(x), f64::from(y));
    let mut part: Vec<DVec2> = polygon.iter().map(|&point| point - corner).collect();
    for (axis, limit, inwards) in [(0, 0.0, 1.0), (0, 1.0, -1.0), (1, 0.0, 1.0), (1, 1.0, -1.0)] {
        part = cut(&part, axis, limit, inwards);
    }
    let first = *part.first()?;
    let (mut area, mut moment) = (0.0, DVec2::ZERO);
    for pair in part.windows(2).skip(1) {
        let [a, b] = [pair[0] - first, pair[1] - first];
        let twice = a.perp_dot(b);
        area += twice;
        moment += twice * (a + b);
    }
    (area != 0.0).then(|| (0.5 * area.abs(), first + moment / (3.0 * area)))
}

/// The part of a convex polygon on one side of a line of constant x or y; what lies on the line is exact.
fn cut(polygon: &[DVec2], axis: usize, limit: f64, inwards: f64) -> Vec<DVec2> {
    let depth = |point: DVec2| inwards * (point[axis] - limit);
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (index, &here) in polygon.iter().enumerate() {
        let next = polygon[(index + 1) % polygon.len()];
        if depth(here) >= 0.0 {
            kept.push(here);
        }
        if (depth(here) > 0.0 && depth(next) < 0.0) || (depth(here) < 0.0 && depth(next) > 0.0) {
            let mut crossing = here.lerp(next, depth(here) / (depth(here) - depth(next)));
            crossing[axis] = limit;
            kept.push(crossing);
        }
    }
    kept
}

/// Returns whether the centre of a pixel lies in a rectangle, its left and top edges counted in: what a rasteriser
/// draws without multisampling.
#[must_use]
pub fn covers_centre([left, top, right, bottom]: Rectangle, [x, y]: [i32; 2]) -> bool {
    let inside = |from: f64, to: f64, pixel: i32| {
        let centre = f64::from(pixel) + 0.5;
        from <= centre && centre < to
    };
    inside(left, right, x) && inside(top, bottom, y)
}

/// Returns the threshold for a pixel of which a card covers the share `coverage` in [0, 1]: `threshold / coverage`, and
/// infinity for none.
///
/// `alpha` reaches it as often as `alpha coverage` reaches a uniform `threshold`. The paper says that the threshold must
/// be modified so, and gives no formula (Fig. 4).
#[must_use]
pub fn corrected<R: Real>(threshold: R, coverage: R) -> R {
    if coverage > R::from_f64(0.0) { threshold / coverage } else { R::from_f64(f64::INFINITY) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::threshold::hash::mm4::murmur3;
    use crate::threshold::hash::open_lattice;

    fn value(card: u32, which: u32) -> f64 {
        open_lattice(murmur3([card, which, 0, 0]))
    }

    /// Cards of one size at random places: how many pixels each draws in the mean, and how many cards draw none.
    fn drawn(side: f64, alpha: f64, keeps: impl Fn(Rectangle, [i32; 2], f64) -> bool) -> (f64, f64) {
        let (cards, mut pixels, mut lost) = (4000, 0_u32, 0_u32);
        for card in 0..cards {
            let corner = [0, 1].map(|axis| 3.0 + 4.0 * value(card, axis));
            let card_area = [corner[0], corner[1], corner[0] + side, corner[1] + side];
            let own = (0..100).map(|i| [i % 10, i / 10]).filter(|&[x, y]| {
                let threshold = open_lattice(murmur3([card, x as u32, y as u32, 9]));
                keeps(card_area, [x, y], threshold) && alpha > 0.0
            });
            let count = own.count() as u32;
            pixels += count;
            lost += u32::from(count == 0);
        }
        (f64::from(pixels) / f64::from(cards), f64::from(lost) / f64::from(cards))
    }

    /// Fig. 4: conservative cards are over-sampled unless the threshold is corrected; then they keep their area.
    #[test]
    fn corrected_thresholds_keep_the_area_of_cards_below_a_pixel() {
        let alpha = 0.7;
        for side in [0.3, 0.6, 0.9, 1.7] {
            let truth = alpha * side * side;
            let touched = |card, pixel| sub_pixel_coverage(card, pixel);
            let (plain, _) = drawn(side, alpha, |c, p, t| touched(c, p) > 0.0 && alpha >= t);
            let (right, _) = drawn(side, alpha, |c, p, t| alpha >= corrected(t, touched(c, p)));
            assert!((plain - alpha * (1.0 + side) * (1.0 + side)).abs() < 0.08, "{side}: {plain}");
            assert!((right - truth).abs() < 0.06, "{side}: {right} for {truth}");
        }
    }

    /// "Some billboards may not appear, causing an apparent loss of coverage" (§2): most cards are lost, and yet the
    /// others make up for them in the mean.
    #[test]
    fn centres_miss_most_small_cards_but_not_their_mean_area() {
        let (area, lost) = drawn(0.3, 1.0, |card, pixel, _| covers_centre(card, pixel));
        assert!((area - 0.09).abs() < 0.02 && lost > 0.85, "{area} {lost}");
    }

    /// A turned square of area one half and its mirror image, the rectangles above, and what lies beside.
    #[test]
    fn polygons_cover_what_rectangles_do_and_more() {
        for i in 0..500 {
            let [left, top, width, height] = [0, 1, 2, 3].map(|which| 3.0 * value(i, which));
            let polygon = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
                .map(|[u, v]: [f64; 2]| dvec2(left + u * width, top + v * height));
            for pixel in (0..36).map(|i| [i % 6, i / 6]) {
                let wanted = sub_pixel_coverage([left, top, left + width, top + height], pixel);
                let found = covered(&polygon, pixel).map_or(0.0, |(area, _)| area);
                assert!((found - wanted).abs() < 1e-12, "{pixel:?}: {found} {wanted}");
            }
        }
        let mut turned = [dvec2(2.5, 3.0), dvec2(3.0, 3.5), dvec2(2.5, 4.0), dvec2(2.0, 3.5)];
        for _ in 0..2 {
            let (area, middle) = covered(&turned, [2, 3]).unwrap();
            assert!((area - 0.5).abs() < 1e-15 && (middle - 0.5).length() < 1e-15);
            assert_eq!(covered(&turned, [3, 3]), None);
            turned.reverse();
        }
        // A large card covers the pixels within it exactly, so that alpha 1 leaves no hole.
        let large = [dvec2(-31.7, -200.1), dvec2(90.3, -11.9), dvec2(77.7, 99.1), dvec2(-55.3, 83.3)];
        assert_eq!(covered(&large, [7, 11]), Some((1.0, dvec2(0.5, 0.5))));
    }

    #[test]
    fn no_coverage_keeps_nothing_and_full_coverage_the_threshold() {
        assert_eq!(corrected(0.25_f32, 1.0), 0.25);
        assert_eq!(corrected(0.25_f64, 0.5), 0.5);
        assert_eq!(corrected(0.25_f64, 0.0), f64::INFINITY);
        let card = [0.5, 0.5, 2.0, 0.75];
        assert_eq!(
            [[0, 0], [1, 0], [2, 0], [0, 1]].map(|p| sub_pixel_coverage(card, p)),
            [0.125, 0.25, 0.0, 0.0]
        );
        assert!(covers_centre(card, [1, 0]) && !covers_centre(card, [0, 1]));
    }
}
