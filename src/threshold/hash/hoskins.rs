//! D. Hoskins's "Hash without Sine" of three coordinates (`hash13`, Shadertoy 4djSRW, 2014, with the numbers of its present version;
//! an earlier one is in Jarzynski & Olano 2020). Not in the paper.

use super::listed::Listed;
use super::reals::real_hash;
use crate::threshold::real::Real;

/// Returns the hash of three coordinates.
#[inline(always)]
pub(in crate::threshold) fn without_sine<R: Real>(fract: impl Fn(R) -> R, coordinates: [R; 3]) -> R {
    let [x, y, z] = coordinates.map(|c| fract(c * R::from_f64(0.1031)));
    let shift = R::from_f64(31.32);
    let product = x * (z + shift) + y * (y + shift) + z * (x + shift);
    fract((x + product + (y + product)) * (z + product))
}

real_hash! {
    /// The hash of the coordinates of a cell; does not read the octave.
    Hoskins, without_sine
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "hoskins",
    reads_octave: false,
    is_exact: false,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[include_str!("../../shader/chunk/hash_cell/hoskins.wgsl")],
    #[cfg(feature = "gpu")]
    mistake: ["0.1031", "0.0625"],
};

#[cfg(test)]
mod tests {
    use super::super::{Cell, Hash};
    use super::*;

    /// By a separate computation in Python, with exact fractions.
    #[test]
    fn it_gives_known_values() {
        for (index, expected) in [
            ([0.0, 0.0, 0.0], 0.000_000_000_000),
            ([1.0, 2.0, 3.0], 0.178_830_832_537),
            ([-7.0, 12.0, 100.0], 0.472_382_791_698),
            ([1000.0, -41.0, 5.0], 0.231_265_058_537),
        ] {
            let value = Hoskins.hash(&Cell::<f64> { index: index.into(), octave: 0 });
            assert!((value - expected).abs() < 1e-9, "{index:?}: {value}");
        }
    }
}
