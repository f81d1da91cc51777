//! What a threshold does to a picture, whatever it costs: its law, its bias, and how often it changes its mind.

use super::Effort;
use super::pool::{COARSE, draw};
use crate::stats::ecdf::kolmogorov_smirnov;
use crate::stats::seed;
use crate::threshold::footprint::Footprint;
use glam::dvec3;
use rand::RngExt;

/// A threshold of many footprints; NaN where there is none.
pub type Evaluate<'a> = dyn Fn(&[Footprint<f64>]) -> Vec<f64> + Sync + 'a;

/// The statistical axis of the ladder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    /// The greatest distance of the empirical law from the uniform one (Kolmogorov-Smirnov); of n independent samples it
    /// is below 1.36 / sqrt(n) with probability 0.95. NaN where a threshold is.
    pub ks: f64,
    /// What `ks` of a uniform law stays below, but once in a million.
    pub chance: f64,
    /// The root mean square, over planes of constant z, of how far coverage at alpha 1/2 is off. An ideal hash has
    /// 1/2 / sqrt(samples a plane).
    pub bias: f64,
    /// How often a fragment whose alpha is any number in (0, 1) appears or vanishes while the surface moves by a pixel.
    pub flips_per_pixel: f64,
    /// The same while the viewer comes closer by half the distance.
    pub flips_per_octave: f64,
}

/// The footprints on which laws are measured.
pub struct Samples {
    spread: Vec<Footprint<f64>>,
    moving: Vec<Footprint<f64>>,
    planes: Vec<Vec<Footprint<f64>>>,
}

/// How finely a motion is cut: changes within a step are not seen.
const STEPS: i32 = 16;

impl Samples {
    /// Draws the footprints, always the same.
    #[must_use]
    pub fn new(effort: Effort) -> Self {
        let plane = |z: usize| {
            let mut rng = seed::rng("cost.plane", z as u64);
            let mut place = || rng.random_range(-2.0e4..2.0e4);
            let at = |_| Footprint {
                position: dvec3(place(), place(), 4.0 * z as f64 + 1.3),
                dpdx: dvec3(1.3, 0.2, 0.1),
                dpdy: dvec3(0.1, 1.3, 0.2),
            };
            (0..effort.pick(1 << 10, 1 << 14)).map(at).collect()
        };
        Self {
            spread: draw(COARSE, "cost.spread", effort.pick(1 << 12, 1 << 18)),
            moving: draw(COARSE, "cost.moving", effort.pick(1 << 9, 1 << 13)),
            planes: (0..effort.pick(4, 16)).map(plane).collect(),
        }
    }

    /// Measures a threshold.
    #[must_use]
    pub fn law(&self, evaluate: &Evaluate<'_>) -> Law {
        let mut values = evaluate(&self.spread);
        let ks = kolmogorov_smirnov(&mut values).map_or(f64::NAN, |found| found.d);
        let off = |plane: &Vec<_>| {
            let values = evaluate(plane);
            let below = values.iter().filter(|&&value| value < 0.5).count();
            below as f64 / values.len() as f64 - 0.5
        };
        let squares: f64 = self.planes.iter().map(off).map(|off| off * off).sum();
        let share = |step: i32| f64::from(step) / f64::from(STEPS);
        // The tail of Kolmogorov's law is at most 2 exp(-2 n d^2).
        let chance = (libm::log(2.0e6) / (2.0 * values.len() as f64)).sqrt();
        Law {
            ks,
            chance,
            bias: (squares / self.planes.len() as f64).sqrt(),
            flips_per_pixel: self.path(evaluate, |footprint, step| Footprint {
                position: footprint.position + footprint.dpdx * share(step),
                ..*footprint
            }),
            flips_per_octave: self.path(evaluate, |footprint, step| {
                let closer = libm::exp2(-share(step));
                Footprint { dpdx: footprint.dpdx * closer, dpdy: footprint.dpdy * closer, ..*footprint }
            }),
        }
    }

    /// Returns the mean length of the path of a threshold: a fragment with an alpha of any size appears or vanishes as
    /// often as the threshold crosses it, so the mean over alphas is the length.
    fn path(&self, evaluate: &Evaluate<'_>, moved: impl Fn(&Footprint<f64>, i32) -> Footprint<f64>) -> f64 {
        let at = |step: i32| {
            let moved: Vec<_> = self.moving.iter().map(|at| moved(at, step).cast::<f32>().cast()).collect();
            evaluate(&moved)
        };
        let mut before = at(0);
        let mut sum = 0.0;
        for step in 1..=STEPS {
            let after = at(step);
            sum += before.iter().zip(&after).map(|(a, b)| (b - a).abs()).sum::<f64>();
            before = after;
        }
        sum / self.moving.len() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::threshold::hashed::HashedAlpha;
    use crate::threshold::two_scale::Variant;

    #[test]
    fn noise_that_is_not_anchored_flips_all_the_time() {
        let samples = Samples::new(Effort::Quick);
        let listing = HashedAlpha::listing(Variant::Isotropic);
        let anchored = samples
            .law(&|footprints| footprints.iter().map(|footprint| listing.threshold(footprint)).collect());
        let jumping = samples.law(&|footprints| {
            let hash = |x: f64| x * 12_345.678 - (x * 12_345.678).floor();
            footprints.iter().map(|footprint| hash(footprint.position.x + 7.0 * footprint.dpdx.x)).collect()
        });
        // A pixel at a time, an independent value in every step moves by a third.
        assert!(jumping.flips_per_pixel > 4.0, "{jumping:?}");
        assert!(anchored.flips_per_pixel < 0.6 && anchored.flips_per_octave < 2.0, "{anchored:?}");
        assert!(anchored.ks < 0.03 && anchored.ks < anchored.chance, "{anchored:?}");
    }

    #[test]
    fn a_law_that_is_not_uniform_is_seen() {
        let samples = Samples::new(Effort::Quick);
        let half = samples.law(&|footprints| vec![0.25; footprints.len()]);
        assert!(half.ks > 0.7 && half.ks > half.chance && half.bias == 0.5, "{half:?}");
        assert_eq!([half.flips_per_pixel, half.flips_per_octave], [0.0; 2]);
    }
}
