//! Samples until failure: as a table, as JSON Lines, as a figure, and as the state from which a run is continued.

use super::figure::until_failure::{FailureBar, until_failure};
use super::text::{COLUMNS, number};
use super::wrap::wrap;
use crate::check::growth::{End, Plan, Step, course, fingerprint};
use crate::check::{Claim, Conclusion, Subject};
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;
use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

/// The version of the keys of a line of JSON; grows when one changes its meaning or goes.
pub const SCHEMA: u32 = 1;

/// The version of the state file.
const STATE: u32 = 1;

/// Where findings begin in the table.
const INDENT: &str = "    ";

/// What is known of a claim on a subject.
#[derive(Debug)]
pub struct Row<'a> {
    /// The claim.
    pub claim: &'a Claim,
    /// The subject.
    pub subject: &'a Subject<'a>,
    /// Its levels from 0 on.
    pub steps: Vec<&'a Step>,
    /// How it has ended; nothing where it could go on.
    pub end: Option<End>,
    /// Up to which p-value the last level rejects.
    pub critical: f64,
}

impl Row<'_> {
    /// Logarithm to base two of the samples of the last level.
    fn log2_n(&self) -> Option<f64> {
        self.steps.last().filter(|step| step.n > 0).map(|step| libm::log2(step.n as f64))
    }

    fn p(&self) -> Option<f64> {
        match self.steps.last()?.conclusion {
            Conclusion::Probability(p) => Some(p),
            Conclusion::Exact { .. }
            | Conclusion::Inconclusive
            | Conclusion::Unavailable
            | Conclusion::NotApplicable => None,
        }
    }

    /// What there is to say below its line.
    fn remark(&self) -> Option<String> {
        let last = self.steps.last()?;
        match self.end? {
            End::Failed | End::Unavailable => Some(last.seen.clone()),
            End::Fixed => {
                Some("not grown: it goes through a table that is the same at every level".to_owned())
            }
            End::Full => Some(format!(
                "not grown beyond 2^{:.1}: it holds all samples at once, or its inputs have no more cells that were not used",
                self.log2_n().unwrap_or_default()
            )),
            End::AsFarAsAsked | End::NotApplicable => None,
        }
    }

    const fn end_name(&self) -> &'static str {
        match self.end {
            None => "open",
            Some(End::Failed) => "failed",
            Some(End::Fixed) => "fixed",
            Some(End::Full) => "full",
            Some(End::AsFarAsAsked) => "as_far_as_asked",
            Some(End::NotApplicable) => "not_applicable",
            Some(End::Unavailable) => "unavailable",
        }
    }
}

/// Returns what is known of every claim on every subject of a plan, subject by subject.
#[must_use]
pub fn rows<'a>(plan: &'a Plan<'_>, steps: &'a [Step]) -> Vec<Row<'a>> {
    let all = plan
        .subjects
        .iter()
        .enumerate()
        .flat_map(|subject| plan.claims.iter().enumerate().map(move |claim| (subject, claim)));
    all.map(|((subject_index, subject), (claim_index, claim))| {
        let steps = course(steps, subject_index, claim_index);
        let end = plan.end(&steps);
        let critical = plan.critical(steps.last().map_or(0, |step| step.doublings));
        Row { claim, subject, steps, end, critical }
    })
    .collect()
}

/// Returns the table with a line break after every line: one line for each claim that says something about its subject, and
/// below it what is to be said of it.
#[must_use]
pub fn table(rows: &[Row<'_>]) -> String {
    let headings = ["result", "check", "subject", "prec", "log2 N", "p", "effect"].map(str::to_owned);
    let mut lines: Vec<([String; 7], Option<String>)> = vec![(headings, None)];
    lines.extend(rows.iter().filter(|row| row.end != Some(End::NotApplicable)).map(|row| {
        let last = row.steps.last();
        let failed = row.end == Some(End::Failed);
        let log2_n = row.log2_n().map_or("-".to_owned(), |log2_n| {
            if failed { format!("{log2_n:.1}") } else { format!(">= {log2_n:.1}") }
        });
        let effect = last.map_or("-".to_owned(), |step| match step.effect {
            Some(effect) => format!("{} {}", number(Some(effect)), step.effect_name),
            None => "-".to_owned(),
        });
        let result = match (row.end, last) {
            (Some(End::Failed), _) => "fails",
            (Some(End::Unavailable), _) => "unavailable",
            (_, None) => "not tried",
            (_, Some(_)) => "holds",
        };
        let name = row.subject.name.chars().filter(|c| !c.is_control()).collect();
        let precision = row.subject.precision.name();
        let cells = [result.to_owned(), row.claim.id.to_owned(), name, precision.to_owned(), log2_n];
        let [result, check, name, precision, log2_n] = cells;
        ([result, check, name, precision, log2_n, number(row.p()), effect], row.remark())
    }));
    let width = |column: usize| lines.iter().map(|(cells, _)| cells[column].chars().count()).max();
    let widths: Vec<usize> = (0..6).map(|column| width(column).unwrap_or_default()).collect();
    let mut text = String::new();
    let mut told = None;
    for (cells, remark) in &lines {
        let padded: Vec<String> =
            cells.iter().zip(&widths).map(|(cell, width)| format!("{cell:<width$}")).collect();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", format!("{}  {}", padded.join("  "), cells[6]).trim_end());
        // Why a subject could not be run is the same for all its claims.
        let is_new = cells[0] != "unavailable" || told.replace(remark) != Some(remark);
        for line in remark.iter().filter(|_| is_new).flat_map(|remark| wrap(remark, COLUMNS - INDENT.len())) {
            let _ = writeln!(text, "{INDENT}{line}");
        }
    }
    for line in wrap(&summary(rows), COLUMNS) {
        let _ = writeln!(text, "{line}");
    }
    text
}

/// Returns how many claims failed, held, and could go no further, in one line without a line break.
#[must_use]
pub fn summary(rows: &[Row<'_>]) -> String {
    let count = |wanted: &dyn Fn(&Row<'_>) -> bool| rows.iter().filter(|row| wanted(row)).count();
    let ended = |ends: &'static [End]| count(&|row| row.end.is_some_and(|end| ends.contains(&end)));
    let counts = [
        (ended(&[End::Failed]), "failed"),
        (count(&|row| row.end.is_none() && !row.steps.is_empty()), "held so far"),
        (ended(&[End::AsFarAsAsked]), "held as far as was asked"),
        (ended(&[End::Full]), "held with as many samples as they can have"),
        (ended(&[End::Fixed]), "held and do not grow"),
        (count(&|row| row.steps.is_empty()), "not tried"),
        (ended(&[End::Unavailable]), "unavailable"),
        (ended(&[End::NotApplicable]), "say nothing about their subject"),
    ];
    let parts: Vec<_> =
        counts.into_iter().filter(|(n, _)| *n > 0).map(|(n, what)| format!("{n} {what}")).collect();
    format!(
        "{} claims on subjects, valid at this and any other time of stopping: {}",
        rows.len(),
        parts.join("; ")
    )
}

/// The keys of one line, in their order.
#[derive(Serialize)]
struct Line<'a> {
    schema: u32,
    check: &'a str,
    subject: &'a str,
    precision: &'a str,
    end: &'a str,
    log2_n: Option<f64>,
    n: u64,
    doublings: Option<u32>,
    p: Option<f64>,
    critical: f64,
    effect: Option<f64>,
    effect_name: &'a str,
    finding: Option<&'a str>,
    seed: u64,
}

/// Writes one JSON object a line and claim on a subject. `n` counts the samples of the last level alone; `end` is `failed`,
/// `open`, `full`, `fixed`, `as_far_as_asked`, `not_applicable` or `unavailable`.
///
/// # Errors
///
/// Those of `to`.
pub fn write_json_lines(rows: &[Row<'_>], seed: u64, mut to: impl Write) -> io::Result<()> {
    for row in rows {
        let last = row.steps.last();
        let line = Line {
            schema: SCHEMA,
            check: row.claim.id,
            subject: &row.subject.name,
            precision: row.subject.precision.name(),
            end: row.end_name(),
            log2_n: row.log2_n(),
            n: last.map_or(0, |step| step.n),
            doublings: last.map(|step| step.doublings),
            p: row.p().filter(|p| p.is_finite()),
            critical: row.critical,
            effect: last.and_then(|step| step.effect).filter(|effect| effect.is_finite()),
            effect_name: last.map_or("", |step| &step.effect_name),
            finding: (row.end == Some(End::Failed)).then(|| last.map_or("", |step| &step.seen)),
            seed,
        };
        serde_json::to_writer(&mut to, &line)?;
        to.write_all(b"\n")?;
    }
    Ok(())
}

/// Draws the figure of all rows that have samples.
#[must_use]
pub fn figure(rows: &[Row<'_>]) -> String {
    let label = |row: &Row<'_>| format!("{} in {}", row.subject.name, row.subject.precision);
    let is_one = rows.iter().all(|row| label(row) == label(&rows[0]));
    let bar = |row: &Row<'_>| {
        Some(FailureBar {
            name: if is_one { row.claim.id.to_owned() } else { format!("{}: {}", label(row), row.claim.id) },
            log2_n: row.log2_n()?,
            failed: row.end == Some(End::Failed),
            full: matches!(row.end, Some(End::Full | End::Fixed)),
        })
    };
    let bars: Vec<FailureBar> = rows.iter().filter_map(bar).collect();
    let of = if is_one { rows.first().map(label) } else { None };
    let title = of.map_or("samples until failure".to_owned(), |of| format!("samples until failure: {of}"));
    until_failure(&title, &bars)
}

/// What a state begins with: what another run must have in common with it.
#[derive(Debug, Deserialize, PartialEq, Serialize)]
struct Header {
    state: u32,
    version: String,
    seed: u64,
    budget: String,
    subjects: Vec<String>,
    claims: Vec<String>,
}

impl Header {
    fn of(plan: &Plan<'_>) -> Self {
        Self {
            state: STATE,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            seed: plan.draw.seed,
            budget: plan.draw.budget.name().to_owned(),
            subjects: plan.subjects.iter().map(fingerprint).collect(),
            claims: plan.claims.iter().map(|claim| claim.id.to_owned()).collect(),
        }
    }

    /// Says what of another header keeps a run from going on where it ended; nothing where all is alike.
    fn differs(&self, other: &Self) -> Option<String> {
        let differs = |what: &str, here: &str, there: &str| {
            (here != there).then(|| format!("it is of another {what}: {there}, and not {here}"))
        };
        differs("form", &self.state.to_string(), &other.state.to_string())
            .or_else(|| differs("version", &self.version, &other.version))
            .or_else(|| differs("seed", &self.seed.to_string(), &other.seed.to_string()))
            .or_else(|| differs("budget", &self.budget, &other.budget))
            .or_else(|| differs("subject", &self.subjects.join("; "), &other.subjects.join("; ")))
            .or_else(|| differs("list of claims", &self.claims.join(", "), &other.claims.join(", ")))
    }
}

/// A step as it is kept.
#[derive(Deserialize, Serialize)]
struct Saved {
    subject: usize,
    claim: String,
    doublings: u32,
    n: u64,
    answer: Answer,
    p: Option<f64>,
    effect: Option<f64>,
    effect_name: String,
    seen: String,
    seconds: f64,
}

#[derive(Clone, Copy, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
enum Answer {
    Probability,
    Holds,
    Breaks,
    Inconclusive,
    NotApplicable,
}

impl Saved {
    /// What is kept of a step; nothing of one whose subject could not be run, which may be able to the next time.
    fn of(step: &Step, plan: &Plan<'_>) -> Option<Self> {
        let (answer, p) = match step.conclusion {
            Conclusion::Probability(p) => (Answer::Probability, Some(p)),
            Conclusion::Exact { holds: true } => (Answer::Holds, None),
            Conclusion::Exact { holds: false } => (Answer::Breaks, None),
            Conclusion::Inconclusive => (Answer::Inconclusive, None),
            Conclusion::NotApplicable => (Answer::NotApplicable, None),
            Conclusion::Unavailable => return None,
        };
        Some(Self {
            subject: step.subject,
            claim: plan.claims[step.claim].id.to_owned(),
            doublings: step.doublings,
            n: step.n,
            answer,
            p,
            effect: step.effect.filter(|effect| effect.is_finite()),
            effect_name: step.effect_name.clone(),
            seen: step.seen.clone(),
            seconds: step.seconds,
        })
    }

    fn step(self, plan: &Plan<'_>) -> Option<Step> {
        let conclusion = match (self.answer, self.p) {
            (Answer::Probability, p) => Conclusion::Probability(p?),
            (Answer::Holds, _) => Conclusion::Exact { holds: true },
            (Answer::Breaks, _) => Conclusion::Exact { holds: false },
            (Answer::Inconclusive, _) => Conclusion::Inconclusive,
            (Answer::NotApplicable, _) => Conclusion::NotApplicable,
        };
        Some(Step {
            claim: plan.claims.iter().position(|claim| claim.id == self.claim)?,
            subject: Some(self.subject).filter(|&subject| subject < plan.subjects.len())?,
            doublings: self.doublings,
            conclusion,
            n: self.n,
            effect: self.effect,
            effect_name: self.effect_name,
            seen: self.seen,
            seconds: self.seconds,
        })
    }
}

/// Why a run cannot be continued from a state.
#[derive(Debug, thiserror::Error)]
pub enum StateError {
    /// The file failed.
    #[error("it cannot be read or written")]
    File(#[from] io::Error),
    /// It is of another run, or no state at all.
    #[error("{0}; remove it, or choose another folder with --out")]
    Other(String),
}

/// The file to which every step is added when it is done, so that a run can be continued.
#[derive(Debug)]
pub struct StateFile(File);

impl StateFile {
    /// Opens the state of a plan, or begins one, and returns the steps that it holds. A last line that was not written to its
    /// end is dropped.
    ///
    /// # Errors
    ///
    /// If the file cannot be read or written, is of another plan, or no state.
    pub fn open(path: &Path, plan: &Plan<'_>) -> Result<(Self, Vec<Step>), StateError> {
        let mut file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)?;
        let mut text = String::new();
        file.read_to_string(&mut text)?;
        let whole = text.rfind('\n').map_or(0, |last| last + 1);
        file.set_len(whole as u64)?;
        file.seek(SeekFrom::End(0))?;
        let mut state = Self(file);
        let header = Header::of(plan);
        let mut lines = text[..whole].lines();
        let Some(first) = lines.next() else {
            state.write(&header)?;
            return Ok((state, Vec::new()));
        };
        let wrong = |line: usize| StateError::Other(format!("its line {line} is not one of a state"));
        let found: Header = serde_json::from_str(first).map_err(|_| wrong(1))?;
        if let Some(what) = header.differs(&found) {
            return Err(StateError::Other(what));
        }
        let read = |(index, line): (usize, &str)| {
            let saved: Option<Saved> = serde_json::from_str(line).ok();
            saved.and_then(|saved| saved.step(plan)).ok_or_else(|| wrong(index + 2))
        };
        let steps = lines.enumerate().map(read).collect::<Result<_, _>>()?;
        Ok((state, steps))
    }

    /// Adds a step and waits until it is on the disk.
    ///
    /// # Errors
    ///
    /// If the file cannot be written.
    pub fn add(&mut self, step: &Step, plan: &Plan<'_>) -> io::Result<()> {
        Saved::of(step, plan).map_or(Ok(()), |saved| self.write(&saved))
    }

    fn write(&mut self, line: &impl Serialize) -> io::Result<()> {
        let mut bytes = serde_json::to_vec(line)?;
        bytes.push(b'\n');
        self.0.write_all(&bytes)?;
        self.0.sync_data()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::claims::{cells::ORIGIN, hash::VALUES};
    use crate::check::subject::Precision;
    use crate::check::{Draw, Subject};
    use crate::threshold::hash::HashKind;

    fn plan(seed: u64, hash: HashKind) -> Plan<'static> {
        let subject = Subject::of_hash("hash", Precision::F32, hash);
        Plan::new(&[VALUES, ORIGIN], vec![subject], Draw::seeded(seed), None)
    }

    fn step(claim: usize, doublings: u32, conclusion: Conclusion) -> Step {
        Step {
            claim,
            subject: 0,
            doublings,
            conclusion,
            n: 65_536 << doublings,
            effect: Some(0.25),
            effect_name: "share".to_owned(),
            seen: "too often".to_owned(),
            seconds: 0.5,
        }
    }

    #[test]
    fn a_state_gives_back_what_it_was_given() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("growth.jsonl");
        let plan_0 = plan(0, HashKind::Mm4);
        let (mut state, steps) = StateFile::open(&path, &plan_0).unwrap();
        assert_eq!(steps, []);
        let given = [
            step(0, 0, Conclusion::Probability(0.123_456_789)),
            step(1, 0, Conclusion::Exact { holds: true }),
            step(0, 1, Conclusion::Probability(1e-300)),
        ];
        given.iter().for_each(|step| state.add(step, &plan_0).unwrap());
        state.add(&step(1, 1, Conclusion::Unavailable), &plan_0).unwrap();
        // A line that was cut off by a loss of power.
        state.0.write_all(b"{\"subject\":0,\"cl").unwrap();
        drop(state);
        assert_eq!(StateFile::open(&path, &plan_0).unwrap().1, given);
        assert_eq!(StateFile::open(&path, &plan_0).unwrap().1, given);
        for (other, what) in [
            (plan(1, HashKind::Mm4), "another seed: 0, and not 1; remove it"),
            (plan(0, HashKind::Pcg3d), "another subject: hash in f32"),
        ] {
            let error = StateFile::open(&path, &other).unwrap_err().to_string();
            assert!(error.contains(what), "{error}");
        }
        std::fs::write(&path, "{}\n").unwrap();
        let error = StateFile::open(&path, &plan_0).unwrap_err().to_string();
        assert!(error.starts_with("its line 1 is not one of a state"), "{error}");
    }

    #[test]
    fn a_row_says_where_its_claim_failed_or_up_to_where_it_held() {
        let plan = plan(0, HashKind::Mm4);
        let steps = [
            step(0, 0, Conclusion::Probability(0.5)),
            step(0, 1, Conclusion::Probability(1e-12)),
            step(1, 0, Conclusion::Probability(0.25)),
        ];
        let rows = rows(&plan, &steps);
        let text = table(&rows);
        let line = |start: &str| text.lines().find(|line| line.starts_with(start)).unwrap();
        assert!(
            line("fails").contains("hash.values   hash     f32   17.0     1.0e-12  0.25 share"),
            "{text}"
        );
        assert!(line("holds").contains("cells.origin  hash     f32   >= 16.0  0.25 "), "{text}");
        assert!(text.contains("\n    too often\n") && text.contains(": 1 failed; 1 held so far\n"), "{text}");
        let mut json = Vec::new();
        write_json_lines(&rows, 7, &mut json).unwrap();
        let json = String::from_utf8(json).unwrap();
        let first: serde_json::Value = serde_json::from_str(json.lines().next().unwrap()).unwrap();
        assert_eq!(
            (&first["end"], &first["log2_n"], &first["seed"]),
            (&"failed".into(), &17.0.into(), &7.into())
        );
        assert!(figure(&rows).contains("samples until failure: hash in f32"));
    }
}
