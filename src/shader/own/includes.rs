//! `#include` in GLSL and HLSL: files beside the one that names them, and in the folders that the user gives (`-I`). A file that is
//! nowhere is left out: it is missed only where something of it is.

use super::directives::directives;
use super::error::Fault;
use super::scan::tokens;
use super::sources::{Put, Sources};
use std::collections::BTreeSet;
use std::io::Read;
use std::path::{Path, PathBuf};

/// How deeply files may include each other.
const DEEPEST: usize = 32;

/// What a file may include.
pub(super) struct Includes<'a> {
    /// The folders that are looked through, in order, behind that of the file itself.
    pub folders: &'a [PathBuf],
    /// The most bytes of all files together.
    pub most: u64,
    /// Files that are in already: each is read once, as if it said `#pragma once`.
    pub read: BTreeSet<PathBuf>,
}

impl Includes<'_> {
    /// Puts the files that a text includes in the place of the lines that name them, and theirs in them.
    ///
    /// # Errors
    ///
    /// A file that is not UTF-8, and files that are too large together or nest too deeply.
    pub fn expand(
        &mut self,
        text: String,
        sources: &mut Sources,
        folder: Option<&Path>,
        depth: usize,
    ) -> Result<String, Fault> {
        let words = tokens(&text)?;
        let mut edits = Vec::new();
        for directive in directives(&text, &words).iter().filter(|directive| directive.name() == "include") {
            let Some(path) = self.find(&directive.written, folder) else { continue };
            let at = directive.at.clone();
            if depth >= DEEPEST {
                return Err(Fault::new(format!("files that include each other more than {DEEPEST} deep"))
                    .at(Some(at)));
            }
            // Functions may be there once only, statements as often as they are wanted.
            let is_new = self.read.insert(path.clone());
            let put = if is_new || self.has_no_function(&path) {
                let theirs = self.text(&path).map_err(|message| Fault::new(message).at(Some(at.clone())))?;
                let mut its = Sources::of(&path.display().to_string(), &theirs);
                // What is wrong in it is told at the line that includes it.
                let expanded = self.expand(theirs, &mut its, path.parent(), depth + 1).map_err(|fault| {
                    let place = fault.at.and_then(|at| {
                        its.locate(at.start)
                            .map(|(file, place)| format!("{file}:{}:{}: ", place.line, place.column))
                    });
                    Fault::new(format!("{}{}", place.unwrap_or_default(), fault.message)).at(Some(at.clone()))
                })?;
                Put::Text(expanded, its)
            } else {
                Put::Words(String::new())
            };
            edits.push((at, put));
        }
        Ok(if edits.is_empty() { text } else { sources.exchange(&text, edits) })
    }

    fn has_no_function(&mut self, path: &Path) -> bool {
        let text = self.text(path).unwrap_or_default();
        !text.is_empty()
            && !text.contains('{')
            && !text.contains("#pragma once")
            && !text.contains("#include")
    }

    /// Finds the file that a directive names: between quotes or angles.
    fn find(&self, written: &str, folder: Option<&Path>) -> Option<PathBuf> {
        let name = written.split_once(['"', '<'])?.1;
        let name = name[..name.find(['"', '>'])?].trim();
        // Godot's `res://`, and paths from the root of a project.
        let name = name.rsplit_once("://").map_or(name, |(_, name)| name).trim_start_matches('/');
        let folders = folder.into_iter().chain(self.folders.iter().map(PathBuf::as_path));
        let candidates = folders.flat_map(|folder| {
            let base = Path::new(name).file_name().map(|base| folder.join(base));
            [Some(folder.join(name)), base].into_iter().flatten()
        });
        candidates.into_iter().find(|path| path.is_file())
    }

    fn text(&mut self, path: &Path) -> Result<String, String> {
        let shown = path.display();
        let mut bytes = Vec::new();
        let file = std::fs::File::open(path).map_err(|error| format!("{shown}: {error}"))?;
        file.take(self.most + 1).read_to_end(&mut bytes).map_err(|error| format!("{shown}: {error}"))?;
        self.most = self
            .most
            .checked_sub(bytes.len() as u64)
            .ok_or_else(|| format!("{shown}: the files that are included are too large together"))?;
        String::from_utf8(bytes).map_err(|error| format!("{shown}: {}", error.utf8_error()))
    }
}
