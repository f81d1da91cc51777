//! The price list on a device: what each effect adds to the test of a fragment there, by the device's own clock.
//!
//! A row is a shader of [`assemble`], called over fragments that the device draws itself: nothing is sent, and all that is
//! fetched is how many samples a fragment keeps. Several samples a fragment are as many calls of the text; what they share is
//! for the driver to find.

use super::Effort;
use super::clock::turns;
use super::effects::{Price, listed};
use crate::shader::assemble::{
    Coverage, FadeIn, ScreenDoor, ShaderOptions, Source, Strata, Stratify, assemble,
};
use crate::shader::gpu::{Device, Error, Kernel, Program};
use crate::threshold::hash::HashKind;
use crate::threshold::robust::Join;
use crate::threshold::stage::order::Order;
use crate::threshold::stage::stipple::Density;
use crate::threshold::two_scale::Variant;
use core::num::NonZeroU16;
use std::time::{Duration, Instant};

/// Frames, and samples of a pixel, as in the paper's figures.
const EIGHT: NonZeroU16 = NonZeroU16::new(8).unwrap();

/// One line of the list; names, places and bases are those of the CPU's list where both have the row.
struct Effect {
    name: &'static str,
    /// Where the sources have it.
    source: &'static str,
    /// The row to which it is an addition; itself for none.
    over: &'static str,
    shader: ShaderOptions,
}

const HASHED: ShaderOptions = ShaderOptions::listing(Variant::Isotropic);
const ANISOTROPIC: ShaderOptions = ShaderOptions::listing(Variant::Anisotropic);
const COPULA: ShaderOptions = ShaderOptions::robust(Variant::Anisotropic);

#[rustfmt::skip]
const EFFECTS: &[Effect] = &[
    row("fixed", "§1", "fixed", of(Source::Fixed)),
    row("stochastic", "§4", "fixed", of(Source::Stochastic)),
    row("hashed", "Listing 1", "fixed", HASHED),
    row("hashed, mm4", "not in the paper", "fixed", ShaderOptions { hash: HashKind::Mm4, ..HASHED }),
    row("anisotropic", "Listing 2", "fixed", ANISOTROPIC),
    row("robust", "not in the paper", "fixed", ShaderOptions::robust(Variant::Isotropic)),
    row("robust anisotropic", "not in the paper", "fixed", COPULA),
    row("robust anisotropic, dithered", "not in the paper", "fixed", ShaderOptions { source: Source::Robust(Join::Dithered), ..COPULA }),
    row("hashed, fade-in", "Eqs. 4, 5", "hashed", faded(HASHED, false)),
    row("hashed, fade-in by anisotropy", "§7.1.1", "hashed", faded(HASHED, true)),
    row("hashed, over 8 frames", "Eq. 6", "hashed", over_frames(HASHED)),
    row("alpha to coverage, 8 regular", "Eq. 7", "fixed", of(Source::Regular(EIGHT))),
    row("alpha to coverage, 8 by pixel", "Humus 2009", "fixed", of(Source::PixelMask(EIGHT))),
    row("hashed, 8 jittered samples", "Eq. 8", "hashed", sampled(HASHED, Strata::InOrder)),
    row("hashed, 8 decorrelated samples", "Eq. 9", "hashed", sampled(HASHED, Strata::Decorrelated)),
    row("hashed, 8 shuffled samples", "§3 (Enderton et al. 2010)", "hashed", sampled(HASHED, Strata::Shuffled)),
    row("screen door, fixed", "§3", "fixed", of(Source::ScreenDoor(ScreenDoor::Fixed))),
    row("screen door, random", "§3", "fixed", of(Source::ScreenDoor(ScreenDoor::RandomMask(0)))),
    row("screen door, hashed", "§8.1", "fixed", of(Source::ScreenDoor(ScreenDoor::Randomised))),
    row("stipple", "Ols 2009", "fixed", of(Source::Stipple(Density::High))),
    // What the paper combines.
    row("hashed, over 8 frames, 8 decorrelated samples", "§7.2, §8", "hashed", sampled(over_frames(HASHED), Strata::Decorrelated)),
    row("anisotropic, over 8 frames, fade-in by anisotropy", "§7", "anisotropic", faded(over_frames(ANISOTROPIC), true)),
];

const fn row(name: &'static str, source: &'static str, over: &'static str, shader: ShaderOptions) -> Effect {
    Effect { name, source, over, shader }
}

const fn of(source: Source) -> ShaderOptions {
    ShaderOptions { source, ..HASHED }
}

/// Noise that fades in over six levels of detail (§7.1).
const fn faded(base: ShaderOptions, anisotropy: bool) -> ShaderOptions {
    ShaderOptions { fade_in: Some(FadeIn { full_noise_lod: 6.0, anisotropy }), ..base }
}

const fn over_frames(base: ShaderOptions) -> ShaderOptions {
    ShaderOptions { stratify: Some(Stratify { frames: EIGHT, order: Order::Ascending }), ..base }
}

const fn sampled(base: ShaderOptions, strata: Strata) -> ShaderOptions {
    ShaderOptions { coverage: Some(Coverage { samples: EIGHT, strata }), ..base }
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
    let programs: Vec<Program> = EFFECTS
        .iter()
        .map(|effect| device.compile(&kernel(&effect.shader)?))
        .collect::<Result<_, Error>>()?;
    // Drivers finish a program when it is first run.
    programs.iter().try_for_each(|program| program.draw(0, 1).map(drop))?;
    let fragments = effort.pick(1 << 16, 1 << 20);
    let rows: Vec<_> = EFFECTS.iter().map(|effect| [effect.name, effect.source, effect.over]).collect();
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

fn kernel(options: &ShaderOptions) -> Result<Kernel, Error> {
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
        for Effect { name, over, shader, .. } in EFFECTS {
            assert!(EFFECTS.iter().any(|effect| effect.name == *over), "{name}");
            assert_eq!(EFFECTS.iter().filter(|effect| effect.name == *name).count(), 1);
            let kernel = kernel(shader).expect("the options can be written");
            let module = naga::front::wgsl::parse_str(&kernel.source).expect(name);
            let mut validator = naga::valid::Validator::new(
                naga::valid::ValidationFlags::all(),
                naga::valid::Capabilities::default(),
            );
            validator.validate(&module).expect(name);
        }
    }
}
