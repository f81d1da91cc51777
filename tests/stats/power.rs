//! `stats::power`.

use super::calibration::assert_close;
use hashed_alpha::stats::power::*;
use hashed_alpha::stats::seed::{rng, uniform01};
use hashed_alpha::stats::{binomial, chi_square};

/// scipy: brentq of ncx2.sf(chi2.isf(alpha, dof), dof, λ) - power.
#[test]
fn noncentralities_match_a_reference() {
    for (dof, alpha, power, lambda) in GOLDEN {
        assert_close(noncentrality(dof, alpha, power), lambda, 1e-8);
    }
    assert_eq!(noncentrality(63, 0.1, 0.1), 0.0);
}

const GOLDEN: [(u64, f64, f64, f64); 12] = [
    (1, 1e-9, 0.999, 84.63342233088315),
    (1, 1e-12, 0.999, 104.46350886104031),
    (15, 1e-9, 0.999, 119.87979149556763),
    (15, 1e-6, 0.999, 95.85196266009909),
    (15, 1e-4, 0.9, 47.58788855096912),
    (63, 1e-9, 0.999, 172.08486843628512),
    (255, 1e-9, 0.999, 276.0316049650158),
    (255, 1e-4, 0.9, 133.48992291051053),
    (1023, 1e-9, 0.999, 482.82910506672465),
    (1023, 1e-12, 0.999, 544.9231600141277),
    (2000, 1e-9, 0.999, 646.9528213573628),
    (2000, 1e-12, 0.999, 727.7312660415835),
];

/// With one degree of freedom the test is the two-sided one of a normal score.
#[test]
fn one_degree_of_freedom_is_a_normal_score() {
    for alpha in [0.01, 1e-6, 1e-12, 1e-300] {
        let shift = detectable_shift_z(1.0, alpha, 0.999);
        assert_close(noncentrality(1, alpha, 0.999), shift * shift, 1e-9);
    }
}

/// sqrt(ln(2e9)/2) + sqrt(ln(2000)/2) = 5.222.
#[test]
fn distances_fall_with_the_root_of_the_sample() {
    assert_close(detectable_distance_ks(1_000_000, 1e-9, 0.999), 5.2219e-3, 1e-4);
}

/// At the detectable effect the test rejects as often as promised: 2000 runs at power .9, level .001.
#[test]
fn the_promised_power_is_met() {
    let (alpha, power, n, bins) = (1e-3, 0.9, 4000, 16);
    let w2 = detectable_effect_chi_square(bins - 1, n, alpha, power);
    // Even bins are up and odd ones down by the same factor: w² is its square.
    let tilt = w2.sqrt();
    let mut rng = rng("stats.power.chi_square", 0);
    let rejections = (0..2000)
        .filter(|_| {
            let mut counts = [0; 16];
            for _ in 0..n {
                let pair = 2 * (uniform01(&mut rng) * 8.0) as usize;
                counts[pair + usize::from(uniform01(&mut rng) >= 0.5 * (1.0 + tilt))] += 1;
            }
            chi_square::uniform(&counts).unwrap().p <= alpha
        })
        .count();
    let (low, high) = binomial::clopper_pearson(rejections as u64, 2000, 1e-6);
    assert!(low < power + 0.01 && high > power - 0.01, "{rejections} of 2000");
}
