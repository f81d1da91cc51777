//! The paper's second hash (§9).

use super::cell::{Cell, Hash};
use super::listed::{Listed, OfBlocks};
use super::sine::{coordinates, hash_2d, hash_2d_all, hash_2d_by};
use crate::threshold::batch::block::Block;
use crate::threshold::batch::lane::Kernel;
use crate::threshold::real::Real;

/// Hashes three coordinates by hashing the first with the hash of the last two (chi_2 of §9).
///
/// Domain and range are those of [`hash_2d`].
#[must_use]
pub fn hash_3d_chi_2<R: Real>(coordinates: R::Vec3) -> R {
    let [x, y, z] = coordinates.into();
    hash_2d(x, hash_2d(y, z))
}

/// [`hash_3d_chi_2`] of the cell's coordinates; does not read the octave.
#[derive(Clone, Copy, Debug, Default)]
pub struct SineChi2;

impl<R: Real> Hash<R> for SineChi2 {
    fn hash(&self, cell: &Cell<R>) -> R {
        let [hash] = self.hash_all([*cell]);
        hash
    }

    #[inline(always)]
    fn hash_all<const N: usize>(&self, cells: [Cell<R>; N]) -> [R; N] {
        let [x, y, z] = coordinates(cells);
        hash_2d_all(x, hash_2d_all(y, z))
    }
}

impl OfBlocks for SineChi2 {
    const ASKS_SINE: bool = true;

    #[inline(always)]
    fn block<R: Kernel, const FUSED: bool>(
        sine: impl Fn(R) -> R + Copy,
        [x, y, z]: [&Block<R>; 3],
        _: &Block<u32>,
        out: &mut Block<R>,
    ) {
        for i in 0..out.len() {
            [out[i]] = hash_2d_by(|[angle]| [sine(angle)], R::lane_fract::<FUSED>, [y[i]], [z[i]]);
        }
        for i in 0..out.len() {
            [out[i]] = hash_2d_by(|[angle]| [sine(angle)], R::lane_fract::<FUSED>, [x[i]], [out[i]]);
        }
    }
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "sine-chi2",
    reads_octave: false,
    is_exact: false,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/hash/sine.wgsl"),
        include_str!("../../shader/chunk/hash_cell/sine_chi_2.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["floor(product)", "trunc(product)"],
};
