//! Which pictures a measurement has.

use crate::cost::Row;
use crate::cost::ladder::statistical_axis;
use crate::cost::row::LITERAL;
use crate::cost::sizes::Size;
use crate::report::cost::table;
use crate::report::figure::front::{Point, front};
use crate::report::figure::growth::{Growth, growth};
use crate::report::figure::price::{Priced, price};
use crate::threshold::two_scale::Variant;

/// A file name and its SVG text.
pub type Picture = (&'static str, String);

/// Draws the fronts of the ladder.
#[must_use]
pub fn ladder(rows: &[Row]) -> Vec<Picture> {
    let points = |wanted: &dyn Fn(&Row) -> bool, value: &dyn Fn(&Row) -> Option<f64>| -> Vec<Point> {
        let point = |row: &Row| Some(Point { name: name(row), ns: row.ns_median, value: value(row)? });
        rows.iter().filter(|row| wanted(row)).filter_map(point).collect()
    };
    let is_axis = |row: &Row| statistical_axis().iter().any(|(name, _)| *name == row.name);
    let is_listing =
        |row: &Row| row.name == LITERAL && row.hash == "sine" && row.variant == Variant::Isotropic.name();
    let bits = |row: &Row| row.error.map(|error| libm::log2(error.max(1e-17)));
    vec![
        thresholds(rows),
        (
            "cost-sine.svg",
            front(
                "The sine: error against time",
                "greatest error [log2]",
                &points(&|row| row.name == "sine", &bits),
            ),
        ),
        (
            "cost-reproducible.svg",
            front(
                "Listing 1: thresholds that are not those of the reference, against time",
                "share of other thresholds",
                &points(&is_listing, &|row| row.bits_equal.map(|share| 1.0 - share)),
            ),
        ),
        (
            "cost-real.svg",
            front(
                "Listing 1: distance to the formula over real numbers, against time",
                "mean distance",
                &points(&is_listing, &|row| row.error),
            ),
        ),
        (
            "cost-uniform.svg",
            front(
                "What may be left out: distance to the uniform law, against time",
                "Kolmogorov-Smirnov distance",
                &points(&is_axis, &|row| row.law.map(|law| law.ks)),
            ),
        ),
        (
            "cost-stable.svg",
            front(
                "What may be left out: changes of visibility in an octave of zoom, against time",
                "changes a fragment",
                &points(&is_axis, &|row| row.law.map(|law| law.flips_per_octave)),
            ),
        ),
    ]
}

/// Draws what accuracy costs in time: the rows of [`table::thresholds`], the fastest first.
#[must_use]
pub fn thresholds(rows: &[Row]) -> Picture {
    let priced = |row: &Row| {
        let law = row.law.filter(|law| law.ks > 0.0)?;
        let name = table::name_and_way(row).join(", ");
        Some((Priced { name, ns: row.ns_median, exact: row.bits_equal?, distance: law.ks }, law.chance))
    };
    let mut found: Vec<(Priced, f64)> =
        rows.iter().filter(|row| table::is_shown(row)).filter_map(priced).collect();
    found.sort_by(|(a, _), (b, _)| a.ns.total_cmp(&b.ns));
    let chance = found.first().map_or(1.0, |(_, chance)| *chance);
    let shown: Vec<Priced> = found.into_iter().map(|(row, _)| row).collect();
    ("cost.svg", price("What accuracy costs in time", &shown, chance))
}

/// Names a row by what tells it apart in its picture.
fn name(row: &Row) -> String {
    let words = [row.name, row.precision, row.tier, row.isa];
    let told: &[&str] = if row.variant == "-" || row.name == LITERAL { &words[1..] } else { &words[..1] };
    let mut told = told.to_vec();
    // "f64 f64" and "double-double double-double" say it once.
    told.dedup();
    told.join(" ")
}

/// Draws cost against size.
#[must_use]
pub fn sizes(sizes: &[Size]) -> Vec<Picture> {
    let mut threads: Vec<usize> = sizes.iter().map(|size| size.threads).collect();
    threads.sort_unstable();
    threads.dedup();
    let of = |threads: usize| sizes.iter().filter(move |size| size.threads == threads);
    let lines = |value: &dyn Fn(&Size) -> Option<f64>| -> Vec<Growth> {
        let line = |&threads: &usize| Growth {
            name: if threads == 1 { "1 thread".to_owned() } else { format!("{threads} threads") },
            points: of(threads).filter_map(|size| Some([size.samples as f64, value(size)?])).collect(),
        };
        threads.iter().map(line).collect()
    };
    let time = lines(&|size| Some(size.seconds));
    let memory = lines(&|size| size.peak_kib.map(|kib| kib as f64 / 1024.0));
    vec![(
        "cost-sizes.svg",
        growth(
            "A chi-square test of the robust threshold",
            [("seconds", &time), ("peak memory, MiB", &memory)],
        ),
    )]
}
