//! Two subjects side by side: are their values the same, or at least the law of their values?
//!
//! Which of the two can be asked depends on what the subjects rest on. Integer hashes give the same bits everywhere;
//! what rests on the sine of large arguments shares no digit between two machines, and all that can be the same is the
//! law.

use crate::check::input::{general_scenes, independent};
use crate::check::tolerance::{DRAWS_A_PLACE, FAMILY_LEVEL, LERP_GROUPS, PAIR_BINS};
use crate::check::{Draw, Subject};
use crate::scene::Fragment;
use crate::stats::histogram::bin_of;
use crate::stats::{StatsError, chi_square, two_sample};
use core::fmt;

/// Largest difference of two values that count as equal but for rounding: sixteen roundings of an `f32` near 1.
const EQUAL_WITHIN: f64 = 1.0e-6;

/// Samples of each of two subjects whose laws are compared: 256 expected in every cell of the table.
const COMPARED_SAMPLES: usize = 1 << 16;

/// How much two subjects agree, the strongest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Agreement {
    /// Every threshold has the same bits.
    Equal,
    /// Every pair of thresholds is at most 1e-6 apart.
    EqualWithin,
    /// Thresholds differ, and nothing tells their laws apart. Says nothing about any single value, however many are
    /// equal.
    SameLaw,
    /// The laws differ.
    DifferentLaws,
}

impl Agreement {
    /// The words by which reports name it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Equal => "equal",
            Self::EqualWithin => "equal within 1e-6",
            Self::SameLaw => "same law",
            Self::DifferentLaws => "different laws",
        }
    }
}

impl fmt::Display for Agreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// What a comparison of two subjects found.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Comparison {
    /// Fragments that both were asked for.
    pub n: u64,
    /// How many of them the first and the second refused.
    pub refused: [u64; 2],
    /// Share of fragments with the same bits, in [0, 1]; two refusals are the same.
    pub share_equal: f64,
    /// Share of fragments whose thresholds are at most 1e-6 apart, in [0, 1].
    pub share_within: f64,
    /// Largest difference of two thresholds; infinite where only one subject refused.
    pub largest_difference: f64,
    /// Two-sample chi-square over lerp factor and threshold, refusals being a bin of their own: probability of tables as
    /// different, if the laws are the same.
    pub p_chi_square: f64,
    /// Two-sample Kolmogorov-Smirnov over thresholds: the same.
    pub p_kolmogorov_smirnov: f64,
    /// The verdict.
    pub agreement: Agreement,
}

/// The verdict, and the figures that it rests on.
impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let percent = |share: f64| 100.0 * share;
        write!(
            f,
            "{}; of {} thresholds {:.2} % are equal in bits, {:.2} % are within 1e-6, the largest difference is {:.2e}; \
             p of one law {:.3} (chi-square), {:.3} (Kolmogorov-Smirnov)",
            self.agreement,
            self.n,
            percent(self.share_equal),
            percent(self.share_within),
            self.largest_difference,
            self.p_chi_square,
            self.p_kolmogorov_smirnov
        )
    }
}

/// Compares two subjects on surfaces in general position, at a level of 1e-6.
///
/// Values are compared fragment by fragment. Laws are compared on samples that share no cell: the first subject at one
/// half of the fragments, the second at the other half. Cells are those that `a` claims to have, and footprints are
/// rounded to its precision.
///
/// # Errors
///
/// The reason, where one of the subjects could not be run or the scenes gave no samples.
pub fn compare(a: &Subject<'_>, b: &Subject<'_>, draw: &Draw) -> Result<Comparison, String> {
    let mut rng = draw.rng("compare");
    let n = draw.samples(COMPARED_SAMPLES);
    let samples = independent(a, &general_scenes(), 2 * n, DRAWS_A_PLACE, &mut rng);
    let values = [a, b].map(|subject| subject.thresholds(&samples));
    for subject in [a, b] {
        if let Some(reason) = subject.failure() {
            return Err(format!("{subject:?}: {reason}"));
        }
    }
    let [left, right] = &values;
    let same = |(x, y): &(&f64, &f64)| x.to_bits() == y.to_bits() || x.is_nan() && y.is_nan();
    let difference = |pair: (&f64, &f64)| match (same(&pair), pair.0 - pair.1) {
        (true, _) => 0.0,
        (false, apart) if apart.is_nan() => f64::INFINITY,
        (false, apart) => apart.abs(),
    };
    let pairs = || left.iter().zip(right);
    let share = |count: usize| count as f64 / samples.len() as f64;
    let share_equal = share(pairs().filter(same).count());
    let share_within = share(pairs().filter(|&pair| difference(pair) <= EQUAL_WITHIN).count());
    let middle = samples.len() / 2;
    let halves = [(&samples[..middle], &left[..middle]), (&samples[middle..], &right[middle..])];
    let [p_chi_square, p_kolmogorov_smirnov] = same_law(a, halves).map_err(|error| error.to_string())?;
    let agreement = if share_equal >= 1.0 {
        Agreement::Equal
    } else if share_within >= 1.0 {
        Agreement::EqualWithin
    } else if 2.0 * p_chi_square.min(p_kolmogorov_smirnov) > FAMILY_LEVEL {
        Agreement::SameLaw
    } else {
        Agreement::DifferentLaws
    };
    Ok(Comparison {
        n: samples.len() as u64,
        refused: [left, right].map(|values| values.iter().filter(|value| value.is_nan()).count() as u64),
        share_equal,
        share_within,
        largest_difference: pairs().map(difference).fold(0.0, f64::max),
        p_chi_square,
        p_kolmogorov_smirnov,
        agreement,
    })
}

/// Judges whether two samples of fragments and thresholds follow the same law: by chi-square, by Kolmogorov-Smirnov.
fn same_law(subject: &Subject<'_>, samples: [(&[Fragment], &[f64]); 2]) -> Result<[f64; 2], StatsError> {
    let tables = samples.map(|(fragments, values)| {
        // One row for each group of lerp factors, since laws that differ at each may agree in the mean.
        let mut table = vec![0_u64; LERP_GROUPS * (PAIR_BINS + 1)];
        for (fragment, &value) in fragments.iter().zip(values) {
            let lerp_factor = subject.nominal(&fragment.footprint).lerp_factor;
            let row = bin_of(lerp_factor, LERP_GROUPS).unwrap_or(LERP_GROUPS - 1);
            let column = bin_of(value, PAIR_BINS).unwrap_or(PAIR_BINS);
            table[row * (PAIR_BINS + 1) + column] += 1;
        }
        table
    });
    let [mut left, mut right] = samples
        .map(|(_, values)| values.iter().copied().filter(|value| value.is_finite()).collect::<Vec<f64>>());
    let by_table = chi_square::two_sample(&tables[0], &tables[1])?.p;
    // Without numbers on one side the table has said it all.
    let by_distance = if left.is_empty() || right.is_empty() {
        1.0
    } else {
        two_sample::kolmogorov_smirnov(&mut left, &mut right)?.p
    };
    Ok([by_table, by_distance])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comparison_reads_as_shares_in_percent() {
        let comparison = Comparison {
            n: 200,
            refused: [0, 1],
            share_equal: 0.25,
            share_within: 0.5,
            largest_difference: 0.125,
            p_chi_square: 0.5,
            p_kolmogorov_smirnov: 0.75,
            agreement: Agreement::SameLaw,
        };
        let expected = "same law; of 200 thresholds 25.00 % are equal in bits, 50.00 % are within 1e-6, the largest \
                        difference is 1.25e-1; p of one law 0.500 (chi-square), 0.750 (Kolmogorov-Smirnov)";
        assert_eq!(comparison.to_string(), expected);
    }
}
