//! Scenes as text: the plan of each take before it runs, and what came out of it.

use crate::render::draw::cost::Cost;
use crate::render::draw::plan::Plan;
use crate::render::effect::{ALL, Effects};
use crate::render::measure::study::{Study, Take};
use crate::render::scene_file::load::Scene;
use crate::report::figure::distance::{Kept, Point, distance};
use serde::Serialize;
use std::collections::BTreeMap;
use std::io::{self, Write};

/// The version of the keys; grows when one changes its meaning or goes.
pub const SCHEMA: u32 = 1;

/// A take as it is planned.
#[derive(Clone, Debug)]
pub struct Planned {
    /// Its effects.
    pub effects: Effects,
    /// Its plan.
    pub plan: Plan,
    /// What all shots will cost.
    pub cost: Cost,
    /// Why the planner chose it, if it did.
    pub reasons: Vec<String>,
}

/// Writes what will run, what it needs and costs, and what will not run and why.
///
/// # Errors
///
/// What the writer says.
pub fn write_plans(scene: &Scene, planned: &[Planned], out: &mut impl Write) -> io::Result<()> {
    write_head(scene, out)?;
    for Planned { effects, plan, cost, reasons } in planned {
        writeln!(out, "\n{}", plan.name)?;
        for reason in reasons {
            writeln!(out, "  chosen   {reason}")?;
        }
        for told in plan.told() {
            writeln!(out, "  runs     {}", told.says)?;
        }
        for need in plan.setup.needs.names() {
            writeln!(out, "  needs    {need}")?;
        }
        writeln!(out, "  costs    {}", quantities(cost))?;
        let skipped = ALL.iter().filter(|known| !known.is_in(effects)).map(|known| known.name);
        writeln!(out, "  skipped  {} (not in the scene file)", skipped.collect::<Vec<_>>().join(", "))?;
    }
    for (table, what) in [
        (scene.file.truth.is_some(), "error to the reference image: no table [truth]"),
        (scene.file.distance.is_some(), "coverage against distance: no table [distance]"),
        (scene.file.layers.is_some(), "correlation of layers: no table [layers]"),
        (scene.file.camera.motion.is_some(), "flips by cause: no table [camera.motion]"),
    ] {
        if !table {
            writeln!(out, "not measured: {what}")?;
        }
    }
    Ok(())
}

fn write_head(scene: &Scene, out: &mut impl Write) -> io::Result<()> {
    let file = &scene.file;
    let figure = file.figure.as_ref().map_or_else(String::new, |figure| format!(" ({figure})"));
    writeln!(out, "{}{figure}", file.name)?;
    if let Some(sentence) = &file.sentence {
        writeln!(out, "  {sentence}")?;
    }
    let [width, height] = file.resolution;
    let (frames, triangles) = (file.frames, scene.mesh.triangles.len());
    writeln!(out, "  {width} x {height} pixels, {frames} frames, {triangles} triangles, seed {}", file.seed)
}

fn quantities(cost: &Cost) -> String {
    let some = cost.quantities().into_iter().filter(|&(_, count)| count > 0);
    some.map(|(name, count)| format!("{count} {name}")).collect::<Vec<_>>().join(", ")
}

/// Writes the measured numbers as a table, a column a take, and what was expected of them.
///
/// # Errors
///
/// What the writer says.
pub fn write_table(scene: &Scene, study: &Study, out: &mut impl Write) -> io::Result<()> {
    write_head(scene, out)?;
    let width = study.takes.iter().map(|take| take.plan.name.chars().count()).max().unwrap_or(0).max(10);
    write!(out, "{:24}", "")?;
    for take in &study.takes {
        write!(out, "  {:>width$}", take.plan.name)?;
    }
    writeln!(out)?;
    for name in names(study) {
        write!(out, "{name:24}")?;
        for take in &study.takes {
            match take.metrics.get(name) {
                Some(value) => write!(out, "  {value:>width$.4}")?,
                None => write!(out, "  {:>width$}", "-")?,
            }
        }
        writeln!(out)?;
    }
    write!(out, "{:24}", "ms a frame")?;
    for take in &study.takes {
        let milliseconds = 1000.0 * take.seconds / take.cost.frames.max(1) as f64;
        write!(out, "  {milliseconds:>width$.2}")?;
    }
    writeln!(out)?;
    for checked in &study.checked {
        writeln!(out, "  {} {}", if checked.holds { "holds" } else { "FAILS" }, checked.text)?;
    }
    Ok(())
}

/// The names of all numbers that some take has.
fn names(study: &Study) -> Vec<&str> {
    let mut names: Vec<&str> =
        study.takes.iter().flat_map(|take| take.metrics.keys().map(String::as_str)).collect();
    names.sort_unstable();
    names.dedup();
    names
}

/// Writes the measured numbers and the counts as CSV, a row a take.
///
/// # Errors
///
/// What the writer says.
pub fn write_csv(study: &Study, out: &mut impl Write) -> io::Result<()> {
    let names = names(study);
    let counts: Vec<&str> = Cost::default().quantities().iter().map(|&(name, _)| name).collect();
    writeln!(out, "take,{},{}", names.join(","), counts.join(","))?;
    for take in &study.takes {
        let quoted = take.plan.name.replace('"', "\"\"");
        write!(out, "\"{quoted}\"")?;
        for name in &names {
            match take.metrics.get(*name) {
                Some(value) => write!(out, ",{value}")?,
                None => write!(out, ",")?,
            }
        }
        for (_, count) in take.cost.quantities() {
            write!(out, ",{count}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// Draws coverage against distance as SVG text; `None` for a scene that is seen from one distance only.
#[must_use]
pub fn distances(scene: &Scene, study: &Study) -> Option<String> {
    let mut factors = scene.file.distance.as_ref()?.factors.clone();
    factors.push(1.0);
    factors.sort_by(f64::total_cmp);
    factors.dedup();
    let at = |take: &Take, name: &str, factor: f64| {
        let key = if factor == 1.0 { name.to_owned() } else { format!("{name}@{factor}") };
        take.metrics.get(&key).copied()
    };
    let line = |take: &Take| Kept {
        name: take.plan.name.clone(),
        points: factors.iter().filter_map(|&x| Some([x, at(take, "coverage", x)?])).collect(),
    };
    // Any take knows what share it has of the truth, if it shows something.
    let right = |x: f64| -> Option<Point> {
        study.takes.iter().find_map(|take| {
            let (coverage, ratio) = (at(take, "coverage", x)?, at(take, "coverage_ratio", x)?);
            (ratio > 0.0).then(|| [x, coverage / ratio])
        })
    };
    let takes: Vec<Kept> = study.takes.iter().map(line).collect();
    let truth: Vec<Point> = factors.iter().filter_map(|&x| right(x)).collect();
    Some(distance(&format!("{}: coverage against distance", scene.file.name), &takes, &truth))
}

/// The keys of a study, in their order.
#[derive(Serialize)]
struct Whole<'a> {
    schema: u32,
    scene: &'a str,
    figure: Option<&'a str>,
    sentence: Option<&'a str>,
    seed: u64,
    resolution: [u32; 2],
    frames: u32,
    notes: Vec<&'a str>,
    takes: Vec<One<'a>>,
    expected: Vec<Expected<'a>>,
}

#[derive(Serialize)]
struct One<'a> {
    take: &'a str,
    stages: Vec<String>,
    needs: Vec<&'static str>,
    cost: BTreeMap<&'static str, u64>,
    metrics: &'a BTreeMap<String, f64>,
}

#[derive(Serialize)]
struct Expected<'a> {
    holds: bool,
    text: &'a str,
}

/// Returns plans, counts and numbers of a scene as one JSON object. Times are not in it, so that equal runs have equal bytes.
///
/// # Errors
///
/// What the encoder says.
pub fn json(scene: &Scene, study: &Study) -> serde_json::Result<String> {
    let take = |take: &'_ Take| -> (Vec<String>, BTreeMap<&'static str, u64>) {
        let stages = take.plan.told().map(|told| told.says.clone()).collect();
        (stages, take.cost.quantities().into_iter().collect())
    };
    let takes = study.takes.iter().map(|one| {
        let (stages, cost) = take(one);
        One { take: &one.plan.name, stages, needs: one.plan.setup.needs.names(), cost, metrics: &one.metrics }
    });
    serde_json::to_string_pretty(&Whole {
        schema: SCHEMA,
        scene: &scene.file.name,
        figure: scene.file.figure.as_deref(),
        sentence: scene.file.sentence.as_deref(),
        seed: scene.file.seed,
        resolution: scene.file.resolution,
        frames: scene.file.frames.get(),
        notes: scene.notes.iter().chain(&study.notes).map(String::as_str).collect(),
        takes: takes.collect(),
        expected: study.checked.iter().map(|c| Expected { holds: c.holds, text: &c.text }).collect(),
    })
}
