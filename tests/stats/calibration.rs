//! The test of tests: on an ideal source p-values are uniform.

use hashed_alpha::stats::ecdf;
use rand::TryRng;
use sha2::{Digest, Sha256};
use siphasher::sip::SipHasher24;
use std::convert::Infallible;

/// Replicas of each test.
const REPLICAS: u32 = 1000;
/// Chance that a correct test fails its calibration; met by the Kolmogorov-Smirnov distance .0704.
const LEVEL: f64 = 1e-4;
/// Most p-values below 1e-3 that are believed; the Poisson law of mean 1 exceeds it with probability 1e-7.
const MOST_SMALL: usize = 9;

/// The ideal source: SipHash-2-4 of a counter, under a key that is made from a name.
///
/// A fast generator may share its structure with a statistic; a keyed cryptographic function does not.
pub struct Ideal {
    keyed: SipHasher24,
    counter: u64,
}

impl Ideal {
    fn new(name: &str) -> Self {
        let digest: [u8; 32] = Sha256::digest(name.as_bytes()).into();
        let mut key = [0; 16];
        key.copy_from_slice(&digest[..16]);
        Self { keyed: SipHasher24::new_with_key(&key), counter: 0 }
    }
}

impl TryRng for Ideal {
    type Error = Infallible;

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        self.counter += 1;
        Ok(self.keyed.hash(&self.counter.to_le_bytes()))
    }

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        Ok((self.try_next_u64()? >> 32) as u32)
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        for chunk in bytes.chunks_mut(8) {
            chunk.copy_from_slice(&self.try_next_u64()?.to_le_bytes()[..chunk.len()]);
        }
        Ok(())
    }
}

/// The ideal source that belongs to a name.
pub fn ideal(name: &str) -> Ideal {
    Ideal::new(name)
}

/// Asserts that a thousand p-values are uniform, and that not too many are below 1e-3.
///
/// `replica` gets the ideal source that belongs to `name` and returns one p-value. To be asked only of laws that
/// are exact, or so nearly that a thousand replicas cannot tell.
pub fn assert_uniform_p(name: &str, mut replica: impl FnMut(&mut Ideal) -> f64) {
    let mut source = Ideal::new(name);
    let mut p: Vec<f64> = (0..REPLICAS).map(|_| replica(&mut source)).collect();
    let small = p.iter().filter(|&&p| p < 1e-3).count();
    assert!(small <= MOST_SMALL, "{name}: {small} of {REPLICAS} p-values are below 1e-3");
    let ks = ecdf::kolmogorov_smirnov(&mut p).expect("p-values are probabilities");
    let most = ecdf::dkwm_distance(ks.n, LEVEL);
    assert!(ks.d < most, "{name}: p-values are off uniform by {}, more than {most}", ks.d);
}

/// Asserts that two numbers agree within a relative error.
pub fn assert_close(actual: f64, expected: f64, relative: f64) {
    let error = (actual - expected).abs();
    assert!(
        error <= relative * expected.abs(),
        "{actual:e} is not {expected:e}: relative error {:e}, allowed {relative:e}",
        error / expected.abs()
    );
}

/// The test of the test of tests: p-values that are only a little too small, or not uniform, are refused.
mod tests {
    use super::*;
    use hashed_alpha::stats::seed::uniform01;

    #[test]
    #[should_panic(expected = "off uniform")]
    fn p_values_that_are_too_small_are_refused() {
        assert_uniform_p("stats.calibration.small", |rng| libm::pow(uniform01(rng), 1.3));
    }

    #[test]
    #[should_panic(expected = "below 1e-3")]
    fn a_heavy_tail_is_refused() {
        assert_uniform_p("stats.calibration.tail", |rng| {
            let p = uniform01(rng);
            if p < 0.02 { p * 0.02 } else { p }
        });
    }

    /// The test vector of the reference implementation for the 8 bytes 0 to 7.
    #[test]
    fn the_source_is_siphash() {
        let key: [u8; 16] = std::array::from_fn(|i| i as u8);
        let bytes: [u8; 8] = std::array::from_fn(|i| i as u8);
        assert_eq!(SipHasher24::new_with_key(&key).hash(&bytes), 0x93f5_f579_9a93_2462);
    }
}
