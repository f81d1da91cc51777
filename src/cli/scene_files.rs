//! What a typed scene means: a name of the gallery, or a file.

use super::args::SceneArgs;
use super::failure::{Failure, told};
use super::output;
use hashed_alpha::render::gallery;
use hashed_alpha::render::gallery::GALLERY;
use hashed_alpha::render::scene_file::load::{Scene, prepare};
use hashed_alpha::render::scene_file::read;
use hashed_alpha::render::scene_file::schema::SceneFile;
use std::borrow::Cow;
use std::fs;
use std::path::Path;

/// A scene file that was read, with what its messages need.
pub struct Read {
    /// What it says, but for what was typed in place of that.
    pub file: SceneFile,
    typed: String,
    text: Cow<'static, str>,
}

/// Reads the files of all scenes that were asked for: whatever is wrong in one of them is told before the first is drawn.
pub fn read_all(args: &SceneArgs) -> Result<Vec<Read>, Failure> {
    let mut all: Vec<Read> = Vec::new();
    for typed in &args.scenes {
        if typed == "gallery" {
            for entry in GALLERY {
                all.push(read(entry.name, args)?);
            }
        } else {
            all.push(read(typed, args)?);
        }
        // Some file systems do not tell small letters from capital ones.
        let name = |read: &Read| read.file.name.to_lowercase();
        for (index, read) in all.iter().enumerate() {
            if let Some(other) = all[..index].iter().find(|other| name(other) == name(read)) {
                let message = format!(
                    "the scenes of `{}` and `{}` are both called `{}`: the files of one would replace those of the other",
                    other.typed, read.typed, read.file.name
                );
                return Err(Failure::Usage(message));
            }
        }
    }
    Ok(all)
}

impl Read {
    /// Reads all that it names, and tells what of that is not simulated.
    pub fn prepare(self) -> Result<Scene, Failure> {
        let Self { file, typed, text } = self;
        let folder = match gallery::find(&typed) {
            Some(_) => Path::new(""),
            None => Path::new(&typed).parent().unwrap_or(Path::new("")),
        };
        let scene = prepare(file, folder).map_err(|error| {
            let key = error.key();
            Failure::Scene(read::error_at(&text, &typed, &key, told(&error)))
        })?;
        for note in &scene.notes {
            output::remark("note", format_args!("{}: {note}", scene.file.name));
        }
        Ok(scene)
    }
}

fn read(typed: &str, args: &SceneArgs) -> Result<Read, Failure> {
    let text = text(typed)?;
    let file = read::read(&text, typed)?;
    let file = SceneFile {
        resolution: args.resolution.unwrap_or(file.resolution),
        frames: args.frames.unwrap_or(file.frames),
        seed: args.seed.unwrap_or(file.seed),
        ..file
    };
    read::check_changed(&file).map_err(|message| Failure::Usage(format!("{typed}: {message}")))?;
    Ok(Read { file, typed: typed.to_owned(), text })
}

fn text(name: &str) -> Result<Cow<'static, str>, Failure> {
    if let Some(entry) = gallery::find(name) {
        return Ok(Cow::Borrowed(entry.text));
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
    Ok(Cow::Owned(fs::read_to_string(path).map_err(open)?))
}
