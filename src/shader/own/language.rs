//! The languages in which a shader can be brought.

use std::path::Path;

/// The language of a shader file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Language {
    /// WGSL: `.wgsl`.
    Wgsl,
    /// GLSL of any version: `.glsl`, `.frag`, `.vert`, `.comp`, `.fs`, `.vs`, `.fsh`, `.vsh`, `.glslh`, `.inc`; Godot's
    /// `.gdshader` and `.gdshaderinc`.
    Glsl,
    /// HLSL: `.hlsl`, `.hlsli`, `.cginc`, `.hlslinc`, `.usf`, `.ush`, `.azsl`; read by glslang.
    Hlsl,
    /// Slang: `.slang`; read by `slangc`.
    Slang,
    /// WGSL, GLSL or HLSL in a string literal of a program: `.js`, `.ts`, `.py`, `.h`, `.cpp`, `.rs`, `.cs`, `.lua`, `.html` and their kin; a file
    /// that defines the function outside of all literals is a shader as it stands.
    Quoted,
    /// WGSL, GLSL or HLSL, whichever its words say, or a part of the file: Unity's `.shader` (between `HLSLPROGRAM` and `ENDHLSL`),
    /// Filament's `.mat` (in `fragment { ... }`), and files of other endings.
    Any,
    /// SPIR-V: `.spv`.
    SpirV,
}

/// Says what to hand over in the place of a file that is known, and cannot be read.
#[must_use]
pub fn instead_of(path: &Path) -> Option<&'static str> {
    match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
        "metal" => Some("MSL is not read: hand over the same function in HLSL, GLSL or WGSL"),
        _ => None,
    }
}

/// Says of a file of an engine what may be missing in it.
pub(super) fn around(path: &Path) -> Option<&'static str> {
    match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
        "usf" | "ush" | "fx" | "fxh" | "fxc" | "shader" | "cginc" | "hlslinc" | "azsl" | "azsli"
        | "surfshader" => Some(
            "it may need what its engine puts around it: where -I DIR does not find that, copy the function, and what it calls, into a \
             file .hlsl",
        ),
        _ => None,
    }
}

impl Language {
    /// Returns the language that the ending of a file name stands for; nothing where it stands for none, and [`Language::Any`] may do.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "wgsl" => Some(Self::Wgsl),
            "glsl" | "frag" | "vert" | "comp" | "rahit" | "rchit" | "fs" | "vs" | "fsh" | "vsh" | "glslh"
            | "glslf" | "inc" | "gdshader" | "gdshaderinc" => Some(Self::Glsl),
            "hlsl" | "hlsli" | "cginc" | "hlslinc" | "usf" | "ush" | "azsl" | "azsli" => Some(Self::Hlsl),
            "slang" => Some(Self::Slang),
            "js" | "mjs" | "cjs" | "jsx" | "ts" | "mts" | "tsx" | "vue" | "svelte" | "html" | "htm"
            | "py" | "h" | "hh" | "hpp" | "hxx" | "inl" | "c" | "cc" | "cpp" | "cxx" | "m" | "mm" | "rs"
            | "go" | "java" | "kt" | "cs" | "swift" | "lua" => Some(Self::Quoted),
            "shader" | "mat" | "fx" | "fxh" | "fxc" | "sc" => Some(Self::Any),
            "spv" => Some(Self::SpirV),
            _ => None,
        }
    }

    /// Returns the language whose words a text has: the first of WGSL, HLSL and GLSL of which it has any.
    #[must_use]
    pub(super) fn told_by(text: &str) -> Option<Self> {
        let has = |words: &[&str]| words.iter().any(|word| has_word(text, word));
        let defines = text.match_indices("fn ").any(|(at, _)| {
            let behind = text[at..].split_once('(').map_or("", |(_, behind)| behind);
            behind.split_once('{').is_some_and(|(head, _)| head.contains(':') || head.contains("->"))
        });
        if defines {
            return Some(Self::Wgsl);
        }
        if has(&["float2", "float3", "float4", "half3", "half4", "SV_Target", "SV_Position", "cbuffer"]) {
            return Some(Self::Hlsl);
        }
        has(&["vec2", "vec3", "vec4", "gl_FragCoord", "dFdx", "fract"]).then_some(Self::Glsl)
    }
}

/// Whether a word stands in a text, and not within another one.
fn has_word(text: &str, word: &str) -> bool {
    let is_letter = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word)
        .any(|(at, _)| !text[..at].ends_with(is_letter) && !text[at + word.len()..].starts_with(is_letter))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_language_is_told_by_its_words() {
        for (text, language) in [
            ("fn f(a: f32) -> f32 { return a; }", Some(Language::Wgsl)),
            ("half4 f(float3 a) { return a; }", Some(Language::Hlsl)),
            ("float f(vec3 a) { return fract(a.x); } // fn (x) {", Some(Language::Glsl)),
            ("int f(my_vec3 a) { return a; }", None),
        ] {
            assert_eq!(Language::told_by(text), language, "{text}");
        }
    }
}
