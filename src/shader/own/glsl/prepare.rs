//! GLSL as engines write it, made into the GLSL 450 that naga reads.
//!
//! Everything is blanked or replaced byte for byte, so that a message about what is left names the user's own line and
//! column:
//!
//! * lines of `#version`, `#extension`, `#pragma`, `#line`, `#include`; a version of OpenGL ES defines `GL_ES`;
//! * functions that the one on trial does not come to, `main` among them;
//! * precision statements, and `highp`, `mediump`, `lowp` everywhere: all is read as 32 bits;
//! * `const` in front of a parameter;
//! * a name `in`, which the paper's own listings use, becomes another one;
//! * `varying` and `attribute`, older words for `in`;
//! * `shader_type`, `render_mode` and the hints of uniforms, as Godot writes them;
//! * declarations of textures;
//! * `uniform` in front of a plain value, which then waits for one (`--set`);
//! * `uniform` and `buffer` in front of a block without a binding: a macro that gives it one;
//! * a setting whose name stands in an `#if` or `#ifdef` is a macro;
//! * derivatives of the position, see [`derivative`].
//!
//! A `main` is appended.

use super::super::derivative::{self, Variables};
use super::super::directives::{Directive, in_directives, is_asked_for};
use super::super::error::Fault;
use super::super::items;
use super::super::options::Options;
use super::super::scan::Token;
use super::macros;

/// Text that naga reads, and what was taken out of it.
pub(super) struct Prepared {
    pub text: String,
    /// Bytes that stand before the user's first one.
    pub prelude: usize,
    /// Names of the uniforms that wait for a value.
    pub uniforms: Vec<String>,
    /// Names of globals that have an initial value; naga drops those values that it cannot compute.
    pub initialised: Vec<String>,
    /// Names of textures, which are not there.
    pub textures: Vec<String>,
    /// The variables that took the place of derivatives.
    pub derivatives: Option<Variables>,
    /// Macros that are defined before the text.
    pub defines: Vec<(String, String)>,
    /// Names of those that are the user's.
    pub defined: Vec<String>,
}

/// Prepares a text for what is asked of it.
///
/// # Errors
///
/// Macros that come to too much.
pub(super) fn prepare(
    text: &str,
    tokens: &[Token],
    directives: &[Directive<'_>],
    asked: &Options,
) -> Result<Prepared, Fault> {
    let mut bytes = text.as_bytes().to_vec();
    blank_comments(&mut bytes, tokens, directives);
    let is_es = blank_directives(&mut bytes, directives);
    let mut defines = Vec::new();
    if is_es {
        defines.push(("GL_ES".to_owned(), "1".to_owned()));
    }
    let settings = asked.settings.iter().filter(|(name, _)| is_asked_for(directives, name));
    defines.extend(settings.map(|(name, value)| (name.clone(), value.clone())));
    defines.extend(words_of_others(text, tokens, directives));
    let defined = defines.iter().map(|(name, _)| name.clone()).collect();
    mark_strange_characters(&mut bytes, tokens);
    let mut spare = derivative::spare_names(tokens, text.as_bytes());
    let [block, buffer, parameter] =
        [spare.next(), spare.next(), spare.next()].map(|name| name.unwrap_or_else(|| "zz".to_owned()));
    for (name, keyword) in [(&block, "uniform"), (&buffer, "buffer")] {
        defines.push((name.clone(), format!("layout(binding = 0) {keyword}")));
    }

    let word = |index: usize| tokens.get(index).map_or("", |token: &Token| &text[token.at.clone()]);
    let is_name = |index: usize| word(index).starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    let in_directive = in_directives(directives, tokens.len());
    let (mut uniforms, mut textures, mut initialised) = (Vec::new(), Vec::new(), Vec::new());
    // Where the declaration begins that a token belongs to, and where that of the last uniform ends.
    let (mut declaration, mut uniform_end) = (0, 0);
    for (index, token) in tokens.iter().enumerate() {
        let is_outside = token.function.is_none() && token.parentheses == 0;
        let mut blank = |tokens: &[Token]| tokens.iter().for_each(|token| bytes[token.at.clone()].fill(b' '));
        match word(index) {
            "precision" if word(index + 3) == ";" => blank(&tokens[index..index + 4]),
            "highp" | "mediump" | "lowp" => blank(&tokens[index..=index]),
            "const" if token.parentheses > 0 || in_directive[index] && word(index + 1) == "in" => {
                blank(&tokens[index..=index]);
            }
            "in" if !is_name(index + 1) && !in_directive[index] => {
                bytes[token.at.clone()].copy_from_slice(parameter.as_bytes())
            }
            "shader_type" | "render_mode" | "stencil_mode" | "group_uniforms" if is_outside => {
                let end = (index..tokens.len()).find(|&at| word(at) == ";").unwrap_or(index);
                blank(&tokens[index..=end]);
            }
            "global" | "instance" if is_outside && word(index + 1) == "uniform" => {
                blank(&tokens[index..=index])
            }
            // Of extensions, and without a meaning here.
            "layout" if is_outside => {
                let close = (index..tokens.len()).find(|&at| word(at) == ")" && tokens[at].parentheses == 0);
                let inside: Vec<usize> = (index + 2..close.unwrap_or(index + 2)).collect();
                let is_strange = |part: &&[usize]| {
                    part.first().is_some_and(|&at| matches!(word(at), "scalar" | "buffer_reference"))
                };
                let parts: Vec<&[usize]> = inside.split(|&at| word(at) == ",").collect();
                if parts.iter().all(is_strange) {
                    blank(&tokens[index..=close.unwrap_or(index)]);
                } else {
                    for part in parts.iter().filter(|part| is_strange(part)) {
                        let (first, last) = (part[0], part[part.len() - 1]);
                        let comma = if word(last + 1) == "," { last + 1 } else { first - 1 };
                        blank(&tokens[first..=last]);
                        blank(&tokens[comma..=comma]);
                    }
                }
            }
            "varying" | "attribute" if is_outside => {
                blank(&tokens[index..=index]);
                bytes[token.at.start..token.at.start + 2].copy_from_slice(b"in");
            }
            keyword @ ("uniform" | "buffer" | "extern") if is_outside && index >= uniform_end => {
                let is_precision = matches!(word(index + 1), "highp" | "mediump" | "lowp");
                let value_type = index + 1 + usize::from(is_precision);
                if word(value_type + 1) == "{" {
                    let is_bound = |at: usize| matches!(word(at), "binding" | "push_constant");
                    if !(declaration..index).any(is_bound) {
                        blank(&tokens[index..=index]);
                        let name = if keyword == "uniform" { &block } else { &buffer };
                        bytes[token.at.start..token.at.start + name.len()].copy_from_slice(name.as_bytes());
                    }
                } else if is_name(value_type + 1) {
                    uniform_end =
                        (index..tokens.len()).find(|&at| word(at) == ";").unwrap_or(tokens.len() - 1);
                    // Behind a colon an editor is told how the value may be chosen.
                    if word(value_type + 2) == ":" {
                        let is_end =
                            |&at: &usize| matches!(word(at), "=" | ";") && tokens[at].parentheses == 0;
                        let end = (value_type + 2..tokens.len()).find(is_end).unwrap_or(tokens.len());
                        blank(&tokens[value_type + 2..end]);
                    }
                    let is_texture =
                        ["sampler", "image", "Image"].iter().any(|part| word(value_type).contains(part));
                    // Textures with a sampler in them are not read at all; the function cannot use them anyway.
                    blank(&tokens[declaration..=if is_texture { uniform_end } else { index }]);
                    let is_declared = |&at: &usize| {
                        let comes_first = at == value_type + 1 || word(at - 1) == ",";
                        comes_first && tokens[at].parentheses == 0 && is_name(at)
                    };
                    let declared = (value_type + 1..uniform_end).filter(is_declared);
                    let names = if is_texture { &mut textures } else { &mut uniforms };
                    names.extend(declared.map(|at| word(at).to_owned()));
                }
            }
            "=" if token.function.is_none() && word(index + 1) != "=" => {
                // Behind the name may stand the size of an array.
                let is_size =
                    |at: usize| matches!(word(at), "[" | "]") || word(at).bytes().all(|b| b.is_ascii_digit());
                let name = (0..index).rev().find(|&at| !is_size(at)).map(word);
                initialised.extend(name.map(str::to_owned));
            }
            _ => {}
        }
        if in_directive[index] || token.function.is_none() && matches!(word(index), ";" | "}") {
            declaration = index + 1;
        }
    }
    items::blank_others(&mut bytes, text, tokens, directives, &asked.function, &asked.names());
    macros::measure(text, tokens, directives, |token| bytes[token.at.start] != b' ')?;
    let position = derivative::position(text, tokens, asked);
    let derivatives = derivative::replace(&mut bytes, tokens, &asked.function, position);
    let prelude = derivatives.as_ref().map_or_else(String::new, derivative::glsl);
    // Nothing but whole characters was replaced, by ASCII.
    let prepared = format!("{prelude}{}\nvoid main() {{}}\n", String::from_utf8_lossy(&bytes));
    let prelude = prelude.len();
    Ok(Prepared { text: prepared, prelude, uniforms, initialised, textures, derivatives, defines, defined })
}

/// Types that GLSL calls otherwise, or has in an extension: what shaders for several languages use.
const OTHER_TYPES: [(&str, &str); 22] = [
    // Of LÖVE and Filament.
    ("number", "float"),
    ("HIGHP", ""),
    ("MEDIUMP", ""),
    ("LOWP", ""),
    ("uint64_t", "uint"),
    ("int64_t", "int"),
    ("half", "float"),
    ("half2", "vec2"),
    ("half3", "vec3"),
    ("half4", "vec4"),
    ("float2", "vec2"),
    ("float3", "vec3"),
    ("float4", "vec4"),
    ("float3x3", "mat3"),
    ("float4x4", "mat4"),
    ("float16_t", "float"),
    ("f16vec2", "vec2"),
    ("f16vec3", "vec3"),
    ("f16vec4", "vec4"),
    ("float32_t", "float"),
    ("f32vec3", "vec3"),
    ("f32vec2", "vec2"),
];

/// Those of them that a text uses and does not define.
fn words_of_others(text: &str, tokens: &[Token], directives: &[Directive<'_>]) -> Vec<(String, String)> {
    let is_used = |word: &str| tokens.iter().any(|token| &text[token.at.clone()] == word);
    let is_defined =
        |word: &str| directives.iter().any(|d| d.name() == "define" && d.words.get(2) == Some(&word));
    let missing = OTHER_TYPES.iter().filter(|(word, _)| is_used(word) && !is_defined(word));
    missing.map(|(word, meaning)| ((*word).to_owned(), (*meaning).to_owned())).collect()
}

/// Puts `#` in the place of characters that no GLSL has outside of comments: the preprocessor refuses one within a line,
/// but where a condition leaves it out.
fn mark_strange_characters(bytes: &mut [u8], tokens: &[Token]) {
    let is_strange = |byte: u8| !byte.is_ascii() || byte.is_ascii_control() || b"@$`'\"".contains(&byte);
    for token in tokens {
        bytes[token.at.clone()].iter_mut().filter(|byte| is_strange(**byte)).for_each(|byte| *byte = b'#');
    }
}

/// Blanks comments: the preprocessor loses its count of lines of them where a condition leaves them out. One that goes on behind
/// the line of a directive stays, since it continues it.
fn blank_comments(bytes: &mut [u8], tokens: &[Token], directives: &[Directive<'_>]) {
    let starts = core::iter::once(0).chain(tokens.iter().map(|token| token.at.end));
    let ends = tokens.iter().map(|token| token.at.start).chain([bytes.len()]);
    for (start, end) in starts.zip(ends) {
        let last = directives[..directives.partition_point(|directive| directive.at.start <= start)].last();
        let goes_on = last.is_some_and(|directive| start < directive.at.end && end > directive.at.end);
        let gap = &mut bytes[start..end];
        if !(goes_on && gap.trim_ascii_start().starts_with(b"/*")) {
            gap.iter_mut().filter(|byte| !byte.is_ascii_whitespace()).for_each(|byte| *byte = b' ');
        }
    }
}

/// Blanks directives that only tell a driver something; returns whether the version is one of OpenGL ES.
fn blank_directives(bytes: &mut [u8], directives: &[Directive<'_>]) -> bool {
    let mut is_es = false;
    for directive in directives {
        let name = directive.name();
        if matches!(name, "version" | "extension" | "pragma" | "line" | "include") {
            is_es |= name == "version"
                && (directive.words[2..].contains(&"es") || directive.words.get(2) == Some(&"100"));
            let line = &mut bytes[directive.at.clone()];
            line.iter_mut().filter(|byte| !byte.is_ascii_whitespace()).for_each(|byte| *byte = b' ');
        }
    }
    is_es
}
