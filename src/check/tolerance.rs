//! Every level, budget and constant of the verdict, with its reason.

/// Probability that a run rejects any true claim at all (Holm). A run a minute would raise one false alarm in two
/// years.
pub const FAMILY_LEVEL: f64 = 1.0e-6;

/// Level at which `detectable` is stated: Holm's first step in the first round of a run of 500 trials, which has half
/// of [`FAMILY_LEVEL`] to spend.
pub const SINGLE_LEVEL: f64 = 1.0e-9;

/// Corrected p-value up to which a claim is suspect and tried again with fresh inputs: one sound run in a hundred pays
/// for a second try.
pub const SUSPICION: f64 = 1.0e-2;

/// How many times more samples a retest draws: a shift shows twice as clearly.
pub const ROUND_GROWTH: usize = crate::stats::sequential::GROWTH;

/// Most samples of one kind in memory, whatever budget and round: a few gigabytes.
pub const SAMPLES_LIMIT: usize = 1 << 23;

/// A specimen is named where it shares this much of what rejects it with a subject: with less, the two differ in most.
pub const LEAST_LIKENESS: f64 = 0.3;

/// A share of footprints without a threshold in (0, 1] beyond which a subject is told to have none: no specimen has more
/// than a few.
pub const NO_THRESHOLD: f64 = 0.9;

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

/// Pairs of cells in each of the other relations: 64 expected in every square, and room for ten relations in a second.
pub const FAR_PAIRS: usize = 1 << 14;

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

// Real surfaces and derivatives.

/// Pairs of frames on each rasterised plane: shows an excess of 0.007 over a share of 0.02, less than grids make that
/// are not nested, a fortieth of what a plane on the faces of cells makes.
pub const RASTER_SAMPLES: usize = 1 << 15;

/// Pixels of the rasterised image: a pixel is then about a hundredth of the plane, as on a card in a real frame.
pub const RASTER_RESOLUTION: [u32; 2] = [256, 192];

/// Half a side of a rasterised plane, in object units.
pub const PLANE_HALF_SIDE: f64 = 1.0;

/// The image moves by this many pixels between two frames: far below a cell, so that few thresholds should change.
pub const FRAME_SHIFT: f64 = 0.012;

/// A threshold that moves further between two frames is another draw. The derivatives of two frames differ by their
/// rounding and by perspective, 1e-3 of an octave at most, and a continuous threshold follows them; a new draw is
/// nearer than this in one case of 128.
pub const REDRAW: f64 = 1.0 / 256.0;

/// Pairs of layers: the bias of the `f32` sine hash differs from one to the next.
pub const LAYER_PAIRS: usize = 8;

/// Samples of each pair of layers: 128 expected in every square.
pub const LAYER_SAMPLES: usize = 1 << 15;

/// Two layers are at least this far apart along z, in object units: many cells.
pub const LEAST_LAYER_DISTANCE: f64 = 1.0;

/// Points whose thresholds are followed under zoom, rotation and tilt: a pop in one of 200 points and octaves shows.
pub const SWEEP_POINTS: usize = 64;

/// Octaves that the scale goes through under zoom: three powers of two along each axis.
pub const ZOOM_OCTAVES: f64 = 3.0;

/// Octaves by which a tilt to 85 degrees stretches a derivative, log2(1 / cos 85).
pub const TILT_OCTAVES: f64 = 3.52;

/// Octaves between two views: the steepest join then moves by less than 0.02 a step, where a pop has a mean of 1/3.
pub const LOG_SCALE_STEP: f64 = 1.0 / 2048.0;

/// Radians between two views of a turn; no scale moves by more than log2(e) octaves a radian.
pub const TURN_STEP: f64 = 1.0 / 3072.0;

/// Octave from which the views of a sweep begin: cells of an eighth of a unit, of which [`PLACEMENT`] holds a million.
pub const FINEST_VIEW: f64 = 3.0;

/// Most that interpolation moves per octave of the scale. Eq. 2: |d tau / d l| <= 1 / (2 (1 - a)^2) <= 2; the weight of
/// Listing 2 moves by at most |d f| / sqrt 3, since the distances to two opposite corners add up to sqrt 3 or more.
pub const INTERPOLATION_SLOPE: f64 = 2.0;

/// Most that the copula of two cells moves per octave: phi(0) Q / ((1 - l)^2 + l^2)^(3/2), with quantiles up to
/// Q = 5.42 for hashes that keep 2^-25 away from 0 and 1; 6.12 at l = 1/2.
pub const COPULA_SLOPE: f64 = 6.2;

/// Most that the copula of eight cells moves per octave of one axis: each of the other two, halfway, adds a factor of
/// sqrt 2 to [`COPULA_SLOPE`]. The axes add up.
pub const COPULA_SLOPE_OF_AN_AXIS: f64 = 2.0 * COPULA_SLOPE;

/// What rounding may add to the change between two views, in `f32` and `f64`: 16 roundings of a number below 1, and
/// for the `f64` copula those of its quantiles.
pub const POP_ROUNDING: [f64; 2] = [1.0 / 1_048_576.0, 1.0 / 17_592_186_044_416.0];

/// Octaves at whose beginning the threshold is followed: indices in them have one to three digits.
pub const BOUNDARY_OCTAVES: core::ops::RangeInclusive<i32> = -2..=6;

/// Points at each power of two: log2 and its floor disagree within few roundings, and at every point if at any.
pub const BOUNDARY_POINTS: usize = 1 << 11;

/// Roundings on each side of a power of two: log2 in `f32` rounds up to two of them to the power up to 2^8.
pub const BOUNDARY_ULPS: i32 = 8;

/// Octaves by which the other axes are finer there: both derivatives together stay shorter than the first, and no
/// shorter than the 2^-5 at which a floor would tie them to it.
pub const OTHER_AXES: [f64; 2] = [0.6, 3.0];

/// Octaves in which the surroundings of the origin are seen: as many as leave the squares of `f32` derivatives finite.
pub const ORIGIN_OCTAVES: core::ops::Range<i32> = -32..32;

/// Cells along every axis, to both sides, among which cells are drawn.
pub const SPREAD: f64 = 512.0;

/// Cells between the origin and a window: from 2^24 on `f32` has no neighbouring cells.
pub const WINDOW_OFFSETS: [f64; 5] = [0.0, 4096.0, 65_536.0, 1_048_576.0, 8_388_608.0];

/// Cells of a window along each axis: flat enough that a bias of single layers of z shows where it grows.
pub const WINDOW_SIZE: [f64; 3] = [2048.0, 2048.0, 16.0];

/// Samples in each window: 2048 a layer, which shows when the layers have fewer than 750 different values each.
pub const WINDOW_SAMPLES: usize = 1 << 15;

/// Pairs of a cell and its image: sees a correlation of 0.035.
pub const MIRROR_PAIRS: usize = 1 << 16;

/// The threshold up to which values are counted: ten times the clamp of the listings, a hundred steps of the lattice.
pub const ATOM_THRESHOLD: f64 = 1.0e-5;

/// Cells of the block in which they are counted: 2^20 in all, ten expected values; sees a rate six times too high, a
/// seventh of that of the `f32` sine hash.
pub const ATOM_BLOCK: [u32; 3] = [64, 128, 128];

/// Distances from the origin at which `f32` positions are tried, in object units: a large level, a city, a country.
pub const FAR_COORDINATES: [f32; 3] = [1.0e4, 1.0e5, 1.0e6];

/// Sizes of a pixel there, in units in the last place of the coordinate: from quads with one position to quads with a
/// derivative of one or two units.
pub const FAR_FOOTPRINTS: [f64; 4] = [0.05, 0.2, 0.5, 1.5];

/// Quads of each size at each distance: a share is known to a hundredth.
pub const FAR_QUADS: usize = 1 << 13;

/// An end of the range: one step of the coarsest grid of the `f32` sine hash.
pub const END: f64 = 1.0 / 1024.0;

/// Layers of the block of cells in which the ends are counted: 256 expected at each end.
pub const END_LAYERS: u32 = ATOM_BLOCK[2] / 4;

/// Pairs of a point before and after a motion: about half stay in their cells.
pub const CELL_PAIRS: usize = 1 << 16;

/// The largest motion along an axis, in sides of the fine cell: three in five points stay in a cell of three axes.
pub const CELL_MOTION: f64 = 0.3;

/// Weights at which the change of either cell shows in the last bits of an `f32`.
pub const CELL_WEIGHTS: core::ops::RangeInclusive<f64> = 0.01..=0.99;

/// Share of pairs of cells whose thresholds may be equal: twice that of the `f32` sine hash, which is a defect of its own
/// (`hash.values`).
pub const MEETING: f64 = 1.0 / 2048.0;

/// Samples of which Eq. 2 is computed again.
pub const FORMULA_SAMPLES: usize = 1 << 16;

/// How far a threshold may be from Eq. 2, in `f32` and `f64`: the clamp at 1e-6, and a dozen roundings of a number below
/// 1 for the logarithm, the weight and the formula.
pub const CDF_ROUNDING: [f64; 2] = [1.0 / 524_288.0, 1.0e-6];

/// Pairs of neighbours whose difference is taken, along each of four directions: 1024 expected in every bin.
pub const DIFFERENCE_PAIRS: usize = 1 << 16;

/// Cells whose thresholds are compared with each other: 512 pairs meet at [`MEETING_VALUES`].
pub const VALUE_CELLS: usize = 1 << 16;

/// Share of pairs of cells that may have one threshold: four times that of a lattice of 2^24 values.
pub const MEETING_VALUES: f64 = 1.0 / 4_194_304.0;

/// Cells in x and y between which both phases of the sine hash, 17 x + 0.1 y and 13 y + x, advance by all but a whole
/// number of half turns; its two-dimensional form has correlations up to 0.2 there.
pub const RESONANCES: [[i32; 2]; 5] = [[355, 0], [710, 0], [3726, -232], [3460, -785], [2750, -785]];

/// Pairs of cells at each resonance: shows a correlation of 0.03.
pub const RESONANCE_PAIRS: usize = 1 << 16;

// Noise as a whole: its size, its spectrum, the variance of coverage.

/// Derivatives of a patch times its hash scale lie in the octave from this one on: coarse cells of 2^-5 units, a
/// thousandth of a cell being five roundings of an `f32` position within [`WIDE`] times [`PLACEMENT`].
pub const PATCH_OCTAVES: f64 = -6.0;

/// No object axis of a patch has less than this share of the largest derivative: twice the share to which the robust
/// threshold raises it.
pub const LEAST_AXIS_SHARE: f64 = 1.0 / 16.0;

/// How much longer one derivative is than the other where a surface is tilted: two octaves, 75 degrees.
pub const TILT_STRETCH: f64 = 4.0;

/// Scan lines of each kind, along each screen axis: sees a size of the noise that is off by a tenth, which four hundred
/// would not.
pub const SCAN_LINES: usize = 1 << 10;

/// Steps of a scan line, an eighth of the claimed size each: four times that size, so that lines of any patch change some
/// cells and the count of changes is not all chance.
pub const SCAN_STEPS: u32 = 32;

/// Steps of a scan line within the claimed size: also the smallest cells, half of that size, are left by one step in
/// four only.
pub const STEPS_A_SIZE: f64 = 8.0;

/// Samples of each surface on which coverage is measured: every share is known to 0.3 %.
pub const COVERAGE_SAMPLES: usize = 1 << 15;

/// Alphas at which coverage is measured on each surface, among them those of a thin and of a dense texture.
pub const COVERAGE_ALPHAS: [f64; 4] = [0.1, 0.3, 0.5, 0.9];

/// Blocks whose coverage is compared with each other: a variance is known to 3 % on either side of lerp factor 1/2.
pub const COVERAGE_BLOCKS: usize = 1 << 12;

/// Blocks that share a patch, each at a place of its own.
pub const BLOCKS_A_PATCH: usize = 16;

/// Places along a side of a block, half the claimed size of the noise apart: a block holds some thirty cells, so that its
/// mean is near normal.
pub const BLOCK_SIDE: usize = 12;

/// Alphas at which the variance is measured: the kurtosis of a kept cell is then negative, which errs on the safe side.
pub const VARIANCE_ALPHAS: [f64; 3] = [0.3, 0.5, 0.7];

/// Largest difference of two values that count as equal but for rounding: sixteen roundings of an `f32` near 1.
pub const EQUAL_WITHIN: f64 = 1.0e-6;

/// Samples of each of two subjects whose laws are compared: 256 expected in every cell of the table.
pub const COMPARED_SAMPLES: usize = 1 << 16;

/// Images of each kind of patch on each side of lerp factor 1/2: enough for a usable tail of Student's law, and to see a
/// correlation that is off by a tenth, or half the power of the lowest frequencies missing.
pub const SPECTRUM_IMAGES: usize = 64;

/// Images that share a patch, each at a place of its own: the expected spectrum costs more than an image.
pub const IMAGES_A_PATCH: usize = 4;

/// Pixels along a side of an image, one claimed size of the noise apart: 256 cells or more.
pub const SPECTRUM_SIDE: usize = 32;

/// Lags along each axis up to which the autocorrelation is tried, in claimed sizes: a cell is at most two sizes long.
pub const LAGS: i64 = 4;

/// Rings of frequencies from 0 to half a cycle for each claimed size: the first has eleven ordinates an image.
pub const RINGS: usize = 6;

// Motion: flips, frames, coordinates.

/// Alphas at which flips are counted: a leaf's edge, its inside, the middle of the range.
pub const ALPHAS: [f64; 3] = [0.1, 0.3, 0.5];

/// Shifts in pixels after which flips are counted: one at which half of the changes are soft, one beyond the fine cell.
pub const FLIP_SHIFTS: [f64; 2] = [0.125, 0.6];

/// Samples at each shift, screen axis and scene: a soft change that is counted as a hard one doubles a share of 0.1.
pub const FLIP_SAMPLES: usize = 1 << 15;

/// How much further than [`PLACEMENT`] an object is placed where changes are counted, or how much smaller its cells are:
/// one axis then has 10^4 intervals or more. The dithered join asks a hash of one interval which octave it takes, so that
/// points with an interval in common are not independent; an `f32` position keeps a hundredth of a cell.
pub const WIDE: f64 = 16.0;

/// How much smaller the cells are than those of [`FINEST_VIEW`] where only the view of a point changes: again 10^5
/// intervals. Much smaller ones would be so for the coordinates that the robust threshold raises them.
pub const FINE_VIEWS: f64 = 256.0;

/// Points whose flips are counted over a whole motion: a flip more in 25 points and octaves shows; leaving out Eq. 2
/// takes away one in 12 at an alpha of 0.1.
pub const FLIP_POINTS: usize = 1 << 14;

/// Views of a point less one: few passages of alpha fall between two of them in twos. The prediction is about the views
/// themselves and does not count those either.
pub const FLIP_STEPS: usize = 16;

/// Frames over which a skinned surface bends: 0.32 radians of its bone, half an octave and more where it bends most.
pub const SKINNED_FRAMES: f64 = 16.0;

/// Pixels by which a frame of motion moves the image: three cells or more at every lerp factor.
pub const MOTION_PIXELS: f64 = 3.0;

/// Radians by which a frame of motion turns an object or rolls a camera.
pub const TURN_A_FRAME: f64 = 0.02;

/// Radians per object unit of the wave that deforms an object and weighs its bones: a quarter of a period in a unit.
pub const WAVE: [f64; 3] = [1.3, 0.9, -0.7];

/// Points that are followed for one cell of the table of coordinates: a share is known to a hundredth.
pub const TABLE_POINTS: usize = 1 << 11;

/// The largest change of a threshold that the change of its scale may explain in that table: two thresholds that have
/// nothing to do with each other are nearer than this in one case of four.
pub const EXPLAINED: f64 = 0.125;

/// Points of a claim that allows not one change.
pub const EXACT_POINTS: usize = 1 << 12;

/// Frames at which a static threshold is asked: neighbours, powers of two, the last one; or as many periods.
pub const FRAMES: [u32; 6] = [0, 1, 2, 7, 1024, u32::MAX];

/// What roundings of `f32` leave between two thresholds of one point in different strata: the sum, the part after the
/// point and the clamp at 2^-24.
pub const STRATUM_ROUNDING: f64 = 1.0 / 4_194_304.0;

/// Pixels by which the image moves in a frame or period where the noise of one pixel is followed.
pub const DRIFT: f64 = 0.15;

/// Frames or periods between two thresholds of one pixel: within the fine cell, across it, and beyond the coarse one.
pub const FRAME_LAGS: [u32; 4] = [1, 2, 5, 16];

/// Points at each lag and of each exponential average: a correlation of 0.05 shows.
pub const FRAME_POINTS: usize = 1 << 15;

/// Weight of the newest frame in an exponential average: that of common temporal antialiasing.
pub const NEWEST: f64 = 0.1;

/// Points that are evaluated one by one.
pub const ALONE: usize = 64;

/// Fragments of a second pass that are evaluated together: neither a power of two nor a row of the first.
pub const PIECE: usize = 37;
