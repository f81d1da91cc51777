//! Multisampling: geometry is tested at several places of a pixel, alpha at one (§1, §2, §8).

use crate::threshold::stage::order::radical_rank;
use core::num::NonZeroU32;

/// Returns the place of sample `i` of `n`, from the centre of the pixel, in pixels along screen x and y; each component is
/// in (-1/2, 1/2). `i` counts modulo `n`.
///
/// Cut into n rows and n columns, the pixel has one place in each, as in the patterns of hardware; one sample is at the
/// centre. Not in the paper, which leaves the places to hardware.
#[must_use]
pub fn sample_place(i: u32, n: NonZeroU32) -> [f64; 2] {
    let middle = |part: u32| (f64::from(part) + 0.5) / f64::from(n.get()) - 0.5;
    [middle(i % n), middle(radical_rank(i % n, n))]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::threshold::fixed::passes;

    fn places(n: u32) -> Vec<[f64; 2]> {
        let n = NonZeroU32::new(n).unwrap();
        (0..n.get()).map(|i| sample_place(i, n)).collect()
    }

    #[test]
    fn every_row_and_column_has_one_place() {
        assert_eq!(places(1), [[0.0, 0.0]]);
        for n in 1..=64 {
            for axis in [0, 1] {
                let mut parts: Vec<_> =
                    places(n).iter().map(|p| ((p[axis] + 0.5) * f64::from(n)).floor() as u32).collect();
                parts.sort_unstable();
                assert!(parts.into_iter().eq(0..n));
            }
        }
    }

    /// "Because this occurs in texture space, geometric antialiasing is ineffective" (§1): an edge of geometry that runs
    /// through a pixel gets as many grey levels as there are samples; the same edge in an alpha map stays in or out.
    #[test]
    fn edges_of_geometry_are_smoothed_and_edges_of_alpha_are_not() {
        let levels = |share: &dyn Fn(f64) -> f64| {
            let mut seen: Vec<_> = (0..=100).map(|x| share(f64::from(x) / 100.0 - 0.5)).collect();
            seen.dedup();
            seen.len()
        };
        let places = places(8);
        let geometry = |edge: f64| places.iter().filter(|p| p[0] < edge).count() as f64 / 8.0;
        // A box filter of a pixel's width, read once, at the centre.
        let alpha = |edge: f64| f64::from(u8::from(passes(edge + 0.5, 0.5)));
        assert_eq!((levels(&geometry), levels(&alpha)), (9, 2));
        for edge in [-0.4, 0.0, 0.3] {
            assert!((geometry(edge) - (edge + 0.5)).abs() <= 1.0 / 16.0 + 1e-12);
        }
    }
}
