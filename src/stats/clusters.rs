//! Events on a lattice that come in blocks: the variance of their number in a block, against independent events.

use super::normal;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Variance of the number of events in a block below which its law is too far from a normal one.
const LEAST_VARIANCE: f64 = 4.0;

/// Fewest blocks whose numbers make a variance.
const FEWEST_BLOCKS: usize = 16;

/// What was found in blocks of one shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clusters {
    /// Cells of a block.
    pub cells: usize,
    /// Variance of the number of events in a block over that of independent events with the same mean.
    pub ratio: f64,
    /// Standard error of the ratio where events are independent.
    pub sigma: f64,
    /// Probability of a ratio as large or larger where events are independent.
    pub p: f64,
}

impl Clusters {
    /// Returns the mean correlation of two events of a block that makes the ratio what it is; negative where events keep apart.
    #[must_use]
    pub fn correlation(&self) -> f64 {
        (self.ratio - 1.0) / (self.cells - 1) as f64
    }

    /// Returns the correlation of two events of a block that is found at level `level` with probability `power`.
    ///
    /// The variance of the ratio grows with its square. Infinite where there are too few blocks for any.
    #[must_use]
    pub fn detectable(&self, level: f64, power: f64) -> f64 {
        let bound = 1.0 - self.sigma * normal::quantile(level);
        let error = 1.0 - self.sigma * normal::quantile(power);
        if error <= 0.0 { f64::INFINITY } else { (bound / error - 1.0) / (self.cells - 1) as f64 }
    }
}

/// Compares the number of events in blocks of `shape` with that of independent events, whatever their mean.
///
/// `events` lie on a lattice of `size`, the first axis the fastest; blocks do not overlap, and cells that fill no block are left
/// out. Given how many events there are in all, the squares of the differences to the mean have the mean `blocks - 1` where
/// they are divided by the variance of a block; their sum is taken for a multiple of chi-square with the same variance, which
/// has the fourth moment of binomial numbers in it.
///
/// `None` where no two events can be told apart: fewer than 16 blocks, or a variance in a block below 4.
///
/// # Panics
/// If there are not as many events as cells, or a side of a block is 0.
///
/// ```
/// use hashed_alpha::stats::clusters::clusters;
///
/// // Rows of eight events and rows of eight without, in turn.
/// let events: Vec<bool> = (0..64 * 64).map(|cell| cell / 8 % 2 == 0).collect();
/// let found = clusters(&events, [64, 64, 1], [8, 8, 1]).expect("events enough");
/// assert!(found.p < 1e-100 && found.correlation() > 0.9);
/// ```
#[must_use]
pub fn clusters(events: &[bool], size: [usize; 3], shape: [usize; 3]) -> Option<Clusters> {
    assert_eq!(events.len(), size.iter().product::<usize>(), "one event a cell of {size:?}");
    let along: [usize; 3] = core::array::from_fn(|axis| size[axis] / shape[axis]);
    let blocks: usize = along.iter().product();
    let cells: usize = shape.iter().product();
    if blocks < FEWEST_BLOCKS {
        return None;
    }
    let mut counts = vec![0_u32; blocks];
    for z in 0..along[2] * shape[2] {
        for y in 0..along[1] * shape[1] {
            let row = size[0] * (y + size[1] * z);
            let block = along[0] * (y / shape[1] + along[1] * (z / shape[2]));
            for x in 0..along[0] * shape[0] {
                counts[block + x / shape[0]] += u32::from(events[row + x]);
            }
        }
    }
    let all = (blocks * cells) as f64;
    let total: f64 = counts.iter().map(|&count| f64::from(count)).sum();
    let share = total / all;
    let variance = cells as f64 * share * (1.0 - share);
    if variance < LEAST_VARIANCE {
        return None;
    }
    let mean = cells as f64 * share;
    let squares: f64 =
        counts.iter().map(|&count| (f64::from(count) - mean) * (f64::from(count) - mean)).sum();
    // Drawn without replacement: the variance of a block's number is smaller by what the others leave.
    let expected = (blocks - 1) as f64 * all / (all - 1.0);
    let ratio = squares / variance / expected;
    let excess = (1.0 - 6.0 * share * (1.0 - share)) / variance;
    let relative_variance = (2.0 + excess) / (blocks - 1) as f64;
    let dof = 2.0 / relative_variance;
    let p = ChiSquared::new(dof).map_or(1.0, |law| law.sf(ratio * dof));
    Some(Clusters { cells, ratio, sigma: relative_variance.sqrt(), p })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::seed;

    /// Independent events of a share, in blocks of 8 x 8; with `common`, the share is as much larger or smaller in each block.
    fn found(seed: u64, share: f64, common: f64) -> Clusters {
        let mut rng = seed::rng("clusters.tests", seed);
        let blocks: Vec<f64> =
            (0..64).map(|_| share + if seed::uniform01(&mut rng) < 0.5 { common } else { -common }).collect();
        let is_event = |at: usize| {
            let (x, y) = (at % 64, at / 64);
            seed::uniform01(&mut rng) < blocks[x / 8 + 8 * (y / 8)]
        };
        let events: Vec<bool> = (0..64 * 64).map(is_event).collect();
        clusters(&events, [64, 64, 1], [8, 8, 1]).unwrap()
    }

    #[test]
    fn independent_events_are_calibrated() {
        for share in [0.12, 0.2, 0.5] {
            let below = |level: f64| (0..1000).filter(|&seed| found(seed, share, 0.0).p < level).count();
            let (tenth, hundredth) = (below(0.1), below(0.01));
            assert!((60..=145).contains(&tenth) && hundredth <= 24, "{share}: {tenth}, {hundredth} of 1000");
        }
    }

    #[test]
    fn a_common_share_is_the_correlation_that_is_told() {
        // The variance of the share over that of an event.
        let expected = 0.01 / 0.16;
        let mean: f64 = (0..200).map(|seed| found(seed, 0.2, 0.1).correlation()).sum::<f64>() / 200.0;
        assert!((mean / expected - 1.0).abs() < 0.1, "{mean}, {expected}");
    }

    #[test]
    fn a_correlation_of_the_detectable_size_is_found() {
        let size = found(0, 0.2, 0.0).detectable(1.0e-6, 0.999);
        let common = (size * 0.16).sqrt();
        let missed = (0..300).filter(|&seed| found(seed, 0.2, common).p > 1.0e-6).count();
        assert!(missed <= 3, "{missed} of 300 at {size}");
    }

    #[test]
    fn too_few_events_say_nothing() {
        assert_eq!(clusters(&[false; 4096], [64, 64, 1], [8, 8, 1]), None);
        assert_eq!(clusters(&[true; 64], [8, 8, 1], [4, 4, 1]), None);
    }
}
