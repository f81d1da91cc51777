//! The test of tests: on an ideal source p-values are uniform.

use super::{ecdf, seed};
use rand::rngs::Xoshiro256PlusPlus;

/// Replicas of each test.
const REPLICAS: u32 = 1000;
/// Chance that a correct test fails its calibration; met by the Kolmogorov-Smirnov distance .0704.
const LEVEL: f64 = 1e-4;
/// Most p-values below 1e-3 that are believed; the Poisson law of mean 1 exceeds it with probability 1e-7.
const MOST_SMALL: usize = 9;

/// Asserts that a thousand p-values are uniform, and that not too many are below 1e-3.
///
/// `replica` gets a generator that is seeded by `name` and returns one p-value.
pub fn assert_uniform_p(name: &str, mut replica: impl FnMut(&mut Xoshiro256PlusPlus) -> f64) {
    let mut rng = seed::rng(name, 0);
    let mut p: Vec<f64> = (0..REPLICAS).map(|_| replica(&mut rng)).collect();
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
