//! `cost`: what accuracy, effects and numbers cost in time.

use super::args::CostArgs;
use super::failure::Failure;
use super::{Ending, drivers, output};
use hashed_alpha::cost::effects::Price;
use hashed_alpha::cost::{Effort, drawing, effects, ladder, sizes, techniques};
use hashed_alpha::report::cost::{json, page, pictures, table};
use hashed_alpha::report::directory::write_atomically;
#[cfg(feature = "gpu")]
use hashed_alpha::{
    cost::devices,
    shader::gpu::{Choice, Device},
};
use indicatif::ProgressBar;
use std::io::{self, Write};
use std::path::Path;

/// Measures, writes tables and pictures into the folder, then the results.
pub fn run(args: &CostArgs) -> Result<Ending, Failure> {
    if args.effects {
        drivers::silence();
    }
    let place = || args.out.display().to_string();
    std::fs::create_dir_all(&args.out).map_err(|source| Failure::File {
        action: "create",
        place: place(),
        source,
    })?;
    if cfg!(debug_assertions) {
        output::remark("note", "this build checks for overflow; `cargo run --release` does not");
    }
    let effort = if args.quick { Effort::Quick } else { Effort::Full };
    if args.sizes {
        of_sizes(args, effort)
    } else if args.drawing {
        of_drawing(args, effort)
    } else if args.effects {
        of_effects(args, effort)
    } else {
        of_accuracy(args, effort)
    }
}

/// Runs a measurement with a bar on stderr, where that is a terminal.
pub fn measured<T>(steps: u64, measure: impl FnOnce(&dyn Fn()) -> T) -> T {
    let bar = ProgressBar::new(steps);
    let found = measure(&|| bar.inc(1));
    bar.finish_and_clear();
    found
}

fn of_accuracy(args: &CostArgs, effort: Effort) -> Result<Ending, Failure> {
    let rows = measured(ladder::steps(effort), |done| ladder::ladder(effort, done));
    let table = table::ladder(&rows);
    written(&args.out, "cost.csv", &table.csv())?;
    for (name, svg) in pictures::ladder(&rows) {
        written(&args.out, name, &svg)?;
    }
    if let Some(path) = &args.page {
        let folder = path.parent().unwrap_or_else(|| Path::new(""));
        let (name, svg) = pictures::thresholds(&rows);
        written(folder, name, &svg)?;
        into_page(path, "cost", &table::thresholds(&rows).markdown())?;
    }
    print(args, &table.aligned(), |out| json::write_ladder(&rows, out))
}

fn of_effects(args: &CostArgs, effort: Effort) -> Result<Ending, Failure> {
    let prices = measured(effects::steps(effort), |done| effects::prices(effort, done));
    let (techniques, frames) = measured(techniques::steps(), |done| {
        (techniques::techniques(effort, done), techniques::frames(effort, done))
    });
    let kernels = table::prices("effect", &prices);
    let [of_techniques, of_frames] = [table::techniques(&techniques), table::frames(&frames)];
    written(&args.out, "cost-effects.csv", &kernels.csv())?;
    written(&args.out, "cost-techniques.csv", &of_techniques.csv())?;
    written(&args.out, "cost-frames.csv", &of_frames.csv())?;
    let device = on_device(args, effort);
    let of_device = device.as_ref().map(|found| table::prices("effect on the device", &found.1));
    if let Some(table) = &of_device {
        written(&args.out, "cost-effects-device.csv", &table.csv())?;
    }
    let tables = [Some(kernels), of_device, Some(of_techniques), Some(of_frames), Some(table::table_1())];
    let text = tables.into_iter().flatten().map(|table| table.aligned()).collect::<Vec<_>>().join("\n");
    print(args, &text, |out| {
        json::write_prices("cpu", &prices, out)?;
        if let Some((name, prices)) = &device {
            json::write_prices(name, prices, out)?;
        }
        json::write_techniques(&techniques, out)
    })
}

/// The name of the device and its price list; `None`, and why on stderr, where there is none.
#[cfg(feature = "gpu")]
fn on_device(args: &CostArgs, effort: Effort) -> Option<(String, Vec<Price>)> {
    let choice = args.adapter.as_deref().map_or_else(Choice::from_environment, Choice::from);
    let prices = Device::open(&choice).and_then(|device| {
        let prices = measured(devices::steps(effort), |done| devices::prices(&device, effort, done))?;
        let clock =
            if device.has_timestamps() { "its own clock" } else { "a wall clock, transfers included" };
        output::remark("note", format_args!("the device is {}, timed by {clock}", device.name()));
        Ok((device.name().to_owned(), prices))
    });
    prices.inspect_err(|error| output::remark("note", format_args!("no prices on a device: {error}"))).ok()
}

#[cfg(not(feature = "gpu"))]
fn on_device(_: &CostArgs, _: Effort) -> Option<(String, Vec<Price>)> {
    output::remark("note", "no prices on a device: this program was built without the feature `gpu`");
    None
}

fn of_sizes(args: &CostArgs, effort: Effort) -> Result<Ending, Failure> {
    let wanted = args.samples.map_or_else(|| sizes::all_sizes(effort), |samples| vec![samples]);
    let of_all = |done: &dyn Fn()| {
        let mut found = Vec::new();
        for samples in wanted.iter().copied() {
            for threads in [1, 2] {
                found.push(sizes::size(samples, threads)?);
                done();
            }
        }
        Ok(found)
    };
    let refused =
        |error: Box<dyn std::error::Error>| Failure::Usage(format!("no threads to be had: {error}"));
    let found = measured(2 * wanted.len() as u64, of_all).map_err(refused)?;
    let table = table::sizes(&found);
    written(&args.out, "cost-sizes.csv", &table.csv())?;
    for (name, svg) in pictures::sizes(&found) {
        written(&args.out, name, &svg)?;
    }
    print(args, &table.aligned(), |out| json::write_sizes(&found, out))
}

fn of_drawing(args: &CostArgs, effort: Effort) -> Result<Ending, Failure> {
    let found = measured(drawing::steps(effort), |done| drawing::drawings(effort, done));
    let table = table::drawings(&found);
    written(&args.out, "cost-drawing.csv", &table.csv())?;
    if let Some(path) = &args.page {
        into_page(path, "cost --drawing", &table.markdown())?;
    }
    print(args, &table.aligned(), |out| json::write_drawings(&found, out))
}

/// Writes a table between its marks in a page.
pub fn into_page(path: &Path, mark: &str, table: &str) -> Result<(), Failure> {
    Ok(write_atomically(path, with_table(path, mark, table)?.as_bytes())?)
}

/// A page with a table between its marks.
pub fn with_table(path: &Path, mark: &str, table: &str) -> Result<String, Failure> {
    let place = || path.display().to_string();
    let text = std::fs::read_to_string(path).map_err(|source| Failure::File {
        action: "read",
        place: place(),
        source,
    })?;
    page::replaced(&text, mark, table).ok_or_else(|| {
        let marks = format!("`<!-- {mark} -->` and `<!-- end of {mark} -->`");
        Failure::Usage(format!("{} does not have the lines {marks}", place()))
    })
}

fn written(folder: &Path, name: &str, text: &str) -> Result<(), Failure> {
    Ok(write_atomically(&folder.join(name), text.as_bytes())?)
}

/// Writes the results as they were asked for.
fn print(
    args: &CostArgs,
    text: &str,
    lines: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<Ending, Failure> {
    output::remark("note", format_args!("tables and pictures are in {}", args.out.display()));
    let mut results = output::results();
    let written = if args.json { lines(&mut results) } else { results.write_all(text.as_bytes()) };
    written.and_then(|()| results.flush()).map_err(Failure::Output)?;
    Ok(Ending::Consistent)
}
