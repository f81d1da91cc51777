//! The tests that run in one process. One program is linked once; what needs a process or a list of trials of its own
//! is a program beside it (`Cargo.toml`).
//!
//! `cargo test --test main golden::` runs the tests of one file.

mod budget;
mod exact;

mod architecture;
mod batch;
mod calibration;
mod compare;
mod constants;
mod coordinates;
mod domain;
mod emulated;
mod exhaustive;
mod extension_claims;
mod extension_hashes;
mod false_alarms;
mod golden;
mod inputs;
#[path = "sentences/mask.rs"]
mod mask;
mod masks;
mod names;
mod namesakes;
mod oracle;
mod power;
mod prop;
mod references;
mod severity;
mod stats;
mod threads;

#[cfg(feature = "shader")]
mod causes;
#[cfg(feature = "shader")]
mod engines;
#[cfg(feature = "shader")]
mod interpreter;
#[cfg(feature = "shader")]
mod interpreter_operations;
mod joins;
#[cfg(feature = "shader")]
mod mend;
#[cfg(feature = "shader")]
mod own_shader;
#[cfg(feature = "shader")]
mod shader_parity;
#[cfg(feature = "shader")]
mod shader_text;
#[cfg(feature = "shader")]
mod shipped;

#[cfg(feature = "render")]
mod extension_effects;
#[cfg(feature = "render")]
mod gltf_standard;
#[cfg(feature = "render")]
mod render;
#[cfg(feature = "render")]
mod render_assets;
#[cfg(feature = "render")]
mod scenes_page;
#[cfg(feature = "render")]
mod techniques;

#[cfg(feature = "cli")]
mod annotated;
#[cfg(feature = "cli")]
mod cli;
#[cfg(feature = "cli")]
mod findings;
#[cfg(feature = "cli")]
mod hashes;
#[cfg(feature = "cli")]
mod recommendation;
