//! A threshold of one's own on trial, as in somebody's own test suite.
//!
//! `cargo test --example verify_my_threshold` runs the tests below; `cargo run --example verify_my_threshold` shows
//! what both thresholds are told.
#![allow(clippy::print_stdout)]

use hashed_alpha::glam::Vec3;
use hashed_alpha::{Budget, Footprint, Subject, Suite, Variant, check};

/// An integer hash of a cell and its octave: three rounds of multiply and shift over each word.
fn hash(cell: Vec3, octave: i32) -> f32 {
    let words = [cell.x as i32, cell.y as i32, cell.z as i32, octave].map(|word| word as u32);
    let mixed = words.into_iter().fold(0x9e37_79b9_u32, |hash, word| {
        let mut hash = hash.wrapping_add(word);
        for factor in [0x85eb_ca6b_u32, 0xc2b2_ae35, 0x27d4_eb2f] {
            hash = (hash ^ (hash >> 15)).wrapping_mul(factor);
        }
        hash ^ (hash >> 16)
    });
    // The middle of one of 2^23 steps: never 0, never 1.
    ((mixed >> 9) as f32 + 0.5) / 8_388_608.0
}

/// Eq. 2.
fn cdf(x: f32, lerp_factor: f32) -> f32 {
    let a = lerp_factor.min(1.0 - lerp_factor);
    if x < a {
        x * x / (2.0 * a * (1.0 - a))
    } else if x < 1.0 - a {
        (x - 0.5 * a) / (1.0 - a)
    } else {
        1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))
    }
}

/// Listing 1 by hand, from the two screen derivatives of a position.
fn threshold_from(position: Vec3, dpdx: Vec3, dpdy: Vec3) -> f32 {
    let scale = 1.0 / dpdx.length().max(dpdy.length());
    let log_scale = libm::log2f(scale);
    let octave = log_scale.floor();
    let lerp_factor = log_scale - octave;
    let [coarse, fine] =
        [octave, octave + 1.0].map(|octave| hash((position * libm::exp2f(octave)).floor(), octave as i32));
    let mixed = (1.0 - lerp_factor) * coarse + lerp_factor * fine;
    cdf(mixed, lerp_factor).clamp(1.0e-6, 1.0)
}

/// The threshold that this project ships.
fn my_threshold(at: &Footprint<f32>) -> f32 {
    threshold_from(at.position, at.dpdx, at.dpdy)
}

/// The same with a slip of the hand: dFdx twice.
fn slipped_threshold(at: &Footprint<f32>) -> f32 {
    threshold_from(at.position, at.dpdx, at.dpdx)
}

fn main() {
    let both = [
        Subject::of_f32("mine", Variant::Isotropic, my_threshold),
        Subject::of_f32("slipped", Variant::Isotropic, slipped_threshold),
    ];
    for subject in both {
        println!("{}\n", check::run(&subject, Suite::Paper, Budget::Quick));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn my_threshold_is_as_good_as_the_papers() {
        let mine = Subject::of_f32("mine", Variant::Isotropic, my_threshold);
        check::run(&mine, Suite::Paper, Budget::Ci).assert();
    }

    #[test]
    fn a_slip_is_named_with_its_mend() {
        let slipped = Subject::of_f32("slipped", Variant::Isotropic, slipped_threshold);
        let results = check::run(&slipped, Suite::Paper, Budget::Quick);
        let panic = std::panic::catch_unwind(|| results.assert()).expect_err("it is rejected");
        let message = panic.downcast_ref::<String>().expect("a message");
        for words in [
            "slipped in f32, suite paper, seed 0: ",
            "rejected: stability.translate (§5",
            "  claim: a sub-pixel shift changes",
            "  seen: ",
            "cause: dfdx-twice: the derivative along screen x stands in for the one along y (",
            "); take dFdy for the second derivative",
        ] {
            assert!(message.contains(words), "{words} is missing in:\n{message}");
        }
    }
}
