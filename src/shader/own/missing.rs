//! Names that a file reads and does not declare, since its engine declares them: what the user says of them, or what their name says,
//! is put in.

use super::head::{Dialect, File, Head};
use super::items::reached;
use super::options::Options;
use super::signature::type_of;
use super::sources::Put;
use super::statements::is_name;
use super::usual::meaning_of;
use core::ops::Range;
use naga::TypeInner;
use std::collections::{BTreeMap, BTreeSet, HashSet};

/// What is put in, in order; `asked` loses what has gone into the text.
pub(super) fn put_in(file: &File<'_, '_>, asked: &mut Options) -> Vec<(Range<usize>, Put)> {
    let first: HashSet<_> = [asked.function.as_str()].into_iter().collect();
    let reached = reached(file.text, file.tokens, file.directives, file.items, first);
    let reached: BTreeSet<String> = reached.into_iter().map(str::to_owned).collect();
    let foreign = foreign(file);
    let mut edits = Vec::new();
    let mut declared = BTreeMap::new();
    // Looked for once a name, since a file may have many words.
    let mut known: BTreeMap<&str, bool> = BTreeMap::new();
    for at in 0..file.tokens.len() {
        let word = file.word(at);
        let is_member = at > 0 && file.word(at - 1) == ".";
        // What a structure of an engine has, however deep.
        if !is_member && foreign.contains(&(file.tokens[at].function, word)) {
            let mut last = at;
            while file.word(last + 1) == "."
                && is_name(file.word(last + 2))
                && !is_swizzle(file.word(last + 2))
            {
                last += 2;
            }
            let own = file.word(last);
            let said = asked.map.iter().find(|(_, name)| *name == own).map(|(meaning, _)| meaning.clone());
            let meaning = said.or_else(|| meaning_of(own).map(str::to_owned));
            if let Some(meaning) = meaning.filter(|_| last > at) {
                let range = file.tokens[at].at.start..file.tokens[last].at.end;
                edits.push((range, Put::Words(own.to_owned())));
                declared.insert(own.to_owned(), meaning);
            }
            continue;
        }
        if !is_name(word)
            || is_member
            || file.in_directive[at]
            || !reached.contains(word)
            || *known.entry(word).or_insert_with(|| is_declared(file, word))
        {
            continue;
        }
        let member = Some(file.word(at + 2))
            .filter(|member| file.word(at + 1) == "." && is_name(member) && !is_swizzle(member));
        let full = member.map(|member| format!("{word}.{member}"));
        let here = |last: usize| file.tokens[at].at.start..file.tokens[last].at.end;
        // A value that is the same everywhere.
        let set = |name: &str| asked.settings.get(name).and_then(|value| literal(value, file.dialect));
        if let Some(value) = full.as_deref().and_then(set) {
            edits.push((here(at + 2), Put::Words(value)));
            continue;
        }
        if let Some(value) = set(word).filter(|_| member.is_none()) {
            edits.push((here(at), Put::Words(value)));
            continue;
        }
        // A value of the fragment, by what the user says, then by its name.
        let said =
            |name: &str| asked.map.iter().find(|(_, said)| *said == name).map(|(meaning, _)| meaning.clone());
        let own = member.unwrap_or(word);
        let meaning = full
            .as_deref()
            .and_then(said)
            .or_else(|| said(own))
            .or_else(|| meaning_of(own).map(str::to_owned));
        let is_called = file.word(at + 1) == "(" || word.starts_with("gl_");
        let Some(meaning) = meaning.filter(|_| !is_called) else { continue };
        // Where the user means another name by it, this one stays what it is.
        let is_said = |name: &str| asked.map.get(&meaning).is_none_or(|said| said == name);
        if !is_said(own) && !full.as_deref().is_some_and(is_said) {
            continue;
        }
        if member.is_some() {
            edits.push((here(at + 2), Put::Words(own.to_owned())));
        }
        declared.insert(own.to_owned(), meaning.clone());
        // It goes by its own name from here on.
        if asked.map.contains_key(&meaning) {
            asked.map.insert(meaning, own.to_owned());
        }
    }
    let used: BTreeSet<String> = asked.settings.keys().cloned().collect();
    for name in used {
        let base = name.split('.').next().unwrap_or_default();
        if reached.contains(base)
            && !is_declared(file, base)
            && literal(&asked.settings[&name], file.dialect).is_some()
        {
            asked.settings.remove(&name);
        }
    }
    if !declared.is_empty() {
        let lines: Vec<_> =
            declared.iter().map(|(name, meaning)| declaration(name, meaning, file.dialect)).collect();
        edits.insert(0, (0..0, Put::Words(lines.join(" ") + "\n")));
    }
    edits
}

/// Whether a member is made of the components of a vector.
fn is_swizzle(member: &str) -> bool {
    (1..=4).contains(&member.len())
        && (member.bytes().all(|byte| b"xyzw".contains(&byte))
            || member.bytes().all(|byte| b"rgba".contains(&byte)))
}

/// Parameters of a type that only an engine declares, each with the function that has it.
fn foreign<'t>(file: &File<'_, 't>) -> HashSet<(Option<usize>, &'t str)> {
    const BUILT_IN: [&str; 19] = [
        "vec", "ivec", "uvec", "bvec", "dvec", "mat", "float", "int", "uint", "bool", "half", "min16", "f32",
        "f16", "u32", "i32", "sampler", "texture", "Texture",
    ];
    let is_structure = |name: &str| {
        let is_declared = (1..file.tokens.len()).any(|at| {
            file.word(at) == name && matches!(file.word(at - 1), "struct" | "alias" | "typedef" | "define")
        });
        !is_declared
            && !BUILT_IN.iter().any(|ty| name.starts_with(ty))
            && name.starts_with(|c: char| c.is_ascii_uppercase())
    };
    let heads = file.items.iter().filter_map(|item| Head::of(file, item));
    let of_head = |head: Head<'t>| {
        let parameters = head.parameters.into_iter().filter(|parameter| {
            parameter
                .tokens
                .clone()
                .map(|at| file.word(at))
                .any(|word| word != parameter.name && is_structure(word))
        });
        parameters.map(|parameter| (Some(head.name), parameter.name)).collect::<Vec<_>>()
    };
    heads.flat_map(of_head).collect()
}

/// Whether a text declares a name, as a variable, a parameter, a function, a type or a macro.
fn is_declared(file: &File<'_, '_>, name: &str) -> bool {
    const NO_TYPES: [&str; 6] = ["return", "else", "case", "in", "out", "discard"];
    let is_macro = file.directives.iter().any(|line| line.words.get(2) == Some(&name));
    is_macro
        || (0..file.tokens.len()).filter(|&at| file.word(at) == name && !file.in_directive[at]).any(|at| {
            let before = at.checked_sub(1).map_or("", |before| file.word(before));
            let behind = file.word(at + 1);
            let has_type = is_name(before) && !NO_TYPES.contains(&before)
                || before == ">" && file.dialect == Dialect::Wgsl;
            let is_listed = before == "," && file.tokens[at].parentheses == 0;
            let is_field = file.dialect == Dialect::Wgsl && behind == ":";
            // `{ name };`, as the name of a structure behind its body.
            let is_instance = before == "}" && matches!(behind, ";" | "[" | ",");
            has_type || is_listed || is_field || is_instance
        })
}

/// A value as a language writes it; nothing for what is no number and no vector.
fn literal(written: &str, dialect: Dialect) -> Option<String> {
    let parts: Vec<_> = written.split(',').map(str::trim).collect();
    let is_number = |part: &&str| part.parse::<f64>().is_ok_and(f64::is_finite);
    if !parts.iter().all(|part| is_number(part) || matches!(*part, "true" | "false")) {
        return None;
    }
    Some(match (parts.len(), dialect) {
        (1, _) => format!("({})", parts[0]),
        (2..=4, Dialect::Glsl) => format!("vec{}({})", parts.len(), parts.join(", ")),
        (2..=4, Dialect::Hlsl) => format!("float{}({})", parts.len(), parts.join(", ")),
        (2..=4, Dialect::Wgsl) => format!("vec{}<f32>({})", parts.len(), parts.join(", ")),
        _ => return None,
    })
}

/// Declares a name as what the fragment has for a meaning.
fn declaration(name: &str, meaning: &str, dialect: Dialect) -> String {
    let inner = type_of(meaning).inner;
    let (size, is_whole) = match inner {
        TypeInner::Vector { size, .. } => (size as usize, false),
        TypeInner::Scalar(scalar) => (1, scalar == naga::Scalar::U32),
        _ => (1, false),
    };
    let ty = match (dialect, size, is_whole) {
        (Dialect::Wgsl, 1, false) => "f32".to_owned(),
        (Dialect::Wgsl, 1, true) => "u32".to_owned(),
        (Dialect::Wgsl, ..) => format!("vec{size}<f32>"),
        (_, 1, true) => "uint".to_owned(),
        (_, 1, false) => "float".to_owned(),
        (Dialect::Glsl, ..) => format!("vec{size}"),
        (Dialect::Hlsl, ..) => format!("float{size}"),
    };
    match dialect {
        Dialect::Wgsl => format!("var<private> {name}: {ty};"),
        Dialect::Glsl => format!("in {ty} {name};"),
        Dialect::Hlsl => format!("uniform {ty} {name};"),
    }
}
