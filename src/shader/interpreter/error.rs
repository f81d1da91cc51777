//! What the interpreter says when it does not take a shader, or stops one.

use naga::Span;

/// Something in a shader that the interpreter does not take.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct Unsupported {
    /// What it is, and what to do instead where there is something.
    pub message: String,
    /// Where it stands; undefined where naga does not know.
    pub span: Span,
}

impl Unsupported {
    pub(super) fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), span: Span::UNDEFINED }
    }

    /// Says where it is, unless something further inside has said so.
    pub(super) fn at(self, span: Span) -> Self {
        if self.span.is_defined() { self } else { Self { span, ..self } }
    }

    /// Returns the message with its line and column in the source that was parsed.
    #[must_use]
    pub fn in_source(&self, source: &str) -> String {
        with_place(&self.message, self.span, source)
    }
}

/// Why a run gave no result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Stopped {
    /// The columns do not fit the parameters.
    #[error("{0}")]
    Arguments(String),
    /// A block of lanes used up its steps: a loop that does not end, or one that is too long.
    #[error("a loop does not end, or takes more than {steps} steps")]
    Endless {
        /// The loop with the most rounds of those that were running.
        span: Span,
        /// The steps that a block of lanes had.
        steps: u64,
    },
}

impl Stopped {
    /// Returns the message, of a loop with its line and column in the source that was parsed.
    #[must_use]
    pub fn in_source(&self, source: &str) -> String {
        match self {
            Self::Arguments(message) => message.clone(),
            Self::Endless { span, .. } => with_place(&self.to_string(), *span, source),
        }
    }
}

fn with_place(message: &str, span: Span, source: &str) -> String {
    match span.to_range() {
        Some(range) if source.is_char_boundary(range.start) => {
            let place = span.location(source);
            format!("line {}, column {}: {message}", place.line_number, place.line_position)
        }
        _ => message.to_owned(),
    }
}
