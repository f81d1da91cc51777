//! The smallest defect that a test can see.
//!
//! A test that passed says little unless it says what it would have caught. Everything here takes a level
//! `alpha` (the chance to reject a good source) and a `power` (the chance to reject a bad one), and gives how
//! bad the source has to be for a given sample.

use super::binomial::poisson_pmf;
use super::{chi_square, normal};

/// Gives the noncentrality λ at which a chi-square test of level `alpha` rejects with probability `power`.
///
/// λ is n w² for n observations and effect size w². Accurate to a relative 1e-9 for 1 to some 100 000 degrees
/// of freedom and `alpha` down to 1e-300. It is 0 if `power` is not above `alpha`.
///
/// The noncentral law is a Poisson mixture of central ones: chi-square of dof + 2J degrees of freedom, J of
/// mean λ/2.
///
/// # Panics
/// If `dof` is 0, `alpha` or `power` is not in `(0, 1)`, or `power` is above 1 - 1e-9, where digits run out.
#[must_use]
pub fn noncentrality(dof: u64, alpha: f64, power: f64) -> f64 {
    assert!(dof > 0, "no degrees of freedom");
    assert_in_open_unit(alpha);
    assert_in_open_unit(power);
    assert!(power <= 1.0 - 1e-9, "power {power} is too close to 1");
    if power <= alpha {
        return 0.0;
    }
    let critical = crossing(dof as f64, |x| chi_square::upper_p(x, dof) > alpha);
    crossing(1.0, |lambda| noncentral_upper_p(critical, dof, lambda) < power)
}

/// Gives the effect size w² that a chi-square test of `n` observations detects: λ/n.
///
/// # Panics
/// If `n` is 0, and where [`noncentrality`] panics.
#[must_use]
pub fn detectable_effect_chi_square(dof: u64, n: u64, alpha: f64, power: f64) -> f64 {
    assert!(n > 0, "no observations");
    noncentrality(dof, alpha, power) / n as f64
}

/// Gives the shift that a two-sided test of a normal estimate detects: (z of alpha/2 + z of power) sigma.
///
/// `sigma` is the standard error of the estimate; the shift has its unit. Rejections on the wrong side are
/// neglected.
///
/// # Panics
/// If `alpha` or `power` is not in `(0, 1)`.
#[must_use]
pub fn detectable_shift_z(sigma: f64, alpha: f64, power: f64) -> f64 {
    assert_in_open_unit(alpha);
    assert_in_open_unit(power);
    (normal::quantile(power) - normal::quantile(0.5 * alpha)) * sigma
}

/// Gives the distance from uniform that a Kolmogorov-Smirnov test of `n` values is sure to detect.
///
/// The distance is the largest one between the true distribution function and x. A guarantee, not an
/// approximation: by the triangle inequality it is the bound of Dvoretzky, Kiefer, Wolfowitz and Massart at
/// level `alpha` plus the same at level 1 - `power`.
///
/// # Panics
/// If `n` is 0 or `alpha` or `power` is not in `(0, 1)`.
#[must_use]
pub fn detectable_distance_ks(n: u64, alpha: f64, power: f64) -> f64 {
    assert_in_open_unit(alpha);
    assert_in_open_unit(power);
    super::ecdf::dkwm_distance(n, alpha) + super::ecdf::dkwm_distance(n, 1.0 - power)
}

fn assert_in_open_unit(p: f64) {
    assert!(p > 0.0 && p < 1.0, "{p} is not in (0, 1)");
}

/// P(X >= x) for X noncentral chi-square.
fn noncentral_upper_p(x: f64, dof: u64, lambda: f64) -> f64 {
    let mean = 0.5 * lambda;
    // Ten standard deviations of the Poisson law, and twenty for small means: the rest is below 1e-20.
    let reach = 10.0 * mean.sqrt() + 20.0;
    let (first, last) = ((mean - reach).max(0.0) as u64, (mean + reach) as u64);
    // Two more degrees of freedom add one Poisson-like term to the tail, so that one tail gives them all.
    let mut tail = chi_square::upper_p(x, dof + 2 * first);
    let mut sum = 0.0;
    let mut shape = 0.5 * dof as f64 + first as f64;
    let mut step = libm::exp(shape * libm::log(0.5 * x) - 0.5 * x - libm::lgamma(shape + 1.0));
    for j in first..=last {
        sum += poisson_pmf(j, mean) * tail.min(1.0);
        tail += step;
        shape += 1.0;
        step *= 0.5 * x / shape;
    }
    sum
}

/// The point from 0 on where a predicate turns from true to false, to the last bits. `guess` is positive.
fn crossing(guess: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let (mut yes, mut no) = (0.0, guess);
    while holds(no) {
        yes = no;
        no *= 2.0;
    }
    while no - yes > 1e-14 * no {
        let middle = 0.5 * (yes + no);
        if holds(middle) {
            yes = middle;
        } else {
            no = middle;
        }
    }
    no
}
