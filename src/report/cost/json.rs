//! Measurements as JSON Lines: one object a row. What was not measured, or is no number, is null.

use crate::cost::Row;
use crate::cost::drawing::Drawing;
use crate::cost::effects::Price;
use crate::cost::sizes::Size;
use crate::cost::techniques::TechniquePrice;
use serde::Serialize;
use std::io::{self, Write};

/// The keys of a row of the ladder, in their order.
#[derive(Serialize)]
struct LadderLine {
    name: &'static str,
    variant: &'static str,
    hash: &'static str,
    join: &'static str,
    precision: &'static str,
    tier: &'static str,
    isa: &'static str,
    threads: usize,
    ns_min: f64,
    ns_median: f64,
    ratio: f64,
    bits_equal: Option<f64>,
    error: Option<f64>,
    ks: Option<f64>,
    flips: Option<f64>,
}

/// Writes the ladder; `flips` are those of a pixel of motion.
///
/// # Errors
/// What the writer says.
pub fn write_ladder(rows: &[Row], out: &mut (impl Write + ?Sized)) -> io::Result<()> {
    let number = |value: Option<f64>| value.filter(|value| value.is_finite());
    write_lines(
        out,
        rows.iter().map(|row| LadderLine {
            name: row.name,
            variant: row.variant,
            hash: row.hash,
            join: row.join,
            precision: row.precision,
            tier: row.tier,
            isa: row.isa,
            threads: row.threads,
            ns_min: row.ns_min,
            ns_median: row.ns_median,
            ratio: row.ratio,
            bits_equal: number(row.bits_equal),
            error: number(row.error),
            ks: number(row.law.map(|law| law.ks)),
            flips: number(row.law.map(|law| law.flips_per_pixel)),
        }),
    )
}

#[derive(Serialize)]
struct PriceLine<'a> {
    effect: &'static str,
    on: &'a str,
    source: &'static str,
    over: &'static str,
    ns_min: f64,
    ns_median: f64,
    marginal: f64,
    over_fixed: f64,
}

/// Writes the price list of `on`, the CPU or a device.
///
/// # Errors
/// What the writer says.
pub fn write_prices(on: &str, prices: &[Price], out: &mut (impl Write + ?Sized)) -> io::Result<()> {
    write_lines(
        out,
        prices.iter().map(|price| PriceLine {
            effect: price.name,
            on,
            source: price.source,
            over: price.over,
            ns_min: price.ns_min,
            ns_median: price.ns_median,
            marginal: price.marginal,
            over_fixed: price.over_fixed,
        }),
    )
}

#[derive(Serialize)]
struct TechniqueLine {
    technique: &'static str,
    scene: &'static str,
    take: &'static str,
    table: &'static str,
    without: f64,
    with: f64,
}

/// Writes what techniques add; times are nanoseconds a pixel.
///
/// # Errors
/// What the writer says.
pub fn write_techniques(prices: &[TechniquePrice], out: &mut (impl Write + ?Sized)) -> io::Result<()> {
    write_lines(
        out,
        prices.iter().map(|TechniquePrice { technique, effect, without, with }| TechniqueLine {
            technique: technique.name,
            scene: technique.shown[0],
            take: technique.shown[1],
            table: effect.map_or("truth", |effect| effect.name),
            without: *without,
            with: *with,
        }),
    )
}

#[derive(Serialize)]
struct DrawingLine<'a> {
    triangles: usize,
    resolution: [u32; 2],
    take: &'a str,
    fragments: u64,
    rays: u64,
    ms_min: f64,
    ms_median: f64,
}

/// Writes the time of a frame against triangles and pixels.
///
/// # Errors
/// What the writer says.
pub fn write_drawings(drawings: &[Drawing], out: &mut (impl Write + ?Sized)) -> io::Result<()> {
    write_lines(
        out,
        drawings.iter().map(|drawing| DrawingLine {
            triangles: drawing.triangles,
            resolution: drawing.resolution,
            take: &drawing.take,
            fragments: drawing.fragments,
            rays: drawing.rays,
            ms_min: drawing.time.min,
            ms_median: drawing.time.median,
        }),
    )
}

#[derive(Serialize)]
struct SizeLine {
    samples: u64,
    threads: usize,
    seconds: f64,
    peak_kib: Option<u64>,
    p: Option<f64>,
}

/// Writes cost against size.
///
/// # Errors
/// What the writer says.
pub fn write_sizes(sizes: &[Size], out: &mut (impl Write + ?Sized)) -> io::Result<()> {
    write_lines(
        out,
        sizes.iter().map(|size| SizeLine {
            samples: size.samples,
            threads: size.threads,
            seconds: size.seconds,
            peak_kib: size.peak_kib,
            p: size.p,
        }),
    )
}

fn write_lines(
    out: &mut (impl Write + ?Sized),
    lines: impl Iterator<Item = impl Serialize>,
) -> io::Result<()> {
    for line in lines {
        serde_json::to_writer(&mut *out, &line)?;
        out.write_all(b"\n")?;
    }
    Ok(())
}
