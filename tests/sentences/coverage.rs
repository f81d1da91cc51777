//! Premultiplied colours, samples of a pixel, and screen doors: §7.3 and §8.

use crate::maps::leaves;
use crate::mask::{self, Mask};
use crate::measure::{list, mean, n, percent, rms, share, value};
use crate::row::{Measured, Row, judge};
use core::num::NonZeroU32;
use hashed_alpha::technique::premultiplied::{Rgba, divide, filtered, premultiply};
use hashed_alpha::threshold::hash::mm4::murmur3;
use hashed_alpha::threshold::stage::coverage::{decorrelated_literal, regular};
use hashed_alpha::threshold::stage::screen_door;

pub const ROWS: &[Row] = &[
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
