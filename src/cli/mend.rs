//! `check FILE --mend`: the smallest change of a shader after which its slips are gone, as a unified diff.

use super::args::CheckArgs;
use super::failure::Failure;
use super::shader_files::{self, ShaderFile};
use super::{Ending, output, subjects};
use hashed_alpha::check::claims;
use hashed_alpha::check::mend::{Broken, Mended, Outcome, mend};
use hashed_alpha::shader::own::{self, Language};
use indicatif::ProgressBar;
use similar::TextDiff;
use std::io::Write;
use std::path::Path;
use std::sync::atomic::AtomicU64;

/// Looks for a change and writes it, once it was tried.
pub fn run(args: &CheckArgs) -> Result<Ending, Failure> {
    let file = only_file(args)?;
    shader_files::refuse_strays(&[args.subjects[0].as_str()], &args.shader)?;
    let language = language(&file)?;
    let mut options = file.options(&args.shader)?;
    let path = Path::new(file.path);
    let shader = own::read(path, &options)?;
    if shader.is_hash() {
        let message = format!("{}: --mend is for a threshold, and this is a hash alone", file.name());
        return Err(Failure::Usage(message));
    }
    shader.notes.iter().for_each(|note| output::remark("note", format_args!("in {} {note}", file.name())));
    options.function.clone_from(&shader.named);
    let refused = |source| Failure::File { action: "read", place: file.path.to_owned(), source };
    let text = std::fs::read_to_string(path).map_err(refused)?;
    let claimed = subjects::Claimed::of(&file, &args.shader, &options, &shader);
    let name = file.name();
    let broken = Broken {
        file: &name,
        language,
        text: &text,
        options: &options,
        variant: claimed.variant,
        claims: claims::ALL,
        claiming: &|subject| claimed.by(subject),
    };
    let bar = ProgressBar::new_spinner();
    let told = AtomicU64::new(0);
    let outcome = mend(&broken, &|tried| {
        bar.inc(tried as u64);
        let seconds = bar.elapsed().as_secs();
        if bar.is_hidden() && output::is_due(&told, seconds) {
            output::remark("note", format_args!("{} changes tried after {seconds} s", bar.position()));
        }
    });
    bar.finish_and_clear();
    match outcome {
        Outcome::Sound => {
            output::remark(
                "note",
                format_args!(
                    "{name}: no experiment shows a slip, and every claim holds that the paper's own listing passes; nothing is to mend"
                ),
            );
            Ok(Ending::Consistent)
        }
        Outcome::Mended(mended) => {
            tell(&name, &mended);
            let diff = unified(file.path, &text, &mended.text);
            let mut results = output::results();
            results.write_all(diff.as_bytes()).and_then(|()| results.flush()).map_err(Failure::Output)?;
            Ok(Ending::Consistent)
        }
        Outcome::Left(found) => {
            found.iter().for_each(|found| output::remark("found", found));
            output::remark("note", format_args!("{name}: no change was found after which all claims hold"));
            Ok(Ending::Rejected)
        }
    }
}

/// The only subject, which has to be a file.
fn only_file(args: &CheckArgs) -> Result<ShaderFile<'_>, Failure> {
    let [word] = args.subjects.as_slice() else {
        return Err(Failure::Usage(
            "--mend changes one shader file: name it, and no other subject".to_owned(),
        ));
    };
    ShaderFile::of(word).ok_or_else(|| {
        Failure::Usage(format!("--mend changes the text of a shader file, and `{word}` is none"))
    })
}

/// The language of a file whose text can be changed.
fn language(file: &ShaderFile<'_>) -> Result<Language, Failure> {
    let refused = |reason: &str| Err(Failure::Usage(format!("{}: {reason}", file.name())));
    match Language::of(Path::new(file.path)) {
        Some(language @ (Language::Glsl | Language::Wgsl)) => Ok(language),
        Some(Language::SpirV) => {
            refused("--mend changes a text, and SPIR-V has none: mend the GLSL or HLSL that it was made of")
        }
        Some(Language::Hlsl | Language::Slang) => refused(
            "--mend reads GLSL and WGSL; HLSL and Slang are tried, and their slips are told, by `check` without it",
        ),
        Some(Language::Quoted | Language::Any) | None => {
            refused("--mend reads files of GLSL and WGSL alone: copy the function into one")
        }
    }
}

/// Says what was wrong and what came of it.
fn tell(name: &str, mended: &Mended) {
    mended.found.iter().for_each(|found| output::remark("found", found));
    let lines = match mended.lines {
        1 => "1 line is another".to_owned(),
        lines => format!("{lines} lines are others"),
    };
    let how = if mended.is_replaced { "no small change mends it: it calls our own function; " } else { "" };
    output::remark(
        "note",
        format_args!(
            "{name}: {how}{lines}; the mended text was tried: no experiment shows a slip, and every claim holds that the paper's \
             own listing passes"
        ),
    );
}

/// The diff, as `git apply` and `patch -p1` take it.
fn unified(path: &str, old: &str, new: &str) -> String {
    // Relative to where the command was typed, as `git apply` takes it.
    let here = std::env::current_dir().ok();
    let path = here
        .and_then(|here| Path::new(path).strip_prefix(here).ok())
        .map_or(path, |path| path.to_str().unwrap_or_default());
    let path = path.trim_start_matches("./").trim_start_matches('/');
    let diff = TextDiff::from_lines(old, new);
    diff.unified_diff().context_radius(3).header(&format!("a/{path}"), &format!("b/{path}")).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_diff_names_the_file_relative_to_where_it_is_applied() {
        let diff = unified("./shaders/a.glsl", "x\ny\n", "x\nz\n");
        assert_eq!(diff, "--- a/shaders/a.glsl\n+++ b/shaders/a.glsl\n@@ -1,2 +1,2 @@\n x\n-y\n+z\n");
    }
}
