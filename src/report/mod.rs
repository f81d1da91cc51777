//! What people see: pictures, and the report of a run as text, JSON Lines and a page of HTML.
//!
//! | module | feature | what it makes |
//! |---|---|---|
//! | [`figure`] | `plots` | SVG text out of plain data |
//! | [`json`] | `cli` | one JSON object a claim |
//! | [`text`] | `cli` | the table for a terminal, one line a claim |
//! | [`by_model`] | `cli` | which claims hold on which device models |
//! | [`html`] | `cli` | one page that needs nothing but the pictures beside it |
//! | [`study`] | `cli` | plans, counts and numbers of scenes as text, CSV and JSON |
//! | [`directory`] | `cli` | all of that as files |
//! | [`cost`] | `cli` | what was measured of time: tables, JSON Lines, pictures |
//!
//! What lives here takes what others found out and shows it. What never will: statistics, verdicts, thresholds of its
//! own making, printing, clocks. May import every wing but `cli`; only the command line and the plots import it.

#[cfg(feature = "cli")]
pub mod by_model;
#[cfg(feature = "cli")]
pub mod cost;
#[cfg(feature = "cli")]
pub mod directory;
#[cfg(feature = "plots")]
pub mod figure;
#[cfg(feature = "cli")]
pub mod html;
#[cfg(feature = "cli")]
pub mod json;
#[cfg(feature = "cli")]
pub mod study;
#[cfg(feature = "cli")]
pub mod text;

#[cfg(all(test, feature = "cli"))]
mod example;

/// What is said of a subject that has no thresholds.
#[cfg(feature = "cli")]
const NO_THRESHOLD: &str = "nearly nothing that it answers is a threshold: NaN, or outside of (0, 1]; see `range`, before \
                            anything else";

/// Returns the answer in words that say whether a negative control did its work.
#[cfg(feature = "plots")]
fn answer(outcome: &crate::check::Outcome) -> &'static str {
    use crate::check::Verdict;
    match (outcome.expected, outcome.verdict) {
        (Verdict::Rejected, Verdict::Rejected) => "rejected, as it must be",
        (Verdict::Rejected, Verdict::Consistent) => "not rejected, though it must be",
        (_, Verdict::Rejected) if outcome.known.is_some() => "rejected, as known",
        (_, Verdict::NotApplicable) => "not applicable",
        (_, verdict) => verdict.name(),
    }
}
