//! `shader`: the verified threshold as text, in the language of an engine.

use super::args::ShaderTextArgs;
use super::failure::Failure;
use super::{Ending, output};
use hashed_alpha::report::directory::write_atomically;
use hashed_alpha::shader::assemble::{ShaderOptions, Source};
use hashed_alpha::shader::export::{Language, export};
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::robust::Join;
use std::io::{IsTerminal, Write};

/// Writes the text to stdout or a file.
pub fn run(args: &ShaderTextArgs) -> Result<Ending, Failure> {
    let preset = if args.literal { ShaderOptions::listing } else { ShaderOptions::robust }(args.variant);
    let source = match (preset.source, args.join) {
        (Source::Robust(preset), join) => Source::Robust(join.unwrap_or(preset)),
        (_, None | Some(Join::Interpolate)) => Source::Listing(CdfForm::Literal),
        (_, Some(_)) => {
            return Err(Failure::Usage("--literal joins as the listings do: interpolate".to_owned()));
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
