//! Uniformity on one plane at a time: the biases of several planes add up here and do not cancel.

use crate::check::evidence::NamedHistogram;
use crate::check::input::{UsedCells, more_independent, rotation};
use crate::check::judge::{histogram, uniformity};
use crate::check::tolerance::BINS;
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::scene::{Camera, Rectangle, Scene};
use crate::stats::chi_square::ChiSquare;
use glam::{DMat3, DVec3};
use rand::rngs::Xoshiro256PlusPlus;

/// Planes of a claim about single planes.
const PLANES: usize = 8;

/// Samples on each plane: eight times what shows the bias of the `f32` sine hash.
const PLANE_SAMPLES: usize = 1 << 15;

/// Planes of constant z.
pub const CONSTANT_Z: Claim = Claim {
    id: "uniform.constant_z",
    anchor: "§5.1 (hash3D), not in the paper",
    statement: "thresholds on each single plane of constant z are uniform",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(7.0e-3)),
    run: |subject, draw| planes(&CONSTANT_Z, "z = ", |_| DMat3::IDENTITY, subject, draw),
};

/// Planes of constant x: the first coordinate that a hash reads.
pub const CONSTANT_X: Claim = Claim {
    id: "uniform.constant_x",
    anchor: "§5.1 (hash3D), not in the paper",
    statement: "thresholds on each single plane of constant x are uniform",
    run: |subject, draw| {
        planes(&CONSTANT_X, "x = ", |_| DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X), subject, draw)
    },
    ..CONSTANT_Z
};

/// Planes of constant y.
pub const CONSTANT_Y: Claim = Claim {
    id: "uniform.constant_y",
    anchor: "§5.1 (hash3D), not in the paper",
    statement: "thresholds on each single plane of constant y are uniform",
    run: |subject, draw| {
        planes(&CONSTANT_Y, "y = ", |_| DMat3::from_cols(DVec3::Z, DVec3::X, DVec3::Y), subject, draw)
    },
    ..CONSTANT_Z
};

/// Planes in any direction.
pub const ANY_DIRECTION: Claim = Claim {
    id: "uniform.any_plane",
    anchor: "§5.1 (hash3D), not in the paper",
    statement: "thresholds on each single plane, whatever its direction, are uniform",
    run: |subject, draw| planes(&ANY_DIRECTION, "plane at ", rotation, subject, draw),
    ..CONSTANT_Z
};

fn planes(
    claim: &Claim,
    label: &str,
    turn: impl Fn(&mut Xoshiro256PlusPlus) -> DMat3,
    subject: &Subject<'_>,
    draw: &Draw,
) -> Attempt<Trial> {
    let mut rng = draw.rng(claim.id);
    let wall = Scene::wall();
    let mut tests: Vec<ChiSquare> = Vec::new();
    let mut evidence = Vec::new();
    let mut biases: Vec<f64> = Vec::new();
    // A plane has only so many cells, so that the planes grow in number.
    let (planes, n) = (draw.groups(PLANES), draw.of_a_group().samples(PLANE_SAMPLES));
    let mut used = UsedCells::of(draw, 2 * n * planes);
    for _ in 0..planes {
        used.next_group();
        let turn = turn(&mut rng);
        // One place for all of a plane's samples: each plane has one distance from the origin.
        let scene = [turned(&wall, turn)];
        let samples = more_independent(subject, &scene, n, usize::MAX, &mut used, &mut rng);
        let values = subject.thresholds(&samples);
        reject_outsiders(subject, &samples, &values)?;
        let counts = histogram(values);
        tests.extend(uniformity(&counts));
        let below_half: u64 = counts.counts()[..BINS / 2].iter().sum();
        biases.push(below_half as f64 / counts.total() as f64 - 0.5);
        let distance = samples.first().map_or(f64::NAN, |sample| sample.footprint.position.dot(turn.z_axis));
        if evidence.len() < PLANES {
            evidence.push(NamedHistogram::new(format!("{label}{distance:.3}"), &counts));
        }
    }
    let Some(sum) =
        tests.into_iter().reduce(|a, b| ChiSquare::new(a.statistic + b.statistic, a.dof + b.dof, a.n + b.n))
    else {
        return Ok(Trial::without(Conclusion::Inconclusive, "the wall gave no samples"));
    };
    Ok(Trial::worst_of(&[sum], sum.n, in_words(&biases), Evidence::Histograms(evidence)))
}

/// Says whether the planes are biased alike.
fn in_words(biases: &[f64]) -> String {
    let n = biases.len() as f64;
    let mean = biases.iter().sum::<f64>() / n;
    let variance = biases.iter().map(|bias| (bias - mean) * (bias - mean)).sum::<f64>() / n;
    if mean * mean > variance {
        return format!(
            "all planes have one bias: the share of thresholds up to 1/2 is off by {:+.2} % in the mean",
            100.0 * mean
        );
    }
    let worst = biases.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0);
    format!(
        "each plane has a bias of its own: the share of thresholds up to 1/2 is off by up to {:+.2} %",
        100.0 * worst
    )
}
/// Turns a scene about the origin, camera and all.
fn turned(scene: &Scene, turn: DMat3) -> Scene {
    let Camera { eye, forward, direction_dx, direction_dy, resolution } = scene.camera;
    let surface = |&Rectangle { centre, half_u, half_v }: &Rectangle| Rectangle {
        centre: turn * centre,
        half_u: turn * half_u,
        half_v: turn * half_v,
    };
    Scene {
        camera: Camera {
            eye: turn * eye,
            forward: turn * forward,
            direction_dx: turn * direction_dx,
            direction_dy: turn * direction_dy,
            resolution,
        },
        surfaces: scene.surfaces.iter().map(surface).collect(),
        ..scene.clone()
    }
}
