//! The hashes of the list: what is known of each as a table for a terminal, what was measured of each as JSON Lines, Markdown and a figure.

use super::cost::table::Table;
use super::figure::hashes::{Hashed, hashes};
use crate::check::catalogue::{Quality, quality, range_in_half, range_in_single};
use crate::check::grain::{Plane, grain, zoom_flips};
use crate::check::{Claim, Precision, Subject};
use crate::cost::hashes::{HashTime, operations};
use crate::threshold::hash::HashKind;
use crate::threshold::robust::Robust;
use crate::threshold::two_scale::Variant;
use serde::{Deserialize, Serialize};

/// What was measured of a hash without a clock: of equal claims and doublings always the same.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Measured {
    /// Its name.
    pub hash: String,
    /// How often samples were doubled at most.
    pub doublings: u32,
    /// How many claims there are about a hash alone.
    pub claims: usize,
    /// Those that reject it, the fewest samples first.
    pub rejected_by: Vec<RejectedBy>,
    /// Logarithm to base two of the most samples that a claim has had.
    pub log2_most: f64,
    /// The largest k up to which indices between 2^k and 2^(k + 1) are hashed to uniform values, not a few, in `f32`.
    pub range: Option<u32>,
    /// The same in half precision.
    pub range_in_half: Option<u32>,
    /// Operations of WGSL in a robust threshold with one scale.
    pub operations: u64,
    /// Grain on axis planes at an alpha of 1/4, under the robust threshold with one scale.
    pub grain: f64,
    /// Share of pixels that appear or vanish in 1/8 of a pixel of motion, there.
    pub flips: f64,
    /// Changes of a point in an octave of zoom at an alpha of 1/2.
    pub flips_an_octave: f64,
}

/// A claim that rejects a hash.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct RejectedBy {
    /// Its name.
    pub claim: String,
    /// How often its samples were doubled.
    pub doublings: u32,
    /// Logarithm to base two of its samples.
    pub log2_n: f64,
}

/// Nanoseconds of a hash, as [`HashTime`] has them.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Nanoseconds {
    /// One cell after the other.
    pub alone: f64,
    /// A cell among thousands.
    pub batch: f64,
    /// A robust threshold with one scale, in a batch.
    pub threshold: f64,
}

impl From<HashTime> for Nanoseconds {
    fn from(HashTime { alone, batch, threshold }: HashTime) -> Self {
        Self { alone, batch, threshold }
    }
}

/// A hash of the catalogue.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Entry {
    /// What was measured without a clock.
    #[serde(flatten)]
    pub measured: Measured,
    /// What was measured with one, in a run in which all hashes took turns.
    pub nanoseconds: Nanoseconds,
}

impl Measured {
    /// Measures a hash.
    ///
    /// # Errors
    ///
    /// In words, where its threshold is none.
    pub fn new(kind: HashKind, claims: &[Claim], doublings: u32) -> Result<Self, String> {
        let Quality { claims, rejections, log2_most } = quality(kind, claims, doublings);
        let robust = Robust { hash: kind, ..Robust::new(Variant::Isotropic) };
        let subject = Subject::robust(kind.name(), Precision::F32, robust);
        let on_axes = grain(&subject, 0)?;
        let quarter = on_axes.iter().find(|found| found.plane == Plane::Axis && found.alpha == 0.25);
        let quarter = quarter.ok_or("nothing was measured on axis planes")?;
        let half = zoom_flips(&subject, 0)?.into_iter().find(|found| found.alpha == 0.5);
        let rejected_by = rejections
            .into_iter()
            .map(|found| RejectedBy {
                claim: found.claim.to_owned(),
                doublings: found.doublings,
                log2_n: rounded(found.log2_n),
            })
            .collect();
        Ok(Self {
            hash: kind.name().to_owned(),
            doublings,
            claims,
            rejected_by,
            log2_most: rounded(log2_most),
            range: range_in_single(kind),
            range_in_half: range_in_half(kind),
            operations: operations(kind).map_err(|error| error.to_string())?,
            grain: rounded(quarter.grain),
            flips: rounded(quarter.flips),
            flips_an_octave: rounded(half.ok_or("nothing was measured at an alpha of 1/2")?.flips),
        })
    }
}

/// To four digits after the point.
fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

/// What the list says of its hashes, without a measurement.
#[must_use]
pub fn list(kinds: &[HashKind]) -> Table {
    let yes = |is: bool| if is { "yes" } else { "no" }.to_owned();
    let row = |&kind: &HashKind| {
        vec![
            kind.name().to_owned(),
            yes(kind.is_exact()),
            yes(kind.reads_octave()),
            repeat(kind),
            operations(kind).map_or_else(|_| "-".to_owned(), |count| count.to_string()),
            kind.about().replace('`', ""),
        ]
    };
    Table {
        headings: vec![
            "hash",
            "same bits everywhere",
            "reads the octave",
            "repeats after",
            "operations",
            "what it is",
        ],
        rows: kinds.iter().map(row).collect(),
    }
}

/// The length of its shortest vector of repetition, in cells.
fn repeat(kind: HashKind) -> String {
    kind.repeats_after().map_or_else(
        || "-".to_owned(),
        |vector| {
            let square: f64 = vector.iter().map(|&c| f64::from(c) * f64::from(c)).sum();
            format!("{:.0}", square.sqrt())
        },
    )
}

/// The entries as a table, those that no claim rejects first, and the one with the fastest threshold of each kind first.
#[must_use]
pub fn table(entries: &[Entry]) -> Table {
    let row = |entry: &&Entry| {
        let Entry { measured, nanoseconds } = entry;
        let size = |k: Option<u32>| k.map_or_else(|| "none".to_owned(), |k| format!("2^{}", k + 1));
        let repeats = measured.hash.parse().map_or_else(|_| "-".to_owned(), repeat);
        let (fails, at, count) = match measured.rejected_by.as_slice() {
            [] => ("-".to_owned(), format!("> 2^{:.0}", measured.log2_most.floor()), "0".to_owned()),
            all @ [first, ..] => (
                first.claim.clone(),
                format!("2^{:.1}", first.log2_n),
                format!("{} of {}", all.len(), measured.claims),
            ),
        };
        let time = |ns: f64| format!("{ns:.2}");
        vec![
            measured.hash.clone(),
            at,
            fails,
            count,
            repeats,
            size(measured.range),
            size(measured.range_in_half),
            format!("{:.2}", measured.grain),
            format!("{:.3}", measured.flips),
            format!("{:.3}", measured.flips_an_octave),
            measured.operations.to_string(),
            time(nanoseconds.alone),
            time(nanoseconds.batch),
            time(nanoseconds.threshold),
        ]
    };
    Table {
        headings: vec![
            "hash",
            "samples to failure",
            "first rejected by",
            "claims that reject it",
            "repeats after",
            "indices up to",
            "in half precision",
            "grain",
            "flips at 1/8 pixel",
            "flips an octave",
            "operations",
            "ns one at a time",
            "ns batch",
            "ns threshold",
        ],
        rows: ranked(entries).iter().map(row).collect(),
    }
}

/// The entries, those that no claim rejects first, then by the time of a threshold.
fn ranked(entries: &[Entry]) -> Vec<&Entry> {
    let mut all: Vec<&Entry> = entries.iter().collect();
    all.sort_by(|a, b| {
        let key = |entry: &Entry| !entry.measured.rejected_by.is_empty();
        key(a).cmp(&key(b)).then(a.nanoseconds.threshold.total_cmp(&b.nanoseconds.threshold))
    });
    all
}

/// The figure of [`table`].
#[must_use]
pub fn figure(entries: &[Entry]) -> String {
    let of = |entry: &&Entry| {
        let first = entry.measured.rejected_by.first();
        Hashed {
            name: entry.measured.hash.clone(),
            ns: entry.nanoseconds.batch,
            log2_n: first.map_or(entry.measured.log2_most, |first| first.log2_n),
            rejected: first.is_some(),
            flips: entry.measured.flips_an_octave,
        }
    };
    hashes(
        "Hashes: time, samples until a claim fails, flicker",
        &ranked(entries).iter().map(of).collect::<Vec<_>>(),
    )
}

/// One JSON object an entry.
///
/// # Errors
///
/// None that can happen: what is written are numbers and names.
pub fn json_lines(entries: &[Entry]) -> serde_json::Result<String> {
    entries.iter().map(|entry| Ok(serde_json::to_string(entry)? + "\n")).collect()
}

/// Reads what [`json_lines`] wrote.
///
/// # Errors
///
/// The first line that is no entry.
pub fn entries(text: &str) -> serde_json::Result<Vec<Entry>> {
    text.lines().map(serde_json::from_str).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(hash: HashKind, rejected: bool, batch: f64) -> Entry {
        let by = RejectedBy { claim: "uniform.marginal".to_owned(), doublings: 1, log2_n: 14.25 };
        let measured = Measured {
            hash: hash.name().to_owned(),
            doublings: 3,
            claims: 29,
            rejected_by: if rejected { vec![by] } else { Vec::new() },
            log2_most: 20.0,
            range: Some(29),
            range_in_half: None,
            operations: 120,
            grain: 1.25,
            flips: 0.07,
            flips_an_octave: 0.5,
        };
        Entry { measured, nanoseconds: Nanoseconds { alone: 3.0, batch, threshold: 4.0 + batch } }
    }

    #[test]
    fn what_no_claim_rejects_comes_first_and_is_read_back() {
        let all = [
            entry(HashKind::Weyl, true, 0.5),
            entry(HashKind::Mm4, false, 1.1),
            entry(HashKind::LowbiasLinear, false, 0.7),
        ];
        let found = table(&all);
        let names: Vec<&str> = found.rows.iter().map(|row| row[0].as_str()).collect();
        assert_eq!(names, ["lowbias-linear", "mm4", "weyl"]);
        assert_eq!(found.rows[0][1..6], ["> 2^20", "-", "0", "1774", "2^30"]);
        assert_eq!(found.rows[2][1..4], ["2^14.2", "uniform.marginal", "1 of 29"]);
        let text = json_lines(&all).expect("numbers and names");
        assert_eq!(entries(&text).expect("what was written"), all);
        assert!(entries("{}").is_err());
    }

    #[test]
    fn the_list_has_every_hash() {
        let found = list(&HashKind::ALL);
        assert_eq!(found.rows.len(), HashKind::ALL.len());
        assert!(found.aligned().contains("lowbias-linear"), "{}", found.aligned());
    }
}
