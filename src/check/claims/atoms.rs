//! Values that come up more often than their share.

use crate::check::input::{Start, at_scale};
use crate::check::judge::detectable_factor;
use crate::check::tolerance::{POWER, SINGLE_LEVEL, SPREAD};
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::scene::Fragment;
use crate::stats::{binomial, power, seed};
use glam::{DVec3, dvec3};
use rand::rngs::Xoshiro256PlusPlus;

/// The threshold up to which values are counted: ten times the clamp of the listings, a hundred steps of the lattice.
const ATOM_THRESHOLD: f64 = 1.0e-5;

/// Cells of the block in which they are counted: 2^20 in all, ten expected values; sees a rate six times too high, a
/// seventh of that of the `f32` sine hash.
const ATOM_BLOCK: [u32; 3] = [64, 128, 128];

/// Most layers of the block when it grows: 2^33 cells, whose indices stay below 2^21, where the robust threshold begins to
/// enlarge its cells.
const MOST_LAYERS: usize = 1 << 20;

/// An end of the range: one step of the coarsest grid of the `f32` sine hash.
const END: f64 = 1.0 / 1024.0;

/// How near to an end values are looked at for the steps in which they are stored.
const NEAR_END: f64 = 4.0 * END;

/// Values near an end after which no more are looked at: every step of 16 bits has come up.
const NEAR_VALUES: usize = 1 << 12;

/// Layers of the block of cells in which the ends are counted: 256 expected at each end.
const END_LAYERS: u32 = ATOM_BLOCK[2] / 4;

/// Thresholds next to zero, which keep what is all but transparent.
pub const ZERO: Claim = Claim {
    id: "atoms.zero",
    anchor: "§5.1, §5 (the clamp of Listing 1)",
    statement: "where one octave has all the weight, thresholds up to 1e-5 come up no more often than that",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(6.0)),
    run: zero,
};

/// Both ends of the range, each of the size of one step of the coarsest grid on which the `f32` sine hash lies.
pub const ENDS: Claim = Claim {
    id: "atoms.ends",
    anchor: "§5 (thresholds in [0, 1))",
    statement: "the lowest and the highest 2^-10 of the range come up with that probability, no more and no less",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.6)),
    run: ends,
};

/// Evaluates every cell of `layers` layers of a block once, at a scale of 1, where the finer octave has no weight, and
/// hands over the thresholds layer by layer; returns their number.
fn block_of_cells(
    subject: &Subject<'_>,
    layers: u32,
    mut rng: Xoshiro256PlusPlus,
    mut use_layer: impl FnMut(&[f64]),
) -> Attempt<u64> {
    let corner = dvec3(seed::uniform01(&mut rng), seed::uniform01(&mut rng), seed::uniform01(&mut rng));
    let corner = (corner * SPREAD).floor() + DVec3::splat(0.25);
    let [nx, ny, _] = ATOM_BLOCK;
    for z in 0..layers {
        let layer: Vec<Fragment> = (0..nx * ny)
            .map(|i| corner + dvec3(f64::from(i % nx), f64::from(i / nx), f64::from(z)))
            .map(|position| at_scale(subject.variant, subject.hash_scale, position, [0.0; 3]))
            .map(|footprint| Start::draw(&mut rng).seeing(subject.precision.round(&footprint)))
            .collect();
        let values = subject.thresholds(&layer);
        reject_outsiders(subject, &layer, &values)?;
        use_layer(&values);
    }
    Ok(u64::from(nx) * u64::from(ny) * u64::from(layers))
}

/// Layers of a block: no fewer than [`Budget::Ci`](crate::check::Budget::Ci) has, and no more than [`MOST_LAYERS`].
fn layers(draw: &Draw, at_ci: u32) -> u32 {
    draw.stream_at_least(at_ci as usize, at_ci as usize).min(MOST_LAYERS) as u32
}

fn zero(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut low = 0;
    let n = block_of_cells(subject, layers(draw, ATOM_BLOCK[2]), draw.rng(ZERO.id), |values| {
        low += values.iter().filter(|&&value| value <= ATOM_THRESHOLD).count() as u64;
    })?;
    let mean = n as f64 * ATOM_THRESHOLD;
    let times = low as f64 / mean;
    Ok(Trial {
        conclusion: Conclusion::Probability(binomial::poisson_upper_p(low, mean)),
        statistic: Some(low as f64),
        statistic_name: format!("thresholds up to {ATOM_THRESHOLD:e}, {mean:.1} expected"),
        n,
        effect: Some(times),
        effect_name: "times as often as expected",
        detectable: Some(detectable_factor(mean)),
        seen: format!(
            "{low} of {n} thresholds are up to {ATOM_THRESHOLD:e}, {times:.0} times as many as expected"
        ),
        evidence: Evidence::None,
    })
}

/// The smallest distance between two different values, at most half of the end; 0 where there is none.
fn step(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    let steps = values.windows(2).map(|pair| pair[1] - pair[0]).filter(|&step| step > 0.0);
    steps.reduce(f64::min).map_or(0.0, |step| step.min(0.5 * END))
}

fn ends(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut counts = [0_u64; 2];
    let mut near: [Vec<f64>; 2] = Default::default();
    let n = block_of_cells(subject, layers(draw, END_LAYERS), draw.rng(ENDS.id), |values| {
        counts[0] += values.iter().filter(|&&value| value < END).count() as u64;
        counts[1] += values.iter().filter(|&&value| value >= 1.0 - END).count() as u64;
        if near.iter().all(|near| near.len() < NEAR_VALUES) {
            near[0].extend(values.iter().filter(|&&value| value < NEAR_END));
            near[1].extend(values.iter().filter(|&&value| value > 1.0 - NEAR_END));
        }
    })?;
    let mean = n as f64 * END;
    // A value that is stored in steps may lie on either side of the end's edge by one of them.
    let steps = near.map(step);
    let p = [0, 1].map(|end| {
        let nearest = (counts[end] as f64 / n as f64).clamp(END - steps[end], END + steps[end]);
        binomial::two_sided_p(counts[end], n, nearest)
    });
    let worst = if p[0] <= p[1] { 0 } else { 1 };
    let share = counts[worst] as f64 / mean;
    let sigma = (mean * (1.0 - END)).sqrt() / mean;
    Ok(Trial {
        conclusion: Conclusion::Probability((2.0 * p[worst]).min(1.0)),
        statistic: Some(counts[worst] as f64),
        statistic_name: format!("thresholds at one end, {mean:.1} expected, worst of 2"),
        n,
        effect: Some((share - 1.0).abs()),
        effect_name: "relative error in their number",
        detectable: Some(power::detectable_shift_z(sigma, SINGLE_LEVEL / 2.0, POWER)),
        seen: format!(
            "{} of {n} thresholds are in the {} 2^-10 of the range, {mean:.0} are expected",
            counts[worst],
            ["lowest", "highest"][worst]
        ),
        evidence: Evidence::None,
    })
}
