//! The claims: one file a family. A claim is a sentence about a threshold and the trial that could refute it.

pub mod atoms;
pub mod cells;
pub mod continuity;
pub mod coordinates;
pub mod coverage;
pub mod degenerate;
pub mod determinism;
pub mod exact;
pub mod flips;
pub mod frames;
pub mod hash;
pub mod independence;
pub mod layers;
pub mod noise_scale;
pub mod planes;
pub mod range;
mod replicas;
pub mod single_planes;
pub mod spectrum;
pub mod stability;
pub mod uniform;

use super::tolerance::{POWER, SINGLE_LEVEL};
use super::{Draw, Evidence, Subject, Verdict};
use crate::stats::chi_square::ChiSquare;
use crate::stats::power;

/// A sentence about a threshold, and how it is tried.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// Identifier, `family.claim`.
    pub id: &'static str,
    /// Place in the paper.
    pub anchor: &'static str,
    /// The sentence.
    pub statement: &'static str,
    /// What a sound subject answers: [`Verdict::Rejected`] for a negative control.
    pub expected: Verdict,
    /// The smallest effect that the claim promises to see; absent where a fixed table is gone through.
    pub promise: Option<Promise>,
    /// Tries the claim on a subject with inputs that follow from the identifier and the draw; an error is a trial that
    /// ended before its statistic.
    pub run: fn(&Subject<'_>, &Draw) -> Attempt<Trial>,
}

/// An effect that a claim promises to see with power 0.999, and how what it sees depends on the number of samples.
///
/// A trial that would not have seen it is inconclusive, unless it rejects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Promise {
    /// Twice the samples show half the effect: an excess of chi-square, a share where none is allowed.
    Linear(f64),
    /// Four times the samples show half the effect: a shift, a distance, a correlation.
    Root(f64),
}

impl Promise {
    /// Returns the samples that the promise needs, where `n` samples show an effect of `detectable`.
    #[must_use]
    pub fn samples(self, n: u64, detectable: f64) -> u64 {
        let times = match self {
            Self::Linear(effect) => detectable / effect,
            Self::Root(effect) => (detectable / effect) * (detectable / effect),
        };
        (n as f64 * times).ceil() as u64
    }
}

/// Every claim, in the order of the report.
pub const ALL: &[Claim] = &[
    range::RANGE,
    degenerate::DEGENERATE,
    degenerate::FAR_FROM_ORIGIN,
    exact::CELLS,
    exact::CDF,
    uniform::MARGINAL,
    uniform::COVERAGE,
    uniform::BY_LERP_FACTOR,
    uniform::WITHOUT_CDF,
    single_planes::CONSTANT_X,
    single_planes::CONSTANT_Y,
    single_planes::CONSTANT_Z,
    single_planes::ANY_DIRECTION,
    coverage::MEAN,
    coverage::MEAN_ALIGNED,
    coverage::VARIANCE,
    independence::NEIGHBOURS,
    independence::DIAGONALS,
    independence::ACROSS_ZERO,
    independence::OCTAVES,
    hash::CHILDREN,
    hash::DIFFERENCES,
    hash::VALUES,
    hash::RESONANCE,
    layers::PARALLEL,
    layers::QUARTER,
    stability::TRANSLATE,
    stability::TRANSLATE_ALIGNED,
    noise_scale::FRONTAL,
    noise_scale::TILTED,
    spectrum::AUTOCORRELATION,
    spectrum::ORDINATES,
    spectrum::RADIAL,
    spectrum::ANISOTROPY,
    flips::TRANSLATION,
    flips::ZOOM,
    flips::ROTATION,
    flips::TILT,
    flips::SKINNING,
    coordinates::OBJECT,
    determinism::TWO_PASSES,
    determinism::DERIVATIVES,
    frames::STATIC,
    frames::STRATIFIED,
    frames::SERIAL,
    frames::AVERAGE,
    planes::AXIS_ALIGNED,
    planes::DYADIC,
    continuity::ZOOM,
    continuity::ROTATION,
    continuity::TILT,
    continuity::OCTAVE_BOUNDARY,
    cells::ORIGIN,
    cells::WINDOW,
    cells::MIRROR,
    atoms::ZERO,
    atoms::ENDS,
];

/// What a trial reached, or the trial that ended it early.
pub type Attempt<T> = Result<T, Box<Trial>>;

/// What a trial says before other trials are taken into account.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Conclusion {
    /// A statement without chance in it holds or does not.
    Exact {
        /// Whether it holds.
        holds: bool,
    },
    /// The probability, under the claim, of evidence as strong as that seen.
    Probability(f64),
    /// The samples were too few for an answer.
    Inconclusive,
    /// The subject could not be run.
    Unavailable,
    /// The claim says nothing about this subject.
    NotApplicable,
}

/// What was seen when a claim was tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// The answer.
    pub conclusion: Conclusion,
    /// The test statistic.
    pub statistic: Option<f64>,
    /// What the statistic is.
    pub statistic_name: String,
    /// Samples that entered it.
    pub n: u64,
    /// Size of the effect seen.
    pub effect: Option<f64>,
    /// What the effect measures.
    pub effect_name: &'static str,
    /// Smallest effect that would have been seen.
    pub detectable: Option<f64>,
    /// What was seen, in words; reported where the claim is rejected or without an answer.
    pub seen: String,
    /// What was seen, to be drawn.
    pub evidence: Evidence,
}

/// The smallest share of bad samples of which at least one is among `n` with power 0.999.
fn detectable_share(n: f64) -> f64 {
    -libm::log(1.0 - POWER) / n
}

impl Trial {
    /// A trial that could not be held, and why.
    pub(super) fn without(conclusion: Conclusion, reason: impl Into<String>) -> Self {
        Self {
            conclusion,
            statistic: None,
            statistic_name: String::new(),
            n: 0,
            effect: None,
            effect_name: "",
            detectable: None,
            seen: reason.into(),
            evidence: Evidence::None,
        }
    }

    /// A trial that failed before any statistic, because some thresholds were none: NaN or outside [0, 1].
    fn no_thresholds(outside: usize, n: usize, example: String) -> Self {
        Self {
            conclusion: Conclusion::Exact { holds: false },
            statistic: Some(outside as f64),
            statistic_name: "thresholds outside [0, 1]".into(),
            n: n as u64,
            effect: Some(outside as f64 / n as f64),
            effect_name: "share of samples",
            detectable: Some(detectable_share(n as f64)),
            seen: format!("{outside} of {n} thresholds are NaN or outside [0, 1]; {example}"),
            evidence: Evidence::None,
        }
    }

    /// A trial that rests on the smallest of several chi-square probabilities (Bonferroni).
    fn worst_of(tests: &[ChiSquare], n: u64, seen: String, evidence: Evidence) -> Self {
        let Some(worst) = tests.iter().min_by(|a, b| a.p.total_cmp(&b.p)) else {
            return Self::without(Conclusion::Inconclusive, "no group had enough samples");
        };
        let of_several = if tests.len() > 1 { format!(", worst of {}", tests.len()) } else { String::new() };
        Self {
            conclusion: Conclusion::Probability((worst.p * tests.len() as f64).min(1.0)),
            statistic: Some(worst.statistic),
            statistic_name: format!("chi-square, {} dof{of_several}", worst.dof),
            n,
            effect: Some(worst.effect),
            effect_name: "excess chi-square per sample",
            detectable: Some(power::detectable_effect_chi_square(
                worst.dof,
                worst.n,
                SINGLE_LEVEL / tests.len() as f64,
                POWER,
            )),
            seen,
            evidence,
        }
    }
}
