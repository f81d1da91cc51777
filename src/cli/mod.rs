//! The command line: what was typed ([`args`]), what it means, and one job a verb.
//!
//! | module | holds |
//! |---|---|
//! | [`args`] | verbs, options and their help |
//! | [`check`], [`compare`], [`eval`], [`explain`], [`grain`], [`hashes`], [`render`], [`scenes`], [`shader`] | one job a verb |
//! | [`growth`] | `check --until-failure` |
//! | [`mend`] | `check --mend` |
//! | [`scene_files`] | what a typed scene means |
//! | [`shader_files`] | what a typed shader file means |
//! | [`subjects`] | what a typed subject means, and where it runs |
//! | [`rows`] | footprints as comma-separated text, read and written |
//! | [`drivers`] | keeps drivers from writing to stderr |
//! | [`known`] | the TOML list of known findings |
//! | [`output`] | the two streams: results on stdout, remarks on stderr |
//! | [`ending`], [`failure`] | what the exit code says, and everything that ends a job early, as one message |
//!
//! What never lives here: mathematics, statistics, the look of a report. Nothing outside this folder prints.

mod args;
mod check;
mod compare;
mod cost;
mod drivers;
mod ending;
mod eval;
mod explain;
mod failure;
mod grain;
mod growth;
mod hashes;
mod known;
mod mend;
mod output;
mod render;
mod rows;
mod scene_files;
mod scenes;
mod shader;
mod shader_files;
mod subjects;

pub use args::Args;

use args::Verb;
use ending::Ending;
use failure::Failure;
use hashed_alpha::shader::own::READER;
use hashed_alpha::threshold::batch::Isa;
use std::io::Write;
use std::process::ExitCode;

/// Keeps panics of the readers of shaders off stderr: they become messages with the name of the file.
pub fn quiet_readers() {
    let told = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if std::thread::current().name() != Some(READER) {
            told(panic);
        }
    }));
}

/// Does what was asked for.
pub fn run(args: &Args) -> Result<Ending, Failure> {
    Isa::asked_for().map_err(Failure::Usage)?;
    match &args.verb {
        Verb::Check(args) if args.mend => mend::run(args),
        Verb::Check(args) => check::run(args),
        Verb::Compare(args) => compare::run(args),
        Verb::Cost(args) => cost::run(args),
        Verb::Eval(args) => eval::run(args),
        Verb::Explain(args) => explain::run(args),
        Verb::Grain(args) => grain::run(args),
        Verb::Hashes(args) => hashes::run(args),
        Verb::Render(args) => render::run(args),
        Verb::Scenes(args) => scenes::run(args),
        Verb::Shader(args) => shader::run(args),
    }
}

/// Prints the help that was asked for, or what is wrong with the arguments.
pub fn tell(message: &clap::Error) -> Result<Ending, Failure> {
    message.print().and_then(|()| std::io::stdout().flush()).map_err(Failure::Output)?;
    Ok(if message.use_stderr() { Ending::Usage } else { Ending::Consistent })
}

/// Turns the end of a job into an exit code and, where it failed, into a message.
///
/// A reader that has seen enough and closed the pipe is no failure.
pub fn finish(result: Result<Ending, Failure>) -> ExitCode {
    match result {
        Ok(Ending::Consistent) => ExitCode::SUCCESS,
        Ok(Ending::Rejected) => ExitCode::from(1),
        Ok(Ending::Usage) => ExitCode::from(2),
        Ok(Ending::NoVerdict) => ExitCode::from(3),
        Err(failure) if failure.is_closed_pipe() => ExitCode::SUCCESS,
        Err(failure) => {
            output::remark("error", failure.message());
            ExitCode::from(2)
        }
    }
}
