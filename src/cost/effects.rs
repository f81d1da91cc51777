//! The price list: what each effect of the paper adds to the test of a fragment, on one core.
//!
//! A row is a pipeline over fragments, and alphas against its thresholds. To add an effect, write its pipeline and name the
//! row that it is an addition to.

use super::Effort;
use super::clock::{Contender, Time, race};
use super::pool::{Pool, SLICE, WIDE};
use crate::stats::seed;
use crate::technique::multisampling::sample_place;
use crate::threshold::batch::Tier;
use crate::threshold::cdf::CdfForm;
use crate::threshold::fixed::{FIXED_THRESHOLD, passes};
use crate::threshold::pipeline::{
    FadeIn, FrameStrata, InputColumns, Pipeline, SamplePattern, SampleStrata, ScreenDoor, Source,
};
use crate::threshold::stage::order::Order;
use crate::threshold::stage::stipple::Density;
use crate::threshold::two_scale::Variant;
use core::num::NonZeroU32;
use rand::{Rng, RngExt, SeedableRng, rngs::Xoshiro256PlusPlus};

/// One line of the list.
pub(super) struct Effect {
    pub name: &'static str,
    /// Where the sources have it.
    pub source: &'static str,
    /// The row to which it is an addition; itself for none.
    pub over: &'static str,
    /// What makes the thresholds of a slice.
    pub pipeline: Pipeline,
    pub tier: Tier,
    pub test: Test,
}

/// What is tested against the thresholds.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Test {
    /// The alpha of each fragment.
    Alpha,
    /// That, and geometry at eight places of its pixel.
    AlphaAndGeometry,
}

/// Frames over which Eq. 6 spreads thresholds, and samples of alpha-to-coverage, as in the paper's figures.
pub(super) const EIGHT: NonZeroU32 = NonZeroU32::new(8).unwrap();

const FIXED: Pipeline = Pipeline::of(Source::Fixed(FIXED_THRESHOLD as f32));
pub(super) const HASHED: Pipeline = Pipeline::listing(Variant::Isotropic);
const ANISOTROPIC: Pipeline = Pipeline::listing(Variant::Anisotropic);

#[rustfmt::skip]
pub(super) const EFFECTS: &[Effect] = &[
    row("fixed", "§1", "fixed", FIXED),
    row("stochastic", "§4", "fixed", Pipeline::of(Source::Stochastic)),
    row("hashed", "Listing 1", "fixed", HASHED),
    Effect { tier: Tier::Fast, ..row("hashed, fast sine", "Listing 1", "fixed", HASHED) },
    row("anisotropic", "Listing 2", "fixed", ANISOTROPIC),
    row("robust", "not in the paper", "fixed", Pipeline::robust(Variant::Isotropic)),
    row("robust anisotropic", "not in the paper", "fixed", Pipeline::robust(Variant::Anisotropic)),
    row("hashed, fade-in", "Eqs. 4, 5", "hashed", faded(HASHED, false)),
    row("hashed, fade-in by anisotropy", "§7.1.1", "hashed", faded(HASHED, true)),
    row("hashed, over 8 frames", "Eq. 6", "hashed", over_frames(HASHED)),
    Effect { test: Test::AlphaAndGeometry, ..row("multisampled geometry, 8 places", "§1, §8", "fixed", FIXED) },
    row("alpha to coverage, 8 regular", "Eq. 7", "fixed", sampled(FIXED, SamplePattern::Regular)),
    row("alpha to coverage, 8 as hardware", "§3, §8", "fixed", sampled(FIXED, SamplePattern::Hardware)),
    row("alpha to coverage, 8 by pixel", "Humus 2009", "fixed", sampled(FIXED, SamplePattern::ByPixel)),
    row("hashed, 8 jittered samples", "Eq. 8", "hashed", sampled(HASHED, SamplePattern::Jittered)),
    row("hashed, 8 decorrelated samples", "Eq. 9", "hashed", sampled(HASHED, SamplePattern::Decorrelated)),
    row("hashed, 8 shuffled samples", "§3 (Enderton et al. 2010)", "hashed", sampled(HASHED, SamplePattern::Shuffled)),
    row("screen door, fixed", "§3", "fixed", Pipeline::of(Source::ScreenDoor(ScreenDoor::Fixed))),
    row("screen door, 8 x 8", "Bayer 1973", "fixed", Pipeline::of(Source::ScreenDoor(ScreenDoor::Bayer))),
    row("screen door, random", "§3", "fixed", Pipeline::of(Source::ScreenDoor(ScreenDoor::RandomMask(0)))),
    row("screen door, hashed", "§8.1", "fixed", Pipeline::of(Source::ScreenDoor(ScreenDoor::Randomised))),
    row("stipple", "Ols 2009", "fixed", Pipeline::of(Source::Stipple { density: Density::High, kept: FIXED_THRESHOLD as f32 })),
    // What the paper combines.
    row("hashed, over 8 frames, 8 decorrelated samples", "§7.2, §8", "hashed", sampled(over_frames(HASHED), SamplePattern::Decorrelated)),
    row("anisotropic, over 8 frames, fade-in by anisotropy", "§7", "anisotropic", faded(over_frames(ANISOTROPIC), true)),
];

/// One test of alpha against each threshold.
pub(super) const fn row(
    name: &'static str,
    source: &'static str,
    over: &'static str,
    pipeline: Pipeline,
) -> Effect {
    Effect { name, source, over, pipeline, tier: Tier::BitExact, test: Test::Alpha }
}

/// Noise that fades in over six levels of detail (§7.1).
const fn faded(base: Pipeline, anisotropy: bool) -> Pipeline {
    let fade_in = FadeIn { authored: FIXED_THRESHOLD as f32, full_noise_lod: 6.0, anisotropy };
    Pipeline { fade_in: Some(fade_in), form: CdfForm::Stable, ..base }
}

const fn over_frames(base: Pipeline) -> Pipeline {
    let strata = FrameStrata { frames: EIGHT, order: Order::Ascending };
    Pipeline { frame_strata: Some(strata), form: CdfForm::Stable, ..base }
}

const fn sampled(base: Pipeline, pattern: SamplePattern) -> Pipeline {
    let strata = SampleStrata { samples: EIGHT, pattern };
    Pipeline { sample_strata: Some(strata), form: CdfForm::Stable, ..base }
}

impl Effect {
    /// Room for the thresholds of a slice.
    fn buffer(&self) -> Vec<f32> {
        vec![0.0; SLICE * self.pipeline.samples().get() as usize]
    }

    /// Returns the share of the samples of a slice that is kept.
    fn kept(&self, fragments: &Fragments, slice: usize, thresholds: &mut [f32]) -> f64 {
        let mut rng = None;
        let mut random =
            || rng.get_or_insert_with(|| Xoshiro256PlusPlus::seed_from_u64(slice as u64)).next_u32();
        self.pipeline.thresholds(self.tier, &fragments.columns(slice), &mut random, thresholds);
        let (kept, of) = match self.test {
            Test::Alpha => (fragments.test(slice, thresholds), thresholds.len()),
            Test::AlphaAndGeometry => {
                (fragments.test_and_cover(slice, thresholds), EIGHT.get() as usize * SLICE)
            }
        };
        f64::from(kept) / of as f64
    }
}

/// Fragments in slices.
struct Fragments {
    pool: Pool<f32>,
    /// What is tested.
    alpha: Vec<f32>,
    /// Columns and rows: a square of 64 x 64 pixels or more.
    pixel: Vec<[u32; 2]>,
    layer: Vec<u32>,
    /// Levels of detail, -2 to 8.
    level: Vec<f32>,
    /// Lengths of the derivatives of texture coordinates.
    lengths: Vec<[f32; 2]>,
}

impl Fragments {
    fn new(slices: usize) -> Self {
        let mut rng = seed::rng("cost.fragments", 0);
        Self {
            pool: Pool::new(WIDE, slices),
            alpha: (0..SLICE).map(|_| rng.random()).collect(),
            pixel: (0..SLICE as u32).map(|k| [k % 64, k / 64]).collect(),
            layer: (0..SLICE as u32).map(|k| k % 5).collect(),
            level: (0..SLICE).map(|_| rng.random_range(-2.0..8.0)).collect(),
            lengths: (0..SLICE).map(|_| [rng.random_range(0.01..1.0), rng.random_range(0.01..1.0)]).collect(),
        }
    }

    /// The fragments of a slice, which are those of a frame.
    fn columns(&self, slice: usize) -> InputColumns<'_, f32> {
        InputColumns {
            footprint: self.pool.columns(slice),
            pixel: &self.pixel,
            frame: slice as u32,
            layer: &self.layer,
            lod: &self.level,
            texel: &self.lengths,
            given: &[],
        }
    }

    /// The alphas of a slice: another order in each, so that no predictor learns it.
    fn alpha(&self, slice: usize, fragment: usize) -> f32 {
        self.alpha[(fragment + 977 * slice) % SLICE]
    }

    fn test(&self, slice: usize, thresholds: &[f32]) -> u32 {
        let kept = |(k, thresholds): (usize, &[f32])| -> u32 {
            let alpha = self.alpha(slice, k);
            thresholds.iter().map(|&threshold| u32::from(passes(alpha, threshold))).sum()
        };
        thresholds.chunks_exact(thresholds.len() / SLICE).enumerate().map(kept).sum()
    }

    /// Tests alpha once and geometry at eight places: three edges of a triangle, of which one cuts each pixel in half.
    fn test_and_cover(&self, slice: usize, thresholds: &[f32]) -> u32 {
        let places: [[f32; 2]; EIGHT.get() as usize] =
            core::array::from_fn(|i| sample_place(i as u32, EIGHT).map(|c| c as f32));
        let covered = |(k, &threshold): (usize, &f32)| -> u32 {
            let [a, b] = self.lengths[(k + 977 * slice) % SLICE];
            let edges = [[a, b, 0.0], [b, -a, 2.0], [-b, a, 2.0]];
            let is_inside = |[x, y]: &[f32; 2]| edges.iter().all(|[a, b, c]| a * x + b * y + c > 0.0);
            let inside = places.iter().map(|place| u32::from(is_inside(place))).sum();
            if passes(self.alpha(slice, k), threshold) { inside } else { 0 }
        };
        thresholds.iter().enumerate().map(covered).sum()
    }
}

/// What an effect costs.
#[derive(Clone, Debug, PartialEq)]
pub struct Price {
    /// What was evaluated.
    pub name: &'static str,
    /// Where the sources have it.
    pub source: &'static str,
    /// The row to which it is an addition.
    pub over: &'static str,
    /// The fastest round, in nanoseconds a fragment, test included.
    pub ns_min: f64,
    /// The middle round, in nanoseconds a fragment.
    pub ns_median: f64,
    /// What the middle round takes beyond that of the row to which it is an addition, in nanoseconds.
    pub marginal: f64,
    /// The median over that of the fixed threshold.
    pub over_fixed: f64,
}

/// How many steps [`prices`] reports.
#[must_use]
pub fn steps(effort: Effort) -> u64 {
    effort.pick(3, 96)
}

/// Measures the price list in one interleaved run; `done` is called after each of [`steps`] steps.
#[must_use]
pub fn prices(effort: Effort, done: &dyn Fn()) -> Vec<Price> {
    let fragments = &Fragments::new(effort.pick(2, 32));
    let mut contenders: Vec<Contender<'_>> = EFFECTS
        .iter()
        .map(|effect| {
            let mut thresholds = effect.buffer();
            let run = move |slice| effect.kept(fragments, slice, &mut thresholds);
            Contender {
                items: SLICE,
                run: Box::new(run),
                touch: Box::new(|slice| fragments.pool.touch_columns(slice)),
            }
        })
        .collect();
    let times = race(&mut contenders, steps(effort) as usize, done);
    let rows: Vec<_> = EFFECTS.iter().map(|effect| [effect.name, effect.source, effect.over]).collect();
    listed(&rows, &times)
}

/// Makes a price list of times: a row is a name, its place in the sources, and the name of the row that it is an addition to.
pub(super) fn listed(rows: &[[&'static str; 3]], times: &[Time]) -> Vec<Price> {
    let median = |wanted: &str| {
        rows.iter().position(|[name, ..]| *name == wanted).map_or(f64::NAN, |at| times[at].median)
    };
    let price = |(&[name, source, over], time): (&[&'static str; 3], &Time)| Price {
        name,
        source,
        over,
        ns_min: time.min,
        ns_median: time.median,
        marginal: if name == over { 0.0 } else { time.median - median(over) },
        over_fixed: time.median / median("fixed"),
    };
    rows.iter().zip(times).map(price).collect()
}

/// Milliseconds a frame on a GeForce GTX 1080 at 1920 x 1080: scene, traditional, hashed, stochastic. Table 1.
pub const TABLE_1: [(&str, [f64; 3]); 10] = [
    ("Single fence", [0.06, 0.08, 0.20]),
    ("Bearded Man", [0.14, 0.16, 0.58]),
    ("Potted Palm", [0.10, 0.12, 0.42]),
    ("Bishop Pine", [0.22, 0.30, 0.75]),
    ("Japanese Walnut", [0.28, 0.36, 0.99]),
    ("European Beech", [0.39, 0.50, 1.69]),
    ("Sponza with Trees", [1.05, 1.15, 4.04]),
    ("QG Tree", [1.08, 1.22, 3.01]),
    ("UE3 FoliageMap", [2.52, 2.86, 11.42]),
    ("San Miguel", [5.19, 5.28, 7.30]),
];

/// Returns the least and the greatest ratio of Table 1 to the traditional test: of the hashed one, and of the stochastic
/// one.
#[must_use]
pub fn table_1_ratios() -> [[f64; 2]; 2] {
    [1, 2].map(|column| {
        let ratios = TABLE_1.map(|(_, times)| times[column] / times[0]);
        [ratios.into_iter().fold(f64::INFINITY, f64::min), ratios.into_iter().fold(0.0, f64::max)]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_effect_is_an_addition_to_one_that_is_listed_and_has_a_price() {
        for effect in EFFECTS {
            assert!(EFFECTS.iter().any(|other| other.name == effect.over), "{}", effect.name);
            assert_eq!(EFFECTS.iter().filter(|other| other.name == effect.name).count(), 1);
        }
        for price in prices(Effort::Quick, &|| ()) {
            assert!(price.ns_min > 0.0 && price.ns_min <= price.ns_median, "{price:?}");
        }
    }

    #[test]
    fn an_effect_keeps_as_many_samples_as_its_law_says() {
        // Alphas are uniform, so are thresholds: half of the samples pass, but for those that fade to 1/2, which does not
        // change the mean either.
        let fragments = Fragments::new(2);
        for effect in EFFECTS {
            let share = effect.kept(&fragments, 1, &mut effect.buffer());
            // Hardware keeps `floor` of 8 alpha, half a sample less; the stipple a quarter less; edges cut pixels in half; the
            // listing is NaN nowhere here.
            let expected = match effect.name {
                "stipple" => 0.375,
                "multisampled geometry, 8 places" => 0.25,
                _ => 0.5,
            };
            assert!((share - expected).abs() < 0.08, "{}: {share}", effect.name);
        }
    }

    #[test]
    fn a_price_is_the_middle_round_less_that_of_the_base() {
        let times = [10.0, 25.0, 75.0].map(|median| Time { min: 1.0, median });
        let rows = [["fixed", "", "fixed"], ["hashed", "", "fixed"], ["faded", "", "hashed"]];
        let found = listed(&rows, &times);
        assert_eq!([0, 1, 2].map(|at| found[at].marginal), [0.0, 15.0, 50.0]);
        assert_eq!([0, 1, 2].map(|at| found[at].over_fixed), [1.0, 2.5, 7.5]);
    }

    #[test]
    fn the_papers_ratios_are_those_of_its_table() {
        let [hashed, stochastic] = table_1_ratios();
        assert!((hashed[0] - 1.017).abs() < 1e-3 && (hashed[1] - 1.364).abs() < 1e-3, "{hashed:?}");
        assert!(
            (stochastic[0] - 1.407).abs() < 1e-3 && (stochastic[1] - 4.532).abs() < 1e-3,
            "{stochastic:?}"
        );
    }
}
