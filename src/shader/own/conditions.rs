//! What conditions of a preprocessor ask for: which macros let a function be read, and what an engine's own `#ifdef` leaves of a
//! WGSL file.

use super::directives::{Directive, directives};
use super::error::Fault;
use super::scan::tokens;
use super::statements::is_name;
use core::ops::Range;
use std::collections::{BTreeMap, BTreeSet};

/// The macros that have to be defined, with their values, so that a byte of the text is read; those that the text defines itself are
/// left out. A condition of another form asks for nothing.
pub(super) fn needed(directives: &[Directive<'_>], offset: usize) -> BTreeMap<String, String> {
    // Of each condition that is open there, the branch in which the byte stands.
    let mut open: Vec<Option<&Directive<'_>>> = Vec::new();
    let mut own = BTreeSet::new();
    for directive in directives.iter().take_while(|directive| directive.at.start < offset) {
        match directive.name() {
            "if" | "ifdef" => open.push(Some(directive)),
            "ifndef" => open.push(None),
            "elif" => {
                open.pop();
                open.push(Some(directive));
            }
            "else" => {
                open.pop();
                open.push(None);
            }
            "endif" => drop(open.pop()),
            "define" => own.extend(directive.words.get(2).copied()),
            _ => {}
        }
    }
    let mut needed = BTreeMap::new();
    for directive in open.into_iter().flatten() {
        let words = directive.words.get(2..).unwrap_or_default();
        match directive.name() {
            "ifdef" => needed.extend(words.first().map(|name| ((*name).to_owned(), "1".to_owned()))),
            // Of several alternatives the first.
            _ => words.split(|word| *word == "|").next().into_iter().for_each(|all| asked(all, &mut needed)),
        }
    }
    needed.retain(|name, _| !own.contains(name.as_str()));
    needed
}

/// Adds to a message about a name that is nowhere that it stands in a branch which another value of a macro leaves out.
pub(super) fn with_branch(fault: Fault, text: &str) -> Fault {
    let is_of_name =
        ["Unknown function", "Unknown variable", "no definition", "undeclared", "undefined identifier"];
    let Some(at) = fault.at.clone().filter(|_| is_of_name.iter().any(|words| fault.message.contains(words)))
    else {
        return fault;
    };
    let Ok(words) = tokens(text) else { return fault };
    let lines = directives(text, &words);
    let mut open: Vec<&str> = Vec::new();
    for line in lines.iter().take_while(|line| line.at.start < at.start) {
        match line.name() {
            "if" | "ifdef" | "ifndef" => open.push(&line.written),
            "elif" | "else" => {
                open.pop();
                open.push(&line.written);
            }
            "endif" => drop(open.pop()),
            _ => {}
        }
    }
    let Some(branch) = open.last() else { return fault };
    let message = format!(
        "{} (behind `{branch}`: --set NAME=VALUE gives a macro the value of another branch)",
        fault.message
    );
    Fault { message, ..fault }
}

/// What the parts of a condition between `&&` ask for: `defined(A)`, `A`, `A == 2`, `A >= 2`.
fn asked(words: &[&str], needed: &mut BTreeMap<String, String>) {
    for part in words.split(|word| *word == "&") {
        let is_negated = part.contains(&"!");
        let plain: Vec<_> =
            part.iter().copied().filter(|word| !matches!(*word, "(" | ")" | "defined" | "=" | ">")).collect();
        match plain[..] {
            [name] if !is_negated && is_name(name) => drop(needed.insert(name.to_owned(), "1".to_owned())),
            [name, number]
                if !is_negated && is_name(name) && number.bytes().all(|byte| byte.is_ascii_digit()) =>
            {
                drop(needed.insert(name.to_owned(), number.to_owned()));
            }
            _ => {}
        }
    }
}

/// The ranges that stand behind `#if 0`: what they hold is often no longer valid.
pub(super) fn dead(directives: &[Directive<'_>]) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut index = 0;
    while let Some(first) = directives.get(index) {
        index += 1;
        if first.name() != "if" || first.words.get(2..) != Some(&["0"]) {
            continue;
        }
        let mut open = 0_usize;
        let end = directives[index..].iter().position(|directive| {
            match directive.name() {
                "if" | "ifdef" | "ifndef" => open += 1,
                "endif" if open > 0 => open -= 1,
                "elif" | "else" | "endif" if open == 0 => return true,
                _ => {}
            }
            false
        });
        let Some(end) = end else { break };
        index += end;
        found.push(first.at.end..directives[index].at.start);
    }
    found
}

/// The ranges of a WGSL text that an engine's preprocessor leaves out, its lines included: Bevy's `#ifdef`, `#ifndef`, `#if A == 1`,
/// `#else` with or without a further condition, `#endif` and `#define`.
///
/// # Errors
///
/// A condition without an end, and an end of none.
pub(super) fn left_out(
    text: &str,
    directives: &[Directive<'_>],
    settings: &BTreeMap<String, String>,
) -> Result<Vec<Range<usize>>, Fault> {
    struct Open<'d> {
        first: &'d Directive<'d>,
        /// Whether this branch is read, and whether one before it was.
        is_read: bool,
        was_read: bool,
    }
    let mut defined: BTreeMap<&str, &str> =
        settings.iter().map(|(name, value)| (name.as_str(), value.as_str())).collect();
    let mut open: Vec<Open<'_>> = Vec::new();
    let mut out = Vec::new();
    let mut from = 0;
    for directive in directives {
        let is_read = open.iter().all(|open| open.is_read);
        let name = directive.name();
        let words = directive.words.get(2..).unwrap_or_default();
        if !matches!(name, "if" | "ifdef" | "ifndef" | "elif" | "else" | "endif" | "define") {
            continue;
        }
        if !is_read {
            out.push(from..directive.at.start);
        }
        out.push(directive.at.clone());
        from = directive.at.end;
        match name {
            "define" if is_read => {
                let value = words.get(1).copied().unwrap_or("1");
                defined.extend(words.first().map(|name| (*name, value)));
            }
            "if" | "ifdef" | "ifndef" => {
                let is_read = holds(name, words, &defined);
                open.push(Open { first: directive, is_read, was_read: is_read });
            }
            "elif" | "else" => {
                let Some(last) = open.last_mut() else { return Err(without(directive)) };
                let holds = match words.first() {
                    None => true,
                    Some(&further @ ("if" | "ifdef" | "ifndef")) => holds(further, &words[1..], &defined),
                    Some(_) => holds("if", words, &defined),
                };
                last.is_read = !last.was_read && holds;
                last.was_read |= last.is_read;
            }
            "endif" => {
                open.pop().ok_or_else(|| without(directive))?;
            }
            _ => {}
        }
    }
    if let Some(Open { first, .. }) = open.pop() {
        let message = format!("the file ends before this `#{}` has its `#endif`", first.name());
        return Err(Fault::new(message).at(Some(first.at.clone())));
    }
    out.retain(|range| range.start < range.end && range.end <= text.len());
    Ok(out)
}

fn without(directive: &Directive<'_>) -> Fault {
    let message = format!("`#{}` without an `#if` before it", directive.name());
    Fault::new(message).at(Some(directive.at.clone()))
}

fn holds(kind: &str, words: &[&str], defined: &BTreeMap<&str, &str>) -> bool {
    let value = words.first().and_then(|name| defined.get(name));
    match kind {
        "ifdef" => value.is_some(),
        "ifndef" => value.is_none(),
        _ => {
            let number = |word: &str| word.parse::<f64>().unwrap_or(if word == "true" { 1.0 } else { 0.0 });
            let value = value.map_or(0.0, |value| number(value));
            let other = words.last().map_or(0.0, |word| number(word));
            match words.get(1..words.len().saturating_sub(1)).unwrap_or_default() {
                ["=", "="] => value == other,
                ["!", "="] => value != other,
                [">"] => value > other,
                [">", "="] => value >= other,
                ["<"] => value < other,
                ["<", "="] => value <= other,
                _ => value != 0.0,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_macros_that_a_place_stands_behind_are_known() {
        let asked = |condition: &str| {
            let text = format!("#define OWN\n#if X\n#else\n#endif\n{condition}\nhere\n#endif");
            let tokens = tokens(&text).unwrap();
            let needed = needed(&directives(&text, &tokens), text.find("here").unwrap());
            needed.into_iter().map(|(name, value)| format!("{name}={value}")).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(asked("#ifdef A"), "A=1");
        assert_eq!(asked("#if defined(A) && defined B && !defined(C) && D >= 2"), "A=1 B=1 D=2");
        assert_eq!(asked("#if defined( A ) || defined( B )"), "A=1");
        assert_eq!(asked("#if E == 3"), "E=3");
        assert_eq!(asked("#ifndef A"), "");
        assert_eq!(asked("#ifdef A\n#else"), "");
        assert_eq!(asked("#ifdef OWN"), "");
        assert_eq!(asked("#if X\n#elif defined(Y)"), "Y=1");
    }

    #[test]
    fn what_stands_behind_a_zero_is_dead() {
        let text =
            "#if 0\na\n#ifdef X\nb\n#else\nc\n#endif\n#else\nd\n#endif\n#if 1\ne\n#endif\n#if 0\nf\n#endif";
        let tokens = tokens(text).unwrap();
        let dead = dead(&directives(text, &tokens));
        let words: Vec<_> = dead
            .into_iter()
            .map(|range| text[range].split_whitespace().collect::<Vec<_>>().join(" "))
            .collect();
        assert_eq!(words, ["a #ifdef X b #else c #endif", "f"]);
    }

    #[test]
    fn an_engines_conditions_leave_out_what_they_say() {
        let left = |text: &str, set: &[(&str, &str)]| {
            let tokens = tokens(text).unwrap();
            let set = set.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
            let out = left_out(text, &directives(text, &tokens), &set).unwrap();
            let mut bytes = text.as_bytes().to_vec();
            out.into_iter().for_each(|range| bytes[range].fill(b' '));
            String::from_utf8(bytes).unwrap().split_whitespace().collect::<Vec<_>>().join(" ")
        };
        let text = "#ifdef A\na\n#ifdef B\nb\n#endif\n#else ifdef C\nc\n#else\nd\n#endif\ne";
        assert_eq!(left(text, &[("A", "1")]), "a e");
        assert_eq!(left(text, &[("A", "1"), ("B", "")]), "a b e");
        assert_eq!(left(text, &[("C", "1"), ("B", "1")]), "c e");
        assert_eq!(left(text, &[]), "d e");
        let text = "#define N 3\n#if N >= 2\na\n#endif\n#if N != 3\nb\n#endif\n#ifndef N\nc\n#endif";
        assert_eq!(left(text, &[]), "a");
        for wrong in ["#ifdef A", "#endif", "#else"] {
            let tokens = tokens(wrong).unwrap();
            assert!(left_out(wrong, &directives(wrong, &tokens), &BTreeMap::new()).is_err());
        }
    }
}
