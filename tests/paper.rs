//! The paper's claims about its own listings, one named trial each.
//!
//! A claim that a listing is known to fail stands in `check::known`; its trial demands that it is still rejected.

use hashed_alpha::check::{Draw, Outcome, Subject, Suite, Verdict, claims, results::Results, run_claims};
use libtest_mimic::{Arguments, Trial};

fn trial(outcome: &Outcome) -> Trial {
    let name = format!("{} {} {}", outcome.check, outcome.subject, outcome.precision);
    let failure = match outcome.listing_fails {
        _ if outcome.is_news() => Some(outcome.to_string()),
        Some(reason) if outcome.verdict != Verdict::Rejected => {
            Some(format!("known as a finding ({reason}), but not rejected\n{outcome}"))
        }
        _ => None,
    };
    Trial::test(name, move || failure.map_or(Ok(()), |text| Err(text.into())))
}

fn main() {
    let outcomes = run_claims(claims::ALL, &Subject::paper(), &Draw::default(), || {});
    let results = Results::new(outcomes, Suite::Paper);
    libtest_mimic::run(&Arguments::from_args(), results.outcomes.iter().map(trial).collect()).exit();
}
