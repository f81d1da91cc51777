//! The paper's hash (§5.1, after McGuire's Graphics Codex).

use super::cell::{Cell, Hash};
use super::listed::{Listed, OfBlocks};
use crate::threshold::batch::block::Block;
use crate::threshold::batch::lane::Kernel;
use crate::threshold::real::Real;

/// Hashes two coordinates: the fractional part of 1e4 sin(17 x + 0.1 y) (0.1 + |sin(13 y + x)|).
///
/// Any finite coordinates; the paper calls with integral ones. The value is in [0, 1]; the paper says [0, 1), and
/// rounding reaches 1 only for a product within half an ULP below an integer. `hash_2d(0, 0)` is 0 and
/// `hash_2d(-x, -y)` is `1 - hash_2d(x, y)`: both are the formula's, not a defect of this crate. §5.1.
#[must_use]
pub fn hash_2d<R: Real>(x: R, y: R) -> R {
    let [hash] = hash_2d_all([x], [y]);
    hash
}

/// [`hash_2d`] of several pairs of coordinates.
#[inline(always)]
pub(super) fn hash_2d_all<R: Real, const N: usize>(x: [R; N], y: [R; N]) -> [R; N] {
    hash_2d_by(R::sin_all, R::fract, x, y)
}

/// [`hash_2d`] of several pairs of coordinates, with sines and a fractional part of the caller's.
#[inline(always)]
pub(in crate::threshold) fn hash_2d_by<R: Real, const N: usize>(
    sin: impl Fn([R; N]) -> [R; N],
    fract: impl Fn(R) -> R,
    x: [R; N],
    y: [R; N],
) -> [R; N] {
    let constant = R::from_f64;
    let (mut first, mut second) = (x, x);
    for i in 0..N {
        first[i] = constant(17.0) * x[i] + constant(0.1) * y[i];
        second[i] = constant(13.0) * y[i] + x[i];
    }
    let (first, second) = (sin(first), sin(second));
    let mut hashes = x;
    for i in 0..N {
        let amplitude = constant(1.0e4) * first[i];
        hashes[i] = fract(amplitude * (constant(0.1) + second[i].abs()));
    }
    hashes
}

/// Hashes three coordinates by hashing the hash of the first two with the third (`hash3D`, §5.1; chi_1 of §9).
///
/// Domain and range are those of [`hash_2d`]. In `f32` the inner hash takes about 4000 effectively different values,
/// so all cells with one z share a bias that no number of samples averages out.
#[must_use]
pub fn hash_3d<R: Real>(coordinates: R::Vec3) -> R {
    let [x, y, z] = coordinates.into();
    hash_2d(hash_2d(x, y), z)
}

/// [`hash_3d`] of the cell's coordinates; does not read the octave, as in Listings 1 and 2.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sine;

impl<R: Real> Hash<R> for Sine {
    fn hash(&self, cell: &Cell<R>) -> R {
        let [hash] = self.hash_all([*cell]);
        hash
    }

    #[inline(always)]
    fn hash_all<const N: usize>(&self, cells: [Cell<R>; N]) -> [R; N] {
        let [x, y, z] = coordinates(cells);
        hash_2d_all(hash_2d_all(x, y), z)
    }
}

/// The coordinates of cells, axis by axis.
#[inline(always)]
pub(super) fn coordinates<R: Real, const N: usize>(cells: [Cell<R>; N]) -> [[R; N]; 3] {
    let mut axes = [[R::from_f64(0.0); N]; 3];
    for (i, cell) in cells.into_iter().enumerate() {
        [axes[0][i], axes[1][i], axes[2][i]] = cell.index.into();
    }
    axes
}

impl OfBlocks for Sine {
    const ASKS_SINE: bool = true;

    #[inline(always)]
    fn block<R: Kernel, const FUSED: bool>(
        sine: impl Fn(R) -> R + Copy,
        [x, y, z]: [&Block<R>; 3],
        _: &Block<u32>,
        out: &mut Block<R>,
    ) {
        for i in 0..out.len() {
            [out[i]] = hash_2d_by(|[angle]| [sine(angle)], R::lane_fract::<FUSED>, [x[i]], [y[i]]);
        }
        for i in 0..out.len() {
            [out[i]] = hash_2d_by(|[angle]| [sine(angle)], R::lane_fract::<FUSED>, [out[i]], [z[i]]);
        }
    }
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "sine",
    reads_octave: false,
    is_exact: false,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/hash/sine.wgsl"),
        include_str!("../../shader/chunk/hash_cell/sine.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["1.0e4", "1.0"],
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn origin_hashes_to_zero() {
        assert_eq!(hash_2d(0.0_f32, 0.0), 0.0);
        assert_eq!(hash_3d::<f64>(glam::DVec3::ZERO), 0.0);
    }

    /// Values from a 60-digit evaluation of the formula with mpmath.
    #[test]
    fn f64_agrees_with_a_high_precision_evaluation() {
        for (x, y, expected) in GOLDEN_2D {
            let value: f64 = hash_2d(x, y);
            // Rounding of the two arguments, times the amplitude.
            let tolerance = 1.1e4 * 2.0 * (17.0 * x.abs() + 13.0 * y.abs()) * f64::EPSILON;
            assert!((value - expected).abs() <= tolerance, "hash_2d({x}, {y}) = {value}, not {expected}");
        }
    }

    #[test]
    fn negative_coordinates_keep_the_range() {
        for x in -40..40 {
            for y in -40..40 {
                let value = hash_2d(x as f32, y as f32);
                assert!((0.0..=1.0).contains(&value), "hash_2d({x}, {y}) = {value}");
            }
        }
    }

    #[test]
    fn mirrored_cells_add_up_to_one() {
        for (x, y) in [(3.0, 5.0), (-7.0, 2.0), (100.0, -41.0)] {
            assert!((hash_2d::<f64>(x, y) + hash_2d::<f64>(-x, -y) - 1.0).abs() < 1e-9);
        }
    }

    const GOLDEN_2D: [(f64, f64, f64); 5] = [
        (1.0, 0.0, 0.721_565_283_119_155_79),
        (0.0, 1.0, 0.300_525_134_600_497_84),
        (3.0, -5.0, 0.035_751_890_499_618_468),
        (-12.0, 7.0, 0.931_564_752_355_345_25),
        (100.0, 41.0, 0.377_027_465_030_453_87),
    ];
}
