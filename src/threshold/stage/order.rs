//! Which stratum of a threshold a frame takes: the orders of temporal stratification (§7.2.3).

use super::clamp::clamp_last;
use super::stratify::{alternating, alternating_literal, stratified, stratified_literal, wrap};
use crate::threshold::cdf::CdfForm;
use crate::threshold::real::Real;
use core::num::NonZeroU32;

/// How n strata are spread over n frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Order {
    /// Frame i takes `fract(chi + i / n)` (Eq. 6): low thresholds, then high ones.
    Ascending,
    /// `j = i / 2 + (i mod 2) n / 2` in whole numbers, to the letter (§7.2.3): no permutation for odd n.
    AlternatingLiteral,
    /// The same with the half rounded up: a permutation for every n.
    Alternating,
    /// `fract(chi + radical_inverse(i))`, to the letter: for an n that is no power of two the strata are uneven.
    VanDerCorputLiteral,
    /// Strata in the order of their radical inverses: a permutation for every n, and the literal one for powers of two.
    VanDerCorput,
    /// The alternating order entered at the stratum of chi: every other threshold is below 1/2 for every chi, as the
    /// paper says of its own order (even n). Not in the paper.
    PhaseRotated,
    /// The van der Corput order entered at the stratum of chi. Not in the paper.
    PhaseRotatedVanDerCorput,
}

impl Order {
    /// Every order, the paper's first.
    pub const ALL: [Self; 7] = [
        Self::Ascending,
        Self::AlternatingLiteral,
        Self::Alternating,
        Self::VanDerCorputLiteral,
        Self::VanDerCorput,
        Self::PhaseRotated,
        Self::PhaseRotatedVanDerCorput,
    ];

    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ascending => "ascending",
            Self::AlternatingLiteral => "alternating-literal",
            Self::Alternating => "alternating",
            Self::VanDerCorputLiteral => "van-der-corput-literal",
            Self::VanDerCorput => "van-der-corput",
            Self::PhaseRotated => "phase-rotated",
            Self::PhaseRotatedVanDerCorput => "phase-rotated-van-der-corput",
        }
    }

    /// The stratum of frame `i` of `n`, where it is the same for every hashed value; `i` is below `n`.
    fn stratum(self, i: u32, n: NonZeroU32) -> Option<u32> {
        match self {
            Self::Ascending => Some(i),
            Self::AlternatingLiteral => Some(alternating_literal(i, n)),
            Self::Alternating => Some(alternating(i, n)),
            Self::VanDerCorput => Some(radical_rank(i, n)),
            Self::VanDerCorputLiteral | Self::PhaseRotated | Self::PhaseRotatedVanDerCorput => None,
        }
    }

    /// Returns the threshold of frame `i` of `n` for a hashed `chi` in (0, 1], in [2^-24, 1]; `i` counts modulo `n`.
    #[must_use]
    pub fn threshold<R: Real>(self, chi: R, i: u32, n: NonZeroU32) -> R {
        let i = i % n;
        match self {
            Self::Ascending | Self::AlternatingLiteral | Self::Alternating | Self::VanDerCorput => {
                stratified(chi, self.stratum(i, n).unwrap_or(i), n)
            }
            Self::VanDerCorputLiteral => van_der_corput_literal(chi, i),
            Self::PhaseRotated => rotated(chi, alternating(entered(chi, i, n), n), n),
            Self::PhaseRotatedVanDerCorput => rotated(chi, radical_rank(entered(chi, i, n), n), n),
        }
    }
}

/// The threshold divided among frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FrameStrata {
    /// Number of frames that belong together.
    pub frames: NonZeroU32,
    /// Which stratum a frame takes.
    pub order: Order,
}

impl FrameStrata {
    /// Returns the threshold of a frame for a hashed `chi` in (0, 1]. The literal form is that of Eq. 6; orders that look at
    /// `chi` or have no strata of equal size have one form.
    pub(in crate::threshold) fn threshold<R: Real>(self, form: CdfForm, chi: R, frame: u32) -> R {
        let Self { frames, order } = self;
        match (form, order.stratum(frame % frames, frames)) {
            (CdfForm::Literal, Some(stratum)) => stratified_literal(chi, stratum, frames),
            (CdfForm::Literal, None) | (CdfForm::Stable, _) => order.threshold(chi, frame, frames),
        }
    }
}

/// Returns the threshold of frame `i`: `fract(chi + radical_inverse(i))`, with a whole sum as 1.
fn van_der_corput_literal<R: Real>(chi: R, i: u32) -> R {
    wrap(chi + R::from_f64(radical_inverse(i, 2)))
}

/// Returns the frame at which a permutation of `n` strata is entered in frame `i`: `(i + floor(n chi)) mod n`.
fn entered<R: Real>(chi: R, i: u32, n: NonZeroU32) -> u32 {
    (i + (chi * R::from_f64(f64::from(n.get()))).floor().to_word() % n) % n
}

/// Returns the threshold of a stratum that keeps the place of `chi` within its own: `(stratum + fract(n chi)) / n`.
fn rotated<R: Real>(chi: R, stratum: u32, n: NonZeroU32) -> R {
    let scaled = chi * R::from_f64(f64::from(n.get()));
    clamp_last((R::from_f64(f64::from(stratum)) + scaled.fract()) / R::from_f64(f64::from(n.get())))
}

/// Returns the radical inverse of `index`: its digits to `base` mirrored at the point, in [0, 1). Base 2 is the van der
/// Corput sequence of §7.2.3. A base below 2 gives 0.
#[must_use]
pub fn radical_inverse(index: u32, base: u32) -> f64 {
    if base < 2 {
        return 0.0;
    }
    let (mut rest, mut mirrored, mut weight) = (index, 0_u64, 1_u64);
    while rest > 0 {
        mirrored = mirrored * u64::from(base) + u64::from(rest % base);
        weight *= u64::from(base);
        rest /= base;
    }
    mirrored as f64 / weight as f64
}

/// Returns how many of the first `n` indices have a smaller radical inverse to base 2 than `i` has.
#[must_use]
pub fn radical_rank(i: u32, n: NonZeroU32) -> u32 {
    (0..n.get()).map(|other| u32::from(other.reverse_bits() < i.reverse_bits())).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn n(frames: u32) -> NonZeroU32 {
        NonZeroU32::new(frames).unwrap()
    }

    fn chis() -> impl Iterator<Item = f64> {
        (0..997).map(|i| (f64::from(i) + 0.5) / 997.0)
    }

    fn strata(order: Order, chi: f64, frames: u32) -> Vec<u32> {
        let mut strata: Vec<_> =
            (0..frames).map(|i| (order.threshold(chi, i, n(frames)) * f64::from(frames)) as u32).collect();
        strata.sort_unstable();
        strata
    }

    /// "Stratifying them to uniformly sample [0..1)": one threshold in each stratum, for every n and chi.
    #[test]
    fn every_sound_order_takes_each_stratum_once() {
        let sound = [
            Order::Ascending,
            Order::Alternating,
            Order::VanDerCorput,
            Order::PhaseRotated,
            Order::PhaseRotatedVanDerCorput,
        ];
        for frames in 1..=33 {
            for chi in chis().step_by(41) {
                for order in sound {
                    assert!(strata(order, chi, frames).into_iter().eq(0..frames), "{order:?} {frames} {chi}");
                }
            }
        }
        for literal in [Order::AlternatingLiteral, Order::VanDerCorputLiteral] {
            assert!(!strata(literal, 0.05, 7).into_iter().eq(0..7), "{literal:?}");
            assert!(strata(literal, 0.05, 8).into_iter().eq(0..8), "{literal:?}");
        }
    }

    /// Over all chi, the threshold of every frame is uniform on its own.
    #[test]
    fn every_frame_keeps_the_share_alpha() {
        for order in Order::ALL {
            for frames in [3, 7, 8] {
                for i in 0..frames {
                    let kept = chis().filter(|&chi| order.threshold(chi, i, n(frames)) <= 0.3).count();
                    assert!((kept as f64 / 997.0 - 0.3).abs() < 0.01, "{order:?} {i} of {frames}: {kept}");
                }
            }
        }
    }

    fn alternates(order: Order, chi: f64, frames: u32) -> bool {
        let low = |i| order.threshold(chi, i, n(frames)) < 0.5;
        (0..frames).all(|i| low(i) != low(i + 1))
    }

    /// "We should alternate so every other sample is below 1/2": the paper's own order does so for a quarter of chi.
    #[test]
    fn only_the_phase_rotated_orders_alternate_for_every_hash_value() {
        let share =
            |order, frames| chis().filter(|&chi| alternates(order, chi, frames)).count() as f64 / 997.0;
        for frames in [4, 8, 16] {
            assert_eq!(share(Order::PhaseRotated, frames), 1.0);
            assert_eq!(share(Order::PhaseRotatedVanDerCorput, frames), 1.0);
        }
        assert_eq!(share(Order::PhaseRotated, 6), 1.0);
        assert!((share(Order::AlternatingLiteral, 8) - 0.25).abs() < 0.01);
        assert_eq!(share(Order::Ascending, 8), 0.0);
    }

    #[test]
    fn radical_inverses_mirror_the_digits() {
        assert_eq!([0, 1, 2, 3, 6].map(|i| radical_inverse(i, 2)), [0.0, 0.5, 0.25, 0.75, 0.375]);
        assert_eq!([1, 2, 3, 5].map(|i| radical_inverse(i, 3)), [1.0 / 3.0, 2.0 / 3.0, 1.0 / 9.0, 7.0 / 9.0]);
        assert_eq!(radical_inverse(5, 1), 0.0);
        assert!(radical_inverse(u32::MAX, 2) < 1.0);
        assert!((0..64).all(|i| f64::from(radical_rank(i, n(64))) / 64.0 == radical_inverse(i, 2)));
    }

    #[test]
    fn the_ends_of_chi_give_thresholds_too() {
        for order in Order::ALL {
            for chi in [1.0_f32 / 16_777_216.0, 0.125, 0.5, 1.0 - 1.0 / 16_777_216.0, 1.0] {
                for frames in [1, 2, 3, 8, 13] {
                    for i in 0..frames {
                        let threshold = order.threshold(chi, i, n(frames));
                        assert!(threshold > 0.0 && threshold <= 1.0, "{order:?} {chi} {i} {frames}");
                    }
                }
            }
        }
    }
}
