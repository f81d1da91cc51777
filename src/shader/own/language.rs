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
    /// HLSL: `.hlsl`, `.hlsli`; read by glslang.
    Hlsl,
    /// Slang: `.slang`; read by `slangc`.
    Slang,
    /// WGSL or GLSL in a string literal of a program: `.js`, `.mjs`, `.ts`, `.tsx`, `.py`, `.h`, `.hpp`, `.cpp`; a file that
    /// defines the function outside of all literals is GLSL.
    Quoted,
    /// SPIR-V: `.spv`.
    SpirV,
}

/// The endings that are known, as a message lists them.
pub const ENDINGS: &str = ".wgsl, .glsl, .frag, .vert, .comp, .fs, .vs, .fsh, .vsh, .glslh, .inc, .gdshader, .gdshaderinc, .hlsl, .hlsli, .slang, .spv, and those of programs that \
                           hold a shader between quotes, .js, .mjs, .ts, .tsx, .py, .h, .hpp, .cpp";

/// Says what to hand over in the place of a file that is known, and cannot be read.
#[must_use]
pub fn instead_of(path: &Path) -> Option<&'static str> {
    match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
        "metal" => Some("MSL is not read: hand over the same function in HLSL, GLSL or WGSL"),
        "usf" | "ush" | "fx" | "fxh" | "shader" | "cginc" | "hlslinc" | "surfshader" => Some(
            "it needs what its engine puts around it: copy the function, and what it calls, into a file .hlsl",
        ),
        _ => None,
    }
}

impl Language {
    /// Returns the language that the ending of a file name stands for.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "wgsl" => Some(Self::Wgsl),
            "glsl" | "frag" | "vert" | "comp" | "fs" | "vs" | "fsh" | "vsh" | "glslh" | "inc"
            | "gdshader" | "gdshaderinc" => Some(Self::Glsl),
            "hlsl" | "hlsli" => Some(Self::Hlsl),
            "slang" => Some(Self::Slang),
            "js" | "mjs" | "ts" | "tsx" | "py" | "h" | "hpp" | "cpp" => Some(Self::Quoted),
            "spv" => Some(Self::SpirV),
            _ => None,
        }
    }
}
