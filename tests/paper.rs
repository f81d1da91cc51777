//! The paper's claims about its own listings, one named trial each.
//!
//! A claim that is known to be wrong stands in `findings.toml`; its trial demands that it is still rejected.

use hashed_alpha::check::expectation::{Expectation, judge};
use hashed_alpha::check::{Subject, claims, run};
use libtest_mimic::{Arguments, Failed, Trial};
use serde::Deserialize;

#[derive(Deserialize)]
struct Findings {
    finding: Vec<Finding>,
}

#[derive(Deserialize)]
struct Finding {
    check: String,
    subject: String,
    precision: String,
    reason: String,
}

fn main() {
    let findings: Findings = toml::from_str(include_str!("../findings.toml")).expect("findings.toml parses");
    assert!(findings.finding.iter().all(|finding| !finding.reason.is_empty()));
    let expectations: Vec<Expectation> = findings
        .finding
        .into_iter()
        .map(|Finding { check, subject, precision, .. }| Expectation { check, subject, precision })
        .collect();

    let outcomes = run(&claims::ALL, &Subject::paper(), 0, || {});
    let judgement = judge(&outcomes, &expectations);
    let mut trials: Vec<Trial> = outcomes
        .iter()
        .enumerate()
        .map(|(index, outcome)| {
            let name = format!("{} {} {}", outcome.check, outcome.subject, outcome.precision);
            let failure = judgement.unexpected.contains(&index).then(|| format!("{outcome:#?}"));
            Trial::test(name, move || failure.map_or(Ok(()), |text| Err(Failed::from(text))))
        })
        .collect();
    for index in judgement.stale.into_iter().chain(judgement.unmatched) {
        let known = &expectations[index];
        let name = format!("known finding {} {} {}", known.check, known.subject, known.precision);
        trials.push(Trial::test(name, || {
            Err(Failed::from("findings.toml lists it, but the claim was not rejected"))
        }));
    }
    libtest_mimic::run(&Arguments::from_args(), trials).exit();
}
