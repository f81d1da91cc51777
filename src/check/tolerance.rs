//! Every level, budget and constant of the verdict, with its reason.

/// Probability that a run rejects any true claim at all (Holm). A run a minute would raise one false alarm in two
/// years.
pub const FAMILY_LEVEL: f64 = 1.0e-6;

/// Level at which `detectable` is stated: Holm's first step in a run of a hundred claims.
pub const SINGLE_LEVEL: f64 = 1.0e-8;

/// Power at which `detectable` is stated: one defect in a thousand of that size goes unseen.
pub const POWER: f64 = 0.999;

/// Bins over [0, 1]: a power of two not above 2^10, so that every bin holds whole steps of the coarsest grid on which
/// the `f32` sine hash lies.
pub const BINS: usize = 64;

/// Bins along each side of a table of pairs: enough to see structure, few enough to fill each square 100 times.
pub const PAIR_BINS: usize = 16;

/// Groups of lerp factors, eight on each side of 1/2: some defects live on one side only.
pub const LERP_GROUPS: usize = 16;

/// Fewest samples of a group that is tested: ten expected in every bin.
pub const LEAST_GROUP: usize = 10 * BINS;

/// Samples of a claim about a marginal law: sees an excess chi-square of 7e-4 a sample, a tenth of the loss from
/// leaving out Eq. 2 at a lerp factor of 0.01.
pub const MARGINAL_SAMPLES: usize = 1 << 18;

/// Draws between two draws of the object's place: many layers of cells enter a marginal law, as in a real scene.
pub const DRAWS_A_PLACE: usize = 1 << 13;

/// Planes of a claim about single planes.
pub const PLANES: usize = 8;

/// Samples on each plane: eight times what shows the bias of the `f32` sine hash.
pub const PLANE_SAMPLES: usize = 1 << 15;

/// Pairs of neighbours along each axis: 256 expected in every square.
pub const NEIGHBOUR_PAIRS: usize = 1 << 16;

/// Samples at each shift, screen axis and scene: tells a change of 0.01 in any share at the single level and power.
pub const SHIFT_SAMPLES: usize = 1 << 16;

/// Shifts in pixels at which stability is tried; all sub-pixel, two of them below the fine cell at every lerp factor.
pub const SHIFTS: [f64; 4] = [0.05, 0.125, 0.25, 0.5];

/// Pixels of the image over which the range is tried.
pub const RANGE_RESOLUTION: [u32; 2] = [256, 192];

/// The object is placed at random within this distance of its own origin along every axis, in object units. Larger
/// than any built-in surface's cell, small enough that an `f32` position keeps a thousandth of a cell.
pub const PLACEMENT: f64 = 8.0;

/// Draws per wanted sample after which a scene counts as too small for the wanted number of distinct cells.
pub const DRAWS_A_SAMPLE: usize = 8;
