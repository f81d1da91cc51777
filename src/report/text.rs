//! The outcomes as a table for a terminal, at most [`COLUMNS`] wide.

use super::cause::causes;
use super::sampled;
use super::wrap::wrap;
use crate::check::diagnosis::Diagnosis;
use crate::check::{Outcome, Standing, Verdict};
use std::fmt::Write as _;

/// The widest line, in characters.
pub const COLUMNS: usize = 120;

const HEADINGS: [&str; 8] =
    ["verdict", "check", "subject", "prec", "n", "statistic", "p (Holm)", "effect / detectable"];
/// Columns of numbers, which stand to the right.
const FIRST_NUMBER: usize = 4;
const GAP: usize = 2;
/// Where findings begin.
const INDENT: &str = "    ";
const SHORTEST_NAME: usize = 12;
/// Characters of a column of what was sampled, for the name of a claim and for all others.
const WIDEST_CLAIM: usize = 28;
const WIDEST_SAMPLED: usize = 14;

/// Returns the table, with a line break after every line: why subjects are rejected, headings, one line a claim, below it its finding
/// where it has one, then what each claim has sampled, and [`summary`].
///
/// `colour` puts ANSI colours around verdicts: green where the answer is the expected one, red where it is not and nobody knew,
/// yellow where it is known or there is none. Without it the text is plain. Names that do not fit are cut in the middle.
#[must_use]
pub fn table(outcomes: &[Outcome], diagnoses: &[Diagnosis], colour: bool) -> String {
    let mut rows: Vec<[String; 8]> = outcomes.iter().map(cells).collect();
    let mut widths = HEADINGS.map(|heading| heading.chars().count());
    for row in &rows {
        for (width, cell) in widths.iter_mut().zip(row) {
            *width = (*width).max(cell.chars().count());
        }
    }
    narrow(&mut widths);
    for row in &mut rows {
        for (cell, &width) in row.iter_mut().zip(&widths) {
            *cell = cut(cell, width);
        }
    }
    let mut text = causes(diagnoses, COLUMNS);
    push_row(&mut text, &HEADINGS.map(str::to_owned), &widths, None);
    let mut told = None;
    for (row, outcome) in rows.iter().zip(outcomes) {
        let paint = colour.then(|| paint_of(outcome));
        push_row(&mut text, row, &widths, paint);
        // Why a subject could not be run is the same for all its claims.
        let reason = (outcome.verdict == Verdict::Unavailable).then_some((&outcome.subject, &outcome.seen));
        if reason.is_none() || told.replace(reason) != Some(reason) {
            push_finding(&mut text, outcome, paint);
        }
    }
    push_sampled(&mut text, outcomes);
    wrap(&summary(outcomes), COLUMNS).iter().for_each(|line| push_line(&mut text, line));
    text
}

/// Returns how many outcomes there are of each kind, in one line without a line break.
#[must_use]
pub fn summary(outcomes: &[Outcome]) -> String {
    let count = |wanted: &dyn Fn(&Outcome) -> bool| outcomes.iter().filter(|outcome| wanted(outcome)).count();
    let of = |standing, is_control| {
        count(&|outcome| outcome.standing() == standing && outcome.is_control() == is_control)
    };
    let without = |verdict| count(&|outcome| outcome.verdict == verdict);
    let known = of(Standing::Known, false) + of(Standing::Known, true);
    let counts = [
        (of(Standing::AsExpected, false), "consistent"),
        (of(Standing::Against, false), "rejected"),
        (known, "rejected, as known"),
        (of(Standing::AsExpected, true), "rejected, as they must be"),
        (of(Standing::Against, true), "not rejected, though they must be"),
        (without(Verdict::Inconclusive), "inconclusive"),
        (without(Verdict::Unavailable), "unavailable"),
        (without(Verdict::NotApplicable), "not applicable"),
    ];
    let parts: Vec<_> =
        counts.into_iter().filter(|(n, _)| *n > 0).map(|(n, name)| format!("{n} {name}")).collect();
    let claims = if outcomes.len() == 1 { "claim" } else { "claims" };
    let parts = if parts.is_empty() { "nothing was tried".to_owned() } else { parts.join("; ") };
    format!("{} {claims}: {parts}", outcomes.len())
}

/// Returns the remark that belongs to an outcome: what was seen, and whether a negative control did its work.
pub(super) fn remark(outcome: &Outcome) -> Option<String> {
    let seen = outcome.seen.as_deref().filter(|seen| !seen.is_empty());
    let is_answered = matches!(outcome.standing(), Standing::AsExpected | Standing::Against);
    let control = (is_answered && outcome.is_control()).then(|| outcome.answer());
    let said = match (control, seen) {
        (Some(control), Some(seen)) => Some(format!("{control}: {seen}")),
        (control, seen) => control.or(seen).map(str::to_owned),
    };
    match &outcome.known {
        Some(reason) => Some(format!("{} (known: {reason})", said.unwrap_or_default())),
        None => said,
    }
}

/// Returns a probability as [`number`] does; what is too small to be one is told as such, and not as 0.
pub(super) fn probability(value: Option<f64>) -> String {
    if value.is_some_and(|p| p < 1.0e-300) { "< 1e-300".to_owned() } else { number(value) }
}

/// Returns a number in at most nine characters; a dash where there is none.
pub(super) fn number(value: Option<f64>) -> String {
    let Some(value) = value else { return "-".to_owned() };
    let magnitude = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if !value.is_finite() {
        value.to_string()
    } else if (0.001..10_000_000.0).contains(&magnitude) {
        let decimals = (3 - libm::log10(magnitude).floor() as i32).clamp(0, 5) as usize;
        let fixed = format!("{value:.decimals$}");
        let trimmed = if decimals > 0 { fixed.trim_end_matches('0').trim_end_matches('.') } else { &fixed };
        trimmed.to_owned()
    } else {
        format!("{value:.1e}")
    }
}

fn cells(outcome: &Outcome) -> [String; 8] {
    let nothing_seen = outcome.effect.is_none() && outcome.detectable.is_none();
    [
        outcome.verdict.name().replace('_', " "),
        outcome.check.to_owned(),
        outcome.subject.chars().map(|c| if c.is_control() { '?' } else { c }).collect(),
        outcome.precision.name().to_owned(),
        outcome.n.to_string(),
        number(outcome.statistic),
        probability(outcome.p_holm),
        if nothing_seen {
            "-".to_owned()
        } else {
            format!("{} / {}", number(outcome.effect), number(outcome.detectable))
        },
    ]
}

/// Takes from the wider of the two columns of names, check and subject, until the line fits.
fn narrow(widths: &mut [usize; 8]) {
    let line = |widths: &[usize; 8]| widths.iter().sum::<usize>() + GAP * (widths.len() - 1);
    while line(widths) > COLUMNS {
        let widest = if widths[1] > widths[2] { 1 } else { 2 };
        if widths[widest] <= SHORTEST_NAME {
            break;
        }
        widths[widest] -= 1;
    }
}

/// Cuts a text to a width by an ellipsis in its middle.
fn cut(text: &str, width: usize) -> String {
    let length = text.chars().count();
    if length <= width {
        return text.to_owned();
    }
    let kept = width.saturating_sub(1);
    let tail = kept / 2;
    let head = text.chars().take(kept - tail);
    head.chain(['…']).chain(text.chars().skip(length - tail)).collect()
}

fn push_row(text: &mut String, cells: &[String; 8], widths: &[usize; 8], paint: Option<&str>) {
    let mut line = String::new();
    for (column, (cell, &width)) in cells.iter().map(String::as_str).zip(widths).enumerate() {
        let padding = " ".repeat(width.saturating_sub(cell.chars().count()));
        let gap = if column == 0 { "" } else { "  " };
        line.push_str(gap);
        match (column, paint) {
            (0, Some(paint)) => line.extend([paint, cell, RESET, &padding]),
            (FIRST_NUMBER.., _) => line.extend([padding.as_str(), cell]),
            _ => line.extend([cell, padding.as_str()]),
        }
    }
    push_line(text, line.trim_end());
}

/// Appends what each claim has sampled, in columns as wide as they need to be, up to [`COLUMNS`].
fn push_sampled(text: &mut String, outcomes: &[Outcome]) {
    let rows = sampled::rows(outcomes);
    if rows.is_empty() {
        return;
    }
    let rows: Vec<_> = std::iter::once(sampled::HEADINGS.map(str::to_owned)).chain(rows).collect();
    let mut widths = [0; 9];
    for row in &rows {
        for (column, (width, cell)) in widths.iter_mut().zip(row).enumerate() {
            let widest = if column == 0 { WIDEST_CLAIM } else { WIDEST_SAMPLED };
            *width = (*width).max(cell.chars().count()).min(widest);
        }
    }
    for row in &rows {
        let padded = row.iter().zip(widths).map(|(cell, width)| format!("{:width$}", cut(cell, width)));
        push_line(text, cut(padded.collect::<Vec<_>>().join(" ").trim_end(), COLUMNS).as_str());
    }
}

fn push_finding(text: &mut String, outcome: &Outcome, paint: Option<&str>) {
    // What is known needs no evidence in a terminal; the page has it.
    let known = outcome.known.as_ref().map(|reason| format!("known: {reason}"));
    let Some(remark) = known.or_else(|| remark(outcome)) else { return };
    for line in wrap(&remark, COLUMNS - INDENT.len()) {
        match paint {
            Some(paint) => push_line(text, &format!("{INDENT}{paint}{line}{RESET}")),
            None => push_line(text, &format!("{INDENT}{line}")),
        }
    }
}

fn push_line(text: &mut String, line: &str) {
    writeln!(text, "{line}").expect("writing into memory cannot fail");
}

const GREEN: &str = "\u{1b}[32m";
const RED: &str = "\u{1b}[31m";
const YELLOW: &str = "\u{1b}[33m";
const RESET: &str = "\u{1b}[0m";

fn paint_of(outcome: &Outcome) -> &'static str {
    match outcome.standing() {
        Standing::AsExpected | Standing::NotApplicable => GREEN,
        Standing::Against => RED,
        Standing::Known | Standing::Unanswered => YELLOW,
    }
}

#[cfg(test)]
mod tests {
    use super::super::example;
    use super::*;
    use crate::check::diagnosis::diagnoses;

    #[test]
    fn table_is_aligned_and_fits() {
        let text = table(&example::outcomes(), &[], false);
        assert!(!text.contains('\u{1b}'));
        for line in text.lines() {
            assert!(line.chars().count() <= COLUMNS, "{line}");
            assert_eq!(line.trim_end(), line);
        }
        let of = |word: &str| text.lines().find(|line| line.contains(word)).unwrap().find("paper").unwrap();
        assert_eq!(text.lines().next().unwrap().find("subject"), Some(of("uniform.by_lerp_factor")));
    }

    #[test]
    fn a_rejected_claim_is_followed_by_its_finding() {
        let text = table(&example::outcomes(), &[], false);
        let lines: Vec<_> = text.lines().collect();
        let at = lines.iter().position(|line| line.contains("stability.translate")).unwrap();
        assert!(lines[at].starts_with("rejected "));
        assert!(lines[at + 1].starts_with("    of 65536 thresholds 37 % change"), "{}", lines[at + 1]);
        assert!(lines[at + 2].starts_with("    ") && lines[at + 3].starts_with("rejected "));
        assert!(text.contains("    rejected, as it must be: neighbouring cells share a factor\n"));
        assert!(text.contains("    not rejected, though it must be\n"));
        assert!(text.contains("    no adapter\n"));
    }

    #[test]
    fn a_rejected_subject_is_told_what_it_looks_like() {
        let outcome = Outcome {
            check: "uniform.without_cdf",
            subject: "mine".to_owned(),
            verdict: Verdict::Consistent,
            expected: Verdict::Rejected,
            ..example::consistent()
        };
        let of = |outcomes: &[Outcome]| table(outcomes, &diagnoses(outcomes, &[]), false);
        assert!(
            of(&[outcome]).starts_with("cause of mine in f32: no experiment shows a slip; it looks like ")
        );
        assert!(of(&[example::consistent()]).starts_with("verdict "));
    }

    #[test]
    fn last_line_sums_up() {
        assert_eq!(
            summary(&example::outcomes()),
            "7 claims: 1 consistent; 1 rejected; 1 rejected, as they must be; 1 not rejected, though they must be; \
             1 inconclusive; 1 unavailable; 1 not applicable"
        );
        assert!(table(&example::outcomes()[1..4], &[], false).ends_with(
            "\n3 claims: 1 rejected; 1 rejected, as they must be; 1 not rejected, though they must be\n"
        ));
        assert_eq!(summary(&[]), "0 claims: nothing was tried");
    }

    #[test]
    fn colour_changes_nothing_but_colour() {
        let coloured = table(&example::outcomes(), &[], true);
        let plain =
            [GREEN, RED, YELLOW, RESET].iter().fold(coloured.clone(), |text, code| text.replace(code, ""));
        assert_eq!(plain, table(&example::outcomes(), &[], false));
        assert!(
            coloured.contains("\u{1b}[31mrejected\u{1b}[0m")
                && coloured.contains("\u{1b}[32mrejected\u{1b}[0m")
        );
    }

    #[test]
    fn foreign_names_cannot_steer_the_terminal() {
        let outcome = Outcome {
            subject: "\u{1b}[2Jx".to_owned(),
            seen: Some("\u{1b}[2J seen".to_owned()),
            ..example::consistent()
        };
        assert!(!table(&[outcome], &[], false).contains('\u{1b}'));
    }

    #[test]
    fn numbers_are_short() {
        let cases = [
            (61.237, "61.24"),
            (0.5386, "0.5386"),
            (1.0, "1"),
            (-0.001_25, "-0.00125"),
            (3.1e-200, "3.1e-200"),
            (9_999.96, "10000"),
            (123_456.0, "123456"),
            (12_345_678.0, "1.2e7"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "NaN"),
            (0.0, "0"),
        ];
        for (value, expected) in cases {
            assert_eq!(number(Some(value)), expected);
        }
        assert_eq!(number(None), "-");
    }

    #[test]
    fn long_names_keep_both_ends() {
        assert_eq!(cut("a/very/long/path.wgsl", 12), "a/very….wgsl");
    }
}
