//! `check FILE --mend`: what is offered for ports with slips applies, is small, and mends them.
//!
//! The search was developed on ports 001 to 060. `HASHED_ALPHA_MEND=all` tries every port in GLSL and WGSL with every claim, which takes an
//! hour; otherwise a few are tried with a few claims.

use hashed_alpha::check::claims::{self, exact, range};
use hashed_alpha::check::mend::{Broken, Outcome, mend};
use hashed_alpha::check::{Claim, Subject, cause, shaders};
use hashed_alpha::shader::interpreter::DeviceModel;
use hashed_alpha::shader::own::{self, Language, Options};
use hashed_alpha::threshold::two_scale::Variant;
use std::path::{Path, PathBuf};

/// Ports that are tried on every change: each step of a threshold, both languages and variants, one slip and two.
const SOME: [&str; 6] = ["004.glsl", "006.frag", "010.glsl", "012.frag", "013.glsl", "080.wgsl"];

/// A diff of so many lines at most is small.
const SMALL: usize = 3;

struct Port {
    file: String,
    text: String,
    language: Language,
    options: Options,
    variant: Variant,
    is_sound: bool,
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/ports")
}

fn ports() -> Vec<Port> {
    let table = std::fs::read_to_string(folder().join("answers.tsv")).expect("the table of answers");
    let rows = table.lines().skip(1).map(|line| line.split('\t').collect::<Vec<_>>());
    let port = |row: Vec<&str>| {
        let language = match Language::of(Path::new(row[0]))? {
            language @ (Language::Glsl | Language::Wgsl) => language,
            _ => return None,
        };
        let pairs = |text: &str| {
            let pair = text.split_once('=').map(|(name, value)| (name.to_owned(), value.to_owned()));
            pair.into_iter().collect()
        };
        let options = Options { function: row[1].to_owned(), map: pairs(row[4]), settings: pairs(row[5]) };
        Some(Port {
            file: row[0].to_owned(),
            text: std::fs::read_to_string(folder().join(row[0])).expect("a port"),
            language,
            options,
            variant: if row[2] == "isotropic" { Variant::Isotropic } else { Variant::Anisotropic },
            is_sound: row[3] == "sound",
        })
    };
    rows.filter_map(port).collect()
}

fn mended(port: &Port, claims: &[Claim]) -> Outcome {
    let broken = Broken {
        file: &port.file,
        language: port.language,
        text: &port.text,
        options: &port.options,
        variant: port.variant,
        claims,
        claiming: &|subject| subject,
    };
    mend(&broken, &|_| {})
}

fn subject(port: &Port, text: &str) -> Subject<'static> {
    let shader = own::parse(&port.file, port.language, text.as_bytes(), &port.options).expect("a shader");
    shaders::interpreted(&port.file, &shader, DeviceModel::ACCURATE, port.variant).expect("a subject")
}

#[test]
fn most_ports_are_mended_in_three_lines() {
    let has_all = std::env::var("HASHED_ALPHA_MEND").is_ok_and(|which| which == "all");
    let claims = if has_all { claims::ALL } else { &[exact::CELLS, range::RANGE] };
    let is_tried = |port: &Port| !port.is_sound && (has_all || SOME.contains(&port.file.as_str()));
    let (mut small, mut all, mut told) = (0, 0, String::new());
    for port in ports().into_iter().filter(is_tried) {
        all += 1;
        match mended(&port, claims) {
            Outcome::Mended(mended) => {
                small += usize::from(mended.lines <= SMALL);
                told += &format!("{}: {} lines\n", port.file, mended.lines);
                let examined = cause::examine(&subject(&port, &mended.text));
                assert!(examined.found.is_empty() && examined.follows, "{}: {examined:?}", port.file);
            }
            other => told += &format!("{}: {other:?}\n", port.file),
        }
    }
    assert!(5 * small >= 4 * all, "{small} of {all}\n{told}");
}

#[test]
fn a_sound_port_is_offered_nothing() {
    for port in ports().into_iter().filter(|port| port.is_sound).step_by(4) {
        assert_eq!(mended(&port, claims::ALL), Outcome::Sound, "{}", port.file);
    }
}

#[cfg(feature = "cli")]
mod typed {
    use std::process::{Command, Output};

    fn check(options: &[&str], folder: &std::path::Path) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_hashed-alpha"));
        command.arg("check").args(options).current_dir(folder).output().expect("the program runs")
    }

    #[test]
    fn the_diff_is_all_of_stdout_and_applies() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::copy(super::folder().join("013.glsl"), folder.path().join("mine.glsl")).expect("a copy");
        let options = ["mine.glsl", "--variant", "anisotropic", "--mend"];
        let first = check(&options, folder.path());
        let told = String::from_utf8_lossy(&first.stderr);
        assert_eq!(first.status.code(), Some(0), "{told}");
        assert!(told.contains("found: clamped-below-opaque") && told.contains("1 line is another"), "{told}");
        let diff = String::from_utf8_lossy(&first.stdout);
        assert!(diff.starts_with("--- a/mine.glsl\n+++ b/mine.glsl\n@@ "), "{diff}");
        std::fs::write(folder.path().join("mine.diff"), &first.stdout).expect("the diff");
        let applied = Command::new("git").args(["apply", "mine.diff"]).current_dir(folder.path()).output();
        let applied = applied.expect("git runs");
        assert!(applied.status.success(), "{}", String::from_utf8_lossy(&applied.stderr));
        // Now nothing is left to mend.
        let second = check(&options, folder.path());
        assert_eq!((second.status.code(), second.stdout.len()), (Some(0), 0));
        assert!(String::from_utf8_lossy(&second.stderr).contains("nothing is to mend"));
    }

    #[test]
    fn what_has_no_text_of_its_own_is_refused_in_words() {
        let ports = super::folder();
        for (options, words) in [
            (&["001.hlsl", "--mend"][..], "HLSL"),
            (&["002.wgsl", "003.frag", "--mend"], "one shader file"),
            (&["--mend"], "one shader file"),
            (&["robust", "--mend"], "`robust` is none"),
            (&["002.wgsl", "--mend", "--json"], "cannot be used with"),
        ] {
            let refused = check(options, &ports);
            let told = String::from_utf8_lossy(&refused.stderr).into_owned();
            assert_eq!(refused.status.code(), Some(2), "{options:?}: {told}");
            assert!(refused.stdout.is_empty() && told.contains(words), "{options:?}: {told}");
        }
    }
}
