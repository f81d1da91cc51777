//! `shader`: the verified threshold as text, in the language of an engine.

use super::args::ShaderTextArgs;
use super::failure::Failure;
use super::{Ending, output};
use hashed_alpha::report::directory::write_atomically;
use hashed_alpha::shader::assemble::{ShaderOptions, Source};
use hashed_alpha::shader::export::{Language, export};
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::robust::Join;
use hashed_alpha::threshold::two_scale::Variant;
use std::io::{IsTerminal, Write};

/// Writes the text to stdout or a file.
pub fn run(args: &ShaderTextArgs) -> Result<Ending, Failure> {
    // As `eval` has it: the ablations have no robust form.
    let is_ablation = matches!(args.variant, Variant::Linear | Variant::Single);
    let preset = if args.literal || is_ablation { ShaderOptions::listing } else { ShaderOptions::robust }(
        args.variant,
    );
    let source = match (preset.source, args.join) {
        (Source::Robust(preset), join) => Source::Robust(join.unwrap_or(preset)),
        (_, None | Some(Join::Interpolate)) if args.literal => Source::Listing(CdfForm::Literal),
        (_, None) => Source::Listing(CdfForm::Stable),
        (_, Some(_)) if args.literal => {
            return Err(Failure::Usage("--literal joins as the listings do: interpolate".to_owned()));
        }
        (_, Some(_)) => {
            let message = format!(
                "--join changes the robust threshold; {} is written as the paper has it",
                args.variant
            );
            return Err(Failure::Usage(message));
        }
    };
    let options = ShaderOptions {
        hash: args.hash.unwrap_or(preset.hash),
        hash_scale: if args.hash_scale_parameter { None } else { Some(args.hash_scale) },
        source,
        ..preset
    };
    let text = export(&options, args.lang).map_err(|error| Failure::Usage(error.to_string()))?;
    if let Some(file) = &args.out {
        write_atomically(file, &text)?;
        return Ok(Ending::Consistent);
    }
    if args.lang == Language::SpirV && std::io::stdout().is_terminal() {
        let message = "SPIR-V is no text for a terminal; write it to a file with --out FILE".to_owned();
        return Err(Failure::Usage(message));
    }
    let mut results = output::results();
    results.write_all(&text).and_then(|()| results.flush()).map_err(Failure::Output)?;
    Ok(Ending::Consistent)
}
