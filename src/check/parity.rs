//! The judgement of a parity by law: two sides that share no value must share their distribution.

use super::tolerance::{BINS, SINGLE_LEVEL};
use crate::stats::StatsError;
use crate::stats::chi_square::{self, ChiSquare};
use crate::stats::histogram::Histogram;

/// Two independent samples and what speaks against their being one law, the uniform one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    /// The two samples against each other.
    pub two_sample: ChiSquare,
    /// The device's sample against U(0, 1).
    pub uniform: ChiSquare,
    /// How many values of the device are NaN or not in [0, 1].
    pub outside: u64,
}

impl Law {
    /// Compares a sample of a device with an independent one of Rust.
    ///
    /// # Errors
    ///
    /// Those of [`chi_square::two_sample`], for samples that are too small.
    pub fn of(device: &[f32], rust: &[f32]) -> Result<Self, StatsError> {
        let [device, rust] = [device, rust].map(|values| {
            let mut histogram = Histogram::new(BINS);
            histogram.extend(values.iter().copied().map(f64::from));
            histogram
        });
        Ok(Self {
            two_sample: chi_square::two_sample(device.counts(), rust.counts())?,
            uniform: chi_square::uniform(device.counts())?,
            outside: device.outside,
        })
    }

    /// Returns whether nothing speaks against it: no value outside, and neither test rejects at
    /// [`SINGLE_LEVEL`].
    #[must_use]
    pub fn holds(&self) -> bool {
        self.outside == 0 && self.two_sample.p.min(self.uniform.p) >= SINGLE_LEVEL
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::seed::{rng, uniform01};

    fn sample(name: &str, power: i32) -> Vec<f32> {
        let mut rng = rng(name, 0);
        (0..1 << 15).map(|_| uniform01(&mut rng).powi(power) as f32).collect()
    }

    #[test]
    fn two_uniform_samples_hold() {
        assert!(Law::of(&sample("parity.left", 1), &sample("parity.right", 1)).unwrap().holds());
    }

    #[test]
    fn another_law_another_sample_or_a_value_outside_do_not() {
        let (uniform, bent) = (sample("parity.left", 1), sample("parity.right", 2));
        assert!(!Law::of(&uniform, &bent).unwrap().holds());
        assert!(!Law::of(&bent, &uniform).unwrap().holds());
        let both_bent = Law::of(&sample("parity.left", 2), &bent).unwrap();
        assert!(both_bent.two_sample.p > SINGLE_LEVEL && !both_bent.holds());
        let mut outside = uniform.clone();
        outside[7] = f32::NAN;
        assert!(!Law::of(&outside, &sample("parity.right", 1)).unwrap().holds());
    }
}
