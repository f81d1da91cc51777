//! GLSL as engines write it, made into the GLSL 450 that naga reads.
//!
//! Everything is blanked or replaced byte for byte, so that a message about what is left names the user's own line and
//! column:
//!
//! * lines of `#version`, `#extension`, `#pragma`; a version of OpenGL ES defines `GL_ES`;
//! * precision statements, and `highp`, `mediump`, `lowp` everywhere: all is read as 32 bits;
//! * `const` in front of a parameter;
//! * a name `in`, which the paper's own listings use, becomes another one;
//! * the body of a `main`, which does not run;
//! * `varying`, an older word for `in`;
//! * declarations of textures;
//! * `uniform` in front of a plain value, which then waits for one (`--set`);
//! * a setting whose name stands in an `#if` or `#ifdef` is a macro;
//! * derivatives of the position, see [`super::derivative`].
//!
//! A `main` is appended where there is none.

use super::derivative;
use super::error::Fault;
use super::macros;
use super::scan::{Token, tokens};
use std::collections::{BTreeMap, BTreeSet};

/// Text that naga reads, and what was taken out of it.
pub(super) struct Prepared {
    pub text: String,
    /// Bytes that stand before the user's first one.
    pub prelude: usize,
    /// Names of the uniforms that wait for a value.
    pub uniforms: Vec<String>,
    /// Names of globals that have an initial value; naga drops those values that it cannot compute.
    pub initialised: Vec<String>,
    pub has_derivatives: bool,
    /// Macros that are defined before the text: `GL_ES`, and those of the user that it asks for.
    pub defines: Vec<(String, String)>,
}

/// Prepares a text whose function to be called is `function`.
///
/// # Errors
///
/// A derivative of something else than the position, and nesting too deep.
pub(super) fn prepare(
    text: &str,
    function: &str,
    settings: &BTreeMap<String, String>,
) -> Result<Prepared, Fault> {
    let mut bytes = text.as_bytes().to_vec();
    let mut defines = Vec::new();
    let Directives { is_es, asked_for } = blank_directives(&mut bytes)?;
    if is_es {
        defines.push(("GL_ES".to_owned(), "1".to_owned()));
    }
    defines.extend(settings.clone().into_iter().filter(|(name, _)| asked_for.contains(name)));
    let blanked = String::from_utf8_lossy(&bytes).into_owned();
    let tokens = tokens(&blanked)?;
    refuse_strange_characters(&tokens, &blanked)?;
    macros::measure(&blanked, &tokens)?;
    let word = |index: usize| tokens.get(index).map_or("", |token: &Token| &blanked[token.at.clone()]);
    let is_name = |index: usize| word(index).starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    let spare = spare_name(&tokens, &blanked);
    let (mut uniforms, mut initialised) = (Vec::new(), Vec::new());
    let mut has_main = false;
    for (index, token) in tokens.iter().enumerate() {
        let mut blank = |at: core::ops::Range<usize>| bytes[at].fill(b' ');
        match word(index) {
            "precision" if word(index + 3) == ";" => {
                blank(token.at.start..tokens[index + 3].at.end);
            }
            "highp" | "mediump" | "lowp" => blank(token.at.clone()),
            "const" if token.parentheses > 0 => blank(token.at.clone()),
            "in" if !is_name(index + 1) => bytes[token.at.clone()].copy_from_slice(spare.as_bytes()),
            "uniform" if token.function.is_none() => {
                let value_type =
                    index + 1 + usize::from(matches!(word(index + 1), "highp" | "mediump" | "lowp"));
                let is_plain = !word(value_type).contains("sampler") && !word(value_type).contains("image");
                if is_plain && is_name(value_type + 1) {
                    blank(token.at.clone());
                    uniforms.push(word(value_type + 1).to_owned());
                } else if word(value_type + 2) == ";" {
                    // Textures with a sampler in them are not read at all; the function cannot use them anyway.
                    blank(token.at.start..tokens[value_type + 2].at.end);
                }
            }
            "=" if token.function.is_none() && word(index + 1) != "=" => {
                // Behind the name may stand the size of an array.
                let before = &tokens[..index];
                let is_size =
                    |at: usize| matches!(word(at), "[" | "]") || word(at).bytes().all(|b| b.is_ascii_digit());
                let name = (0..before.len()).rev().find(|&at| !is_size(at)).map(word);
                initialised.extend(name.map(str::to_owned));
            }
            "main" if token.function.is_none() && word(index + 1) == "(" => has_main = true,
            // A varying is an input by its older name.
            "varying" if token.function.is_none() => {
                blank(token.at.clone());
                bytes[token.at.start..token.at.start + 2].copy_from_slice(b"in");
            }
            _ => {}
        }
    }
    blank_main(&mut bytes, &tokens, &blanked);
    let has_derivatives = derivative::replace(&mut bytes, &tokens, function)?;
    let prelude = if has_derivatives { derivative::GLSL } else { "" };
    // Nothing but whole characters was replaced, by ASCII.
    let mut prepared = format!("{prelude}{}", String::from_utf8_lossy(&bytes));
    if !has_main {
        prepared.push_str("\nvoid main() {}\n");
    }
    Ok(Prepared { text: prepared, prelude: prelude.len(), uniforms, initialised, has_derivatives, defines })
}

/// Blanks the body of `main`, which does not run and may use what only an older version has.
fn blank_main(bytes: &mut [u8], tokens: &[Token], text: &str) {
    let is_main = |name: usize| &text[tokens[name].at.clone()] == "main";
    let body = tokens.iter().filter(|token| token.function.is_some_and(is_main)).skip(1);
    let range = body.fold(None, |range: Option<(usize, usize)>, token| {
        Some((range.map_or(token.at.start, |(start, _)| start), token.at.end))
    });
    if let Some((start, end)) = range {
        bytes[start..end].iter_mut().filter(|byte| !byte.is_ascii_whitespace()).for_each(|byte| *byte = b' ');
    }
}

/// Refuses characters that no GLSL has outside of comments.
fn refuse_strange_characters(tokens: &[Token], text: &str) -> Result<(), Fault> {
    let is_strange = |word: &str| {
        !word.is_ascii() || word.bytes().any(|byte| byte.is_ascii_control() || b"@$`'".contains(&byte))
    };
    match tokens.iter().find(|token| is_strange(&text[token.at.clone()])) {
        Some(token) => {
            let message = format!("{:?} is no character of GLSL", &text[token.at.clone()]);
            Err(Fault::new(message).at(Some(token.at.clone())))
        }
        None => Ok(()),
    }
}

/// What directives say of the rest of the text.
#[derive(Default)]
struct Directives {
    /// Whether the version is one of OpenGL ES.
    is_es: bool,
    /// Words in conditions.
    asked_for: BTreeSet<String>,
}

/// Blanks directives that only tell a driver something.
fn blank_directives(bytes: &mut [u8]) -> Result<Directives, Fault> {
    let mut directives = Directives::default();
    let mut start = 0;
    for line in bytes.split_mut(|&byte| byte == b'\n') {
        let at = start..start + line.len();
        start = at.end + 1;
        let text = String::from_utf8_lossy(line);
        let Some(directive) = text.trim_start().strip_prefix('#') else { continue };
        let mut words = directive.split_whitespace();
        let name = words.next();
        if matches!(name, Some("if" | "ifdef" | "ifndef" | "elif")) {
            let words = directive.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
            directives.asked_for.extend(words.map(str::to_owned));
        }
        if name == Some("include") {
            return Err(Fault::new("files are not included; paste the text of this one").at(Some(at)));
        }
        if matches!(name, Some("version" | "extension" | "pragma")) {
            let version: Vec<_> = words.collect();
            directives.is_es |=
                name == Some("version") && (version.contains(&"es") || version.first() == Some(&"100"));
            line.iter_mut().filter(|byte| **byte != b'\r').for_each(|byte| *byte = b' ');
        }
    }
    Ok(directives)
}

/// A name of two letters that the text does not use.
fn spare_name(tokens: &[Token], text: &str) -> String {
    let is_used = |name: &String| tokens.iter().any(|token| text[token.at.clone()] == **name);
    ('a'..='z')
        .map(|letter| format!("_{letter}"))
        .find(|name| !is_used(name))
        .unwrap_or_else(|| "zz".to_owned())
}
