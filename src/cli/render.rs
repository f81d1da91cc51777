//! `render`: pictures and numbers of scenes, and whether they show what they must.

use super::args::RenderArgs;
use super::failure::Failure;
use super::{Ending, output, scene_files};
use hashed_alpha::render::measure::picture::{animation, png};
use hashed_alpha::render::measure::study::{Study, study};
use hashed_alpha::render::scene_file::load::Scene;
use hashed_alpha::report::directory::write_atomically;
use hashed_alpha::report::study::{distances, json, write_csv, write_table};
use indicatif::{ProgressBar, ProgressStyle};
use std::fmt::Display;
use std::fs;
use std::io::Write;
use std::path::Path;

/// Draws every scene. What is finished is written before the next one begins.
pub fn run(args: &RenderArgs) -> Result<Ending, Failure> {
    let refused = |source| Failure::File { action: "create", place: args.out.display().to_string(), source };
    fs::create_dir_all(&args.out).map_err(refused)?;
    let mut results = output::results();
    let mut ending = Ending::Consistent;
    for read in scene_files::read_all(&args.scene)? {
        let scene = read.prepare()?;
        let bar = bar(&scene);
        let study = study(&scene, &mut |done, all| {
            bar.set_length(all);
            bar.set_position(done);
        });
        bar.finish_and_clear();
        for take in study.takes.iter().filter(|take| take.cost.fragments == 0) {
            let (scene, take) = (&scene.file.name, &take.plan.name);
            output::remark(
                "note",
                format_args!(
                    "{scene}: {take}: no surface is seen; is the camera at the right place, and on the side from which one-sided materials are seen?"
                ),
            );
        }
        for note in &study.notes {
            output::remark("note", format_args!("{}: {note}", scene.file.name));
        }
        let text = json(&scene, &study).map_err(|error| making("numbers", error))?;
        write(&args.out, &scene, &study, &text, args.sequence)?;
        if args.json {
            writeln!(results, "{text}").map_err(Failure::Output)?;
        } else {
            write_table(&scene, &study, &mut results).map_err(Failure::Output)?;
            writeln!(results, "  written to {}\n", args.out.join(format!("{}.*", scene.file.name)).display())
                .map_err(Failure::Output)?;
        }
        results.flush().map_err(Failure::Output)?;
        if study.checked.iter().any(|checked| !checked.holds) {
            ending = Ending::Rejected;
        }
    }
    Ok(ending)
}

/// Shows how far a scene is.
pub fn bar(scene: &Scene) -> ProgressBar {
    let bar = ProgressBar::new(0).with_message(scene.file.name.clone());
    bar.set_style(
        ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len} pictures, {eta} left")
            .unwrap_or_else(|_| ProgressStyle::default_bar()),
    );
    bar
}

fn making(what: &str, error: impl Display) -> Failure {
    Failure::Usage(format!("cannot make the {what}: {error}"))
}

/// Writes the files of a scene, the pictures last.
fn write(folder: &Path, scene: &Scene, study: &Study, json: &str, sequence: bool) -> Result<(), Failure> {
    let name = &scene.file.name;
    write_atomically(&folder.join(format!("{name}.json")), json.as_bytes())?;
    let mut csv = Vec::new();
    write_csv(study, &mut csv).map_err(|error| making("table", error))?;
    write_atomically(&folder.join(format!("{name}.csv")), &csv)?;
    if sequence {
        for take in &study.takes {
            let moving = animation(&take.sequence, 10).map_err(|error| making("sequence", error))?;
            // Whatever may lead to another folder stays out.
            let safe = |letter: char| letter.is_alphanumeric() || "-_.,+()".contains(letter);
            let file = format!("{name}-{}.png", take.plan.name.replace(|letter| !safe(letter), "-"));
            write_atomically(&folder.join(file), &moving)?;
        }
    }
    if let Some(figure) = distances(scene, study) {
        write_atomically(&folder.join(format!("{name}-distance.svg")), figure.as_bytes())?;
    }
    let sheet = png(&study.sheet(scene.file.inset.as_ref())).map_err(|error| making("picture", error))?;
    write_atomically(&folder.join(format!("{name}.png")), &sheet)?;
    Ok(())
}
