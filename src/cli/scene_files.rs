//! What a typed scene means: a name of the gallery, or a file.

use super::args::SceneArgs;
use super::failure::Failure;
use hashed_alpha::render::file::{self, SceneFile};
use hashed_alpha::render::gallery::{self, GALLERY};
use hashed_alpha::render::prepare::{Scene, prepare};
use std::fs;
use std::path::Path;

/// Names of all scenes that were asked for.
pub fn names(args: &SceneArgs) -> Vec<String> {
    let expand = |name: &String| match name.as_str() {
        "gallery" => GALLERY.iter().map(|entry| entry.name.to_owned()).collect(),
        _ => vec![name.clone()],
    };
    args.scenes.iter().flat_map(expand).collect()
}

/// Reads a scene and all that it names.
pub fn load(name: &str, args: &SceneArgs) -> Result<Scene, Failure> {
    let (file, folder) = read(name)?;
    let frames = args.frames.unwrap_or(file.frames);
    let file = SceneFile {
        resolution: args.resolution.unwrap_or(file.resolution),
        frames,
        seed: args.seed.unwrap_or(file.seed),
        ..file
    };
    Ok(prepare(file, folder)?)
}

fn read(name: &str) -> Result<(SceneFile, &Path), Failure> {
    if let Some(entry) = gallery::find(name) {
        return Ok((file::read(entry.text, name)?, Path::new("")));
    }
    let path = Path::new(name);
    if path.extension().is_none() && !path.exists() {
        let known: Vec<_> = GALLERY.iter().map(|entry| entry.name).collect();
        let message = format!(
            "no scene is called `{name}`; a file ends in .toml, known names are {}",
            known.join(", ")
        );
        return Err(Failure::Usage(message));
    }
    let open = |source| Failure::File { action: "read", place: name.to_owned(), source };
    let text = fs::read_to_string(path).map_err(open)?;
    Ok((file::read(&text, name)?, path.parent().unwrap_or(Path::new(""))))
}
