//! Cards smaller than a pixel: conservative coverage with a corrected threshold (§2, Fig. 4).

use crate::threshold::real::Real;

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
    use crate::threshold::hash::integer::murmur3;
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
