//! What is known: claims that are known to be rejected, whose they are, and why.
//!
//! What is known of the paper's own listings is [`OF_THE_LISTINGS`], the one truth for the trials of the paper, for
//! [`Suite::Paper`](super::Suite::Paper) and for the pages: a listing that starts passing fails the tests, as a new failure
//! does. A file that somebody keeps of their own threshold is a list of the same kind.
//!
//! Another subject is excused by the listings only where it fails in the same way: by as much, and for a reason that is true of
//! it, too ([`RestsOn`]). How much that is was measured and is committed as `known_sizes.txt`. A new entry is one line of the
//! list; `HASHED_ALPHA_BLESS=all cargo test --test paper` measures its size.

use super::Budget;
use super::outcome::{LikeTheListing, Outcome, Standing, Verdict};
use super::rests_on::RestsOn;
use super::sizes::{EXCESS, EXCESS_OF_A_SINE, Size, number};
use super::subject::{Precision, Subject};
use crate::threshold::two_scale::Variant;
use core::fmt;
use std::borrow::Cow;

/// A claim that is known to be rejected.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Known {
    /// Identifier of the claim.
    pub check: Cow<'static, str>,
    /// Who fails it.
    pub who: Who,
    /// Why.
    pub reason: Cow<'static, str>,
    /// What that rests on, where it is tried on the subject; never for a list of somebody's own.
    pub rests_on: Option<RestsOn>,
    /// The size of the effect, in a list of somebody's own: a fifth more is news. `None` where any size is accepted; those of the
    /// listings are measured ([`Size`]).
    pub size: Option<f64>,
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
        Self {
            check: check.into(),
            who: Who::Subject { name, precision },
            reason: reason.into(),
            rests_on: None,
            size: None,
        }
    }

    /// The same for effects up to a fifth above a size.
    #[must_use]
    pub fn with_size(self, size: Option<f64>) -> Self {
        Self { size, ..self }
    }

    /// Returns what a rejection that the entry is about owes to it: the reason with the sizes, or why it is another failure.
    fn excuse(&self, outcome: &Outcome) -> Result<String, String> {
        match (&self.who, self.size, outcome.effect) {
            (Who::Listing { .. }, ..) => match &outcome.listing {
                Some(LikeTheListing { is_like: true, words }) => Ok(format!("{}; {words}", self.reason)),
                Some(LikeTheListing { is_like: false, words }) => Err(words.clone()),
                None => Err("it was not compared with the paper's listing".to_owned()),
            },
            (Who::Subject { .. }, None, _) => Ok(self.reason.to_string()),
            (Who::Subject { .. }, Some(size), Some(effect)) if effect <= EXCESS * size => {
                Ok(format!("{}; known: {}, here {}", self.reason, number(size), number(effect)))
            }
            (Who::Subject { .. }, Some(size), effect) => {
                let here = effect.map_or_else(|| "without a size".to_owned(), number);
                Err(format!("known is {}, and it is {here}", number(size)))
            }
        }
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

/// Compares the rejections of one subject with those of the paper's listings that are known.
pub(crate) fn compare_with_the_listing(subject: &Subject<'_>, outcomes: &mut [Outcome], budget: Budget) {
    let mut tried: Vec<(RestsOn, bool)> = Vec::new();
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.verdict == Verdict::Rejected) {
        let Some(known) = OF_THE_LISTINGS.iter().find(|known| known.is_about(outcome)) else { continue };
        let is_true = known.rests_on.is_none_or(|reason| {
            let before = tried.iter().find(|(of, _)| *of == reason).map(|(_, holds)| *holds);
            before.unwrap_or_else(|| {
                let holds = reason.is_true_of(subject);
                tried.push((reason, holds));
                holds
            })
        });
        let excess = if known.rests_on == Some(RestsOn::SineFarAway) { EXCESS_OF_A_SINE } else { EXCESS };
        let found = match known.rests_on.filter(|_| !is_true) {
            Some(reason) => Err(format!("the listing fails by {}, which is not true of it", reason.name())),
            None => {
                let found = Size::of(outcome, budget).into_iter().map(|size| size.compare(outcome, excess));
                let without = Err("no size is known of the listing's failure".to_owned());
                found
                    .reduce(|first, other| first.or_else(|words| other.map_err(|_| words)))
                    .unwrap_or(without)
            }
        };
        let (is_like, words) = (found.is_ok(), found.unwrap_or_else(|words| words));
        outcome.listing = Some(LikeTheListing { is_like, words });
    }
}

/// Enters the reason into every rejection that a list names and excuses, in place of another list's; where it does not excuse
/// it, says in what was seen why.
pub fn mark(outcomes: &mut [Outcome], list: &[Known]) {
    for outcome in outcomes.iter_mut().filter(|outcome| outcome.verdict == Verdict::Rejected) {
        match list.iter().find(|known| known.is_about(outcome)).map(|known| known.excuse(outcome)) {
            Some(Ok(reason)) => outcome.known = Some(reason.into()),
            Some(Err(difference)) => {
                let seen = outcome.seen.take().unwrap_or_default();
                outcome.seen = Some(format!("{seen}; not excused as known: {difference}"));
            }
            None => {}
        }
    }
}

/// Claims about the whole domain. Both listings fail them beyond [`Reach::Listings`](super::Reach::Listings), where
/// [`Suite::Paper`](super::Suite::Paper) does not ask them, so that none excuses anything.
const BEYOND_REACH: [&str; 5] =
    ["domain.uniform", "domain.neighbours", "domain.layers", "domain.changes", "domain.continuity"];

/// Returns why the paper's own listing, of the variant and in the precision of an outcome, fails its claim; `None` where it
/// does not.
#[must_use]
pub fn listing_fails(outcome: &Outcome) -> Option<&'static str> {
    let known =
        OF_THE_LISTINGS.iter().find(|known| known.is_about(outcome)).map(|known| known.reason.as_ref());
    let is_beyond = || LISTINGS.contains(&outcome.variant) && BEYOND_REACH.contains(&outcome.check);
    known.or_else(|| {
        is_beyond().then_some(
            "the listings divide by derivatives of zero, and their sines end at 2^19 cells from the origin",
        )
    })
}

/// A claim that listings are known to fail.
const fn fails(
    check: &'static str,
    variants: &'static [Variant],
    precisions: &'static [Precision],
    rests_on: RestsOn,
    reason: &'static str,
) -> Known {
    let who = Who::Listing { variants, precisions };
    Known {
        check: Cow::Borrowed(check),
        who,
        reason: Cow::Borrowed(reason),
        rests_on: Some(rests_on),
        size: None,
    }
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
        RestsOn::SineHash,
        "hash3D hashes x and y into about 4000 different values before z comes in: every plane of \
                 constant z has a coverage bias of its own",
    ),
    fails(
        "hash.values",
        LISTINGS,
        F32,
        RestsOn::SineHash,
        "hash3D in f32 has the variety of some 4000 values: two cells in 4000 have the same threshold",
    ),
    fails(
        "hash.octave_copies",
        LISTINGS,
        BOTH,
        RestsOn::NoOctaveInHash,
        "the paper's hash does not read the octave: cells of the same index have one threshold in all octaves",
    ),
    fails(
        "hash.octave_avalanche",
        LISTINGS,
        BOTH,
        RestsOn::NoOctaveInHash,
        "the paper's hash does not read the octave: no bit of it turns over any bit of the threshold",
    ),
    fails(
        "hash.lags",
        LISTINGS,
        F32,
        RestsOn::SineHash,
        "hash3D repeats: 3550 cells along z are 113 half turns of its outer sine and 14 690 of its inner one, and in f32 \
                 cells there add up to 1 more often than they should",
    ),
    fails(
        "range",
        LISTING_2,
        BOTH,
        RestsOn::DivisionByZero,
        "Listing 2 divides by zero where neither derivative moves along an axis: NaN on axis-aligned \
         planes",
    ),
    fails(
        "uniform.constant_z",
        LISTING_2,
        BOTH,
        RestsOn::DivisionByZero,
        "Listing 2 has no threshold on a plane of constant z: dz is 0 and the weight NaN",
    ),
    fails(
        "uniform.constant_x",
        LISTING_2,
        BOTH,
        RestsOn::DivisionByZero,
        "Listing 2 has no threshold on a plane of constant x: dx is 0 and the weight NaN",
    ),
    fails(
        "uniform.constant_y",
        LISTING_2,
        BOTH,
        RestsOn::DivisionByZero,
        "Listing 2 has no threshold on a plane of constant y: dy is 0 and the weight NaN",
    ),
    fails(
        "coverage.mean_aligned",
        LISTING_2,
        BOTH,
        RestsOn::DivisionByZero,
        "Listing 2 divides by zero where neither derivative moves along an axis: NaN on axis-aligned \
         planes",
    ),
    fails(
        "range.degenerate",
        LISTING_1,
        BOTH,
        RestsOn::DivisionByZero,
        "Listing 1 divides by a derivative of zero, and the square of a small or large one is \
                 zero or infinite: NaN, which keeps a fragment of alpha 0",
    ),
    fails(
        "range.degenerate",
        LISTING_2,
        BOTH,
        RestsOn::DivisionByZero,
        "Listing 2 divides by zero as soon as one axis has no derivative: NaN, which keeps a \
                 fragment of alpha 0",
    ),
    fails(
        "range.far_from_origin",
        LISTING_1,
        BOTH,
        RestsOn::DivisionByZero,
        "Listing 1 divides by zero where neighbouring pixels have the same f32 position: in 90 % \
                 of the quads at 0.05 units in the last place, in a quarter at a half",
    ),
    fails(
        "range.far_from_origin",
        LISTING_2,
        BOTH,
        RestsOn::DivisionByZero,
        "Listing 2 divides by zero where neighbouring pixels have the same coordinate along one \
                 axis, as on every wall of constant z",
    ),
    fails(
        "layers.parallel",
        LISTING_1,
        F32,
        RestsOn::SineHash,
        "hash3D hashes x and y into about 4000 different values before z comes in: layers of \
                 constant z depend on each other",
    ),
    fails(
        "layers.parallel",
        LISTING_2,
        BOTH,
        RestsOn::DivisionByZero,
        "Listing 2 has no threshold on a plane of constant z: dz is 0 and the weight NaN",
    ),
    fails(
        "planes.axis_aligned",
        LISTING_2,
        BOTH,
        RestsOn::DivisionByZero,
        "Listing 2 divides by zero where a coordinate is constant, and by the rounding of the \
                 rasteriser where it is not quite: NaN, or cells of one unit in the last place that are \
                 redrawn in every frame",
    ),
    fails(
        "planes.dyadic",
        LISTING_1,
        BOTH,
        RestsOn::FacesAtWholeNumbers,
        "0.5, 1, 2 and 3 lie on faces of cells in every octave of interest: the rounding of the \
                 rasteriser decides on which side, anew in every frame",
    ),
    fails(
        "planes.dyadic",
        LISTING_2,
        BOTH,
        RestsOn::DivisionByZero,
        "Listing 2 on an axis-aligned plane, and its cells have faces at 0.5, 1, 2 and 3 too",
    ),
    fails(
        "continuity.zoom",
        LISTING_2,
        BOTH,
        RestsOn::OctaveExchange,
        "when one axis passes an octave, Listing 2 exchanges both of its cells: three pops an \
                 octave, a third in the mean",
    ),
    fails(
        "domain.continuity",
        LISTING_2,
        BOTH,
        RestsOn::OctaveExchange,
        "when one axis passes an octave, Listing 2 exchanges both of its cells: two to three pops an \
                 octave at any distance",
    ),
    fails(
        "continuity.rotation",
        LISTING_2,
        BOTH,
        RestsOn::OctaveExchange,
        "when one axis passes an octave, Listing 2 exchanges both of its cells, and turning an \
                 object lets its axes pass at different times",
    ),
    fails(
        "continuity.tilt",
        LISTING_2,
        BOTH,
        RestsOn::OctaveExchange,
        "when one axis passes an octave, Listing 2 exchanges both of its cells, and a tilt to 85 \
                 degrees takes each axis through three",
    ),
    fails(
        "continuity.octave_boundary",
        LISTING_2,
        BOTH,
        RestsOn::OctaveExchange,
        "at a power of two the floor of Listing 2 moves to another cell, one rounding later the \
                 ceiling does, while the weight is inside (0, 1): two pops",
    ),
    fails(
        "cells.origin",
        LISTINGS,
        BOTH,
        RestsOn::OriginCells,
        "the eight cells around the origin are the same in every octave, so each octant has one \
                 threshold for ever; that of positive coordinates is 0 before the clamp",
    ),
    fails(
        "cells.window",
        LISTINGS,
        F32,
        RestsOn::SineFarAway,
        "at 2^23 cells along all axes 0.1 z swallows the last digits of 17 hash(x, y): a layer of \
                 z is left with a few hundred values",
    ),
    fails(
        "atoms.zero",
        LISTINGS,
        F32,
        RestsOn::SineHash,
        "hash3D is exactly 0 for one cell in 2300: a product of 10^4 and a sine has too few \
                 digits after the point",
    ),
    fails(
        "stability.translate_aligned",
        LISTING_2,
        BOTH,
        RestsOn::DivisionByZero,
        "Listing 2 divides by zero where neither derivative moves along an axis: NaN on axis-aligned \
         planes",
    ),
    fails(
        "independence.octaves",
        LISTINGS,
        BOTH,
        RestsOn::NoOctaveInHash,
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
        let known =
            |check: &'static str| Known::of_subject(check.into(), "s".into(), Precision::F32, "why".into());
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

    #[test]
    fn an_effect_beyond_a_known_size_is_news() {
        let known = Known::of_subject("a".into(), "s".into(), Precision::F32, "why".into());
        let list = [known.with_size(Some(0.1))];
        for (effect, standing) in [
            (Some(0.02), Standing::Known),
            (Some(0.119), Standing::Known),
            (Some(0.121), Standing::Against),
            (None, Standing::Against),
        ] {
            let mut outcomes = [Outcome { effect, ..outcome("a", Verdict::Rejected) }];
            mark(&mut outcomes, &list);
            assert_eq!(outcomes[0].standing(), standing, "{effect:?}");
        }
    }

    #[test]
    fn only_what_was_compared_with_the_listing_is_excused_by_it() {
        for (listing, standing) in [
            (None, Standing::Against),
            (Some(LikeTheListing { is_like: false, words: "more".into() }), Standing::Against),
            (Some(LikeTheListing { is_like: true, words: "as much".into() }), Standing::Known),
        ] {
            let rejected = outcome("range.degenerate", Verdict::Rejected);
            let mut outcomes = [Outcome { variant: Variant::Isotropic, listing, ..rejected }];
            mark(&mut outcomes, OF_THE_LISTINGS);
            assert_eq!(outcomes[0].standing(), standing, "{outcomes:?}");
        }
    }
}
