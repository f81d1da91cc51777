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

#[cfg(test)]
mod tests {
    use super::super::binomial;
    use super::super::calibration::assert_uniform_p;
    use super::super::seed::{rng, uniform01};
    use super::*;

    #[test]
    fn p_is_uniform_on_an_ideal_source() {
        // Probabilities i/20000: mean about 9999.5, variance about 3333.
        let (mean, variance) = (0..20_000)
            .map(|i| f64::from(i) / 20_000.0)
            .fold((0.0, 0.0), |(m, v), p| (m + p, v + p * (1.0 - p)));
        assert_uniform_p("stats.poisson_binomial", |rng| {
            let count = (0..20_000).filter(|&i| uniform01(rng) < f64::from(i) / 20_000.0).count();
            sum_of_events(count as u64, mean, variance).p
        });
    }

    /// Events of equal probability have an exact law to compare with.
    #[test]
    fn p_is_near_the_exact_one_or_above_it() {
        for (n, q) in [(20_u64, 0.5), (1000, 0.3), (1000, 0.001), (100_000, 0.01), (1_000_000, 0.4)] {
            let (mean, variance) = (n as f64 * q, n as f64 * q * (1.0 - q));
            for step in 0..40 {
                let count = (mean + f64::from(step - 20) / 2.5 * variance.sqrt()).round();
                if count < 0.0 || count > n as f64 {
                    continue;
                }
                let exact = binomial::two_sided_p(count as u64, n, q);
                let ours = sum_of_events(count as u64, mean, variance);
                if ours.is_bound {
                    assert!(
                        ours.p >= exact * (1.0 - 1e-9),
                        "n {n} q {q} count {count}: {} < {exact}",
                        ours.p
                    );
                } else {
                    // The skewness moves the middle, too.
                    let slack = (ours.z.abs().powi(3) / 6.0 + 0.5) / variance.sqrt();
                    assert!(
                        libm::log(ours.p / exact).abs() < slack,
                        "n {n} q {q} count {count}: {} {exact}",
                        ours.p
                    );
                }
            }
        }
    }

    /// Events of probabilities (i/1000)², whose law is convolved.
    #[test]
    fn unequal_events_keep_to_the_exact_law() {
        let probabilities = (0..1000).map(|i| (f64::from(i) / 1000.0).powi(2));
        let mut law = vec![1.0];
        for q in probabilities.clone() {
            law.push(0.0);
            for count in (0..law.len()).rev() {
                law[count] = law[count] * (1.0 - q) + if count > 0 { law[count - 1] * q } else { 0.0 };
            }
        }
        let mean: f64 = probabilities.clone().sum();
        let variance: f64 = probabilities.map(|q| q * (1.0 - q)).sum();
        for observed in 290..=380 {
            let tails = [&law[..=observed], &law[observed..]].map(|tail| tail.iter().sum::<f64>());
            let exact = (2.0 * tails[0].min(tails[1])).min(1.0);
            let ours = sum_of_events(observed as u64, mean, variance);
            let slack = (ours.z.abs().powi(3) / 6.0 + 0.5) / variance.sqrt();
            let is_kept =
                if ours.is_bound { ours.p >= exact } else { libm::log(ours.p / exact).abs() < slack };
            assert!(is_kept, "{observed}: {} {exact}", ours.p);
        }
    }

    #[test]
    fn certain_events_leave_no_choice() {
        assert_eq!(sum_of_events(5, 5.000_000_1, 0.0).p, 1.0);
        assert_eq!(
            sum_of_events(4, 5.0, 0.0),
            PoissonBinomial { z: f64::NEG_INFINITY, p: 0.0, is_bound: true }
        );
    }

    /// All probabilities are one hundredth too high.
    #[test]
    fn a_biased_source_is_rejected() {
        let mut rng = rng("stats.poisson_binomial.biased", 0);
        let (mut count, mut mean, mut variance) = (0, 0.0, 0.0);
        for _ in 0..200_000 {
            let p = 0.9 * uniform01(&mut rng);
            mean += p;
            variance += p * (1.0 - p);
            count += u64::from(uniform01(&mut rng) < p + 0.01);
        }
        assert!(sum_of_events(count, mean, variance).p < 1e-9);
    }
}
