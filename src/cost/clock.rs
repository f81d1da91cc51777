//! Timing in rounds: every contender once a round, in another order each time.
//!
//! A ratio of two times means something where both were taken under the same conditions. So all contenders run in one
//! process and take turns; each gets inputs that it has not seen for many rounds, or a branch predictor would have
//! learnt them and flatter the scalar code by a factor of two; and the inputs are brought into the cache before the
//! clock starts, for all alike.

use crate::stats::seed;
use rand::seq::SliceRandom;
use std::hint::black_box;
use std::time::Instant;

/// Something that is timed.
pub struct Contender<'a> {
    /// How many items one run evaluates.
    pub items: usize,
    /// Evaluates inputs of which there are many, chosen by the number of the round; the result cannot be optimised away.
    pub run: Box<dyn FnMut(usize) -> f64 + 'a>,
    /// Reads the same inputs.
    pub touch: Box<dyn Fn(usize) -> f64 + 'a>,
}

/// What a contender took, in nanoseconds per item.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time {
    /// The fastest round.
    pub min: f64,
    /// The middle one.
    pub median: f64,
}

/// Times contenders in `rounds` rounds, at least one; `after_each` is called after every round.
#[must_use]
pub fn race(contenders: &mut [Contender<'_>], rounds: usize, after_each: impl Fn()) -> Vec<Time> {
    let count = contenders.len();
    let time = |index: usize, round| {
        let Contender { items, run, touch } = &mut contenders[index];
        black_box(touch(round));
        let start = Instant::now();
        black_box(run(round));
        start.elapsed().as_secs_f64() * 1e9 / *items as f64
    };
    turns(count, rounds, time, after_each)
}

/// Lets so many contenders take turns in `rounds` rounds, at least one; `time` runs one in a round and returns what it took,
/// and `after_each` is called after every round.
#[must_use]
pub fn turns(
    contenders: usize,
    rounds: usize,
    mut time: impl FnMut(usize, usize) -> f64,
    after_each: impl Fn(),
) -> Vec<Time> {
    let mut rng = seed::rng("cost.order", 0);
    let mut order: Vec<usize> = (0..contenders).collect();
    let mut times = vec![Vec::with_capacity(rounds); contenders];
    for round in 0..rounds.max(1) {
        order.shuffle(&mut rng);
        for &index in &order {
            times[index].push(time(index, round));
        }
        after_each();
    }
    times.iter_mut().map(|times| summary(times)).collect()
}

fn summary(times: &mut [f64]) -> Time {
    times.sort_by(f64::total_cmp);
    Time { min: times[0], median: times[times.len() / 2] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn every_contender_runs_once_a_round_on_the_inputs_of_the_round() {
        let runs = Cell::new(0_usize);
        let contender = || Contender {
            items: 10,
            run: Box::new(|round| {
                runs.set(runs.get() + 1);
                round as f64
            }),
            touch: Box::new(|_| 0.0),
        };
        let rounds = Cell::new(0);
        let times = race(&mut [contender(), contender()], 7, || rounds.set(rounds.get() + 1));
        assert_eq!((runs.get(), rounds.get(), times.len()), (14, 7, 2));
        assert!(times.iter().all(|time| time.min >= 0.0 && time.min <= time.median));
    }

    #[test]
    fn the_summary_of_times_is_their_least_and_their_middle() {
        assert_eq!(summary(&mut [3.0, 9.0, 1.0]), Time { min: 1.0, median: 3.0 });
    }
}
