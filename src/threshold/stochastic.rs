//! Stochastic alpha testing (§4): the threshold is a fresh random number in every fragment and frame.

use super::real::Real;

/// Makes a threshold of a fresh random word, uniform on [0, 1): `drand48()` of §4, 24 random bits in `f32` and `f64` alike.
///
/// It can be 0, and then keeps a fragment of alpha 0; the conference version says (0, 1] for that reason.
#[must_use]
pub fn stochastic<R: Real>(word: u32) -> R {
    R::from_f64(f64::from(word >> 8) * (1.0 / 16_777_216.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{Rng, SeedableRng, rngs::Xoshiro256PlusPlus};

    #[test]
    fn expected_visibility_is_alpha() {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(0x5ec4);
        let n = 100_000;
        let kept = (0..n)
            .filter(|_| crate::threshold::fixed::passes(0.3, stochastic::<f64>(rng.next_u32())))
            .count();
        let sigmas = (kept as f64 - 0.3 * f64::from(n)) / (0.21 * f64::from(n)).sqrt();
        assert!(sigmas.abs() < 5.0, "{sigmas}");
    }
}
