//! The paper's claims about its own listings, one named trial each.
//!
//! A claim that a listing is known to fail stands in `check::known`; its trial demands that it is still rejected.

use hashed_alpha::check::known::listing_fails;
use hashed_alpha::check::{Draw, Outcome, Results, Standing, Subject, Suite, claims, run_claims};
use libtest_mimic::{Arguments, Trial};

fn trial(outcome: &Outcome) -> Trial {
    let name = format!("{} {} {}", outcome.check, outcome.subject, outcome.precision);
    let failure = match (outcome.standing(), listing_fails(outcome)) {
        (Standing::Against | Standing::Unanswered, _) => Some(outcome.to_string()),
        (Standing::AsExpected | Standing::NotApplicable, Some(reason)) => {
            Some(format!("known to be rejected ({reason}), and is not\n{outcome}"))
        }
        (Standing::Known, _) | (Standing::AsExpected | Standing::NotApplicable, None) => None,
    };
    Trial::test(name, move || failure.map_or(Ok(()), |text| Err(text.into())))
}

fn main() {
    let outcomes = run_claims(claims::ALL, &Subject::paper(), &Draw::default(), || {});
    let results = Results::new(outcomes, Suite::Paper);
    libtest_mimic::run(&Arguments::from_args(), results.outcomes.iter().map(trial).collect()).exit();
}
