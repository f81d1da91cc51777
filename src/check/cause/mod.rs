//! What is wrong with a threshold, found by experiments on it. Not in the paper.
//!
//! A threshold is asked where one octave has all weight; there it shows the hash of one cell, whatever its hash is and in
//! whatever language it is written. From what it shows of the two cells of a place, Listing 1 or 2 says what the threshold
//! there should be. Where it is another one, each step is exchanged for what ports by hand have in its place
//! (`measure`, `join`, `law`), two steps at most, until it comes out. Where cells begin (`cells`) and what the hash
//! reads (`hash`, `reads`) is looked at directly. What none of these explains is left without a cause.

mod cells;
mod hash;
mod join;
mod law;
mod measure;
mod probe;
mod reads;
mod slip;
mod step;
mod two_scale;

pub use slip::{Found, Slip};
pub use step::Step;

use super::Subject;
use crate::stats::seed;
use crate::threshold::robust::Join;
use measure::Measure;
use probe::{ALONE, Probe};

/// What experiments on a threshold have shown.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Examination {
    /// Its slips, in the order of the steps of a threshold; empty where no experiment shows one.
    pub found: Vec<Found>,
    /// Whether its values follow from what it shows of single cells, as Listing 1 or 2 says, without a slip on the way.
    pub follows: bool,
    /// Whether a way is known by which they do, with slips on it or without.
    pub is_explained: bool,
}

/// Finds the slips of a threshold.
///
/// It asks for some 10^5 thresholds, with inputs of their own. Of a bare hash, and of a join that is not the paper's, it says nothing
/// of the join.
///
/// ```
/// use hashed_alpha::check::{Subject, cause, subject::Precision};
/// use hashed_alpha::threshold::{footprint::Footprint, names::listing_1_f64, two_scale::Variant};
///
/// // A port that takes the derivative along x twice.
/// let mine = Subject::new("mine", Precision::F64, Variant::Isotropic, |at| {
///     listing_1_f64(&Footprint { dpdy: at.dpdx, ..*at }, 1.0)
/// });
/// assert_eq!(cause::examine(&mine).found[0].slip.name, "dfdx-twice");
/// ```
#[must_use]
pub fn examine(subject: &Subject<'_>) -> Examination {
    examined(subject, None)
}

/// The same, where of all wrong ways only those with slips of these names are tried: much faster, and as good for a threshold that
/// has no others, as one that is being mended. Of what has another way nothing is told.
#[must_use]
pub fn examine_among(subject: &Subject<'_>, slips: &[&str]) -> Examination {
    examined(subject, Some(slips))
}

fn examined(subject: &Subject<'_>, among: Option<&[&str]>) -> Examination {
    /// A size of the noise that is no power of two, so that every way of reading it shows.
    const HASH_SCALE: f64 = 0.4;
    let rescaled = subject.at_hash_scale(HASH_SCALE);
    let subject = rescaled.as_ref().unwrap_or(subject);
    let rng = &mut seed::rng("cause", 0);
    let mut all = Vec::new();
    let reading = reads::look(subject, rng);
    all.extend(reading.found);
    if !reading.follows_position {
        return Examination { found: all, ..Examination::default() };
    }
    let steps = two_scale::steps(subject, rng);
    if let Some(steps) = &steps
        && steps.are_halves
    {
        // Coordinates of three digits make anything of cells and hashes.
        all.push(steps.found.clone());
        return Examination { found: all, ..Examination::default() };
    }
    let places = two_scale::some_places(subject, rng);
    let measured = two_scale::measured(subject, &places, among);
    let size = measured
        .as_ref()
        .map_or_else(|| Measure::sound(subject.variant, subject.hash_scale), |measured| measured.measure);
    let is_interpolated = subject.join == Join::Interpolate && !subject.bare_hash;
    let explained = if is_interpolated {
        two_scale::explain(subject, size, &places, steps.as_ref(), among, rng)
    } else {
        None
    };
    // Of what is to be mended, nothing more is asked once it has another way.
    if among.is_some() && is_interpolated && explained.is_none() {
        return Examination { found: all, ..Examination::default() };
    }
    let measure = explained.as_ref().map_or(size, |explained| explained.measure);
    let mut probe = Probe { subject, measure, finer: 0, lean: ALONE };
    // Where one cell alone has nothing to say, both are looked at.
    if probe.is_mute(rng) {
        probe.lean = 0.5;
    }
    all.extend(measured.into_iter().flat_map(|measured| measured.found(subject)));
    let inverse = cells::inverse(&probe, rng);
    if inverse.is_some() {
        probe.measure = measure.inverse();
    }
    let faces = cells::look(&probe, subject.nested_phase, rng);
    match (&explained, inverse) {
        (_, Some(inverse)) => all.push(inverse),
        (Some(explained), None) => all.extend(explained.of_scale(&faces)),
        (None, None) => {}
    }
    all.extend(faces.found.clone());
    // Without cells the hash of one says nothing.
    if !faces.none {
        probe.finer = faces.finer;
        let is_bent = explained.as_ref().is_some_and(two_scale::Explained::has_bent_hash);
        let of_hash = hash::look(&probe, is_bent, steps.is_some(), rng);
        // A mirror at the origin makes one cell of two there, too.
        if of_hash.iter().any(|found| found.slip == hash::MIRRORED) {
            all.retain(|found| found.slip != cells::TRUNCATION);
        }
        all.extend(of_hash);
    }
    let is_explained = explained.is_some();
    match explained {
        Some(explained) => all.extend(explained.of_join(&probe, &faces)),
        None if is_interpolated => all.extend(two_scale::by_law(&probe, rng)),
        None => {}
    }
    all.extend(steps.map(|steps| steps.found));
    if all.is_empty() && !is_explained {
        all.extend(cells::uncut(&probe, rng));
    }
    let follows = all.is_empty() && is_explained;
    Examination { found: all, follows, is_explained }
}
