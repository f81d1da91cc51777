//! What stands in a text outside of all functions, and what of it the function on trial comes to, by names alone: a file as it is
//! shipped has much else, which may need textures, other files, or another version of the language.

use super::directives::{Directive, in_directives};
use super::scan::Token;
use super::statements::is_name;
use core::ops::Range;
use std::collections::{BTreeSet, HashMap, HashSet};

/// A function, a structure, a declaration: up to its semicolon or its closing brace.
pub(super) struct Item<'t> {
    /// Its tokens; among them may be some of directives.
    pub tokens: Range<usize>,
    /// The token of its name where it is a function with a body.
    pub function: Option<usize>,
    /// What others call it, or parts of it.
    pub names: Vec<&'t str>,
}

/// Cuts a text into its items.
pub(super) fn items<'t>(text: &'t str, tokens: &[Token], directives: &[Directive<'_>]) -> Vec<Item<'t>> {
    let in_directive = in_directives(directives, tokens.len());
    let word = |at: usize| tokens.get(at).map_or("", |token| &text[token.at.clone()]);
    let mut found = Vec::new();
    let (mut start, mut function) = (None, None);
    for at in (0..tokens.len()).filter(|&at| !in_directive[at]) {
        let start_of_item = *start.get_or_insert(at);
        function = function.or(tokens[at].function);
        let mut ends = false;
        match word(at) {
            "}" => {
                // Behind the brace of a structure or a block may stand the name of a variable.
                let next = (at + 1..tokens.len()).find(|&next| !in_directive[next]);
                let goes_on = next.is_some_and(|next| {
                    matches!(word(next), ";" | "," | ")")
                        || is_name(word(next)) && matches!(word(next + 1), ";" | "[" | "," | "=")
                });
                ends = tokens[at].braces == 0 && (function.is_some() || !goes_on);
            }
            ";" => ends = tokens[at].braces == 0 && tokens[at].parentheses == 0,
            _ => {}
        }
        if ends || at + 1 == tokens.len() {
            let tokens_of = start_of_item..at + 1;
            let names = match function {
                Some(name) => vec![word(name)],
                None => declared(text, tokens, &in_directive, tokens_of.clone()),
            };
            found.push(Item { tokens: tokens_of, function, names });
            (start, function) = (None, None);
        }
    }
    found
}

/// The names that a declaration brings: of variables, of a structure, of members where a block has no name.
fn declared<'t>(text: &'t str, tokens: &[Token], in_directive: &[bool], range: Range<usize>) -> Vec<&'t str> {
    let at: Vec<usize> = range.filter(|&at| !in_directive[at]).collect();
    let word = |index: usize| at.get(index).map_or("", |&at| &text[tokens[at].at.clone()]);
    let open = (0..at.len()).find(|&index| word(index) == "{" && tokens[at[index]].parentheses == 0);
    let close = (0..at.len()).rev().find(|&index| word(index) == "}");
    // `layout(binding = 1)` gives no value.
    let is_given = |index: usize| word(index) == "=" && tokens[at[index]].parentheses == 0;
    let is_value = open.is_some_and(|open| (0..open).any(is_given));
    let is_structure = (0..open.unwrap_or(0)).any(|index| word(index) == "struct");
    // `} name;`
    let has_instance = close.is_some_and(|close| is_name(word(close + 1)));
    // What an engine's macro declares, as in `TEXTURE2D(map);`.
    if open.is_none()
        && is_name(word(0))
        && word(1) == "("
        && word(at.len() - 1) == ";"
        && word(at.len() - 2) == ")"
    {
        return (2..at.len()).map(word).filter(|word| is_name(word)).collect();
    }
    let mut names = Vec::new();
    let mut is_initial = false;
    for index in 0..at.len() {
        let is_within = open.zip(close).is_some_and(|(open, close)| open < index && index < close);
        let sign = word(index + 1);
        match word(index) {
            "=" if tokens[at[index]].parentheses == 0 => is_initial = true,
            ";" | "," if tokens[at[index]].parentheses == 0 => is_initial = false,
            _ => {}
        }
        if !is_name(word(index)) || is_initial || is_within && (is_structure || has_instance || is_value) {
            continue;
        }
        let is_declared = matches!(sign, ";" | "," | "=" | "[" | ":" | "{")
            || sign.is_empty()
            || sign == "(" && index > 0 && is_name(word(index - 1));
        if is_declared && tokens[at[index]].parentheses == 0 {
            names.push(word(index));
        }
    }
    names
}

/// What is always kept: it says how the rest is to be read.
const OF_THE_WHOLE: [&str; 9] = [
    "precision",
    "enable",
    "requires",
    "diagnostic",
    "shader_type",
    "render_mode",
    // Of Slang.
    "import",
    "using",
    "extension",
];

/// Blanks all that `function` and the names `kept` do not come to, byte for byte, but for directives. Where there is no function of that
/// name, only `main` goes.
pub(super) fn blank_others(
    bytes: &mut [u8],
    text: &str,
    tokens: &[Token],
    directives: &[Directive<'_>],
    function: &str,
    kept: &BTreeSet<&str>,
) {
    let word = |index: usize| &text[tokens[index].at.clone()];
    let in_directive = in_directives(directives, tokens.len());
    let items = items(text, tokens, directives);
    // Babylon's WGSL declares what is no WGSL.
    let text_is_wgsl = items.iter().any(|item| {
        word(item.tokens.start) == "fn"
            || item.function.is_some_and(|name| name > 0 && word(name - 1) == "fn")
    });
    let is_there = items.iter().any(|item| item.function.is_some_and(|name| word(name) == function));
    let reached = is_there.then(|| {
        let first = kept.iter().copied().chain([function]).collect();
        reached(text, tokens, directives, &items, first)
    });
    for item in &items {
        let stays = match &reached {
            Some(reached) => {
                let is_of_engine =
                    text_is_wgsl && matches!(word(item.tokens.start), "uniform" | "varying" | "attribute");
                !is_of_engine
                    && (item.names.is_empty()
                        || OF_THE_WHOLE.contains(&word(item.tokens.start))
                        || item.names.iter().any(|name| reached.contains(name)))
            }
            None => item.function.is_none_or(|name| word(name) != "main"),
        };
        if !stays {
            let own = item.tokens.clone().filter(|&at| !in_directive[at]);
            own.for_each(|at| bytes[tokens[at].at.clone()].fill(b' '));
        }
    }
}

/// The words that some names come to, themselves among them.
pub(super) fn reached<'t>(
    text: &'t str,
    tokens: &[Token],
    directives: &[Directive<'t>],
    items: &[Item<'t>],
    first: HashSet<&'t str>,
) -> HashSet<&'t str> {
    let in_directive = in_directives(directives, tokens.len());
    // What stands in an item or in a macro, by its names.
    let mut within: HashMap<&str, Vec<&str>> = HashMap::new();
    for item in items {
        let own = item.tokens.clone().filter(|&at| !in_directive[at]);
        let words: Vec<_> = own.map(|at| &text[tokens[at].at.clone()]).filter(|word| is_name(word)).collect();
        for name in &item.names {
            within.entry(name).or_default().extend(&words);
        }
    }
    for directive in directives.iter().filter(|directive| directive.name() == "define") {
        if let [_, _, name, body @ ..] = &directive.words[..] {
            within.entry(name).or_default().extend(body);
        }
    }
    let mut open: Vec<_> = first.iter().copied().collect();
    let mut reached = first;
    while let Some(name) = open.pop() {
        let words = within.get(name).into_iter().flatten();
        open.extend(words.filter(|&&word| reached.insert(word)));
    }
    reached
}

#[cfg(test)]
mod tests {
    use super::super::directives::directives;
    use super::super::scan::tokens;
    use super::*;

    fn blanked(text: &str, function: &str, kept: &[&str]) -> String {
        let tokens = tokens(text).unwrap();
        let mut bytes = text.as_bytes().to_vec();
        let kept = kept.iter().copied().collect();
        blank_others(&mut bytes, text, &tokens, &directives(text, &tokens), function, &kept);
        let left = String::from_utf8(bytes).unwrap();
        assert_eq!(left.len(), text.len());
        left
    }

    #[test]
    fn only_what_the_function_comes_to_stays() {
        let text = "#define CALL(x) deep(x)
precision highp float;
struct S { float x; };
struct T { Unknown y; } t;
layout(std140, binding = 1) uniform Block { vec3 eye; };
layout(std140) uniform Named { vec3 pupil; } named;
uniform Lights lights[4];
const float K = 2.0, L = 3.0;
float deep(float x) { S s; return x * L + eye.x; }
float lost(float x) { return texture2D(u_map, vec2(x)).a; }
float first() { return 1.0; }
float one = first();
float threshold(vec3 position) { return CALL(position.x) * one; }
void main() {
#ifdef X
    lost(1.0);
#endif
}";
        let left = blanked(text, "threshold", &[]);
        for stays in [
            "#define CALL",
            "struct S",
            "uniform Block { vec3 eye; };",
            "deep(float",
            "first() {",
            "#endif",
            "const float K",
            "precision highp float;",
        ] {
            assert!(left.contains(stays), "{stays}: {left}");
        }
        for goes in ["lost(float", "main", "Unknown", "pupil", "lights"] {
            assert!(!left.contains(goes), "{goes}: {left}");
        }
        assert!(blanked(text, "threshold", &["lights"]).contains("uniform Lights lights[4];"));
        let all = blanked(text, "other", &[]);
        assert!(all.contains("u_map") && all.contains("lights") && !all.contains("main"), "{all}");
    }

    #[test]
    fn items_of_other_languages_are_told_apart() {
        let wgsl = "struct A { @location(0) a: vec4<f32>, b: f32 }
@group(0) @binding(0) var<uniform> material: Material;
@group(0) @binding(1) var map: texture_2d<f32>;
const PI = 3.14;
fn threshold(@location(0) p: vec3f) -> @location(0) f32 { return PI; }
@fragment fn main(a: A) -> @location(0) vec4f { return textureSample(map, a.b); }";
        let left = blanked(wgsl, "threshold", &[]);
        assert_eq!(
            left.trim(),
            "const PI = 3.14;
fn threshold(@location(0) p: vec3f) -> @location(0) f32 { return PI; }"
        );
        let hlsl = "cbuffer Frame : register(b0) { float4 eye; float scale; }
cbuffer Other : register(b1) { Unknown what; };
Texture2D map : register(t0);
static const float3 K = { 1, 2, 3 };
float threshold(float3 p : TEXCOORD0) : SV_Target { return scale * K.x; }";
        let left = blanked(hlsl, "threshold", &[]);
        assert!(left.contains("cbuffer Frame") && left.contains("K = { 1, 2, 3 };"), "{left}");
        assert!(!left.contains("Unknown") && !left.contains("map"), "{left}");
    }
}
