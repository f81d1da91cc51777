//! Any number of thresholds on every core (one after the other without the feature `threads`), without holding more of them than fit the second cache.

use super::columns::{ColumnBuffer, Columns};
use super::evaluator::{Batch, Lane};
#[cfg(feature = "threads")]
use rayon::prelude::*;

/// How many footprints are filled in, evaluated and handed on at once: in `f32` nine columns take 144 KiB.
pub const CHUNK: usize = 4096;

/// How many footprints a task has; large enough that the scheduling of tasks does not count.
const TASK: u64 = 1 << 18;

impl Batch {
    /// [`Batch::thresholds`] on every core. The bits do not depend on their number.
    ///
    /// # Panics
    /// If the columns and `out` are not all of one length.
    pub fn par_thresholds<R: Lane>(&self, columns: &Columns<'_, R>, out: &mut [R]) {
        assert!(columns.is_as_long_as(out), "columns of unequal length");
        #[cfg(feature = "threads")]
        let chunks = out.par_chunks_mut(CHUNK);
        #[cfg(not(feature = "threads"))]
        let chunks = out.chunks_mut(CHUNK);
        chunks.enumerate().for_each(|(chunk, out)| {
            let first = chunk * CHUNK;
            self.thresholds(&columns.slice(first..first + out.len()), out);
        });
    }

    /// Evaluates `count` footprints on every core and folds their thresholds into one state.
    ///
    /// `fill(first, columns)` overwrites all of `columns` with the footprints from number `first` on. `visit` sees
    /// their thresholds, up to [`CHUNK`] at a time. States begin as `start()`; `merge` adds a later one to an earlier
    /// one, and must be associative: which neighbours are merged first depends on the number of cores.
    ///
    /// ```
    /// use hashed_alpha::threshold::batch::{Batch, Bins, ColumnBuffer};
    /// use hashed_alpha::threshold::{robust::Robust, two_scale::Variant};
    ///
    /// let batch = Batch::new(Robust::new(Variant::Isotropic));
    /// let fill = |first: u64, columns: &mut ColumnBuffer<f32>| {
    ///     for (i, x) in columns.position[0].iter_mut().enumerate() {
    ///         *x = (first + i as u64) as f32 * 0.01;
    ///     }
    ///     columns.dpdx[0].fill(0.01);
    ///     columns.dpdy[1].fill(0.01);
    /// };
    /// let bins = batch.stream(
    ///     100_000,
    ///     fill,
    ///     || Bins::new(16),
    ///     |bins, thresholds| bins.add(batch.isa, thresholds),
    ///     |earlier, later| earlier.merge(&later),
    /// );
    /// assert_eq!(bins.counts().iter().sum::<u64>(), 100_000);
    /// ```
    pub fn stream<R: Lane, S: Send>(
        &self,
        count: u64,
        fill: impl Fn(u64, &mut ColumnBuffer<R>) + Sync,
        start: impl Fn() -> S + Sync + Send,
        visit: impl Fn(&mut S, &[R]) + Sync,
        merge: impl Fn(&mut S, S) + Sync + Send,
    ) -> S {
        let task = |task: u64| {
            let mut state = start();
            let mut buffer = ColumnBuffer::zeroed(CHUNK);
            let mut thresholds = [R::from_f64(0.0); CHUNK];
            let last = count.min((task + 1) * TASK);
            for first in (task * TASK..last).step_by(CHUNK) {
                let length = (last - first).min(CHUNK as u64) as usize;
                if length < CHUNK {
                    buffer = ColumnBuffer::zeroed(length);
                }
                fill(first, &mut buffer);
                let thresholds = &mut thresholds[..length];
                self.thresholds(&buffer.columns(), thresholds);
                visit(&mut state, thresholds);
            }
            state
        };
        let merged = |mut earlier, later| {
            merge(&mut earlier, later);
            earlier
        };
        let tasks = 0..count.div_ceil(TASK);
        #[cfg(feature = "threads")]
        let whole = tasks.into_par_iter().map(task).reduce(&start, merged);
        #[cfg(not(feature = "threads"))]
        let whole = tasks.map(task).fold(start(), merged);
        whole
    }
}
