//! WGSL as it is written for an engine or for a browser.

use super::derivative;
use super::directives::directives;
use super::error::{Fault, Place};
use super::front::Front;
use super::invalid::{joined, validate};
use super::isolated::isolated;
use super::items;
use super::nesting::Nesting;
use super::options::Options;
use super::scan::{Token, end_of_file, tokens};
use super::signature::without_test;
use naga::front::wgsl::ParseError;

/// Reads and validates a text; the derivatives of the position in the body of the function become variables.
///
/// # Errors
///
/// Text that is no WGSL or not valid.
pub(super) fn read(text: &str, asked: &Options) -> Result<Front, Fault> {
    let tokens = tokens(text)?;
    let mut nesting = Nesting::of_functions();
    for Token { at, .. } in &tokens {
        nesting.see(&text[at.clone()]).map_err(|message| Fault::new(message).at(Some(at.clone())))?;
    }
    let mut bytes = text.as_bytes().to_vec();
    blank_imports(&mut bytes, &tokens)?;
    let directives = directives(text, &tokens);
    items::blank_others(&mut bytes, text, &tokens, &directives, &asked.function, &asked.names());
    widen(&mut bytes, &tokens);
    let position = derivative::position(text, &tokens, asked);
    let derivatives = derivative::replace(&mut bytes, &tokens, &asked.function, position);
    // Only ASCII was replaced, by ASCII.
    let mut prepared = String::from_utf8_lossy(&bytes).into_owned();
    if let Some(variables) = &derivatives {
        prepared.push_str(&derivative::wgsl(variables));
    }
    let length = text.trim_end().len();
    let function = asked.function.clone();
    let read = isolated(move || {
        let module = naga::front::wgsl::parse_str(&prepared).map_err(|error| said(&error, &prepared))?;
        validate(&module)?;
        if module.entry_points.iter().any(|entry| entry.name == function) {
            return Err(Fault::new(without_test(&function)));
        }
        Ok(Front::plain(module, derivatives))
    });
    read.map_err(|fault| match &fault.at {
        Some(at) if at.start >= length => end_of_file(text, &tokens).unwrap_or(fault),
        _ => fault,
    })
}

/// Makes numbers of 16 bits numbers of 32, and push constants what naga calls them.
fn widen(bytes: &mut [u8], tokens: &[Token]) {
    let word =
        |bytes: &[u8], at: usize| tokens.get(at).map_or(Vec::new(), |token| bytes[token.at.clone()].to_vec());
    for (index, token) in tokens.iter().enumerate() {
        let at = token.at.clone();
        match &word(bytes, index)[..] {
            b"enable" if word(bytes, index + 1) == b"f16" => {
                tokens[index..(index + 3).min(tokens.len())]
                    .iter()
                    .for_each(|token| bytes[token.at.clone()].fill(b' '));
            }
            b"f16" => bytes[at].copy_from_slice(b"f32"),
            b"push_constant" => {
                bytes[at.clone()].fill(b' ');
                bytes[at.start..at.start + 9].copy_from_slice(b"immediate");
            }
            [b'v', b'e', b'c', b'2'..=b'4', b'h'] => bytes[at.end - 1] = b'f',
            [b'0'..=b'9', .., b'h'] if !bytes[at.clone()].starts_with(b"0x") => bytes[at.end - 1] = b'f',
            _ => {}
        }
    }
}

/// What naga's parser says. A single label repeats the message in other words, unless it names a type; of several, each
/// but the first has a place of its own.
fn said(error: &ParseError, text: &str) -> Fault {
    let at = error.labels().next().and_then(|(span, _)| span.to_range());
    let several = error.labels().len() > 1;
    let labels = error.labels().enumerate().filter(|(_, (_, label))| several || label.contains(" type "));
    let labels = labels.filter(|(_, (_, label))| !label.is_empty() && *label != "see msg").map(
        |(index, (span, label))| match span.to_range() {
            Some(range) if index > 0 => format!("{label} (line {})", Place::of(text, range.start).line),
            _ => label.to_owned(),
        },
    );
    let notes = error.notes().map(str::to_owned);
    Fault::new(joined(error.message(), labels.chain(notes))).at(at)
}

/// Blanks the lines by which an engine puts a WGSL file together, `#import` and `#define_import_path`; what they bring is
/// not here.
fn blank_imports(bytes: &mut [u8], tokens: &[Token]) -> Result<(), Fault> {
    let word =
        |bytes: &[u8], at: usize| tokens.get(at).map_or(Vec::new(), |token| bytes[token.at.clone()].to_vec());
    for (index, token) in tokens.iter().enumerate() {
        if word(bytes, index) != b"#" {
            continue;
        }
        if !matches!(&word(bytes, index + 1)[..], b"import" | b"include" | b"define_import_path") {
            let message = "WGSL has no directives; those of an engine are to be carried out before";
            return Err(Fault::new(message).at(Some(token.at.clone())));
        }
        let line = bytes[token.at.start..].iter().position(|&byte| byte == b'\n');
        let mut end = line.map_or(bytes.len(), |length| token.at.start + length);
        if bytes[token.at.start..end].contains(&b'{') {
            // A list may go over several lines.
            let mut open = 0_i32;
            let close = tokens[index..].iter().find(|token| {
                open += match bytes[token.at.start] {
                    b'{' => 1,
                    b'}' => -1,
                    _ => 0,
                };
                open == 0 && bytes[token.at.start] == b'}'
            });
            end = end.max(close.map_or(bytes.len(), |close| close.at.end));
        }
        bytes[token.at.start..end]
            .iter_mut()
            .filter(|byte| !byte.is_ascii_whitespace())
            .for_each(|byte| *byte = b' ');
    }
    Ok(())
}
