//! The outcomes as JSON Lines: one object a claim, in the order in which the claims were tried.

use crate::check::diagnosis::Diagnosis;
use crate::check::domain::Levels;
use crate::check::known::listing_fails;
use crate::check::{Domain, Outcome};
use serde::Serialize;
use std::io::{self, Write};

/// The version of the keys; grows when one changes its meaning or goes.
pub const SCHEMA: u32 = 2;

/// The keys of one line, in their order.
#[derive(Serialize)]
struct Line<'a> {
    schema: u32,
    check: &'a str,
    anchor: &'a str,
    subject: &'a str,
    precision: &'a str,
    verdict: &'a str,
    statistic: Option<f64>,
    n: u64,
    p: Option<f64>,
    p_holm: Option<f64>,
    effect: Option<f64>,
    detectable: Option<f64>,
    seed: u64,
    finding: Option<&'a str>,
    expected: &'a str,
    statement: &'a str,
    statistic_name: &'a str,
    effect_name: &'a str,
    known: Option<&'a str>,
    rounds: u32,
    listing_fails: Option<&'a str>,
    standing: &'a str,
    domain: Option<Sampled>,
    causes: Vec<&'a str>,
}

/// What was sampled. Ranges have both ends; octaves and distances are whole logarithms to base two.
#[derive(Serialize)]
struct Sampled {
    thresholds: u64,
    octaves: Vec<[i32; 2]>,
    log2_distances: Vec<[i32; 2]>,
    octants: u32,
    half_axes: u32,
    log2_ratios: Vec<[i32; 2]>,
    zero_derivatives: Vec<&'static str>,
    lods: Vec<[i32; 2]>,
    layers: Vec<[i32; 2]>,
    frames: usize,
    first_frame: Option<u32>,
    last_frame: Option<u32>,
    hash_scales: Vec<f64>,
    pixels: Option<[f64; 2]>,
    texcoords: Option<[f64; 2]>,
}

impl From<&Domain> for Sampled {
    fn from(domain: &Domain) -> Self {
        let ends = |levels: Levels| {
            levels.ranges().into_iter().map(|range| [*range.start(), *range.end()]).collect::<Vec<_>>()
        };
        Self {
            thresholds: domain.n,
            octaves: ends(domain.octaves),
            log2_distances: ends(domain.distances),
            octants: domain.octants(),
            half_axes: domain.half_axes(),
            log2_ratios: ends(domain.ratios),
            zero_derivatives: domain.zero_derivatives(),
            lods: ends(domain.lods),
            layers: ends(domain.layers),
            frames: domain.frames.len(),
            first_frame: domain.frames.first().copied(),
            last_frame: domain.frames.last().copied(),
            hash_scales: domain.hash_scales(),
            pixels: domain.pixels,
            texcoords: domain.texcoords,
        }
    }
}

impl<'a> Line<'a> {
    fn of(outcome: &'a Outcome, diagnoses: &'a [Diagnosis]) -> Self {
        let own =
            diagnoses.iter().find(|of| of.subject == outcome.subject && of.precision == outcome.precision);
        let found = own.map_or(&[][..], |own| &own.examination.found);
        let finite = |value: Option<f64>| value.filter(|v| v.is_finite());
        Self {
            schema: SCHEMA,
            check: outcome.check,
            anchor: outcome.anchor,
            subject: &outcome.subject,
            precision: outcome.precision.name(),
            verdict: outcome.verdict.name(),
            statistic: finite(outcome.statistic),
            n: outcome.n,
            p: finite(outcome.p),
            p_holm: finite(outcome.p_holm),
            effect: finite(outcome.effect),
            detectable: finite(outcome.detectable),
            seed: outcome.seed,
            finding: outcome.seen.as_deref(),
            expected: outcome.expected.name(),
            statement: outcome.statement,
            statistic_name: &outcome.statistic_name,
            effect_name: outcome.effect_name,
            known: outcome.known.as_deref(),
            rounds: outcome.rounds,
            listing_fails: listing_fails(outcome),
            standing: outcome.standing().name(),
            domain: (outcome.domain.n > 0).then(|| Sampled::from(&outcome.domain)),
            causes: found.iter().map(|found| found.slip.name).collect(),
        }
    }
}

/// Writes one JSON object a line and an outcome.
///
/// Values that are absent or not finite become `null`. Integers (`n`, `seed`) are written in full, up to 2^64 - 1:
/// readers that hold numbers as `f64` round large seeds. The evidence is not written. `causes` names the slips of the subject, in
/// each of its lines.
///
/// # Errors
///
/// Those of `to`.
pub fn write_json_lines(outcomes: &[Outcome], diagnoses: &[Diagnosis], mut to: impl Write) -> io::Result<()> {
    for outcome in outcomes {
        serde_json::to_writer(&mut to, &Line::of(outcome, diagnoses))?;
        to.write_all(b"\n")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::example;
    use super::*;

    fn lines() -> Vec<String> {
        let mut bytes = Vec::new();
        write_json_lines(&example::outcomes(), &[], &mut bytes).unwrap();
        String::from_utf8(bytes).unwrap().lines().map(str::to_owned).collect()
    }

    #[test]
    fn a_line_has_the_promised_keys_in_their_order() {
        assert_eq!(
            lines()[0],
            "{\"schema\":2,\"check\":\"uniform.by_lerp_factor\",\"anchor\":\"§5.4.2, Eq. 2\",\
             \"subject\":\"paper:isotropic\",\"precision\":\"f32\",\"verdict\":\"consistent\",\
             \"statistic\":61.237,\"n\":1048576,\"p\":0.5386,\"p_holm\":1.0,\"effect\":0.0000584,\
             \"detectable\":0.00016,\"seed\":18446744073709551615,\"finding\":null,\"expected\":\"consistent\",\
             \"statement\":\"Thresholds are uniform for every lerp factor.\",\
             \"statistic_name\":\"chi-square, 63 dof\",\"effect_name\":\"excess chi-square per sample\",\"known\":null,\"rounds\":1,\
             \"listing_fails\":null,\"standing\":\"as_expected\",\"domain\":null,\"causes\":[]}"
        );
    }

    #[test]
    fn what_is_not_finite_becomes_null() {
        let lines = lines();
        assert!(lines[1].contains("\"statistic\":null") && lines[4].contains("\"effect\":null"));
        for line in &lines {
            let value: serde_json::Value = serde_json::from_str(line).unwrap();
            assert_eq!(value["schema"], 2);
            assert_eq!(value.as_object().unwrap().len(), 24);
        }
    }
}
