//! `shader`: the verified threshold as text, in the language of an engine.

use super::args::ShaderTextArgs;
use super::failure::Failure;
use super::{Ending, output};
use hashed_alpha::report::directory::write_atomically;
use hashed_alpha::shader::assemble::{HashScale, ShaderOptions};
use hashed_alpha::shader::export::{Language, export};
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::model::Model;
use hashed_alpha::threshold::robust::{Join, Preset, Repairs, Robust};
use hashed_alpha::threshold::two_scale::Variant;
use std::io::{IsTerminal, Write};

/// The recommended threshold of a variant, but for what is stated; a hash that cannot tell octaves apart is joined as in the paper
/// unless another join is stated.
pub fn robust_of(
    variant: Variant,
    hash: Option<HashKind>,
    join: Option<Join>,
    repairs: Repairs,
) -> Result<Robust, Failure> {
    let preset = Robust::recommended(Preset::of(variant));
    let asked = Robust {
        variant,
        hash: hash.unwrap_or(preset.hash),
        join: join.unwrap_or(preset.join),
        repairs,
        ..preset
    };
    match (asked.tells_octaves_apart(), join) {
        (true, _) => Ok(asked),
        (false, None) => {
            let why = "cells of different octaves are not told apart, which `inherit` needs";
            output::remark("note", format_args!("joined by interpolate, as in the paper: {why}"));
            Ok(Robust { join: Join::Interpolate, ..asked })
        }
        (false, Some(_)) => Err(Failure::octaves_alike()),
    }
}

/// Writes the text to stdout or a file.
pub fn run(args: &ShaderTextArgs) -> Result<Ending, Failure> {
    // As `eval` has it: the ablations have no robust form.
    let is_ablation = matches!(args.variant, Variant::Linear | Variant::Single);
    let (variant, hash_scale) = (args.variant, f64::from(args.hash_scale));
    let model: Model = if args.literal || is_ablation {
        match args.join {
            None | Some(Join::Interpolate) if args.literal => {}
            None => {}
            Some(_) if args.literal => {
                return Err(Failure::Usage("--literal joins as the listings do: interpolate".to_owned()));
            }
            Some(_) => {
                let message =
                    format!("--join changes the robust threshold; {variant} is written as the paper has it");
                return Err(Failure::Usage(message));
            }
        }
        let form = if args.literal { CdfForm::Literal } else { CdfForm::Stable };
        HashedAlpha { variant, hash: args.hash.unwrap_or(HashKind::Sine), hash_scale, form }.into()
    } else {
        Robust { hash_scale, ..robust_of(variant, args.hash, args.join, Repairs::ALL)? }.into()
    };
    let options = ShaderOptions {
        pipeline: model.into(),
        hash_scale: if args.hash_scale_parameter { HashScale::Parameter } else { HashScale::Written },
    };
    let exported =
        export(options, args.lang).map_err(|error| Failure::Usage(error.to_string()))?.into_bytes();
    if let Some(file) = &args.out {
        write_atomically(file, &exported)?;
        return Ok(Ending::Consistent);
    }
    if args.lang == Language::SpirV && std::io::stdout().is_terminal() {
        let message = "SPIR-V is no text for a terminal; write it to a file with --out FILE".to_owned();
        return Err(Failure::Usage(message));
    }
    let mut results = output::results();
    results.write_all(&exported).and_then(|()| results.flush()).map_err(Failure::Output)?;
    Ok(Ending::Consistent)
}
