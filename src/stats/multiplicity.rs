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
