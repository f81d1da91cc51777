//! The price list: what each effect of the paper adds to the test of a fragment, on one core.
//!
//! A row is a function of fragments that makes thresholds, changes them, and tests alphas against them. To add an effect,
//! write the function and name the row that it is an addition to.

use super::Effort;
use super::clock::{Contender, race};
use super::pool::{Pool, SLICE, WIDE};
use crate::stats::seed;
use crate::technique::stipple::{self, Density};
use crate::technique::{mask, screen_door};
use crate::threshold::batch::{Batch, Model, Tier};
use crate::threshold::fade_in::{anisotropy, blend, fade_in};
use crate::threshold::fixed::{FIXED_THRESHOLD, passes};
use crate::threshold::hash::{HashKind, integer::pcg4d, open_lattice};
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::robust::Robust;
use crate::threshold::two_scale::Variant;
use crate::threshold::{cdf::CdfForm, coverage, stochastic, stratify};
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
    /// Tests the fragments of a slice; returns how many samples were kept.
    test: fn(&Fragments, usize, &mut Thresholds) -> u32,
}

/// Frames over which Eq. 6 spreads thresholds, and samples of alpha-to-coverage, as in the paper's figures.
const EIGHT: NonZeroU32 = NonZeroU32::new(8).unwrap();

/// The levels of detail over which noise fades in (§7.1).
const FADE_LEVELS: f32 = 6.0;

const EFFECTS: &[Effect] = &[
    Effect {
        name: "fixed",
        source: "§1",
        over: "fixed",
        test: |f, slice, t| {
            t.fill(FIXED_THRESHOLD as f32);
            f.test(slice, t)
        },
    },
    Effect {
        name: "stochastic",
        source: "§4",
        over: "fixed",
        test: |f, slice, t| {
            f.stochastic(slice, t);
            f.test(slice, t)
        },
    },
    Effect {
        name: "hashed",
        source: "Listing 1",
        over: "fixed",
        test: |f, slice, t| {
            f.hashed(Variant::Isotropic, slice, t);
            f.test(slice, t)
        },
    },
    Effect {
        name: "hashed, fast sine",
        source: "Listing 1",
        over: "fixed",
        test: |f, slice, t| {
            f.hashed_fast(slice, t);
            f.test(slice, t)
        },
    },
    Effect {
        name: "anisotropic",
        source: "Listing 2",
        over: "fixed",
        test: |f, slice, t| {
            f.hashed(Variant::Anisotropic, slice, t);
            f.test(slice, t)
        },
    },
    Effect {
        name: "robust",
        source: "not in the paper",
        over: "fixed",
        test: |f, slice, t| {
            f.robust(Variant::Isotropic, slice, t);
            f.test(slice, t)
        },
    },
    Effect {
        name: "robust anisotropic",
        source: "not in the paper",
        over: "fixed",
        test: |f, slice, t| {
            f.robust(Variant::Anisotropic, slice, t);
            f.test(slice, t)
        },
    },
    Effect {
        name: "hashed, fade-in",
        source: "Eqs. 4, 5",
        over: "hashed",
        test: |f, slice, t| {
            f.hashed(Variant::Isotropic, slice, t);
            f.fade(slice, t);
            f.test(slice, t)
        },
    },
    Effect {
        name: "hashed, fade-in by anisotropy",
        source: "§7.1.1",
        over: "hashed",
        test: |f, slice, t| {
            f.hashed(Variant::Isotropic, slice, t);
            f.fade_anisotropic(slice, t);
            f.test(slice, t)
        },
    },
    Effect {
        name: "hashed, over 8 frames",
        source: "Eq. 6",
        over: "hashed",
        test: |f, slice, t| {
            f.hashed(Variant::Isotropic, slice, t);
            stratified(slice, t);
            f.test(slice, t)
        },
    },
    Effect {
        name: "alpha to coverage, 8 regular",
        source: "Eq. 7",
        over: "fixed",
        test: |f, slice, _| f.cover(slice, |_, i, _| coverage::regular(i, EIGHT)),
    },
    Effect {
        name: "alpha to coverage, 8 as hardware",
        source: "§3, §8",
        over: "fixed",
        test: |f, slice, _| f.cover(slice, |_, i, _| mask::hardware_threshold(i, EIGHT)),
    },
    Effect {
        name: "alpha to coverage, 8 by pixel",
        source: "Humus 2009",
        over: "fixed",
        test: |f, slice, t| {
            t.iter_mut().enumerate().for_each(|(k, t)| *t = mask::pixel_value(pixel(k)));
            f.cover(slice, |k, i, _| mask::turned(t[k], i, EIGHT))
        },
    },
    Effect {
        name: "hashed, 8 jittered samples",
        source: "Eq. 8",
        over: "hashed",
        test: |f, slice, t| {
            f.hashed(Variant::Isotropic, slice, t);
            f.cover(slice, |k, i, _| coverage::jittered(t[k], i, EIGHT))
        },
    },
    Effect {
        name: "hashed, 8 decorrelated samples",
        source: "Eq. 9",
        over: "hashed",
        test: |f, slice, t| {
            f.hashed(Variant::Isotropic, slice, t);
            f.cover(slice, |k, i, xi| coverage::jittered(t[k], coverage::decorrelated(xi, i, EIGHT), EIGHT))
        },
    },
    Effect {
        name: "hashed, 8 shuffled samples",
        source: "§3 (Enderton et al. 2010)",
        over: "hashed",
        test: |f, slice, t| {
            f.hashed(Variant::Isotropic, slice, t);
            f.cover(slice, |k, i, [xi, _]| {
                coverage::jittered(t[k], mask::shuffled(xi.to_bits(), i, EIGHT), EIGHT)
            })
        },
    },
    Effect {
        name: "screen door, fixed",
        source: "§3",
        over: "fixed",
        test: |f, slice, t| {
            t.iter_mut().enumerate().for_each(|(k, t)| *t = screen_door::fixed(pixel(k)));
            f.test(slice, t)
        },
    },
    Effect {
        name: "screen door, hashed",
        source: "§8.1",
        over: "fixed",
        test: |f, slice, t| {
            let layer = slice as u32;
            t.iter_mut().enumerate().for_each(|(k, t)| *t = screen_door::randomised(pixel(k), layer));
            f.test(slice, t)
        },
    },
    Effect {
        name: "stipple",
        source: "Ols 2009",
        over: "fixed",
        test: |f, slice, t| {
            let kept = FIXED_THRESHOLD as f32;
            t.iter_mut()
                .enumerate()
                .for_each(|(k, t)| *t = stipple::threshold(Density::High, pixel(k), kept));
            f.test(slice, t)
        },
    },
    Effect {
        name: "hashed, fade-in, over 8 frames",
        source: "§7",
        over: "hashed",
        test: |f, slice, t| {
            f.hashed(Variant::Isotropic, slice, t);
            stratified(slice, t);
            f.fade(slice, t);
            f.test(slice, t)
        },
    },
];

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

    /// Tests eight samples a fragment against thresholds of their own, which may ask for two random numbers a fragment.
    fn cover(&self, slice: usize, threshold: impl Fn(usize, u32, [f32; 2]) -> f32) -> u32 {
        let of_fragment = |k: usize| -> u32 {
            let words = pcg4d([k as u32, slice as u32, 0, 0]);
            let xi = [open_lattice(words[0]), open_lattice(words[1])];
            let alpha = self.alpha(slice, k);
            (0..EIGHT.get()).map(|i| u32::from(passes(alpha, threshold(k, i, xi)))).sum()
        };
        (0..SLICE).map(of_fragment).sum()
    }
}

/// The pixel of a fragment of a slice, which covers a square of 64 x 64 pixels or more.
fn pixel(fragment: usize) -> [u32; 2] {
    [fragment as u32 % 64, fragment as u32 / 64]
}

fn stratified(frame: usize, thresholds: &mut Thresholds) {
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
            let run = move |slice| f64::from((effect.test)(fragments, slice, &mut thresholds));
            Contender {
                items: SLICE,
                run: Box::new(run),
                touch: Box::new(|slice| fragments.pool.touch_columns(slice)),
            }
        })
        .collect();
    let times = race(&mut contenders, steps(effort) as usize, done);
    let median = |name: &str| {
        let at = EFFECTS.iter().position(|effect| effect.name == name);
        at.map_or(f64::NAN, |at| times[at].median)
    };
    EFFECTS
        .iter()
        .zip(&times)
        .map(|(effect, time)| Price {
            name: effect.name,
            source: effect.source,
            over: effect.over,
            ns_min: time.min,
            ns_median: time.median,
            marginal: if effect.name == effect.over { 0.0 } else { time.median - median(effect.over) },
            over_fixed: time.median / median("fixed"),
        })
        .collect()
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
            let kept = f64::from((effect.test)(&fragments, 1, &mut thresholds));
            let samples = if effect.name.contains("8 ") && !effect.name.contains("frames") { 8 } else { 1 };
            let share = kept / f64::from(samples) / SLICE as f64;
            // Hardware keeps `floor` of 8 alpha, half a sample less; the stipple a quarter less; the listing is NaN nowhere
            // here.
            let expected = if effect.name == "stipple" { 0.375 } else { 0.5 };
            assert!((share - expected).abs() < 0.08, "{}: {share}", effect.name);
        }
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
