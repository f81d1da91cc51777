//! Masks of samples: what they cover alone and one behind the other.

use crate::mask::*;
use core::num::NonZeroU32;
use hashed_alpha::threshold::hash::{mm4::murmur3, open_lattice};
use hashed_alpha::threshold::real::Real;
use hashed_alpha::threshold::stage::coverage::jittered_literal;

fn n(samples: u32) -> NonZeroU32 {
    NonZeroU32::new(samples).unwrap()
}

fn value(words: [u32; 4]) -> f64 {
    open_lattice(murmur3(words))
}

/// Returns the mask of Eq. 8 to the letter: sample 0 covers alpha 0 where its `chi` is 0.
fn stratified_literal<R: Real>(alpha: R, n: NonZeroU32, chi: impl Fn(u32) -> R) -> Mask {
    by_threshold(alpha, n, |i| jittered_literal(chi(i), i, n))
}

/// Every kind of mask at a pixel and layer, with hashes that differ between layers.
type Kind = (&'static str, fn(f64, NonZeroU32, u32, u32) -> Mask);
const KINDS: [Kind; 7] = [
    ("fixed dither", |alpha, n, _, _| fixed_dither(alpha, n)),
    ("hardware", |alpha, n, _, _| hardware(alpha, n)),
    ("one chi", |alpha, n, p, l| stratified(alpha, n, |_| value([p, l, 0, 1]))),
    ("n chi", |alpha, n, p, l| stratified(alpha, n, |i| value([p, l, i, 2]))),
    ("permuted", |alpha, n, p, l| {
        permuted(alpha, n, [value([p, l, 0, 3]), value([p, l, 1, 3])], |i| value([p, l, i, 4]))
    }),
    ("random set", |alpha, n, p, l| random_set(alpha, n, value([p, l, 0, 5]), murmur3([p, l, 0, 6]))),
    ("by pixel", |alpha, n, p, _| by_pixel(alpha, n, [p % 256, p / 256])),
];

fn mean_coverage(mask: impl Fn(u32) -> Mask, n: NonZeroU32) -> f64 {
    let pixels = 4096;
    (0..pixels).map(|p| coverage(mask(p), n)).sum::<f64>() / f64::from(pixels)
}

#[test]
fn alpha_0_covers_nothing_and_alpha_1_everything() {
    for samples in [1, 2, 3, 4, 5, 8, 16, 32] {
        let all = if samples == 32 { Mask::MAX } else { (1 << samples) - 1 };
        for (name, kind) in KINDS {
            for p in 0..200 {
                assert_eq!(kind(0.0, n(samples), p, 1), 0, "{name}, {samples}");
                assert_eq!(kind(1.0, n(samples), p, 1), all, "{name}, {samples}");
            }
        }
    }
    assert_eq!(stratified_literal(0.0_f32, n(4), |_| 0.0), 1);
}

#[test]
fn a_single_layer_covers_alpha_but_for_what_rounding_takes() {
    for alpha in [0.1, 0.3, 0.5, 0.8] {
        for (name, kind) in KINDS {
            let covered = mean_coverage(|p| kind(alpha, n(8), p, 0), n(8));
            let expected = match name {
                "fixed dither" => (8.0 * alpha + 0.5_f64).floor() / 8.0,
                "hardware" => (8.0_f64 * alpha).floor() / 8.0,
                _ => alpha,
            };
            assert!((covered - expected).abs() < 0.01, "{name} of {alpha}: {covered}");
        }
    }
}

fn layered(kind: Kind, layers: u32) -> f64 {
    mean_coverage(|p| (0..layers).fold(0, |mask, l| mask | kind.1(0.5, n(8), p, l)), n(8))
}

/// "Correlations between overlapping transparent fragments, causing aggregate geometry to lose opacity" (§8): what
/// is behind shows as through one layer, unless strata are permuted or drawn for each fragment.
#[test]
fn only_masks_of_their_own_make_layers_multiply() {
    for layers in [2, 4, 8] {
        let product = 1.0 - libm::exp2(-f64::from(layers));
        for kind in KINDS {
            let covered = layered(kind, layers);
            let expected = match kind.0 {
                "permuted" | "random set" => product,
                _ => 0.5,
            };
            assert!((covered - expected).abs() < 0.01, "{}: {covered} for {layers} layers", kind.0);
        }
    }
}

/// Numerics of the literal Eq. 9: with 5 samples a step of 5 puts all of them into one stratum.
#[test]
fn the_literal_permutation_covers_all_or_nothing_for_five_samples() {
    let xi = [0.0, 0.99];
    assert_eq!(permuted_literal(0.29, n(5), xi, |_| 0.5), 0b11111);
    assert_eq!(permuted(0.29, n(5), xi, |_| 0.5).count_ones(), 1);
}

/// "You can often see very obvious and repetitive dither patterns" (Humus 2009).
#[test]
fn pixels_get_patterns_of_their_own() {
    let different =
        |mask: &dyn Fn(u32) -> Mask| (0..4096).map(mask).collect::<std::collections::HashSet<_>>().len();
    assert_eq!(different(&|_| fixed_dither(0.5, n(8))), 1);
    assert_eq!(different(&|p| by_pixel(0.5, n(8), [p % 64, p / 64])), 8);
}

/// Every set of a size is equally likely: each of the 6 pairs of 4 samples within 5 deviations.
#[test]
fn random_sets_are_evenly_drawn() {
    let mut counts = [0_u32; 16];
    for word in 0..6000 {
        counts[random_set(0.5, n(4), 1.0, murmur3([word, 0, 0, 0])) as usize] += 1;
    }
    for (mask, count) in counts.into_iter().enumerate() {
        if mask.count_ones() == 2 {
            assert!((f64::from(count) - 1000.0).abs() < 5.0 * 29.0, "{mask:04b}: {count}");
        } else {
            assert_eq!(count, 0);
        }
    }
}

/// "Using randomized thresholds corresponds to stratified stochastic transparency" (§10): less variance than n
/// random ones, which `alpha (1 - alpha) / n` has.
#[test]
fn stratified_thresholds_vary_less_than_random_ones() {
    let variance = |mask: &dyn Fn(u32) -> Mask| {
        let square = |p| (coverage(mask(p), n(8)) - 0.3) * (coverage(mask(p), n(8)) - 0.3);
        (0..4096).map(square).sum::<f64>() / 4096.0
    };
    let jittered = variance(&|p| stratified(0.3, n(8), |i| value([p, i, 0, 7])));
    let random = variance(&|p| by_threshold(0.3, n(8), |i| value([p, i, 0, 8])));
    assert!((random / (0.21 / 8.0) - 1.0).abs() < 0.15, "{random}");
    assert!(jittered < 0.2 * random, "{jittered} {random}");
}
