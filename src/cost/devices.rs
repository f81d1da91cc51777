//! The price list on a device: what each effect adds to the test of a fragment there, by the device's own clock.
//!
//! A row is a shader of [`assemble`], called over fragments that the device draws itself: nothing is sent, and all that is
//! fetched is how many samples a fragment keeps. Several samples a fragment are as many calls of the text; what they share is
//! for the driver to find.

use super::Effort;
use super::clock::{Time, turns};
use super::effects::Price;
use crate::shader::assemble::{
    Coverage, FadeIn, ScreenDoor, ShaderOptions, Source, Strata, Stratify, assemble,
};
use crate::shader::gpu::{Device, Error, Kernel, Program};
use crate::technique::order::Order;
use crate::technique::stipple::Density;
use crate::threshold::hash::HashKind;
use crate::threshold::robust::Join;
use crate::threshold::two_scale::Variant;
use core::num::NonZeroU16;
use std::time::{Duration, Instant};

/// Frames, and samples of a pixel, as in the paper's figures.
const EIGHT: NonZeroU16 = NonZeroU16::new(8).unwrap();

/// The levels of detail over which noise fades in (§7.1).
const FADE_IN: FadeIn = FadeIn { full_noise_lod: 6.0, anisotropy: false };

const OVER_FRAMES: Stratify = Stratify { frames: EIGHT, order: Order::Ascending };

const fn samples(strata: Strata) -> Option<Coverage> {
    Some(Coverage { samples: EIGHT, strata })
}

/// The rows: a name, its place in the sources, the row that it is an addition to, and what the shader does.
const ROWS: &[(&str, &str, &str, ShaderOptions)] = {
    const LISTING: ShaderOptions = ShaderOptions::listing(Variant::Isotropic);
    const LISTING_2: ShaderOptions = ShaderOptions::listing(Variant::Anisotropic);
    const ROBUST: ShaderOptions = ShaderOptions::robust(Variant::Isotropic);
    const ROBUST_2: ShaderOptions = ShaderOptions::robust(Variant::Anisotropic);
    const fn of(source: Source) -> ShaderOptions {
        ShaderOptions { source, ..LISTING }
    }
    &[
        ("fixed", "§1", "fixed", of(Source::Fixed)),
        ("stochastic", "§4", "fixed", of(Source::Stochastic)),
        ("hashed", "Listing 1", "fixed", LISTING),
        ("hashed, mm4", "not in the paper", "fixed", ShaderOptions { hash: HashKind::Mm4, ..LISTING }),
        ("anisotropic", "Listing 2", "fixed", LISTING_2),
        ("robust", "not in the paper", "fixed", ROBUST),
        ("robust anisotropic, copula", "not in the paper", "fixed", ROBUST_2),
        (
            "robust anisotropic, dithered",
            "not in the paper",
            "fixed",
            ShaderOptions { source: Source::Robust(Join::Dithered), ..ROBUST_2 },
        ),
        ("hashed, fade-in", "Eqs. 4, 5", "hashed", ShaderOptions { fade_in: Some(FADE_IN), ..LISTING }),
        (
            "hashed, fade-in by anisotropy",
            "§7.1.1",
            "hashed",
            ShaderOptions { fade_in: Some(FadeIn { anisotropy: true, ..FADE_IN }), ..LISTING },
        ),
        (
            "hashed, over 8 frames",
            "Eq. 6",
            "hashed",
            ShaderOptions { stratify: Some(OVER_FRAMES), ..LISTING },
        ),
        ("alpha to coverage, 8 regular", "Eq. 7", "fixed", of(Source::Regular(EIGHT))),
        ("alpha to coverage, 8 by pixel", "Humus 2009", "fixed", of(Source::PixelMask(EIGHT))),
        (
            "hashed, 8 jittered samples",
            "Eq. 8",
            "hashed",
            ShaderOptions { coverage: samples(Strata::InOrder), ..LISTING },
        ),
        (
            "hashed, 8 decorrelated samples",
            "Eq. 9",
            "hashed",
            ShaderOptions { coverage: samples(Strata::Decorrelated), ..LISTING },
        ),
        (
            "hashed, 8 shuffled samples",
            "§3 (Enderton et al. 2010)",
            "hashed",
            ShaderOptions { coverage: samples(Strata::Shuffled), ..LISTING },
        ),
        ("screen door, fixed", "§3", "fixed", of(Source::ScreenDoor(ScreenDoor::Fixed))),
        ("screen door, random mask", "§8.1", "fixed", of(Source::ScreenDoor(ScreenDoor::RandomMask(1)))),
        ("screen door, hashed", "§8.1", "fixed", of(Source::ScreenDoor(ScreenDoor::Randomised))),
        ("stipple", "Ols 2009", "fixed", of(Source::Stipple(Density::High))),
        (
            "hashed, over 8 frames, 8 jittered samples",
            "§8",
            "hashed",
            ShaderOptions { stratify: Some(OVER_FRAMES), coverage: samples(Strata::InOrder), ..LISTING },
        ),
        (
            "anisotropic, fade-in, over 8 frames",
            "§7",
            "anisotropic",
            ShaderOptions { fade_in: Some(FADE_IN), stratify: Some(OVER_FRAMES), ..LISTING_2 },
        ),
    ]
};

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
        ROWS.iter().map(|(.., options)| device.compile(&kernel(options)?)).collect::<Result<_, Error>>()?;
    // Drivers finish a program when it is first run.
    programs.iter().try_for_each(|program| program.draw(0, 1).map(drop))?;
    let fragments = effort.pick(1 << 16, 1 << 20);
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
        None => Ok(listed(&times)),
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

fn listed(times: &[Time]) -> Vec<Price> {
    let median =
        |name: &str| ROWS.iter().position(|row| row.0 == name).map_or(f64::NAN, |at| times[at].median);
    let price = |(&(name, source, over, _), time): (&(_, _, _, _), &Time)| Price {
        name,
        source,
        over,
        ns_min: time.min,
        ns_median: time.median,
        marginal: if name == over { 0.0 } else { time.median - median(over) },
        over_fixed: time.median / median("fixed"),
    };
    ROWS.iter().zip(times).map(price).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_is_an_addition_to_one_that_is_listed_and_a_valid_shader() {
        for (name, _, over, options) in ROWS {
            assert!(ROWS.iter().any(|row| row.0 == *over), "{name}");
            assert_eq!(ROWS.iter().filter(|row| row.0 == *name).count(), 1);
            let kernel = kernel(options).expect("the options can be written");
            let module = naga::front::wgsl::parse_str(&kernel.source).expect(name);
            let mut validator = naga::valid::Validator::new(
                naga::valid::ValidationFlags::all(),
                naga::valid::Capabilities::default(),
            );
            validator.validate(&module).expect(name);
        }
    }

    #[test]
    fn the_price_of_an_effect_is_its_middle_round_less_that_of_its_base() {
        let times: Vec<Time> =
            (1..=ROWS.len()).map(|k| Time { min: k as f64, median: 10.0 * k as f64 }).collect();
        let found = listed(&times);
        let at = |name: &str| found.iter().position(|price| price.name == name).expect("a row");
        assert_eq!((found[at("fixed")].marginal, found[at("fixed")].over_fixed), (0.0, 1.0));
        let [base, effect] = ["hashed", "hashed, fade-in"].map(at);
        assert_eq!(found[effect].marginal, 10.0 * (effect - base) as f64);
    }
}
