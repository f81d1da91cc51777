//! Sums of independent gamma values with weights of either sign: what a linear function of a spectrum is.
//!
//! The ordinates of a periodogram, each divided by its expectation, are nearly independent exponential values, gamma values
//! of shape 1 (those that are their own mirror images have shape 1/2). An autocorrelation is a sum of them with the weights
//! of a cosine.
//!
//! Tails come from the saddle point, by Barndorff-Nielsen's formula with Lugannani and Rice's terms. The relative error is
//! below 1e-3 at every level down to 1e-300 where the shapes add up to 50 or more and no term has most of the variance; it
//! falls with the sum of the shapes.

use super::{Tails, normal};

/// Signed root up to which the correction is that of the skewness: the difference of the two logarithms has lost its
/// digits.
const NEAR_THE_MEAN: f64 = 1e-4;

/// One term of a sum: a gamma value with a weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Term {
    /// What the value is multiplied by; not 0.
    pub weight: f64,
    /// Shape of the gamma law, above 0: its mean and its variance.
    pub shape: f64,
}

/// A sum of independent gamma values, less its mean.
#[derive(Debug, Clone, PartialEq)]
pub struct GammaSum {
    terms: Vec<Term>,
    variance: f64,
    skewness: f64,
    /// Weights of largest size on either side of 0, or 0.
    extremes: [f64; 2],
}

/// The sum under the law that is tilted by `exp(at x)`.
struct Saddle {
    at: f64,
    /// The mean of the tilted law: the deviation of which this is the saddle point.
    deviation: f64,
    /// `deviation * at` less the cumulant generating function at `at`.
    exponent: f64,
    /// The variance of the tilted law.
    variance: f64,
}

impl GammaSum {
    /// Adds up terms.
    ///
    /// # Panics
    /// If there is no term, a weight is 0 or not finite, or a shape is not above 0.
    #[must_use]
    pub fn new(terms: Vec<Term>) -> Self {
        assert!(!terms.is_empty(), "a sum without terms");
        for Term { weight, shape } in &terms {
            assert!(*weight != 0.0 && weight.is_finite() && *shape > 0.0, "weight {weight}, shape {shape}");
        }
        let moment = |k: i32| terms.iter().map(|term| term.shape * term.weight.powi(k)).sum::<f64>();
        let variance = moment(2);
        let skewness = 2.0 * moment(3) / (variance * variance.sqrt());
        let extremes = [f64::min, f64::max]
            .map(|of: fn(f64, f64) -> f64| terms.iter().map(|term| term.weight).fold(0.0, of));
        Self { terms, variance, skewness, extremes }
    }

    /// The standard deviation of the sum.
    #[must_use]
    pub fn sigma(&self) -> f64 {
        self.variance.sqrt()
    }

    /// Gives the probabilities of a sum at least as far below, and above, its mean as `deviation`.
    ///
    /// # Panics
    /// If `deviation` is NaN.
    #[must_use]
    pub fn tails(&self, deviation: f64) -> Tails {
        assert!(!deviation.is_nan(), "the deviation is NaN");
        // A sum of weights of one sign has an end.
        let mean: f64 = self.terms.iter().map(|term| term.shape * term.weight).sum();
        if self.extremes[0] == 0.0 && deviation <= -mean {
            return Tails { lower: 0.0, upper: 1.0 };
        }
        if self.extremes[1] == 0.0 && deviation >= -mean {
            return Tails { lower: 1.0, upper: 0.0 };
        }
        self.tails_at(&self.saddle_of(deviation))
    }

    /// Gives how far above the mean the sum is with probability `p` in (0, 1/2), or below it (negative).
    ///
    /// # Panics
    /// If `p` is not in (0, 1/2).
    #[must_use]
    pub fn exceeded(&self, p: f64, above: bool) -> f64 {
        assert!(p > 0.0 && p < 0.5, "{p} is not in (0, 1/2)");
        let tail = |at: f64| {
            let saddle = self.saddle(at);
            let tails = self.tails_at(&saddle);
            (saddle.deviation, if above { tails.upper } else { tails.lower })
        };
        // The part of the way to where the tilted law ends; without an end on this side, a part of infinity.
        let end = self.ends()[usize::from(above)];
        let scale = 1.0 / self.sigma();
        let at = |part: f64| {
            if end.is_finite() { end * part } else { scale.copysign(end) * part / (1.0 - part) }
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if tail(at(middle)).1 > p { low = middle } else { high = middle }
        }
        tail(at(low)).0
    }

    /// Tilts between which the tilted law exists.
    fn ends(&self) -> [f64; 2] {
        let [low, high] = self.extremes;
        [
            if low < 0.0 { 1.0 / low } else { f64::NEG_INFINITY },
            if high > 0.0 { 1.0 / high } else { f64::INFINITY },
        ]
    }

    fn saddle(&self, at: f64) -> Saddle {
        let (mut deviation, mut variance, mut cumulants) = (0.0, 0.0, 0.0);
        for &Term { weight, shape } in &self.terms {
            let tilt = at * weight;
            let grown = weight / (1.0 - tilt);
            deviation += shape * tilt * grown;
            variance += shape * grown * grown;
            cumulants -= shape * (libm::log1p(-tilt) + tilt);
        }
        Saddle { at, deviation, exponent: at * deviation - cumulants, variance }
    }

    /// Newton's method for the tilt, which never leaves the interval in which the root is known to be.
    fn saddle_of(&self, deviation: f64) -> Saddle {
        let [mut low, mut high] = self.ends();
        let mut at = 0.0;
        loop {
            let saddle = self.saddle(at);
            let error = saddle.deviation - deviation;
            if error > 0.0 {
                high = at
            } else {
                low = at
            }
            let mut next = at - error / saddle.variance;
            if !(low < next && next < high) {
                next = match (low.is_finite(), high.is_finite()) {
                    (true, true) => 0.5 * (low + high),
                    (false, _) => 2.0 * at - 1.0 / self.sigma(),
                    (true, false) => 2.0 * at + 1.0 / self.sigma(),
                };
            }
            if error.abs() <= 1e-10 * self.sigma() || next == at {
                return saddle;
            }
            at = next;
        }
    }

    fn tails_at(&self, saddle: &Saddle) -> Tails {
        let root = (2.0 * saddle.exponent.max(0.0)).sqrt().copysign(saddle.at);
        let corrected = if root.abs() < NEAR_THE_MEAN {
            root + self.skewness / 6.0
        } else {
            root + libm::log(saddle.at * saddle.variance.sqrt() / root) / root
        };
        Tails { lower: normal::upper_p(-corrected), upper: normal::upper_p(corrected) }
    }
}
