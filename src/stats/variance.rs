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
