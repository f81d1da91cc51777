//! Hashes: how fast, how good, and how much a surface flickers with them.

use super::rows::{Column, range_of, rows};
use super::style::{Axis, BLUE, Key, VERMILLION};

/// One hash.
#[derive(Clone, Debug, PartialEq)]
pub struct Hashed {
    /// Its name.
    pub name: String,
    /// Its time in nanoseconds a cell, above 0.
    pub ns: f64,
    /// Logarithm to base two of the fewest samples at which a claim rejects it, or of the most that none rejects.
    pub log2_n: f64,
    /// Whether a claim rejects it.
    pub rejected: bool,
    /// Changes of a point in an octave of zoom.
    pub flips: f64,
}

/// Room for the names, and widths of the charts.
const WIDTHS: [i32; 4] = [420, 480, 480, 420];

/// Draws hashes from top to bottom: nanoseconds a cell, samples until a claim fails, changes in an octave.
#[must_use]
pub fn hashes(title: &str, all: &[Hashed]) -> String {
    let entries = [
        (Key::Field(BLUE), "no claim rejects it, up to so many samples"),
        (Key::Field(VERMILLION), "a claim rejects it at so many samples"),
    ];
    let names: Vec<&str> = all.iter().map(|hash| hash.name.as_str()).collect();
    let marks = |value: &dyn Fn(&Hashed) -> f64| {
        let colour = |hash: &Hashed| if hash.rejected { VERMILLION } else { BLUE };
        all.iter().map(|hash| (value(hash), colour(hash))).collect()
    };
    let [room, of_times, of_samples, of_flips] = WIDTHS;
    let columns = [
        Column {
            axis: Axis::logarithmic(
                "nanoseconds a cell",
                range_of(all.iter().map(|hash| libm::log10(hash.ns)), 0.1),
                8,
            ),
            width: of_times,
            marks: marks(&|hash| libm::log10(hash.ns)),
            line: None,
        },
        Column {
            axis: Axis::new(
                "samples until failure [log2]",
                range_of(all.iter().map(|hash| hash.log2_n), 1.0),
                6,
            ),
            width: of_samples,
            marks: marks(&|hash| hash.log2_n),
            line: None,
        },
        Column {
            axis: Axis::new("flips an octave", range_of(all.iter().map(|hash| hash.flips), 0.05), 4),
            width: of_flips,
            marks: marks(&|hash| hash.flips),
            line: None,
        },
    ];
    rows(title, &entries, (&names, room), &columns)
}

#[cfg(test)]
mod tests {
    use super::super::style::tests::is_sound;
    use super::*;

    #[test]
    fn what_a_claim_rejects_is_marked() {
        let hash = |name: &str, ns, rejected| Hashed {
            name: name.to_owned(),
            ns,
            log2_n: 12.0,
            rejected,
            flips: 0.5,
        };
        let svg = hashes("hashes", &[hash("fast", 0.7, false), hash("lattice", 0.4, true)]);
        is_sound(&svg, &["fast", "lattice", "nanoseconds a cell", "flips an octave"]);
        assert_eq!(svg.matches("<circle").count(), 6);
        is_sound(&hashes("none", &[]), &["none"]);
    }
}
