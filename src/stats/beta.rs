//! Tails of the beta law and of the two that rest on it: Student's t and Fisher's F.

use super::Tails;
use super::binomial::binomial_density;

/// Gives both tails of Fisher's F at `f`, with `dof` degrees of freedom above and below the line.
///
/// True tails: relative error below 1e-10 down to 1e-300, for up to a million degrees of freedom.
///
/// # Panics
/// If `f` is negative or NaN, or a number of degrees of freedom is 0.
#[must_use]
pub fn f_tails(f: f64, dof: [u64; 2]) -> Tails {
    assert!(f >= 0.0, "F {f}");
    assert!(dof[0] > 0 && dof[1] > 0, "{dof:?} degrees of freedom");
    let [above, below] = dof.map(|dof| dof as f64);
    if f.is_infinite() {
        return Tails { lower: 1.0, upper: 0.0 };
    }
    // The share of the numerator in the sum of squares.
    let (share, rest) = (above * f / (above * f + below), below / (above * f + below));
    Tails {
        lower: regularized(0.5 * above, 0.5 * below, share, rest),
        upper: regularized(0.5 * below, 0.5 * above, rest, share),
    }
}

/// Gives the probability that a score of Student's law with `dof` degrees of freedom is at least `|t|` away
/// from 0, on either side.
///
/// A true tail, as accurate as [`f_tails`]: the square of such a score is an F with 1 and `dof` degrees.
///
/// # Panics
/// If `t` is NaN or `dof` is 0.
#[must_use]
pub fn student_two_sided_p(t: f64, dof: u64) -> f64 {
    f_tails(t * t, [1, dof]).upper
}

/// The incomplete beta function I_x(a, b) for x + y = 1: the probability that a beta variable is at most x.
///
/// By Lentz's method for its continued fraction, which takes some sqrt(a + b) steps.
fn regularized(a: f64, b: f64, x: f64, y: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    if y <= 0.0 {
        return 1.0;
    }
    if x * (a + b + 2.0) > a + 1.0 {
        return 1.0 - regularized(b, a, y, x);
    }
    // x^a y^b / (a B(a, b))
    let front = binomial_density(a, b, x, y) * b / (a + b);
    let (mut c, mut d) = (1.0, 1.0 / (1.0 - (a + b) * x / (a + 1.0)));
    let mut fraction = d;
    for step in 1.. {
        let m = f64::from(step);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        let before = fraction;
        for numerator in [even, odd] {
            d = 1.0 / (1.0 + numerator * d);
            c = 1.0 + numerator / c;
            fraction *= c * d;
        }
        if (fraction - before).abs() <= 1e-16 * fraction.abs() || step == 1_000_000 {
            break;
        }
    }
    (front * fraction).min(1.0)
}
