//! `eval`: from footprints to thresholds, a row at a time.

use super::Ending;
use super::args::EvalArgs;
use super::failure::Failure;
use super::output;
use super::rows::{Rows, write_fields};
use hashed_alpha::check::subject::Precision;
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::hashed::{HashedAlpha, Trace};
use hashed_alpha::threshold::real::Real;
use hashed_alpha::threshold::two_scale::Variant;
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

/// Finds what the options mean in the precision `R`.
fn model<R: Real>(args: &EvalArgs) -> Result<HashedAlpha, Failure> {
    let hash_scale = R::from_f64(args.hash_scale);
    if !hash_scale.is_finite() || hash_scale <= R::default() {
        let message = format!(
            "--hash-scale {:?} is not finite and above 0 in {}; give a size in pixels",
            args.hash_scale,
            R::NAME
        );
        return Err(Failure::Usage(message));
    }
    let form = if args.literal { CdfForm::Literal } else { CdfForm::Stable };
    Ok(HashedAlpha { variant: args.variant, hash: args.hash, hash_scale: args.hash_scale, form })
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
    model: &HashedAlpha,
    traces: bool,
    mut rows: Rows<impl Read, R>,
    output: &mut impl Write,
) -> Result<u64, Failure> {
    let header = if traces { trace_header(model.variant) } else { "threshold".to_owned() };
    writeln!(output, "{header}").map_err(Failure::Output)?;
    let mut count = 0;
    while let Some(row) = rows.next() {
        let trace = model.trace(&row?);
        let written = if traces {
            write_trace(output, model.variant, &trace)
        } else {
            writeln!(output, "{:?}", trace.threshold)
        };
        let flushed = written.and_then(|()| if rows.may_wait() { output.flush() } else { Ok(()) });
        flushed.map_err(Failure::Output)?;
        count += 1;
    }
    Ok(count)
}

/// Tells how many values a variant has of those that [`TwoScale`](hashed_alpha::threshold::two_scale::TwoScale)
/// holds for every axis.
fn axes(variant: Variant) -> usize {
    if variant == Variant::Anisotropic { 3 } else { 1 }
}

fn trace_header(variant: Variant) -> String {
    let mut names = Vec::new();
    for name in ["max_derivative", "pixel_scale", "octave"] {
        let suffixes = if axes(variant) == 1 { [""].as_slice() } else { &["_x", "_y", "_z"] };
        names.extend(suffixes.iter().map(|suffix| format!("{name}{suffix}")));
    }
    names.join(",") + ",lerp_factor,hash_coarse,hash_fine,interpolated,threshold"
}

fn write_trace<R: Real>(output: &mut impl Write, variant: Variant, trace: &Trace<R>) -> io::Result<()> {
    let (axes, scales) = (axes(variant), &trace.two_scale);
    for value in scales.max_derivative[..axes].iter().chain(&scales.pixel_scale[..axes]) {
        write!(output, "{value:?},")?;
    }
    for octave in &scales.octave[..axes] {
        write!(output, "{octave},")?;
    }
    let Trace { hash_coarse, hash_fine, interpolated, threshold, .. } = *trace;
    write_fields(output, [scales.lerp_factor, hash_coarse, hash_fine, interpolated, threshold])
}
