//! Cost against size: time and memory of a chi-square test of the robust threshold over any number of samples.

use super::Effort;
use crate::stats::chi_square;
use crate::threshold::batch::{Batch, Bins, ColumnBuffer};
use crate::threshold::robust::Robust;
use crate::threshold::two_scale::Variant;
use rayon::{ThreadPoolBuildError, ThreadPoolBuilder};
use std::time::Instant;

/// What a number of samples costs.
#[derive(Clone, Debug, PartialEq)]
pub struct Size {
    /// How many thresholds were evaluated and counted.
    pub samples: u64,
    /// On how many threads.
    pub threads: usize,
    /// How long it took, in seconds.
    pub seconds: f64,
    /// The most memory that the process has had so far, in KiB; `None` where the system does not tell.
    pub peak_kib: Option<u64>,
    /// The p-value of their chi-square, both tails; `None` where there are too few samples for the bins.
    pub p: Option<f64>,
}

/// Bins of the test.
const BINS: usize = 1 << 10;

/// The sizes that are measured, smallest first, since memory is that of all before.
#[must_use]
pub fn all_sizes(effort: Effort) -> Vec<u64> {
    (4..=effort.pick(6, 9)).map(|exponent| 10_u64.pow(exponent)).collect()
}

/// Measures one size on a number of threads.
///
/// # Errors
/// If the threads cannot be had.
pub fn size(samples: u64, threads: usize) -> Result<Size, ThreadPoolBuildError> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
    let batch = Batch::new(Robust::new(Variant::Isotropic));
    let start = Instant::now();
    let bins = pool.install(|| {
        batch.stream(
            samples,
            grid,
            || Bins::new(BINS),
            |bins, thresholds| bins.add(batch.isa, thresholds),
            |earlier, later| earlier.merge(&later),
        )
    });
    let tested = chi_square::uniform(bins.counts()).map(|found| found.tails().two_sided_p());
    Ok(Size {
        samples,
        threads,
        seconds: start.elapsed().as_secs_f64(),
        peak_kib: peak_kib(),
        p: tested.ok(),
    })
}

/// Samples a row of the grid has.
const ROW: u64 = 1 << 15;

/// Puts every footprint into a cell of its own of both octaves, at 1024 different weights between them.
///
/// Derivatives run over [1/2, 1), so that coarse cells have a side of 1 and indices are those of the grid.
pub(super) fn grid(first: u64, columns: &mut ColumnBuffer<f32>) {
    let (x, y) = ((first % ROW) as f32 + 0.25, (first / ROW) as f32 + 0.25);
    for (i, column) in columns.position[0].iter_mut().enumerate() {
        *column = x + i as f32;
    }
    columns.position[1].fill(y);
    columns.position[2].fill(0.25);
    for (i, column) in columns.dpdx[0].iter_mut().enumerate() {
        *column = 0.5 + (i & 1023) as f32 / 2048.0;
    }
    for column in columns.dpdx[1..].iter_mut().chain(&mut columns.dpdy) {
        column.fill(0.0);
    }
}

/// Returns the most memory that the process has held, where Linux tells.
fn peak_kib() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::threshold::footprint::Footprint;
    use std::collections::HashSet;

    #[test]
    fn no_two_samples_of_the_grid_share_a_coarse_cell() {
        let mut seen = HashSet::new();
        for first in (0..4 * ROW).step_by(4096) {
            let mut columns = ColumnBuffer::zeroed(4096);
            grid(first, &mut columns);
            for i in 0..4096 {
                let Footprint { position, dpdx, .. } = columns.columns().footprint(i);
                assert!((0.5..1.0).contains(&dpdx.x));
                assert!(seen.insert(position.floor().to_array().map(|x| x as i32)));
            }
        }
    }

    #[test]
    fn the_number_of_threads_changes_time_only() {
        let [one, two] = [1, 2].map(|threads| size(300_000, threads).unwrap());
        assert_eq!(one.p, two.p);
        assert!(one.p.is_some_and(|p| p > 1e-4), "{one:?}");
        assert!(one.seconds > 0.0);
    }
}
