//! Interleaved gradient noise (J. Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014) of x and y,
//! each moved by z as frames move it. A regular pattern, good on a screen and under a filter: it is here as what no claim of
//! independence may accept. Not in the paper.

use super::listed::Listed;
use super::reals::real_hash;
use crate::threshold::real::Real;

/// Returns the noise at a pixel, here x and y, of a frame, here z.
#[inline(always)]
pub(in crate::threshold) fn gradient_noise<R: Real>(fract: impl Fn(R) -> R, [x, y, z]: [R; 3]) -> R {
    let constant = R::from_f64;
    let shift = constant(5.588_238) * z;
    let slope = constant(0.067_110_56) * (x + shift) + constant(0.005_837_15) * (y + shift);
    fract(constant(52.982_918_9) * fract(slope))
}

real_hash! {
    /// The noise of the coordinates of a cell; does not read the octave.
    InterleavedGradient, gradient_noise
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "interleaved-gradient",
    reads_octave: false,
    is_exact: false,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[include_str!("../../shader/chunk/hash_cell/interleaved_gradient.wgsl")],
    #[cfg(feature = "gpu")]
    mistake: ["52.9829189", "0.529829189"],
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
            ([1.0, 2.0, 3.0], 0.986_660_900_031),
            ([-7.0, 12.0, 100.0], 0.348_746_506_096),
            ([1000.0, -41.0, 5.0], 0.187_046_819_747),
        ] {
            let value = InterleavedGradient.hash(&Cell::<f64> { index: index.into(), octave: 0 });
            assert!((value - expected).abs() < 1e-9, "{index:?}: {value}");
        }
    }
}
