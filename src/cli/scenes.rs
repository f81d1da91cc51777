//! `scenes`: both galleries as a list, one scene of footprints as rows for `eval`, one of the render gallery as a file.

use super::Ending;
use super::args::ScenesArgs;
use super::failure::Failure;
use super::output;
use super::rows::{write_header, write_row};
use hashed_alpha::check::subject::Precision;
use hashed_alpha::render::gallery;
use hashed_alpha::scene::Scene;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::real::Real;
use std::io::{self, Write};

/// Writes the list, or the footprints of the scene that was named.
pub fn run(args: &ScenesArgs) -> Result<Ending, Failure> {
    let output = &mut output::results();
    let written = match &args.name {
        None => write_list(output),
        Some(name) => match gallery::find(name) {
            Some(entry) => output.write_all(entry.text.as_bytes()),
            None => Scene::all()
                .into_iter()
                .filter(|scene| scene.name == name)
                .try_for_each(|scene| write_scene(output, scene, args)),
        },
    };
    written.and_then(|()| output.flush()).map_err(Failure::Output)?;
    Ok(Ending::Consistent)
}

/// One line a scene: `rows` are for `eval`, a `file` is for `explain` and `render`.
fn write_list(output: &mut impl Write) -> io::Result<()> {
    let scenes = Scene::all();
    let drawn = gallery::GALLERY;
    let names = scenes.iter().map(|scene| scene.name).chain(drawn.iter().map(|entry| entry.name));
    let width = names.map(str::len).max().unwrap_or(0);
    for scene in &scenes {
        writeln!(output, "{:width$}  rows  {}", scene.name, scene.description)?;
    }
    drawn
        .iter()
        .try_for_each(|scene| writeln!(output, "{:width$}  file  {}", scene.name, gallery::sentence(scene)))
}

fn write_scene(output: &mut impl Write, scene: Scene, args: &ScenesArgs) -> io::Result<()> {
    let scene = match args.resolution {
        Some(resolution) => scene.with_resolution(resolution),
        None => scene,
    };
    write_header(output)?;
    match (args.precision, args.quads) {
        (Precision::F32, false) => write_rows(output, scene.footprints().map(|exact| exact.cast::<f32>())),
        (Precision::F64, false) => write_rows(output, scene.footprints()),
        (Precision::F32, true) => write_rows(output, scene.quad_footprints()),
        (Precision::F64, true) => write_rows(output, scene.quad_footprints().map(|quad| quad.cast::<f64>())),
    }
}

fn write_rows<R: Real>(
    output: &mut impl Write,
    mut footprints: impl Iterator<Item = Footprint<R>>,
) -> io::Result<()> {
    footprints.try_for_each(|footprint| write_row(output, &footprint))
}
