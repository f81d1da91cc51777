//! n thresholds in one fragment: alpha-to-coverage as n alpha tests (§8, Eqs. 7 to 9).

use super::clamp::clamp_last;
use super::stratify::wrap;
use crate::threshold::cdf::CdfForm;
use crate::threshold::hash::mm4::murmur3;
use crate::threshold::hash::open_lattice;
use crate::threshold::hash::pcg_nested::pcg;
use crate::threshold::real::Real;
use crate::threshold::stochastic::stochastic;
use core::num::NonZeroU32;

/// Several thresholds in one fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SampleStrata {
    /// Number of samples in a pixel.
    pub samples: NonZeroU32,
    /// Which thresholds they have.
    pub pattern: SamplePattern,
}

/// The thresholds of the samples of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum SamplePattern {
    /// The fixed dither of Eq. 7; needs no hash.
    Regular,
    /// One jitter for all strata, Eq. 8.
    Jittered,
    /// The same with strata in an order that each layer has for itself, Eq. 9.
    Decorrelated,
    /// Independent draws, as stochastic transparency has them (§10): the first is that of the source.
    Independent,
    /// `floor(n alpha)` samples, always the same ones, as the paper has it of hardware (§3, §8); needs no hash.
    Hardware,
    /// One jitter for all strata, which are shuffled for each fragment: random sets of samples (§3, Enderton et al. 2010).
    Shuffled,
    /// Strata turned by one value of the pixel, the same for all layers (Humus 2009); needs no threshold.
    ByPixel,
}

impl SamplePattern {
    /// Every pattern, in the order in which they are listed to users.
    pub const ALL: [Self; 7] = [
        Self::Regular,
        Self::Jittered,
        Self::Decorrelated,
        Self::Independent,
        Self::Hardware,
        Self::Shuffled,
        Self::ByPixel,
    ];

    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Regular => "regular",
            Self::Jittered => "jittered",
            Self::Decorrelated => "decorrelated",
            Self::Independent => "independent",
            Self::Hardware => "hardware",
            Self::Shuffled => "random",
            Self::ByPixel => "pixel",
        }
    }

    /// Whether samples have their thresholds from that of the fragment.
    #[must_use]
    pub const fn uses_source(self) -> bool {
        match self {
            Self::Jittered | Self::Decorrelated | Self::Independent | Self::Shuffled => true,
            Self::Regular | Self::Hardware | Self::ByPixel => false,
        }
    }

    /// Whether the order of the strata is drawn for each pixel, layer and frame.
    #[must_use]
    pub const fn is_permuted(self) -> bool {
        matches!(self, Self::Decorrelated | Self::Shuffled)
    }

    /// The number of hashes that it takes for one fragment.
    #[must_use]
    pub const fn hashes(self) -> u64 {
        match self {
            Self::Decorrelated | Self::Shuffled | Self::ByPixel => 1,
            Self::Regular | Self::Jittered | Self::Independent | Self::Hardware => 0,
        }
    }
}

impl SampleStrata {
    /// Writes the thresholds of consecutive samples of one fragment, from the sample `first` on. `out[0]` holds the threshold
    /// of the fragment; `words` are its own, `random` draws fresh ones.
    pub(in crate::threshold) fn thresholds<R: Real>(
        self,
        form: CdfForm,
        pixel: [u32; 2],
        words: impl FnOnce() -> [u32; 4],
        random: &mut impl FnMut() -> u32,
        first: u32,
        out: &mut [R],
    ) {
        let (n, chi, literal) = (self.samples, out[0], form == CdfForm::Literal);
        // Strata are below n.
        let jitter = |stratum| {
            let threshold = jittered_literal(chi, stratum, n);
            if literal { threshold } else { clamp_last(threshold) }
        };
        let samples = out.iter_mut().enumerate().map(|(i, out)| (out, first.wrapping_add(i as u32)));
        match self.pattern {
            SamplePattern::Regular => samples.for_each(|(out, i)| *out = regular(i, n)),
            SamplePattern::Hardware => samples.for_each(|(out, i)| *out = hardware_threshold(i, n)),
            SamplePattern::ByPixel => {
                let chi = pixel_value(pixel);
                samples.for_each(|(out, i)| *out = turned(chi, i, n));
            }
            SamplePattern::Jittered if literal => samples.for_each(|(out, i)| *out = jitter(i)),
            SamplePattern::Jittered => samples.for_each(|(out, i)| *out = jitter(within(i, n))),
            SamplePattern::Decorrelated => {
                let xi = fragment_pair::<R>(words());
                if literal {
                    samples.for_each(|(out, i)| *out = jitter(decorrelated_literal(xi, i, n)));
                } else {
                    let order = Permutation::drawn(xi, n);
                    samples.for_each(|(out, i)| *out = jitter(order.stratum(i)));
                }
            }
            SamplePattern::Shuffled => {
                let [_, _, _, word] = words();
                let mut hashes = [0; AT_HAND];
                match hashes.get_mut(..n.get() as usize) {
                    Some(hashes) => {
                        for (i, hash) in hashes.iter_mut().enumerate() {
                            *hash = hash_of_sample(word, i as u32);
                        }
                        samples.for_each(|(out, i)| {
                            let own = hashes[within(i, n) as usize];
                            *out = jitter(hashes.iter().map(|&other| u32::from(other < own)).sum());
                        });
                    }
                    None => samples.for_each(|(out, i)| *out = jitter(shuffled(word, i, n))),
                }
            }
            SamplePattern::Independent => {
                samples.filter(|&(_, i)| i > 0).for_each(|(out, _)| *out = stochastic(random()));
            }
        }
    }
}

/// Returns the threshold of sample `i` of `n` under the fixed dither: `(i + 1/2) / n`; `i` counts modulo `n`. Eq. 7.
///
/// It keeps `round(n alpha)` samples; the paper says that this is the same as the `floor(n alpha)` of hardware (§3),
/// which it is not for half of all alphas.
#[must_use]
pub fn regular<R: Real>(i: u32, n: NonZeroU32) -> R {
    (R::from_f64(f64::from(within(i, n))) + R::from_f64(0.5)) / R::from_f64(f64::from(n.get()))
}

/// Returns the threshold of sample `i` of `n` as hardware has it, `(i + 1) / n`, in (0, 1]; `i` counts modulo `n`. It keeps the
/// `floor(n alpha)` samples that §3 and §8 give for hardware.
#[must_use]
pub fn hardware_threshold<R: Real>(i: u32, n: NonZeroU32) -> R {
    R::from_f64(f64::from(within(i, n) + 1)) / R::from_f64(f64::from(n.get()))
}

/// Returns the value of a pixel, in (0, 1), given its column and row: the same in every frame and layer (Humus 2009).
#[must_use]
pub fn pixel_value<R: Real>(pixel: [u32; 2]) -> R {
    open_lattice(murmur3([pixel[0], pixel[1], 0, 0]))
}

/// Returns the threshold of sample `i` of `n` by a value of the pixel: `fract(chi + i / n)`, in [2^-24, 1] with a whole sum as 1.
#[must_use]
pub fn turned<R: Real>(chi: R, i: u32, n: NonZeroU32) -> R {
    let share = R::from_f64(f64::from(within(i, n))) / R::from_f64(f64::from(n.get()));
    wrap(chi + share)
}

/// Returns the threshold of sample `i` of `n`, jittered within its stratum: `(i + chi) / n`. Eq. 8.
///
/// Literal: 0 for `i` = 0 and `chi` = 0.
#[must_use]
pub fn jittered_literal<R: Real>(chi: R, i: u32, n: NonZeroU32) -> R {
    (R::from_f64(f64::from(i)) + chi) / R::from_f64(f64::from(n.get()))
}

/// Returns the threshold of sample `i` of `n`, jittered within its stratum by `chi` in [0, 1], in [2^-24, 1]; `i` counts
/// modulo `n`. Eq. 8, with the clamp after it.
#[must_use]
pub fn jittered<R: Real>(chi: R, i: u32, n: NonZeroU32) -> R {
    clamp_last(jittered_literal(chi, i % n, n))
}

/// Returns the stratum of sample `i` of `n`: `(offset + i step) mod n` with `offset = floor(n xi_1)` and the odd
/// `step = 2 floor(n xi_2 / 2) + 1`. Eq. 9.
///
/// Literal: a permutation of 0..n only where `step` is coprime to `n`, as for powers of two, to which the paper limits
/// it.
#[must_use]
pub fn decorrelated_literal<R: Real>(xi: [R; 2], i: u32, n: NonZeroU32) -> u32 {
    let size = R::from_f64(f64::from(n.get()));
    let offset = (size * xi[0]).floor().to_word();
    let step = 2 * (R::from_f64(0.5) * size * xi[1]).floor().to_word() + 1;
    offset.wrapping_add(i.wrapping_mul(step)) % n
}

/// The order in which the samples of one fragment take the strata: drawn once, asked for every sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Permutation {
    offset: u32,
    /// Coprime to the number of samples.
    step: u32,
    samples: NonZeroU32,
}

impl Permutation {
    /// Draws an order of `n` samples by two values in [0, 1]: the step of Eq. 9 is drawn from the numbers coprime to `n`.
    ///
    /// For powers of two these are the odd numbers, as in the paper. The work grows with any other `n`.
    #[inline(always)]
    #[must_use]
    pub fn drawn<R: Real>(xi: [R; 2], n: NonZeroU32) -> Self {
        let size = n.get();
        let step = if size.is_power_of_two() {
            2 * chosen_part(xi[1], (size / 2).max(1)) + 1
        } else {
            coprime_step(xi[1], size)
        };
        Self { offset: chosen_part(xi[0], size), step, samples: n }
    }

    /// Returns the stratum of sample `i`, which counts modulo the number of samples: `(offset + i step) mod n`. Eq. 9.
    #[inline(always)]
    #[must_use]
    pub fn stratum(self, i: u32) -> u32 {
        let Self { offset, step, samples } = self;
        if samples.is_power_of_two() {
            return offset.wrapping_add(i.wrapping_mul(step)) & (samples.get() - 1);
        }
        let stratum =
            (u64::from(offset) + u64::from(within(i, samples)) * u64::from(step)) % u64::from(samples.get());
        stratum as u32
    }
}

/// Returns the stratum of sample `i` of `n`: a permutation of 0..n for every `n` and every `xi` in [0, 1]. Eq. 9, with a
/// step that is drawn from the numbers coprime to `n`; `i` counts modulo `n`. For all samples of a fragment at once there is
/// [`Permutation`].
#[must_use]
pub fn decorrelated<R: Real>(xi: [R; 2], i: u32, n: NonZeroU32) -> u32 {
    Permutation::drawn(xi, n).stratum(i)
}

/// Returns the stratum of sample `i` of `n` in the permutation that `word` draws, every one of them as likely as any
/// other: the rank of the sample's own hash among those of all. `i` counts modulo `n`.
///
/// The work grows with `n`. Not in the paper, which names the permutations and not how to draw them.
#[must_use]
pub fn shuffled(word: u32, i: u32, n: NonZeroU32) -> u32 {
    let own = hash_of_sample(word, i % n);
    // No two are equal: the hash is a bijection.
    (0..n.get()).filter(|&other| hash_of_sample(word, other) < own).count() as u32
}

fn hash_of_sample(word: u32, sample: u32) -> u32 {
    pcg(word.wrapping_add(sample))
}

/// Up to so many samples are ranked by hashes that are found once for all of them.
const AT_HAND: usize = 64;

/// A sample's number modulo `n`; a division only where it is one.
#[inline(always)]
fn within(i: u32, n: NonZeroU32) -> u32 {
    if i < n.get() { i } else { i % n }
}

/// The two numbers in (0, 1) of a fragment, out of its words; the first word is left to stochastic thresholds.
fn fragment_pair<R: Real>([_, first, second, _]: [u32; 4]) -> [R; 2] {
    [first, second].map(open_lattice)
}

/// Cuts [0, 1] into `n` equal parts and returns the index of the one that holds `xi`; 0 for NaN.
#[inline(always)]
fn chosen_part<R: Real>(xi: R, n: u32) -> u32 {
    let scaled = (Real::clamp(xi, R::from_f64(0.0), R::from_f64(1.0)) * R::from_f64(f64::from(n))).floor();
    scaled.to_word().min(n - 1)
}

/// Returns one of the numbers coprime to `size`, each for an equal part of [0, 1].
#[inline(never)]
fn coprime_step<R: Real>(xi: R, size: u32) -> u32 {
    let coprime = |&step: &u32| is_coprime(step, size);
    let count = (1..=size).filter(coprime).count();
    let chosen = chosen_part(xi, count as u32);
    (1..=size).filter(coprime).nth(chosen as usize).unwrap_or(1)
}

fn is_coprime(mut a: u32, mut b: u32) -> bool {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sizes() -> impl Iterator<Item = NonZeroU32> {
        (1..=64).filter_map(NonZeroU32::new)
    }

    fn parameters() -> impl Iterator<Item = [f64; 2]> {
        (0..=5).flat_map(|a| (0..=128).map(move |b| [f64::from(a) / 5.0, f64::from(b) / 128.0]))
    }

    fn is_permutation(xi: [f64; 2], n: NonZeroU32, order: impl Fn([f64; 2], u32, NonZeroU32) -> u32) -> bool {
        let mut strata: Vec<_> = (0..n.get()).map(|i| order(xi, i, n)).collect();
        strata.sort_unstable();
        strata.into_iter().eq(0..n.get())
    }

    #[test]
    fn every_sample_gets_a_stratum_of_its_own_for_every_n() {
        for n in sizes() {
            assert!(parameters().all(|xi| is_permutation(xi, n, decorrelated)), "{n}");
        }
    }

    #[test]
    fn the_literal_step_fails_for_n_that_are_no_powers_of_two() {
        for n in sizes() {
            let always = parameters().all(|xi| is_permutation(xi, n, decorrelated_literal));
            assert_eq!(always, n.get().is_power_of_two(), "{n}");
        }
    }

    #[test]
    fn regular_thresholds_keep_the_rounded_number_of_samples() {
        let n = NonZeroU32::new(4).unwrap();
        let kept = |alpha: f64| (0..4).filter(|&i| alpha >= regular(i, n)).count();
        assert_eq!(kept(0.2), 1);
        assert_eq!((4.0_f64 * 0.2).floor(), 0.0);
        assert_eq!((kept(0.0), kept(0.5), kept(1.0)), (0, 2, 4));
    }

    #[test]
    fn alpha_0_never_passes_and_alpha_1_always_does() {
        for n in sizes() {
            for chi in [0.0, 1e-30, 1.0 / 16_777_216.0, 0.5, 1.0 - 1.0 / 16_777_216.0, 1.0_f32] {
                for i in 0..n.get() {
                    let threshold = jittered(chi, i, n);
                    assert!(threshold > 0.0 && threshold <= 1.0);
                }
            }
        }
        assert_eq!(jittered_literal(0.0_f32, 0, NonZeroU32::MIN), 0.0);
    }

    /// Every permutation is equally likely: each of the 24 of 4 samples within 5 deviations.
    #[test]
    fn permutations_are_evenly_drawn() {
        let mut counts = std::collections::HashMap::<Vec<u32>, u32>::new();
        for word in 0..24_000 {
            let word = murmur3([word, 1, 0, 0]);
            *counts
                .entry((0..4).map(|i| shuffled(word, i, NonZeroU32::new(4).unwrap())).collect())
                .or_default() += 1;
        }
        assert_eq!(counts.len(), 24);
        for (order, count) in counts {
            assert!((f64::from(count) - 1000.0).abs() < 5.0 * 31.0, "{order:?}: {count}");
        }
    }
}
