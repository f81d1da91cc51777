//! From the effects of a take to the stages that simulate them.

use super::kind::Rules;
use super::{ALL, Effects};
use crate::render::draw::cost::{Cost, Per};
use crate::render::draw::plan::{Phase, Plan, Text, tell};
use crate::render::draw::work::{Shading, Work};
use crate::render::scene_file::diagnostic::Diagnostic;
use crate::threshold::batch::Tier;
use crate::threshold::fixed::passes;
use crate::threshold::pipeline::{InputColumns, Pipeline, Source};
use glam::vec2;
use rand::Rng;

/// Finds what is wrong with a set of effects: two of them that do not go together, one that needs another. Single numbers
/// are checked as they are read.
///
/// # Errors
///
/// The [`Diagnostic`], whose key is a path within the table of the take.
pub fn check(effects: &Effects) -> Result<(), Diagnostic> {
    let present = ALL.iter().filter_map(|known| Some((known.name, (known.rules)(effects)?)));
    Rules::check(&present.collect::<Vec<_>>())?;
    let plan = plan(effects);
    ALL.iter().try_for_each(|known| (known.check)(effects, &plan).map_err(|wrong| wrong.within(known.name)))
}

/// Makes the plan of a set of effects; no table at all gives the plain alpha test.
#[must_use]
pub fn plan(effects: &Effects) -> Plan {
    let mut plan = Plan::new(effects.name.clone().unwrap_or_else(|| name(effects)));
    let price = [(Per::Frame, Cost::passes(1)), (Per::Fragment, Cost::fragments(1))];
    plan.before(tell("rasterise: fragments of every surface", &price, Text::None), |_| {});
    let price = [(Per::Texel, Cost::texels(1))];
    plan.before(tell("sample alpha: filtered, at the level of the footprint", &price, Text::None), |_| {});
    for known in ALL {
        plan.simulate(Some(known.name));
        (known.plan)(effects, &mut plan);
    }
    plan.simulate(None);
    if let Some(pipeline) = plan.setup.pipeline {
        test(&mut plan, pipeline);
    }
    plan
}

/// Adds the thresholds, the test and what it shows.
fn test(plan: &mut Plan, pipeline: Pipeline) {
    let reads = pipeline.reads();
    let needs = &mut plan.setup.needs;
    needs.footprint |= reads.footprint;
    needs.layer |= reads.layer;
    needs.lod |= reads.lod;
    needs.frame |= reads.frame || reads.random;
    needs.pixel |= reads.pixel;
    let says = match pipeline.source {
        Source::Fixed(threshold) if pipeline.uses_source() && plan.setup.yields_to_material => {
            format!("threshold: {threshold} for all, or what a material has of its own")
        }
        Source::Fixed(threshold) if pipeline.uses_source() => format!("threshold: {threshold} for all"),
        Source::Given | Source::Stipple { .. } | Source::Fixed(_) => "threshold: as found".to_owned(),
        Source::Stochastic | Source::Hash(_) | Source::ScreenDoor(_) => {
            "threshold: clamped into [2^-24, 1], last".to_owned()
        }
    };
    let each = Cost::hashes(pipeline.hashes()) + Cost::randoms(pipeline.randoms());
    let told = tell(says, &[(Per::Fragment, each)], Text::None);
    plan.shade(Phase::Threshold, told, move |shading, work, _| thresholds(&pipeline, shading, work));
    let told = tell("test: keep where alpha >= threshold", &[(Per::Threshold, Cost::tests(1))], Text::None);
    plan.shade(Phase::Test, told, |shading, work, _| keep(shading, work));
    let told = tell("resolve: the nearest that is kept", &[], Text::None);
    plan.shade(Phase::Resolve, told, |shading, work, result| shading.resolve(work, result));
}

/// A name made of the tables that are present.
fn name(effects: &Effects) -> String {
    let present: Vec<&str> =
        ALL.iter().filter(|known| known.is_in(effects)).map(|known| known.name).collect();
    if present.is_empty() { "alpha test".to_owned() } else { present.join(" + ") }
}

/// Finds the thresholds of all fragments, those of the samples of one side by side.
fn thresholds(pipeline: &Pipeline, shading: &Shading<'_>, work: &mut Work) {
    let Work { fragments, access, given, threshold, rng, .. } = work;
    let reads = pipeline.reads();
    let all = || 0..fragments.len();
    let (mut pixel, mut lod, mut texel) = (Vec::new(), Vec::new(), Vec::new());
    if reads.pixel {
        pixel.extend(all().map(|at| shading.place(fragments, at)));
    }
    if reads.lod {
        lod.extend(access.iter().map(|access| access.lod));
    }
    if reads.texel {
        texel.extend(all().map(|at| {
            let [width, height] = shading.texture(fragments.triangle[at]).levels[0].size;
            let texels = vec2(width as f32, height as f32);
            [fragments.dtdx[at], fragments.dtdy[at]].map(|change| (change * texels).length())
        }));
    }
    let inputs = InputColumns {
        footprint: fragments.footprint.columns(),
        pixel: &pixel,
        frame: shading.frame,
        layer: &fragments.layer,
        lod: &lod,
        texel: &texel,
        given,
    };
    threshold.clear();
    threshold.resize(fragments.len() * pipeline.samples().get() as usize, 0.0);
    pipeline.thresholds(Tier::BitExact, &inputs, &mut || rng.next_u32(), threshold);
}

/// Tests each fragment against its thresholds: one a sample, or one for all of them.
fn keep(shading: &Shading<'_>, work: &mut Work) {
    let all = u64::MAX >> (u64::BITS - shading.setup.samples.get());
    let each = work.threshold.len() / work.fragments.len();
    for (at, (&alpha, thresholds)) in work.tested.iter().zip(work.threshold.chunks_exact(each)).enumerate() {
        let kept = if let [one] = thresholds {
            if passes(alpha, *one) { all } else { 0 }
        } else {
            thresholds.iter().enumerate().map(|(i, &t)| u64::from(passes(alpha, t)) << i).sum()
        };
        work.kept.push(kept & work.fragments.covered.get(at).unwrap_or(&all));
    }
}
