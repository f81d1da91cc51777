//! The claims: one file a family. A claim is a sentence about a threshold and the trial that could refute it.

pub mod atoms;
pub mod avalanche;
pub mod cells;
pub mod combinations;
pub mod continuity;
pub mod coordinates;
pub mod copies;
pub mod coverage;
pub mod degenerate;
pub mod determinism;
pub mod exact;
pub mod flips;
pub mod frames;
pub mod hash;
pub mod independence;
pub mod lags;
pub mod layers;
pub mod noise_scale;
pub mod planes;
pub mod range;
pub mod single_planes;
pub mod spectrum;
pub mod stability;
pub mod uniform;

use super::claim::Claim;

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
    coordinates::OBJECT,
    determinism::TWO_PASSES,
    determinism::ARGUMENTS,
    determinism::DERIVATIVES,
    frames::STATIC,
    frames::STRATIFIED,
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
];
