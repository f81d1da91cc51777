//! Compilers of other people, which are programs of their own.

use super::error::Fault;
use core::ops::Range;
use std::ffi::OsString;
use std::io::ErrorKind;
use std::path::PathBuf;
use std::process::{Command, Output};
use std::sync::atomic::{AtomicU32, Ordering};

/// A folder that is gone afterwards.
pub(super) struct Folder(PathBuf);

impl Folder {
    /// Makes one; `language` is what the compiler of a message compiles.
    pub fn new(language: &str) -> Result<Self, Fault> {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("hashed-alpha-{}-{count}", std::process::id()));
        std::fs::create_dir(&path).map_err(|error| not_handed(language, &error))?;
        Ok(Self(path))
    }

    /// The path of a file in it.
    pub fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // Nothing else could be done about what stays.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Says that a text could not be written for a compiler, or what it made not be read.
pub(super) fn not_handed(language: &str, error: &std::io::Error) -> Fault {
    Fault::new(format!("the compiler of {language} cannot be handed the text: {error}"))
}

/// Runs a compiler; `missing` is what to do where there is none.
pub(super) fn run(program: &str, arguments: Vec<OsString>, missing: &str) -> Result<Output, Fault> {
    Command::new(program).args(arguments).output().map_err(|error| match error.kind() {
        ErrorKind::NotFound => Fault::new(missing),
        _ => Fault::new(format!("{program}: {error}")),
    })
}

/// The bytes of a line, counted from 1; nothing behind the last.
pub(super) fn line_of(text: &str, line: usize) -> Option<Range<usize>> {
    let start = text.split_inclusive('\n').take(line.checked_sub(1)?).map(str::len).sum::<usize>();
    let length = text.get(start..)?.lines().next()?.len();
    Some(start..start + length)
}
