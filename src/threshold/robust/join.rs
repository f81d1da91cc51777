//! How the hashes of neighbouring octaves become one threshold.
//!
//! | join | hashes (isotropic, anisotropic) | uniform | under zoom |
//! |---|---|---|---|
//! | [`Join::Interpolate`] | 2, 2 | by Eq. 2 | continuous; with one scale an axis it jumps at every octave of an axis |
//! | [`Join::Copula`] | 2, 8 | for any weights | continuous |
//! | [`Join::Dithered`] | 2 of 3, 1 and 3 of one dimension | by construction | each cell switches once an octave; with one scale an axis, each slab of cells |
//! | [`Join::Inherit`] | as `Dithered` | by construction | as `Dithered`; of those that switch, a quarter keep their threshold, with one scale an axis a half |

use super::nested::{inherited, named};
use super::repairs::{Repair, Repairs};
use super::scales::{Scales, corner_weight, nested_cell};
use crate::threshold::cdf::{cdf, cdf_literal};
use crate::threshold::choice::{UnknownName, by_name};
use crate::threshold::hash::{Cell, Hash, octave_word};
use crate::threshold::real::Real;
use crate::threshold::two_scale::Variant;
use core::fmt;
use core::str::FromStr;

/// A way of joining the hashes of two octaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Join {
    /// The paper's: a linear mixture, made uniform by Eq. 2.
    Interpolate,
    /// A linear mixture of normal quantiles, scaled back to unit variance: uniform for any weights. With one scale an
    /// axis it mixes the eight corners of the box of octaves by trilinear weights and is continuous in each of them.
    /// Not in the paper, which tried eight corners with a CDF of their own and set them aside (§6.2).
    Copula,
    /// One of the two hashes, chosen by a third hash of the coarse cell: no mixture and no CDF, and one change in an octave of
    /// zoom. Not in the paper.
    Dithered,
    /// [`Join::Dithered`] with cells that inherit: one in four children keeps the threshold of its parent, with one scale an
    /// axis one in two along each axis, so that a quarter or half of what the dithered join changes under zoom stays
    /// ([`nested`]). With one scale the other children share the rest of [0, 1], which makes less grain. The hash has to read the octave
    /// ([`Robust::tells_octaves_apart`]). Not in the paper.
    ///
    /// [`nested`]: crate::threshold::robust::nested
    /// [`Robust::tells_octaves_apart`]: crate::threshold::robust::Robust::tells_octaves_apart
    Inherit,
}

impl Join {
    /// Every join, in the order in which they are listed to users.
    pub const ALL: [Self; 4] = [Self::Interpolate, Self::Copula, Self::Dithered, Self::Inherit];

    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Interpolate => "interpolate",
            Self::Copula => "copula",
            Self::Dithered => "dithered",
            Self::Inherit => "inherit",
        }
    }

    /// Whether a cell takes one of its two octaves, and changes from the one to the other at once.
    #[must_use]
    pub const fn switches(self) -> bool {
        match self {
            Self::Interpolate | Self::Copula => false,
            Self::Dithered | Self::Inherit => true,
        }
    }

    /// The number of hashes of one threshold, by how scales come from derivatives.
    #[must_use]
    pub const fn hashes(self, variant: Variant) -> u64 {
        match (self, variant) {
            (Self::Copula, Variant::Anisotropic) => 8,
            (Self::Dithered | Self::Inherit, Variant::Anisotropic) => 4,
            (Self::Interpolate | Self::Copula | Self::Dithered | Self::Inherit, _) => 2,
        }
    }
}

impl fmt::Display for Join {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Join {
    type Err = UnknownName;
    fn from_str(name: &str) -> Result<Self, UnknownName> {
        by_name("join", &Self::ALL, Self::name, name)
    }
}

/// What a join made of a footprint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joined<R: Real> {
    /// Weight of the finer octave, along each axis; of the finer corner for [`Join::Interpolate`].
    pub lerp_factor: [R; 3],
    /// Hash of the cell that is coarse along every axis, or the value that it inherits.
    pub hash_coarse: R,
    /// Hash of the cell that is fine along every axis, or the value that it inherits.
    pub hash_fine: R,
    /// The mixture before it is made uniform; the threshold itself for joins that mix nothing.
    pub interpolated: R,
    /// The threshold before the last clamp.
    pub uniform: R,
}

/// What a threshold takes of a join: the weights, the mixture and the uniform value of [`Joined`].
pub(super) struct Mixed<R: Real> {
    pub lerp_factor: [R; 3],
    pub interpolated: R,
    pub uniform: R,
}

/// Joins the hashes of the cells around `position`.
#[inline(always)]
pub(super) fn joined<R: Real, H: Hash<R>>(
    join: Join,
    variant: Variant,
    hash: &H,
    position: R::Vec3,
    scales: &Scales<R>,
    repairs: Repairs,
) -> Mixed<R> {
    let coarse = nested_cell::<R>(position, scales.octave, repairs);
    let fine = nested_cell::<R>(position, scales.next_octave, repairs);
    let corners = Corners { coarse: coarse.index.into(), fine: fine.index.into(), scales, repairs };
    let anisotropic = variant == Variant::Anisotropic;
    let (lerp_factor, interpolated, uniform) = match join {
        Join::Interpolate => {
            let weight = if anisotropic { corner_weight(scales.fraction) } else { scales.fraction[0] };
            let hashes = hash.hash_all([coarse, fine]);
            let (mixture, uniform) = interpolated(hashes, weight, repairs);
            ([weight; 3], mixture, uniform)
        }
        Join::Copula if anisotropic => {
            let mut cells = [coarse; 8];
            for (corner, cell) in cells.iter_mut().enumerate() {
                *cell = corners.cell([corner & 1 == 1, corner >> 1 & 1 == 1, corner >> 2 & 1 == 1]);
            }
            let normal = trilinear(scales.fraction, hash.hash_all(cells));
            (scales.fraction, normal, normal.normal_cdf())
        }
        Join::Copula => {
            let normal = linear(scales.fraction[0], hash.hash_all([coarse, fine]));
            (scales.fraction, normal, normal.normal_cdf())
        }
        Join::Dithered if anisotropic => {
            let chosen = hash.hash(&corners.cell(takes_fine(hash, &coarse, scales)));
            (scales.fraction, chosen, chosen)
        }
        Join::Dithered => {
            let is_fine = is_fine(hash, &coarse, scales);
            // By its place in memory: what a hash decides, no predictor of branches foretells.
            let chosen = hash.hash(&[coarse, fine][usize::from(is_fine)]);
            (scales.fraction, chosen, chosen)
        }
        Join::Inherit if anisotropic => {
            let chosen = hash.hash(&corners.named(takes_fine(hash, &coarse, scales)));
            (scales.fraction, chosen, chosen)
        }
        Join::Inherit => {
            let is_fine = usize::from(is_fine(hash, &coarse, scales));
            let octave = [scales.octave[0], scales.next_octave[0]][is_fine];
            let chosen = inherited(hash, [coarse, fine][is_fine].index.into(), octave, repairs);
            (scales.fraction, chosen, chosen)
        }
    };
    Mixed { lerp_factor, interpolated, uniform }
}

/// Returns the values of the coarse and of the fine cell, between which a join moves: their hashes, or what they inherit.
pub(super) fn ends<R: Real, H: Hash<R>>(
    join: Join,
    variant: Variant,
    hash: &H,
    position: R::Vec3,
    scales: &Scales<R>,
    repairs: Repairs,
) -> [R; 2] {
    let cells = [scales.octave, scales.next_octave].map(|octave| nested_cell::<R>(position, octave, repairs));
    match (join, variant) {
        (Join::Inherit, Variant::Anisotropic) => {
            let [coarse, fine] = cells.map(|cell| cell.index.into());
            let corners = Corners { coarse, fine, scales, repairs };
            [false, true].map(|is_fine| hash.hash(&corners.named([is_fine; 3])))
        }
        (Join::Inherit, _) => {
            let of = |cell: Cell<R>, octave: [i32; 3]| inherited(hash, cell.index.into(), octave[0], repairs);
            [of(cells[0], scales.octave), of(cells[1], scales.next_octave)]
        }
        (Join::Interpolate | Join::Copula | Join::Dithered, _) => hash.hash_all(cells),
    }
}

/// The cells around a position: those of the coarse and of the fine octave of each axis, in any combination.
struct Corners<'a, R: Real> {
    coarse: [R; 3],
    fine: [R; 3],
    scales: &'a Scales<R>,
    repairs: Repairs,
}

impl<R: Real> Corners<'_, R> {
    /// The cell that is fine along the axes that are named, coarse along the others.
    #[inline(always)]
    fn cell(&self, is_fine: [bool; 3]) -> Cell<R> {
        let Scales { octave, next_octave, .. } = self.scales;
        let index = choose(is_fine, self.fine, self.coarse);
        let octave = choose(is_fine, *next_octave, *octave);
        self.at(index, octave)
    }

    /// The same by the names of its intervals.
    #[inline(always)]
    fn named(&self, is_fine: [bool; 3]) -> Cell<R> {
        let Scales { octave, next_octave, .. } = self.scales;
        let index = choose(is_fine, self.fine, self.coarse);
        let octave = choose(is_fine, *next_octave, *octave);
        let nested_phase = self.repairs.contains(Repair::NestedPhase);
        let [x, y, z] = [0, 1, 2].map(|axis| named(index[axis].to_word() as i32, octave[axis], nested_phase));
        self.at([x.0, y.0, z.0].map(|index| R::from_f64(f64::from(index))), [x.1, y.1, z.1])
    }

    #[inline(always)]
    fn at(&self, index: [R; 3], octave: [i32; 3]) -> Cell<R> {
        let word = if self.repairs.contains(Repair::OctaveWord) { octave_word(octave) } else { 0 };
        Cell { index: index.into(), octave: word }
    }
}

/// Takes each component from the one or the other, by its place in memory and without a branch.
#[inline(always)]
fn choose<T: Copy>([x, y, z]: [bool; 3], [x1, y1, z1]: [T; 3], [x0, y0, z0]: [T; 3]) -> [T; 3] {
    [[x0, x1][usize::from(x)], [y0, y1][usize::from(y)], [z0, z1][usize::from(z)]]
}

/// Mixes two hashes, and makes the mixture uniform by Eq. 2.
#[inline(always)]
fn interpolated<R: Real>([coarse, fine]: [R; 2], weight: R, repairs: Repairs) -> (R, R) {
    let mixture = (R::from_f64(1.0) - weight) * coarse + weight * fine;
    let law = if repairs.contains(Repair::StableCdf) { cdf } else { cdf_literal };
    (mixture, law(mixture, weight))
}

/// Tells the words of the choosing hash from those of cells: bits of the root of 2, which no octave has. One bit would be
/// too few: PCG4D turns a difference in the highest alone into the same value half a unit away, in a quarter of the cells.
pub(in crate::threshold) const CHOICE: u32 = 0x6a09_e667;

/// The same for each axis that chooses alone: the roots of 3, 5 and 7.
const CHOICE_OF_AXIS: [u32; 3] = [0xbb67_ae85, 0x3c6e_f372, 0xa54f_f53a];

/// Whether a cell takes its finer octave: chosen by its own hash.
#[inline(always)]
fn is_fine<R: Real>(hash: &impl Hash<R>, coarse: &Cell<R>, scales: &Scales<R>) -> bool {
    scales.fraction[0] > hash.hash(&Cell { octave: coarse.octave ^ CHOICE, ..*coarse })
}

/// The one-dimensional cell by which an axis chooses its octave: its own interval and octave, nothing of the others.
#[inline(always)]
fn interval<R: Real>(coarse: &Cell<R>, axis: usize, octave: i32) -> Cell<R> {
    let zero = R::from_f64(0.0);
    let index: [R; 3] = coarse.index.into();
    let alone = [index[axis], zero, zero];
    Cell { index: alone.into(), octave: interval_word(axis, octave) }
}

/// Along which axes a cell takes its finer octave: chosen by the hash of the axis's interval.
#[inline(always)]
fn takes_fine<R: Real>(hash: &impl Hash<R>, coarse: &Cell<R>, scales: &Scales<R>) -> [bool; 3] {
    let [x, y, z] = scales.octave;
    let intervals = [interval(coarse, 0, x), interval(coarse, 1, y), interval(coarse, 2, z)];
    let ([x, y, z], [x_choice, y_choice, z_choice]) = (scales.fraction, hash.hash_all(intervals));
    [x > x_choice, y > y_choice, z > z_choice]
}

/// The word of such an interval.
#[inline(always)]
pub(in crate::threshold) fn interval_word(axis: usize, octave: i32) -> u32 {
    CHOICE_OF_AXIS[axis] ^ octave as u32
}

/// Mixes the corners of the box of octaves by trilinear weights, as normal quantiles of unit variance.
#[inline(always)]
fn trilinear<R: Real>(fraction: [R; 3], hashes: [R; 8]) -> R {
    let (one, [x, y, z]) = (R::from_f64(1.0), fraction);
    let shares = [[one - x, x], [one - y, y], [one - z, z]];
    // A loop of its own, which the compiler turns into vector instructions.
    let mut quantiles = hashes;
    for quantile in &mut quantiles {
        *quantile = quantile.normal_quantile();
    }
    let mut sum = R::from_f64(0.0);
    for (corner, quantile) in quantiles.into_iter().enumerate() {
        let weight = shares[0][corner & 1] * shares[1][corner >> 1 & 1] * shares[2][corner >> 2 & 1];
        sum = sum + weight * quantile;
    }
    sum / (variance_along(x) * variance_along(y) * variance_along(z)).sqrt()
}

/// Mixes two hashes as normal quantiles of unit variance.
#[inline(always)]
fn linear<R: Real>(weight: R, [coarse, fine]: [R; 2]) -> R {
    let sum = (R::from_f64(1.0) - weight) * coarse.normal_quantile() + weight * fine.normal_quantile();
    sum / variance_along(weight).sqrt()
}

/// The variance of two independent values of unit variance that are mixed by a weight and its rest. That of trilinear
/// weights is the product over their axes.
#[inline(always)]
pub(in crate::threshold) fn variance_along<R: Real>(weight: R) -> R {
    let rest = R::from_f64(1.0) - weight;
    rest * rest + weight * weight
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pairs of values from a grid, mixed at many weights: the law is uniform within the grid's own step at each.
    #[test]
    fn the_copula_is_uniform_at_every_weight() {
        const SIDE: u32 = 256;
        let grid = |k: u32| (k as f32 + 0.5) / SIDE as f32;
        for weight in (0..=64).map(|i| i as f32 / 64.0) {
            let pairs = (0..SIDE).flat_map(|a| (0..SIDE).map(move |b| [grid(a), grid(b)]));
            let mut thresholds: Vec<f32> = pairs.map(|pair| linear(weight, pair).normal_cdf()).collect();
            thresholds.sort_unstable_by(f32::total_cmp);
            let count = thresholds.len() as f32;
            let farthest = thresholds
                .iter()
                .enumerate()
                .map(|(rank, threshold)| (rank as f32 / count - threshold).abs())
                .fold(0.0, f32::max);
            assert!(farthest < 1.0 / SIDE as f32, "{weight}: {farthest}");
        }
    }
}
