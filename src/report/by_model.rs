//! Which claims hold on which device models: one line a claim, one column a model.

use crate::check::{Outcome, Verdict};
use std::fmt::Write as _;

const GAP: &str = "  ";

/// Returns one table for every subject that was tried under several models; `models` are their names, and a subject is
/// called `MODEL:NAME`. Empty where there is none.
#[must_use]
pub fn by_model(outcomes: &[Outcome], models: &[&str]) -> String {
    let parts = |outcome: &Outcome| {
        let (model, name) = outcome.subject.split_once(':')?;
        let column = models.iter().position(|&known| known == model)?;
        Some((column, name.to_owned()))
    };
    let mut names: Vec<String> = outcomes.iter().filter_map(parts).map(|(_, name)| name).collect();
    names.sort_unstable();
    names.dedup();
    let mut text = String::new();
    for name in names {
        let mut rows: Vec<(&str, Vec<&str>)> = Vec::new();
        for outcome in outcomes {
            let Some((column, _)) = parts(outcome).filter(|(_, found)| *found == name) else { continue };
            let at = rows.iter().position(|(claim, _)| *claim == outcome.check).unwrap_or_else(|| {
                rows.push((outcome.check, vec!["-"; models.len()]));
                rows.len() - 1
            });
            rows[at].1[column] = word(outcome);
        }
        push_table(&mut text, &name, models, &rows);
    }
    text
}

fn word(outcome: &Outcome) -> &'static str {
    match outcome.verdict {
        verdict if verdict == outcome.expected => "holds",
        Verdict::Consistent | Verdict::Rejected => "fails",
        Verdict::Inconclusive => "unclear",
        Verdict::Unavailable => "not run",
        Verdict::NotApplicable => "-",
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
        let text = by_model(&outcomes, &["accurate", "half"]);
        let expected = "my.wgsl  accurate  half\nrange    holds     holds\nuniform  holds     fails\n";
        assert_eq!(text, expected);
        assert_eq!(by_model(&outcomes[4..], &["accurate", "half"]), "");
    }
}
