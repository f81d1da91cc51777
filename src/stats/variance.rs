//! Variances of normal values: against a given one, and against each other.
//!
//! The laws are those of normal values. A mean of many nearly independent events is close to normal; what is
//! left of its excess kurtosis κ multiplies the variance of a sample variance by 1 + κ/2. A two-sided p-value
//! of 1e-9 then keeps its order of magnitude while |κ| is below .05.

use super::{StatsError, Tails, beta, chi_square};

/// Holds the mean and the variance of a sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Variance {
    /// Mean of the values.
    pub mean: f64,
    /// Sum of the squared distances from the mean, divided by [`dof`](Self::dof); an unbiased estimate.
    pub variance: f64,
    /// Degrees of freedom: one less than there are values.
    pub dof: u64,
}

impl Variance {
    /// Measures a sample.
    ///
    /// # Errors
    /// [`StatsError::Empty`] for fewer than 2 values, [`StatsError::NotFinite`] for NaN and infinities.
    pub fn of(values: &[f64]) -> Result<Self, StatsError> {
        if values.len() < 2 {
            return Err(StatsError::Empty);
        }
        if let Some(&value) = values.iter().find(|x| !x.is_finite()) {
            return Err(StatsError::NotFinite { value });
        }
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let dof = values.len() as u64 - 1;
        let variance = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / dof as f64;
        Ok(Self { mean, variance, dof })
    }

    /// Judges the variance if the true one is `expected`: dof s²/σ² is chi-square distributed.
    ///
    /// # Panics
    /// If `expected` is not above 0, or `dof` is 0.
    #[must_use]
    pub fn against(self, expected: f64) -> Tails {
        assert!(expected > 0.0, "variance {expected}");
        chi_square::tails(self.dof as f64 * self.variance / expected, self.dof)
    }

    /// Gives the two-sided p-value of the mean if the true one is `expected`, by Student's law.
    ///
    /// The exact test of a mean from independent replicas whose spread is only known from themselves.
    ///
    /// # Panics
    /// If the variance is 0 and the mean is `expected`, or `dof` is 0.
    #[must_use]
    pub fn mean_p(self, expected: f64) -> f64 {
        let standard_error = (self.variance / (self.dof + 1) as f64).sqrt();
        beta::student_two_sided_p((self.mean - expected) / standard_error, self.dof)
    }
}

#[cfg(test)]
mod tests {
    use super::super::calibration::{assert_close, assert_uniform_p};
    use super::super::normal;
    use super::super::seed::{rng, uniform01};
    use super::*;
    use rand::Rng;

    fn sample(n: usize, sigma: f64, rng: &mut impl Rng) -> Variance {
        let values: Vec<f64> = (0..n).map(|_| sigma * normal::quantile(uniform01(rng).max(1e-300))).collect();
        Variance::of(&values).unwrap()
    }

    /// scipy.stats: chi2 and ttest_1samp.
    #[test]
    fn the_statistics_match_a_reference() {
        let v = Variance::of(&[1.0, 2.0, 4.0, 8.0]).unwrap();
        assert_eq!((v.mean, v.dof), (3.75, 3));
        assert_close(v.variance, 9.583333333333334, 1e-15);
        assert_close(v.against(2.0).upper, 0.0024367052227767996, 1e-13);
        assert_close(v.against(2.0).lower, 0.9975632947772232, 1e-13);
        assert_close(v.mean_p(1.0), 0.17369950650853067, 1e-13);
    }

    #[test]
    fn too_little_is_refused() {
        assert_eq!(Variance::of(&[1.0]), Err(StatsError::Empty));
        assert!(Variance::of(&[1.0, f64::NAN]).is_err());
    }

    #[test]
    fn p_is_uniform_on_an_ideal_source() {
        assert_uniform_p("stats.variance.against", |rng| sample(20, 3.0, rng).against(9.0).two_sided_p());
        assert_uniform_p("stats.variance.mean_p", |rng| sample(5, 3.0, rng).mean_p(0.0));
    }

    /// A standard deviation a tenth too small, and one too large; a mean off by a fifth of it.
    #[test]
    fn broken_sources_are_rejected() {
        let mut rng = rng("stats.variance.broken", 0);
        let v = sample(4000, 0.9, &mut rng);
        assert!(v.against(1.0).lower < 1e-9 && v.against(0.81).two_sided_p() > 1e-4);
        assert!(v.mean_p(0.2) < 1e-9);
    }
}
