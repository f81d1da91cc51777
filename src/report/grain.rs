//! Grain and flips of subjects: a table for a terminal, one JSON object a row, and rows of Markdown.

use crate::check::Subject;
use crate::check::grain::{self, Grain, Plane, ZoomFlips};
use crate::check::motion::{self, Pops, Runs};
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

/// How a subject answers to the camera.
pub struct Moved {
    /// What [`motion::pops`] found.
    pub pops: Vec<Pops>,
    /// What [`motion::runs`] found.
    pub runs: Vec<Runs>,
}

impl Moved {
    /// Measures a subject.
    ///
    /// # Errors
    ///
    /// Those of [`motion::pops`].
    pub fn new(subject: &Subject<'_>, seed: u64) -> Result<Self, String> {
        Ok(Self { pops: motion::pops(subject, seed)?, runs: motion::runs(subject, seed)? })
    }
}

/// The head of a table of [`Measured::markdown`]: each cell for alpha 0.1, 0.25 and 0.5.
pub const MARKDOWN_HEAD: &str = "\
| threshold | grain, axis plane | general position | grazing angle | flips at 1/8 pixel, axis plane | general position | flips an octave |
|---|---|---|---|---|---|---|";

/// What the numbers are, in a line or two.
pub const MEANING: &str = "grain: power of what is visible below 1/16 cycle a pixel, 1 for noise without order (256 x 256 pixels, no \
                           other window; mean of 24 pictures and its standard error)\nflips: share of pixels that appear or vanish when \
                           the surface moves by 1/8 pixel; an octave: share of points that do while the camera comes an octave closer\na small \
                           motion: 1/64 of an octave, or of a quarter turn about the line of sight, around the surface's normal, \
                           towards the surface\nruns: pixels in a row that are all visible or all not, at alpha 0.5, across the \
                           direction of view and along it";

/// The table for a terminal.
#[must_use]
pub fn table(all: &[(Measured, Moved)]) -> String {
    let mut text = String::new();
    for (Measured { name, grain, zoom }, Moved { pops, runs }) in all {
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
        text += "  a small motion    mean    worst  of a surface's points appear or vanish\n";
        for Pops { motion, mean, worst, at } in pops {
            let (motion, tilt) = (motion.name(), at.tilt.to_degrees());
            let _ = writeln!(text, "  {motion:<16}  {mean:.4}  {worst:.4} (at a tilt of {tilt:.0} degrees)");
        }
        text += "  pixel             runs across, along  flips across, along\n";
        for Runs { stretch, lengths: [across, along], flips: [flips_across, flips_along] } in runs {
            let pixel = format!("{stretch} times as long");
            let _ = writeln!(
                text,
                "  {pixel:<16}  {across:5.2}  {along:5.2}        {flips_across:.4}  {flips_along:.4}"
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

/// What a small motion changes as JSON.
#[derive(Serialize)]
struct PopLine<'a> {
    subject: &'a str,
    motion: &'a str,
    mean: f64,
    worst: f64,
}

/// Runs at one angle as JSON, across the direction of view and along it.
#[derive(Serialize)]
struct RunLine<'a> {
    subject: &'a str,
    stretch: f64,
    runs: [f64; 2],
    flips: [f64; 2],
}

/// One JSON object a row; the rows of an octave of zoom have no grain. Rows with the key `motion` are what a small motion changes, those with
/// `stretch` runs and flips across the direction of view and along it.
///
/// # Errors
///
/// None that can happen: what is written are numbers and names.
pub fn json_lines(all: &[(Measured, Moved)]) -> serde_json::Result<String> {
    let mut text = String::new();
    for (Measured { name: subject, grain, zoom }, Moved { pops, runs }) in all {
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
        for &Pops { motion, mean, worst, .. } in pops {
            text += &serde_json::to_string(&PopLine { subject, motion: motion.name(), mean, worst })?;
            text.push('\n');
        }
        for &Runs { stretch, lengths, flips } in runs {
            text += &serde_json::to_string(&RunLine { subject, stretch, runs: lengths, flips })?;
            text.push('\n');
        }
    }
    Ok(text)
}
