//! Hashed alpha in an engine: §7 and §8.

use crate::maps::leaves;
use crate::measure::{
    CHIS, Plane, flicker, independent, list, listing, mean, percent, rms, share, value, visible,
};
use crate::row::{Measured, Row, judge};
use core::num::NonZeroU32;
use hashed_alpha::stats::correlation::pearson;
use hashed_alpha::technique::jitter::camera_jitter;
use hashed_alpha::technique::mask::{self, Mask};
use hashed_alpha::technique::noise_scale::noise_scale;
use hashed_alpha::technique::order::Order;
use hashed_alpha::technique::premultiplied::{Rgba, divide, filtered, premultiply};
use hashed_alpha::technique::screen_door;
use hashed_alpha::threshold::coverage::{decorrelated_literal, regular};
use hashed_alpha::threshold::fade_in::{anisotropy, anisotropy_literal, blend, fade_in};
use hashed_alpha::threshold::hash::integer::murmur3;
use hashed_alpha::threshold::hash::offset::Offset;
use hashed_alpha::threshold::hash::sine::Sine;
use hashed_alpha::threshold::hash::{Cell, Hash};
use hashed_alpha::threshold::stratify::{alternating_literal, stratified_literal};
use hashed_alpha::threshold::two_scale::Variant::Isotropic;

pub const ROWS: &[Row] = &[
    Row {
        id: "fade.ends",
        place: "§7.1, Eqs. 3, 4",
        sentence: "The blend goes from the traditional test at b = 0 to the hashed one at b = 1.",
        measure: fade_ends,
    },
    Row {
        id: "fade.keeps",
        place: "§7.1, Fig. 12",
        sentence: "Fading the noise in keeps distant geometry.",
        measure: fade_keeps,
    },
    Row {
        id: "fade.quadratic",
        place: "§7.1, Eq. 5",
        sentence: "A linear ramp keeps more noise near the camera than a quadratic one.",
        measure: quadratic,
    },
    Row {
        id: "fade.grazing",
        place: "§7.1.1",
        sentence: "Eq. 5 fails at grazing angles; scaling the level by the anisotropy fixes it.",
        measure: grazing,
    },
    Row {
        id: "fade.anisotropy",
        place: "§7.1.1",
        sentence: "The larger ratio of the two texture derivatives is the degree of anisotropy.",
        measure: anisotropy_of_all,
    },
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
    Row {
        id: "colour.halo",
        place: "§7.3",
        sentence: "Without premultiplied alpha, thresholds below 1/2 let colours bleed from transparent texels.",
        measure: halo,
    },
    Row {
        id: "colour.divide",
        place: "§7.3",
        sentence: "Premultiplied colours must be divided by alpha to converge to the ground truth.",
        measure: division,
    },
    Row {
        id: "coverage.floor",
        place: "§8, Eq. 7",
        sentence: "floor(n alpha) coverage bits are equivalent to n tests with the thresholds of Eq. 7.",
        measure: floor,
    },
    Row {
        id: "coverage.one_sample",
        place: "§8",
        sentence: "The traditional test is Eq. 7 with n = 1.",
        measure: one_sample,
    },
    Row {
        id: "coverage.jittered",
        place: "§8, Eq. 8",
        sentence: "Jittered thresholds keep alpha, with one chi or one for each sample.",
        measure: jittered,
    },
    Row {
        id: "coverage.fixed_layers",
        place: "§3, §8, Figs. 1, 9",
        sentence: "Fixed dither patterns correlate layers, so that aggregate geometry loses opacity.",
        measure: fixed_layers,
    },
    Row {
        id: "coverage.decorrelated",
        place: "§8, Eq. 9",
        sentence: "Offset and increment for each fragment decorrelate layers.",
        measure: decorrelated_layers,
    },
    Row {
        id: "coverage.one_of_two",
        place: "§8",
        sentence: "It is enough that one of xi_1, xi_2 differs between layers.",
        measure: one_of_two,
    },
    Row {
        id: "coverage.power_of_two",
        place: "§8",
        sentence: "For powers of two the increment is odd and below n, and every stratum is used.",
        measure: power_of_two,
    },
    Row {
        id: "coverage.random_masks",
        place: "§3",
        sentence: "Random permutations of the pattern (Enderton et al.) solve the correlation of layers.",
        measure: random_masks,
    },
    Row {
        id: "screen_door.masks",
        place: "§3",
        sentence: "Even random screen-door masks correlate layers, and repeat over the screen.",
        measure: door_masks,
    },
    Row {
        id: "screen_door.hashed",
        place: "§8.1",
        sentence: "The same randomisation between pixels decorrelates layers of a screen door.",
        measure: door_hashed,
    },
];

fn n(samples: u32) -> NonZeroU32 {
    NonZeroU32::new(samples).expect("not 0")
}

fn chis() -> impl Iterator<Item = f64> {
    (0..CHIS).map(|i| (f64::from(i) + 0.5) / f64::from(CHIS))
}

fn fade_ends() -> Measured {
    let wrong = chis().filter(|&chi| fade_in(chi, 0.0) != 0.5 || fade_in(chi, 1.0) != chi).count();
    judge(CHIS, wrong == 0, false, format!("{wrong} of {CHIS} thresholds differ from either"))
}

fn fade_keeps() -> Measured {
    let kept = |lod: f64| mean(chis().map(|chi| visible(0.3, fade_in(chi, blend(lod, 6.0)))));
    let lods = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    let shares = lods.map(kept);
    let seen = format!(
        "alpha 0.3, n = 6, kept at levels 1 to 6: {}; alpha below (1 - b) / 2 vanishes while the noise fades in",
        list(shares)
    );
    judge(6 * CHIS, shares.iter().all(|s| *s > 0.25), (shares[5] - 0.3).abs() < 0.01, seen)
}

fn quadratic() -> Measured {
    let lods = [1.0, 2.0, 3.0, 4.0, 5.0];
    let (square, line) = (lods.map(|lod| blend(lod, 6.0)), lods.map(|lod| lod / 6.0));
    let seen =
        format!("share of noise at levels 1 to 5 of 6: quadratic {}, linear {}", list(square), list(line));
    judge(5_u64, square.iter().zip(&line).all(|(a, b)| a < b), false, seen)
}

fn grazing() -> Measured {
    // Sixteen times as long as wide: level 1.5 is read where the longer side has level 5.5.
    let factor = anisotropy([16.0, 1.0]);
    let kept = |lod: f64| mean(chis().map(|chi| visible(0.3, fade_in(chi, blend(lod, 6.0)))));
    let (without, with) = (kept(1.5), kept(factor * 1.5));
    let seen = format!(
        "alpha 0.3, level 1.5, anisotropy 16, n = 6: kept {without:.3} by Eq. 5, {with:.3} with the factor"
    );
    judge(2 * CHIS, without == 0.0 && (with - 0.3).abs() < 0.01, false, seen)
}

fn anisotropy_of_all() -> Measured {
    let lengths = [0.0, 1e-30, 0.25, 1.0, 4.0, 1e30];
    let pairs = lengths.into_iter().flat_map(|x| lengths.into_iter().map(move |y| [x, y]));
    let (with_zero, without): (Vec<_>, Vec<_>) = pairs.partition(|pair| pair.contains(&0.0));
    let wrong =
        |pairs: &[[f64; 2]]| pairs.iter().filter(|pair| !anisotropy_literal(**pair).is_finite()).count();
    let seen = format!(
        "not finite for {} of {} pairs with a 0 among them, for {} of {} others",
        wrong(&with_zero),
        with_zero.len(),
        wrong(&without),
        without.len()
    );
    judge(36_u64, wrong(&with_zero) == 0, wrong(&without) == 0, seen)
}

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
    let seen = format!(
        "flicker at alpha 1/4, 1/2: {}; independent {}, ascending {}",
        list(paper),
        list(random),
        list(up)
    );
    judge(CHIS, paper[0] < random[0] && paper[1] < random[1], paper[1] < random[1], seen)
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

const LEAF: [f64; 3] = [0.0, 1.0, 0.0];
const PAINT: [f64; 3] = [1.0, 0.0, 1.0];

/// The mean colour that is seen through a hashed test at level 4 of a green map with magenta where it is clear: red, and
/// green over what it should be.
fn seen_colour(texel: fn(Rgba) -> Rgba, colour: fn(Rgba) -> [f64; 3]) -> (f64, f64) {
    let map = leaves(256);
    let (mut red, mut green, mut truth) = (0.0, 0.0, 0.0);
    for block in 0..256_usize {
        let corner = (16 * (block % 16), 16 * (block / 16));
        let texels: Vec<Rgba> = (0..256)
            .map(|i| {
                let alpha = f64::from(map.texels[(corner.1 + i / 16) * 256 + corner.0 + i % 16]);
                let [r, g, b] = if alpha > 0.0 { LEAF } else { PAINT };
                texel([r, g, b, alpha])
            })
            .collect();
        let filtered = filtered(&texels);
        for i in 0..256 {
            if filtered[3] >= (f64::from(i) + 0.5) / 256.0 {
                let [r, g, _] = colour(filtered);
                red += r;
                green += g;
            }
        }
        truth += 256.0 * filtered[3];
    }
    (red / truth, green / truth)
}

fn straight(texel: Rgba) -> [f64; 3] {
    [texel[0], texel[1], texel[2]]
}

fn halo() -> Measured {
    let (bled, green) = seen_colour(|texel| texel, straight);
    let (clean, _) = seen_colour(premultiply, divide);
    let seen = format!(
        "green leaves on magenta paint, level 4: {bled:.3} of what is seen is magenta and {green:.3} green; premultiplied \
         {clean:.3} magenta"
    );
    judge(256 * 256, bled > 0.05 && clean == 0.0, false, seen)
}

fn division() -> Measured {
    let ((_, with), (_, without)) = (seen_colour(premultiply, divide), seen_colour(premultiply, straight));
    let seen = format!("green over its true value: {with:.3} with the division, {without:.3} without");
    judge(256 * 256, (with - 1.0).abs() < 0.01 && without < 0.95, false, seen)
}

fn floor() -> Measured {
    let alphas = 10_000;
    let alpha = |i: u32| (f64::from(i) + 0.5) / f64::from(alphas);
    let differ = |samples| {
        share((0..alphas).map(|i| {
            mask::hardware(alpha(i), n(samples)).count_ones()
                != mask::fixed_dither(alpha(i), n(samples)).count_ones()
        }))
    };
    let bias = |kind: fn(f64, NonZeroU32) -> Mask| {
        mean((0..alphas).map(|i| mask::coverage(kind(alpha(i), n(8)), n(8)) - alpha(i)))
    };
    let seen = format!(
        "they differ for {} of all alphas (n = 4), {} (n = 8); mean error of coverage for n = 8: floor {:.4}, Eq. 7 {:.4}",
        percent(differ(4)),
        percent(differ(8)),
        bias(mask::hardware),
        bias(mask::fixed_dither)
    );
    judge(alphas, differ(8) == 0.0, false, seen)
}

fn one_sample() -> Measured {
    let threshold: f64 = regular(0, n(1));
    judge(1_u64, threshold == 0.5, false, format!("its threshold is {threshold}"))
}

const PIXELS: u32 = 8192;

/// Mean and standard deviation of the coverage of one layer.
fn single(alpha: f64, mask: impl Fn(u32) -> Mask) -> (f64, f64) {
    let covered = |p| mask::coverage(mask(p), n(8));
    (mean((0..PIXELS).map(covered)), rms((0..PIXELS).map(|p| covered(p) - alpha)))
}

fn jittered() -> Measured {
    let one = single(0.3, |p| mask::stratified(0.3, n(8), |_| value([p, 0, 20, 0])));
    let each = single(0.3, |p| mask::stratified(0.3, n(8), |i| value([p, i, 21, 0])));
    let random = (0.21_f64 / 8.0).sqrt();
    let seen = format!(
        "alpha 0.3, n = 8: mean {:.3} and {:.3}, deviation {:.3} and {:.3} (random thresholds: {random:.3})",
        one.0, each.0, one.1, each.1
    );
    let near = |mean: f64| (mean - 0.3).abs() < 0.005;
    judge(PIXELS, near(one.0) && near(each.0) && one.1 < random && each.1 < random, near(one.0), seen)
}

/// The coverage of two, four and eight layers of alpha 1/2 by masks of a pixel and layer.
fn layered(mask: impl Fn(u32, u32) -> Mask) -> [f64; 3] {
    [2, 4, 8].map(|layers| {
        mean((0..PIXELS).map(|p| mask::coverage((0..layers).fold(0, |all, l| all | mask(p, l)), n(8))))
    })
}

const PRODUCT: [f64; 3] = [0.75, 0.9375, 0.996_093_75];

fn is_product(found: [f64; 3]) -> bool {
    found.iter().zip(PRODUCT).all(|(found, product)| (found - product).abs() < 0.006)
}

fn layers_seen(found: [f64; 3]) -> String {
    format!("2, 4, 8 layers of alpha 1/2 cover {} (product law: 0.750, 0.938, 0.996)", list(found))
}

fn fixed_layers() -> Measured {
    let found = layered(|_, _| mask::fixed_dither(0.5, n(8)));
    judge(3 * PIXELS, found == [0.5; 3], found[0] < 0.7, layers_seen(found))
}

/// A mask of Eq. 9 to the letter; the words say with what xi_1 and xi_2 vary.
fn equation_9(p: u32, l: u32, first: u32, second: u32) -> Mask {
    let xi = [value([p, first, 22, 0]), value([p, second, 23, 0])];
    mask::permuted_literal(0.5, n(8), xi, |i| value([p, l, i, 24]))
}

fn decorrelated_layers() -> Measured {
    let found = layered(|p, l| equation_9(p, l, l, l));
    judge(3 * PIXELS, is_product(found), found[0] > 0.7, format!("n = 8: {}", layers_seen(found)))
}

fn one_of_two() -> Measured {
    let (offset, step) = (layered(|p, l| equation_9(p, l, l, 0)), layered(|p, l| equation_9(p, l, 0, l)));
    let seen = format!("only xi_1 differs: {}; only xi_2: {}", list(offset), layers_seen(step));
    judge(
        6 * PIXELS,
        is_product(offset) && is_product(step),
        is_product(offset) || is_product(step) || offset[0] > 0.7,
        seen,
    )
}

fn power_of_two() -> Measured {
    let missed = |samples: u32| {
        share((0..3000).map(|i| {
            let xi = [0.3, (f64::from(i) + 0.5) / 3000.0];
            let mut strata: Vec<u32> =
                (0..samples).map(|s| decorrelated_literal(xi, s, n(samples))).collect();
            strata.sort_unstable();
            !strata.into_iter().eq(0..samples)
        }))
    };
    let (powers, others) = ([2, 4, 8, 16, 32].map(missed), [3, 5, 6, 15].map(missed));
    let seen = format!(
        "strata are missed in {} of the draws for n = 2 to 32; for n = 3, 5, 6, 15, to which it is not limited, in {}",
        percent(mean(powers)),
        others.map(percent).join(", ")
    );
    judge(9 * 3000, powers == [0.0; 5], false, seen)
}

fn random_masks() -> Measured {
    let found = layered(|p, l| mask::random_set(0.5, n(8), value([p, l, 25, 0]), murmur3([p, l, 26, 0])));
    judge(3 * PIXELS, is_product(found), found[0] > 0.7, layers_seen(found))
}

/// The coverage of two, four and eight layers of alpha 1/2 by thresholds of a pixel and layer.
fn doors(threshold: impl Fn([u32; 2], u32) -> f64) -> [f64; 3] {
    [2, 4, 8].map(|layers| {
        share((0..128 * 128).map(|i| (0..layers).any(|l| 0.5 >= threshold([i % 128, i / 128], l))))
    })
}

fn door_masks() -> Measured {
    let (fixed, random) = (doors(|p, _| screen_door::fixed(p)), doors(|p, _| screen_door::random_mask(p, 9)));
    let repeats = share((0..4096).map(|i| {
        let [x, y] = [i % 64, i / 64];
        let threshold: f64 = screen_door::random_mask([x, y], 9);
        threshold == screen_door::random_mask::<f64>([x + screen_door::TILE, y], 9)
    }));
    let seen = format!(
        "fixed {}; random {}; {} of the thresholds repeat",
        list(fixed),
        layers_seen(random),
        percent(repeats)
    );
    judge(6 * 16_384, random == [0.5; 3] && fixed == [0.5; 3] && repeats == 1.0, false, seen)
}

fn door_hashed() -> Measured {
    let found = doors(screen_door::randomised);
    let near = found.iter().zip(PRODUCT).all(|(found, product)| (found - product).abs() < 0.01);
    judge(3 * 16_384, near, found[0] > 0.7, layers_seen(found))
}
