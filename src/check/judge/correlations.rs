//! A correlation that should be zero.

use crate::check::tolerance::{POWER, SINGLE_LEVEL};
use crate::check::{Conclusion, Trial};
use crate::stats::correlation::Correlation;
use crate::stats::power;

/// A trial that rests on the worst of several correlations.
pub(crate) fn uncorrelated(worst: &Correlation, of: usize, seen: String) -> Trial {
    let tests = of as f64;
    let sigma = 1.0 / (worst.n as f64 - 1.0).sqrt();
    Trial {
        statistic: Some(worst.z),
        statistic_name: format!("z of the correlation, worst of {tests}"),
        n: worst.n,
        effect: Some(worst.r.abs()),
        effect_name: "correlation",
        detectable: Some(power::detectable_shift_z(sigma, SINGLE_LEVEL / tests, POWER)),
        ..Trial::without(Conclusion::Probability((tests * worst.p).min(1.0)), seen)
    }
}
