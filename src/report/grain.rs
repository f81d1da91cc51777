//! Grain and flips of subjects: a table for a terminal, one JSON object a row, and rows of Markdown.

use crate::check::Subject;
use crate::check::grain::{self, Grain, Plane, ZoomFlips};
use serde::Serialize;
use std::fmt::Write as _;

/// What was measured of one subject.
pub struct Measured {
    /// Its name and precision, as in `robust:isotropic in f32`.
    pub name: String,
    /// What [`grain::grain`] found.
    pub grain: Vec<Grain>,
    /// What [`grain::zoom_flips`] found.
    pub zoom: Vec<ZoomFlips>,
}

impl Measured {
    /// Measures a subject.
    ///
    /// # Errors
    ///
    /// Those of [`grain::grain`].
    pub fn new(subject: &Subject<'_>, seed: u64) -> Result<Self, String> {
        Ok(Self {
            name: format!("{} in {}", subject.name, subject.precision),
            grain: grain::grain(subject, seed)?,
            zoom: grain::zoom_flips(subject, seed)?,
        })
    }

    fn of(&self, plane: Plane) -> impl Iterator<Item = &Grain> {
        self.grain.iter().filter(move |grain| grain.plane == plane)
    }

    /// A row of [`MARKDOWN_HEAD`], behind a first column.
    #[must_use]
    pub fn markdown(&self, first: &str) -> String {
        let joined = |values: Vec<String>| values.join(" / ");
        let grain = |plane| joined(self.of(plane).map(|found| format!("{:.2}", found.grain)).collect());
        let flips = |plane| joined(self.of(plane).map(|found| format!("{:.3}", found.flips)).collect());
        let zoom = joined(self.zoom.iter().map(|found| format!("{:.3}", found.flips)).collect());
        let [axis, general, grazing] = Plane::ALL.map(grain);
        let [on_axis, in_general, _] = Plane::ALL.map(flips);
        format!("| {first} | {axis} | {general} | {grazing} | {on_axis} | {in_general} | {zoom} |")
    }
}

/// The head of a table of [`Measured::markdown`]: each cell for alpha 0.1, 0.25 and 0.5.
pub const MARKDOWN_HEAD: &str = "\
| threshold | grain, axis plane | general position | grazing angle | flips at 1/8 pixel, axis plane | general position | flips an octave |
|---|---|---|---|---|---|---|";

/// What the numbers are, in a line or two.
pub const MEANING: &str = "grain: power of what is visible below 1/16 cycle a pixel, 1 for noise without order (256 x 256 pixels, no \
                           other window; mean of 24 pictures and its standard error)\nflips: share of pixels that appear or vanish when \
                           the surface moves by 1/8 pixel; an octave: share of points that do while the camera comes an octave closer";

/// The table for a terminal.
#[must_use]
pub fn table(all: &[Measured]) -> String {
    let mut text = String::new();
    for Measured { name, grain, zoom } in all {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name}\n  surface           alpha  grain        flips");
        for Grain { plane, alpha, grain, error, flips } in grain {
            let plane = plane.name();
            let _ = writeln!(text, "  {plane:<16}  {alpha:<5}  {grain:4.2} ± {error:4.2}  {flips:.4}");
        }
        for ZoomFlips { alpha, flips, error } in zoom {
            let without_memory = flips / (2.0 * alpha * (1.0 - alpha));
            let _ = writeln!(
                text,
                "  an octave         {alpha:<5}  {flips:.4} ± {error:.4} flips, {without_memory:.2} times 2 alpha (1 - alpha)"
            );
        }
    }
    text + MEANING + "\n"
}

/// One row as JSON.
#[derive(Serialize)]
struct Line<'a> {
    subject: &'a str,
    surface: &'a str,
    alpha: f64,
    grain: Option<f64>,
    grain_error: Option<f64>,
    flips: f64,
}

/// One JSON object a row; the rows of an octave of zoom have no grain.
///
/// # Errors
///
/// None that can happen: what is written are numbers and names.
pub fn json_lines(all: &[Measured]) -> serde_json::Result<String> {
    let mut text = String::new();
    for Measured { name: subject, grain, zoom } in all {
        let of_grain = grain.iter().map(|found| Line {
            subject,
            surface: found.plane.name(),
            alpha: found.alpha,
            grain: Some(found.grain),
            grain_error: Some(found.error),
            flips: found.flips,
        });
        let of_zoom = zoom.iter().map(|found| Line {
            subject,
            surface: "an octave of zoom",
            alpha: found.alpha,
            grain: None,
            grain_error: None,
            flips: found.flips,
        });
        for line in of_grain.chain(of_zoom) {
            text += &serde_json::to_string(&line)?;
            text.push('\n');
        }
    }
    Ok(text)
}
