//! Counts of independent events with unequal probabilities.

use super::normal;

/// Smallest variance at which the normal law is used at all.
const LEAST_VARIANCE: f64 = 100.0;

/// Holds the judgement of a count of independent events against the sum of their probabilities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoissonBinomial {
    /// Standard score: (observed - mean) / sqrt(variance). Infinite if the variance is 0 and the count is
    /// off.
    pub z: f64,
    /// Two-sided p-value, or an upper bound of it.
    pub p: f64,
    /// Tells whether [`p`](Self::p) is Bennett's bound; otherwise it comes from the normal law.
    pub is_bound: bool,
}

/// Tests the number of events that happened among independent ones of probabilities p₁, p₂, ...
///
/// `mean` is Σpᵢ, `variance` is Σpᵢ(1-pᵢ). Where the variance σ² is at least 100 and |z|³ <= σ, p comes from
/// the normal law, half an event nearer to the mean because a count is whole: the skewness of such a sum is at
/// most 1/σ, which changes a tail by a factor of no more than about exp((|z|³/6 + 1/2)/σ) < 1.24. Everywhere
/// else p is Bennett's bound 2 exp(-σ² h(|x-mean|/σ²)) with h(u) = (1+u) ln(1+u) - u: it holds for every sum of
/// this kind, however small or skewed, and is conservative by a factor of about 2.5 |z|. A level of 1e-9 is judged by the normal law from σ² = 52 000 on.
///
/// Source: Bennett 1962, J. Am. Statist. Assoc. 57.
///
/// # Panics
/// If `mean` or `variance` is negative or not finite.
#[must_use]
pub fn sum_of_events(observed: u64, mean: f64, variance: f64) -> PoissonBinomial {
    assert!(mean >= 0.0 && mean.is_finite(), "mean {mean} of a count");
    assert!(variance >= 0.0 && variance.is_finite(), "variance {variance} of a count");
    let excess = observed as f64 - mean;
    if variance == 0.0 {
        // Every event is certain or impossible; half an event allows for the rounding of the sum.
        return if excess.abs() < 0.5 {
            PoissonBinomial { z: 0.0, p: 1.0, is_bound: true }
        } else {
            PoissonBinomial { z: excess.signum() * f64::INFINITY, p: 0.0, is_bound: true }
        };
    }
    let sigma = variance.sqrt();
    let z = excess / sigma;
    if variance >= LEAST_VARIANCE && z.abs().powi(3) <= sigma {
        let p = normal::two_sided_p((excess.abs() - 0.5).max(0.0) / sigma);
        return PoissonBinomial { z, p, is_bound: false };
    }
    let u = excess.abs() / variance;
    let h = (1.0 + u) * libm::log1p(u) - u;
    PoissonBinomial { z, p: (2.0 * libm::exp(-variance * h)).min(1.0), is_bound: true }
}
