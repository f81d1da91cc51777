//! Levels, budgets and constants that several parts of the verdict share, with their reasons. What one part alone needs
//! stands at the top of its file.

/// Probability that a run rejects any true claim at all (Holm). A run a minute would raise one false alarm in two
/// years.
pub const FAMILY_LEVEL: f64 = 1.0e-6;

/// Level at which `detectable` is stated: Holm's first step in the first round of a run of 500 trials, which has half
/// of [`FAMILY_LEVEL`] to spend.
pub const SINGLE_LEVEL: f64 = 1.0e-9;

/// Specimens that are named for one subject: more are no help.
pub const GUESSES: usize = 3;

/// Power at which `detectable` is stated: one defect in a thousand of that size goes unseen.
pub const POWER: f64 = 0.999;

/// Bins over [0, 1]: a power of two not above 2^10, so that every bin holds whole steps of the coarsest grid on which
/// the `f32` sine hash lies.
pub const BINS: usize = 64;

/// Bins along each side of a table of pairs: enough to see structure, few enough to fill each square 100 times.
pub const PAIR_BINS: usize = 16;

/// Groups of lerp factors, eight on each side of 1/2: some defects live on one side only.
pub const LERP_GROUPS: usize = 16;

/// Fewest samples of a group that is tested: 64 expected in every bin. A smaller group would only weaken the others,
/// since all share one level.
pub const LEAST_GROUP: usize = 64 * BINS;

/// Draws between two draws of the object's place: many layers of cells enter a marginal law, as in a real scene.
pub const DRAWS_A_PLACE: usize = 1 << 13;

/// Pairs of cells in each of the other relations: 64 expected in every square, and room for ten relations in a second.
pub const FAR_PAIRS: usize = 1 << 14;

/// The object is placed at random within this distance of its own origin along every axis, in object units. Larger
/// than any built-in surface's cell, small enough that an `f32` position keeps a thousandth of a cell.
pub const PLACEMENT: f64 = 8.0;

/// Draws per wanted sample after which a scene counts as too small for the wanted number of distinct cells.
pub const DRAWS_A_SAMPLE: usize = 8;

/// Octaves by which a tilt to 85 degrees stretches a derivative, log2(1 / cos 85).
pub const TILT_OCTAVES: f64 = 3.52;

/// Cells along every axis, to both sides, among which cells are drawn.
pub const SPREAD: f64 = 512.0;

/// Share of pairs of cells whose thresholds may be equal: twice that of the `f32` sine hash, which is a defect of its own
/// (`hash.values`).
pub const MEETING: f64 = 1.0 / 2048.0;

/// How much longer one derivative is than the other where a surface is tilted: two octaves, 75 degrees.
pub const TILT_STRETCH: f64 = 4.0;

/// Alphas at which flips are counted: a leaf's edge, its inside, the middle of the range.
pub const ALPHAS: [f64; 3] = [0.1, 0.3, 0.5];

/// How much further than [`PLACEMENT`] an object is placed where changes are counted, or how much smaller its cells are:
/// one axis then has 10^4 intervals or more. The dithered join asks a hash of one interval which octave it takes, so that
/// points with an interval in common are not independent; an `f32` position keeps a hundredth of a cell.
pub const WIDE: f64 = 16.0;

/// Cells along each side of what one view can show: as many as a screen of 4096 pixels has, cells being no smaller than a
/// pixel where their octave has most of the weight. A repeat at this distance or a larger one is tolerated along an axis and in
/// a plane of two axes, where walls and floors are. In all other directions it is tolerated beyond [`VIEW_DEPTH`]. Any linear
/// combination of indices modulo 2^32 repeats within 1626 cells in space and within 65 536 in a plane of two axes, by
/// counting (Minkowski), and may be the input of a sound hash.
pub const VIEW: u32 = 4096;

/// Indices of cells whose bits are looked at one by one: an `f32` position holds this many and a quarter of a cell, above the
/// smallest cell that the robust threshold has.
pub const INDEX_LIMIT: u32 = 1 << 20;

/// Cells along each side of a cube that has as many cells as a view of [`VIEW`]: no repeat is tolerated below this
/// distance, in whatever direction. A surface holds a longer vector that is along no plane of two axes to within a cell if its
/// direction is one of some hundred.
pub const VIEW_DEPTH: u32 = 256;

/// Up to this correlation at one distance, or length of the mean phase of a sum or difference, two cells are not tied: it changes
/// the power of a picture of noise by at most 4 % at any frequency. The one-dimensional PCG, added to at the outermost step, has
/// 0.018 between words that are 804 apart, in twice the difference.
pub const TOLERATED_TIE: f64 = 0.02;

/// Points of a claim that allows not one change.
pub const EXACT_POINTS: usize = 1 << 12;
