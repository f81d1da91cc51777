//! Other samples, stochastic transparency and the results: §9 to §12.

use crate::maps::{Map, fence, leaves, noise, strands};
use crate::mask;
use crate::measure::{CHIS, Plane, list, listing, mean, n, percent, rms, share, value, visible};
use crate::row::{Measured, Row, judge};
use glam::{DVec3, vec3};
use hashed_alpha::stats::chi_square;
use hashed_alpha::stats::correlation::{pair_table, pearson};
use hashed_alpha::stats::seed::uniform01;
use hashed_alpha::technique::foveated::Gaze;
use hashed_alpha::technique::history::steady_state;
use hashed_alpha::technique::occlusion::{chi_by_two_hashes, generator, open};
use hashed_alpha::technique::prior_work::Level;
use hashed_alpha::technique::prior_work::scaled_alpha::{alpha_scale, scaled};
use hashed_alpha::technique::prior_work::test_then_blend::{Layer, sorted};
use hashed_alpha::threshold::hash::offset::Offset;
use hashed_alpha::threshold::hash::sine::Sine;
use hashed_alpha::threshold::hash::sine_chi_2::SineChi2;
use hashed_alpha::threshold::hash::{Cell, Hash};
use hashed_alpha::threshold::real::Real;
use hashed_alpha::threshold::stage::order::Order;
use hashed_alpha::threshold::two_scale::Variant::{self, Anisotropic, Isotropic};
use std::sync::OnceLock;

pub const ROWS: &[Row] = &[
    Row {
        id: "occlusion.screen_seeds",
        place: "§9",
        sentence: "Seeds fixed to pixels show as a screen door when geometry moves; hashed ones move with it.",
        measure: screen_seeds,
    },
    Row {
        id: "occlusion.stable",
        place: "§9, Fig. 8",
        sentence: "With one hashed ray a pixel the noise of ambient occlusion stays largely stable under motion.",
        measure: rays_under_motion,
    },
    Row {
        id: "occlusion.two_hashes",
        place: "§9",
        sentence: "The two orders of nesting give two samples chi_1, chi_2 that can be used together.",
        measure: two_hashes,
    },
    Row {
        id: "occlusion.two_offsets",
        place: "§9",
        sentence: "Two offsets of one hash give independent samples, too.",
        measure: two_offsets,
    },
    Row {
        id: "occlusion.cosine",
        place: "§9",
        sentence: "The direction made of chi_1, chi_2 is distributed as the cosine.",
        measure: cosine,
    },
    Row {
        id: "occlusion.generator",
        place: "§9",
        sentence: "A hash that returns an integer can seed an ordinary generator.",
        measure: seeded_generator,
    },
    Row {
        id: "transparency.converges",
        place: "§10",
        sentence: "With more tests a pixel layers converge to sorted blending, as stochastic transparency does.",
        measure: transparency,
    },
    Row {
        id: "transparency.strata",
        place: "§10",
        sentence: "Eq. 7 is stochastic transparency with regular samples, Eq. 8 with stratified ones.",
        measure: strata,
    },
    Row {
        id: "results.added_time",
        place: "§11, Table 1",
        sentence: "At one test a fragment hashing adds 0.1 to 0.3 ms in scenes with typical numbers of fragments.",
        measure: added_time,
    },
    Row {
        id: "results.hashed_ratio",
        place: "§11, Table 1",
        sentence: "A frame with hashed alpha testing takes 1.02 to 1.36 times that with the traditional test.",
        measure: hashed_ratio,
    },
    Row {
        id: "results.dilation",
        place: "§11, Fig. 10",
        sentence: "Castano's scaled alpha dilates distant geometry, which then looks too dense.",
        measure: dilation,
    },
    Row {
        id: "results.stability",
        place: "§11, Fig. 13",
        sentence: "Under sub-pixel motion hashed alpha testing is about as stable as the traditional test.",
        measure: stability,
    },
    Row {
        id: "results.unstable",
        place: "§11, Fig. 13",
        sentence: "Stochastic thresholds are significantly less stable.",
        measure: instability,
    },
    Row {
        id: "results.checkerboard",
        place: "§11, Fig. 14",
        sentence: "A checkerboard does not vanish under the traditional test but aliases; hashing makes noise of that.",
        measure: checkerboard,
    },
    Row {
        id: "results.checkerboard_samples",
        place: "§11, Fig. 14",
        sentence: "With hashed alpha-to-coverage of eight samples it converges to a uniform grey in the distance.",
        measure: checkerboard_samples,
    },
    Row {
        id: "results.temporal",
        place: "§11, Fig. 11",
        sentence: "Hashed alpha with temporal antialiasing looks much like hashed alpha-to-coverage (8 samples).",
        measure: temporal_against_spatial,
    },
    Row {
        id: "results.temporal_coverage",
        place: "§11, Fig. 11",
        sentence: "Temporally antialiased alpha-to-coverage is nearly the ground truth.",
        measure: temporal_coverage,
    },
    Row {
        id: "results.foveated",
        place: "§11, Fig. 15",
        sentence: "In the periphery of a foveated image the traditional test loses foliage, the hashed one keeps it.",
        measure: foveated,
    },
];

fn chi(variant: Variant, plane: &Plane, x: f64, y: f64) -> [f32; 2] {
    chi_by_two_hashes(variant, &plane.at(x, y).cast::<f32>())
}

/// The share of points of a surface that keep their ray while it moves by so many pixels.
fn kept_rays(variant: Variant, pixels: f64) -> f64 {
    let plane = Plane::tilted(60.0, 0.0117, 0.3);
    let moved = Plane { origin: plane.origin + pixels * plane.dx, ..plane };
    share((0..1 << 14).map(|i| {
        let (x, y) = (f64::from(i % 128), f64::from(i / 128));
        chi(variant, &plane, x, y) == chi(variant, &moved, x, y)
    }))
}

fn screen_seeds() -> Measured {
    let plane = Plane::tilted(60.0, 0.0117, 0.3);
    let moved = Plane { origin: plane.origin + 3.0 * plane.dx, ..plane };
    let count = 1 << 14;
    let places = || (0..count).map(|i| (f64::from(i % 128), f64::from(i / 128)));
    let hashed =
        share(places().map(|(x, y)| chi(Isotropic, &plane, x + 3.0, y) == chi(Isotropic, &moved, x, y)));
    let screen = share(
        places().map(|(x, y)| value([x as u32 + 3, y as u32, 30, 0]) == value([x as u32, y as u32, 30, 0])),
    );
    let seen = format!(
        "after three pixels {} of the points keep a hashed ray, {} one of their pixel",
        percent(hashed),
        percent(screen)
    );
    judge(count, hashed > 0.98 && screen < 0.01, hashed > screen, seen)
}

fn rays_under_motion() -> Measured {
    let shifts = [0.05, 0.125, 0.25];
    let (one, two) = (shifts.map(|s| kept_rays(Isotropic, s)), shifts.map(|s| kept_rays(Anisotropic, s)));
    let seen = format!(
        "rays kept for a shift of 0.05, 0.125, 0.25 pixels at 60 degrees: isotropic {}, anisotropic {}",
        list(one),
        list(two)
    );
    judge(6 * (1 << 14), one[0] > 0.9 && two[0] > 0.9 && one[2] > 0.5, one[0] > 0.8 && two[0] > 0.8, seen)
}

/// The probability that pairs of two hashes on two walls are independent and uniform, over 16 x 16 squares.
fn joint<R: Real>(first: impl Fn(&Cell<R>) -> R, second: impl Fn(&Cell<R>) -> R) -> [f64; 2] {
    let walls: [fn(f64, f64) -> [f64; 3]; 2] = [|u, v| [u, v, 3.0], |u, v| [3.0, u, v]];
    walls.map(|wall| {
        let pairs = (0..1 << 18).map(|i| {
            let index = wall(f64::from(i % 512) + 1.0, f64::from(i / 512) + 1.0).map(R::from_f64).into();
            let cell = Cell { index, octave: 0 };
            (first(&cell).to_f64(), second(&cell).to_f64())
        });
        chi_square::uniform(&pair_table(pairs, 16)).expect("a full table").p
    })
}

fn judged_pairs(single: [f64; 2], double: [f64; 2]) -> Measured {
    let text = |p: [f64; 2]| p.map(|p| format!("{p:.1e}")).join(", ");
    let seen =
        format!("joint law on walls of constant z, x: p = {} in f32, {} in f64", text(single), text(double));
    let sound = |p: [f64; 2]| p.iter().all(|p| *p > 1e-4);
    judge(4 << 18, sound(single) && sound(double), sound(double), seen)
}

fn two_hashes() -> Measured {
    judged_pairs(
        joint::<f32>(|c| Sine.hash(c), |c| SineChi2.hash(c)),
        joint::<f64>(|c| Sine.hash(c), |c| SineChi2.hash(c)),
    )
}

const OFFSETS: [[f64; 3]; 2] = [[1013.0, -377.0, 2311.0], [-1999.0, 743.0, 89.0]];

fn two_offsets() -> Measured {
    fn of<R: Real>(which: usize) -> impl Fn(&Cell<R>) -> R {
        let offset = OFFSETS[which].map(R::from_f64).into();
        move |cell| Offset { hash: Sine, offset }.hash(cell)
    }
    judged_pairs(joint::<f32>(of(0), of(1)), joint::<f64>(of(0), of(1)))
}

fn cosine() -> Measured {
    let plane = Plane::tilted(30.0, 0.0117, 0.3);
    let count = 1 << 14;
    // Five pixels apart, so that rays are independent.
    let rays: Vec<[f64; 2]> = (0..count)
        .map(|i| chi(Isotropic, &plane, 5.0 * f64::from(i % 128), 5.0 * f64::from(i / 128)).map(f64::from))
        .collect();
    let angles = [30.0, 45.0, 60.0_f64];
    let found = angles.map(|angle| {
        let limit = libm::cos(angle.to_radians());
        1.0 - share(rays.iter().map(|&chi| open(DVec3::Z, chi, |direction| direction.z > limit)))
    });
    let truth = angles.map(|angle| libm::sin(angle.to_radians()) * libm::sin(angle.to_radians()));
    let near = found.iter().zip(truth).all(|(found, truth)| (found - truth).abs() < 0.02);
    let seen = format!(
        "rays within 30, 45, 60 degrees of the normal: {} (cosine law: {})",
        list(found),
        list(truth)
    );
    judge(count, near, false, seen)
}

fn seeded_generator() -> Measured {
    let draws = |x: i32| {
        let mut rng =
            generator(&Cell::<f32> { index: vec3((x % 128) as f32, (x / 128) as f32, 3.0), octave: 0 });
        [uniform01(&mut rng), uniform01(&mut rng)]
    };
    let count = 1 << 14;
    let all: Vec<[f64; 2]> = (0..count).map(draws).collect();
    let column = |which: usize| all.iter().map(|draws| draws[which]).collect::<Vec<_>>();
    let (first, second) = (column(0), column(1));
    let within = pearson(&first, &second).expect("not constant").r;
    let beside = pearson(&first[1..], &first[..first.len() - 1]).expect("not constant").r;
    let stays = all == (0..count).map(draws).collect::<Vec<_>>();
    let seen = format!(
        "correlation of two draws of a cell {within:.3}, of neighbours {beside:.3}; the same again: {stays}"
    );
    judge(count as u64, stays && within.abs() < 0.04 && beside.abs() < 0.04, false, seen)
}

fn transparency() -> Measured {
    let pixels = 1000;
    let error = |tests: u32| {
        rms((0..pixels).map(|p| {
            let layers: Vec<Layer> = (0..4)
                .map(|l| Layer {
                    depth: f64::from(l),
                    alpha: value([p, l, 31, 0]),
                    value: value([p, l, 32, 0]),
                })
                .collect();
            let seen = |test: u32| {
                let nearest =
                    layers.iter().zip(0_u32..).find(|(layer, l)| layer.alpha >= value([p, *l, test, 33]));
                nearest.map_or(0.0, |(layer, _)| layer.value)
            };
            mean((0..tests).map(seen)) - sorted(&layers, 0.0)
        }))
    };
    let errors = [1, 4, 16, 64, 256].map(error);
    let halved = errors.windows(2).all(|pair| (pair[0] / pair[1] - 2.0).abs() < 0.25);
    judge(
        pixels,
        halved,
        errors[4] < 0.5 * errors[0],
        format!("four layers, 1 to 256 tests: error {} rms", list(errors)),
    )
}

fn strata() -> Measured {
    let deviation = |mask: &dyn Fn(u32) -> u32| rms((0..8192).map(|p| mask::coverage(mask(p), n(8)) - 0.3));
    let regular = {
        let coverage: Vec<f64> =
            (0..100).map(|i| mask::coverage(mask::fixed_dither(f64::from(i) / 100.0, n(8)), n(8))).collect();
        rms(coverage.iter().zip(0..).map(|(c, i)| c - f64::from(i) / 100.0))
    };
    let stratified = deviation(&|p| mask::stratified(0.3, n(8), |i| value([p, i, 34, 0])));
    let random =
        deviation(&|p| (0..8).filter(|&i| 0.3 >= value([p, i, 35, 0])).fold(0, |mask, i| mask | 1 << i));
    let seen = format!(
        "n = 8: error {regular:.3} rms over alphas, fixed for each; deviation {stratified:.3} stratified, {random:.3} random"
    );
    judge(8192_u64, regular < stratified && stratified < random, stratified < random, seen)
}

/// Table 1: milliseconds of the traditional and of the hashed test.
const TABLE_1: [(f64, f64); 10] = [
    (0.06, 0.08),
    (0.14, 0.16),
    (0.10, 0.12),
    (0.22, 0.30),
    (0.28, 0.36),
    (0.39, 0.50),
    (1.05, 1.15),
    (1.08, 1.22),
    (2.52, 2.86),
    (5.19, 5.28),
];

fn added_time() -> Measured {
    let added = TABLE_1.map(|(traditional, hashed)| hashed - traditional);
    let within = added.iter().filter(|t| (0.095..0.305).contains(*t)).count();
    let (least, most) = added.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), &t| (a.min(t), b.max(t)));
    let seen =
        format!("by Table 1 itself: {least:.2} to {most:.2} ms, within 0.1 to 0.3 in {within} of 10 scenes");
    judge(10_u64, within == 10, within > 0, seen)
}

/// The ratios of hashed to traditional that docs/cost.md records of frames, in ascending order. Times cannot be measured again
/// by a test; what is on record can.
fn recorded() -> Vec<f64> {
    let page = include_str!("../../docs/cost.md");
    let table = page.split("| hashed over traditional |").nth(1).unwrap_or_default();
    let ratio = |line: &str| line.split('|').nth(3)?.trim().parse::<f64>().ok();
    let rows = table.lines().skip(2).take_while(|line| line.starts_with('|'));
    let mut ratios: Vec<f64> = rows.filter_map(ratio).collect();
    ratios.sort_by(f64::total_cmp);
    ratios
}

fn hashed_ratio() -> Measured {
    let ratios = recorded();
    let within = ratios.iter().filter(|ratio| (1.0..1.405).contains(*ratio)).count();
    let [first, middle, last] = [0, ratios.len() / 2, ratios.len().saturating_sub(1)].map(|at| ratios[at]);
    let seen = format!(
        "no time is measured here; on record in docs/cost.md (`hashed-alpha cost --effects`, frames of the gallery in \
         software): {first} to {last}, half of them above {middle}, {within} of {} within 1.0 to 1.4; it adds arithmetic and no \
         texel, so the ratio falls with what else a frame costs",
        ratios.len()
    );
    judge(ratios.len() as u64, within == ratios.len(), 2 * within >= ratios.len(), seen)
}

fn dilation() -> Measured {
    let maps = [leaves(256), strands(256), fence(256)].map(Map::chain);
    // The share that passes the plain test, over that of the finest level.
    let density = |chain: &[Map], i: usize| {
        let wanted = chain[0].level().passing_share(0.5);
        let texels = scaled(chain[i].level(), alpha_scale(chain[i].level(), wanted, 0.5));
        Level { texels: &texels, ..chain[i].level() }.passing_share(0.5) / wanted
    };
    // Of the texels that pass, those that are less than half covered: what makes thin things thick.
    let thickened = |chain: &[Map], i: usize| {
        let level = chain[i].level();
        let scale = alpha_scale(level, chain[0].level().passing_share(0.5), 0.5);
        share(level.texels.iter().zip(scaled(level, scale)).filter(|(_, s)| *s >= 0.5).map(|(a, _)| *a < 0.5))
    };
    let densities = maps.each_ref().map(|chain| [2, 3, 4, 5].map(|i| density(chain, i)));
    let thick = maps.each_ref().map(|chain| thickened(chain, 3));
    let seen = format!(
        "plain test, share that passes over that of the finest level at levels 2, 3, 4, 5: leaves {}, strands of hair {}, a fence {}; \
         of what passes at level 3 less than half covered: leaves {}, strands {}; pieces grow and others go, so the share is kept \
         where a level has many different alphas and is all or nothing where it has few",
        list(densities[0]),
        list(densities[1]),
        list(densities[2]),
        percent(thick[0]),
        percent(thick[1])
    );
    let is_dense = |d: &f64| *d > 1.05;
    let grows = thick[0] > 0.02 && thick[1] > 0.02;
    judge(
        3 * 256 * 256,
        grows && densities[..2].iter().all(|map| map.iter().all(is_dense)),
        grows && densities.iter().flatten().any(is_dense),
        seen,
    )
}

/// The share of points that flip under a shift of 1/8 pixel, with one texel a pixel: traditional, hashed, stochastic.
///
/// The hashed planes are in general position, or follow the axes, where cells change less often.
fn flips(follows_the_axes: bool, alpha: impl Fn(f64, f64) -> f64) -> [f64; 3] {
    let of = listing(Isotropic, 1.0);
    let plane = |i: u32| {
        let size = 0.01 * libm::exp2(f64::from(i) / 16.0);
        let general = Plane::tilted(0.0, size, 0.43 * f64::from(i));
        let aligned = Plane { dx: DVec3::X * size, dy: DVec3::Y * size, ..general };
        if follows_the_axes { aligned } else { general }
    };
    let planes: Vec<Plane> = (0..16).map(plane).collect();
    let all: Vec<[bool; 3]> = (0..POINTS)
        .map(|i| {
            let plane = &planes[(i % 16) as usize];
            let [x, y] = [0, 1].map(|axis| 512.0 * value([i, axis, 36, 0]));
            let alphas = [alpha(x, y), alpha(x + 0.125, y)];
            let hashed = [of(&plane.at(x, y)), of(&plane.at(x + 0.125, y))];
            let random = [value([i, 2, 36, 0]), value([i, 3, 36, 0])];
            [[0.5; 2], hashed, random].map(|t| (alphas[0] >= t[0]) != (alphas[1] >= t[1]))
        })
        .collect();
    [0, 1, 2].map(|kind| share(all.iter().map(|flips| flips[kind])))
}

const POINTS: u32 = 1 << 17;

/// Leaves at levels 2, 3, 4, and a map of random texels, opaque or clear, at levels 0, 1, 2; on planes in general
/// position and on planes that follow the axes.
fn on_maps() -> &'static [[[f64; 3]; 6]; 2] {
    static FLIPS: OnceLock<[[[f64; 3]; 6]; 2]> = OnceLock::new();
    FLIPS.get_or_init(|| {
        let (tree, noise) = (leaves(512).chain(), noise(512).chain());
        let maps: [&Map; 6] = [&tree[2], &tree[3], &tree[4], &noise[0], &noise[1], &noise[2]];
        [false, true].map(|aligned| maps.map(|map| flips(aligned, |x, y| map.at(x, y))))
    })
}

fn stability() -> Measured {
    let [general, aligned] = on_maps();
    let ratios = |found: &[[f64; 3]; 6]| found.map(|f| f[1] / f[0]);
    let veil = flips(false, |_, _| 0.5001);
    let seen = format!(
        "1/8 pixel, leaves at levels 2, 3, 4 and random texels at levels 0, 1, 2: traditional {}, hashed {}: {} times as many \
         flips, on planes that follow the axes {} times; on a veil of alpha 1/2, of which the source does not speak, {} and {}",
        list(general.map(|f| f[0])),
        list(general.map(|f| f[1])),
        list(ratios(general)),
        list(ratios(aligned)),
        percent(veil[0]),
        percent(veil[1])
    );
    // On the way from traditional to stochastic, nearer to the former.
    let nearer = general.iter().chain(aligned).all(|f| f[1] / f[0] < f[2] / f[1]);
    judge(13 * POINTS, ratios(general).iter().all(|r| *r < 1.25), nearer, seen)
}

fn instability() -> Measured {
    let [found, _] = on_maps();
    let ratios = found.map(|f| f[2] / f[1]);
    let seen = format!(
        "the same maps: stochastic {}: {} times the flips of hashed",
        list(found.map(|f| f[2])),
        list(ratios)
    );
    judge(6 * POINTS, ratios.iter().all(|r| *r > 1.5), ratios.iter().any(|r| *r > 1.5), seen)
}

/// A checkerboard of so many texels a pixel, read as a mip level reads it: the mean of a box of one pixel.
fn checkered_alpha(texels: f64) -> Vec<f64> {
    // The sum of +1, -1, ... up to x.
    let cumulated = |x: f64| {
        let whole = x.floor();
        let odd = whole - 2.0 * (whole / 2.0).floor();
        odd + (x - whole) * (1.0 - 2.0 * odd)
    };
    let wave = |c: u32| {
        let from = f64::from(c) * texels + 0.3;
        (cumulated(from + texels) - cumulated(from)) / texels
    };
    (0..BOARD * BOARD).map(|i| 0.5 + 0.5 * wave(i % BOARD) * wave(i / BOARD)).collect()
}

/// Pixels along each side of a picture of a checkerboard.
const BOARD: u32 = 128;

/// A checkerboard under the traditional and the hashed test: the share that passes the former, and by how much blocks of
/// 16 x 16 pixels miss their mean alpha under each.
fn checkered(texels: f64) -> [f64; 3] {
    let image = checkered_alpha(texels);
    let hashed = Plane::tilted(0.0, 0.012, 0.0).image(BOARD, listing(Isotropic, 1.0));
    let missed = |threshold: &dyn Fn(usize) -> f64| {
        rms((0..64).map(|block| {
            let corner = (block % 8 * 16, block / 8 * 16);
            mean((0..256).map(|i| {
                let at = ((corner.1 + i / 16) * BOARD + corner.0 + i % 16) as usize;
                visible(image[at], threshold(at)) - image[at]
            }))
        }))
    };
    let passing = share(image.iter().map(|&alpha| alpha >= 0.5));
    [passing, missed(&|_| 0.5), missed(&|at| hashed[at])]
}

fn checkerboard() -> Measured {
    let rates = [1.3, 1.97, 2.05, 4.1];
    let found = rates.map(checkered);
    let seen = format!(
        "{} texels a pixel: the traditional test passes {}; error of blocks of 16 x 16 pixels: traditional {}, hashed {} \
         (independent thresholds: 0.031)",
        list(rates),
        list(found.map(|f| f[0])),
        list(found.map(|f| f[1])),
        list(found.map(|f| f[2]))
    );
    let stays = found.iter().all(|f| (0.3..0.7).contains(&f[0]));
    let noise = found.iter().all(|f| f[2] < 0.06);
    judge(4 * 16_384, stays && noise && found[1][1] > 0.1 && found[2][1] > 0.1, stays && noise, seen)
}

fn checkerboard_samples() -> Measured {
    // How far pixels are from grey with so many samples, whose strata are jittered by the threshold of the surface.
    let from_grey = |variant: Variant, texels: f64, samples: u32| {
        let image = checkered_alpha(texels);
        let chi = Plane::tilted(60.0, 0.012, 0.0).image(BOARD, listing(variant, 1.0));
        rms(image.iter().zip(&chi).map(|(&alpha, &chi)| {
            mask::coverage(mask::stratified(alpha, n(samples), |_| chi), n(samples)) - 0.5
        }))
    };
    let rates = [1.3, 2.7, 5.3, 10.7];
    let own = rates.map(|rate| rms(checkered_alpha(rate).iter().map(|alpha| alpha - 0.5)));
    let [one, eight] = [1, 8].map(|samples| rates.map(|rate| from_grey(Isotropic, rate, samples)));
    let other = rates.map(|rate| from_grey(Anisotropic, rate, 8));
    let seen = format!(
        "{} texels a pixel, deviation of pixels from grey: one hashed sample {}, eight {}, eight anisotropic {}; of the filtered \
         alpha itself {}",
        list(rates),
        list(one),
        list(eight),
        list(other),
        list(own)
    );
    let falls = |found: &[f64; 4]| found.windows(2).all(|pair| pair[1] < pair[0]);
    // Half a stratum is 0.0625.
    let grey = |found: &[f64; 4]| found[3] < 0.0625;
    let as_said = [&eight, &other].iter().all(|found| falls(found) && grey(found)) && one[3] > 4.0 * eight[3];
    judge(12 * BOARD * BOARD, as_said, eight[3] < one[3] && grey(&eight), seen)
}

/// The error of a pixel of alpha 0.4 under the exponential average (weight 0.1) of eight frames of masks.
fn averaged(samples: u32) -> f64 {
    rms((0..CHIS).map(|p| {
        let chi = (f64::from(p) + 0.5) / f64::from(CHIS);
        let xi = [value([p, 0, 39, 0]), value([p, 1, 39, 0])];
        let frame = |i| {
            let chi = |sample| {
                let own = if samples == 1 { chi } else { value([p, sample, 40, 0]) };
                Order::Alternating.threshold(own, i, n(8))
            };
            mask::coverage(mask::permuted(0.4, n(samples), xi, chi), n(samples))
        };
        let frames: Vec<f64> = (0..8).map(frame).collect();
        steady_state(&frames, 0.1, 7) - 0.4
    }))
}

fn temporal_against_spatial() -> Measured {
    let temporal = averaged(1);
    let spatial =
        rms((0..CHIS)
            .map(|p| mask::coverage(mask::stratified(0.4, n(8), |i| value([p, i, 41, 0])), n(8)) - 0.4));
    let seen = format!(
        "alpha 0.4, error of a pixel: eight stratified frames averaged {temporal:.3}, eight samples {spatial:.3}"
    );
    let ratio = temporal / spatial;
    judge(2 * CHIS, (0.5..2.0).contains(&ratio), ratio < 4.0, seen)
}

fn temporal_coverage() -> Measured {
    let error = averaged(8);
    judge(
        CHIS,
        error < 0.02,
        error < 0.05,
        format!("alpha 0.4, eight samples and eight frames: error of a pixel {error:.4} rms"),
    )
}

fn foveated() -> Measured {
    let gaze = Gaze { centre: [960.0, 540.0], radius: 200.0, slope: 0.05 };
    let chain = leaves(256).chain();
    let base = chain[0].level();
    let at = |x: f64| chain[gaze.coarser_by([x, 540.0]).round() as usize].level();
    let places = [960.0, 1400.0, 1900.0];
    let fixed = places.map(|x| at(x).passing_share(0.5) / base.passing_share(0.5));
    let hashed = places.map(|x| at(x).mean() / base.mean());
    let seen = format!(
        "leaves 0, 440, 940 pixels from the gaze, over the finest level: traditional {}, hashed {}",
        list(fixed),
        list(hashed)
    );
    judge(
        256 * 256,
        fixed[2] < 0.9 && hashed.iter().all(|h| (h - 1.0).abs() < 1e-3),
        fixed[2] < fixed[0],
        seen,
    )
}
