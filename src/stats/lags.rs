//! Does a block of values repeat itself, at any distance? All circular lags at once, by Fourier transforms.
//!
//! The values of a block of three axes are compared with themselves shifted by every lag, around the ends: each lag has as
//! many pairs as the block has values. Five statistics a lag, all of which a copy or a dependence of some kind shows in:
//!
//! * the plain correlation of the values, a normal score;
//! * with phases phi = exp(2 pi i k h), k = 1 and 2, the sum of phi(c + d) conj phi(c), which sees a constant difference
//!   modulo 1, and that of phi(c + d) phi(c), which sees a constant sum: squared and divided by the number of pairs, an
//!   exponential value of mean 1.
//!
//! **The law.** For independent values that are uniform on `[0, 1)`, or on equally spaced points in it, the terms of each
//! sum are uniform phases, of which any are independent that do not go around a cycle of the lag. A lag that is its own
//! opposite counts every pair twice and is left out. Sums at different lags are uncorrelated but not independent, so that the
//! p-value of the worst is that of Bonferroni. Mean and variance are those of the block: a law of single values that is
//! not uniform is no repeat.

use super::transform::{opposite, place, signed, transform};
use super::{StatsError, normal};
use core::f64::consts::TAU;
use rustfft::num_complex::Complex64;
use rustfft::{FftDirection, FftPlanner};

/// What two values at a lag have to do with each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Relation {
    /// They are correlated.
    Correlation,
    /// Their difference times `harmonic`, modulo 1, prefers some values.
    Difference {
        /// 1 or 2.
        harmonic: u8,
    },
    /// Their sum times `harmonic`, modulo 1, prefers some values.
    Sum {
        /// 1 or 2.
        harmonic: u8,
    },
}

/// Holds the lag that stands out most in one block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorstLag {
    /// The lag along the three axes, each in `(-n/2, n/2]` for an axis of n values.
    pub lag: [i64; 3],
    /// In what it stands out.
    pub relation: Relation,
    /// Correlation, or length of the mean phase, in `[0, 1]`.
    pub strength: f64,
    /// Probability of as much at this lag and in this relation.
    pub p: f64,
    /// Lags times relations that were looked at: `p` times this is the p-value of the block.
    pub tests: u64,
}

/// Finds the circular lag at which the values of a block are least independent.
///
/// `values` holds `size[0] * size[1] * size[2]` values in `[0, 1]`, the first axis the fastest. Up to `tolerated`, in `[0, 1]`, a
/// correlation or a mean phase is no tie: the p-value is a bound of the probability of what was found if the true one is as large.
///
/// # Errors
/// [`StatsError::LengthMismatch`] if the block has another size, [`StatsError::Empty`] if no lag is left,
/// [`StatsError::Constant`] if all values are equal, [`StatsError::NotFinite`] with a value that is NaN or infinite.
pub fn worst_lag(values: &[f64], size: [usize; 3], tolerated: f64) -> Result<WorstLag, StatsError> {
    let n = size.iter().product();
    if values.len() != n {
        return Err(StatsError::LengthMismatch { left: values.len(), right: n });
    }
    if let Some(&value) = values.iter().find(|value| !value.is_finite()) {
        return Err(StatsError::NotFinite { value });
    }
    let mut planner = FftPlanner::new();
    let mut search = Search { size, tolerated, tests: 0, worst: None };
    let plain = spectrum(values, size, &mut planner, |value| Complex64::new(value, 0.0))?;
    let correlations = transform(powers(&plain, None), size, FftDirection::Inverse, &mut planner);
    // Half of the two-sided tail belongs to each sign; the score is the square, which orders alike.
    search.visit(&correlations, Relation::Correlation, |z| z.re * z.re, |z| normal::two_sided_p(z.sqrt()));
    drop((plain, correlations));
    let phases = [1, 2].map(|harmonic| {
        spectrum(values, size, &mut planner, |value| Complex64::cis(TAU * f64::from(harmonic) * value))
    });
    let [first, second] = phases;
    let (first, second) = (first?, second?);
    // Both are real, so that one transform gives the sums of both harmonics.
    let both = transform(powers(&first, Some(&second)), size, FftDirection::Inverse, &mut planner);
    let back = |at: usize| both[opposite(at, size)].conj();
    let harmonics: [Vec<Complex64>; 2] = [
        both.iter().enumerate().map(|(at, z)| 0.5 * (z + back(at))).collect(),
        both.iter().enumerate().map(|(at, z)| Complex64::new(0.0, -0.5) * (z - back(at))).collect(),
    ];
    for (harmonic, sums) in (1..).zip(&harmonics) {
        search.visit(sums, Relation::Difference { harmonic }, Complex64::norm_sqr, |e| libm::exp(-e));
    }
    drop((both, harmonics));
    for (harmonic, phases) in (1..).zip([first, second]) {
        let products = phases.iter().enumerate().map(|(at, z)| z * phases[opposite(at, size)]).collect();
        let sums = transform(products, size, FftDirection::Inverse, &mut planner);
        search.visit(&sums, Relation::Sum { harmonic }, Complex64::norm_sqr, |e| libm::exp(-e));
    }
    let tests = search.tests;
    search.worst.map(|worst| WorstLag { tests, ..worst }).ok_or(StatsError::Empty)
}

/// The transform of a function of the values, centred, and scaled so that the sum over the pairs of a lag, out of the
/// transform back, has a variance of 1.
fn spectrum(
    values: &[f64],
    size: [usize; 3],
    planner: &mut FftPlanner<f64>,
    of: impl Fn(f64) -> Complex64,
) -> Result<Vec<Complex64>, StatsError> {
    let field: Vec<Complex64> = values.iter().map(|&value| of(value)).collect();
    let n = field.len() as f64;
    let mean = field.iter().sum::<Complex64>() / n;
    let variance = field.iter().map(|z| (z - mean).norm_sqr()).sum::<f64>() / n;
    // What the rounding of a mean leaves of a constant is no variance.
    if variance <= 1e-20 {
        return Err(StatsError::Constant);
    }
    // A sum over n pairs has n times the squared variance; the transform back adds a factor of n.
    let scale = 1.0 / (variance.sqrt() * libm::pow(n, 0.75));
    let centred = field.into_iter().map(|z| (z - mean) * scale).collect();
    Ok(transform(centred, size, FftDirection::Forward, planner))
}

/// The power of one spectrum, and `i` times that of another.
fn powers(real: &[Complex64], imaginary: Option<&[Complex64]>) -> Vec<Complex64> {
    let power = |at: usize| {
        Complex64::new(real[at].norm_sqr(), imaginary.map_or(0.0, |spectrum| spectrum[at].norm_sqr()))
    };
    (0..real.len()).map(power).collect()
}

/// What has been found so far.
struct Search {
    size: [usize; 3],
    tolerated: f64,
    tests: u64,
    worst: Option<WorstLag>,
}

impl Search {
    /// Looks at the sums of all lags, one of each two opposite ones, for the largest score.
    fn visit(
        &mut self,
        sums: &[Complex64],
        relation: Relation,
        score: impl Fn(&Complex64) -> f64,
        p: impl Fn(f64) -> f64,
    ) {
        let mut worst = (0, -1.0);
        for (at, sum) in sums.iter().enumerate() {
            if at < opposite(at, self.size) {
                self.tests += 1;
                let score = score(sum);
                if score > worst.1 {
                    worst = (at, score);
                }
            }
        }
        let (at, score) = worst;
        if score < 0.0 {
            return;
        }
        let n = sums.len() as f64;
        let strength = (score / n).sqrt();
        // A normal score, or the length of a complex one, around the tolerated mean: the tail of the latter is below that of its
        // distance from there (Marcum's Q).
        let beyond = (strength - self.tolerated).max(0.0);
        let p = p(beyond * beyond * n);
        if self.worst.is_none_or(|found| p < found.p) {
            let [x, y, z] = place(at, self.size);
            let [nx, ny, nz] = self.size;
            let lag = [signed(x, nx), signed(y, ny), signed(z, nz)];
            self.worst = Some(WorstLag { lag, relation, strength, p, tests: 0 });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::seed;

    fn uniform(seed: u64, n: usize) -> Vec<f64> {
        let mut rng = seed::rng("lags.tests", seed);
        (0..n).map(|_| seed::uniform01(&mut rng)).collect()
    }

    #[test]
    fn sums_are_those_of_the_definition() {
        let size = [8, 4, 2];
        let values = uniform(0, 64);
        let found = worst_lag(&values, size, 0.0).unwrap();
        let mean = values.iter().sum::<f64>() / 64.0;
        let variance = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / 64.0;
        let phase = |harmonic: u8, v: f64| Complex64::cis(TAU * f64::from(harmonic) * v);
        let mut best = f64::INFINITY;
        for lag in 1..64 {
            if lag >= opposite(lag, size) {
                continue;
            }
            let [lx, ly, lz] = place(lag, size);
            let pair = |at: usize| {
                let [x, y, z] = place(at, size);
                [values[at], values[(x + lx) % 8 + 8 * ((y + ly) % 4 + 4 * ((z + lz) % 2))]]
            };
            let r: f64 = (0..64).map(pair).map(|[a, b]| (a - mean) * (b - mean)).sum::<f64>() / variance;
            best = best.min(normal::two_sided_p(r / 8.0));
            for harmonic in [1, 2] {
                let all: Vec<Complex64> = values.iter().map(|&v| phase(harmonic, v)).collect();
                let mean = all.iter().sum::<Complex64>() / 64.0;
                let variance = all.iter().map(|z| (z - mean).norm_sqr()).sum::<f64>() / 64.0;
                let sum = |other: fn(Complex64) -> Complex64| {
                    let terms = (0..64)
                        .map(pair)
                        .map(|[a, b]| (phase(harmonic, b) - mean) * other(phase(harmonic, a) - mean));
                    terms.sum::<Complex64>().norm_sqr() / (64.0 * variance * variance)
                };
                best = best.min(libm::exp(-sum(|z| z.conj()))).min(libm::exp(-sum(|z| z)));
            }
        }
        assert!((found.p / best - 1.0).abs() < 1e-9, "{found:?}, {best}");
        assert_eq!(found.tests, 5 * (64 - 8) / 2);
    }

    #[test]
    fn every_relation_is_seen_where_it_is() {
        let size = [16, 16, 8];
        let n = size.iter().product();
        let free = uniform(1, n);
        let tied = |tie: fn(f64, f64) -> f64| -> Vec<f64> {
            // Every other layer is tied to the one below, (3, 2, 1) behind.
            (0..n)
                .map(|at| {
                    let [x, y, z] = place(at, size);
                    let behind = (x + 13) % 16 + 16 * ((y + 14) % 16 + 16 * ((z + 7) % 8));
                    if z % 2 == 0 { tie(free[behind], free[at]) } else { free[at] }
                })
                .collect()
        };
        for (tie, relation) in [
            ((|a, _| a) as fn(f64, f64) -> f64, Relation::Difference { harmonic: 1 }),
            (|a, _| (a + 0.25) - libm::floor(a + 0.25), Relation::Difference { harmonic: 1 }),
            (|a, _| 1.0 - a, Relation::Sum { harmonic: 1 }),
            (|a, b| 0.5 * (a + (2.0 * b).floor()), Relation::Correlation),
        ] {
            let found = worst_lag(&tied(tie), size, 0.0).unwrap();
            let (there, back) = ([3, 2, 1], [-3, -2, -1]);
            assert!(found.lag == there || found.lag == back, "{found:?} is not {relation:?}");
            assert!(found.p * (found.tests as f64) < 1e-9, "{found:?}");
        }
    }

    #[test]
    fn independent_values_are_calibrated() {
        let p = |seed: u64| {
            let found = worst_lag(&uniform(seed, 1 << 10), [16, 8, 8], 0.0).unwrap();
            found.p * found.tests as f64
        };
        let below = |level: f64| (100..600).filter(|&seed| p(seed) < level).count();
        // Bonferroni over half of the lags is a little conservative.
        let tenth = below(0.1);
        assert!((20..=75).contains(&tenth), "{tenth} of 500");
    }

    #[test]
    fn what_cannot_be_judged_is_an_error() {
        assert_eq!(worst_lag(&[0.5; 8], [2, 2, 2], 0.0), Err(StatsError::Constant));
        assert_eq!(worst_lag(&uniform(0, 8), [2, 2, 2], 0.0), Err(StatsError::Empty));
        assert!(worst_lag(&[0.5; 7], [2, 2, 2], 0.0).is_err());
    }

    /// A tie of the tolerated strength comes out below a level no more often than that; a stronger one is seen.
    #[test]
    fn a_tolerated_tie_is_none() {
        let size = [64, 32, 32];
        let tied = |seed: u64, strength: f64| {
            let (free, coins) = (uniform(seed, 1 << 16), uniform(seed + 1000, 1 << 16));
            let copy = |at: usize| if coins[at] < strength { free[at - 1] } else { free[at] };
            let values: Vec<f64> = core::iter::once(free[0]).chain((1..1 << 16).map(copy)).collect();
            let found = worst_lag(&values, size, 0.02).unwrap();
            found.p * found.tests as f64
        };
        let below = (0..40).filter(|&seed| tied(seed, 0.02) < 0.05).count();
        assert!(below <= 8, "{below} of 40");
        assert!(tied(1, 0.08) < 1e-9);
    }
}
