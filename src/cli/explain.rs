//! `explain`: what a scene will simulate, before it does.

use super::args::ExplainArgs;
use super::failure::Failure;
use super::{Ending, output, scene_files};
use hashed_alpha::render::plan::plan;
use hashed_alpha::render::study;
use hashed_alpha::report::study::{Planned, write_plans};
use std::io::Write;

/// Prints the plans of every scene.
pub fn run(args: &ExplainArgs) -> Result<Ending, Failure> {
    let mut results = output::results();
    for name in scene_files::names(&args.scene) {
        let scene = scene_files::load(&name, &args.scene)?;
        let textures = scene.textures(false);
        let chosen = study::chosen(&scene, &textures);
        let planned: Vec<Planned> = chosen
            .into_iter()
            .map(|(effects, reasons)| {
                let plan = plan(&effects);
                Planned { cost: plan.predict(&scene, &textures), effects, plan, reasons }
            })
            .collect();
        write_plans(&scene, &planned, &mut results).map_err(Failure::Output)?;
        for planned in planned.iter().filter(|_| args.shader) {
            let text = planned.plan.shader().map_err(|error| Failure::Usage(error.to_string()))?;
            let text = text.unwrap_or_else(|| "// no shader text for this threshold\n".to_owned());
            writeln!(results, "\n// {}\n{text}", planned.plan.name).map_err(Failure::Output)?;
        }
    }
    results.flush().map_err(Failure::Output)?;
    Ok(Ending::Consistent)
}
