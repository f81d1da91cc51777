//! `stats::collisions`.

use super::calibration::assert_close;
use hashed_alpha::stats::Tails;
use hashed_alpha::stats::binomial::{poisson_lower_p, poisson_upper_p};
use hashed_alpha::stats::chi_square;
use hashed_alpha::stats::collisions::*;
use hashed_alpha::stats::seed::{rng, uniform01};

/// Every way to throw 6 values in 4 urns, and 4 in 6.
#[test]
fn small_cases_are_enumerated() {
    for (n, urns) in [(6_u64, 4_u64), (4, 6), (3, 1), (1, 5)] {
        let ways = urns.pow(n as u32);
        let repeats = |way: u64| {
            count_repeats(&mut (0..n).map(|i| way / urns.pow(i as u32) % urns).collect::<Vec<_>>())
        };
        let counts: Vec<u64> = (0..ways).map(repeats).collect();
        let share = |holds: &dyn Fn(u64) -> bool| {
            counts.iter().filter(|&&count| holds(count)).count() as f64 / ways as f64
        };
        for observed in 0..n {
            let found = collisions(observed, n, urns);
            assert!(found.is_exact);
            assert!((found.tails.lower - share(&|count| count <= observed)).abs() < 1e-15);
            assert!((found.tails.upper - share(&|count| count >= observed)).abs() < 1e-15);
            assert_close(found.expected + 1.0, counts.iter().sum::<u64>() as f64 / ways as f64 + 1.0, 1e-14);
        }
    }
}

/// No collision at all: Π (1 - i/k). All in one urn: k^(1-n).
#[test]
fn tails_are_true_tails() {
    let none: f64 = (0..2000).map(|i| 1.0 - f64::from(i) / 10_000.0).product();
    assert_close(collisions(0, 2000, 10_000).tails.lower, none, 1e-12);
    assert_close(collisions(99, 100, 1000).tails.upper, 1e-297, 1e-12);
}

/// Where the exact law is too long to compute, the Poisson law is too wide, by little.
#[test]
fn the_poisson_law_errs_on_the_safe_side() {
    let (n, urns) = (4096, 1 << 20);
    for observed in [2, 13, 19, 24] {
        let exact = collisions(observed, n, urns);
        let z = (observed as f64 - exact.expected) / exact.expected.sqrt();
        let poisson = [poisson_lower_p(observed, exact.expected), poisson_upper_p(observed, exact.expected)];
        let (exact, poisson) =
            if z < 0.0 { (exact.tails.lower, poisson[0]) } else { (exact.tails.upper, poisson[1]) };
        let excess = poisson / exact - 1.0;
        assert!(excess > 0.0 && excess < z * z * n as f64 / urns as f64, "{observed}: {excess}");
    }
}

/// The observed shares of each outcome of 4000 runs follow the law.
fn follows(outcomes: &[u64], law: impl Fn(u64) -> Tails) {
    let share = |count: u64| law(count).upper - law(count + 1).upper;
    let last = outcomes.len() as u64 - 1;
    let expected: Vec<f64> = (0..last).map(share).chain(std::iter::once(law(last).upper)).collect();
    let found = chi_square::against(outcomes, &expected).unwrap();
    assert!(found.p > 1e-4, "{} {outcomes:?}", found.p);
}

fn histogram(mut run: impl FnMut() -> u64) -> Vec<u64> {
    let mut outcomes = vec![0; 16];
    for _ in 0..4000 {
        outcomes[(run() as usize).min(15)] += 1;
    }
    outcomes
}

#[test]
fn an_ideal_source_follows_the_law() {
    let mut source = rng("stats.collisions.ideal", 0);
    let repeats = |rng: &mut _| {
        count_repeats(&mut (0..256).map(|_| (uniform01(rng) * 8192.0) as u64).collect::<Vec<_>>())
    };
    follows(&histogram(|| repeats(&mut source)), |count| collisions(count, 256, 8192).tails);
}

/// Values on one tenth of the urns collide ten times as often; stratified ones never do.
#[test]
fn broken_sources_are_rejected() {
    let mut rng = rng("stats.collisions.broken", 0);
    let mut atoms: Vec<u64> = (0..4096).map(|_| (uniform01(&mut rng) * 26_214.4) as u64 * 10).collect();
    let found = collisions(count_repeats(&mut atoms), 4096, 1 << 18);
    assert!(found.tails.upper < 1e-100);
    let mut strata: Vec<u64> = (0..4096).map(|i| i * 64).collect();
    assert!(collisions(count_repeats(&mut strata), 4096, 1 << 18).tails.lower < 1e-13);
}
