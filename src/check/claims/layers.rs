//! Transparent layers one behind the other: each lets its own share through, whatever the others do.

use crate::check::input::{UsedCells, general_scenes, placed, placement, sighting};
use crate::check::tolerance::{DRAWS_A_SAMPLE, PAIR_BINS, PLACEMENT};
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::scene::{Fragment, Rectangle, Scene};
use crate::stats::chi_square::{self, ChiSquare};
use crate::stats::correlation;
use crate::stats::seed::uniform01;
use rand::rngs::Xoshiro256PlusPlus;

/// Pairs of layers: the bias of the `f32` sine hash differs from one to the next.
const LAYER_PAIRS: usize = 8;

/// Samples of each pair of layers: 128 expected in every square.
const LAYER_SAMPLES: usize = 1 << 15;

/// Two layers are at least this far apart along z, in object units: many cells.
const LEAST_LAYER_DISTANCE: f64 = 1.0;

/// Pairs of thresholds at the same x and y on two planes of constant z.
pub const PARALLEL: Claim = Claim {
    id: "layers.parallel",
    anchor: "§5.3 (including z in the hash removes correlations)",
    statement: "thresholds at the same x and y on two planes of constant z are uniform and independent, so that two \
                half-transparent layers are both kept at a quarter of the pixels",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.015)),
    run: parallel,
};

/// Pairs of thresholds at one pixel on two surfaces that cross the line of sight at different angles.
pub const QUARTER: Claim = Claim {
    id: "layers.quarter",
    anchor: "§5.3 (layers at one pixel), §4 (expected visibility is alpha)",
    statement: "thresholds at one pixel on two surfaces in general position are uniform and independent, so that two \
                half-transparent layers are both kept at a quarter of the pixels",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.015)),
    run: quarter,
};

fn parallel(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(PARALLEL.id);
    let wall = Scene::wall();
    let (pairs, n) = sizes(draw);
    let mut used = UsedCells::of(draw, 4 * n * pairs);
    both_kept(subject, (0..pairs).map(|_| samples(subject, &wall, n, &mut used, &mut rng)))
}

fn quarter(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(QUARTER.id);
    let scenes = general_scenes();
    let (pairs, n) = sizes(draw);
    let mut used = UsedCells::of(draw, 4 * n * pairs);
    let pairs = (0..pairs)
        .map(|pair| behind(subject, &scenes[pair % scenes.len()], pair as u32 + 1, n, &mut used, &mut rng));
    both_kept(subject, pairs)
}

/// How many pairs of layers there are, and samples of each: two layers have only so many cells, so that the pairs grow in
/// number.
fn sizes(draw: &Draw) -> (usize, usize) {
    (draw.groups(LAYER_PAIRS), draw.of_a_group().samples(LAYER_SAMPLES))
}

/// Tests thresholds in twos, group by group, for a law of pairs that is uniform over the square.
fn both_kept(subject: &Subject<'_>, groups: impl Iterator<Item = Vec<Fragment>>) -> Attempt<Trial> {
    let mut pooled = vec![0; PAIR_BINS * PAIR_BINS];
    let (mut squares, mut visible): (Vec<ChiSquare>, Vec<ChiSquare>) = (Vec::new(), Vec::new());
    let mut worst = 0.0_f64;
    for samples in groups {
        let values = subject.thresholds(&samples);
        reject_outsiders(subject, &samples, &values)?;
        let pairs = || values.chunks_exact(2).map(|pair| (pair[0], pair[1]));
        let table = correlation::pair_table(pairs(), PAIR_BINS);
        pooled.iter_mut().zip(&table).for_each(|(sum, count)| *sum += count);
        squares.extend(chi_square::uniform(&table));
        let n = pairs().count() as u64;
        // A fragment is kept where its alpha is not below the threshold.
        let both = pairs().filter(|&(near, far)| near <= 0.5 && far <= 0.5).count() as u64;
        visible.extend(chi_square::against(&[both, n - both], &[0.25, 0.75]));
        let error = both as f64 / n as f64 - 0.25;
        if error.abs() > worst.abs() {
            worst = error;
        }
    }
    // Summed over the pairs of layers: what is wrong with one adds up with what is wrong with the next.
    let sum =
        |a: ChiSquare, b: ChiSquare| ChiSquare::new(a.statistic + b.statistic, a.dof + b.dof, a.n + b.n);
    let tests: Vec<ChiSquare> =
        [squares, visible].into_iter().filter_map(|of| of.into_iter().reduce(sum)).collect();
    let per_dof: Vec<String> =
        tests.iter().map(|test| format!("{:.2}", test.statistic / test.dof as f64)).collect();
    let seen = format!(
        "the share of pixels that keep both of two half-transparent layers is off from a quarter by up to {:+.2} %; \
         chi-square per dof of the pairs, and of that share: {}",
        100.0 * worst,
        per_dof.join(", ")
    );
    Ok(Trial::worst_of(
        &tests,
        pooled.iter().sum(),
        seen,
        Evidence::Pairs { side: PAIR_BINS, counts: pooled },
    ))
}

/// Fragments in twos, at the same place on two planes of constant z; no two pairs touch the same cell.
fn samples(
    subject: &Subject<'_>,
    wall: &Scene,
    n: usize,
    used: &mut UsedCells,
    rng: &mut Xoshiro256PlusPlus,
) -> Vec<Fragment> {
    let place = placement(rng);
    let mut height = || (2.0 * uniform01(rng) - 1.0) * PLACEMENT;
    let near = height();
    let far = loop {
        let far = height();
        if (far - near).abs() >= LEAST_LAYER_DISTANCE {
            break far;
        }
    };
    used.next_group();
    let mut samples = Vec::with_capacity(2 * n);
    for _ in 0..n * DRAWS_A_SAMPLE {
        if samples.len() == 2 * n {
            break;
        }
        let found = sighting(wall, rng);
        // The camera looks along -z, from far enough away that both are seen at the same pixel.
        let pair = [(near, far), (far, near)].map(|(z, other)| {
            let mut fragment = found.placed(place.with_z(z), subject.precision).fragment;
            fragment.world.z += z;
            fragment.eye.z -= z;
            fragment.layer = u32::from(other > z);
            fragment
        });
        if used.claim(subject, &pair) {
            samples.extend(pair);
        }
    }
    samples
}

/// Fragments in twos, at the same pixel on the surface of a scene and on another far behind it, with that one's index of
/// the layer; no two pairs touch the same cell.
fn behind(
    subject: &Subject<'_>,
    scene: &Scene,
    layer: u32,
    n: usize,
    used: &mut UsedCells,
    rng: &mut Xoshiro256PlusPlus,
) -> Vec<Fragment> {
    let (camera, place) = (&scene.camera, placement(rng));
    // Up to 60 degrees away from facing the camera.
    let mut between = |low: f64, high: f64| low + (high - low) * uniform01(rng);
    let tilt = camera.direction_dx.normalize() * between(-1.2, 1.2)
        + camera.direction_dy.normalize() * between(-1.2, 1.2);
    let side = (tilt - camera.forward).any_orthonormal_vector() * PLACEMENT * 4.0;
    let further = between(2.0, 4.0) * LEAST_LAYER_DISTANCE;
    let other = Rectangle {
        centre: scene.surfaces[0].centre + camera.forward * further,
        half_u: side,
        half_v: (tilt - camera.forward).normalize().cross(side),
    };
    used.next_group();
    let mut samples = Vec::with_capacity(2 * n);
    for _ in 0..n * DRAWS_A_SAMPLE {
        if samples.len() == 2 * n {
            break;
        }
        let near = sighting(scene, rng).fragment;
        let far = other.fragment(camera, near.pixel).map(|far| Fragment { layer, ..far });
        let Some(far) = far.filter(|far| far.eye.z >= near.eye.z + LEAST_LAYER_DISTANCE) else { continue };
        let pair = [near, far].map(|fragment| placed(&fragment, place, subject.precision));
        if used.claim(subject, &pair) {
            samples.extend(pair);
        }
    }
    samples
}
