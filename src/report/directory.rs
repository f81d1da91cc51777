//! A report as a directory: `check.jsonl`, `check.sarif`, `index.html` and a picture for every outcome that has evidence.

use super::annotations::{Written, sarif};
use super::figure::evidence::evidence;
use super::html::{self, Run};
use super::json::write_json_lines;
use crate::check::diagnosis::Diagnosis;
use crate::check::{Evidence, Outcome};
use std::collections::BTreeSet;
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicU64, Ordering};

/// Why a report could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A file or a directory failed.
    #[error("cannot {action} {path}", path = path.display())]
    File {
        /// What was tried, as in "write".
        action: &'static str,
        /// Where.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The page could not be made.
    #[error("cannot make the page for {path}", path = path.display())]
    Page {
        /// Where it would have gone.
        path: PathBuf,
        /// What the template engine said.
        source: minijinja::Error,
    },
}

/// Stands at the end of every picture of a report, so that a later report can tell its own.
const MARK: &str = "<!-- a picture of a hashed-alpha report -->\n";

/// Writes a report into a directory and returns the files that it wrote: pictures in the order of the outcomes, then
/// `check.jsonl`, `check.sarif`, then `index.html`. `written_in` says where subjects are written, for the second.
///
/// Makes the directory where it is missing. Each file is complete or not there (see [`write_atomically`]), and the
/// page comes last. Pictures that an earlier report left in the directory and this one does not have are removed;
/// nothing else is touched.
///
/// # Errors
///
/// If the directory or a file cannot be written or a stale picture cannot be removed; the error names the path.
pub fn write_report(
    dir: &Path,
    outcomes: &[Outcome],
    diagnoses: &[Diagnosis],
    written_in: &[Written],
    run: &Run,
) -> Result<Vec<PathBuf>, ReportError> {
    fs::create_dir_all(dir).map_err(|source| ReportError::File {
        action: "create",
        path: dir.into(),
        source,
    })?;
    let names = picture_names(outcomes);
    let mut written = Vec::new();
    for (outcome, name) in outcomes.iter().zip(&names) {
        if let (Some(name), Some(mut svg)) = (name, evidence(outcome)) {
            svg.push_str(MARK);
            let path = dir.join(name);
            write_atomically(&path, svg.as_bytes())?;
            written.push(path);
        }
    }
    let mut lines = Vec::new();
    let data = dir.join("check.jsonl");
    write_json_lines(outcomes, diagnoses, &mut lines).map_err(|source| ReportError::File {
        action: "make the lines of",
        path: data.clone(),
        source,
    })?;
    write_atomically(&data, &lines)?;
    written.push(data);
    let annotations = dir.join("check.sarif");
    let sarif = format!("{:#}\n", sarif(outcomes, diagnoses, written_in));
    write_atomically(&annotations, sarif.as_bytes())?;
    written.push(annotations);
    let index = dir.join("index.html");
    let page = html::page(outcomes, &names, diagnoses, run)
        .map_err(|source| ReportError::Page { path: index.clone(), source })?;
    write_atomically(&index, page.as_bytes())?;
    written.push(index);
    remove_stale(dir, &names.iter().flatten().map(String::as_str).collect())?;
    Ok(written)
}

/// Writes a file by way of a temporary one beside it that is renamed, so that no reader sees half of it.
///
/// A link stays, and what it leads to is written. What is there and no regular file (a device, a pipe, the standard output
/// by its name) is opened and written through, behind what it holds.
///
/// # Errors
///
/// If any step fails; the error names `path`, and the temporary file is removed. Does not wait for the disk: after
/// a loss of power the file may be empty.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), ReportError> {
    let written = target(path).and_then(|target| match target {
        Target::Replaced(file) => replace(&file, bytes),
        Target::Through => OpenOptions::new().append(true).open(path)?.write_all(bytes),
    });
    written.map_err(|source| ReportError::File { action: "write", path: path.into(), source })
}

/// How a path is to be written.
enum Target {
    /// A regular file, a missing one, or a directory, which then refuses: without links.
    Replaced(PathBuf),
    /// Whatever else it is, and every file that a process has open already.
    Through,
}

/// Follows the links of a path, the last of which may lead to nothing.
fn target(path: &Path) -> io::Result<Target> {
    /// As many as systems follow.
    const MOST_LINKS: usize = 40;
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        if let (Some(name), Some(folder)) = (path.file_name(), path.parent()) {
            let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
            path = fs::canonicalize(folder)?.join(name);
        }
        if path.starts_with("/proc") {
            return Ok(Target::Through);
        }
        match fs::symlink_metadata(&path) {
            Ok(found) if found.is_symlink() => {
                let next = fs::read_link(&path)?;
                path = path.parent().map_or(next.clone(), |folder| folder.join(&next));
            }
            Ok(found) if found.is_file() || found.is_dir() => return Ok(Target::Replaced(path)),
            Ok(_) => return Ok(Target::Through),
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Target::Replaced(path)),
            Err(error) => return Err(error),
        }
    }
    Err(io::Error::other("links that lead to each other"))
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    static COUNTER: AtomicU64 = AtomicU64::new(0);
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let number = COUNTER.fetch_add(1, Ordering::Relaxed);
    let partial = path.with_file_name(format!(".{name}.{}-{number}.partial", process::id()));
    fs::write(&partial, bytes).and_then(|()| fs::rename(&partial, path)).inspect_err(|_| {
        // The first error is the one to tell; the file may not even exist.
        let _ = fs::remove_file(&partial);
    })
}

/// Returns the file name of the picture of each outcome: check, subject and precision, in characters that every file
/// system takes and no page needs to escape. Equal names get a number.
fn picture_names(outcomes: &[Outcome]) -> Vec<Option<String>> {
    let mut taken = BTreeSet::new();
    let mut name = |outcome: &Outcome| {
        let parts = [outcome.check, &outcome.subject, outcome.precision.name()].map(sanitised);
        let stem = parts.join("--");
        let numbered = (2..).map(|number| format!("{stem}-{number}.svg"));
        let mut candidates = std::iter::once(format!("{stem}.svg")).chain(numbered);
        candidates.find(|candidate| taken.insert(candidate.to_lowercase()))
    };
    outcomes
        .iter()
        .map(|outcome| if outcome.evidence == Evidence::None { None } else { name(outcome) })
        .collect()
}

/// Keeps letters, digits, dots and underscores of ASCII, and at most 60 characters; the rest becomes hyphens, never
/// two in a row. Never begins with a dot.
fn sanitised(text: &str) -> String {
    let mut name = String::new();
    for c in text.chars() {
        let kept = c.is_ascii_alphanumeric() || c == '_' || (c == '.' && !name.is_empty());
        match c {
            _ if name.len() == 60 => break,
            _ if kept => name.push(c),
            _ if name.is_empty() || name.ends_with('-') => {}
            _ => name.push('-'),
        }
    }
    let trimmed = name.trim_end_matches(['-', '.']);
    if trimmed.is_empty() { "unnamed".to_owned() } else { trimmed.to_owned() }
}

/// Removes pictures that carry our mark and a name of our form and are not among `current`.
fn remove_stale(dir: &Path, current: &BTreeSet<&str>) -> Result<(), ReportError> {
    let failed = |action, path: &Path| {
        let path = path.to_owned();
        move |source| ReportError::File { action, path, source }
    };
    for entry in fs::read_dir(dir).map_err(failed("list", dir))? {
        let entry = entry.map_err(failed("list", dir))?;
        let (path, name) = (entry.path(), entry.file_name());
        let Some(name) = name.to_str() else { continue };
        let named_by_us = name.ends_with(".svg") && name.matches("--").count() == 2;
        // Of links and directories nothing is ours.
        let is_file = entry.file_type().is_ok_and(|kind| kind.is_file());
        if !named_by_us || !is_file || current.contains(name) {
            continue;
        }
        // What cannot be read was not written by us, as far as we can tell.
        if fs::read(&path).is_ok_and(|bytes| bytes.ends_with(MARK.as_bytes())) {
            fs::remove_file(&path).map_err(failed("remove", &path))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::example;
    use super::*;

    fn run() -> Run {
        Run { command: "hashed-alpha check".to_owned(), seed: 1, version: "0.1.0".to_owned() }
    }

    fn files(dir: &Path) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(dir)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn report_holds_lines_page_and_pictures() {
        let root = tempfile::tempdir().unwrap();
        let dir = root.path().join("new").join("report");
        let written = write_report(&dir, &example::outcomes(), &[], &[], &run()).unwrap();
        let expected = [
            "check.jsonl",
            "check.sarif",
            "independence.neighbours--specimen-raw-hash--f32.svg",
            "index.html",
            "stability.translate--script-alert-1-script-co--f32.svg",
            "uniform.by_lerp_factor--paper-isotropic--f32.svg",
        ];
        assert_eq!(files(&dir), expected);
        assert_eq!(written.len(), expected.len());
        let page = fs::read_to_string(dir.join("index.html")).unwrap();
        for picture in expected.iter().filter(|name| name.ends_with(".svg")) {
            assert!(page.contains(&format!("src=\"{picture}\"")), "{picture}");
        }
        let bytes: Vec<_> = written.iter().map(|path| fs::read(path).unwrap()).collect();
        write_report(&dir, &example::outcomes(), &[], &[], &run()).unwrap();
        assert_eq!(bytes, written.iter().map(|path| fs::read(path).unwrap()).collect::<Vec<_>>());
    }

    #[test]
    fn stale_pictures_go_and_foreign_files_stay() {
        let root = tempfile::tempdir().unwrap();
        write_report(root.path(), &example::outcomes(), &[], &[], &run()).unwrap();
        for foreign in ["a--b--c.svg", "notes.txt", "photo.svg"] {
            fs::write(root.path().join(foreign), "<svg></svg>").unwrap();
        }
        write_report(root.path(), &example::outcomes()[..1], &[], &[], &run()).unwrap();
        let expected = [
            "a--b--c.svg",
            "check.jsonl",
            "check.sarif",
            "index.html",
            "notes.txt",
            "photo.svg",
            "uniform.by_lerp_factor--paper-isotropic--f32.svg",
        ];
        assert_eq!(files(root.path()), expected);
    }

    #[test]
    fn a_file_is_replaced_whole_or_not_at_all() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("file.txt");
        write_atomically(&path, b"old").unwrap();
        write_atomically(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        fs::create_dir(root.path().join("taken")).unwrap();
        fs::write(root.path().join("taken").join("x"), "").unwrap();
        let error = write_atomically(&root.path().join("taken"), b"new").unwrap_err();
        assert!(error.to_string().ends_with("taken"), "{error}");
        assert_eq!(files(root.path()), ["file.txt", "taken"]);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_and_what_it_leads_to_is_replaced() {
        let root = tempfile::tempdir().unwrap();
        let at = |name: &str| root.path().join(name);
        fs::create_dir(at("folder")).unwrap();
        fs::write(at("folder/file"), "old").unwrap();
        for (link, target) in
            [("one", "folder/file"), ("two", "one"), ("new", "folder/absent"), ("a", "b"), ("b", "a")]
        {
            std::os::unix::fs::symlink(target, at(link)).unwrap();
        }
        write_atomically(&at("two"), b"two").unwrap();
        write_atomically(&at("new"), b"new").unwrap();
        assert_eq!(fs::read(at("folder/file")).unwrap(), b"two");
        assert_eq!(fs::read(at("folder/absent")).unwrap(), b"new");
        assert!(
            ["one", "two", "new"].iter().all(|link| fs::symlink_metadata(at(link)).unwrap().is_symlink())
        );
        assert_eq!(files(&at("folder")), ["absent", "file"]);
        assert!(write_atomically(&at("a"), b"").is_err());
    }

    #[cfg(unix)]
    #[test]
    fn a_pipe_is_written_through() {
        use std::os::unix::fs::FileTypeExt;
        let root = tempfile::tempdir().unwrap();
        let pipe = root.path().join("pipe");
        assert!(process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let reader = std::thread::spawn({
            let pipe = pipe.clone();
            move || fs::read(pipe).unwrap()
        });
        write_atomically(&pipe, b"new").unwrap();
        assert_eq!(reader.join().unwrap(), b"new");
        assert!(fs::symlink_metadata(&pipe).unwrap().file_type().is_fifo());
        assert_eq!(files(root.path()), ["pipe"]);
    }

    #[test]
    fn errors_name_the_path() {
        let root = tempfile::tempdir().unwrap();
        let file = root.path().join("file");
        fs::write(&file, "").unwrap();
        let error = write_report(&file.join("report"), &[], &[], &[], &run()).unwrap_err();
        assert!(error.to_string().contains("report"), "{error}");
    }

    #[test]
    fn picture_names_are_safe_and_distinct() {
        let named = |subject: &str| Outcome { subject: subject.to_owned(), ..example::consistent() };
        let outcomes = ["../../etc/passwd", "a/b", "a b", "A B", "…"].map(named);
        let names: Vec<_> = picture_names(&outcomes).into_iter().flatten().collect();
        let prefix = "uniform.by_lerp_factor--";
        let expected =
            ["etc-passwd--f32.svg", "a-b--f32.svg", "a-b--f32-2.svg", "A-B--f32-3.svg", "unnamed--f32.svg"];
        assert_eq!(names, expected.map(|name| format!("{prefix}{name}")));
    }
}
