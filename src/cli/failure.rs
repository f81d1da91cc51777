//! Everything that ends a job early, as one message with the place and the way out.

use super::rows::RowError;
use hashed_alpha::render::scene_file::read::FileError;
use hashed_alpha::report::directory::ReportError;
use hashed_alpha::report::growth::StateError;
use hashed_alpha::shader::own::ShaderError;
use hashed_alpha::threshold::robust::Robust;
use std::error::Error;
use std::io;

/// The reason why a job could not be finished.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// Stdout does not take the results.
    #[error("cannot write to standard output")]
    Output(#[source] io::Error),
    /// A file or a folder cannot be opened, read or written.
    #[error("cannot {action} {place}")]
    File {
        /// What was tried, as in "open".
        action: &'static str,
        /// The name of the file.
        place: String,
        /// What the system says.
        source: io::Error,
    },
    /// The rows of the input cannot be read.
    #[error(transparent)]
    Row(#[from] RowError),
    /// The report cannot be written.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// A shader cannot be put on trial.
    #[error(transparent)]
    Shader(#[from] ShaderError),
    /// A scene file is wrong.
    #[error(transparent)]
    Scene(#[from] FileError),
    /// A run cannot be continued from what an earlier one left.
    #[error("cannot continue {place}")]
    State {
        /// The name of the file.
        place: String,
        /// Why.
        source: StateError,
    },
    /// Something that was typed does not have a meaning.
    #[error("{0}")]
    Usage(String),
}

impl Failure {
    /// A join that hashes cells of several octaves side by side, without what tells them apart.
    pub fn octaves_alike() -> Self {
        let hash = Robust::HASH;
        Self::Usage(format!(
            "--join inherit hashes cells of several octaves side by side: it needs the repair octave-word and a hash that reads the octave, as {hash}"
        ))
    }

    /// Tells whether the reader of the results has gone.
    pub fn is_closed_pipe(&self) -> bool {
        matches!(self, Self::Output(error) if error.kind() == io::ErrorKind::BrokenPipe)
    }

    /// Returns what happened and, after a colon each, what was behind it.
    pub fn message(&self) -> String {
        told(self)
    }
}

/// Returns an error and, after a colon each, what was behind it.
pub fn told(error: &dyn Error) -> String {
    let mut message = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        message += &format!(": {error}");
        cause = error.source();
    }
    message
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_tells_what_was_behind_it() {
        let source = io::Error::other("the dog ate it");
        let failure = Failure::File { action: "open", place: "rows.csv".to_owned(), source };
        assert_eq!(failure.message(), "cannot open rows.csv: the dog ate it");
    }

    #[test]
    fn only_results_have_a_reader_that_can_go() {
        let gone = || io::Error::from(io::ErrorKind::BrokenPipe);
        assert!(Failure::Output(gone()).is_closed_pipe());
        assert!(!Failure::File { action: "read", place: String::new(), source: gone() }.is_closed_pipe());
    }
}
