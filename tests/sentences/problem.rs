//! Why geometry disappears, and the remedies: §1 to §3.

use crate::maps::{Map, fence, inverse, leaves, noise};
use crate::measure::{list, mean, percent, rms, share, value};
use crate::row::{Measured, Row, judge};
use core::num::NonZeroU32;
use hashed_alpha::technique::conservative::{corrected, covers_centre, sub_pixel_coverage};
use hashed_alpha::technique::jitter::camera_jitter;
use hashed_alpha::technique::prior_work::Level;
use hashed_alpha::technique::prior_work::finest_level::{limited, stride};
use hashed_alpha::technique::prior_work::level_threshold::{level_threshold, texel_thresholds};
use hashed_alpha::technique::prior_work::scaled_alpha::{alpha_scale, scaled, scaled_by_texel};
use hashed_alpha::technique::prior_work::supersampling::{side_needed, supersampled};
use hashed_alpha::technique::prior_work::test_then_blend::{Layer, naive, sorted, test_then_blend};

pub const ROWS: &[Row] = &[
    Row {
        id: "problem.prefilter",
        place: "§1",
        sentence: "Filtering the alpha map does not antialias an alpha test, whose result stays binary.",
        measure: prefilter,
    },
    Row {
        id: "problem.variance",
        place: "§2",
        sentence: "A box filter makes the variance of alpha smaller in each coarser level.",
        measure: variance,
    },
    Row {
        id: "problem.average",
        place: "§2, Fig. 2",
        sentence: "The coarsest level is the mean alpha of the map.",
        measure: average,
    },
    Row {
        id: "problem.passing",
        place: "§2",
        sentence: "Fewer and fewer texels pass the test in coarser levels.",
        measure: passing,
    },
    Row {
        id: "problem.erosion",
        place: "§2, Fig. 3",
        sentence: "With distance a wire thins to one pixel and is then gone at once.",
        measure: erosion,
    },
    Row {
        id: "problem.billboards",
        place: "§2, Fig. 4",
        sentence: "Pixel centres miss cards below a pixel, so that coverage seems lost.",
        measure: billboards,
    },
    Row {
        id: "problem.multisampling",
        place: "§2",
        sentence: "Multisampling and conservative rasterisation reduce that loss.",
        measure: multisampling,
    },
    Row {
        id: "problem.conservative",
        place: "Fig. 4",
        sentence: "Conservative rasterisation over-samples small cards unless the threshold allows for their share of a \
                   pixel.",
        measure: conservative,
    },
    Row {
        id: "remedies.level_threshold",
        place: "§3, Eq. 1",
        sentence: "A threshold for each level keeps the share of passing texels.",
        measure: per_level,
    },
    Row {
        id: "remedies.content",
        place: "§3",
        sentence: "That threshold differs between maps, and within a level.",
        measure: content,
    },
    Row {
        id: "remedies.disappears",
        place: "§3, Fig. 3",
        sentence: "Even with a perfect threshold for each level geometry disappears.",
        measure: disappears,
    },
    Row {
        id: "remedies.scaled_alpha",
        place: "§3",
        sentence: "Scaling the alphas of a level is equivalent to a threshold of its own.",
        measure: scaling,
    },
    Row {
        id: "remedies.texel",
        place: "§3",
        sentence: "Adjusting each texel may still only dilate the borders of alpha.",
        measure: by_texel,
    },
    Row {
        id: "remedies.finest_level",
        place: "§3",
        sentence: "Alpha from the finest level avoids the loss.",
        measure: finest,
    },
    Row {
        id: "remedies.stability",
        place: "§3",
        sentence: "Alpha from a level finer than the footprint makes fine detail unstable in time.",
        measure: finest_is_unstable,
    },
    Row {
        id: "remedies.naive_blend",
        place: "§3",
        sentence: "Naive blending pollutes the depth buffer: transparent fragments hide opaque ones.",
        measure: naive_blending,
    },
    Row {
        id: "remedies.test_then_blend",
        place: "§3",
        sentence: "Alpha test first and blending after it never lets a transparent fragment hide an opaque one.",
        measure: testing_then_blending,
    },
    Row {
        id: "remedies.supersampling",
        place: "§3",
        sentence: "Dense supersampling of binary alpha gives accurate visibility; the density needed has no bound.",
        measure: supersampling,
    },
];

fn prefilter() -> Measured {
    let chain = leaves(256).chain();
    let truth = &chain[4].texels;
    let error = rms(truth.iter().map(|&alpha| f64::from(alpha) - f64::from(u8::from(alpha >= 0.5))));
    let seen = format!(
        "error of a texel at level 4 after the test: {error:.3} rms, the filtered alpha itself has none"
    );
    judge(truth.len(), error > 0.05, false, seen)
}

fn variance() -> Measured {
    let variances = |map: Map| {
        let of = |map: &Map| {
            let level = map.level();
            mean(level.texels.iter().map(|&a| f64::from(a) * f64::from(a))) - level.mean() * level.mean()
        };
        map.chain()[..7].iter().map(of).collect::<Vec<_>>()
    };
    let (tree, wires) = (variances(leaves(256)), variances(fence(256)));
    let falls = |v: &[f64]| v.windows(2).all(|pair| pair[1] <= pair[0] + 1e-9);
    let seen = format!("levels 0 to 6: leaves {}; fence {}", list(tree.clone()), list(wires.clone()));
    judge(256 * 256, falls(&tree) && falls(&wires), false, seen)
}

fn average() -> Measured {
    let chain = leaves(256).chain();
    let (base, last) = (chain[0].level().mean(), chain[8].level().mean());
    judge(256 * 256, (base - last).abs() < 1e-6, false, format!("{base:.4} and {last:.4}"))
}

fn passing() -> Measured {
    let shares = |map: Map| map.chain().iter().map(|m| m.level().passing_share(0.5)).collect::<Vec<_>>();
    let dense = inverse(&leaves(256));
    let [tree, wires, dense] = [leaves(256), fence(256), dense].map(shares);
    let falls = |shares: &[f64]| shares[8] < shares[0] && shares[6] <= shares[0];
    let seen = format!(
        "levels 0, 4, 6, 8: leaves {}; fence {}; a map of mean alpha above 1/2 gains: {}",
        list([0, 4, 6, 8].map(|i| tree[i])),
        list([0, 4, 6, 8].map(|i| wires[i])),
        list([0, 4, 6, 8].map(|i| dense[i]))
    );
    judge(3 * 256 * 256, falls(&tree) && falls(&wires) && falls(&dense), falls(&tree) && falls(&wires), seen)
}

fn erosion() -> Measured {
    let n = 4000;
    let pixels = |width: f64| {
        mean((0..n).map(|i| {
            let left = 2.0 + value([i, 0, 1, 0]);
            let covered = |pixel: i32| sub_pixel_coverage([left, 0.0, left + width, 1.0], [pixel, 0]);
            (0..12).filter(|&pixel| covered(pixel) >= 0.5).count() as f64
        }))
    };
    let widths = [5.0, 2.0, 1.0, 0.7, 0.5, 0.4];
    let kept = widths.map(pixels);
    let seen = format!("wires of {} pixels keep {} pixels", list(widths), list(kept));
    judge(n, (kept[0] - 5.0).abs() < 0.05 && (kept[2] - 1.0).abs() < 0.05 && kept[5] == 0.0, false, seen)
}

const CARDS: u32 = 20_000;

/// Pixels that a card of 0.3 pixels is drawn in, in the mean, and the share of cards in none.
fn cards(alpha: f64, keeps: impl Fn([f64; 4], [i32; 2], f64) -> bool) -> (f64, f64) {
    let counts: Vec<f64> = (0..CARDS)
        .map(|card| {
            let corner = [0, 1].map(|axis| 1.0 + value([card, axis, 2, 0]));
            let area = [corner[0], corner[1], corner[0] + 0.3, corner[1] + 0.3];
            let drawn = (0..16_i32).map(|i| [i % 4, i / 4]).filter(|&pixel| {
                alpha > 0.0 && keeps(area, pixel, value([card, pixel[0] as u32, pixel[1] as u32, 3]))
            });
            drawn.count() as f64
        })
        .collect();
    (mean(counts.iter().copied()), share(counts.iter().map(|&count| count == 0.0)))
}

fn billboards() -> Measured {
    let (area, lost) = cards(1.0, |card, pixel, _| covers_centre(card, pixel));
    let seen = format!(
        "of cards of 0.3 pixels {} are not drawn, and yet their mean area is kept: {area:.4} of 0.0900 pixels",
        percent(lost)
    );
    judge(CARDS, area < 0.08, lost > 0.5 && (area - 0.09).abs() < 0.008, seen)
}

fn multisampling() -> Measured {
    let n = NonZeroU32::new(8).expect("not 0");
    let samples: Vec<[f64; 2]> = (0..8).map(|i| camera_jitter(i, n)).collect();
    let (_, one) = cards(1.0, |card, pixel, _| covers_centre(card, pixel));
    let (_, eight) = cards(1.0, |[left, top, right, bottom], pixel, _| {
        samples.iter().any(|[x, y]| covers_centre([left - x, top - y, right - x, bottom - y], pixel))
    });
    let (_, all) = cards(1.0, |card, pixel, _| sub_pixel_coverage(card, pixel) > 0.0);
    let seen = format!(
        "not drawn: one sample {}, eight {}, conservative {}",
        percent(one),
        percent(eight),
        percent(all)
    );
    judge(CARDS, eight < one && all == 0.0, false, seen)
}

fn conservative() -> Measured {
    let (plain, _) = cards(0.7, |card, pixel, t| sub_pixel_coverage(card, pixel) > 0.0 && 0.7 >= t);
    let (right, _) = cards(0.7, |card, pixel, t| 0.7 >= corrected(t, sub_pixel_coverage(card, pixel)));
    let truth = 0.7 * 0.09;
    let seen = format!(
        "cards of 0.3 pixels, alpha 0.7: {:.1} times their coverage; with threshold / coverage {:.2} times",
        plain / truth,
        right / truth
    );
    judge(CARDS, plain > 2.0 * truth && (right / truth - 1.0).abs() < 0.1, false, seen)
}

fn per_level() -> Measured {
    let chain = leaves(256).chain();
    let wanted = chain[0].level().passing_share(0.5);
    let of = |threshold: &dyn Fn(Level<'_>) -> f32| {
        chain.iter().map(|map| map.level().passing_share(threshold(map.level()))).collect::<Vec<_>>()
    };
    let (kept, fixed) = (of(&|level| level_threshold(level, wanted)), of(&|_| 0.5));
    let error = |i: usize| (kept[i] - wanted).abs();
    let seen = format!(
        "leaves, share at levels 0, 2, 4, 5, 6, 7: {} (fixed threshold: {})",
        list([0, 2, 4, 5, 6, 7].map(|i| kept[i])),
        list([0, 2, 4, 5, 6, 7].map(|i| fixed[i]))
    );
    judge(256 * 256, (0..9).all(|i| error(i) < 0.02), (0..6).all(|i| error(i) < 0.02), seen)
}

fn content() -> Measured {
    let of = |map: Map| {
        let wanted = map.level().passing_share(0.5);
        map.chain()[2..6].iter().map(|m| f64::from(level_threshold(m.level(), wanted))).collect::<Vec<_>>()
    };
    let [tree, dense, coin] = [leaves(256), inverse(&leaves(256)), noise(256)].map(of);
    let chain = leaves(256).chain();
    let mut local = texel_thresholds(chain[4].level(), chain[0].level(), 0.5, 2);
    local.retain(|threshold| threshold.is_finite());
    local.sort_by(f32::total_cmp);
    let (low, high) = (local[local.len() / 20], local[local.len() - 1 - local.len() / 20]);
    let seen = format!(
        "levels 2 to 5: leaves {}; what they leave free {}; random texels {}; windows of 5 x 5 texels of level 4 of the leaves: \
         {low:.2} to {high:.2} (nine in ten)",
        list(tree.clone()),
        list(dense.clone()),
        list(coin)
    );
    judge(3 * 256 * 256, (tree[3] - dense[3]).abs() > 0.02 && high - low > 0.1, false, seen)
}

fn disappears() -> Measured {
    let chain = fence(256).chain();
    let wanted = chain[0].level().passing_share(0.5);
    let kept: Vec<f64> =
        chain.iter().map(|map| map.level().passing_share(level_threshold(map.level(), wanted))).collect();
    let seen = format!("fence, share at levels 0 to 8: {}", list(kept.clone()));
    judge(256 * 256, kept[8] == 0.0 && kept[0] > 0.2, false, seen)
}

fn scaling() -> Measured {
    let (mut texels, mut wrong) = (0, 0);
    for map in [leaves(256), fence(256)] {
        let wanted = map.level().passing_share(0.5);
        for map in map.chain() {
            let level = map.level();
            let threshold = level_threshold(level, wanted);
            let scaled = scaled(level, alpha_scale(level, wanted, 0.5));
            texels += scaled.len();
            wrong +=
                scaled.iter().zip(level.texels).filter(|(s, a)| (**s >= 0.5) != (**a >= threshold)).count();
        }
    }
    judge(texels, wrong == 0, false, format!("{wrong} texels of {texels} pass one test and not the other"))
}

/// The mean alpha of scaled levels, in mean alphas of the map: by level and by texel.
fn densities(level: usize) -> [f64; 2] {
    let chain = leaves(256).chain();
    let (base, coarse) = (chain[0].level(), chain[level].level());
    let by_level = scaled(coarse, alpha_scale(coarse, base.passing_share(0.5), 0.5));
    let by_texel = scaled_by_texel(coarse, base, 0.5, 2);
    [by_level, by_texel].map(|texels| Level { texels: &texels, ..coarse }.mean() / base.mean())
}

fn by_texel() -> Measured {
    let all = [3, 4, 5].map(densities);
    let seen = format!(
        "leaves, thresholds from windows of 5 x 5 texels: mean alpha at levels 3, 4, 5 is {} times that of the map (by \
         level: {})",
        list(all.map(|d| d[1])),
        list(all.map(|d| d[0]))
    );
    judge(3 * 256 * 256, all.iter().all(|d| d[1] > 1.02), all.iter().any(|d| d[1] > 1.02), seen)
}

/// What the pixels of a footprint of level 4 show, for each place of their grid in steps of one texel.
fn frames(shows: impl Fn(usize, usize) -> bool) -> Vec<Vec<bool>> {
    let step = stride(4.0, limited(4.0, 0.0)) as usize;
    let places = || (0..256).step_by(step).flat_map(|y| (0..256).step_by(step).map(move |x| (x, y)));
    let all = |row: usize, phase: usize| places().map(|(x, y)| shows(x + phase, y + row)).collect();
    (0..step)
        .flat_map(|row| (0..step).map(move |phase| (row, phase)))
        .map(|(row, phase)| all(row, phase))
        .collect()
}

fn finest() -> Measured {
    let map = leaves(256);
    let truth = map.level().passing_share(0.5);
    let kept = mean(
        frames(|x, y| map.texels[y * 256 + x] >= 0.5).into_iter().flatten().map(|v| f64::from(u8::from(v))),
    );
    let fixed = map.chain()[4].level().passing_share(0.5);
    let seen = format!("leaves at level 4: {kept:.3} of {truth:.3} kept; by the level itself {fixed:.3}");
    judge(256 * 256, (kept - truth).abs() < 1e-9, (kept - truth).abs() < 0.03, seen)
}

fn finest_is_unstable() -> Measured {
    // The last frame of a row and the first of the next are not neighbours.
    let flips = |frames: &[Vec<bool>]| {
        let pairs = frames.chunks(16).flat_map(|row| row.windows(2));
        mean(pairs.map(|pair| share(pair[0].iter().zip(&pair[1]).map(|(a, b)| a != b))))
    };
    let found = [leaves(256), noise(256)].map(|map| {
        let finest = flips(&frames(|x, y| map.texels[y * 256 + x] >= 0.5));
        let chain = map.chain();
        let place = |c: usize| (c as f64 + 0.5) / 16.0;
        [finest, flips(&frames(|x, y| chain[4].at(place(x), place(y)) >= 0.5))]
    });
    let seen = format!(
        "level 4, a shift of 1/16 pixel: of leaves {} flip, by the level itself {}; of random texels {} and {}",
        percent(found[0][0]),
        percent(found[0][1]),
        percent(found[1][0]),
        percent(found[1][1])
    );
    judge(2 * 256 * 240, found.iter().all(|[finest, own]| finest > own), found[1][0] > found[1][1], seen)
}

const STACKS: u32 = 10_000;

/// The share of random stacks of one opaque and four transparent fragments, in random order, in which the opaque one has
/// not the weight that it has under sorted blending.
fn wrong_weight(blend: fn(&[Layer]) -> f64) -> f64 {
    share((0..STACKS).map(|stack| {
        let layers: Vec<Layer> = (0..5)
            .map(|i| {
                let opaque = i == stack % 5;
                Layer {
                    depth: value([stack, i, 4, 0]),
                    alpha: if opaque { 1.0 } else { 0.45 * value([stack, i, 5, 0]) },
                    value: f64::from(u8::from(opaque)),
                }
            })
            .collect();
        (blend(&layers) - sorted(&layers, 0.0)).abs() > 1e-9
    }))
}

fn naive_blending() -> Measured {
    let wrong = wrong_weight(|layers| naive(layers, 0.0));
    judge(
        STACKS,
        wrong > 0.1,
        false,
        format!("wrong weight of the opaque fragment in {} of the stacks", percent(wrong)),
    )
}

fn testing_then_blending() -> Measured {
    let wrong = wrong_weight(|layers| test_then_blend(layers, 0.0, 0.5));
    judge(
        STACKS,
        wrong == 0.0,
        false,
        format!("wrong weight of the opaque fragment in {} of the stacks", percent(wrong)),
    )
}

fn supersampling() -> Measured {
    let chain = leaves(256).chain();
    let error = |side: u32| {
        rms(chain[4].texels.iter().enumerate().map(|(i, &truth)| {
            let corner = (16 * (i % 16), 16 * (i / 16));
            let sample = |x: f64, y: f64| {
                f64::from(
                    chain[0].texels[(corner.1 + (16.0 * y) as usize) * 256 + corner.0 + (16.0 * x) as usize],
                )
            };
            supersampled(side, sample) - f64::from(truth)
        }))
    };
    let errors = [1, 2, 4, 8, side_needed(4.0)].map(error);
    let seen = format!(
        "leaves at level 4: error {} rms for 1, 2, 4, 8, 16 samples a side; level 8 needs {} a side",
        list(errors),
        side_needed(8.0)
    );
    judge(256, errors[4] < 1e-7 && errors[3] > 1e-3, false, seen)
}
