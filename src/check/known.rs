//! What is known: claims that are known to be rejected, whose they are, and why.
//!
//! What is known of the paper's own listings is [`OF_THE_LISTINGS`], the one truth for the trials of the paper, for
//! [`Suite::Paper`](super::Suite::Paper) and for the pages: a listing that starts passing fails the tests, as a new failure
//! does. A file that somebody keeps of their own threshold is a list of the same kind.

use super::outcome::{Outcome, Standing, Verdict};
use super::subject::Precision;
use crate::threshold::two_scale::Variant;
use core::fmt;
use std::borrow::Cow;

/// A claim that is known to be rejected.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Known {
    /// Identifier of the claim.
    pub check: Cow<'static, str>,
    /// Who fails it.
    pub who: Who,
    /// Why.
    pub reason: Cow<'static, str>,
}

/// Who is known to fail a claim.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Who {
    /// Whatever follows one of the paper's listings in one of these arithmetics.
    Listing {
        /// The listings.
        variants: &'static [Variant],
        /// The arithmetics.
        precisions: &'static [Precision],
    },
    /// One subject.
    Subject {
        /// Its name.
        name: String,
        /// Its arithmetic.
        precision: Precision,
    },
}

/// As in "paper:isotropic in f32" or "the paper's listings (anisotropic) in f32, f64".
impl fmt::Display for Who {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Listing { variants, precisions } => {
                let names = |all: Vec<String>| all.join(", ");
                let variants = names(variants.iter().map(ToString::to_string).collect());
                let precisions =
                    names(precisions.iter().map(|precision| precision.name().to_owned()).collect());
                write!(f, "the paper's listings ({variants}) in {precisions}")
            }
            Self::Subject { name, precision } => write!(f, "{name} in {precision}"),
        }
    }
}

impl Known {
    /// Makes an entry about one subject.
    #[must_use]
    pub fn of_subject(check: String, name: String, precision: Precision, reason: String) -> Self {
        Self { check: check.into(), who: Who::Subject { name, precision }, reason: reason.into() }
    }

    /// Returns whether an outcome is of this claim and subject, whatever its verdict.
    #[must_use]
    pub fn is_about(&self, outcome: &Outcome) -> bool {
        let is_who = match &self.who {
            Who::Listing { variants, precisions } => {
                variants.contains(&outcome.variant) && precisions.contains(&outcome.precision)
            }
            Who::Subject { name, precision } => *name == outcome.subject && *precision == outcome.precision,
        };
        self.check == outcome.check && is_who
    }

    /// Returns whether a run tried the claim on the subject.
    #[must_use]
    pub fn was_tried(&self, outcomes: &[Outcome]) -> bool {
        outcomes.iter().any(|outcome| self.is_about(outcome))
    }

    /// Returns whether a run shows that the entry is out of date: the claim was tried, and the answer is that of a sound
    /// subject.
    #[must_use]
    pub fn is_stale(&self, outcomes: &[Outcome]) -> bool {
        outcomes.iter().any(|outcome| self.is_about(outcome) && outcome.standing() == Standing::AsExpected)
    }
}

/// Enters the reason into every rejection that a list names, in place of another list's.
pub fn mark(outcomes: &mut [Outcome], list: &[Known]) {
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.verdict == Verdict::Rejected) {
        if let Some(known) = list.iter().find(|known| known.is_about(outcome)) {
            outcome.known = Some(known.reason.clone());
        }
    }
}

/// Returns why the paper's own listing, of the variant and in the precision of an outcome, fails its claim; `None` where it
/// does not.
#[must_use]
pub fn listing_fails(outcome: &Outcome) -> Option<&'static str> {
    OF_THE_LISTINGS.iter().find(|known| known.is_about(outcome)).map(|known| known.reason.as_ref())
}

/// A claim that listings are known to fail.
const fn fails(
    check: &'static str,
    variants: &'static [Variant],
    precisions: &'static [Precision],
    reason: &'static str,
) -> Known {
    let who = Who::Listing { variants, precisions };
    Known { check: Cow::Borrowed(check), who, reason: Cow::Borrowed(reason) }
}

const F32: &[Precision] = &[Precision::F32];
const BOTH: &[Precision] = &Precision::ALL;
const LISTING_1: &[Variant] = &[Variant::Isotropic];
const LISTING_2: &[Variant] = &[Variant::Anisotropic];
const LISTINGS: &[Variant] = &[Variant::Isotropic, Variant::Anisotropic];

/// Every claim that Listing 1 or 2 to the letter, with the sine hash, fails.
pub const OF_THE_LISTINGS: &[Known] = &[
    fails(
        "uniform.constant_z",
        LISTING_1,
        F32,
        "hash3D hashes x and y into about 4000 different values before z comes in: every plane of \
                 constant z has a coverage bias of its own",
    ),
    fails(
        "hash.values",
        LISTINGS,
        F32,
        "hash3D in f32 has the variety of some 4000 values: two cells in 4000 have the same threshold",
    ),
    fails(
        "hash.octave_copies",
        LISTINGS,
        BOTH,
        "the paper's hash does not read the octave: cells of the same index have one threshold in all octaves",
    ),
    fails(
        "hash.octave_avalanche",
        LISTINGS,
        BOTH,
        "the paper's hash does not read the octave: no bit of it turns over any bit of the threshold",
    ),
    fails(
        "hash.lags",
        LISTINGS,
        F32,
        "hash3D repeats: 3550 cells along z are 113 half turns of its outer sine and 14 690 of its inner one, and in f32 \
                 cells there add up to 1 more often than they should",
    ),
    fails(
        "range",
        LISTING_2,
        BOTH,
        "Listing 2 divides by zero where neither derivative moves along an axis: NaN on axis-aligned \
         planes",
    ),
    fails(
        "uniform.constant_z",
        LISTING_2,
        BOTH,
        "Listing 2 has no threshold on a plane of constant z: dz is 0 and the weight NaN",
    ),
    fails(
        "uniform.constant_x",
        LISTING_2,
        BOTH,
        "Listing 2 has no threshold on a plane of constant x: dx is 0 and the weight NaN",
    ),
    fails(
        "uniform.constant_y",
        LISTING_2,
        BOTH,
        "Listing 2 has no threshold on a plane of constant y: dy is 0 and the weight NaN",
    ),
    fails(
        "coverage.mean_aligned",
        LISTING_2,
        BOTH,
        "Listing 2 divides by zero where neither derivative moves along an axis: NaN on axis-aligned \
         planes",
    ),
    fails(
        "range.degenerate",
        LISTING_1,
        BOTH,
        "Listing 1 divides by a derivative of zero, and the square of a small or large one is \
                 zero or infinite: NaN, which keeps a fragment of alpha 0",
    ),
    fails(
        "range.degenerate",
        LISTING_2,
        BOTH,
        "Listing 2 divides by zero as soon as one axis has no derivative: NaN, which keeps a \
                 fragment of alpha 0",
    ),
    fails(
        "range.far_from_origin",
        LISTING_1,
        BOTH,
        "Listing 1 divides by zero where neighbouring pixels have the same f32 position: in 90 % \
                 of the quads at 0.05 units in the last place, in a quarter at a half",
    ),
    fails(
        "range.far_from_origin",
        LISTING_2,
        BOTH,
        "Listing 2 divides by zero where neighbouring pixels have the same coordinate along one \
                 axis, as on every wall of constant z",
    ),
    fails(
        "layers.parallel",
        LISTING_1,
        F32,
        "hash3D hashes x and y into about 4000 different values before z comes in: layers of \
                 constant z depend on each other",
    ),
    fails(
        "layers.parallel",
        LISTING_2,
        BOTH,
        "Listing 2 has no threshold on a plane of constant z: dz is 0 and the weight NaN",
    ),
    fails(
        "planes.axis_aligned",
        LISTING_2,
        BOTH,
        "Listing 2 divides by zero where a coordinate is constant, and by the rounding of the \
                 rasteriser where it is not quite: NaN, or cells of one unit in the last place that are \
                 redrawn in every frame",
    ),
    fails(
        "planes.dyadic",
        LISTING_1,
        BOTH,
        "0.5, 1, 2 and 3 lie on faces of cells in every octave of interest: the rounding of the \
                 rasteriser decides on which side, anew in every frame",
    ),
    fails(
        "planes.dyadic",
        LISTING_2,
        BOTH,
        "Listing 2 on an axis-aligned plane, and its cells have faces at 0.5, 1, 2 and 3 too",
    ),
    fails(
        "continuity.zoom",
        LISTING_2,
        BOTH,
        "when one axis passes an octave, Listing 2 exchanges both of its cells: three pops an \
                 octave, a third in the mean",
    ),
    fails(
        "continuity.rotation",
        LISTING_2,
        BOTH,
        "when one axis passes an octave, Listing 2 exchanges both of its cells, and turning an \
                 object lets its axes pass at different times",
    ),
    fails(
        "continuity.tilt",
        LISTING_2,
        BOTH,
        "when one axis passes an octave, Listing 2 exchanges both of its cells, and a tilt to 85 \
                 degrees takes each axis through three",
    ),
    fails(
        "continuity.octave_boundary",
        LISTING_2,
        BOTH,
        "at a power of two the floor of Listing 2 moves to another cell, one rounding later the \
                 ceiling does, while the weight is inside (0, 1): two pops",
    ),
    fails(
        "cells.origin",
        LISTINGS,
        BOTH,
        "the eight cells around the origin are the same in every octave, so each octant has one \
                 threshold for ever; that of positive coordinates is 0 before the clamp",
    ),
    fails(
        "cells.window",
        LISTINGS,
        F32,
        "at 2^23 cells along all axes 0.1 z swallows the last digits of 17 hash(x, y): a layer of \
                 z is left with a few hundred values",
    ),
    fails(
        "atoms.zero",
        LISTINGS,
        F32,
        "hash3D is exactly 0 for one cell in 2300: a product of 10^4 and a sine has too few \
                 digits after the point",
    ),
    fails(
        "stability.translate_aligned",
        LISTING_2,
        BOTH,
        "Listing 2 divides by zero where neither derivative moves along an axis: NaN on axis-aligned \
         planes",
    ),
    fails(
        "independence.octaves",
        LISTINGS,
        BOTH,
        "the paper's hash does not read the octave: an object of half the size has the very same \
                 noise, shrunk with it",
    ),
];

#[cfg(test)]
mod tests {
    use super::super::outcome::tests::outcome;
    use super::*;
    use crate::check::claims;

    #[test]
    fn every_known_failure_is_about_a_claim_and_none_is_told_twice() {
        for known in OF_THE_LISTINGS {
            assert!(claims::ALL.iter().any(|claim| claim.id == known.check), "{}", known.check);
        }
        for claim in claims::ALL {
            for variant in Variant::ALL {
                for precision in Precision::ALL {
                    let of = Outcome { variant, precision, ..outcome(claim.id, Verdict::Rejected) };
                    let told = OF_THE_LISTINGS.iter().filter(|known| known.is_about(&of)).count();
                    assert!(told <= 1, "{} {variant}", claim.id);
                }
            }
        }
    }

    #[test]
    fn what_is_known_is_told_from_what_is_new() {
        let mut outcomes = [
            outcome("a", Verdict::Consistent),
            outcome("b", Verdict::Rejected),
            outcome("c", Verdict::Rejected),
            outcome("d", Verdict::Inconclusive),
        ];
        let known = |check: &'static str| Known {
            check: check.into(),
            who: Who::Subject { name: "s".into(), precision: Precision::F32 },
            reason: "why".into(),
        };
        let list = ["b", "a", "nobody", "d"].map(known);
        mark(&mut outcomes, &list);
        let standings = outcomes.each_ref().map(Outcome::standing);
        assert_eq!(
            standings,
            [Standing::AsExpected, Standing::Known, Standing::Against, Standing::Unanswered]
        );
        assert_eq!(list.each_ref().map(|known| known.is_stale(&outcomes)), [false, true, false, false]);
        assert_eq!(list.each_ref().map(|known| known.was_tried(&outcomes)), [true, true, false, true]);
    }
}
