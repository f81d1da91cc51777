//! What accuracy costs in time: one row a threshold, its nanoseconds beside its exactness and its distance to the uniform law.

use super::rows::{Column, range_of, rows as drawn};
use super::style::{Axis, BLUE, INK, Key, VERMILLION};

/// One way to a threshold.
#[derive(Clone, Debug, PartialEq)]
pub struct Priced {
    /// Its name.
    pub name: String,
    /// Its time in nanoseconds a threshold, above 0.
    pub ns: f64,
    /// The share of thresholds that have the bits of the reference.
    pub exact: f64,
    /// The greatest distance of its law to the uniform one, above 0.
    pub distance: f64,
}

/// Room for the names, and widths of the charts of times, shares and distances.
const WIDTHS: [i32; 4] = [710, 480, 250, 360];

/// Draws rows from top to bottom: nanoseconds, share of exact thresholds, distance to the uniform law. A law farther from the uniform one than `chance`, which is drawn as a line, is marked.
#[must_use]
pub fn price(title: &str, rows: &[Priced], chance: f64) -> String {
    let entries = [
        (Key::Field(BLUE), "uniform, as far as the samples tell"),
        (Key::Field(VERMILLION), "not uniform"),
        (Key::Line(INK), "chance stays to the left of the line, but once in a million"),
    ];
    let names: Vec<&str> = rows.iter().map(|row| row.name.as_str()).collect();
    let marks = |value: &dyn Fn(&Priced) -> f64| {
        let colour = |row: &Priced| if row.distance > chance { VERMILLION } else { BLUE };
        rows.iter().map(|row| (value(row), colour(row))).collect()
    };
    let logarithms = |read: fn(&Priced) -> f64| rows.iter().map(move |row| libm::log10(read(row)));
    let times = range_of(logarithms(|row| row.ns), 0.15);
    let distances = range_of(logarithms(|row| row.distance).chain([libm::log10(chance)]), 0.15);
    let [room, of_times, of_shares, of_distances] = WIDTHS;
    let columns = [
        Column {
            axis: Axis::logarithmic("nanoseconds a threshold", times, 9),
            width: of_times,
            marks: marks(&|row| libm::log10(row.ns)),
            line: None,
        },
        Column {
            axis: Axis { terse: true, ..Axis::new("exact bits", -0.08..1.08, 2) },
            width: of_shares,
            marks: marks(&|row| row.exact),
            line: None,
        },
        Column {
            axis: Axis::logarithmic("distance to uniform law", distances, 5),
            width: of_distances,
            marks: marks(&|row| libm::log10(row.distance)),
            line: Some(libm::log10(chance)),
        },
    ];
    drawn(title, &entries, (&names, room), &columns)
}

#[cfg(test)]
mod tests {
    use super::super::style::tests::is_sound;
    use super::*;

    #[test]
    fn rows_are_named_and_those_beyond_chance_are_marked() {
        let row = |name: &str, ns, distance| Priced { name: name.to_owned(), ns, exact: 1.0, distance };
        let rows = [row("fast", 2.1, 0.001), row("linear", 30.0, 0.08)];
        let svg = price("prices", &rows, 0.005);
        is_sound(
            &svg,
            &["fast", "linear", "nanoseconds a threshold", "distance to uniform law", "exact bits", "0.01"],
        );
        let marks = |rows: &[Priced]| price("prices", rows, 0.005).matches("<circle").count();
        assert_eq!(marks(&rows), 6);
        let colours = svg.matches("#D55E00").count();
        let sound = price("prices", &rows[..1], 0.005).matches("#D55E00").count();
        assert_eq!(colours, sound + 3, "three marks of one row");
    }

    #[test]
    fn nothing_to_draw_gives_an_empty_picture() {
        is_sound(&price("nothing", &[], 0.005), &["nothing"]);
    }
}
