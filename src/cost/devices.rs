//! The price list on a device: what each effect adds to the test of a fragment there, by the device's own clock.
//!
//! A row is the shader of a pipeline, called over fragments that the device draws itself: nothing is sent, and all that is
//! fetched is how many samples a fragment keeps. Several samples a fragment are as many calls of the text; what they share is
//! for the driver to find.

use super::Effort;
use super::clock::turns;
use super::effects::{EFFECTS, EIGHT, Effect, HASHED, Price, Test, listed, row};
use crate::shader::assemble::{ShaderOptions, assemble};
use crate::shader::gpu::{Device, Error, Kernel, Program};
use crate::threshold::batch::Tier;
use crate::threshold::hash::HashKind;
use crate::threshold::model::Model;
use crate::threshold::pipeline::{Pipeline, Source};
use crate::threshold::robust::{Join, Robust};
use crate::threshold::two_scale::Variant;
use std::time::{Duration, Instant};

const DITHERED: Robust = Robust { join: Join::Dithered, ..Robust::new(Variant::Anisotropic) };

/// Rows that only a device has.
const MORE: [Effect; 2] = [
    row("hashed, mm4", "not in the paper", "fixed", HASHED.with_hash(HashKind::Mm4)),
    row(
        "robust anisotropic, dithered",
        "not in the paper",
        "fixed",
        Pipeline::of(Source::Hash(Model::Robust(DITHERED))),
    ),
];

/// The rows of the CPU's list that are a shader, and those that only a device has.
fn effects() -> impl Iterator<Item = &'static Effect> {
    let is_shader = |effect: &&Effect| {
        effect.tier == Tier::BitExact && effect.test == Test::Alpha && assemble(effect.pipeline).is_ok()
    };
    EFFECTS.iter().filter(is_shader).chain(&MORE)
}

/// How many steps [`prices`] reports.
#[must_use]
pub fn steps(effort: Effort) -> u64 {
    effort.pick(2, 16)
}

/// Measures the price list of a device, drawing of the fragment and test included, all rows in turns; `done` is called after
/// each of [`steps`] steps.
///
/// Times are those of the device's own clock where [it has one](Device::has_timestamps), and a wall clock's otherwise, which
/// counts transfers too.
///
/// # Errors
///
/// What the device says where it cannot go on.
pub fn prices(device: &Device, effort: Effort, done: &dyn Fn()) -> Result<Vec<Price>, Error> {
    let programs: Vec<Program> =
        effects().map(|effect| device.compile(&kernel(effect.pipeline)?)).collect::<Result<_, Error>>()?;
    // Drivers finish a program when it is first run.
    programs.iter().try_for_each(|program| program.draw(0, 1).map(drop))?;
    let fragments = effort.pick(1 << 16, 1 << 20);
    let rows: Vec<_> = effects().map(|effect| [effect.name, effect.source, effect.over]).collect();
    let mut failed = None;
    let times = turns(
        programs.len(),
        steps(effort) as usize,
        |row, round| match time(&programs[row], round as u32, fragments) {
            Ok(time) => time.as_secs_f64() * 1e9 / f64::from(fragments),
            Err(error) => {
                failed.get_or_insert(error);
                f64::NAN
            }
        },
        done,
    );
    match failed {
        Some(error) => Err(error),
        None => Ok(listed(&rows, &times)),
    }
}

fn kernel(pipeline: Pipeline) -> Result<Kernel, Error> {
    let options = ShaderOptions::from(pipeline);
    let text = assemble(options).map_err(|error| Error::Validation(error.to_string()))?;
    let names: Vec<&str> = options.parameters().iter().map(|parameter| parameter.name).collect();
    let samples = if names.contains(&"sample_index") { EIGHT.get() } else { 1 };
    let drawn = include_str!("drawn_fragment.wgsl")
        .replace("SAMPLES", &format!("{samples}u"))
        .replace("ARGUMENTS", &names.join(", "));
    Ok(Kernel::of_drawn_words(&format!("{text}\n{drawn}"), 1, "array(kept())"))
}

fn time(program: &Program, round: u32, fragments: u32) -> Result<Duration, Error> {
    let start = Instant::now();
    let drawn = program.draw(round, fragments)?;
    Ok(drawn.time.unwrap_or_else(|| start.elapsed()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_is_an_addition_to_one_that_is_listed_and_a_valid_shader() {
        assert_eq!(effects().count(), 23);
        for Effect { name, over, pipeline, .. } in effects() {
            assert!(effects().any(|effect| effect.name == *over), "{name}");
            assert_eq!(effects().filter(|effect| effect.name == *name).count(), 1);
            let kernel = kernel(*pipeline).expect("the options can be written");
            let module = naga::front::wgsl::parse_str(&kernel.source).expect(name);
            let mut validator = naga::valid::Validator::new(
                naga::valid::ValidationFlags::all(),
                naga::valid::Capabilities::default(),
            );
            validator.validate(&module).expect(name);
        }
    }
}
