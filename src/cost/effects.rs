//! The price list: what each effect of the paper adds to the test of a fragment, on one core.
//!
//! A row is functions of fragments that make thresholds, change them, and test alphas against them. To add an effect,
//! write what it does and name the row that it is an addition to.

use super::Effort;
use super::clock::{Contender, Time, race};
use super::pool::{Pool, SLICE, WIDE};
use crate::stats::seed;
use crate::technique::multisampling::sample_place;
use crate::threshold::stage::stipple::{self, Density};

use crate::threshold::batch::{Batch, Model, Tier};
use crate::threshold::fixed::{FIXED_THRESHOLD, passes};
use crate::threshold::hash::{HashKind, integer::pcg4d, open_lattice};
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::robust::Robust;
use crate::threshold::stage::fade_in::{anisotropy, blend, fade_in};
use crate::threshold::stage::{coverage, mask, screen_door, stratify};
use crate::threshold::two_scale::Variant;
use crate::threshold::{cdf::CdfForm, stochastic};
use core::num::NonZeroU32;
use rand::{RngExt, SeedableRng, rngs::Xoshiro256PlusPlus};

/// The thresholds of a slice of fragments.
type Thresholds = [f32];

/// One line of the list.
struct Effect {
    name: &'static str,
    /// Where the sources have it.
    source: &'static str,
    /// The row to which it is an addition; itself for none.
    over: &'static str,
    /// What makes the thresholds of a slice, and what changes them, in turn.
    make: &'static [Step],
    /// Tests the fragments of a slice; returns how many samples were kept.
    test: Test,
    /// The samples of a fragment.
    samples: u32,
}

type Step = fn(&Fragments, usize, &mut Thresholds);
type Test = fn(&Fragments, usize, &Thresholds) -> u32;

/// Frames over which Eq. 6 spreads thresholds, and samples of alpha-to-coverage, as in the paper's figures.
const EIGHT: NonZeroU32 = NonZeroU32::new(8).unwrap();

/// The levels of detail over which noise fades in (§7.1).
const FADE_LEVELS: f32 = 6.0;

const FIXED: Step = |_, _, t| t.fill(FIXED_THRESHOLD as f32);
const HASHED: Step = |f, slice, t| f.hashed(Variant::Isotropic, slice, t);
const ANISOTROPIC: Step = |f, slice, t| f.hashed(Variant::Anisotropic, slice, t);
const ROBUST: Step = |f, slice, t| f.robust(Variant::Isotropic, slice, t);
const ROBUST_ANISOTROPIC: Step = |f, slice, t| f.robust(Variant::Anisotropic, slice, t);
const PIXEL: Step = |_, _, t| by_pixel(t, mask::pixel_value);
const DOOR: Step = |_, _, t| by_pixel(t, screen_door::fixed);
const RANDOM_DOOR: Step = |_, _, t| {
    const SIDE: u32 = screen_door::TILE;
    let mask: [f32; (SIDE * SIDE) as usize] =
        core::array::from_fn(|k| screen_door::random_mask([k as u32 % SIDE, k as u32 / SIDE], 0));
    by_pixel(t, |[x, y]| mask[(y % SIDE * SIDE + x % SIDE) as usize]);
};
const HASHED_DOOR: Step = |_, slice, t| by_pixel(t, |pixel| screen_door::randomised(pixel, slice as u32));
const STIPPLE: Step =
    |_, _, t| by_pixel(t, |pixel| stipple::threshold(Density::High, pixel, FIXED_THRESHOLD as f32));

const REGULAR: Test = |f, slice, _| f.cover(slice, |_| |i| coverage::regular(i, EIGHT));
const HARDWARE: Test = |f, slice, _| f.cover(slice, |_| |i| mask::hardware_threshold(i, EIGHT));
const TURNED: Test = |f, slice, t| f.cover(slice, |k| move |i| mask::turned(t[k], i, EIGHT));
const JITTERED: Test = |f, slice, t| f.cover(slice, |k| move |i| coverage::jittered(t[k], i, EIGHT));
const DECORRELATED: Test = |f, slice, t| {
    f.cover(slice, |k| {
        let [_, first, second, _] = words(k, slice);
        let xi: [f32; 2] = [first, second].map(open_lattice);
        move |i| coverage::jittered(t[k], coverage::decorrelated(xi, i, EIGHT), EIGHT)
    })
};
const SHUFFLED: Test = |f, slice, t| {
    f.cover(slice, |k| {
        let [_, _, _, word] = words(k, slice);
        move |i| coverage::jittered(t[k], mask::shuffled(word, i, EIGHT), EIGHT)
    })
};

#[rustfmt::skip]
const EFFECTS: &[Effect] = &[
    row("fixed", "§1", "fixed", &[FIXED]),
    row("stochastic", "§4", "fixed", &[Fragments::stochastic]),
    row("hashed", "Listing 1", "fixed", &[HASHED]),
    row("hashed, fast sine", "Listing 1", "fixed", &[Fragments::hashed_fast]),
    row("anisotropic", "Listing 2", "fixed", &[ANISOTROPIC]),
    row("robust", "not in the paper", "fixed", &[ROBUST]),
    row("robust anisotropic", "not in the paper", "fixed", &[ROBUST_ANISOTROPIC]),
    row("hashed, fade-in", "Eqs. 4, 5", "hashed", &[HASHED, Fragments::fade]),
    row("hashed, fade-in by anisotropy", "§7.1.1", "hashed", &[HASHED, Fragments::fade_anisotropic]),
    row("hashed, over 8 frames", "Eq. 6", "hashed", &[HASHED, stratified]),
    row("multisampled geometry, 8 places", "§1, §8", "fixed", &[FIXED]).with_samples(Fragments::test_and_cover),
    row("alpha to coverage, 8 regular", "Eq. 7", "fixed", &[]).with_samples(REGULAR),
    row("alpha to coverage, 8 as hardware", "§3, §8", "fixed", &[]).with_samples(HARDWARE),
    row("alpha to coverage, 8 by pixel", "Humus 2009", "fixed", &[PIXEL]).with_samples(TURNED),
    row("hashed, 8 jittered samples", "Eq. 8", "hashed", &[HASHED]).with_samples(JITTERED),
    row("hashed, 8 decorrelated samples", "Eq. 9", "hashed", &[HASHED]).with_samples(DECORRELATED),
    row("hashed, 8 shuffled samples", "§3 (Enderton et al. 2010)", "hashed", &[HASHED]).with_samples(SHUFFLED),
    row("screen door, fixed", "§3", "fixed", &[DOOR]),
    row("screen door, random", "§3", "fixed", &[RANDOM_DOOR]),
    row("screen door, hashed", "§8.1", "fixed", &[HASHED_DOOR]),
    row("stipple", "Ols 2009", "fixed", &[STIPPLE]),
    // What the paper combines.
    row("hashed, over 8 frames, 8 decorrelated samples", "§7.2, §8", "hashed", &[HASHED, stratified]).with_samples(DECORRELATED),
    row("anisotropic, over 8 frames, fade-in by anisotropy", "§7", "anisotropic", &[ANISOTROPIC, stratified, Fragments::fade_anisotropic]),
];

impl Effect {
    /// The same with eight samples a fragment.
    const fn with_samples(self, test: Test) -> Self {
        Self { test, samples: EIGHT.get(), ..self }
    }

    /// Returns the share of the samples of a slice that is kept.
    fn kept(&self, fragments: &Fragments, slice: usize, thresholds: &mut Thresholds) -> f64 {
        self.make.iter().for_each(|step| step(fragments, slice, thresholds));
        let kept = (self.test)(fragments, slice, thresholds);
        f64::from(kept) / f64::from(self.samples) / SLICE as f64
    }
}

/// One test a fragment.
const fn row(name: &'static str, source: &'static str, over: &'static str, make: &'static [Step]) -> Effect {
    Effect { name, source, over, make, test: |f, slice, t| f.test(slice, t), samples: 1 }
}

/// Fragments in slices.
struct Fragments {
    pool: Pool<f32>,
    /// What is tested.
    alpha: Vec<f32>,
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
            level: (0..SLICE).map(|_| rng.random_range(-2.0..8.0)).collect(),
            lengths: (0..SLICE).map(|_| [rng.random_range(0.01..1.0), rng.random_range(0.01..1.0)]).collect(),
        }
    }

    /// The alphas of a slice: another order in each, so that no predictor learns it.
    fn alpha(&self, slice: usize, fragment: usize) -> f32 {
        self.alpha[(fragment + 977 * slice) % SLICE]
    }

    fn test(&self, slice: usize, thresholds: &Thresholds) -> u32 {
        let kept = |(i, &threshold): (usize, &f32)| u32::from(passes(self.alpha(slice, i), threshold));
        thresholds.iter().enumerate().map(kept).sum()
    }

    fn stochastic(&self, slice: usize, thresholds: &mut Thresholds) {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(slice as u64);
        thresholds.fill_with(|| stochastic::threshold(&mut rng));
    }

    fn hashed(&self, variant: Variant, slice: usize, thresholds: &mut Thresholds) {
        Batch::new(listing(variant)).thresholds(&self.pool.columns(slice), thresholds);
    }

    fn hashed_fast(&self, slice: usize, thresholds: &mut Thresholds) {
        let batch = Batch { tier: Tier::Fast, ..Batch::new(listing(Variant::Isotropic)) };
        batch.thresholds(&self.pool.columns(slice), thresholds);
    }

    fn robust(&self, variant: Variant, slice: usize, thresholds: &mut Thresholds) {
        Batch::new(Robust::new(variant)).thresholds(&self.pool.columns(slice), thresholds);
    }

    fn fade(&self, _: usize, thresholds: &mut Thresholds) {
        for (threshold, &level) in thresholds.iter_mut().zip(&self.level) {
            *threshold = fade_in(*threshold, blend(level, FADE_LEVELS));
        }
    }

    fn fade_anisotropic(&self, _: usize, thresholds: &mut Thresholds) {
        for ((threshold, &level), &lengths) in thresholds.iter_mut().zip(&self.level).zip(&self.lengths) {
            *threshold = fade_in(*threshold, blend(level * anisotropy(lengths), FADE_LEVELS));
        }
    }

    /// Tests eight samples a fragment against thresholds of their own, which the fragment's function makes of them.
    fn cover<S: Fn(u32) -> f32>(&self, slice: usize, of_fragment: impl Fn(usize) -> S) -> u32 {
        let covered = |k: usize| -> u32 {
            let (alpha, threshold) = (self.alpha(slice, k), of_fragment(k));
            (0..EIGHT.get()).map(|i| u32::from(passes(alpha, threshold(i)))).sum()
        };
        (0..SLICE).map(covered).sum()
    }

    /// Tests alpha once and geometry at eight places: three edges of a triangle, of which one cuts each pixel in half.
    fn test_and_cover(&self, slice: usize, thresholds: &Thresholds) -> u32 {
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

/// The pixel of a fragment of a slice, which covers a square of 64 x 64 pixels or more.
fn pixel(fragment: usize) -> [u32; 2] {
    [fragment as u32 % 64, fragment as u32 / 64]
}

fn by_pixel(thresholds: &mut Thresholds, threshold: impl Fn([u32; 2]) -> f32) {
    thresholds.iter_mut().enumerate().for_each(|(k, t)| *t = threshold(pixel(k)));
}

/// Random numbers of a fragment.
fn words(fragment: usize, slice: usize) -> [u32; 4] {
    pcg4d([fragment as u32, slice as u32, 0, 0])
}

fn stratified(_: &Fragments, frame: usize, thresholds: &mut Thresholds) {
    let frame = frame as u32 % EIGHT;
    thresholds.iter_mut().for_each(|t| *t = stratify::stratified(*t, frame, EIGHT));
}

fn listing(variant: Variant) -> Model {
    HashedAlpha { variant, hash: HashKind::Sine, hash_scale: 1.0, form: CdfForm::Literal }.into()
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
            let mut thresholds = vec![0.0; SLICE];
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
            let mut thresholds = vec![0.0; SLICE];
            let share = effect.kept(&fragments, 1, &mut thresholds);
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
