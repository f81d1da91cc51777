//! Alpha-to-coverage: which of n samples a fragment covers, as bits (§3, §8; Enderton et al. 2010; Humus 2009).
//!
//! Bit i of a mask is sample i; `n` is at most 32, and samples beyond that are left out. Alpha 0 covers nothing and
//! alpha 1 every sample, whatever the random numbers, in every function that is not called literal.

use core::num::NonZeroU32;
use hashed_alpha::threshold::real::Real;
use hashed_alpha::threshold::stage::coverage::{
    decorrelated, decorrelated_literal, hardware_threshold, jittered, jittered_literal, pixel_value, regular,
    shuffled, turned,
};

/// The samples that a fragment covers.
pub type Mask = u32;

/// Returns the share of samples that a mask covers.
pub fn coverage(mask: Mask, n: NonZeroU32) -> f64 {
    f64::from(mask.count_ones()) / f64::from(n.get())
}

/// Returns the mask of `n` samples whose thresholds `alpha` reaches.
pub fn by_threshold<R: Real>(alpha: R, n: NonZeroU32, threshold: impl Fn(u32) -> R) -> Mask {
    (0..n.get().min(Mask::BITS)).filter(|&i| alpha >= threshold(i)).fold(0, |mask, i| mask | 1 << i)
}

/// Returns the mask of the fixed dither: n alpha tests with the thresholds of Eq. 7, which cover `round(n alpha)`
/// samples. Layers of equal alpha cover the same ones.
pub fn fixed_dither<R: Real>(alpha: R, n: NonZeroU32) -> Mask {
    by_threshold(alpha, n, |i| regular(i, n))
}

/// Returns a mask of `floor(n alpha)` samples, the count that §3 and §8 give for hardware; the first ones, as hardware
/// may choose them and the paper does not say.
///
/// Half a sample too few in the mean.
pub fn hardware<R: Real>(alpha: R, n: NonZeroU32) -> Mask {
    by_threshold(alpha, n, |i| hardware_threshold(i, n))
}

/// Returns the mask of jittered thresholds, `(i + chi_i) / n`, clamped: Eq. 8. `chi(i)` is in [0, 1], one value for
/// every sample or one for each.
pub fn stratified<R: Real>(alpha: R, n: NonZeroU32, chi: impl Fn(u32) -> R) -> Mask {
    by_threshold(alpha, n, |i| jittered(chi(i), i, n))
}

/// Returns the mask of jittered thresholds that are permuted for each fragment, Eq. 9 with a step coprime to `n`.
///
/// `xi` holds two hashes in [0, 1] that must differ between layers; `chi` is that of [`stratified`].
pub fn permuted<R: Real>(alpha: R, n: NonZeroU32, xi: [R; 2], chi: impl Fn(u32) -> R) -> Mask {
    by_threshold(alpha, n, |i| jittered(chi(i), decorrelated(xi, i, n), n))
}

/// Returns the mask of Eq. 9 to the letter: for an `n` that is no power of two strata repeat, up to all of them.
pub fn permuted_literal<R: Real>(alpha: R, n: NonZeroU32, xi: [R; 2], chi: impl Fn(u32) -> R) -> Mask {
    by_threshold(alpha, n, |i| jittered_literal(chi(i), decorrelated_literal(xi, i, n), n))
}

/// Returns a random mask: `floor(n alpha + 1 - chi)` samples, every set of that size as likely as any other (Enderton et
/// al. 2010, whom §3 cites for random permutations of patterns).
///
/// `chi` in [0, 1] rounds the count so that its mean is `n alpha`; `word` chooses the set and must differ between
/// layers and fragments. These are jittered thresholds whose strata are [`shuffled`].
pub fn random_set<R: Real>(alpha: R, n: NonZeroU32, chi: R, word: u32) -> Mask {
    by_threshold(alpha, n, |i| jittered(chi, shuffled(word, i, n), n))
}

/// Returns the mask of one pseudo-random value of the pixel: sample i is covered where alpha reaches
/// `fract(chi + i / n)` (Humus 2009, who writes the mask to the shader's coverage output and shows no formula).
///
/// The value both rounds the count and turns the pattern, so neighbouring pixels have different ones. Layers of a pixel
/// share it, and with it their samples.
pub fn by_pixel<R: Real>(alpha: R, n: NonZeroU32, pixel: [u32; 2]) -> Mask {
    let chi = pixel_value(pixel);
    by_threshold(alpha, n, |i| turned(chi, i, n))
}
