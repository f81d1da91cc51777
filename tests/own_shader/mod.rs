//! A user's own shader: what is taken, what is refused and with which words, and that nothing makes the reader panic.

use hashed_alpha::scene::fragment::Fragment;
use hashed_alpha::shader::export::{self, export};
use hashed_alpha::shader::interpreter::DeviceModel;
use hashed_alpha::shader::own::{
    Input, LARGEST_FILE, Language, Options, OwnShader, Place, Value, parse, read,
};
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::robust::Robust;
use hashed_alpha::threshold::two_scale::Variant;
use proptest::prelude::*;
use std::path::{Path, PathBuf};

mod as_shipped;
mod derivatives;
mod hostile;
mod refused;
mod taken;

fn examples() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/shaders");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

fn options(settings: &[(&str, &str)]) -> Options {
    let settings = settings.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    Options { settings, ..Options::default() }
}

/// The values that the examples ask for.
fn options_of(path: &Path) -> Options {
    match path.file_stem().and_then(|stem| stem.to_str()) {
        Some("listing_sine") if path.extension().is_some_and(|ending| ending == "glsl") => {
            options(&[("g_HashScale", "1")])
        }
        Some("mistake_case_selection") => options(&[("alpha_hash_scale", "1.0")]),
        _ => Options::default(),
    }
}

/// The threshold of one fragment at a position, with derivatives of 1/8 along x and 1/4 along y.
fn threshold(shader: &OwnShader, position: [f64; 3]) -> f32 {
    let footprint: Footprint<f64> = Footprint {
        position: position.into(),
        dpdx: glam::dvec3(0.125, 0.0, 0.0),
        dpdy: glam::dvec3(0.0, 0.25, 0.0),
    };
    let program = shader.program().unwrap();
    shader.thresholds(&program, &[footprint.into()], &DeviceModel::ACCURATE).unwrap()[0]
}

fn wgsl(text: &str, options: &Options) -> Result<OwnShader, String> {
    parse("own.wgsl", Language::Wgsl, text.as_bytes(), options).map_err(|error| error.to_string())
}

fn glsl(text: &str, options: &Options) -> Result<OwnShader, String> {
    parse("own.glsl", Language::Glsl, text.as_bytes(), options).map_err(|error| error.to_string())
}
