//! What is known to be wrong with the paper's own listings.
//!
//! One truth for the trials of the paper, for [`Suite::Paper`](super::Suite::Paper) and for the pages: a listing that
//! stops failing here is as loud as one that begins to.

use super::subject::Precision;
use crate::threshold::two_scale::Variant;

/// A claim that a listing is known to fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Identifier of the claim.
    pub check: &'static str,
    /// The listings that fail it.
    pub variants: &'static [Variant],
    /// The arithmetic in which they fail it.
    pub precisions: &'static [Precision],
    /// Why they do.
    pub reason: &'static str,
}

const F32: &[Precision] = &[Precision::F32];
const BOTH: &[Precision] = &Precision::ALL;
const LISTING_1: &[Variant] = &[Variant::Isotropic];
const LISTING_2: &[Variant] = &[Variant::Anisotropic];
const LISTINGS: &[Variant] = &[Variant::Isotropic, Variant::Anisotropic];

/// Every claim that Listing 1 or 2 to the letter, with the sine hash, fails.
pub const OF_THE_LISTINGS: &[Finding] = &[
    Finding {
        check: "uniform.constant_z",
        variants: LISTING_1,
        precisions: F32,
        reason: "hash3D hashes x and y into about 4000 different values before z comes in: every plane of \
                 constant z has a coverage bias of its own",
    },
    Finding {
        check: "hash.values",
        variants: LISTINGS,
        precisions: F32,
        reason: "hash3D in f32 has the variety of some 4000 values: two cells in 4000 have the same threshold",
    },
    Finding {
        check: "range",
        variants: LISTING_2,
        precisions: BOTH,
        reason: "Listing 2 divides by zero where neither derivative moves along an axis: NaN on axis- \
                 aligned planes",
    },
    Finding {
        check: "uniform.constant_z",
        variants: LISTING_2,
        precisions: BOTH,
        reason: "Listing 2 has no threshold on a plane of constant z: dz is 0 and the weight NaN",
    },
    Finding {
        check: "uniform.constant_x",
        variants: LISTING_2,
        precisions: BOTH,
        reason: "Listing 2 has no threshold on a plane of constant x: dx is 0 and the weight NaN",
    },
    Finding {
        check: "uniform.constant_y",
        variants: LISTING_2,
        precisions: BOTH,
        reason: "Listing 2 has no threshold on a plane of constant y: dy is 0 and the weight NaN",
    },
    Finding {
        check: "coverage.mean_aligned",
        variants: LISTING_2,
        precisions: BOTH,
        reason: "Listing 2 divides by zero where neither derivative moves along an axis: NaN on axis- \
                 aligned planes",
    },
    Finding {
        check: "range.degenerate",
        variants: LISTING_1,
        precisions: BOTH,
        reason: "Listing 1 divides by a derivative of zero, and the square of a small or large one is \
                 zero or infinite: NaN, which keeps a fragment of alpha 0",
    },
    Finding {
        check: "range.degenerate",
        variants: LISTING_2,
        precisions: BOTH,
        reason: "Listing 2 divides by zero as soon as one axis has no derivative: NaN, which keeps a \
                 fragment of alpha 0",
    },
    Finding {
        check: "range.far_from_origin",
        variants: LISTING_1,
        precisions: BOTH,
        reason: "Listing 1 divides by zero where neighbouring pixels have the same f32 position: in 90 % \
                 of the quads at 0.05 units in the last place, in a quarter at a half",
    },
    Finding {
        check: "range.far_from_origin",
        variants: LISTING_2,
        precisions: BOTH,
        reason: "Listing 2 divides by zero where neighbouring pixels have the same coordinate along one \
                 axis, as on every wall of constant z",
    },
    Finding {
        check: "layers.parallel",
        variants: LISTING_1,
        precisions: F32,
        reason: "hash3D hashes x and y into about 4000 different values before z comes in: layers of \
                 constant z depend on each other",
    },
    Finding {
        check: "layers.parallel",
        variants: LISTING_2,
        precisions: BOTH,
        reason: "Listing 2 has no threshold on a plane of constant z: dz is 0 and the weight NaN",
    },
    Finding {
        check: "planes.axis_aligned",
        variants: LISTING_2,
        precisions: BOTH,
        reason: "Listing 2 divides by zero where a coordinate is constant, and by the rounding of the \
                 rasteriser where it is not quite: NaN, or cells of one unit in the last place that are \
                 redrawn in every frame",
    },
    Finding {
        check: "planes.dyadic",
        variants: LISTING_1,
        precisions: BOTH,
        reason: "0.5, 1, 2 and 3 lie on faces of cells in every octave of interest: the rounding of the \
                 rasteriser decides on which side, anew in every frame",
    },
    Finding {
        check: "planes.dyadic",
        variants: LISTING_2,
        precisions: BOTH,
        reason: "Listing 2 on an axis-aligned plane, and its cells have faces at 0.5, 1, 2 and 3 too",
    },
    Finding {
        check: "continuity.zoom",
        variants: LISTING_2,
        precisions: BOTH,
        reason: "when one axis passes an octave, Listing 2 exchanges both of its cells: three pops an \
                 octave, a third in the mean",
    },
    Finding {
        check: "continuity.rotation",
        variants: LISTING_2,
        precisions: BOTH,
        reason: "when one axis passes an octave, Listing 2 exchanges both of its cells, and turning an \
                 object lets its axes pass at different times",
    },
    Finding {
        check: "continuity.tilt",
        variants: LISTING_2,
        precisions: BOTH,
        reason: "when one axis passes an octave, Listing 2 exchanges both of its cells, and a tilt to 85 \
                 degrees takes each axis through three",
    },
    Finding {
        check: "continuity.octave_boundary",
        variants: LISTING_2,
        precisions: BOTH,
        reason: "at a power of two the floor of Listing 2 moves to another cell, one rounding later the \
                 ceiling does, while the weight is inside (0, 1): two pops",
    },
    Finding {
        check: "cells.origin",
        variants: LISTINGS,
        precisions: BOTH,
        reason: "the eight cells around the origin are the same in every octave, so each octant has one \
                 threshold for ever; that of positive coordinates is 0 before the clamp",
    },
    Finding {
        check: "cells.window",
        variants: LISTINGS,
        precisions: F32,
        reason: "at 2^23 cells along all axes 0.1 z swallows the last digits of 17 hash(x, y): a layer of \
                 z is left with a few hundred values",
    },
    Finding {
        check: "atoms.zero",
        variants: LISTINGS,
        precisions: F32,
        reason: "hash3D is exactly 0 for one cell in 2300: a product of 10^4 and a sine has too few \
                 digits after the point",
    },
    Finding {
        check: "stability.translate_aligned",
        variants: LISTING_2,
        precisions: BOTH,
        reason: "Listing 2 divides by zero where neither derivative moves along an axis: NaN on axis- \
                 aligned planes",
    },
    Finding {
        check: "independence.octaves",
        variants: LISTINGS,
        precisions: BOTH,
        reason: "the paper's hash does not read the octave: an object of half the size has the very same \
                 noise, shrunk with it",
    },
];

/// Returns why the paper's listing of a variant, computed in a precision, fails a claim; `None` where it does not.
#[must_use]
pub fn of_listing(check: &str, variant: Variant, precision: Precision) -> Option<&'static str> {
    let is_about = |finding: &&Finding| {
        finding.check == check
            && finding.variants.contains(&variant)
            && finding.precisions.contains(&precision)
    };
    OF_THE_LISTINGS.iter().find(is_about).map(|finding| finding.reason)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::claims;

    #[test]
    fn every_finding_is_about_a_claim_and_none_is_told_twice() {
        for finding in OF_THE_LISTINGS {
            assert!(claims::ALL.iter().any(|claim| claim.id == finding.check), "{}", finding.check);
        }
        for claim in claims::ALL {
            for variant in Variant::ALL {
                for precision in Precision::ALL {
                    let about = |f: &&Finding| {
                        f.check == claim.id
                            && f.variants.contains(&variant)
                            && f.precisions.contains(&precision)
                    };
                    assert!(OF_THE_LISTINGS.iter().filter(about).count() <= 1, "{} {variant}", claim.id);
                }
            }
        }
    }
}
