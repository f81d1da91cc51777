//! Measurements as headings and cells.

use crate::cost::Row;
use crate::cost::drawing::Drawing;
use crate::cost::effects::{Price, TABLE_1, table_1_ratios};
use crate::cost::ladder::statistical_axis;
use crate::cost::law::Law;
use crate::cost::row::{LITERAL, ROBUST};
use crate::cost::sizes::Size;
use crate::cost::techniques::{FramePrice, TechniquePrice};
use crate::threshold::batch::{Isa, Tier};
use crate::threshold::hash::HashKind;
use crate::threshold::real::Real;
use crate::threshold::robust::{Join, Robust};
use crate::threshold::two_scale::Variant;

/// A table: headings, and as many cells in every row.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// What stands above the columns.
    pub headings: Vec<&'static str>,
    /// Cells, row by row.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// Returns the table with every column as wide as its widest cell, numbers to the right.
    #[must_use]
    pub fn aligned(&self) -> String {
        let width = |column: usize| {
            let cells = self.rows.iter().map(|row| row[column].chars().count());
            cells.chain([self.headings[column].chars().count()]).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..self.headings.len()).map(width).collect();
        let is_number = |column: usize| {
            let mut cells = self.rows.iter().map(|row| row[column].as_str()).filter(|&cell| cell != NOTHING);
            cells.all(|cell| cell.parse::<f64>().is_ok())
        };
        let numbers: Vec<bool> = (0..self.headings.len()).map(is_number).collect();
        let headings: Vec<String> = self.headings.iter().map(|&heading| heading.to_owned()).collect();
        let mut text = String::new();
        for row in std::iter::once(&headings).chain(&self.rows) {
            let cells = row.iter().zip(&widths).zip(&numbers).map(|((cell, &width), &is_number)| {
                if is_number { format!("{cell:>width$}") } else { format!("{cell:<width$}") }
            });
            text += cells.collect::<Vec<_>>().join("  ").trim_end();
            text += "\n";
        }
        text
    }

    /// Returns the table with commas between the cells; none of them holds one.
    #[must_use]
    pub fn csv(&self) -> String {
        let line = |cells: Vec<String>| cells.join(",") + "\n";
        let plain = |cell: &String| if cell == NOTHING { String::new() } else { cell.replace(',', ";") };
        let headings = self.headings.iter().map(|heading| heading.replace(' ', "_")).collect();
        let rows = self.rows.iter().map(|row| line(row.iter().map(plain).collect()));
        std::iter::once(line(headings)).chain(rows).collect()
    }

    /// Returns the table as Markdown.
    #[must_use]
    pub fn markdown(&self) -> String {
        let line = |cells: &[&str]| format!("| {} |\n", cells.join(" | "));
        let rule = format!("|{}\n", "---|".repeat(self.headings.len()));
        let rows = self.rows.iter().map(|row| line(&row.iter().map(String::as_str).collect::<Vec<_>>()));
        [line(&self.headings), rule].into_iter().chain(rows).collect()
    }
}

/// What stands where nothing was measured.
const NOTHING: &str = "-";

fn time(ns: f64) -> String {
    format!("{ns:.3}")
}

fn small(value: Option<f64>) -> String {
    value.map_or_else(|| NOTHING.to_owned(), |value| format!("{value:.2e}"))
}

/// Returns the ladder as a table.
#[must_use]
pub fn ladder(rows: &[Row]) -> Table {
    let cells = |row: &Row| {
        let share = row.bits_equal.map_or_else(|| NOTHING.to_owned(), |share| format!("{share:.4}"));
        let law = |read: fn(&Law) -> f64| {
            row.law.as_ref().map_or_else(|| NOTHING.to_owned(), |law| format!("{:.4}", read(law)))
        };
        let words = [row.name, row.variant, row.hash, row.join, row.precision, row.tier, row.isa];
        let numbers = [
            row.threads.to_string(),
            time(row.ns_min),
            time(row.ns_median),
            format!("{:.2}", row.ratio),
            share,
            small(row.error),
            law(|law| law.ks),
            law(|law| law.bias),
            law(|law| law.flips_per_pixel),
            law(|law| law.flips_per_octave),
        ];
        words.map(str::to_owned).into_iter().chain(numbers).collect()
    };
    let headings = [
        "name",
        "variant",
        "hash",
        "join",
        "precision",
        "tier",
        "isa",
        "threads",
        "ns min",
        "ns median",
        "ratio",
        "bits equal",
        "error",
        "ks",
        "bias",
        "flips",
        "zoom flips",
    ];
    Table { headings: headings.to_vec(), rows: rows.iter().map(cells).collect() }
}

/// Returns a price list as a table; `effects` stands above the names of its rows.
#[must_use]
pub fn prices(effects: &'static str, prices: &[Price]) -> Table {
    let cells = |price: &Price| {
        let over = if price.over == price.name { NOTHING } else { price.over };
        let words = [price.name, price.source, over].map(str::to_owned);
        let numbers = [price.ns_min, price.ns_median, price.marginal]
            .map(time)
            .into_iter()
            .chain([format!("{:.2}", price.over_fixed)]);
        words.into_iter().chain(numbers).collect()
    };
    let headings = [effects, "source", "over", "ns min", "ns median", "marginal ns", "over fixed"];
    Table { headings: headings.to_vec(), rows: prices.iter().map(cells).collect() }
}

/// Returns what every technique adds to a frame of its scene.
#[must_use]
pub fn techniques(prices: &[TechniquePrice]) -> Table {
    let cells = |TechniquePrice { technique, effect, without, with }: &TechniquePrice| {
        let ([scene, take], table) = (technique.shown, effect.map_or("truth", |effect| effect.name));
        let words = [technique.name, technique.source, scene, take, table];
        let numbers = [*without, *with, with - without].map(|ns| format!("{ns:.1}"));
        words.map(str::to_owned).into_iter().chain(numbers).collect()
    };
    let headings =
        vec!["technique", "source", "scene", "take", "table", "without", "with", "adds ns a pixel"];
    Table { headings, rows: prices.iter().map(cells).collect() }
}

/// Whether a row is one of those that a reader compares first: whole thresholds by the best instructions of the machine and one
/// at a time, with the hash that each comes with, and what may be left out.
#[must_use]
pub fn is_shown(row: &Row) -> bool {
    let is_best = row.isa == Isa::best().name() || row.isa == "scalar";
    let (is_sine, is_default) = (row.hash == HashKind::Sine.name(), row.hash == Robust::HASH.name());
    let is_exact = row.tier == Tier::BitExact.name();
    let is_isotropic = row.variant == Variant::Isotropic.name();
    is_best
        && match row.name {
            LITERAL => {
                row.precision != "double-double" && (is_sine || (is_default && is_exact && is_isotropic))
            }
            ROBUST => is_default && is_exact && row.precision == f32::NAME,
            name => {
                name != "two scales with CDF" && statistical_axis().iter().any(|(known, _)| *known == name)
            }
        }
}

/// Names a threshold, and the way that it is computed.
#[must_use]
pub fn name_and_way(row: &Row) -> [String; 2] {
    let is_isotropic = row.variant == Variant::Isotropic.name();
    let name = match row.name {
        LITERAL if is_isotropic => "Listing 1",
        LITERAL => "Listing 2",
        ROBUST if is_isotropic => "robust",
        ROBUST => "robust anisotropic",
        // The joins of the statistical axis.
        name if name == row.join => "robust",
        name => name,
    };
    let mut words = vec![name];
    if row.name == LITERAL && row.hash != HashKind::Sine.name() {
        words.push(row.hash);
    }
    if name.starts_with("robust") && row.join != Join::Interpolate.name()
        || row.name == ROBUST && !is_isotropic
    {
        words.push(row.join);
    }
    if row.precision != f32::NAME {
        words.push(row.precision);
    }
    [words.join(" "), format!("{} {}", row.tier, row.isa)]
}

/// Returns the rows that a reader compares first, for a page.
#[must_use]
pub fn thresholds(rows: &[Row]) -> Table {
    let number = |value: f64, digits: usize| format!("{value:.digits$}");
    let cells = |row: &Row| {
        let [name, way] = name_and_way(row);
        let law = |read: fn(&Law) -> f64| {
            row.law.as_ref().map_or_else(|| NOTHING.to_owned(), |law| number(read(law), 4))
        };
        vec![
            name,
            way,
            number(row.ns_min, 2),
            number(row.ns_median, 2),
            number(row.ratio, 1),
            row.bits_equal.map_or_else(|| NOTHING.to_owned(), |share| number(share, 4)),
            small(row.error),
            law(|law| law.ks),
            law(|law| law.bias),
            law(|law| law.flips_per_pixel),
            law(|law| law.flips_per_octave),
        ]
    };
    let headings = [
        "threshold",
        "computed by",
        "ns min",
        "ns median",
        "ratio to std",
        "bits",
        "real",
        "KS distance",
        "bias of planes",
        "changes a pixel",
        "changes an octave",
    ];
    Table { headings: headings.to_vec(), rows: rows.iter().filter(|row| is_shown(row)).map(cells).collect() }
}

/// Returns the three tests of Table 1 over the scenes of the gallery, as ratios to the traditional one.
#[must_use]
pub fn frames(prices: &[FramePrice]) -> Table {
    let cells = |FramePrice { scene, tests: [traditional, hashed, stochastic] }: &FramePrice| {
        let ratio = |ns: f64| format!("{:.2}", ns / traditional);
        vec![(*scene).to_owned(), format!("{traditional:.1}"), ratio(*hashed), ratio(*stochastic)]
    };
    let headings = vec![
        "whole frames",
        "traditional ns a pixel",
        "hashed over traditional",
        "stochastic over traditional",
    ];
    Table { headings, rows: prices.iter().map(cells).collect() }
}

/// Returns Table 1 of the paper as ratios to the traditional test.
#[must_use]
pub fn table_1() -> Table {
    let ratio = |value: f64| format!("{value:.2}");
    let cells = |&(scene, [traditional, hashed, stochastic]): &(&str, [f64; 3])| {
        vec![scene.to_owned(), ratio(hashed / traditional), ratio(stochastic / traditional)]
    };
    let [hashed, stochastic] = table_1_ratios().map(|[low, high]| format!("{low:.2} to {high:.2}"));
    let mut rows: Vec<Vec<String>> = TABLE_1.iter().map(cells).collect();
    rows.push(vec!["all".to_owned(), hashed, stochastic]);
    Table {
        headings: vec!["Table 1 (whole frames)", "hashed over traditional", "stochastic over traditional"],
        rows,
    }
}

/// Returns the time of a frame against triangles and pixels.
#[must_use]
pub fn drawings(drawings: &[Drawing]) -> Table {
    let cells = |drawing: &Drawing| {
        let [width, height] = drawing.resolution;
        let each = drawing.time.median * 1e6 / drawing.fragments.max(1) as f64;
        vec![
            drawing.triangles.to_string(),
            format!("{width} x {height}"),
            drawing.take.clone(),
            drawing.fragments.to_string(),
            drawing.rays.to_string(),
            format!("{:.1}", drawing.time.min),
            format!("{:.1}", drawing.time.median),
            format!("{each:.1}"),
        ]
    };
    let headings =
        ["triangles", "pixels", "take", "fragments", "rays", "ms min", "ms median", "ns a fragment"];
    Table { headings: headings.to_vec(), rows: drawings.iter().map(cells).collect() }
}

/// Returns cost against size as a table.
#[must_use]
pub fn sizes(sizes: &[Size]) -> Table {
    let cells = |size: &Size| {
        vec![
            size.samples.to_string(),
            size.threads.to_string(),
            format!("{:.5}", size.seconds),
            time(size.seconds * 1e9 / size.samples as f64),
            size.peak_kib.map_or_else(|| NOTHING.to_owned(), |kib| format!("{:.1}", kib as f64 / 1024.0)),
            size.p.map_or_else(|| NOTHING.to_owned(), |p| format!("{p:.3}")),
        ]
    };
    let headings = ["samples", "threads", "seconds", "ns a sample", "peak MiB", "p of chi-square"];
    Table { headings: headings.to_vec(), rows: sizes.iter().map(cells).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_to_the_right_and_no_cell_breaks_a_line_of_csv() {
        let table = Table {
            headings: vec!["a name", "b"],
            rows: vec![vec!["x, y".into(), "1".into()], vec!["z".into(), "-".into()]],
        };
        assert_eq!(table.aligned(), "a name  b\nx, y    1\nz       -\n");
        assert_eq!(table.csv(), "a_name,b\nx; y,1\nz,\n");
        assert_eq!(table.markdown(), "| a name | b |\n|---|---|\n| x, y | 1 |\n| z | - |\n");
    }

    #[test]
    fn the_papers_table_ends_with_its_range() {
        let table = table_1();
        assert_eq!(table.rows.len(), 11);
        assert_eq!(table.rows[10], ["all", "1.02 to 1.36", "1.41 to 4.53"]);
    }
}
