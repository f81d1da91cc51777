//! The claims: one file a family. A claim is a sentence about a threshold and the trial that could refute it.

pub mod atoms;
pub mod avalanche;
pub mod cells;
pub mod cluster;
pub mod combinations;
pub mod continuity;
pub mod coordinates;
pub mod copies;
pub mod coverage;
pub mod degenerate;
pub mod determinism;
pub mod domain;
pub mod exact;
pub mod flips;
pub mod frames;
pub mod hash;
pub mod independence;
pub mod lags;
pub mod layers;
pub mod nested;
pub mod noise_scale;
pub mod planes;
pub mod range;
pub mod single_planes;
pub mod spectrum;
pub mod stability;
pub mod uniform;

use super::Subject;
use super::claim::Claim;
use crate::threshold::robust::Join;

/// Families of claims, and single claims, that are about more than the values of cells: about what a threshold makes of two
/// octaves, or about what changes while one looks.
const BEYOND_A_HASH: &[&str] = &[
    "range",
    "exact",
    "uniform.by_lerp_factor",
    "uniform.without_cdf",
    "coverage",
    "stability",
    "noise_scale",
    "spectrum",
    "nested",
    "flips",
    "coordinates",
    "domain",
    "determinism",
    "symmetry.derivatives",
    "frames",
    "planes",
    "continuity",
];

/// Returns whether a claim of this identifier says nothing about a bare hash ([`Subject::of_hash`](super::Subject::of_hash)).
#[must_use]
pub fn is_beyond_a_hash(id: &str) -> bool {
    let is_of = |family: &&str| {
        id.strip_prefix(*family).is_some_and(|rest| matches!(rest.as_bytes(), [] | [b'.', ..]))
    };
    BEYOND_A_HASH.iter().any(is_of)
}

/// Claims on cells of two octaves that know nothing of each other: some keep what their parent has, where a join is nested.
const ACROSS_OCTAVES: &[&str] = &["hash.children", "hash.octave_copies"];

/// Claims on cells of one octave that know nothing of each other: those of one parent do, where they share [0, 1].
const AMONG_CELLS: &[&str] = &[
    "independence.neighbours",
    "independence.diagonals",
    "independence.across_zero",
    "independence.octaves",
    "hash.differences",
    "hash.lags",
    "hash.copies",
    "hash.triples",
    "hash.squares",
    "hash.avalanche",
    "domain.neighbours",
];

/// Returns why a claim of this identifier says nothing about a subject whose join is nested: it is about cells that are independent.
#[must_use]
pub fn not_of_kin(subject: &Subject<'_>, id: &str) -> Option<&'static str> {
    if subject.join == Join::Inherit && ACROSS_OCTAVES.contains(&id) {
        Some("some cells keep the threshold of the cell that they came from; the claims flips.* ask how many")
    } else if subject.has_kin() && AMONG_CELLS.contains(&id) {
        Some(
            "children of one cell share [0, 1] among them, so that neighbours know of each other; nested.children, nested.kept \
             and nested.order ask how",
        )
    } else {
        None
    }
}

/// Every claim, in the order of the report.
pub const ALL: &[Claim] = &[
    range::RANGE,
    degenerate::DEGENERATE,
    degenerate::FAR_FROM_ORIGIN,
    exact::CELLS,
    exact::CDF,
    uniform::MARGINAL,
    uniform::COVERAGE,
    uniform::BY_LERP_FACTOR,
    uniform::WITHOUT_CDF,
    single_planes::CONSTANT_X,
    single_planes::CONSTANT_Y,
    single_planes::CONSTANT_Z,
    single_planes::ANY_DIRECTION,
    coverage::MEAN,
    coverage::MEAN_ALIGNED,
    coverage::VARIANCE,
    independence::NEIGHBOURS,
    independence::DIAGONALS,
    independence::ACROSS_ZERO,
    independence::OCTAVES,
    hash::CHILDREN,
    hash::DIFFERENCES,
    hash::VALUES,
    hash::RESONANCE,
    lags::LAGS,
    copies::COPIES,
    copies::OCTAVE_COPIES,
    combinations::TRIPLES,
    combinations::SQUARES,
    avalanche::INDEX,
    avalanche::OCTAVE,
    layers::PARALLEL,
    layers::QUARTER,
    stability::TRANSLATE,
    stability::TRANSLATE_ALIGNED,
    noise_scale::FRONTAL,
    noise_scale::TILTED,
    spectrum::AUTOCORRELATION,
    spectrum::ORDINATES,
    spectrum::RADIAL,
    spectrum::ANISOTROPY,
    flips::TRANSLATION,
    flips::ZOOM,
    flips::ROTATION,
    flips::TILT,
    flips::SKINNING,
    cluster::CLUSTER,
    nested::CHILDREN,
    nested::KEPT,
    nested::ORDER,
    coordinates::OBJECT,
    determinism::TWO_PASSES,
    determinism::ARGUMENTS,
    determinism::DERIVATIVES,
    frames::STATIC,
    frames::STRATIFIED,
    frames::SEQUENCE,
    frames::SERIAL,
    frames::AVERAGE,
    planes::AXIS_ALIGNED,
    planes::DYADIC,
    continuity::ZOOM,
    continuity::ROTATION,
    continuity::TILT,
    continuity::OCTAVE_BOUNDARY,
    cells::ORIGIN,
    cells::WINDOW,
    cells::MIRROR,
    copies::SYMMETRY,
    atoms::ZERO,
    atoms::ENDS,
    domain::UNIFORM,
    domain::NEIGHBOURS,
    domain::LAYERS,
    domain::CHANGES,
    domain::CONTINUITY,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn claims_on_strangers_exist() {
        assert!(ACROSS_OCTAVES.iter().chain(AMONG_CELLS).all(|id| ALL.iter().any(|claim| claim.id == *id)));
    }

    #[test]
    fn every_family_is_about_cells_or_about_more() {
        const ABOUT_CELLS: [&str; 7] =
            ["uniform", "independence", "hash", "layers", "symmetry", "cells", "atoms"];
        for claim in ALL {
            let family = claim.id.split('.').next().unwrap_or_default();
            let is_about_cells = ABOUT_CELLS.contains(&family);
            let is_single = BEYOND_A_HASH.contains(&claim.id);
            assert_eq!(is_beyond_a_hash(claim.id), !is_about_cells || is_single, "{}: say which", claim.id);
        }
        for entry in BEYOND_A_HASH {
            assert!(ALL.iter().any(|claim| claim.id.starts_with(entry)), "{entry}");
        }
    }
}
