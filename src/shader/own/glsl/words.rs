//! What naga's parser of GLSL says, in the words of the language.

use super::super::directives::Directive;
use super::super::error::Fault;
use core::ops::Range;
use naga::front::glsl::{ErrorKind, ExpectedToken, ParseErrors};

/// The first error of a text, which is shown as the user wrote it; `textures` are names that were taken out of it.
pub(super) fn said(errors: &ParseErrors, text: &str, textures: &[String]) -> Fault {
    let Some(error) = errors.errors.first() else { return Fault::new("it is no GLSL") };
    let at = error.meta.to_range();
    let there = at.clone().and_then(|at| text.get(at)).unwrap_or_default();
    let message = match &error.kind {
        ErrorKind::EndOfFile => "the file ends too early".to_owned(),
        ErrorKind::InvalidToken(_, expected) => {
            let expected: Vec<_> = expected.iter().map(sign).collect();
            format!("expected {}, found `{there}`", expected.join(" or "))
        }
        ErrorKind::UnknownVariable(name) if textures.contains(name) => format!(
            "`{name}` is a texture, which is not there when the function runs alone: make what is read of it a parameter"
        ),
        ErrorKind::UnknownVariable(name) => unknown(name, text),
        ErrorKind::PreprocessorError(error) => return preprocessor(&format!("{error:?}"), text, at),
        other => other.to_string(),
    };
    Fault::new(message).at(at)
}

/// Says of a name that is not known, of whatever it is, that a file may have it which is not included.
pub(super) fn or_included(fault: Fault, directives: &[Directive<'_>]) -> Fault {
    let is_unknown = ["declared nowhere", "nknown function", "nknown type", "expected a type"]
        .iter()
        .any(|words| fault.message.contains(words));
    let included: Vec<_> = directives
        .iter()
        .filter(|directive| directive.name() == "include")
        .map(|directive| format!("`{}`", directive.written))
        .collect();
    if !is_unknown || included.is_empty() {
        return fault;
    }
    let files = included.join(", ");
    Fault {
        message: format!(
            "{}; {files} may have it, which is neither beside the file nor in a folder of -I DIR",
            fault.message
        ),
        ..fault
    }
}

/// What the preprocessor says, by the name of its error.
fn preprocessor(error: &str, text: &str, at: Option<Range<usize>>) -> Fault {
    let place = at.clone().map_or(0, |at| at.start);
    let start = text.get(..place).unwrap_or_default().rfind('\n').map_or(0, |end| end + 1);
    let line = text[start..].lines().next().unwrap_or_default().trim();
    let here = text.get(place..).and_then(|rest| rest.chars().next());
    match here {
        _ if error == "ErrorDirective" => Fault::new(format!("the file says: {line}")).at(at),
        Some(strange) if error == "UnexpectedHash" && strange != '#' => {
            Fault::new(format!("{:?} is no character of GLSL", strange.to_string())).at(at)
        }
        _ => Fault::new(format!("the preprocessor stops here: {}", in_words(error))).at(at),
    }
}

/// A name without a value: perhaps a macro that comes back to itself, or one that is not defined.
fn unknown(name: &str, text: &str) -> String {
    let line = |line: &str| {
        let words: Vec<_> = line
            .split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
            .filter(|word| !word.is_empty())
            .collect();
        line.trim_start().starts_with('#') && words.first() == Some(&"define") && words.get(1) == Some(&name)
    };
    match text.lines().position(line) {
        Some(index) => format!(
            "`{name}` is left over here: the macro of that name in line {} comes back to itself, is called without \
             arguments, or stands behind a condition or further down",
            index + 1
        ),
        None => format!(
            "`{name}` has no value: it is declared nowhere; what the rest of a program gives is a parameter here, or a \
             uniform with --set {name}=VALUE"
        ),
    }
}

fn sign(expected: &ExpectedToken) -> String {
    match expected {
        ExpectedToken::Token(token) => {
            let name = format!("{token:?}");
            let sign = SIGNS.iter().find(|(known, _)| *known == name).map(|(_, sign)| format!("`{sign}`"));
            sign.unwrap_or_else(|| in_words(&name))
        }
        ExpectedToken::TypeName => "a type".to_owned(),
        ExpectedToken::Identifier => "a name".to_owned(),
        ExpectedToken::IntLiteral => "an integer".to_owned(),
        ExpectedToken::FloatLiteral => "a number".to_owned(),
        ExpectedToken::BoolLiteral => "true or false".to_owned(),
        ExpectedToken::Eof => "the end of the file".to_owned(),
    }
}

/// What naga calls the signs that it can miss.
const SIGNS: [(&str, &str); 11] = [
    ("Semicolon", ";"),
    ("Comma", ","),
    ("Colon", ":"),
    ("Assign", "="),
    ("LeftParen", "("),
    ("RightParen", ")"),
    ("LeftBrace", "{"),
    ("RightBrace", "}"),
    ("LeftBracket", "["),
    ("RightBracket", "]"),
    ("While", "while"),
];

/// "UnknownDirective" as "unknown directive".
fn in_words(name: &str) -> String {
    let name = name.split('(').next().unwrap_or_default();
    let mut words = String::new();
    for letter in name.chars() {
        if letter.is_ascii_uppercase() && !words.is_empty() {
            words.push(' ');
        }
        words.push(letter.to_ascii_lowercase());
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_errors_become_words() {
        assert_eq!(in_words("TooFewDefineArguments"), "too few define arguments");
        assert_eq!(in_words("UnexpectedToken(Ident(\"x\"))"), "unexpected token");
    }
}
