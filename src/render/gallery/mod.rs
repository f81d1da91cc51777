//! The figures of the sources as scenes, each with the sentence that it must show.

use crate::render::scene_file::read;

/// A built-in scene file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The name by which a user asks for it.
    pub name: &'static str,
    /// The TOML text.
    pub text: &'static str,
}

/// Lists files of the folder `gallery`.
macro_rules! gallery {
    ($($name:literal),* $(,)?) => {
        /// Every built-in scene file, in the order of the figures.
        pub const GALLERY: &[Entry] =
            &[$(Entry { name: $name, text: include_str!(concat!($name, ".toml")) }),*];
    };
}

gallery![
    "vanishing-foliage",
    "mips-and-wires",
    "sub-pixel-cards",
    "samples-converge",
    "grazing-fence",
    "axis-plane",
    "blending",
    "octaves",
    "castano",
    "hair",
    "fade-in",
    "subpixel-motion",
    "checkerboard",
    "multisample",
    "layers",
    "pixel-masks",
    "screen-door",
    "stipple",
    "stipple-buffers",
    "noise-scales",
    "temporal-orders",
    "temporal-ghosts",
    "temporal-noise",
    "foveated",
    "occlusion",
    "halo",
    "coordinates",
    "auto",
];

/// Returns the scene file of a name.
#[must_use]
pub fn find(name: &str) -> Option<&'static Entry> {
    GALLERY.iter().find(|entry| entry.name == name)
}

impl Entry {
    /// Returns the sentence that the scene must show; empty where it has none.
    #[must_use]
    pub fn sentence(&self) -> String {
        read::read(self.text, self.name).ok().and_then(|scene| scene.sentence).unwrap_or_default()
    }
}
