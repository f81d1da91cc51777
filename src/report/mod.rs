//! What people see: pictures, and the report of a run as text, JSON Lines and a page of HTML.
//!
//! | module | feature | what it makes |
//! |---|---|---|
//! | [`figure`] | `plots` | SVG text out of plain data |
//! | [`json`] | `cli` | one JSON object a claim |
//! | [`text`] | `cli` | the table for a terminal, one line a claim |
//! | [`by_model`] | `cli` | which claims hold on which device models |
//! | [`html`] | `cli` | one page that needs nothing but the pictures beside it |
//! | [`sampled`] | `cli` | what each claim has sampled of the domain |
//! | [`study`] | `cli` | plans, counts and numbers of scenes as text, CSV and JSON |
//! | [`grain`] | `cli` | grain and flips of subjects: text, JSON, Markdown |
//! | [`growth`] | samples until failure: the table, one JSON object a claim, the state that a run continues from |
//! | [`hashes`] | `cli` | the hashes of the list: text, JSON, Markdown, a figure |
//! | [`directory`] | `cli` | all of that as files |
//! | [`cost`] | `cli` | what was measured of time: tables, JSON Lines, pictures |
//!
//! What lives here takes what others found out and shows it. What never will: statistics, verdicts, thresholds of its
//! own making, printing, clocks. May import every wing but `cli`; only the command line and the plots import it.

#[cfg(feature = "cli")]
pub mod annotations;
#[cfg(feature = "cli")]
pub mod by_model;
#[cfg(feature = "cli")]
pub mod cause;
#[cfg(feature = "cli")]
pub mod cost;
#[cfg(feature = "cli")]
pub mod directory;
#[cfg(feature = "plots")]
pub mod figure;
#[cfg(feature = "cli")]
pub mod grain;
#[cfg(feature = "cli")]
pub mod growth;
#[cfg(feature = "cli")]
pub mod hashes;
#[cfg(feature = "cli")]
pub mod html;
#[cfg(feature = "cli")]
pub mod json;
#[cfg(feature = "cli")]
pub mod sampled;
#[cfg(feature = "cli")]
pub mod study;
#[cfg(feature = "cli")]
pub mod text;
#[cfg(feature = "cli")]
mod wrap;

#[cfg(all(test, feature = "cli"))]
mod example;
