//! Thresholds from frame to frame: §7.2.

use crate::measure::{
    CHIS, Plane, chis, flicker, independent, list, listing, mean, n, percent, rms, share, visible,
};
use crate::row::{Measured, Row, judge};
use hashed_alpha::stats::correlation::pearson;
use hashed_alpha::technique::history::flicker_range;
use hashed_alpha::technique::jitter::camera_jitter;
use hashed_alpha::technique::noise_scale::noise_scale;
use hashed_alpha::threshold::hash::offset::Offset;
use hashed_alpha::threshold::hash::sine::Sine;
use hashed_alpha::threshold::hash::{Cell, Hash};
use hashed_alpha::threshold::stage::order::Order;
use hashed_alpha::threshold::stage::stratify::{alternating_literal, stratified_literal};
use hashed_alpha::threshold::two_scale::Variant::Isotropic;

pub const ROWS: &[Row] = &[
    Row {
        id: "temporal.blocks",
        place: "§7.2",
        sentence: "Plain temporal antialiasing shows pixel-sized blocks in place of an average over thresholds.",
        measure: blocks,
    },
    Row {
        id: "temporal.noise_scale",
        place: "§7.2.1",
        sentence: "A hash scale of sqrt(1/n) gives n different values in a pixel.",
        measure: values_in_a_pixel,
    },
    Row {
        id: "temporal.noise_scale_unstable",
        place: "§7.2.1",
        sentence: "A hash scale below 1 makes samples less stable under motion.",
        measure: smaller_noise,
    },
    Row {
        id: "temporal.offsets",
        place: "§7.2.2, §9",
        sentence: "Hashes at an offset are independent of each other.",
        measure: offsets,
    },
    Row {
        id: "temporal.independent_flicker",
        place: "§7.2.2",
        sentence: "An exponential average over a cycle of independent thresholds flickers.",
        measure: independent_flicker,
    },
    Row {
        id: "temporal.stratified",
        place: "§7.2.3, Eq. 6",
        sentence: "The n thresholds of a hash value divide [0, 1) evenly.",
        measure: stratified,
    },
    Row {
        id: "temporal.half",
        place: "§7.2.3",
        sentence: "Half of the stratified thresholds are below 1/2.",
        measure: half,
    },
    Row {
        id: "temporal.ascending",
        place: "§7.2.3",
        sentence: "In the order of Eq. 6 the average flickers as with independent hashes.",
        measure: ascending,
    },
    Row {
        id: "temporal.order",
        place: "§7.2.3",
        sentence: "The order j = i/2 + (i mod 2) n/2 visits the strata of an n-frame sequence.",
        measure: order,
    },
    Row {
        id: "temporal.alternates",
        place: "§7.2.3",
        sentence: "In that order every other threshold is below 1/2.",
        measure: alternates,
    },
    Row {
        id: "temporal.sufficient",
        place: "§7.2.3",
        sentence: "That order is the steadiest of the approaches over eight samples.",
        measure: sufficient,
    },
    Row {
        id: "temporal.van_der_corput",
        place: "§7.2.3",
        sentence: "A van der Corput order is better still.",
        measure: van_der_corput,
    },
    Row {
        id: "temporal.eight",
        place: "§7.2",
        sentence: "Eight samples are too few for a converged result.",
        measure: eight_samples,
    },
];

/// The thresholds of a pixel in the eight frames of a jittered camera, for pixels of a frontal plane.
fn jittered_pixels(hash_scale: f64) -> Vec<Vec<f64>> {
    let of = listing(Isotropic, hash_scale);
    (0..4096_u32)
        .map(|p| {
            let plane = Plane::tilted(0.0, 0.01 * libm::exp2(f64::from(p % 16) / 16.0), f64::from(p % 13));
            let (x, y) = (5.0 * f64::from(p % 64), 5.0 * f64::from(p / 64));
            let frame = |i| {
                let [dx, dy] = camera_jitter(i, n(8));
                of(&plane.at(x + dx, y + dy))
            };
            (0..8).map(frame).collect()
        })
        .collect()
}

fn blocks() -> Measured {
    let variance = |pixels: &[Vec<f64>]| {
        let average = |frames: &Vec<f64>| mean(frames.iter().map(|&t| visible(0.5, t))) - 0.5;
        let error = rms(pixels.iter().map(average));
        error * error / 0.25
    };
    let plain = variance(&jittered_pixels(1.0));
    let seen = format!(
        "alpha 1/2, eight jittered frames: the average keeps {plain:.2} of the variance of one frame (independent frames: \
         0.125)"
    );
    judge(4096_u64, plain > 0.3, plain > 0.2, seen)
}

fn values_in_a_pixel() -> Measured {
    let distinct = |frames: &Vec<f64>| {
        let mut frames = frames.clone();
        frames.sort_by(f64::total_cmp);
        frames.dedup();
        frames.len()
    };
    let counts: Vec<usize> = jittered_pixels(noise_scale(n(8))).iter().map(distinct).collect();
    let average = mean(counts.iter().map(|&c| c as f64));
    let full = share(counts.iter().map(|&c| c == 8));
    let seen = format!(
        "n = 8: eight jittered frames see {average:.2} values in the mean, from {} to {}; eight in {} of the pixels",
        counts.iter().min().unwrap_or(&0),
        counts.iter().max().unwrap_or(&0),
        percent(full)
    );
    judge(counts.len() as u64, full > 0.95, average > 4.0, seen)
}

fn smaller_noise() -> Measured {
    let changed = |scale: f64| {
        let of = listing(Isotropic, scale);
        mean((0..16).map(|i| {
            let plane = Plane::tilted(0.0, 0.01 * libm::exp2(f64::from(i) / 16.0), 0.37 * f64::from(i));
            let moved = Plane { origin: plane.origin + 0.125 * plane.dx, ..plane };
            let (before, after) = (plane.image(64, of), moved.image(64, of));
            share(before.iter().zip(&after).map(|(a, b)| a != b))
        }))
    };
    let (one, small) = (changed(1.0), changed(noise_scale(n(8))));
    let seen = format!(
        "a shift of 1/8 pixel changes {} of the thresholds at scale 1, {} at sqrt(1/8)",
        percent(one),
        percent(small)
    );
    judge(16 * 4096, small > 1.3 * one, small > one, seen)
}

fn offsets() -> Measured {
    let cell = |i: u32| Cell::<f32> { index: glam::vec3((i % 128) as f32, (i / 128) as f32, 5.0), octave: 0 };
    let correlation = |offset: [f32; 3]| {
        let other = Offset { hash: Sine, offset: offset.into() };
        let (a, b): (Vec<f64>, Vec<f64>) =
            (0..1 << 14).map(|i| (f64::from(Sine.hash(&cell(i))), f64::from(other.hash(&cell(i))))).unzip();
        pearson(&a, &b).expect("not constant").r
    };
    // The mean of eight frames in a cell and in the next.
    let scrolled = |step: f32| {
        let average = |i: u32| {
            mean((0..8).map(|frame| {
                let offset = [step * frame as f32, 0.0, 0.0].into();
                f64::from(Offset { hash: Sine, offset }.hash(&cell(i)))
            }))
        };
        let (a, b): (Vec<f64>, Vec<f64>) =
            (0..1 << 14).filter(|i| i % 128 < 127).map(|i| (average(i), average(i + 1))).unzip();
        pearson(&a, &b).expect("not constant").r
    };
    let (large, tiny) = (correlation([1013.0, -377.0, 2311.0]), correlation([1e-6, 0.0, 0.0]));
    let (near, far) = (scrolled(1.0), scrolled(1009.0));
    let seen = format!(
        "correlation in a cell: {large:.3} for an offset of thousands of cells, {tiny:.3} for 1e-6; between neighbours, of \
         the mean of eight frames: {near:.3} for offsets (i, 0, 0), {far:.3} for (1009 i, 0, 0)"
    );
    let sound = large.abs() < 0.05 && far.abs() < 0.05;
    judge(1 << 14, sound && tiny.abs() < 0.05 && near.abs() < 0.05, sound, seen)
}

/// The flicker at alpha 1/4 and 1/2.
fn flickers(threshold: impl Fn(f64, u32) -> f64) -> [f64; 2] {
    [0.25, 0.5].map(|alpha| flicker(alpha, &threshold))
}

fn of_order(order: Order) -> [f64; 2] {
    flickers(|chi, i| order.threshold(chi, i, n(8)))
}

fn independent_flicker() -> Measured {
    let found = flickers(independent);
    let seen =
        format!("weight 0.1, n = 8: the average moves within {} at alpha 1/4, 1/2, for ever", list(found));
    judge(CHIS, found.iter().all(|f| *f > 0.05), false, seen)
}

fn stratified() -> Measured {
    let gap = |frames: u32| {
        chis()
            .map(|chi| {
                let mut all: Vec<f64> = (0..frames).map(|i| stratified_literal(chi, i, n(frames))).collect();
                all.sort_by(f64::total_cmp);
                let inner = all.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
                inner.max(all[0] + 1.0 - all[all.len() - 1]) * f64::from(frames)
            })
            .fold(0.0, f64::max)
    };
    let gaps = [3, 8, 13].map(gap);
    let seen = format!("largest gap in strata for n = 3, 8, 13: {}", list(gaps));
    judge(3 * CHIS, gaps.iter().all(|g| (g - 1.0).abs() < 1e-9), false, seen)
}

fn half() -> Measured {
    let exact = |frames: u32| {
        share(chis().map(|chi| {
            2 * (0..frames).filter(|&i| stratified_literal(chi, i, n(frames)) < 0.5).count() as u32 == frames
        }))
    };
    let (even, odd) = (exact(8), exact(7));
    let seen = format!(
        "exactly half for {} of the hash values with n = 8, {} with n = 7",
        percent(even),
        percent(odd)
    );
    judge(2 * CHIS, even == 1.0 && odd == 1.0, even == 1.0, seen)
}

fn ascending() -> Measured {
    let (found, random) = (of_order(Order::Ascending), flickers(independent));
    let seen = format!("ascending {}, independent {} at alpha 1/4, 1/2", list(found), list(random));
    judge(CHIS, found[0] >= random[0] && found[1] >= random[1], false, seen)
}

fn order() -> Measured {
    let is_permutation = |frames: u32| {
        let mut strata: Vec<u32> = (0..frames).map(|i| alternating_literal(i, n(frames))).collect();
        strata.sort_unstable();
        strata.into_iter().eq(0..frames)
    };
    let odd = (3..=64).filter(|frames| frames % 2 == 1 && !is_permutation(*frames)).count();
    let even = (2..=64).filter(|frames| frames % 2 == 0 && is_permutation(*frames)).count();
    let seen = format!("a permutation for {even} of 32 even n, not for {odd} of 31 odd n");
    judge(63_u64, odd == 0 && even == 32, even == 32, seen)
}

fn alternates() -> Measured {
    let of = |order: Order| {
        share(chis().map(|chi| {
            let low = |i| order.threshold(chi, i, n(8)) < 0.5;
            (0..8).all(|i| low(i) != low(i + 1))
        }))
    };
    let (paper, rotated) = (of(Order::AlternatingLiteral), of(Order::PhaseRotated));
    let seen = format!(
        "n = 8: true for {} of the hash values; entered at the stratum of the hash, for {}",
        percent(paper),
        percent(rotated)
    );
    judge(CHIS, paper == 1.0, paper > 0.9, seen)
}

fn sufficient() -> Measured {
    let (paper, up, random) =
        (of_order(Order::AlternatingLiteral), of_order(Order::Ascending), flickers(independent));
    let small = jittered_pixels(noise_scale(n(8)));
    let smaller = [0.25, 0.5].map(|alpha| {
        mean(small.iter().map(|frames| {
            let frames: Vec<f64> = frames.iter().map(|&t| visible(alpha, t)).collect();
            flicker_range(&frames, 0.1)
        }))
    });
    let seen = format!(
        "flicker at alpha 1/4, 1/2: {}; independent {}, ascending {}, smaller noise {}",
        list(paper),
        list(random),
        list(up),
        list(smaller)
    );
    let steadier = |i: usize| [random, up, smaller].iter().all(|other| paper[i] < other[i]);
    judge(CHIS, steadier(0) && steadier(1), steadier(0) || steadier(1), seen)
}

fn van_der_corput() -> Measured {
    let (found, paper) = (of_order(Order::VanDerCorput), of_order(Order::AlternatingLiteral));
    let rotated = of_order(Order::PhaseRotatedVanDerCorput);
    let seen = format!(
        "flicker at alpha 1/4, 1/2: {}, the order above {}; entered at the stratum of the hash {}",
        list(found),
        list(paper),
        list(rotated)
    );
    judge(CHIS, found[0] < paper[0] && found[1] < paper[1], found[0] < paper[0], seen)
}

fn eight_samples() -> Measured {
    let error = |threshold: &dyn Fn(f64, u32) -> f64| {
        rms(chis().map(|chi| mean((0..8).map(|i| visible(0.4, threshold(chi, i)))) - 0.4))
    };
    let (random, strata) = (error(&independent), error(&|chi, i| stratified_literal(chi, i, n(8))));
    let seen = format!(
        "alpha 0.4: error of a pixel {random:.3} rms for independent, {strata:.3} for stratified thresholds"
    );
    judge(CHIS, random > 0.1 && strata > 1.0 / 64.0, random > 0.1, seen)
}
