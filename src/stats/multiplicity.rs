//! What a p-value is worth among many.

/// Adjusts p-values so that rejecting those at or below a level keeps the family-wise error rate at that
/// level.
///
/// Holm's step-down method: valid whatever the dependence between the tests. The result is in `[0, 1]`, in
/// the order of the input, and never smaller than the input. Source: Holm 1979, Scand. J. Statist. 6.
///
/// # Panics
/// If a p-value is NaN or not in `[0, 1]`.
#[must_use]
pub fn holm(p: &[f64]) -> Vec<f64> {
    for p in p {
        assert!((0.0..=1.0).contains(p), "{p} is not a p-value");
    }
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|&i, &j| p[i].total_cmp(&p[j]));
    let mut adjusted = vec![0.0; p.len()];
    let mut worst = 0.0_f64;
    for (rank, &i) in order.iter().enumerate() {
        worst = worst.max((p[i] * (p.len() - rank) as f64).min(1.0));
        adjusted[i] = worst;
    }
    adjusted
}

#[cfg(test)]
mod tests {
    use super::super::calibration::assert_close;
    use super::super::seed::{rng, uniform01};
    use super::*;

    /// R: p.adjust(c(.01, .04, .03, .005, .5), "holm").
    #[test]
    fn adjusted_values_match_the_definition() {
        let p = [0.01, 0.04, 0.03, 0.005, 0.5];
        for (actual, expected) in holm(&p).into_iter().zip([0.04, 0.09, 0.09, 0.025, 0.5]) {
            assert_close(actual, expected, 1e-14);
        }
        assert!(holm(&[]).is_empty());
        assert_eq!(holm(&[0.9, 0.8]), [1.0, 1.0]);
        assert_eq!(holm(&[1e-300; 2]), [2e-300; 2]);
    }

    /// 2000 families of 20 true hypotheses at level .05: 100 expected, 4.9 standard deviations allowed.
    #[test]
    fn holm_keeps_the_family_wise_error_rate() {
        let mut rng = rng("stats.multiplicity.holm", 0);
        let false_alarms = (0..2000)
            .filter(|_| {
                let p: Vec<f64> = (0..20).map(|_| uniform01(&mut rng)).collect();
                holm(&p).iter().any(|&p| p <= 0.05)
            })
            .count();
        assert!((52..148).contains(&false_alarms), "{false_alarms}");
    }

    #[test]
    #[should_panic(expected = "not a p-value")]
    fn nan_is_refused() {
        let _ = holm(&[0.5, f64::NAN]);
    }
}
