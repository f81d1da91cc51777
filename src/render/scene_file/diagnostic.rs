//! What is wrong with a scene file, at which key, and what was likely meant.

use crate::shader::spelling::likely;

/// What is wrong, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The path of the key, with the number of each table in a list from 0, as in `surface.0.card.size`.
    pub key: String,
    /// What is wrong, and what would be right.
    pub message: String,
}

impl Diagnostic {
    /// Tells a message at a key.
    pub(in crate::render) fn new(key: impl Into<String>, message: impl Into<String>) -> Self {
        Self { key: key.into(), message: message.into() }
    }

    /// The same at a key that is a path within a table.
    pub(in crate::render) fn within(self, table: &str) -> Self {
        Self { key: format!("{table}.{}", self.key), ..self }
    }
}

/// Line and column, both from 1, of a byte.
pub(in crate::render) fn place(text: &str, byte: usize) -> (usize, usize) {
    let before = text.get(..byte).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}

/// Rewrites "unknown field `a`, expected one of `b`, `c`", or "unknown hash `a`; known are b, c", so that the likely one
/// stands out.
pub(in crate::render) fn suggest(message: &str) -> Option<String> {
    let mut quoted = message.split('`').skip(1).step_by(2);
    let wrong = quoted.next()?;
    let known: Vec<&str> = match message.split_once("; known are ") {
        Some((_, known)) => known.split(", ").collect(),
        None => quoted.collect(),
    };
    let what = message.split('`').next()?.trim();
    if !what.starts_with("unknown") {
        return None;
    }
    let what = if what.ends_with("field") { "unknown key" } else { what };
    let likely = likely(wrong, &known);
    let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
    Some(format!("{what} `{wrong}`.{likely} Known here: {known}"))
}

/// Says in the words of a scene file, in place of those of Rust, what is wrong with the value of a key.
pub(in crate::render) fn plain(key: &str, message: &str) -> String {
    const WORDS: [(&str, &str); 14] = [
        ("a nonzero u32", "a whole number from 1 to 4294967295"),
        ("expected u32", "expected a whole number from 0 to 4294967295"),
        ("expected usize", "expected a whole number from 0 on"),
        ("expected u64", "expected a whole number from 0 on"),
        ("expected i128", "expected a whole number"),
        ("expected f64", "expected a number"),
        ("expected f32", "expected a number"),
        ("expected a boolean", "expected true or false"),
        ("expected a sequence", "expected a list"),
        ("expected an array", "expected a list"),
        ("floating point", "number"),
        ("integer `", "number `"),
        ("sequence", "list"),
        ("map,", "table,"),
    ];
    let mut text = WORDS.iter().fold(message.to_owned(), |text, (rust, word)| text.replace(rust, word));
    for (kind, word) in [("struct ", "a table"), ("enum ", "a name in quotes"), ("unit struct ", "a table")] {
        if let Some(at) = text.find(&format!("expected {kind}")) {
            text.truncate(at);
            text += &format!("expected {word}");
        }
    }
    if text.ends_with("table, expected a list") && !key.is_empty() {
        text += &format!(", as `[[{key}]]` begins");
    }
    if key.is_empty() { text } else { format!("`{key}`: {text}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_rust_are_told_in_those_of_a_scene() {
        for (message, expected) in [
            (
                "invalid type: map, expected a sequence",
                "`k`: invalid type: table, expected a list, as `[[k]]` begins",
            ),
            (
                "invalid type: integer `5`, expected struct Region",
                "`k`: invalid type: number `5`, expected a table",
            ),
            ("invalid value: floating point `1.5`, expected u32", "from 0 to 4294967295"),
            (
                "invalid length 2, expected an array of length 3",
                "`k`: invalid length 2, expected a list of length 3",
            ),
            ("invalid type: string \"a\", expected f64", "expected a number"),
        ] {
            let plain = plain("k", message);
            assert!(plain.contains(expected), "{plain}");
        }
    }
}
