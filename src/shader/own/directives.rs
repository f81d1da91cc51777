//! The lines of a GLSL text that its preprocessor reads, and what stands behind a condition.

use super::error::Fault;
use super::scan::Token;
use core::ops::Range;
use std::collections::BTreeMap;

/// A line that begins with `#`, with those that a backslash adds to it.
pub(super) struct Directive<'t> {
    /// Its tokens, the `#` first, but for backslashes.
    pub words: Vec<&'t str>,
    /// The indices of its tokens.
    pub tokens: Range<usize>,
    /// Its bytes, comments included.
    pub at: Range<usize>,
    /// It as it is written, in one line, without a comment at its end.
    pub written: String,
}

impl Directive<'_> {
    /// The word behind the `#`.
    pub fn name(&self) -> &str {
        self.words.get(1).copied().unwrap_or_default()
    }

    fn is_condition(&self) -> bool {
        matches!(self.name(), "if" | "ifdef" | "ifndef" | "elif")
    }
}

/// Finds the directives of a text in order.
pub(super) fn directives<'t>(text: &'t str, tokens: &[Token]) -> Vec<Directive<'t>> {
    let word = |token: &Token| &text[token.at.clone()];
    let mut found = Vec::new();
    let mut index = 0;
    while let Some(first) = tokens.get(index) {
        if word(first) != "#" {
            index += 1;
            continue;
        }
        let end = end_of_line(text, first.at.start);
        let count = tokens[index..].iter().take_while(|token| token.at.start < end).count();
        let words = tokens[index..index + count].iter().map(word).filter(|&word| word != "\\").collect();
        let at = first.at.start..end;
        let line = text[at.clone()].replace("\\\n", " ");
        let written =
            line.split("//").next().unwrap_or_default().split_whitespace().collect::<Vec<_>>().join(" ");
        found.push(Directive { words, tokens: index..index + count, at, written });
        index += count;
    }
    found
}

/// The end of a line that goes on behind a backslash.
fn end_of_line(text: &str, start: usize) -> usize {
    let mut end = start;
    loop {
        end = text[end..].find('\n').map_or(text.len(), |newline| end + newline);
        let goes_on = text[start..end].trim_end_matches('\r').ends_with('\\') && end < text.len();
        if !goes_on {
            return end;
        }
        end += 1;
    }
}

/// Whether a condition asks for a word.
pub(super) fn is_asked_for(directives: &[Directive<'_>], word: &str) -> bool {
    directives.iter().any(|directive| directive.is_condition() && directive.words[2..].contains(&word))
}

/// Says of every token whether it belongs to a directive.
pub(super) fn in_directives(directives: &[Directive<'_>], tokens: usize) -> Vec<bool> {
    let mut within = vec![false; tokens];
    directives.iter().for_each(|directive| within[directive.tokens.clone()].fill(true));
    within
}

/// Returns the functions of a text: `main` apart, each with the innermost condition that it stands behind.
///
/// # Errors
///
/// A condition that has no end, and an end of none.
pub(super) fn functions(
    text: &str,
    tokens: &[Token],
    directives: &[Directive<'_>],
) -> Result<BTreeMap<String, Option<String>>, Fault> {
    let mut functions: BTreeMap<String, Option<String>> = BTreeMap::new();
    let mut open: Vec<(&Directive<'_>, String)> = Vec::new();
    let (mut last, mut start) = (None, 0);
    let mut find = |range: Range<usize>, condition: Option<&String>| {
        for name in tokens[range].iter().filter_map(|token| token.function) {
            let word = &text[tokens[name].at.clone()];
            if last.replace(name) != Some(name) && word != "main" {
                // A function that stands behind none at another place is there.
                let known = functions.entry(word.to_owned()).or_insert_with(|| condition.cloned());
                *known = known.take().filter(|_| condition.is_some());
            }
        }
    };
    for directive in directives {
        find(start..directive.tokens.start, open.last().map(|(_, condition)| condition));
        start = directive.tokens.end;
        let written = || directive.written.clone();
        match directive.name() {
            "if" | "ifdef" | "ifndef" => open.push((directive, written())),
            name @ ("elif" | "else" | "endif") => {
                let (first, condition) = open.pop().ok_or_else(|| {
                    let message = format!("`#{name}` without an `#if` before it");
                    Fault::new(message).at(Some(directive.at.clone()))
                })?;
                match name {
                    "elif" => open.push((first, written())),
                    "else" => open.push((first, format!("the #else of {condition}"))),
                    _ => {}
                }
            }
            _ => {}
        }
    }
    if let Some((first, _)) = open.pop() {
        let message = format!("the file ends before this `#{}` has its `#endif`", first.name());
        return Err(Fault::new(message).at(Some(first.at.clone())));
    }
    find(start..tokens.len(), None);
    Ok(functions)
}

#[cfg(test)]
mod tests {
    use super::super::scan::tokens;
    use super::*;

    fn found(text: &str) -> Result<Vec<(String, Option<String>)>, String> {
        let tokens = tokens(text).unwrap();
        let functions = functions(text, &tokens, &directives(text, &tokens));
        let said = |fault: Fault| format!("{} {:?}", fault.message, fault.at);
        functions.map(|all| all.into_iter().collect()).map_err(said)
    }

    #[test]
    fn a_function_behind_conditions_is_named_with_the_innermost() {
        let text = "float a() { return 1.0; }
#if defined( X ) && \\
    Y > 2
float b() { return 1.0; }
#ifdef Z
float c() { return 1.0; }
#else
float d() { return 1.0; }
#endif
#endif";
        let of = |name: &str, condition: Option<&str>| (name.to_owned(), condition.map(str::to_owned));
        let first = "#if defined( X ) && Y > 2";
        let wanted = [
            of("a", None),
            of("b", Some(first)),
            of("c", Some("#ifdef Z")),
            of("d", Some("the #else of #ifdef Z")),
        ];
        assert_eq!(found(text).unwrap(), wanted);
        let both = "#ifdef X\nfloat a() { return 1.0; }\n#endif\nfloat a(float x) { return x; }";
        assert_eq!(found(both).unwrap(), [of("a", None)]);
    }

    #[test]
    fn conditions_have_an_end_and_ends_a_condition() {
        let error = found("\n#ifdef A\n#if B\n#endif").unwrap_err();
        assert_eq!(error, "the file ends before this `#ifdef` has its `#endif` Some(1..9)");
        let error = found("#endif").unwrap_err();
        assert_eq!(error, "`#endif` without an `#if` before it Some(0..6)");
    }
}
