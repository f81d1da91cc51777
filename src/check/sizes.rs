//! How large the known failures of the listings are.
//!
//! The sizes are measured over several seeds and committed as `known_sizes.txt`: one line a claim, variant, precision, budget
//! and form, with mean and standard deviation of the effect over seeds, their number, and what the effect measures. `tests/paper.rs` writes
//! them.

use super::Budget;
use super::outcome::Outcome;

/// How many times as large as the listing's an effect may be: one a fifth larger is another failure.
pub(crate) const EXCESS: f64 = 1.2;

/// The same for what is left of the sine of arguments in the millions, which is each device's own.
pub(crate) const EXCESS_OF_A_SINE: f64 = 2.0;

/// Standard deviations by which an effect may be larger than the mean over seeds, where that is more than [`EXCESS`] has: of
/// five noisy effects a run, one in 2,500 runs is further away (Student, 15 dof).
const DEVIATIONS: f64 = 5.0;

const COMMITTED: &str = include_str!("known_sizes.txt");

/// The size of a listing's failure.
#[derive(Clone, Debug, PartialEq)]
pub struct Size {
    /// Mean of the effect over seeds.
    pub mean: f64,
    /// Standard deviation of the effect of one run.
    pub deviation: f64,
    /// What the effect measures.
    pub effect_name: String,
}

impl Size {
    /// Returns the sizes for the claim, variant and precision of an outcome, one a form: the listing as it is, with NaN that a
    /// device's clamp makes a number, with a device's sine; those of the next smaller budget where none was measured at this
    /// one.
    #[must_use]
    pub fn of(outcome: &Outcome, budget: Budget) -> Vec<Self> {
        let key = [outcome.check, outcome.variant.name(), outcome.precision.name()];
        let of_line = |line: &str| {
            let mut words = line.splitn(9, ' ').skip(5);
            let mut number = || words.next()?.parse().ok();
            let (mean, deviation, _): (f64, f64, f64) = (number()?, number()?, number()?);
            Some(Self { mean, deviation, effect_name: words.next()?.to_owned() })
        };
        let at = |budget: &Budget| -> Vec<Self> {
            let is_meant = |line: &&str| line.split(' ').take(4).eq(key.into_iter().chain([budget.name()]));
            COMMITTED.lines().filter(is_meant).filter_map(of_line).collect()
        };
        let smaller = Budget::ALL.iter().rev().skip_while(|other| **other != budget);
        smaller.map(at).find(|sizes| !sizes.is_empty()).unwrap_or_default()
    }

    /// Returns both sizes in words where the effect of an outcome is at most `excess` times as large, or why it is another one.
    ///
    /// # Errors
    ///
    /// What is different, in words.
    pub fn compare(&self, outcome: &Outcome, excess: f64) -> Result<String, String> {
        let Self { mean, deviation, effect_name } = self;
        let known = format!("{} +- {}", number(*mean), number(*deviation));
        let Some(effect) = outcome.effect.filter(|_| outcome.effect_name == effect_name) else {
            return Err(format!(
                "known is \"{effect_name}\" of {known}, and it is \"{}\"",
                outcome.effect_name
            ));
        };
        let (spread, here) = (DEVIATIONS * deviation, number(effect));
        if effect > (excess * mean).max(mean + spread) || effect.is_nan() {
            return Err(format!("the listing has {known}, and it has {here}"));
        }
        let is_less = effect < (mean / EXCESS).min(mean - spread);
        Ok(format!("known: {known}, here {here}{}", if is_less { ", which is less" } else { "" }))
    }
}

/// Writes a number with three digits.
pub(crate) fn number(x: f64) -> String {
    let is_plain = x == 0.0 || (1.0e-4..1.0e4).contains(&x.abs());
    if !is_plain {
        return format!("{x:.2e}");
    }
    let digits = if x == 0.0 { 0 } else { (2 - libm::log10(x.abs()).floor() as i32).max(0) };
    format!("{x:.*}", digits as usize)
}

#[cfg(test)]
mod tests {
    use super::super::known::OF_THE_LISTINGS;
    use super::super::outcome::{Verdict, tests::outcome};
    use super::*;
    use crate::check::Precision;
    use crate::threshold::two_scale::Variant;

    #[test]
    fn every_known_failure_has_a_size() {
        for known in OF_THE_LISTINGS {
            for claim in crate::check::claims::ALL.iter().filter(|claim| claim.id == known.check) {
                for (variant, precision) in
                    Variant::ALL.into_iter().flat_map(|v| Precision::ALL.map(|p| (v, p)))
                {
                    let of = Outcome { variant, precision, ..outcome(claim.id, Verdict::Rejected) };
                    let sizes = Budget::ALL.map(|budget| !Size::of(&of, budget).is_empty());
                    let is_known = known.is_about(&of);
                    assert!(!is_known || sizes == [true; 3], "{} {variant} {precision}", claim.id);
                }
            }
        }
    }

    #[test]
    fn a_fifth_more_or_five_deviations_are_the_same_failure() {
        let seen = |effect, effect_name| Outcome {
            effect: Some(effect),
            effect_name,
            ..outcome("a", Verdict::Rejected)
        };
        let size = |deviation| Size { mean: 0.1, deviation, effect_name: "share".into() };
        assert_eq!(
            size(1e-3).compare(&seen(0.119, "share"), EXCESS).unwrap(),
            "known: 0.100 +- 0.00100, here 0.119"
        );
        assert_eq!(
            size(1e-3).compare(&seen(0.05, "share"), EXCESS).unwrap(),
            "known: 0.100 +- 0.00100, here 0.0500, which is less"
        );
        assert!(size(1e-3).compare(&seen(0.121, "share"), EXCESS).is_err());
        assert!(size(1e-2).compare(&seen(0.149, "share"), EXCESS).is_ok());
        assert!(size(1e-3).compare(&seen(0.1, "pops"), EXCESS).is_err());
        assert!(size(1e-3).compare(&seen(f64::NAN, "share"), EXCESS).is_err());
    }
}
