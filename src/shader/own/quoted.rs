//! Shaders in the texts of other programs: between the backticks of JavaScript, TypeScript and Go, the quotes of Python, Java and Swift,
//! the raw strings of C++, Rust and C#, the long brackets of Lua, the `<script>` of a page.

use super::error::Fault;
use super::options::THRESHOLD;
use super::scan::tokens;
use super::unit::sounding;
use crate::shader::spelling::likely;
use core::ops::Range;
use std::collections::BTreeSet;

/// A string literal of a program.
struct Literal {
    /// What stands between the quotes.
    at: Range<usize>,
    /// The same with them.
    whole: Range<usize>,
    /// Whether it ends with its line; a shader is then made of many.
    is_line: bool,
}

/// Literals that follow each other, as one text.
struct Group {
    at: Range<usize>,
    shown: String,
}

/// Puts literals together between which nothing stands but what joins them.
fn groups(text: &str) -> Vec<Group> {
    let literals = literals(text);
    let is_next = |a: &Literal, b: &Literal| {
        let between = &text[a.whole.end..b.whole.start];
        between.bytes().all(|byte| byte.is_ascii_whitespace() || b",+\\".contains(&byte))
    };
    let shown = |literals: &[Literal]| {
        let at = literals[0].at.start..literals[literals.len() - 1].at.end;
        let mut bytes = text.as_bytes()[at.clone()].to_vec();
        let mut kept = vec![false; bytes.len()];
        let here = |range: &Range<usize>| range.start - at.start..range.end - at.start;
        for Literal { at: own, is_line, .. } in literals {
            kept[here(own)].fill(true);
            if !is_line {
                holes(text, own).iter().for_each(|hole| kept[here(hole)].fill(false));
                continue;
            }
            for escape in escapes(text, own) {
                kept[here(&escape)].fill(false);
                // A literal may hold several lines.
                if text[escape.clone()].ends_with('n') && escape.end < own.end {
                    (bytes[escape.end - 1 - at.start], kept[escape.end - 1 - at.start]) = (b'\n', true);
                }
            }
        }
        let goes = |(byte, kept): &(&mut u8, bool)| !kept && **byte != b'\n';
        bytes.iter_mut().zip(kept).filter(goes).for_each(|(byte, _)| *byte = b' ');
        Group { at, shown: String::from_utf8_lossy(&bytes).into_owned() }
    };
    literals.chunk_by(is_next).map(shown).collect()
}

/// Blanks all but the string literal, or the literals that follow each other, in which `function` is defined; no byte moves. Where
/// the text defines it outside of all literals, it is a shader as it stands: headers of shaders have the endings of C. Where none is
/// named, one that sounds like it is taken, and otherwise the text that discards.
///
/// # Errors
///
/// No literal that defines it, and several.
pub(super) fn uncovered(text: &str, function: &mut String) -> Result<String, Fault> {
    let groups = groups(text);
    if *function == THRESHOLD && defined(text, function).is_none() {
        let names: BTreeSet<_> = groups.iter().flat_map(|group| functions(&group.shown)).collect();
        if let Some(name) = sounding(&names.iter().map(String::as_str).collect()) {
            name.clone_into(function);
        }
    }
    let function = function.as_str();
    let is_nowhere =
        function == THRESHOLD && groups.iter().all(|group| defined(&group.shown, function).is_none());
    // Where no name says which function is meant, the literal that discards has it.
    let discards = |group: &&Group| group.shown.contains("discard");
    let defines = |group: &&Group| defined(&group.shown, function).is_some() || is_nowhere && discards(group);
    let mut defining: Vec<_> = groups.iter().filter(defines).collect();
    // Of several `main` that which discards.
    if defining.len() > 1 && defining.iter().filter(|group| discards(group)).count() == 1 {
        defining.retain(discards);
    }
    match defining[..] {
        [group] => {
            let mut bytes: Vec<u8> =
                text.bytes().map(|byte| if byte == b'\n' { b'\n' } else { b' ' }).collect();
            for Group { at, shown } in with_helpers(group, &groups) {
                bytes[at.clone()].copy_from_slice(shown.as_bytes());
            }
            Ok(without_placeholders(&String::from_utf8_lossy(&bytes)))
        }
        [] if defined(text, function).is_some() => Ok(text.to_owned()),
        [] => {
            let names: Vec<_> = groups.iter().flat_map(|group| functions(&group.shown)).collect();
            let likely = likely(function, &names);
            let known = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
            Err(Fault::absent(format!(
                "no text between quotes defines a function `{function}`.{likely} --function NAME takes one of another name; functions \
                 between quotes are {known}"
            )))
        }
        [_, second, ..] => {
            let message = format!(
                "`{function}` is defined in several string literals of the file; this is the second: copy the one that is meant into \
                 a file"
            );
            Err(Fault::new(message).at(Some(second.at.start..second.at.start + 1)))
        }
    }
}

/// A text, and those that define what it calls and does not define: a program puts them together.
fn with_helpers<'g>(group: &'g Group, groups: &'g [Group]) -> Vec<&'g Group> {
    let mut all = vec![group];
    let mut next = 0;
    while let Some(group) = all.get(next).copied() {
        next += 1;
        let known: BTreeSet<String> = all.iter().flat_map(|group| functions(&group.shown)).collect();
        for name in called(&group.shown).into_iter().filter(|name| !known.contains(name)) {
            let mut defining = groups.iter().filter(|other| defined(&other.shown, &name).is_some());
            if let (Some(other), None) = (defining.next(), defining.next())
                && !all.iter().any(|known| known.at == other.at)
            {
                all.push(other);
            }
        }
    }
    all
}

/// The names in front of a bracket.
fn called(text: &str) -> BTreeSet<String> {
    let Ok(tokens) = tokens(text) else { return BTreeSet::new() };
    let word = |at: usize| tokens.get(at).map_or("", |token| &text[token.at.clone()]);
    let is_call = |&at: &usize| {
        word(at + 1) == "(" && !matches!(word(at), "if" | "for" | "while" | "switch" | "return" | "layout")
    };
    (0..tokens.len()).filter(is_call).map(|at| word(at).to_owned()).collect()
}

/// Blanks the `%(name)s` of Python.
fn without_placeholders(text: &str) -> String {
    let mut text = text.to_owned();
    while let Some(start) = text.find("%(") {
        let length = text[start..].find(")s").map(|at| at + 2);
        let is_name = |length: &usize| {
            text[start + 2..start + length - 2].bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
        };
        // A remainder of a bracket is no placeholder.
        let length = length.filter(is_name).unwrap_or(0);
        if length == 0 {
            break;
        }
        text.replace_range(start..start + length, &" ".repeat(length));
    }
    text
}

/// The lines of a program, from 1, in which a template that is shown leaves something to it.
pub(super) fn gaps(text: &str, shown: &str) -> Vec<usize> {
    let start = shown.len() - shown.trim_start().len();
    let within = start..shown.trim_end().len();
    let gaps = text.match_indices("${").map(|(at, _)| at).filter(|at| within.contains(at));
    // Where the shader is the whole file, `${` is a word of another tool.
    let hidden = gaps.filter(|&at| shown.as_bytes().get(at) == Some(&b' '));
    let mut lines: Vec<_> = hidden.map(|at| text[..at].matches('\n').count() + 1).collect();
    lines.dedup();
    lines
}

/// Returns the word in front of the name where a text defines a function: `fn` in WGSL, a type in the others.
pub(super) fn defined<'t>(text: &'t str, function: &str) -> Option<&'t str> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(function).find_map(|(start, _)| {
        let (before, behind) = (&text[..start], &text[start + function.len()..]);
        let apart = before.trim_end();
        let is_call = behind.trim_start().starts_with('(');
        let type_start = apart.rfind(|c| !is_word(c)).map_or(0, |at| at + 1);
        let word = &apart[type_start..];
        let is_definition = apart.len() < before.len()
            && !word.is_empty()
            && word != "return"
            && word != "else"
            && has_body(behind.trim_start());
        (is_call && is_definition).then_some(word)
    })
}

/// Whether a body, or what the function returns, follows the brackets that a text begins with.
fn has_body(text: &str) -> bool {
    if !text.starts_with('(') {
        return false;
    }
    let mut open = 0_usize;
    let close = text.bytes().position(|byte| {
        match byte {
            b'(' => open += 1,
            b')' => open = open.saturating_sub(1),
            _ => {}
        }
        open == 0
    });
    let behind = close.map_or("", |close| text[close + 1..].trim_start());
    ["{", "->", ":", "//", "/*"].iter().any(|sign| behind.starts_with(sign))
}

/// The names of the functions that a text defines.
pub(super) fn functions(text: &str) -> Vec<String> {
    let Ok(tokens) = tokens(text) else { return Vec::new() };
    let mut seen = BTreeSet::new();
    let names = tokens.iter().filter_map(|token| Some(&text[tokens[token.function?].at.clone()]));
    names.filter(|name| seen.insert(*name)).map(str::to_owned).collect()
}

/// Finds the string literals of a program; comments are left out.
fn literals(text: &str) -> Vec<Literal> {
    let mut found = Vec::new();
    let mut start = 0;
    while start < text.len() {
        let rest = &text[start..];
        let until = |from: usize, end: &str| rest[from..].find(end).map_or(rest.len(), |at| from + at);
        if rest.starts_with("//") {
            start += until(2, "\n");
        } else if rest.starts_with("/*") {
            start += (until(2, "*/") + 2).min(rest.len());
        } else if let Some(quotes) = ["\"\"\"", "'''"].into_iter().find(|quotes| rest.starts_with(quotes)) {
            let end = until(3, quotes);
            let whole = start..(start + end + 3).min(text.len());
            found.push(Literal { at: start + 3..start + end, whole, is_line: false });
            start += (end + 3).min(rest.len());
        } else if let Some((open, close)) = raw(rest) {
            let end = until(open, &close);
            let whole = start..(start + end + close.len()).min(text.len());
            found.push(Literal { at: start + open..start + end, whole, is_line: false });
            start += (end + close.len()).min(rest.len());
        } else if let Some(quote) = rest.bytes().next().filter(|byte| b"`\"'".contains(byte)) {
            let is_line = quote != b'`';
            let mut is_escaped = false;
            let ends = |byte: u8| {
                let ends = !is_escaped && (byte == quote || is_line && byte == b'\n');
                is_escaped = byte == b'\\' && !is_escaped;
                ends
            };
            let end = rest.bytes().skip(1).position(ends).map_or(rest.len(), |at| at + 1);
            let is_closed = rest.as_bytes().get(end) == Some(&quote);
            if is_closed {
                found.push(Literal { at: start + 1..start + end, whole: start..start + end + 1, is_line });
            }
            // A quote alone is a lifetime of Rust, or an apostrophe.
            start += if is_closed || quote != b'\'' { (end + 1).min(rest.len()) } else { 1 };
        } else {
            start += rest.chars().next().map_or(1, char::len_utf8);
        }
    }
    found
}

/// The length of the beginning of a literal that has no escapes, and its end.
fn raw(text: &str) -> Option<(usize, String)> {
    // C#.
    if text.starts_with("@\"") {
        return Some((2, "\"".to_owned()));
    }
    // What a page keeps for its program, as `<script type="x-shader/x-fragment">`.
    if text.starts_with("<script") && text.contains("</script>") {
        let end = text.find('>')? + 1;
        return text[..end].contains("shader").then(|| (end, "</script>".to_owned()));
    }
    // Rust, with as many signs as it takes; Lua, whose brackets may be those of an array elsewhere.
    let marked = |open: &str, mark: char, second: char| {
        let rest = text.strip_prefix(open)?;
        let marks: String = rest.chars().take_while(|&c| c == mark).collect();
        rest[marks.len()..].starts_with(second).then_some(marks)
    };
    if let Some(marks) = marked("r", '#', '"').filter(|_| !text.starts_with("r\"\"\"")) {
        return Some((marks.len() + 2, format!("\"{marks}")));
    }
    if let Some(marks) = marked("[", '=', '[') {
        let (open, close) = (marks.len() + 2, format!("]{marks}]"));
        let is_text =
            text.split_once(&close).is_some_and(|(text, _)| !text.contains(['`', '"']) && text.contains('{'));
        return is_text.then_some((open, close));
    }
    // C++.
    let name = text.strip_prefix("R\"")?.split_once('(')?.0;
    let is_name = name.len() <= 16 && !name.contains(|c: char| c.is_whitespace() || c == '"' || c == ')');
    is_name.then(|| (name.len() + 3, format!("){name}\"")))
}

/// The escapes of newlines and tabs in a literal of one line.
fn escapes(text: &str, at: &Range<usize>) -> Vec<Range<usize>> {
    let escapes = ["\\n", "\\t", "\\r"].into_iter().flat_map(|escape| text[at.clone()].match_indices(escape));
    escapes.map(|(start, escape)| at.start + start..at.start + start + escape.len()).collect()
}

/// The `${...}` of a template, whose values only the program knows.
fn holes(text: &str, at: &Range<usize>) -> Vec<Range<usize>> {
    let within = &text[at.clone()];
    let holes = within.match_indices("${").filter_map(|(start, _)| {
        let length = within[start..].find('}')?;
        Some(at.start + start..at.start + start + length + 1)
    });
    holes.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn left(text: &str) -> String {
        let uncovered = uncovered(text, &mut "f".to_owned()).unwrap();
        assert_eq!(uncovered.len(), text.len());
        assert_eq!(uncovered.matches('\n').count(), text.matches('\n').count());
        uncovered.trim().to_owned()
    }

    #[test]
    fn the_literal_that_defines_the_function_is_left() {
        for text in [
            "// don't\nexport default /* glsl */ `\nfloat f(vec3 p) { return 1.0; }\n`; const b = 'x';",
            "# a f(b)\nSHADER = r\"\"\"\nfloat f(vec3 p) { return 1.0; }\n\"\"\"\nOTHER = 'c'",
            "const char* x = R\"glsl(\nfloat f(vec3 p) { return 1.0; }\n)glsl\"; char y = 'z';",
            "const X: &'static str = r#\"\nfloat f(vec3 p) { return 1.0; }\n\"#; const Y: char = 'z';",
            "local x = [[\nfloat f(vec3 p) { return 1.0; }\n]] y = a[b[1]]",
            "const int[,] a = [[1, 2], [3, 4]]; string x = @\"\nfloat f(vec3 p) { return 1.0; }\n\"; var y = \"z\";",
            "<p>it's</p><script type=\"x-shader\">\nfloat f(vec3 p) { return 1.0; }\n</script><script>g()</script>",
        ] {
            assert_eq!(left(text), "float f(vec3 p) { return 1.0; }", "{text}");
        }
        let lines = "x = [\n\"float f(vec3 p) {\\n\",\n  'return 1.0;',\n \"}\"\n].join(); g = \"other\";";
        let apart = "s = \"float f(vec3 p)\\n\"\n  \"{\\n\"\n  \"return 1.0; }\\n\";";
        let whole = "s = \"#version 330\\nfloat f(vec3 p) { return 1.0; }\\n\";";
        assert_eq!(
            left(apart).split_whitespace().collect::<Vec<_>>().join(" "),
            "float f(vec3 p) { return 1.0; }"
        );
        let uncovered_whole = uncovered(whole, &mut "f".to_owned()).unwrap();
        assert_eq!(uncovered_whole.trim(), "#version 330 \nfloat f(vec3 p) { return 1.0; }");
        let words: Vec<_> = left(lines).split_whitespace().map(str::to_owned).collect();
        assert_eq!(words.join(" "), "float f(vec3 p) { return 1.0; }");
        assert_eq!(
            left("x(`float a = ${b};\nfloat f() { return a; }`)"),
            "float a =     ;\nfloat f() { return a; }"
        );
    }

    #[test]
    fn a_text_without_such_a_literal_stays() {
        let text = "#define A \"b\"\nfloat f(vec3 p) { return 1.0; }";
        assert_eq!(left(text), text);
        assert!(uncovered("`float f() {}`; b = `float f() {}`", &mut "f".to_owned()).is_err());
        let error = uncovered(
            "a = `float g(vec3 p) { return h(p); } float h() { return 1.0; }`;",
            &mut "f".to_owned(),
        )
        .unwrap_err();
        assert!(error.message.ends_with("functions between quotes are g, h"), "{}", error.message);
        assert_eq!(defined("return f(1.0); fn f(p: vec3f) -> f32 {", "f"), Some("fn"));
        assert_eq!(defined("calls f(1.0), or float f(vec3 p);", "f"), None);
        assert_eq!(defined("return f(1.0) + of(2.0)", "f"), None);
    }

    #[test]
    fn unfinished_literals_end_with_the_text() {
        for text in ["`", "\"", "'a\nb", "R\"(", "\"\"\"a", "/*", "//", "R\"", "`\\", "é`é", ""] {
            assert!(uncovered(text, &mut "f".to_owned()).is_err(), "{text}");
        }
    }
}
