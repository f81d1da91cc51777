//! What the first two layers of a pixel have in common.

use crate::render::draw::fragments::Fragments;
use crate::render::draw::rasterise::TILE;
use core::num::NonZeroU32;

/// Sums over the pixels in which two layers or more have an alpha between 0 and 1, the first two by distance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LayerSums {
    /// Of the products of what each shows beyond its alpha.
    pub covariance: f64,
    /// Of the products of the standard deviations that a fair test would have.
    pub deviation: f64,
}

/// Sums over the pixels of a tile, after the test.
pub(in crate::render) fn layer_sums(
    fragments: &Fragments,
    alpha: &[f32],
    kept: &[u64],
    samples: NonZeroU32,
) -> LayerSums {
    const NONE: u32 = u32::MAX;
    let mut first = vec![[NONE; 2]; (TILE * TILE) as usize];
    let depth = |at: u32| fragments.depth[at as usize];
    for at in 0..fragments.len() as u32 {
        let [near, far] = &mut first[usize::from(fragments.pixel[at as usize])];
        if *near == NONE || depth(at) < depth(*near) {
            (*far, *near) = (*near, at);
        } else if *far == NONE || depth(at) < depth(*far) {
            *far = at;
        }
    }
    let mut sums = LayerSums::default();
    for pair in first.iter().filter(|pair| pair[1] != NONE) {
        let alphas = pair.map(|at| {
            // What a fragment covers in the mean, if it covers a part of its pixel only.
            let share = fragments.coverage.get(at as usize).unwrap_or(&1.0);
            share * f64::from(alpha[at as usize])
        });
        if alphas.iter().any(|alpha| !(0.01..=0.99).contains(alpha)) {
            continue;
        }
        // Over the samples of the pixel that both cover, so that what two layers show at one sample counts.
        let [a, b] = pair.map(|at| kept[at as usize]);
        let all = u64::MAX >> (u64::BITS - samples.get());
        let both = pair.iter().fold(all, |all, &at| all & fragments.covered.get(at as usize).unwrap_or(&all));
        if both == 0 {
            continue;
        }
        let share = |mask: u64| f64::from((mask & both).count_ones()) / f64::from(both.count_ones());
        let [p, q] = alphas;
        sums.covariance += share(a & b) - p * share(b) - q * share(a) + p * q;
        sums.deviation += (p * (1.0 - p) * q * (1.0 - q)).sqrt();
    }
    sums
}
