//! What is wrong with a user's shader, and where.

use core::fmt;
use core::ops::Range;

/// A place in a text file; both count from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Line.
    pub line: usize,
    /// Column, in characters.
    pub column: usize,
}

impl Place {
    /// Returns the place of a byte of `text`; the end of the text for an offset beyond it.
    #[must_use]
    pub fn of(text: &str, offset: usize) -> Self {
        let before = &text.as_bytes()[..offset.min(text.len())];
        let start = before.iter().rposition(|&byte| byte == b'\n').map_or(0, |newline| newline + 1);
        let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
        // Every byte that does not continue a character begins one.
        let column = before[start..].iter().filter(|&&byte| byte & 0xc0 != 0x80).count() + 1;
        Self { line, column }
    }
}

/// A shader file that cannot be put on trial.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct ShaderError {
    /// Name of the file.
    pub file: String,
    /// Where in it, where that is known.
    pub place: Option<Place>,
    /// What is wrong, and what would do instead.
    pub message: String,
    /// Whether there is no function of the name in it, and none that is meant: it may be a file of another purpose.
    pub is_absent: bool,
}

impl fmt::Display for ShaderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file)?;
        if let Some(Place { line, column }) = self.place {
            write!(f, ":{line}:{column}")?;
        }
        write!(f, ": {}", self.message)
    }
}

/// A message and the bytes of the prepared text that it is about.
#[derive(Clone, Debug)]
pub(super) struct Fault {
    pub message: String,
    pub at: Option<Range<usize>>,
    /// Whether there is no function of the name that is asked for.
    pub is_absent: bool,
}

impl Fault {
    pub fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), at: None, is_absent: false }
    }

    /// There is no function of the name that is asked for.
    pub fn absent(message: impl Into<String>) -> Self {
        Self { is_absent: true, ..Self::new(message) }
    }

    pub fn at(self, at: Option<Range<usize>>) -> Self {
        Self { at, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_characters_from_one() {
        let text = "a\nüb c\n";
        assert_eq!(Place::of(text, 0), Place { line: 1, column: 1 });
        assert_eq!(Place::of(text, 4), Place { line: 2, column: 2 });
        assert_eq!(Place::of(text, 999), Place { line: 3, column: 1 });
        assert_eq!(Place::of("", 7), Place { line: 1, column: 1 });
    }
}
