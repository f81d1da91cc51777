//! Which claims hold on which device models: one line a claim, one column a model.

use crate::check::{Outcome, Standing, Verdict};
use std::fmt::Write as _;

const GAP: &str = "  ";

/// Returns the table of a subject that was tried under several models, each of which is given with the name that the subject
/// has under it. Empty where none of them was tried.
#[must_use]
pub fn by_model(outcomes: &[Outcome], name: &str, models: &[(&str, String)]) -> String {
    let mut rows: Vec<(&str, Vec<&str>)> = Vec::new();
    for outcome in outcomes {
        let Some(column) = models.iter().position(|(_, subject)| *subject == outcome.subject) else {
            continue;
        };
        let at = rows.iter().position(|(claim, _)| *claim == outcome.check).unwrap_or_else(|| {
            rows.push((outcome.check, vec!["-"; models.len()]));
            rows.len() - 1
        });
        rows[at].1[column] = word(outcome);
    }
    let mut text = String::new();
    if !rows.is_empty() {
        let models: Vec<&str> = models.iter().map(|(model, _)| *model).collect();
        push_table(&mut text, name, &models, &rows);
    }
    text
}

fn word(outcome: &Outcome) -> &'static str {
    match outcome.standing() {
        Standing::AsExpected => "holds",
        Standing::Against => "fails",
        Standing::Known => "known",
        Standing::Unanswered if outcome.verdict == Verdict::Unavailable => "not run",
        Standing::Unanswered => "unclear",
        Standing::NotApplicable => "-",
    }
}

fn push_table(text: &mut String, name: &str, models: &[&str], rows: &[(&str, Vec<&str>)]) {
    let first = rows.iter().map(|(claim, _)| claim.chars().count()).chain([name.chars().count()]).max();
    let first = first.unwrap_or_default();
    let mut line = |head: &str, cells: &[&str]| {
        let cells =
            cells.iter().zip(models).map(|(cell, model)| format!("{GAP}{cell:<0$}", model.len().max(7)));
        let cells: String = cells.collect();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", format!("{head:<first$}{cells}").trim_end());
    };
    line(name, models);
    rows.iter().for_each(|(claim, cells)| line(claim, cells));
}

#[cfg(test)]
mod tests {
    use super::super::example;
    use super::*;

    #[test]
    fn a_line_a_claim_and_a_column_a_model() {
        let of = |subject: &str, check: &'static str, verdict| Outcome {
            subject: subject.to_owned(),
            check,
            verdict,
            ..example::outcomes()[0].clone()
        };
        let outcomes = [
            of("accurate:my.wgsl", "range", Verdict::Consistent),
            of("accurate:my.wgsl", "uniform", Verdict::Consistent),
            of("half:my.wgsl", "range", Verdict::Consistent),
            of("half:my.wgsl", "uniform", Verdict::Rejected),
            of("other", "range", Verdict::Rejected),
        ];
        let models = ["accurate", "half"].map(|model| (model, format!("{model}:my.wgsl")));
        let text = by_model(&outcomes, "my.wgsl", &models);
        let expected = "my.wgsl  accurate  half\nrange    holds     holds\nuniform  holds     fails\n";
        assert_eq!(text, expected);
        assert_eq!(by_model(&outcomes[4..], "my.wgsl", &models), "");
    }
}
