//! The law of single cells: what a threshold does after Eq. 2, which it does to every hash alike.

use super::slip::{Slip, named};

/// A value of its own has so many of the values at least.
const ATOM: usize = 4;

/// Below this an atom at the low end is that of the listing's clamp.
const LISTING_CLAMP: f64 = 1.0e-4;

/// Largest distance between two distribution functions that are one, times the root of the number of values; a sound law
/// passes it once in 10^5.
const DISTANCE: f64 = 2.5;

/// Fewest different values of a law without steps, as a share of all.
const DIFFERENT: f64 = 0.8;

/// What a threshold does to a uniform value.
#[derive(Clone, Debug)]
pub(super) struct Law {
    pub slip: Option<Slip>,
    /// What was seen of it, with a number.
    pub shown: String,
    pub bend: Bend,
}

/// A function of a uniform value, and its inverse.
#[derive(Clone, Copy, Debug)]
pub(super) enum Bend {
    /// No more than a clamp: ends that some values are moved to.
    Clamp([f64; 2]),
    /// Between two ends, linearly.
    Line([f64; 2]),
    /// A power.
    Power(f64),
    /// The curve of sRGB, encoded or decoded.
    Srgb { encoded: bool },
}

impl Bend {
    pub fn bent(self, t: f64) -> f64 {
        match self {
            Self::Clamp([low, high]) => t.clamp(low, high),
            Self::Line([low, high]) => low + (high - low) * t,
            Self::Power(gamma) => libm::pow(t.max(0.0), gamma),
            Self::Srgb { encoded: true } => encoded(t),
            Self::Srgb { encoded: false } => decoded(t),
        }
    }

    pub fn straight(self, t: f64) -> f64 {
        match self {
            Self::Clamp(_) => t,
            Self::Line([low, high]) => (t - low) / (high - low),
            Self::Power(gamma) => libm::pow(t.max(0.0), 1.0 / gamma),
            Self::Srgb { encoded: true } => decoded(t),
            Self::Srgb { encoded: false } => encoded(t),
        }
    }
}

fn encoded(t: f64) -> f64 {
    if t <= 0.003_130_8 { 12.92 * t } else { 1.055 * libm::pow(t, 1.0 / 2.4) - 0.055 }
}

fn decoded(t: f64) -> f64 {
    if t <= 0.040_45 { t / 12.92 } else { libm::pow((t + 0.055) / 1.055, 2.4) }
}

/// The largest distance between the values, in order, and a distribution function, in units of a sound law's.
fn distance(sorted: &[f64], law: impl Fn(f64) -> f64) -> f64 {
    let n = sorted.len() as f64;
    let furthest = sorted.iter().enumerate().map(|(rank, &value)| {
        let law = law(value).clamp(0.0, 1.0);
        (law - rank as f64 / n).abs().max((law - (rank + 1) as f64 / n).abs())
    });
    furthest.fold(0.0, f64::max) * n.sqrt()
}

/// Whether the values could be those of a distribution function.
pub(super) fn follows(values: &[f64], law: impl Fn(f64) -> f64) -> bool {
    distance(&unique(values), law) < DISTANCE
}

/// A distribution function.
pub(super) type Distribution = fn(f64) -> f64;

/// The law that is nearest to the values, where one is near enough: hashes of few values are no sound samples.
pub(super) fn nearest<'a, T>(values: &[f64], laws: &'a [(T, Distribution)]) -> Option<&'a T> {
    let unique = unique(values);
    let distances = laws.iter().map(|(name, law)| (name, distance(&unique, law)));
    let (name, least) = distances.min_by(|a, b| a.1.total_cmp(&b.1))?;
    (least < 2.0 * DISTANCE).then_some(name)
}

/// The number of steps of 1 / 4096 that some value lies in.
pub(super) fn occupied(values: &[f64]) -> usize {
    let mut steps: Vec<i64> = values.iter().map(|value| (value * 4096.0).floor() as i64).collect();
    steps.sort_unstable();
    steps.dedup();
    steps.len()
}

/// The different values, in order.
pub(super) fn unique(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    sorted.dedup();
    sorted
}

/// What thresholds of single cells could have been through, the simplest first; the values are those of as many cells.
/// Empty where the law is none that is known.
pub(super) fn laws(values: &[f64]) -> Vec<Law> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let (Some(&low), Some(&high)) = (sorted.first(), sorted.last()) else { return Vec::new() };
    let n = sorted.len() as f64;
    // Cells that are one are no samples of their own.
    let unique = unique(&sorted);
    let mut found = Vec::new();
    let mut add = |slip: Option<Slip>, shown: String, bend: Bend| found.push(Law { slip, shown, bend });
    let at = |end: f64| sorted.iter().filter(|&&value| value == end).count();
    let has_steps = (unique.len() as f64) < DIFFERENT * n;
    let is_uniform = |[low, high]: [f64; 2]| {
        let inner: Vec<f64> = unique.iter().copied().filter(|&value| value > low && value < high).collect();
        2 * inner.len() > unique.len() && distance(&inner, |value| (value - low) / (high - low)) < DISTANCE
    };
    let floor = !has_steps && at(low) >= ATOM && low > LISTING_CLAMP && low < 0.5;
    let ceiling = !has_steps && at(high) >= ATOM && high < 1.0 && high > 0.5;
    let share = |count: usize| 100.0 * count as f64 / n;
    if (floor || ceiling) && is_uniform([if floor { low } else { 0.0 }, if ceiling { high } else { 1.0 }]) {
        let ends = [if floor { low } else { 0.0 }, if ceiling { high } else { 1.0 }];
        if floor {
            let shown = format!(
                "{:.2} % of all thresholds are exactly {low:.4}, and none is smaller",
                share(at(low))
            );
            add(Some(named("clamped-by-255ths")), shown, Bend::Clamp(ends));
        }
        if ceiling {
            let shown = format!(
                "{:.2} % of all thresholds are exactly {high:.4}, and none is larger",
                share(at(high))
            );
            add(Some(named("clamped-below-opaque")), shown, Bend::Clamp(ends));
        }
        return found;
    }
    if distance(&unique, |value| value) < DISTANCE {
        add(None, String::new(), Bend::Clamp([0.0, 1.0]));
    }
    // One value in a thousand lies below the first thousandth: what ends earlier is squeezed.
    let ends = [low - (high - low) / n, high + (high - low) / n];
    if (ends[0] > 0.01 || ends[1] < 0.99) && is_uniform(ends) {
        let ends = ends.map(|end| (end * 1000.0).round() / 1000.0);
        let around = (0.5 * (ends[0] + ends[1]) - 0.5).abs() < 0.01 && ends[1] - ends[0] < 0.7;
        let shown = format!("thresholds are spread evenly between {:.3} and {:.3}", ends[0], ends[1]);
        let slip = if ends[0] < 0.01 && (ends[1] - 0.5).abs() < 0.01 {
            named("sign-bit-masked")
        } else if ends[0] < -0.2 {
            named("signed-hash")
        } else if around {
            named("around-a-cutoff")
        } else {
            named("safe-middle")
        };
        add(Some(slip), shown, Bend::Line(ends));
    }
    for encoded in [true, false] {
        let bend = Bend::Srgb { encoded };
        if distance(&unique, |value| bend.straight(value)) < DISTANCE {
            let shown = format!(
                "the median threshold is {:.3}, as of a value {} sRGB",
                sorted[sorted.len() / 2],
                if encoded { "encoded for" } else { "decoded from" }
            );
            add(Some(named("srgb-curve")), shown, bend);
        }
    }
    let positive = sorted.iter().filter(|&&value| value > 0.0);
    let gamma = positive.clone().map(|&value| -libm::log(value)).sum::<f64>() / positive.count() as f64;
    // The mean of the logarithm of as many uniform values is known to 1 / sqrt(n).
    if (gamma - 1.0).abs() > 4.0 / n.sqrt()
        && distance(&unique, |value| libm::pow(value.max(0.0), 1.0 / gamma)) < DISTANCE
    {
        let gamma = (gamma * 20.0).round() / 20.0;
        let shown = format!(
            "the median threshold is {:.3}, as of a value to the power of {gamma:.2}",
            sorted[sorted.len() / 2]
        );
        add(Some(named("gamma-curve")), shown, Bend::Power(gamma));
    }
    found
}

/// What the few values of a matrix, which lie at even distances, have been through; nothing where they still do, or where nothing
/// explains it.
pub(super) fn bent_steps(values: &[f64]) -> Option<(Slip, String)> {
    /// Fewer have no distances to compare, more are no matrix.
    const STEPS: core::ops::RangeInclusive<usize> = 4..=1024;
    /// How much the distances of even steps differ, as a share.
    const EVEN: f64 = 0.02;
    /// Of displays, and squares.
    const POWERS: [f64; 6] = [2.2, 1.0 / 2.2, 2.0, 0.5, 2.4, 1.0 / 2.4];
    let steps = unique(values);
    if !STEPS.contains(&steps.len()) {
        return None;
    }
    let is_even = |bend: Option<Bend>| {
        let straight: Vec<f64> =
            steps.iter().map(|&step| bend.map_or(step, |bend| bend.straight(step))).collect();
        let mean = (straight[straight.len() - 1] - straight[0]) / (straight.len() - 1) as f64;
        straight.windows(2).all(|pair| (pair[1] - pair[0] - mean).abs() <= EVEN * mean)
    };
    if is_even(None) {
        return None;
    }
    let count = steps.len();
    let curves = [true, false].map(|encoded| {
        let what = if encoded { "encoded for" } else { "decoded from" };
        (named("srgb-curve"), Bend::Srgb { encoded }, format!("{what} sRGB"))
    });
    let powers = POWERS
        .map(|power| (named("gamma-curve"), Bend::Power(power), format!("taken to the power of {power:.2}")));
    let (slip, _, what) = powers.into_iter().chain(curves).find(|(_, bend, _)| is_even(Some(*bend)))?;
    Some((slip, format!("the {count} different thresholds are even steps {what}")))
}

/// What stands in for Eq. 2 where all weight is on one octave, undone: such that the value is the hash again.
pub(super) struct Undone {
    values: Vec<f64>,
}

impl Undone {
    const STEPS: usize = 4096;

    /// Of a correction at a weight; none where it is not increasing there.
    pub fn of(correction: fn(f64, f64) -> f64, weight: f64) -> Option<Self> {
        let at = |step: usize| correction(step as f64 / Self::STEPS as f64, weight);
        let values: Vec<f64> = (0..=Self::STEPS).map(at).collect();
        let middle = &values[Self::STEPS / 64..Self::STEPS - Self::STEPS / 64];
        let rises = middle.windows(2).all(|pair| pair[0] < pair[1]);
        (rises && middle[0] < 0.2 && middle[middle.len() - 1] > 0.8).then_some(Self { values })
    }

    pub fn value(&self, bent: f64) -> f64 {
        let above = self.values.partition_point(|&value| value < bent).clamp(1, Self::STEPS);
        let (low, high) = (self.values[above - 1], self.values[above]);
        let part = if high > low { ((bent - low) / (high - low)).clamp(0.0, 1.0) } else { 0.5 };
        ((above - 1) as f64 + part) / Self::STEPS as f64
    }
}

/// The distribution function of the mean of three hashes.
pub(super) fn mean_of_three(x: f64) -> f64 {
    let cube = |x: f64| x * x * x;
    match 3.0 * x {
        s if s <= 0.0 => 0.0,
        s if s < 1.0 => cube(s) / 6.0,
        s if s < 2.0 => (cube(s) - 3.0 * cube(s - 1.0)) / 6.0,
        s if s < 3.0 => 1.0 - cube(3.0 - s) / 6.0,
        _ => 1.0,
    }
}
