//! Do three values satisfy a linear relation? All forms with small whole coefficients, modulo 1, at once.
//!
//! Values in `[0, 1)` are cut to [`LEVELS`] equal levels and triples of them are counted. The Fourier transform of the counts
//! at (a, b, c) is S, the sum of exp(-2 pi i (a x + b y + c z)) over the triples. Where the form is a constant modulo 1, |S| is as large as
//! their number but for the levels, which take 6 % for a coefficient of [`COEFFICIENT`].
//!
//! **The law.** Take triples (h(p), h(p + d), h(p + e)) of a field with independent values, uniform on the levels, at all p
//! of a box, and let 0 < d < e in the order in which places are counted. If the first or the last coefficient
//! is odd, the forms of all triples are independent and uniform on the levels, however much the triples overlap: each has one
//! value that no earlier one (or no later one) had, times a unit. |S|^2 / n is then exponential of mean 1, its tail no heavier.

use super::StatsError;
use super::transform::{opposite, place, signed, transform};
use rustfft::num_complex::Complex64;
use rustfft::{FftDirection, FftPlanner};

/// Levels to which a value is cut: a power of two, so that odd numbers are units and lattices of 2^6 or more points fill all
/// levels alike.
pub const LEVELS: usize = 64;

/// Largest coefficient: 9 h(c) - 6 h(c + 1) + h(c + 2) is the relation of RANDU.
pub const COEFFICIENT: i64 = 12;

/// Holds the form that stands out most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorstForm {
    /// The coefficients of the three values.
    pub coefficients: [i64; 3],
    /// Length of the mean phase of the form, in `[0, 1]`.
    pub strength: f64,
    /// Probability of as much in this form.
    pub p: f64,
    /// Forms that were looked at: `p` times this is the p-value of the triples.
    pub tests: u64,
    /// Number of triples.
    pub n: u64,
}

/// Finds the form of two or three values whose fraction is least uniform. The law is that of the [module](self).
///
/// # Errors
/// [`StatsError::Empty`] without triples.
pub fn worst_form(triples: impl IntoIterator<Item = [f64; 3]>) -> Result<WorstForm, StatsError> {
    let size = [LEVELS; 3];
    let mut counts = vec![Complex64::ZERO; LEVELS * LEVELS * LEVELS];
    let mut n = 0;
    for triple in triples {
        let [x, y, z] = triple.map(|value| ((value * LEVELS as f64) as usize).min(LEVELS - 1));
        counts[x + LEVELS * (y + LEVELS * z)].re += 1.0;
        n += 1;
    }
    if n == 0 {
        return Err(StatsError::Empty);
    }
    let sums = transform(counts, size, FftDirection::Forward, &mut FftPlanner::new());
    let (mut tests, mut worst) = (0, (0, -1.0));
    for (at, sum) in sums.iter().enumerate() {
        let form = place(at, size).map(|index| signed(index, LEVELS));
        let is_small = form.iter().all(|coefficient| coefficient.abs() <= COEFFICIENT);
        let is_joint = form.iter().filter(|coefficient| **coefficient != 0).count() >= 2;
        let has_unit = form[0] & 1 == 1 || form[2] & 1 == 1;
        // Of a form and its negative one is enough.
        if is_small && is_joint && has_unit && at < opposite(at, size) {
            tests += 1;
            if sum.norm_sqr() > worst.1 {
                worst = (at, sum.norm_sqr());
            }
        }
    }
    let (at, square) = worst;
    Ok(WorstForm {
        coefficients: place(at, size).map(|index| signed(index, LEVELS)),
        strength: square.sqrt() / n as f64,
        p: libm::exp(-square / n as f64),
        tests,
        n,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::seed;

    /// The triples of a row, which overlap.
    fn of_row(row: &[f64]) -> Vec<[f64; 3]> {
        row.windows(3).map(|window| [window[0], window[1], window[2]]).collect()
    }

    fn uniform(seed: u64, n: usize) -> Vec<f64> {
        let mut rng = seed::rng("forms.tests", seed);
        (0..n).map(|_| seed::uniform01(&mut rng)).collect()
    }

    #[test]
    fn randu_is_found_by_its_relation() {
        let mut state = 1_u64;
        let row: Vec<f64> = (0..5000)
            .map(|_| {
                state = state * 65_539 % (1 << 31);
                state as f64 / f64::from(1_u32 << 31)
            })
            .collect();
        let found = worst_form(of_row(&row)).unwrap();
        assert!(found.strength > 0.9 && found.p < 1e-300, "{found:?}");
        assert!([[9, -6, 1], [-9, 6, -1]].contains(&found.coefficients), "{found:?}");
    }

    #[test]
    fn independent_values_are_calibrated() {
        let p = |seed: u64| {
            let found = worst_form(of_row(&uniform(seed, 4096))).unwrap();
            found.p * found.tests as f64
        };
        let below = (0..40).filter(|&seed| p(seed) < 0.1).count();
        assert!(below <= 12, "{below} of 40");
        assert_eq!(worst_form([]), Err(StatsError::Empty));
    }
}
