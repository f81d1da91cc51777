//! The two streams: results on stdout, remarks on stderr.

use std::env;
use std::fmt::Display;
use std::io::{self, BufWriter, IsTerminal, StdoutLock, Write};
use std::sync::atomic::{AtomicU64, Ordering};

/// Returns stdout with a buffer. Flush it: what is left in the buffer at the end is lost without a word.
pub fn results() -> BufWriter<StdoutLock<'static>> {
    BufWriter::with_capacity(1 << 16, io::stdout().lock())
}

/// Tells whether results may carry colours: on a terminal, unless `NO_COLOR` says no.
pub fn takes_colour() -> bool {
    is_terminal() && env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

/// Tells whether somebody reads the results on a terminal.
pub fn is_terminal() -> bool {
    io::stdout().is_terminal()
}

/// Writes `kind: text` to stderr. Nobody is left to hear of it when that fails.
pub fn remark(kind: &str, text: impl Display) {
    let _ = writeln!(io::stderr().lock(), "{kind}: {text}");
}

/// Whether ten seconds have passed since the last line; of several threads one is told so.
pub fn is_due(told: &AtomicU64, seconds: u64) -> bool {
    let tens = seconds / 10;
    told.fetch_max(tens, Ordering::Relaxed) < tens
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_due_every_ten_seconds() {
        let told = AtomicU64::new(0);
        let due = [0, 9, 10, 10, 19, 34, 39, 40].map(|seconds| is_due(&told, seconds));
        assert_eq!(due, [false, false, true, false, false, true, false, true]);
    }
}
