//! What is read of a file before its parser: the files that it includes, the branches of an engine's conditions, the function that
//! is meant, and its test of an alpha.

use super::alpha_test::rewritten;
use super::conditions::{dead, left_out, needed};
use super::definitions::wanted;
use super::directives::{Directive, directives, functions, in_directives};
use super::error::Fault;
use super::head::{Dialect, File};
use super::includes::Includes;
use super::items::{Item, items, reached};
use super::missing::put_in;
use super::options::{ALPHA, LARGEST_FILE, Options, THRESHOLD};
use super::scan::{Token, tokens};
use super::signature::absent;
use super::sources::Sources;
use core::ops::Range;
use std::collections::BTreeSet;
use std::path::Path;

/// A text that is ready for its parser.
pub(super) struct Unit {
    pub text: String,
    /// What is asked of it: the name of the function, and what has to be set so that it is read.
    pub asked: Options,
    /// The name of the function in the file.
    pub named: String,
    /// What was done, in sentences.
    pub notes: Vec<String>,
    /// Names of what holds the place of the fragment on the screen, whatever they sound like.
    pub pixels: BTreeSet<String>,
}

/// Makes a text ready; `sources` knows afterwards where its bytes come from. `folder` is where its file is.
///
/// # Errors
///
/// What is wrong with the text as a whole, and a test that discards the wrong way around.
pub(super) fn unit(
    text: String,
    dialect: Dialect,
    asked: &Options,
    folder: Option<&Path>,
    sources: &mut Sources,
) -> Result<Unit, Fault> {
    let mut notes = Vec::new();
    let mut asked = asked.clone();
    let mut text = text;
    if dialect == Dialect::Wgsl {
        text = without_holes(&text, &mut asked);
    } else {
        text = without(&text, |_, lines| Ok(dead(lines)))?;
        let mut includes = Includes { folders: &asked.include, most: LARGEST_FILE, read: BTreeSet::new() };
        text = includes.expand(text, sources, folder, 0)?;
        text = without(&text, |words, lines| Ok([dead(lines), line_macros(&text, words, lines)].concat()))?;
    }
    cut(&text, dialect, |file| {
        if let Some(name) = meant(file, &asked) {
            notes.push(is_taken(&name));
            asked.function = name;
        }
        refuse_absent(file, &asked)?;
        let names = file.items.iter().filter_map(|item| item.function);
        let names = names.filter(|&name| file.word(name) == asked.function);
        let places: Vec<_> = names.map(|name| file.tokens[name].at.start).collect();
        // Where one of several stands there without a word, that is the one.
        let is_read = |&at: &usize| needed(file.directives, at).is_empty();
        let place = if places.iter().any(is_read) { None } else { places.first().copied() };
        define(place, file.directives, &mut asked, &mut notes);
        define_reached(file, &mut asked, &mut notes);
        Ok(())
    })?;
    if dialect == Dialect::Wgsl {
        let settings = asked.settings.clone();
        let mut macros = BTreeSet::new();
        text = without(&text, |_, lines| {
            macros.extend(
                lines.iter().flat_map(|line| line.words.iter().skip(2).map(|word| (*word).to_owned())),
            );
            left_out(&text, lines, &settings)
        })?;
        asked.settings.retain(|name, _| !macros.contains(name));
    }
    let edits = cut(&text, dialect, |file| Ok(put_in(file, &mut asked)))?;
    if !edits.is_empty() {
        text = sources.exchange(&text, edits);
    }
    let (pixels, test) = cut(&text, dialect, |file| {
        notes.extend(precision(file, &asked));
        let test = rewritten(file, &asked)?;
        define(test.as_ref().map(|test| test.at), file.directives, &mut asked, &mut notes);
        Ok((pixels(file), test))
    })?;
    let Some(test) = test else {
        let exchanged = cut(&text, dialect, |file| Ok(exchanged(file, &asked)))?;
        notes.extend(exchanged.map(|Fault { message, at, .. }| {
            let line = at.and_then(|at| sources.locate(at.start)).map_or(0, |(_, place)| place.line);
            format!("line {line}: {message}")
        }));
        let named = asked.function.clone();
        return Ok(Unit { text, asked, named, notes, pixels });
    };
    let blanked = blanked(&text, test.blank);
    let named = core::mem::replace(&mut asked.function, test.function);
    // What has gone into the test needs no value any more.
    asked.map.remove(ALPHA);
    let line = |at: usize| sources.locate(at).map_or(0, |(_, place)| place.line);
    let [alpha, threshold] = &test.sides;
    let mut note = format!(
        "the threshold is what `{alpha}` is compared with in line {}, in `{named}`: `{threshold}`",
        line(test.at)
    );
    if !test.others.is_empty() {
        let lines: Vec<_> = test.others.iter().map(|&at| line(at).to_string()).collect();
        note += &format!("; it is compared in line {}, too, which is left out", lines.join(", "));
    }
    if !test.behind.is_empty() {
        note += &format!("; it stands behind {}, elsewhere nothing is looked at", test.behind.join(" and "));
    }
    notes.push(note);
    let text = sources.exchange(&blanked, test.edits);
    cut(&text, dialect, |file| {
        define_reached(file, &mut asked, &mut notes);
        Ok(())
    })?;
    Ok(Unit { text, asked, named, notes, pixels })
}

/// Cuts a text into words, lines of a preprocessor and items, and looks at them.
fn cut<R>(
    text: &str,
    dialect: Dialect,
    look: impl FnOnce(&File<'_, '_>) -> Result<R, Fault>,
) -> Result<R, Fault> {
    let words = tokens(text)?;
    let lines = directives(text, &words);
    let in_directive = in_directives(&lines, words.len());
    let items = items(text, &words, &lines);
    look(&File {
        text,
        tokens: &words,
        directives: &lines,
        in_directive: &in_directive,
        items: &items,
        dialect,
    })
}

/// Blanks ranges of a text.
fn blanked(text: &str, ranges: Vec<Range<usize>>) -> String {
    let mut bytes = text.as_bytes().to_vec();
    for range in ranges {
        bytes[range].iter_mut().filter(|byte| !byte.is_ascii_whitespace()).for_each(|byte| *byte = b' ');
    }
    // Whole words went.
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Blanks what is found in a text.
fn without(
    text: &str,
    find: impl FnOnce(&[Token], &[Directive<'_>]) -> Result<Vec<Range<usize>>, Fault>,
) -> Result<String, Fault> {
    let words = tokens(text)?;
    let found = find(&words, &directives(text, &words))?;
    Ok(if found.is_empty() { text.to_owned() } else { blanked(text, found) })
}

/// Fills the holes of an engine's templates in WGSL, `#{NAME}`, with what `--set` gives, or 0.
fn without_holes(text: &str, asked: &mut Options) -> String {
    let mut filled = text.to_owned();
    let mut used = BTreeSet::new();
    while let Some(start) = filled.find("#{") {
        let Some(length) = filled[start..].find('}') else { break };
        let name = filled[start + 2..start + length].trim();
        let value =
            asked.settings.get(name).filter(|value| value.len() <= length).map_or("0", String::as_str);
        let value = format!("{value:width$}", width = length + 1);
        used.insert(name.to_owned());
        filled.replace_range(start..=start + length, &value);
    }
    asked.settings.retain(|name, _| !used.contains(name));
    filled
}

/// Lines that hold nothing but a macro of an engine which the file does not define, as `CBUFFER_END` or `UNITY_INSTANCING_START(a)`.
fn line_macros(text: &str, tokens: &[Token], lines: &[Directive<'_>]) -> Vec<Range<usize>> {
    let in_directive = in_directives(lines, tokens.len());
    let defined: BTreeSet<_> = lines
        .iter()
        .filter(|line| line.name() == "define")
        .filter_map(|line| line.words.get(2).copied())
        .collect();
    let word = |at: usize| tokens.get(at).map_or("", |token| &text[token.at.clone()]);
    let is_first = |at: usize| at == 0 || text[tokens[at - 1].at.end..tokens[at].at.start].contains('\n');
    let is_loud = |word: &str| {
        word.len() > 3 && word.bytes().all(|b| b.is_ascii_uppercase() || b.is_ascii_digit() || b == b'_')
    };
    let mut found = Vec::new();
    for at in (0..tokens.len()).filter(|&at| !in_directive[at] && is_first(at)) {
        let is_outside = tokens[at].function.is_none() && tokens[at].parentheses == 0;
        if !is_outside || !is_loud(word(at)) || defined.contains(word(at)) {
            continue;
        }
        let mut end = at + 1;
        if word(end) == "(" {
            end = (end..tokens.len())
                .find(|&close| word(close) == ")" && tokens[close].parentheses == 0)
                .map_or(tokens.len(), |close| close + 1);
        }
        let is_alone =
            end >= tokens.len() || text[tokens[end - 1].at.end..tokens[end].at.start].contains('\n');
        let is_one_line = !text[tokens[at].at.start..tokens[end - 1].at.end].contains('\n');
        if is_alone && is_one_line {
            found.push(tokens[at].at.start..tokens[end - 1].at.end);
        }
    }
    found
}

/// Sets what has to be defined so that a place is read.
fn define(at: Option<usize>, lines: &[Directive<'_>], asked: &mut Options, notes: &mut Vec<String>) {
    for (name, value) in at.map(|at| needed(lines, at)).unwrap_or_default() {
        if !asked.settings.contains_key(&name) {
            notes
                .push(format!("`{name}` is defined as {value}, since `{}` stands behind it", asked.function));
            asked.settings.insert(name, value);
        }
    }
}

/// Sets what has to be defined so that what the function comes to is read.
fn define_reached(file: &File<'_, '_>, asked: &mut Options, notes: &mut Vec<String>) {
    for (behind, macros) in wanted(file, &asked.function, &asked.settings) {
        for (name, value) in macros {
            notes.push(format!("`{name}` is defined as {value}, since `{behind}` stands behind it"));
            asked.settings.insert(name, value);
        }
    }
}

/// Refuses a function that is nowhere, before anything else of the file is looked at; a macro may still make it.
fn refuse_absent(file: &File<'_, '_>, asked: &Options) -> Result<(), Fault> {
    let is_there = (0..file.tokens.len()).any(|at| file.word(at) == asked.function);
    if is_there {
        return Ok(());
    }
    let functions = functions(file.text, file.tokens, file.directives)?;
    Err(Fault::absent(absent(&asked.function, &functions)))
}

/// The test of what a function returns, in another one, where it discards the wrong way around.
fn exchanged(file: &File<'_, '_>, asked: &Options) -> Option<Fault> {
    let calls = |item: &&Item<'_>| item.tokens.clone().any(|at| file.word(at) == asked.function);
    let others = file.items.iter().filter(calls).filter_map(|item| item.function).map(|name| file.word(name));
    others.filter(|name| *name != asked.function).find_map(|name| {
        let asked = Options { function: name.to_owned(), ..asked.clone() };
        rewritten(file, &asked).err()
    })
}

/// Says that another function is taken for the one that goes without saying.
pub(super) fn is_taken(name: &str) -> String {
    format!("there is no function `{THRESHOLD}`, and `{name}` is taken for it (--function names another)")
}

/// The function that is meant where none is named and none has the name that goes without saying: the only one that sounds like a
/// hashed threshold, or the only one that has a test of an alpha; nothing where that is not certain.
fn meant(file: &File<'_, '_>, asked: &Options) -> Option<String> {
    let functions: BTreeSet<&str> =
        file.items.iter().filter_map(|item| item.function).map(|name| file.word(name)).collect();
    if asked.function != THRESHOLD || functions.contains(THRESHOLD) {
        return None;
    }
    let has_test = |name: &&&str| {
        let asked = Options { function: (**name).to_owned(), ..asked.clone() };
        // One that is the wrong way around is told as that.
        rewritten(file, &asked).map_or(true, |test| test.is_some())
    };
    let tests = || {
        let mut found = functions.iter().filter(has_test);
        found.next().copied().filter(|_| found.next().is_none())
    };
    sounding(&functions).or_else(tests).map(str::to_owned)
}

/// The only name of several that says that it is a hashed threshold.
pub(super) fn sounding<'n>(names: &BTreeSet<&'n str>) -> Option<&'n str> {
    let is_like = |name: &str, parts: &[&str]| {
        let plain: String = name.chars().filter(|c| *c != '_').flat_map(char::to_lowercase).collect();
        parts.iter().all(|part| plain.contains(part))
    };
    let kinds: [&[&str]; 10] = [
        &["hash", "thresh"],
        &["thresh"],
        &["hash", "cutoff"],
        &["alpha", "hash"],
        &["hash", "test"],
        &["hash", "opacity"],
        &["hash", "discard"],
        &["hash", "clip"],
        &["should", "discard"],
        &["alpha", "test"],
    ];
    kinds.into_iter().find_map(|parts| {
        let mut found = names.iter().filter(|name| is_like(name, parts));
        found.next().copied().filter(|_| found.next().is_none())
    })
}

/// Says that fewer bits than 32 are not what is tried, where the function comes to words that ask for them.
fn precision(file: &File<'_, '_>, asked: &Options) -> Option<String> {
    const NARROW: [&str; 18] = [
        "mediump",
        "lowp",
        "half",
        "half2",
        "half3",
        "half4",
        "float16_t",
        "f16vec2",
        "f16vec3",
        "f16vec4",
        "min16float",
        "min16float2",
        "min16float3",
        "min16float4",
        "f16",
        "vec2h",
        "vec3h",
        "vec4h",
    ];
    let names = [asked.function.as_str()].into_iter().collect();
    let all = reached(file.text, file.tokens, file.directives, file.items, names);
    let word = NARROW.iter().find(|word| all.contains(*word))?;
    Some(format!(
        "`{word}` is computed in 32 bits; what 16 make of the threshold on a device that has them is tried with --on device-model"
    ))
}

/// What a text marks as the place on the screen: `@builtin(position)` in WGSL, `: SV_Position` in HLSL.
fn pixels(file: &File<'_, '_>) -> BTreeSet<String> {
    let marked = (1..file.tokens.len()).filter_map(|at| match file.dialect {
        Dialect::Wgsl if file.word(at) == "builtin" && file.word(at + 2) == "position" => {
            Some(file.word(at + 4))
        }
        Dialect::Hlsl if file.word(at).eq_ignore_ascii_case("sv_position") && at > 1 => {
            Some(file.word(at - 2))
        }
        Dialect::Wgsl | Dialect::Hlsl | Dialect::Glsl => None,
    });
    marked.map(str::to_owned).collect()
}
