//! Values that come up more often than their share.

use super::cells::at_scale;
use super::uniform::reject_outsiders;
use super::{Attempt, Claim, Conclusion, Trial};
use crate::check::tolerance::{ATOM_BLOCK, ATOM_THRESHOLD, POWER, SINGLE_LEVEL, SPREAD};
use crate::check::{Evidence, Subject, Verdict};
use crate::stats::{binomial, seed};
use crate::threshold::footprint::Footprint;
use glam::{DVec3, dvec3};

/// Thresholds next to zero, which keep what is all but transparent.
pub const ZERO: Claim = Claim {
    id: "atoms.zero",
    anchor: "§5.1, §5 (the clamp of Listing 1)",
    statement: "where one octave has all the weight, thresholds up to 1e-5 come up with that probability",
    expected: Verdict::Consistent,
    run: zero,
};

fn zero(subject: &Subject<'_>, seed: u64) -> Attempt<Trial> {
    let mut rng = seed::rng(ZERO.id, seed);
    // Every cell of a block once, at a scale of 1: the finer octave has no weight.
    let corner = dvec3(seed::uniform01(&mut rng), seed::uniform01(&mut rng), seed::uniform01(&mut rng));
    let corner = (corner * SPREAD).floor() + DVec3::splat(0.25);
    let [nx, ny, nz] = ATOM_BLOCK;
    let mut low = 0;
    for z in 0..nz {
        let layer: Vec<Footprint<f64>> = (0..nx * ny)
            .map(|i| corner + dvec3(f64::from(i % nx), f64::from(i / nx), f64::from(z)))
            .map(|position| at_scale(subject.variant, subject.hash_scale, position, [0.0; 3]))
            .map(|footprint| subject.precision.round(&footprint))
            .collect();
        let values = subject.thresholds(&layer);
        reject_outsiders(&layer, &values)?;
        low += values.iter().filter(|&&value| value <= ATOM_THRESHOLD).count() as u64;
    }
    let n = u64::from(nx) * u64::from(ny) * u64::from(nz);
    let mean = n as f64 * ATOM_THRESHOLD;
    let times = low as f64 / mean;
    Ok(Trial {
        conclusion: Conclusion::Probability(binomial::poisson_upper_p(low, mean)),
        statistic: Some(low as f64),
        statistic_name: format!("thresholds up to {ATOM_THRESHOLD:e}, {mean:.1} expected"),
        n,
        effect: Some(times),
        effect_name: "times as often as expected",
        detectable: Some(detectable(mean)),
        seen: format!(
            "{low} of {n} thresholds are up to {ATOM_THRESHOLD:e}, {times:.0} times as many as expected"
        ),
        evidence: Evidence::None,
    })
}

/// The smallest excess of a Poisson count of this mean that would be seen, as a factor.
fn detectable(mean: f64) -> f64 {
    let critical =
        (0..).find(|&count| binomial::poisson_upper_p(count, mean) < SINGLE_LEVEL).unwrap_or(u64::MAX);
    let unseen = |factor: f64| binomial::poisson_lower_p(critical - 1, factor * mean);
    (4..)
        .map(|quarter| f64::from(quarter) / 4.0)
        .find(|&factor| unseen(factor) <= 1.0 - POWER)
        .unwrap_or(f64::INFINITY)
}
