//! Stippled alpha: one pixel of every 2 x 2 is treated apart, wherever the surface lies (Ols 2009).

use crate::threshold::real::Real;

/// How much of a surface the stipple keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Density {
    /// Three of four pixels are kept: the surface looks three quarters opaque.
    High,
    /// One of four pixels is kept.
    Low,
}

impl Density {
    /// Both, the greater first.
    pub const ALL: [Self; 2] = [Self::High, Self::Low];

    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::High => "high",
            Self::Low => "low",
        }
    }
}

/// Returns whether the stipple keeps a pixel, given its column and row: the odd pixel of an odd row is the one apart.
///
/// The form with a texture of 2 x 2 texels.
#[must_use]
pub fn keeps(density: Density, pixel: [u32; 2]) -> bool {
    is_apart(pixel) == (density == Density::Low)
}

fn is_apart([x, y]: [u32; 2]) -> bool {
    x & y & 1 == 1
}

/// Returns the threshold of a pixel: `kept`, in (0, 1], where the stipple keeps, and 1, which only an opaque fragment
/// reaches, where it does not.
///
/// The source stipples the surfaces that are to look translucent and no others; alpha 1 says here that one is opaque.
#[must_use]
pub fn threshold<R: Real>(density: Density, pixel: [u32; 2], kept: R) -> R {
    if keeps(density, pixel) { kept } else { R::from_f64(1.0) }
}

/// Returns whether the pseudo-code of the source keeps a pixel, `position` being in pixels: it discards where
/// `fract(position / 2)` is at most 1/2 along both axes.
///
/// Literal: GLSL's `step(x, 0.5)` is true up to 1/2, while the text discards what exceeds 1/2. At pixel centres
/// (`k + 1/2`) both discard one of four, though not the same one; at whole numbers the pseudo-code discards everything,
/// and the text nothing ([`keeps_in_words`]).
#[must_use]
pub fn keeps_literal(position: [f64; 2]) -> bool {
    let [x, y] = position.map(half_fraction);
    let discards = x <= 0.5 && y <= 0.5;
    !discards
}

/// Returns whether the text of the source keeps a pixel: "wherever the components for both width and height exceed 0.5"
/// it is discarded. `position` is in pixels; see [`keeps_literal`].
#[must_use]
pub fn keeps_in_words(position: [f64; 2]) -> bool {
    let [x, y] = position.map(half_fraction);
    let discards = x > 0.5 && y > 0.5;
    !discards
}

fn half_fraction(position: f64) -> f64 {
    let half = position * 0.5;
    half - half.floor()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: u32 = 24;

    fn pixels() -> impl Iterator<Item = [u32; 2]> {
        (0..SIDE * SIDE).map(|i| [i % SIDE, i / SIDE])
    }

    fn kept(test: impl Fn([u32; 2]) -> bool) -> f64 {
        pixels().filter(|&pixel| test(pixel)).count() as f64 / f64::from(SIDE * SIDE)
    }

    fn high(pixel: [u32; 2]) -> bool {
        keeps(Density::High, pixel)
    }

    /// "The stipple pattern is 2x2 pixels, with three opaque, and one transparent."
    #[test]
    fn the_densities_are_three_quarters_and_one() {
        assert_eq!(kept(high), 0.75);
        assert_eq!(kept(|pixel| keeps(Density::Low, pixel)), 0.25);
        assert!(pixels().all(|p| high(p) != keeps(Density::Low, p)));
    }

    /// "The discarded components are only one pixel in size, and padded by one pixel on all sides."
    #[test]
    fn every_hole_is_one_pixel_among_kept_ones() {
        for [x, y] in pixels().filter(|&p| !high(p) && p[0] > 0 && p[1] > 0) {
            let around = (0..9).filter(|&i| i != 4).map(|i| [x + i % 3 - 1, y + i / 3 - 1]);
            assert_eq!(around.filter(|&p| high(p)).count(), 8);
        }
    }

    /// Text and pseudo-code part where positions are whole numbers, and one of them is blank, the other solid.
    #[test]
    fn the_pseudo_code_needs_positions_at_pixel_centres() {
        let at = |[x, y]: [u32; 2], shift: f64| [f64::from(x) + shift, f64::from(y) + shift];
        assert_eq!(kept(|p| keeps_literal(at(p, 0.5))), 0.75);
        assert_eq!(kept(|p| keeps_in_words(at(p, 0.5))), 0.75);
        assert!(pixels().all(|p| keeps_in_words(at(p, 0.5)) == high(p)));
        assert!(!pixels().all(|p| keeps_literal(at(p, 0.5)) == high(p)));
        assert_eq!(kept(|p| keeps_literal(at(p, 0.0))), 0.0);
        assert_eq!(kept(|p| keeps_in_words(at(p, 0.0))), 1.0);
    }

    #[test]
    fn opaque_surfaces_have_no_hole_and_absent_ones_never_show() {
        for density in [Density::High, Density::Low] {
            for pixel in pixels() {
                let threshold = threshold(density, pixel, 0.3);
                assert!(threshold > 0.0 && threshold <= 1.0);
                assert_eq!(0.7 >= threshold, keeps(density, pixel));
            }
        }
    }

    /// "It only allows one layer of translucency": the second layer has its holes in the same place.
    #[test]
    fn two_layers_look_like_one() {
        let through_both = |density| kept(|p| !keeps(density, p) && !keeps(density, p));
        assert_eq!(through_both(Density::High), 0.25);
        assert_eq!(through_both(Density::Low), 0.75);
    }

    /// "The constant size of the perforations": a surface of few pixels keeps what its place on the screen says.
    #[test]
    fn a_small_surface_is_kept_or_lost_by_its_place() {
        let card = |left: u32, top: u32, side: u32| {
            let inside = (0..side * side).map(|i| [left + i % side, top + i / side]);
            inside.filter(|&p| high(p)).count() as f64 / f64::from(side * side)
        };
        let spread = |side| {
            let shares: Vec<_> = (0..4).map(|i| card(i % 2, i / 2, side)).collect();
            shares.iter().copied().fold(0.0, f64::max) - shares.iter().copied().fold(1.0, f64::min)
        };
        assert_eq!([1, 3, 9].map(spread).map(|s| (s * 81.0).round()), [81.0, 27.0, 9.0]);
        assert_eq!(spread(2), 0.0);
    }

    /// A depth buffer of a stippled surface at depth 1 before a wall at depth 9.
    fn depth([x, y]: [u32; 2]) -> f64 {
        if high([x, y]) { 1.0 } else { 9.0 }
    }

    fn values(depths: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut values: Vec<_> = depths.collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        values
    }

    /// "Sometimes it will make the object disappear, and sometimes completely opaque", by which pixel is taken; "the
    /// worst case being a weird grid", where the ratio is no whole number of patterns.
    #[test]
    fn a_smaller_depth_buffer_loses_the_surface_the_holes_or_both() {
        let taken = |phase: u32, ratio: u32| {
            values((0..16).map(|i| depth([phase + ratio * (i % 4), phase + ratio * (i / 4)])))
        };
        assert_eq!(taken(0, 2), [1.0]);
        assert_eq!(taken(1, 2), [9.0]);
        assert_eq!(taken(0, 3), [1.0, 9.0]);
        let mean = |ratio: u32, corner: u32| {
            let inside = (0..ratio * ratio).map(|i| [corner + i % ratio, corner + i / ratio]);
            inside.map(depth).sum::<f64>() / f64::from(ratio * ratio)
        };
        // The mean of 2 x 2 is a depth at which there is nothing; of 3 x 3 it differs from block to block.
        assert_eq!(mean(2, 0), 3.0);
        assert_ne!(mean(3, 0), mean(3, 3));
    }

    /// A normal buffer of the same: averaging 2 x 2 mixes the surface's normal with the wall's.
    #[test]
    fn a_smaller_normal_buffer_points_nowhere() {
        let normal = |p| if high(p) { [0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0] };
        let sum = (0..4)
            .map(|i| normal([i % 2, i / 2]))
            .fold([0.0; 3], |s: [f64; 3], n| core::array::from_fn(|i| s[i] + n[i] / 4.0));
        assert_eq!(sum, [0.0, 0.25, 0.75]);
        assert!(sum.iter().map(|c| c * c).sum::<f64>() < 0.8);
    }

    /// "Noisy dark and bright spots": occlusion from the depths around a pixel, on a flat surface before a far wall.
    #[test]
    fn ambient_occlusion_sees_the_holes_as_pits() {
        let occlusion = |depth: &dyn Fn([u32; 2]) -> f64, [x, y]: [u32; 2]| {
            let around = (0..9).filter(|&i| i != 4).map(|i| [x + i % 3 - 1, y + i / 3 - 1]);
            around.filter(|&p| depth(p) < depth([x, y]) - 0.1).count() as f64 / 8.0
        };
        let inner: Vec<_> = pixels().filter(|p| p.iter().all(|&c| c > 0 && c < SIDE - 1)).collect();
        assert_eq!(values(inner.iter().map(|&p| occlusion(&|_| 1.0, p))), [0.0]);
        assert_eq!(values(inner.iter().map(|&p| occlusion(&depth, p))), [0.0, 1.0]);
    }
}
