//! The outcomes for programs that show them beside a shader: SARIF 2.1.0, and commands of a workflow on GitHub.

use super::cause::sentences;
use crate::check::diagnosis::Diagnosis;
use crate::check::{Outcome, Standing, claims};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Where a subject is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// Name of the subject.
    pub subject: String,
    /// Path of its file, as it was typed.
    pub path: String,
    /// Line and column of its function, both from 1, where they are known.
    pub place: Option<[usize; 2]>,
}

/// Where the function of a subject is written; nothing for one of this crate.
fn written<'a>(subject: &str, all: &'a [Written]) -> Option<&'a Written> {
    all.iter().find(|written| written.subject == subject)
}

/// Returns the outcomes that need a reader as SARIF 2.1.0, one run: each cause of a rejection, then each rejection, as errors; what
/// has no verdict as warnings. All of a subject lie at the line of its function.
#[must_use]
pub fn sarif(outcomes: &[Outcome], diagnoses: &[Diagnosis], written_in: &[Written]) -> Value {
    let locations = |subject: &str| {
        let location = |written: &Written| {
            let mut physical = json!({ "artifactLocation": { "uri": written.path.replace('\\', "/") } });
            if let Some([line, column]) = written.place {
                physical["region"] = json!({ "startLine": line, "startColumn": column });
            }
            json!([{ "physicalLocation": physical }])
        };
        written(subject, written_in).map_or_else(|| json!([]), location)
    };
    let result = |rule: &str, level: &str, subject: &str, text: String| {
        json!({
            "ruleId": rule,
            "level": level,
            "message": { "text": text },
            "locations": locations(subject),
        })
    };
    let of_causes = diagnoses.iter().flat_map(|diagnosis| {
        let named = diagnosis.examination.found.iter().map(|found| found.slip.name);
        let rules = named.chain(std::iter::repeat("cause"));
        let texts = sentences(diagnosis).into_iter().zip(rules);
        texts.map(|(text, rule)| result(rule, "error", &diagnosis.subject, text)).collect::<Vec<_>>()
    });
    let of_claims = outcomes.iter().filter_map(|outcome| {
        let level = match outcome.standing() {
            Standing::Against => "error",
            Standing::Unanswered => "warning",
            Standing::Known | Standing::AsExpected | Standing::NotApplicable => return None,
        };
        let seen = outcome.seen.as_deref().filter(|seen| !seen.is_empty()).unwrap_or(outcome.verdict.name());
        let text = format!("{} in {}: {seen}", outcome.subject, outcome.precision);
        Some(result(outcome.check, level, &outcome.subject, text))
    });
    let results: Vec<Value> = of_causes.chain(of_claims).collect();
    let rule = |claim: &crate::check::Claim| json!({ "id": claim.id, "shortDescription": { "text": claim.statement } });
    let rules: Vec<Value> = claims::ALL.iter().map(rule).collect();
    json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": env!("CARGO_PKG_NAME"),
                "version": env!("CARGO_PKG_VERSION"),
                "rules": rules,
            } },
            "results": results,
        }],
    })
}

/// Returns a command of a workflow for each cause of a rejection, one a line: an error at the line of the function, with what to
/// change. A subject that is rejected without one has the strongest evidence in its place.
#[must_use]
pub fn github(diagnoses: &[Diagnosis], written_in: &[Written]) -> String {
    let mut text = String::new();
    for diagnosis in diagnoses {
        let mut properties = Vec::new();
        if let Some(Written { path, place, .. }) = written(&diagnosis.subject, written_in) {
            properties.push(format!("file={}", escaped(path, true)));
            if let Some([line, column]) = place {
                properties.extend([format!("line={line}"), format!("col={column}")]);
            }
        }
        let title = format!("{} in {} is rejected", diagnosis.subject, diagnosis.precision);
        properties.push(format!("title={}", escaped(&title, true)));
        for sentence in sentences(diagnosis) {
            let message = escaped(&sentence, false);
            writeln!(text, "::error {}::{message}", properties.join(","))
                .expect("writing into memory cannot fail");
        }
    }
    text
}

/// A text as commands of a workflow have it: in properties without the signs that part them.
fn escaped(text: &str, is_property: bool) -> String {
    let text = text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A");
    if is_property { text.replace(':', "%3A").replace(',', "%2C") } else { text }
}

#[cfg(test)]
mod tests {
    use super::super::example;
    use super::*;
    use crate::check::Verdict;
    use crate::check::diagnosis::diagnoses;

    fn rejected() -> Vec<Outcome> {
        let rejected = Outcome {
            check: "uniform.without_cdf",
            subject: "a,b.glsl".to_owned(),
            verdict: Verdict::Consistent,
            expected: Verdict::Rejected,
            ..example::consistent()
        };
        vec![example::consistent(), rejected]
    }

    fn places() -> [Written; 1] {
        [Written { subject: "a,b.glsl".to_owned(), path: "src/a,b.glsl".to_owned(), place: Some([12, 7]) }]
    }

    #[test]
    fn sarif_has_a_result_for_what_needs_a_reader_at_its_place() {
        let outcomes = rejected();
        let sarif = sarif(&outcomes, &diagnoses(&outcomes, &[]), &places());
        let results = sarif["runs"][0]["results"].as_array().unwrap();
        let last = results.last().unwrap();
        assert_eq!((&last["ruleId"], &last["level"]), (&json!("uniform.without_cdf"), &json!("error")));
        for result in results {
            let place = &result["locations"][0]["physicalLocation"];
            assert_eq!(place["artifactLocation"]["uri"], "src/a,b.glsl");
            assert_eq!(place["region"], json!({ "startLine": 12, "startColumn": 7 }));
        }
        assert_eq!(sarif["version"], "2.1.0");
        let nothing = super::sarif(&outcomes[..1], &[], &[]);
        assert_eq!(nothing["runs"][0]["results"], json!([]));
    }

    #[test]
    fn a_workflow_is_told_the_cause_at_its_line() {
        let outcomes = rejected();
        let text = github(&diagnoses(&outcomes, &[]), &places());
        let first = text.lines().next().unwrap();
        let head = "::error file=src/a%2Cb.glsl,line=12,col=7,title=a%2Cb.glsl in f32 is rejected::";
        assert!(first.starts_with(head), "{first}");
        assert_eq!(escaped("100 %\nx: y, z", true), "100 %25%0Ax%3A y%2C z");
        assert!(github(&[], &places()).is_empty());
    }
}
