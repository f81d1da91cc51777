//! How fine the values are that a subject gives: a threshold that is stored in few bits changes in steps.

/// Binades that are told apart: down to the smallest threshold of `f32` noise, 2^-24 and below.
const BINADES: usize = 32;

/// The coarsest step that is excused: eight bits. What is coarser is judged as if it had none.
const COARSEST: f64 = 1.0 / 256.0;

/// Values that are looked at: with a million, the gaps of a continuous law are near 2^-40.
const VALUES: usize = 1 << 20;

/// The smallest difference between values of each binade, of the values between 1/2 and 1 first: that of a half float
/// shrinks with the value, that of a fixed number of bits does not.
#[derive(Clone, Debug, Default)]
pub(crate) struct Resolution {
    values: Vec<f64>,
}

impl Resolution {
    /// Takes note of values, as long as there are not enough.
    pub fn extend(&mut self, values: &[f64]) {
        let room = VALUES.saturating_sub(self.values.len());
        self.values.extend(values.iter().take(room));
    }

    /// The steps that were found: for two values, the larger step at either.
    pub fn steps(mut self) -> impl Fn([f64; 2]) -> f64 {
        self.values.sort_unstable_by(f64::total_cmp);
        self.values.dedup();
        let mut steps = [f64::INFINITY; BINADES];
        for pair in self.values.windows(2) {
            // The step up to a power of two is one of the binade below.
            let step = &mut steps[binade(pair[0])];
            *step = step.min(pair[1] - pair[0]);
        }
        let steps = steps.map(|step| if step <= COARSEST { step } else { 0.0 });
        move |values| values.map(|value| steps[binade(value)]).into_iter().fold(0.0, f64::max)
    }
}

fn binade(value: f64) -> usize {
    let (_, exponent) = libm::frexp(value.abs());
    (-exponent).clamp(0, BINADES as i32 - 1) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::seed::{rng, uniform01};

    fn steps_of(rounded: impl Fn(f64) -> f64) -> impl Fn([f64; 2]) -> f64 {
        let mut rng = rng("judge.resolution", 0);
        let values: Vec<f64> = (0..100_000).map(|_| rounded(uniform01(&mut rng))).collect();
        let mut resolution = Resolution::default();
        resolution.extend(&values);
        resolution.steps()
    }

    #[test]
    fn steps_are_those_of_the_format() {
        let fixed = steps_of(|x| (x * 65_536.0).round() / 65_536.0);
        assert_eq!(fixed([0.9, 0.2]), 1.0 / 65_536.0);
        let half = steps_of(|x| {
            let (mantissa, exponent) = libm::frexp(x);
            libm::ldexp((mantissa * 2048.0).round() / 2048.0, exponent)
        });
        assert_eq!([half([0.9, 0.2]), half([0.2, 0.15])], [1.0 / 2048.0, 1.0 / 8192.0]);
        assert!(steps_of(|x| x)([0.9, 0.8]) < 1.0e-8);
        assert_eq!(steps_of(|x| (x * 100.0).round() / 100.0)([0.9, 0.2]), 0.0);
    }
}
