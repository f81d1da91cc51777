//! How the hashes of neighbouring octaves become one threshold.
//!
//! | join | hashes (isotropic, anisotropic) | uniform | under zoom |
//! |---|---|---|---|
//! | [`Join::Interpolate`] | 2, 2 | by Eq. 2 | continuous; with one scale an axis it jumps at every octave of an axis |
//! | [`Join::Copula`] | 2, 8 | for any weights | continuous |
//! | [`Join::Dithered`] | 2 of 3, 1 and 3 of one dimension | by construction | each cell switches once an octave; with one scale an axis, each slab of cells |

use super::repairs::{Repair, Repairs};
use super::scales::{Scales, corner_weight, nested_cell};
use crate::threshold::cdf::{cdf, cdf_literal};
use crate::threshold::choice::{UnknownName, by_name};
use crate::threshold::hash::{Cell, Hash};
use crate::threshold::normal::{normal_cdf, normal_quantile};
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
    /// One of the two hashes, chosen by a third hash of the coarse cell: no mixture and no CDF, and as few changes of
    /// visibility under zoom as any join can have. Not in the paper.
    Dithered,
}

impl Join {
    /// Every join, in the order in which they are listed to users.
    pub const ALL: [Self; 3] = [Self::Interpolate, Self::Copula, Self::Dithered];

    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Interpolate => "interpolate",
            Self::Copula => "copula",
            Self::Dithered => "dithered",
        }
    }

    /// The number of hashes of one threshold, by how scales come from derivatives.
    #[must_use]
    pub const fn hashes(self, variant: Variant) -> u64 {
        match (self, variant) {
            (Self::Copula, Variant::Anisotropic) => 8,
            (Self::Dithered, Variant::Anisotropic) => 4,
            (Self::Interpolate | Self::Copula | Self::Dithered, _) => 2,
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
    /// Hash of the cell that is coarse along every axis.
    pub hash_coarse: R,
    /// Hash of the cell that is fine along every axis.
    pub hash_fine: R,
    /// The mixture before it is made uniform; the threshold itself for the dithered join.
    pub interpolated: R,
    /// The threshold before the last clamp.
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
) -> Joined<R> {
    let coarse = nested_cell(position, scales.octave, repairs);
    let fine = nested_cell(position, scales.next_octave, repairs);
    let (hash_coarse, hash_fine) = (hash.hash(&coarse), hash.hash(&fine));
    let anisotropic = variant == Variant::Anisotropic;
    let (lerp_factor, interpolated, uniform) = match join {
        Join::Interpolate => {
            let weight = if anisotropic { corner_weight(scales.fraction) } else { scales.fraction[0] };
            let (mixture, uniform) = interpolated(hash_coarse, hash_fine, weight, repairs);
            ([weight; 3], mixture, uniform)
        }
        Join::Copula => {
            let normal = if anisotropic {
                let corner = |fine: [bool; 3]| {
                    let octave = [0, 1, 2]
                        .map(|axis| if fine[axis] { scales.next_octave[axis] } else { scales.octave[axis] });
                    hash.hash(&nested_cell(position, octave, repairs))
                };
                trilinear(scales.fraction.map(R::to_f64), hash_coarse, hash_fine, corner)
            } else {
                let weight = scales.fraction[0].to_f64();
                normal_mixture([(1.0 - weight, hash_coarse), (weight, hash_fine)])
            };
            (scales.fraction, R::from_f64(normal), R::from_f64(normal_cdf(normal)))
        }
        Join::Dithered => {
            let octave = if anisotropic {
                [0, 1, 2].map(|axis| {
                    let takes_fine =
                        takes_fine(hash, &coarse, axis, scales.octave[axis], scales.fraction[axis]);
                    if takes_fine { scales.next_octave[axis] } else { scales.octave[axis] }
                })
            } else {
                let choice = hash.hash(&Cell { octave: coarse.octave ^ CHOICE, ..coarse });
                if scales.fraction[0] > choice { scales.next_octave } else { scales.octave }
            };
            let chosen = hash.hash(&nested_cell(position, octave, repairs));
            (scales.fraction, chosen, chosen)
        }
    };
    Joined { lerp_factor, hash_coarse, hash_fine, interpolated, uniform }
}

/// Mixes two hashes, and makes the mixture uniform by Eq. 2.
#[inline(always)]
fn interpolated<R: Real>(coarse: R, fine: R, weight: R, repairs: Repairs) -> (R, R) {
    let mixture = (R::from_f64(1.0) - weight) * coarse + weight * fine;
    let law = if repairs.contains(Repair::StableCdf) { cdf } else { cdf_literal };
    (mixture, law(mixture, weight))
}

/// Tells the words of the choosing hash from those of cells: bits of the root of 2, which no octave has. One bit would be
/// too few: PCG4D turns a difference in the highest alone into the same value half a unit away, in a quarter of the cells.
pub(in crate::threshold) const CHOICE: u32 = 0x6a09_e667;

/// The same for each axis that chooses alone: the roots of 3, 5 and 7.
const CHOICE_OF_AXIS: [u32; 3] = [0xbb67_ae85, 0x3c6e_f372, 0xa54f_f53a];

/// The one-dimensional cell by which an axis chooses its octave: its own interval and octave, nothing of the others.
#[inline(always)]
fn interval<R: Real>(coarse: &Cell<R>, axis: usize, octave: i32) -> Cell<R> {
    let zero = R::from_f64(0.0);
    let index: [R; 3] = coarse.index.into();
    let alone = [index[axis], zero, zero];
    Cell { index: alone.into(), octave: interval_word(axis, octave) }
}

/// Whether an axis takes its finer octave: chosen by the hash of its interval.
#[inline(always)]
fn takes_fine<R: Real>(hash: &impl Hash<R>, coarse: &Cell<R>, axis: usize, octave: i32, fraction: R) -> bool {
    fraction > hash.hash(&interval(coarse, axis, octave))
}

/// The word of such an interval.
#[inline(always)]
pub(in crate::threshold) fn interval_word(axis: usize, octave: i32) -> u32 {
    CHOICE_OF_AXIS[axis] ^ octave as u32
}

/// Mixes the corners of the box of octaves by trilinear weights, as normal quantiles of unit variance.
fn trilinear<R: Real>(fraction: [f64; 3], coarse: R, fine: R, corner: impl Fn([bool; 3]) -> R) -> f64 {
    normal_mixture((0..8_u32).map(|bits| {
        let is_fine = [0, 1, 2].map(|axis| bits >> axis & 1 == 1);
        let weight =
            (0..3).map(|axis| if is_fine[axis] { fraction[axis] } else { 1.0 - fraction[axis] }).product();
        let value = match bits {
            0 => coarse,
            7 => fine,
            _ => corner(is_fine),
        };
        (weight, value)
    }))
}

/// Keeps the quantile of a hash that can be 0 or 1 finite: half a step inside the open lattice.
pub(in crate::threshold) const EDGE: f64 = 1.0 / 33_554_432.0;

/// Mixes normal quantiles of uniform values by weights that add up to 1, and scales the sum to unit variance.
fn normal_mixture<R: Real>(terms: impl IntoIterator<Item = (f64, R)>) -> f64 {
    let (mut sum, mut variance) = (0.0, 0.0);
    for (weight, value) in terms {
        sum += weight * normal_quantile(value.to_f64().clamp(EDGE, 1.0 - EDGE));
        variance += weight * weight;
    }
    sum / variance.sqrt()
}
