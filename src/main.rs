//! `hashed-alpha`, the command line: parse, run, exit code. What it does is in [`cli`].

mod cli;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    cli::quiet_readers();
    match cli::Args::try_parse() {
        Ok(args) => cli::finish(cli::run(&args)),
        Err(message) => cli::finish(cli::tell(&message)),
    }
}
