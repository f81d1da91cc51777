//! `explain`: what a scene will simulate, before it does.

use super::args::ExplainArgs;
use super::failure::Failure;
use super::render::bar;
use super::{Ending, output, scene_files};
use hashed_alpha::render::draw::shot::shots;
use hashed_alpha::render::draw::texture::TextureNeeds;
use hashed_alpha::render::effect::plan::plan;
use hashed_alpha::render::measure::predict::predict;
use hashed_alpha::render::measure::study;
use hashed_alpha::report::study::{Planned, write_plans};
use std::io::Write;

/// Prints the plans of every scene.
pub fn run(args: &ExplainArgs) -> Result<Ending, Failure> {
    let mut results = output::results();
    for read in scene_files::read_all(&args.scene)? {
        let scene = read.prepare()?;
        let chosen = study::chosen(&scene, &scene.textures(&TextureNeeds::default()));
        let bar = bar(&scene);
        let pictures = (chosen.len() * shots(&scene).len()) as u64 * u64::from(scene.file.frames.get());
        bar.set_length(pictures);
        let planned: Vec<Planned> = chosen
            .into_iter()
            .map(|(effects, reasons)| {
                let plan = plan(&effects);
                let textures = scene.textures(&plan.setup.textures);
                let cost = predict(&plan, &scene, &textures, &mut || bar.inc(1));
                Planned { cost, effects, plan, reasons }
            })
            .collect();
        bar.finish_and_clear();
        write_plans(&scene, &planned, &mut results).map_err(Failure::Output)?;
        for planned in planned.iter().filter(|_| args.shader) {
            let text = planned.plan.shader().unwrap_or_else(|reason| format!("// {reason}\n"));
            writeln!(results, "\n// {}\n{text}", planned.plan.name).map_err(Failure::Output)?;
        }
    }
    results.flush().map_err(Failure::Output)?;
    Ok(Ending::Consistent)
}
