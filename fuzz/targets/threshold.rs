//! Raw bits in, a threshold in (0, 1] or a typed error out: the robust threshold and everything that may follow it.
//!
//! Every number is taken from the input bit by bit, so NaN payloads, infinities and subnormals are as common as
//! anything else.

#![no_main]

use core::num::NonZeroU32;
use glam::{DVec3, Vec3};
use hashed_alpha::threshold::fixed::passes;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::real::Real;
use hashed_alpha::threshold::robust::{Join, Robust};
use hashed_alpha::threshold::two_scale::Variant;
use hashed_alpha::threshold::stage::{clamp, coverage, fade_in, stratify};
use libfuzzer_sys::fuzz_target;

/// Reads numbers off the input; zeros behind its end.
struct Bits<'a>(&'a [u8]);

impl Bits<'_> {
    fn word(&mut self) -> u64 {
        let (head, rest) = self.0.split_at(self.0.len().min(8));
        self.0 = rest;
        let mut bytes = [0; 8];
        bytes[..head.len()].copy_from_slice(head);
        u64::from_le_bytes(bytes)
    }
}

fuzz_target!(|data: &[u8]| {
    let mut bits = Bits(data);
    let options = bits.word();
    let words: [u64; 9] = core::array::from_fn(|_| bits.word());
    let hash_scale = f64::from_bits(bits.word());
    let (lod, levels) = (bits.word(), bits.word());
    let counts = bits.word();

    let double = words.map(f64::from_bits);
    chain(
        Footprint::<f64> {
            position: DVec3::from_slice(&double[..3]),
            dpdx: DVec3::from_slice(&double[3..6]),
            dpdy: DVec3::from_slice(&double[6..]),
        },
        options,
        hash_scale,
        [f64::from_bits(lod), f64::from_bits(levels)],
        counts,
    );
    let single = words.map(|word| f32::from_bits(word as u32));
    chain(
        Footprint::<f32> {
            position: Vec3::from_slice(&single[..3]),
            dpdx: Vec3::from_slice(&single[3..6]),
            dpdy: Vec3::from_slice(&single[6..]),
        },
        options,
        hash_scale,
        [f32::from_bits(lod as u32), f32::from_bits(levels as u32)],
        counts,
    );
});

fn chain<R: Real>(footprint: Footprint<R>, options: u64, hash_scale: f64, [lod, levels]: [R; 2], counts: u64) {
    let pick = |shift: u32, n: usize| (options >> shift) as usize % n;
    let variant = [Variant::Isotropic, Variant::Anisotropic][pick(0, 2)];
    let robust = Robust {
        join: Join::ALL[pick(8, Join::ALL.len())],
        hash: HashKind::ALL[pick(16, HashKind::ALL.len())],
        hash_scale: if pick(24, 2) == 0 { 1.0 } else { hash_scale },
        ..Robust::new(variant)
    };
    let Ok(threshold) = robust.threshold(&footprint) else { return };
    assert_threshold(threshold, "robust");

    let n = NonZeroU32::new(counts as u32 % 64 + 1).unwrap_or(NonZeroU32::MIN);
    let frame = (counts >> 32) as u32;
    let share = fade_in::blend(lod * fade_in::anisotropy([lod, levels]), levels);
    let mut chained = threshold;
    for step in 0..4 {
        chained = match options >> (32 + 8 * step) & 7 {
            0 => stratify::stratified(chained, stratify::alternating(frame, n), n),
            1 => coverage::jittered(chained, coverage::decorrelated([threshold, chained], frame, n), n),
            2 => fade_in::fade_in(R::from_f64(0.5), chained, share),
            3 => clamp::clamp_last(coverage::regular(frame % n, n)),
            _ => chained,
        };
        assert_threshold(chained, "chained");
    }
}

fn assert_threshold<R: Real>(threshold: R, place: &str) {
    let [zero, one] = [0.0, 1.0].map(R::from_f64);
    assert!(threshold > zero && threshold <= one, "{place}: {threshold:?}");
    assert!(!passes(zero, threshold) && passes(one, threshold), "{place}: {threshold:?}");
}
