//! The languages in which a shader can be brought.

use std::path::Path;

/// The language of a shader file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Language {
    /// WGSL: `.wgsl`.
    Wgsl,
    /// GLSL of any version: `.glsl`, `.frag`, `.vert`, `.comp`, `.fs`, `.vs`.
    Glsl,
    /// SPIR-V: `.spv`.
    SpirV,
}

impl Language {
    /// Returns the language that the ending of a file name stands for.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "wgsl" => Some(Self::Wgsl),
            "glsl" | "frag" | "vert" | "comp" | "fs" | "vs" => Some(Self::Glsl),
            "spv" => Some(Self::SpirV),
            _ => None,
        }
    }
}
