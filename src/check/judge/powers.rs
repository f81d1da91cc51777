//! Powers of bands of a spectrum, for those that are predicted.

use crate::check::tolerance::POWER;
use crate::stats::Tails;

/// The relative change of a power that is seen at a level, either way: by the law of the ratio of what is measured to what
/// is predicted, of which a change multiplies every quantile.
pub(crate) fn detectable_change(law: impl Fn(f64) -> Tails, level: f64) -> f64 {
    let lowest = |p: f64| point(|ratio| law(ratio).lower < p);
    let highest = |p: f64| point(|ratio| law(ratio).upper > p);
    let stronger = highest(0.5 * level) / lowest(1.0 - POWER) - 1.0;
    let weaker = 1.0 - lowest(0.5 * level) / highest(1.0 - POWER);
    stronger.max(weaker)
}

/// The ratio up to which a predicate holds.
fn point(holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    while holds(high) {
        (low, high) = (high, 2.0 * high);
    }
    while high - low > 1e-9 * high {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::chi_square::ChiSquare;
    use crate::stats::normal;

    /// For many ordinates it is the sum of two normal quantiles; for few, what is stronger is harder to see.
    #[test]
    fn many_ordinates_are_normal() {
        let change =
            |dof: u64| detectable_change(|ratio| ChiSquare::new(dof as f64 * ratio, dof, 1).tails(), 1e-9);
        let dof = 4_000_000;
        let normal = (normal::quantile(POWER) - normal::quantile(0.5e-9)) * (2.0 / dof as f64).sqrt();
        assert!((change(dof) / normal - 1.0).abs() < 0.01, "{} {normal}", change(dof));
        let normal = normal * (dof as f64 / 400.0).sqrt();
        assert!(change(400) > 1.3 * normal, "{} {normal}", change(400));
    }
}
