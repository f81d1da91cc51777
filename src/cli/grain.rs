//! `grain`: how much of the noise is seen from afar, and how much of it changes.

use super::args::GrainArgs;
use super::failure::Failure;
use super::{Ending, drivers, output, shader_files, subjects};
use hashed_alpha::check::Subject;
use hashed_alpha::report::grain::{Measured, Moved, json_lines, table};
use std::io::Write;

/// Measures every subject; one that cannot be run is told on stderr.
pub fn run(args: &GrainArgs) -> Result<Ending, Failure> {
    let typed: Vec<&str> = args.subjects.iter().map(String::as_str).collect();
    shader_files::refuse_strays(&typed, &args.shader)?;
    drivers::silence_for(&args.subjects, &args.shader);
    let asked = subjects::subjects(&args.subjects, &args.shader)?;
    let mut ending = Ending::Consistent;
    let mut all = Vec::new();
    for asked in &asked {
        let both = Measured::new(&asked.subject, args.seed)
            .and_then(|measured| Ok((measured, Moved::new(&asked.subject, args.seed)?)));
        match both {
            Ok(both) => all.push(both),
            Err(reason) => {
                let Subject { name, precision, .. } = &asked.subject;
                output::remark("error", format_args!("{name} in {precision}: {reason}"));
                ending = Ending::NoVerdict;
            }
        }
    }
    let text = if args.json {
        json_lines(&all).map_err(|error| Failure::Output(error.into()))?
    } else {
        table(&all)
    };
    let mut results = output::results();
    results.write_all(text.as_bytes()).and_then(|()| results.flush()).map_err(Failure::Output)?;
    Ok(ending)
}
