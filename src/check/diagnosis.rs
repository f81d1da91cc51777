//! Why a threshold is rejected: its slips, by experiments on it ([`cause`]); where these show none, the specimens that
//! nearly the same claims reject.

use super::cause::{self, Examination};
use super::claims::range::RANGE;
use super::known::listing_fails;
use super::outcome::{Outcome, Standing, Verdict};
use super::specimen::{self, Specimen, matrix::KillMatrix};
use super::subject::{Precision, Subject};
use super::tolerance::GUESSES;
use core::fmt;

/// A specimen is named where it shares this much of what rejects it with a subject: with less, the two differ in most.
const LEAST_LIKENESS: f64 = 0.5;

/// A share of footprints without a threshold in (0, 1] beyond which a subject is told to have none: no specimen has more
/// than a few.
const NO_THRESHOLD: f64 = 0.9;

/// A specimen that a subject looks like.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Guess {
    /// The specimen.
    pub specimen: &'static Specimen,
    /// How much the claims that reject the two have in common, from 0, nothing, to 1, all.
    pub likeness: f64,
}

/// Name, defect and mend.
impl fmt::Display for Guess {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Specimen { name, defect, mend, .. } = self.specimen;
        write!(f, "{name} ({defect}) - {mend}")
    }
}

/// Returns the specimens that the subject of these outcomes looks like, the most similar first. Of those that are equally
/// similar, which happens where few claims were tried, the one with the simplest defect comes first: the one that the fewest
/// claims of the whole suite reject.
///
/// Specimens are sound but for one defect. A subject may be a port of the paper's own listing with that defect: what the
/// listing fails by itself is then no difference, and the greater of both likenesses counts.
///
/// Only claims that were tried and gave an answer count, and none that is known to fail: under
/// [`Suite::Paper`](super::Suite::Paper) those are the ones that the paper's own listing fails. Empty where nothing
/// speaks against the subject, where it looks like none of the specimens, and where next to nothing that it answers is a
/// threshold.
#[must_use]
pub fn guesses(outcomes: &[Outcome]) -> Vec<Guess> {
    if is_no_threshold(outcomes) {
        return Vec::new();
    }
    let matrix = KillMatrix::committed();
    let weight =
        |claim: &str| libm::log((matrix.rows.len() + 1) as f64 / (matrix.rejected_by(claim) + 1) as f64);
    let weighed: Vec<(&Outcome, bool, f64)> = outcomes
        .iter()
        .filter_map(|outcome| match outcome.standing() {
            Standing::Against => Some((outcome, true, weight(outcome.check))),
            Standing::AsExpected => Some((outcome, false, weight(outcome.check))),
            Standing::Unanswered | Standing::Known | Standing::NotApplicable => None,
        })
        .collect();
    let likeness = |specimen: &'static Specimen| {
        let row = matrix.row(specimen.name)?;
        let of_port = |is_listing: bool| {
            let (mut both, mut either) = (0.0, 0.0);
            for &(outcome, is_against, weight) in &weighed {
                let fails =
                    row.claims.contains(&outcome.check) || is_listing && listing_fails(outcome).is_some();
                match (is_against, fails) {
                    (true, true) => (both, either) = (both + weight, either + weight),
                    (false, false) => {}
                    (true, false) | (false, true) => either += weight,
                }
            }
            if either > 0.0 { both / either } else { 0.0 }
        };
        let likeness = of_port(false).max(of_port(true));
        (likeness >= LEAST_LIKENESS).then_some(Guess { specimen, likeness })
    };
    let mut guesses: Vec<Guess> = specimen::ALL.iter().filter_map(likeness).collect();
    let rejections = |guess: &Guess| matrix.row(guess.specimen.name).map_or(0, |row| row.claims.len());
    guesses.sort_by(|a, b| b.likeness.total_cmp(&a.likeness).then_with(|| rejections(a).cmp(&rejections(b))));
    guesses
}

/// Why one subject of a run is rejected.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Diagnosis {
    /// Name of the subject.
    pub subject: String,
    /// Its arithmetic.
    pub precision: Precision,
    /// Whether it answers next to nothing but what is no threshold; then nothing else is said, since no other claim says more.
    pub is_no_threshold: bool,
    /// What experiments on it have shown.
    pub examination: Examination,
    /// The claims that speak against it.
    pub rejections: Vec<&'static str>,
    /// Those of them that neither a specimen with one of these slips nor the paper's own listing fails.
    pub unexplained: Vec<&'static str>,
    /// The most similar specimens, at most three; none where experiments have shown a slip, or that there is none.
    pub guesses: Vec<Guess>,
    /// The claim that speaks most clearly against it, and what it has seen.
    pub strongest: Option<(&'static str, String)>,
}

/// Whether nearly all thresholds are NaN or outside of (0, 1].
fn is_no_threshold(outcomes: &[Outcome]) -> bool {
    let is_so =
        |o: &Outcome| o.check == RANGE.id && o.verdict == Verdict::Rejected && o.effect > Some(NO_THRESHOLD);
    outcomes.iter().any(is_so)
}

/// Returns why the subjects of a run are rejected, of those that are. `subjects` are asked again; one that is not among them is
/// told by its outcomes alone.
#[must_use]
pub fn diagnoses(outcomes: &[Outcome], subjects: &[Subject<'_>]) -> Vec<Diagnosis> {
    let of_one_subject = |a: &Outcome, b: &Outcome| a.subject == b.subject && a.precision == b.precision;
    let rejected = outcomes
        .chunk_by(of_one_subject)
        .filter(|outcomes| outcomes.iter().any(|outcome| outcome.standing() == Standing::Against));
    rejected.map(|outcomes| diagnosis(outcomes, subjects)).collect()
}

fn diagnosis(outcomes: &[Outcome], subjects: &[Subject<'_>]) -> Diagnosis {
    let Outcome { subject: name, precision, .. } = &outcomes[0];
    let is_no_threshold = is_no_threshold(outcomes);
    let subject = subjects.iter().find(|s| s.name == *name && s.precision == *precision);
    let examination = match subject {
        Some(subject) if !is_no_threshold => cause::examine(subject),
        Some(_) | None => Examination::default(),
    };
    let against = || outcomes.iter().filter(|outcome| outcome.standing() == Standing::Against);
    let matrix = KillMatrix::committed();
    let is_of_a_slip = |check: &str| {
        let rows = examination.found.iter().filter_map(|found| matrix.row(found.slip.name));
        rows.into_iter().any(|row| row.claims.contains(&check))
    };
    let unexplained: Vec<&'static str> = against()
        .filter(|o| !is_of_a_slip(o.check) && listing_fails(o).is_none())
        .map(|outcome| outcome.check)
        .collect();
    let mut guesses = guesses(outcomes);
    // What follows the listing is guessed at only where something is left that the listing does not fail.
    let is_told = !examination.found.is_empty() || examination.follows && unexplained.is_empty();
    guesses.truncate(if is_told { 0 } else { GUESSES });
    // An effect in units of the smallest one that would have been seen.
    let clarity = |outcome: &Outcome| match (outcome.effect, outcome.detectable) {
        (Some(effect), Some(detectable)) if detectable > 0.0 => effect / detectable,
        (Some(_), _) => 1.0,
        (None, _) => 0.0,
    };
    let strongest = against().max_by(|a, b| clarity(a).total_cmp(&clarity(b)));
    Diagnosis {
        subject: name.clone(),
        precision: *precision,
        is_no_threshold,
        rejections: against().map(|outcome| outcome.check).collect(),
        unexplained,
        guesses,
        strongest: strongest.map(|outcome| (outcome.check, outcome.seen.clone().unwrap_or_default())),
        examination,
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::super::outcome::tests::outcome;
    use super::super::{Claim, claims};
    use super::*;
    use crate::threshold::two_scale::Variant;

    /// The outcomes of a specimen as the matrix has them.
    pub(crate) fn outcomes_of(specimen: &str) -> Vec<Outcome> {
        let matrix = KillMatrix::committed();
        let row = matrix.row(specimen).expect("a row of that name");
        let answer = |claim: &Claim| {
            let rejected = row.claims.contains(&claim.id) != (claim.expected == Verdict::Rejected);
            let verdict = if rejected { Verdict::Rejected } else { Verdict::Consistent };
            Outcome { expected: claim.expected, ..outcome(claim.id, verdict) }
        };
        claims::ALL.iter().map(answer).collect()
    }

    #[test]
    fn every_row_of_the_matrix_leads_back_to_its_specimen() {
        for specimen in specimen::ALL {
            let found = guesses(&outcomes_of(specimen.name));
            let own = found.iter().find(|guess| guess.specimen.name == specimen.name);
            assert!(own.is_some_and(|own| own.likeness == 1.0), "{specimen:?}: {found:?}");
        }
    }

    #[test]
    fn of_equally_like_specimens_the_simplest_comes_first() {
        let tried = ["range", "range.degenerate", "range.far_from_origin"];
        let mut outcomes = outcomes_of("no-derivative-floor");
        outcomes.retain(|outcome| tried.contains(&outcome.check));
        let found = guesses(&outcomes);
        let place = |name: &str| found.iter().position(|guess| guess.specimen.name == name).unwrap();
        assert_eq!(found[place("half-precision")].likeness, found[0].likeness);
        assert_eq!(place("no-derivative-floor"), 0);
        assert!(place("zero-derivatives-skipped") < place("half-precision"));
    }

    #[test]
    fn what_is_sound_looks_like_nothing() {
        let sound: Vec<Outcome> = claims::ALL
            .iter()
            .map(|claim| Outcome { expected: claim.expected, ..outcome(claim.id, claim.expected) })
            .collect();
        assert!(guesses(&sound).is_empty() && diagnoses(&sound, &[]).is_empty());
    }

    #[test]
    fn what_is_known_to_fail_does_not_count() {
        let mut outcomes = outcomes_of("dfdx-twice");
        let other = outcomes.iter_mut().find(|outcome| outcome.check == "range.degenerate");
        let other = other.expect("a claim of that name");
        (other.verdict, other.known) = (Verdict::Rejected, Some("it divides by zero".into()));
        let found = guesses(&outcomes);
        assert!(found[0].specimen.name == "dfdx-twice" && found[0].likeness == 1.0, "{found:?}");
    }

    #[test]
    fn a_defect_is_found_in_a_port_of_the_listing_too() {
        // What the listing fails by itself hides the defect, and is no difference.
        let outcomes = |specimen: &str| {
            let mut outcomes = outcomes_of(specimen);
            for outcome in &mut outcomes {
                (outcome.variant, outcome.precision) = (Variant::Isotropic, Precision::F32);
                if listing_fails(outcome).is_some() {
                    outcome.verdict = Verdict::Rejected;
                }
            }
            outcomes
        };
        for specimen in ["natural-logarithm", "case-by-lerp-factor", "truncation", "mirrored-coordinates"] {
            let found = guesses(&outcomes(specimen));
            assert_eq!(found[0].specimen.name, specimen, "{found:?}");
        }
    }

    #[test]
    fn what_is_no_threshold_looks_like_nothing_else() {
        let mut outcomes = outcomes_of("signed-hash");
        let range = outcomes.iter_mut().find(|outcome| outcome.check == RANGE.id).unwrap();
        range.effect = Some(0.5);
        let of_half = |outcomes: &[Outcome]| diagnoses(outcomes, &[])[0].is_no_threshold;
        assert!(!of_half(&outcomes));
        let range = outcomes.iter_mut().find(|outcome| outcome.check == RANGE.id).unwrap();
        range.effect = Some(1.0);
        let found = diagnoses(&outcomes, &[]);
        assert!(found[0].is_no_threshold && found[0].guesses.is_empty(), "{found:?}");
    }

    #[test]
    fn a_slip_that_experiments_show_is_told_and_nothing_is_guessed() {
        let specimen = specimen::ALL.iter().find(|specimen| specimen.name == "dfdx-twice").unwrap();
        let subject = (specimen.subject)();
        let of_it = |o: Outcome| Outcome { subject: subject.name.clone(), precision: subject.precision, ..o };
        let mut outcomes: Vec<Outcome> = outcomes_of("dfdx-twice").into_iter().map(of_it).collect();
        let more = outcomes.iter_mut().find(|outcome| outcome.check == "range").unwrap();
        more.verdict = Verdict::Rejected;
        let found = diagnoses(&outcomes, &[subject]).remove(0);
        let names: Vec<_> = found.examination.found.iter().map(|found| found.slip.name).collect();
        assert_eq!(names, ["dfdx-twice"]);
        assert!(found.guesses.is_empty() && found.unexplained == ["range"], "{found:?}");
    }

    #[test]
    fn each_subject_of_a_run_has_a_diagnosis_of_its_own() {
        let mut outcomes = outcomes_of("dfdx-twice");
        outcomes.extend(
            outcomes_of("unchecked-inputs").into_iter().map(|o| Outcome { subject: "other".into(), ..o }),
        );
        let found = diagnoses(&outcomes, &[]);
        let names: Vec<_> =
            found.iter().map(|of| (of.subject.as_str(), of.guesses[0].specimen.name)).collect();
        assert_eq!(names, [("s", "dfdx-twice"), ("other", "unchecked-inputs")]);
        assert!(found.iter().all(|of| of.guesses.len() <= GUESSES));
    }
}
