//! Humus 2009 and Ols 2009.

use crate::mask;
use crate::measure::{list, mean, percent, rms, share, value};
use crate::row::{Measured, Row, judge};
use core::num::NonZeroU32;
use hashed_alpha::threshold::stage::screen_door;
use hashed_alpha::threshold::stage::stipple::{Density, keeps, keeps_in_words, keeps_literal};

pub const HUMUS: &[Row] = &[
    Row {
        id: "pixel_masks.patterns",
        place: "article",
        sentence: "Alpha-to-coverage of hardware shows obvious, repetitive patterns; a value of the pixel breaks them up.",
        measure: patterns,
    },
    Row {
        id: "pixel_masks.noise",
        place: "comment of 29 January",
        sentence: "It is slightly noisier than alpha-to-coverage of hardware.",
        measure: noise,
    },
    Row {
        id: "pixel_masks.mean",
        place: "article",
        sentence: "A better sample mask than that of hardware gives better quality.",
        measure: quality,
    },
];

pub const OLS: &[Row] = &[
    Row {
        id: "stipple.density",
        place: "Implementation",
        sentence: "Of 2 x 2 pixels three are opaque and one transparent; the variation keeps the other one.",
        measure: density,
    },
    Row {
        id: "stipple.padding",
        place: "Implementation",
        sentence: "A hole is one pixel in size, with a kept pixel on all sides.",
        measure: padding,
    },
    Row {
        id: "stipple.screen",
        place: "Implementation",
        sentence: "Aligned to the surface in place of the screen the pattern would shimmer when the camera moves.",
        measure: screen_aligned,
    },
    Row {
        id: "stipple.pseudo_code",
        place: "Pseudo-code",
        sentence: "The pseudo-code discards where both halved positions exceed 1/2.",
        measure: pseudo_code,
    },
    Row {
        id: "stipple.order",
        place: "Properties",
        sentence: "Objects that overlap themselves do not pop, and need no sorting.",
        measure: order,
    },
    Row {
        id: "stipple.one_layer",
        place: "Properties",
        sentence: "There is one layer of translucency: the nearest surface hides those behind it.",
        measure: one_layer,
    },
    Row {
        id: "stipple.distance",
        place: "Properties",
        sentence: "The holes have a constant size, so translucency gets worse with distance.",
        measure: distance,
    },
    Row {
        id: "stipple.occlusion",
        place: "Properties, Fig. 3",
        sentence: "Screen-space ambient occlusion becomes dark and bright spots all over the surface.",
        measure: occlusion,
    },
    Row {
        id: "stipple.smaller_buffers",
        place: "Properties, Fig. 3",
        sentence: "In smaller buffers the object vanishes, is opaque or becomes a grid, by the size that is picked.",
        measure: smaller_buffers,
    },
    Row {
        id: "stipple.upscaled",
        place: "Update 1",
        sentence: "At a lower resolution that is scaled up it can look bad.",
        measure: upscaled,
    },
];

const N: NonZeroU32 = NonZeroU32::new(8).unwrap();

/// What stands for hardware: one dither for tiles of 4 x 4 pixels, since the source sees its patterns repeat. Which one the
/// card of the source has, it does not say.
fn tiled(alpha: f64, pixel: [u32; 2]) -> u32 {
    mask::stratified(alpha, N, |_| screen_door::fixed(pixel))
}

fn patterns() -> Measured {
    let alpha = 0.45;
    let repeated = |mask: &dyn Fn([u32; 2]) -> u32| {
        let tile = screen_door::TILE;
        share((0..4096).map(|i| mask([i % 64, i / 64]) == mask([i % 64 + tile, i / 64])))
    };
    let (tiles, own) = (repeated(&|p| tiled(alpha, p)), repeated(&|p| mask::by_pixel(alpha, N, p)));
    let seen = format!(
        "alpha 0.45, n = 8: a dither of tiles is the same one tile on in {}, a value of the pixel in {} of the pixels (by chance \
         6.5 %)",
        percent(tiles),
        percent(own)
    );
    judge(4096_u64, tiles > 0.9 && own < 0.2, own < 0.5 * tiles, seen)
}

/// The deviation of the coverage of pixels from their mean, over alphas.
fn deviations(kind: impl Fn(f64, [u32; 2]) -> u32) -> (f64, f64) {
    let alphas = || (1..20).map(|a| f64::from(a) / 20.0);
    let covered = |alpha: f64| (0..1024).map(move |i| (alpha, [i % 32, i / 32]));
    let of = |(alpha, p): (f64, [u32; 2])| mask::coverage(kind(alpha, p), N);
    let noise = rms(alphas().flat_map(|alpha| {
        let all: Vec<f64> = covered(alpha).map(of).collect();
        let average = mean(all.iter().copied());
        all.into_iter().map(move |c| c - average).collect::<Vec<_>>()
    }));
    let bias = rms(alphas().map(|alpha| mean(covered(alpha).map(of)) - alpha));
    (noise, bias)
}

/// The deviation of the mean coverage of tiles from alpha, over alphas.
fn deviation_of_tiles(kind: impl Fn(f64, [u32; 2]) -> u32) -> f64 {
    let tile = screen_door::TILE;
    let alphas = || (1..20).map(|a| f64::from(a) / 20.0);
    rms(alphas().flat_map(|alpha| {
        let kind = &kind;
        (0..256).map(move |i| {
            let corner = [i % 16 * tile, i / 16 * tile];
            let inside = (0..tile * tile).map(|k| [corner[0] + k % tile, corner[1] + k / tile]);
            mean(inside.map(|pixel| mask::coverage(kind(alpha, pixel), N))) - alpha
        })
    }))
}

fn noise() -> Measured {
    let by_pixel = |alpha, p| mask::by_pixel(alpha, N, p);
    let (own, hardware) = (deviations(by_pixel).0, deviations(tiled).0);
    let tiles = [deviation_of_tiles(by_pixel), deviation_of_tiles(tiled)];
    let seen = format!(
        "n = 8, against a dither of tiles of 4 x 4 pixels: deviation of the coverage of a pixel {own:.3} and {hardware:.3}, of a tile \
         {:.4} and {:.4}",
        tiles[0], tiles[1]
    );
    let slightly = |[own, other]: [f64; 2]| own > other && own < 1.5 * other;
    judge(
        19 * 4096,
        slightly([own, hardware]) && slightly(tiles),
        own < 1.5 * hardware && tiles[0] > tiles[1],
        seen,
    )
}

fn quality() -> Measured {
    let own = deviations(|alpha, p| mask::by_pixel(alpha, N, p)).1;
    let floor = deviations(|alpha, _| mask::hardware(alpha, N)).1;
    let layers = mean((0..4096).map(|i| {
        let layers = (0..2).fold(0, |all, _| all | mask::by_pixel(0.5, N, [i % 64, i / 64]));
        mask::coverage(layers, N)
    }));
    let seen = format!(
        "error of the mean coverage over alphas: {own:.4}, floor(n alpha) {floor:.4}; but two layers of alpha 1/2 still cover \
         {layers:.3}, since they share the value"
    );
    judge(19 * 1024, own < 0.5 * floor && layers > 0.7, own < 0.5 * floor, seen)
}

const SIDE: u32 = 96;

fn pixels() -> impl Iterator<Item = [u32; 2]> {
    (0..SIDE * SIDE).map(|i| [i % SIDE, i / SIDE])
}

fn high(pixel: [u32; 2]) -> bool {
    keeps(Density::High, pixel)
}

fn density() -> Measured {
    let of = |density| share(pixels().map(|p| keeps(density, p)));
    let (high, low) = (of(Density::High), of(Density::Low));
    judge(
        SIDE * SIDE,
        high == 0.75 && low == 0.25,
        false,
        format!("kept: {} and {}", percent(high), percent(low)),
    )
}

fn padding() -> Measured {
    let holes: Vec<[u32; 2]> = pixels().filter(|&p| !high(p)).collect();
    let padded = share(
        holes.iter().map(|&[x, y]| (0..9).filter(|&i| i != 4).all(|i| high([x + i % 3 - 1, y + i / 3 - 1]))),
    );
    judge(holes.len() as u64, padded == 1.0, false, format!("{} of the holes", percent(padded)))
}

fn screen_aligned() -> Measured {
    // A surface whose own pixels are as large as those of the screen, and that moves by a third of one.
    let on_surface = |[x, y]: [u32; 2], shift: f64| {
        high([(f64::from(x) + 0.5 + shift).floor() as u32, (f64::from(y) + 0.5 + 0.6 * shift).floor() as u32])
    };
    let flips = share((1..4).flat_map(|step| {
        pixels()
            .map(move |p| on_surface(p, 0.3 * f64::from(step)) != on_surface(p, 0.3 * f64::from(step - 1)))
    }));
    let seen = format!(
        "steps of 0.3 pixels: {} of the pixels flip in a frame aligned to the surface, none aligned to the screen",
        percent(flips)
    );
    judge(3 * SIDE * SIDE, flips > 0.05, flips > 0.0, seen)
}

fn pseudo_code() -> Measured {
    let at = |[x, y]: [u32; 2], shift: f64| [f64::from(x) + shift, f64::from(y) + shift];
    let kept = |test: fn([f64; 2]) -> bool, shift| share(pixels().map(|p| test(at(p, shift))));
    let same = share(pixels().map(|p| keeps_literal(at(p, 0.5)) == keeps_in_words(at(p, 0.5))));
    let seen = format!(
        "it discards where both are at most 1/2: at pixel centres {} are kept, by leaving out the pixel opposite to that of the words (the same for {} of the pixels); at \
         whole positions it keeps {} and the words {}",
        percent(kept(keeps_literal, 0.5)),
        percent(same),
        percent(kept(keeps_literal, 0.0)),
        percent(kept(keeps_in_words, 0.0))
    );
    let same_at = |shift| pixels().all(|p| keeps_literal(at(p, shift)) == keeps_in_words(at(p, shift)));
    judge(SIDE * SIDE, same_at(0.5) && same_at(0.0), same_at(0.5) || same_at(0.0), seen)
}

/// What is seen of two stippled layers and a wall, drawn one after the other with a depth test.
fn drawn(order: [u32; 3], pixel: [u32; 2]) -> u32 {
    order.into_iter().filter(|&layer| layer == 2 || high(pixel)).fold(3, |nearest, layer| nearest.min(layer))
}

/// What a pixel shows of the same, of 0, 1 and 1/2, if the layers are blended as they come with the stipple's opacity.
fn blended(order: [u32; 3]) -> f64 {
    order.into_iter().fold(0.0, |seen, layer| match layer {
        2 => 0.5,
        layer => 0.75 * f64::from(layer) + 0.25 * seen,
    })
}

fn order() -> Measured {
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let differ = share(pixels().map(|p| orders.iter().any(|&order| drawn(order, p) != drawn(orders[0], p))));
    let right = blended([2, 1, 0]);
    let wrong = orders.iter().filter(|&&order| (blended(order) - right).abs() > 1e-9).count();
    let seen = format!(
        "{} of the pixels depend on the order of drawing; blended, {wrong} of 6 orders show another colour",
        percent(differ)
    );
    judge(6 * SIDE * SIDE, differ == 0.0 && wrong > 0, differ == 0.0, seen)
}

fn one_layer() -> Measured {
    let second = share(pixels().map(|p| drawn([0, 1, 2], p) == 1));
    let wall = share(pixels().map(|p| drawn([0, 1, 2], p) == 2));
    let seen = format!(
        "of two layers before a wall the second shows in {}, the wall in {} (product law: 18.8 %, 6.2 %)",
        percent(second),
        percent(wall)
    );
    judge(SIDE * SIDE, second == 0.0, second < 0.05, seen)
}

fn distance() -> Measured {
    let deviation = |side: u32| {
        rms((0..4000).map(|i| {
            let corner = [0, 1].map(|axis| (value([i, axis, 60, 0]) * 64.0) as u32);
            let inside = (0..side * side).map(|i| [corner[0] + i % side, corner[1] + i / side]);
            share(inside.map(high)) - 0.75
        }))
    };
    let found = [1, 3, 5, 9, 17].map(deviation);
    let seen = format!(
        "objects of 1, 3, 5, 9, 17 pixels: error of their opacity {} rms, by their place on the screen",
        list(found)
    );
    judge(4000_u64, found.windows(2).all(|pair| pair[0] > pair[1]) && found[0] > 0.3, false, seen)
}

/// The depth of a stippled surface at 1 before a wall at 9.
fn depth_of(density: Density, pixel: [u32; 2]) -> f64 {
    if keeps(density, pixel) { 1.0 } else { 9.0 }
}

fn depth(pixel: [u32; 2]) -> f64 {
    depth_of(Density::High, pixel)
}

fn occlusion() -> Measured {
    let of = |depth: fn([u32; 2]) -> f64| {
        let inner = pixels().filter(|p| p.iter().all(|&c| c > 0));
        let occluded = |[x, y]: [u32; 2]| {
            let around = (0..9).filter(|&i| i != 4).map(move |i| [x + i % 3 - 1, y + i / 3 - 1]);
            share(around.map(|p| depth(p) < depth([x, y]) - 0.1))
        };
        let all: Vec<f64> = inner.map(occluded).collect();
        let average = mean(all.iter().copied());
        (average, rms(all.into_iter().map(|o| o - average)))
    };
    let (plain, stippled) = (of(|_| 1.0), of(depth));
    let seen = format!(
        "a flat surface before a wall, occlusion from the depths around a pixel: {:.2} +- {:.2} solid, {:.2} +- {:.2} stippled",
        plain.0, plain.1, stippled.0, stippled.1
    );
    judge(SIDE * SIDE, stippled.1 > 0.3 && plain.1 == 0.0, false, seen)
}

fn smaller_buffers() -> Measured {
    // The least and the greatest depth of a buffer of so many times fewer pixels along each side.
    let averaged = |density, ratio: u32| {
        let block = |i: u32| {
            mean(
                (0..ratio * ratio)
                    .map(|k| depth_of(density, [ratio * (i % 30) + k % ratio, ratio * (i / 30) + k / ratio])),
            )
        };
        let all = || (0..900).map(block);
        [all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max)]
    };
    let high = [2, 3, 4].map(|ratio| averaged(Density::High, ratio));
    let low = [2, 3, 4].map(|ratio| averaged(Density::Low, ratio));
    let text =
        |found: [[f64; 2]; 3]| found.map(|[least, most]| format!("{least:.2} to {most:.2}")).join(", ");
    let seen = format!(
        "depth 1 before 9, averaged at a half, a third, a quarter of the size: high density {}, low {}: depths at which there is \
         nothing, nearer to the surface (opaque) or to the wall (gone) by the density, and a grid where the size is no whole number \
         of patterns",
        text(high),
        text(low)
    );
    // What a pass that compares with the middle takes a depth for.
    let (is_opaque, is_gone) = (|[_, most]: [f64; 2]| most < 5.0, |[least, _]: [f64; 2]| least > 5.0);
    let is_grid = |[least, most]: [f64; 2]| most - least > 0.5;
    let any = |is: &dyn Fn([f64; 2]) -> bool, of: &[[f64; 2]; 3]| of.iter().any(|&found| is(found));
    let by_size = [high, low].iter().any(|of| any(&is_opaque, of) && any(&is_gone, of) && any(&is_grid, of));
    let by_both = any(&is_opaque, &high) && any(&is_gone, &low) && any(&is_grid, &high);
    judge(6 * 900, by_size, by_both, seen)
}

/// The kept share of a stippled surface that is scaled up, each pixel showing the nearest of the smaller image, and the
/// widths of holes and of the gaps between them.
fn scaled_up(ratio: f64) -> (f64, Vec<u32>, Vec<u32>) {
    let small = |c: u32| ((f64::from(c) + 0.5) / ratio) as u32;
    let shown = |[x, y]: [u32; 2]| high([small(x), small(y)]);
    // A row with holes, from the first to the last of them.
    let y = (0..SIDE).find(|&y| small(y) % 2 == 1).unwrap_or(0);
    let row: Vec<bool> = (0..SIDE).map(|x| shown([x, y])).collect();
    let widths = |kept: bool| {
        let runs = row.chunk_by(|a, b| a == b).filter(|run| run[0] == kept).map(|run| run.len() as u32);
        let mut runs: Vec<u32> = runs.collect();
        runs.truncate(runs.len().saturating_sub(1));
        runs.drain(..1.min(runs.len()));
        runs.sort_unstable();
        runs.dedup();
        runs
    };
    (share(pixels().map(shown)), widths(false), widths(true))
}

fn upscaled() -> Measured {
    let [plain, quarter, half] = [1.0, 1.25, 1.5].map(scaled_up);
    let text =
        |(kept, holes, gaps): &(f64, Vec<u32>, Vec<u32>)| format!("{}, {holes:?}, {gaps:?}", percent(*kept));
    let seen = format!(
        "kept, widths of holes and of what is between them: as it is {}; scaled up by 5/4 {}, by 3/2 {}",
        text(&plain),
        text(&quarter),
        text(&half)
    );
    let is_off = |(kept, _, gaps): &(f64, Vec<u32>, Vec<u32>)| (kept - 0.75).abs() > 0.05 || gaps.len() > 1;
    judge(3 * SIDE * SIDE, !is_off(&plain) && is_off(&quarter) && is_off(&half), is_off(&half), seen)
}
