//! What a function of a GLSL text comes to, by names alone: bodies, macros and initial values.

use super::super::scan::Token;
use super::directives::{Directive, in_directives};
use std::collections::{HashMap, HashSet};

/// Blanks every function that `function` does not come to, byte for byte, but for directives: it may need textures, or
/// what only another version has. Where there is no function of that name, only `main` goes.
pub(super) fn blank_others(
    bytes: &mut [u8],
    text: &str,
    tokens: &[Token],
    directives: &[Directive<'_>],
    function: &str,
) {
    let word = |index: usize| &text[tokens[index].at.clone()];
    let in_directive = in_directives(directives, tokens.len());
    let reached = reached(text, tokens, directives, &in_directive, function);
    let goes = |name: usize| match &reached {
        Some(reached) => !reached.contains(word(name)),
        None => word(name) == "main",
    };
    let (mut declaration, mut body_of) = (Vec::new(), None);
    for (index, token) in tokens.iter().enumerate().filter(|&(index, _)| !in_directive[index]) {
        declaration.push(token.at.clone());
        match (token.function, body_of) {
            (Some(name), _) => body_of = Some(name),
            // The bracket that closes it.
            (None, Some(name)) => {
                if goes(name) {
                    declaration.iter().for_each(|at| bytes[at.clone()].fill(b' '));
                }
                body_of = None;
                declaration.clear();
            }
            (None, None) if word(index) == ";" && token.parentheses == 0 => declaration.clear(),
            (None, None) => {}
        }
    }
}

/// Returns the words that a function comes to, its name among them; nothing where there is no such function.
fn reached<'t>(
    text: &'t str,
    tokens: &[Token],
    directives: &[Directive<'t>],
    in_directive: &[bool],
    function: &'t str,
) -> Option<HashSet<&'t str>> {
    let word = |index: usize| &text[tokens[index].at.clone()];
    // What stands in a function or in a macro; in initial values under the empty name.
    let mut within: HashMap<&str, Vec<&str>> = HashMap::new();
    let mut is_value = false;
    for (index, token) in tokens.iter().enumerate().filter(|&(index, _)| !in_directive[index]) {
        match token.function {
            Some(name) => within.entry(word(name)).or_default().push(word(index)),
            None => {
                is_value = match word(index) {
                    "=" => true,
                    ";" => false,
                    _ => is_value,
                };
                if is_value {
                    within.entry("").or_default().push(word(index));
                }
            }
        }
    }
    within.get(function)?;
    for directive in directives.iter().filter(|directive| directive.name() == "define") {
        if let [_, _, name, body @ ..] = &directive.words[..] {
            within.entry(name).or_default().extend(body);
        }
    }
    let mut reached = HashSet::from([function]);
    let mut open = vec![function, ""];
    while let Some(name) = open.pop() {
        let words = within.get(name).into_iter().flatten();
        open.extend(words.filter(|&&word| reached.insert(word)));
    }
    Some(reached)
}

#[cfg(test)]
mod tests {
    use super::super::super::scan::tokens;
    use super::super::directives::directives;
    use super::*;

    #[test]
    fn only_what_the_function_comes_to_stays() {
        let text = "#define CALL(x) deep(x)
struct S { float x; };
layout(std140) uniform Block { vec3 eye; };
float deep(float x) { return x; }
float lost(float x) { return texture2D(u_map, vec2(x)).a; }
float first() { return 1.0; }
float one = first();
float threshold(vec3 position) { return CALL(position.x); }
void main() {
#ifdef X
    lost(1.0);
#endif
}";
        let blanked = |function: &str| {
            let tokens = tokens(text).unwrap();
            let mut bytes = text.as_bytes().to_vec();
            blank_others(&mut bytes, text, &tokens, &directives(text, &tokens), function);
            String::from_utf8(bytes).unwrap()
        };
        let left = blanked("threshold");
        assert_eq!(left.len(), text.len());
        for stays in
            ["#define CALL", "struct S", "uniform Block { vec3 eye; };", "deep(float", "first() {", "#endif"]
        {
            assert!(left.contains(stays), "{stays}: {left}");
        }
        assert!(!left.contains("lost") && !left.contains("main"), "{left}");
        let all = blanked("other");
        assert!(all.contains("u_map") && !all.contains("main"), "{all}");
    }
}
