//! A row of the table: a sentence of a source, and the function that measures it.

use std::fmt::Write as _;

/// What the measurement says of the sentence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It holds as it stands.
    Confirmed,
    /// It holds under a condition that it does not state, or for another reason.
    Refined,
    /// It does not hold.
    Refuted,
}

impl Verdict {
    pub const ALL: [Self; 3] = [Self::Confirmed, Self::Refined, Self::Refuted];

    pub const fn name(self) -> &'static str {
        match self {
            Self::Confirmed => "confirmed",
            Self::Refined => "refined",
            Self::Refuted => "refuted",
        }
    }

    /// The end of a line with this verdict.
    pub fn at_end(self) -> String {
        format!("| {} |", self.name())
    }
}

/// What a measurement found.
pub struct Measured {
    /// Samples that it rests on.
    pub n: u64,
    pub verdict: Verdict,
    /// The figures, in words.
    pub seen: String,
}

/// Judges a sentence: it holds as said, or under the condition that the figures show, or not at all.
pub fn judge(n: impl TryInto<u64>, as_said: bool, under_a_condition: bool, seen: String) -> Measured {
    let verdict = match (as_said, under_a_condition) {
        (true, _) => Verdict::Confirmed,
        (false, true) => Verdict::Refined,
        (false, false) => Verdict::Refuted,
    };
    Measured { n: n.try_into().unwrap_or(u64::MAX), verdict, seen }
}

/// A sentence of a source, in words of ours.
pub struct Row {
    /// By this name it is measured again.
    pub id: &'static str,
    /// Section, equation or figure.
    pub place: &'static str,
    pub sentence: &'static str,
    pub measure: fn() -> Measured,
}

/// A source and its rows.
pub struct Source {
    pub title: &'static str,
    pub rows: Vec<&'static Row>,
}

/// Writes a row as a line of the table.
pub fn line(row: &Row, measured: &Measured) -> String {
    let mut line = String::new();
    let Measured { n, verdict, seen } = measured;
    let _ =
        write!(line, "| `{}` | {} | {} | {seen} | {n} {}", row.id, row.place, row.sentence, verdict.at_end());
    line
}
