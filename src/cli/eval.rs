//! `eval`: from footprints to thresholds, a row at a time.

use super::Ending;
use super::args::EvalArgs;
use super::failure::Failure;
use super::output;
use super::rows::{Rows, write_fields};
use super::shader::robust_of;
use hashed_alpha::check::subject::Precision;
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::real::Real;
use hashed_alpha::threshold::robust::{Join, Repairs, Robust, join::Joined, scales::Scales};
use hashed_alpha::threshold::two_scale::{TwoScale, Variant};
use std::fs::File;
use std::io::{self, IsTerminal, Read, Write};
use std::path::Path;

/// Reads rows, writes thresholds.
pub fn run(args: &EvalArgs) -> Result<Ending, Failure> {
    match args.precision {
        Precision::F32 => run_in::<f32>(args),
        Precision::F64 => run_in::<f64>(args),
    }
}

fn run_in<R: Real>(args: &EvalArgs) -> Result<Ending, Failure> {
    let model = model::<R>(args)?;
    let (input, place) = open(&args.file)?;
    let rows = Rows::<_, R>::new(input, place.clone());
    let output = &mut output::results();
    let count = evaluate(&model, args.trace, rows, output);
    // Before a bad row is reported, so that the rows above it are kept.
    output.flush().map_err(Failure::Output)?;
    if count? == 0 {
        output::remark("note", format_args!("{place} holds no footprints"));
    }
    Ok(Ending::Consistent)
}

/// What the options ask for.
enum Model {
    /// The paper's, to the letter or, for the ablations, with the clamp.
    Listing(HashedAlpha),
    /// The robust threshold.
    Robust(Robust),
}

/// Finds what the options mean in the precision `R`.
fn model<R: Real>(args: &EvalArgs) -> Result<Model, Failure> {
    let &EvalArgs { variant, hash_scale, .. } = args;
    let rounded = R::from_f64(hash_scale);
    if !rounded.is_finite() || rounded <= R::default() {
        let message = format!(
            "--hash-scale {hash_scale:?} is not finite and above 0 in {}; give a size in pixels",
            R::NAME
        );
        return Err(Failure::Usage(message));
    }
    let is_ablation = matches!(variant, Variant::Linear | Variant::Single);
    if args.literal || is_ablation {
        if args.join.is_some() || !args.without.is_empty() {
            let message = format!(
                "--join and --without change the robust threshold; {} is evaluated as the paper has it",
                if args.literal { "--literal" } else { variant.name() }
            );
            return Err(Failure::Usage(message));
        }
        let form = if args.literal { CdfForm::Literal } else { CdfForm::Stable };
        let hash = args.hash.unwrap_or(HashKind::Sine);
        return Ok(Model::Listing(HashedAlpha { variant, hash, hash_scale, form }));
    }
    let repairs = args.without.iter().fold(Repairs::ALL, |repairs, &repair| repairs.without(repair));
    Ok(Model::Robust(Robust { hash_scale, ..robust_of(variant, args.hash, args.join, repairs)? }))
}

fn open(file: &Path) -> Result<(Box<dyn Read>, String), Failure> {
    if file == Path::new("-") {
        if io::stdin().is_terminal() {
            output::remark("note", "reading footprints from the terminal; --help shows what a row is");
        }
        return Ok((Box::new(io::stdin().lock()), "standard input".to_owned()));
    }
    let place = file.display().to_string();
    match File::open(file) {
        Ok(input) => Ok((Box::new(input), place)),
        Err(source) => Err(Failure::File { action: "open", place, source }),
    }
}

/// Writes a header and one line a row; returns the number of rows.
///
/// Nothing is held back while the input pauses, so that a program can feed rows and read thresholds in turn.
fn evaluate<R: Real>(
    model: &Model,
    traces: bool,
    mut rows: Rows<impl Read, R>,
    output: &mut impl Write,
) -> Result<u64, Failure> {
    let header = if traces { trace_header(model) } else { "threshold".to_owned() };
    writeln!(output, "{header}").map_err(Failure::Output)?;
    let mut count = 0;
    while let Some(row) = rows.next() {
        let steps = steps(model, &row?)?;
        let written = if traces {
            write_steps(output, model, &steps)
        } else {
            writeln!(output, "{:?}", steps.threshold)
        };
        let flushed = written.and_then(|()| if rows.may_wait() { output.flush() } else { Ok(()) });
        flushed.map_err(Failure::Output)?;
        count += 1;
    }
    Ok(count)
}

/// The columns of a trace. What a model has once stands three times.
struct Steps<R> {
    max_derivative: [R; 3],
    pixel_scale: [R; 3],
    octave: [i32; 3],
    lerp_factor: [R; 3],
    hash_coarse: R,
    hash_fine: R,
    interpolated: R,
    threshold: R,
}

fn steps<R: Real>(model: &Model, footprint: &Footprint<R>) -> Result<Steps<R>, Failure> {
    match model {
        Model::Listing(listing) => {
            let trace = listing.trace(footprint);
            let TwoScale { max_derivative, pixel_scale, octave, lerp_factor, .. } = trace.two_scale;
            Ok(Steps {
                max_derivative,
                pixel_scale,
                octave,
                lerp_factor: [lerp_factor; 3],
                hash_coarse: trace.hash_coarse,
                hash_fine: trace.hash_fine,
                interpolated: trace.interpolated,
                threshold: trace.threshold,
            })
        }
        Model::Robust(robust) => {
            let trace = robust.trace(footprint).map_err(|error| Failure::Usage(error.to_string()))?;
            let Scales { max_derivative, pixel_scale, octave, .. } = trace.scales;
            let Joined { lerp_factor, hash_coarse, hash_fine, interpolated, .. } = trace.joined;
            let threshold = trace.threshold;
            Ok(Steps {
                max_derivative,
                pixel_scale,
                octave,
                lerp_factor,
                hash_coarse,
                hash_fine,
                interpolated,
                threshold,
            })
        }
    }
}

impl Model {
    /// Tells how many scales there are, and how many weights.
    fn axes(&self) -> (usize, usize) {
        match self {
            Self::Listing(HashedAlpha { variant: Variant::Anisotropic, .. }) => (3, 1),
            Self::Robust(Robust { variant: Variant::Anisotropic, join: Join::Interpolate, .. }) => (3, 1),
            Self::Robust(Robust { variant: Variant::Anisotropic, .. }) => (3, 3),
            _ => (1, 1),
        }
    }
}

fn trace_header(model: &Model) -> String {
    let (scales, weights) = model.axes();
    let columns =
        [("max_derivative", scales), ("pixel_scale", scales), ("octave", scales), ("lerp_factor", weights)];
    let mut names = Vec::new();
    for (name, count) in columns {
        let suffixes = if count == 1 { [""].as_slice() } else { &["_x", "_y", "_z"] };
        names.extend(suffixes.iter().map(|suffix| format!("{name}{suffix}")));
    }
    names.join(",") + ",hash_coarse,hash_fine,interpolated,threshold"
}

fn write_steps<R: Real>(output: &mut impl Write, model: &Model, steps: &Steps<R>) -> io::Result<()> {
    let (scales, weights) = model.axes();
    for value in steps.max_derivative[..scales].iter().chain(&steps.pixel_scale[..scales]) {
        write!(output, "{value:?},")?;
    }
    for octave in &steps.octave[..scales] {
        write!(output, "{octave},")?;
    }
    for weight in &steps.lerp_factor[..weights] {
        write!(output, "{weight:?},")?;
    }
    write_fields(output, [steps.hash_coarse, steps.hash_fine, steps.interpolated, steps.threshold])
}
