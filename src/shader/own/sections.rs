//! Files of which a part is a shader, between words of an engine that no language of shaders has.

use super::language::Language;
use super::options::THRESHOLD;
use super::quoted::defined;
use core::ops::Range;

/// The words around HLSL in Unity's ShaderLab; what stands between the first two is in front of every pass.
const OF_UNITY: [(&str, &str); 4] =
    [("HLSLINCLUDE", "ENDHLSL"), ("CGINCLUDE", "ENDCG"), ("HLSLPROGRAM", "ENDHLSL"), ("CGPROGRAM", "ENDCG")];

/// Blanks what stands around the shader in a text, which may be nothing; nothing moves. Says the language, too, where the words around it
/// do.
pub(super) fn uncovered(text: &str, function: &str) -> (String, Option<Language>) {
    let of_unity = of_unity(text, function);
    if !of_unity.is_empty() {
        return (all_but(text, &of_unity), Some(Language::Hlsl));
    }
    let (kept, language) = match of_godot(text).or_else(|| of_filament(text)) {
        Some(kept) => (kept, Some(Language::Glsl)),
        None => (0..text.len(), None),
    };
    (without_marks(&all_but(text, &[kept])), language)
}

/// The parts of ShaderLab that are HLSL: those in front of every pass, and of the passes the one that has the function.
fn of_unity(text: &str, function: &str) -> Vec<Range<usize>> {
    let parts = |words: &[(&str, &str)]| {
        let mut found: Vec<Range<usize>> = Vec::new();
        for (open, close) in words {
            for (at, _) in text.match_indices(open) {
                let start = at + open.len();
                found.extend(text[start..].find(close).map(|end| start..start + end));
            }
        }
        found.sort_by_key(|range| range.start);
        found
    };
    let (mut shared, passes) = (parts(&OF_UNITY[..2]), parts(&OF_UNITY[2..]));
    let has_function = |range: &&Range<usize>| defined(&text[(*range).clone()], function).is_some();
    let discards = |range: &&Range<usize>| {
        let pass = &text[(*range).clone()];
        function == THRESHOLD && (pass.contains("clip(") || pass.contains("discard"))
    };
    let is_shared = shared.iter().any(|range| has_function(&range));
    let pass = passes.iter().find(has_function).or_else(|| passes.iter().find(discards));
    let pass = pass.or_else(|| passes.first()).filter(|_| !is_shared);
    shared.extend(pass.cloned());
    shared
}

/// The stage of fragments in the files of Godot's own renderers.
fn of_godot(text: &str) -> Option<Range<usize>> {
    let start = text.find("#[fragment]")? + "#[fragment]".len();
    let end = text[start..].find("\n#[").map_or(text.len(), |end| start + end);
    Some(start..end)
}

/// The block `fragment { ... }` of a material of Filament.
fn of_filament(text: &str) -> Option<Range<usize>> {
    let at = text.match_indices("fragment").find_map(|(at, word)| {
        let begins_line = text[..at].rsplit('\n').next().is_some_and(|line| line.trim().is_empty());
        let behind = text[at + word.len()..].trim_start();
        (begins_line && behind.starts_with('{')).then_some(at)
    })?;
    let start = at + text[at..].find('{')? + 1;
    let mut depth = 1_usize;
    let end = text[start..].bytes().position(|byte| {
        match byte {
            b'{' => depth += 1,
            b'}' => depth -= 1,
            _ => {}
        }
        depth == 0
    })?;
    Some(start..start + end)
}

/// Blanks lines that belong to a tool: Godot's `#VERSION_DEFINES`, bgfx's `$input`, sokol's `@fs`.
fn without_marks(text: &str) -> String {
    const LINES: [&str; 21] = [
        "#VERSION_DEFINES",
        "#[",
        "$input",
        "$output",
        "@ctype",
        "@header",
        "@image_sample_type",
        "@sampler_type",
        "@glsl_options",
        "@hlsl_options",
        "@msl_options",
        "@msl_only",
        "@vs",
        "@fs",
        "@cs",
        "@block",
        "@include_block",
        "@include",
        "@program",
        "@module",
        "@end",
    ];
    let is_mark = |line: &str| {
        let line = line.trim();
        LINES.iter().any(|mark| {
            let behind = line.strip_prefix(mark);
            behind.is_some_and(|behind| {
                mark.ends_with('[') || behind.is_empty() || behind.starts_with(char::is_whitespace)
            })
        })
    };
    let mut bytes = text.as_bytes().to_vec();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        if is_mark(line) {
            bytes[start..start + line.trim_end().len()].fill(b' ');
        }
        start += line.len();
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Blanks all but some ranges, in order.
fn all_but(text: &str, kept: &[Range<usize>]) -> String {
    let mut bytes = text.as_bytes().to_vec();
    let goes = |at: usize| !kept.iter().any(|range| range.contains(&at));
    bytes
        .iter_mut()
        .enumerate()
        .filter(|(at, byte)| goes(*at) && **byte != b'\n')
        .for_each(|(_, byte)| *byte = b' ');
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str, function: &str) -> (String, Option<Language>) {
        let (shown, language) = uncovered(text, function);
        assert_eq!(shown.len(), text.len());
        (shown.split_whitespace().collect::<Vec<_>>().join(" "), language)
    }

    #[test]
    fn the_shader_of_a_file_is_shown() {
        let unity = "Shader \"A\" {\nHLSLINCLUDE\nfloat k;\nENDHLSL\nPass { CGPROGRAM\nfloat vert() {}\nENDCG }\nPass { HLSLPROGRAM\nfloat f() { clip(1); }\nENDHLSL } }";
        let hlsl = Some(Language::Hlsl);
        assert_eq!(shown(unity, "f"), ("float k; float f() { clip(1); }".to_owned(), hlsl));
        assert_eq!(shown(unity, "vert"), ("float k; float vert() {}".to_owned(), hlsl));
        assert_eq!(shown(unity, THRESHOLD), ("float k; float f() { clip(1); }".to_owned(), hlsl));
        let glsl = Some(Language::Glsl);
        let godot = "#[vertex]\nvoid main() {}\n#[fragment]\n#VERSION_DEFINES\nvoid main() { discard; }\n";
        assert_eq!(shown(godot, "main"), ("void main() { discard; }".to_owned(), glsl));
        let filament = "material { name : a }\nvertex { void v() {} }\nfragment {\n void material(inout M m) { if (a) {} }\n}\n";
        assert_eq!(shown(filament, "f"), ("void material(inout M m) { if (a) {} }".to_owned(), glsl));
        let sokol = "@fs fs\nvoid main() { discard; }\n@end\n@program a vs fs\n$input v_pos\n";
        assert_eq!(shown(sokol, "main"), ("void main() { discard; }".to_owned(), None));
        let wgsl = "@fragment fn fs() -> f32 {\n return 1.0; }";
        assert_eq!(shown(wgsl, "fs"), ("@fragment fn fs() -> f32 { return 1.0; }".to_owned(), None));
    }
}
