//! Draws the pictures of the README: `cargo run --release --example plots [DIRECTORY]`, by default into
//! `plots/gallery`. Equal bytes on every run: each picture takes its samples from a seed of its own.
#![allow(clippy::print_stdout)]

mod arithmetic;
mod axis_planes;

use glam::{DVec2, DVec3, dvec2, dvec3};
use hashed_alpha::check::claims;
use hashed_alpha::check::specimen::{self, matrix::KillMatrix};
use hashed_alpha::report::figure::before_and_after::{LerpHistograms, before_and_after};
use hashed_alpha::report::figure::cdf_family::cdf_family;
use hashed_alpha::report::figure::kill_matrix::{Kill, KillRow, kill_matrix};
use hashed_alpha::report::figure::noise::{NoisePanel, noise};
use hashed_alpha::report::figure::stability::{MeasuredShare, StabilityPanel, StabilitySeries, stability};
use hashed_alpha::scene::Scene;
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::stability::change_probability;
use hashed_alpha::threshold::two_scale::Variant;
use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let gallery = Path::new(env!("CARGO_MANIFEST_DIR")).join("plots").join("gallery");
    let directory = env::args_os().nth(1).map_or(gallery, PathBuf::from);
    fs::create_dir_all(&directory)?;
    for (name, picture) in [
        ("before_and_after", draw_before_and_after as fn(Xoshiro256PlusPlus) -> String),
        ("cdf_family", |_| cdf_family(&[0.0, 0.05, 0.15, 0.3, 0.5])),
        ("stability", draw_stability),
        ("stability_grazing", draw_stability_grazing),
        ("noise", draw_noise),
        ("validity", |_| arithmetic::draw_validity()),
        ("planes", |_| axis_planes::draw_planes()),
        ("dyadic", axis_planes::draw_dyadic),
        ("room", |_| axis_planes::draw_room()),
        ("kill_matrix", |_| draw_kill_matrix()),
    ] {
        let path = directory.join(name).with_extension("svg");
        fs::write(&path, picture(rng(name)))?;
        println!("{}", path.display());
    }
    Ok(())
}

/// A source of random numbers that depends on the name of the picture only.
fn rng(name: &str) -> Xoshiro256PlusPlus {
    let mut seed = [0; 32];
    for (place, byte) in seed.iter_mut().zip(name.bytes()) {
        *place = byte;
    }
    Xoshiro256PlusPlus::from_seed(seed)
}

fn hashed_alpha(variant: Variant, hash_scale: f64) -> HashedAlpha {
    HashedAlpha { variant, hash: HashKind::Mm4, hash_scale, form: CdfForm::Stable }
}

/// A pixel of a wall in general position, seen frontally: both derivatives have the length `derivative`.
fn wall(derivative: f64, pixel: DVec2) -> Footprint<f64> {
    // Two orthogonal unit vectors that follow no axis.
    let (right, up) = (dvec3(0.6, 0.64, 0.48), dvec3(0.8, -0.48, -0.36));
    let (dpdx, dpdy) = (right * derivative, up * derivative);
    Footprint { position: dvec3(3.1, -7.2, 11.3) + dpdx * pixel.x + dpdy * pixel.y, dpdx, dpdy }
}

/// A pixel of a frontal wall of constant z.
fn upright(derivative: f64, pixel: DVec2) -> Footprint<f64> {
    let (dpdx, dpdy) = (DVec3::X * derivative, DVec3::Y * derivative);
    Footprint { position: dvec3(3.1, -7.2, 11.3) + dpdx * pixel.x + dpdy * pixel.y, dpdx, dpdy }
}

/// A displacement so far that it leaves no trace of where the surface stood in its cells.
fn anywhere(rng: &mut Xoshiro256PlusPlus) -> DVec3 {
    DVec3::from_array([0; 3].map(|_| rng.random_range(-1000.0..1000.0)))
}

fn draw_before_and_after(mut rng: Xoshiro256PlusPlus) -> String {
    const SAMPLES: usize = 200_000;
    const BINS: usize = 32;
    let listing = hashed_alpha(Variant::Isotropic, 1.0);
    let columns = [0.05, 0.2, 0.35, 0.5, 0.8].map(|lerp_factor| {
        let (mut before, mut after) = (vec![0; BINS], vec![0; BINS]);
        for _ in 0..SAMPLES {
            let still = wall(libm::exp2(-8.0 - lerp_factor), DVec2::ZERO);
            let trace = listing.trace(&Footprint { position: anywhere(&mut rng), ..still });
            for (counts, value) in [(&mut before, trace.interpolated), (&mut after, trace.threshold)] {
                counts[((value * BINS as f64) as usize).min(BINS - 1)] += 1;
            }
        }
        LerpHistograms { lerp_factor, before, after }
    });
    before_and_after(&columns)
}

/// Shifts `surface` along the screen by parts of a pixel: what changes, and what the closed form says.
fn shifts(
    name: &str,
    listing: &HashedAlpha,
    surface: &[Footprint<f64>],
    along_x: bool,
    rng: &mut Xoshiro256PlusPlus,
) -> StabilitySeries {
    const CURVE_STEPS: u32 = 100;
    let motion = |at: &Footprint<f64>, shift: f64| if along_x { at.dpdx } else { at.dpdy } * shift;
    let predicted = |shift: f64| {
        let chance = |at: &Footprint<f64>| {
            let scales = listing.variant.two_scale(at, listing.hash_scale).pixel_scale;
            change_probability(scales.map(|s| libm::exp2(libm::log2(s).ceil())), motion(at, shift).to_array())
        };
        surface.iter().map(chance).sum::<f64>() / surface.len() as f64
    };
    let measured = (1..=10).map(|step| {
        let shift = f64::from(step) / 10.0;
        let changes = surface.iter().filter(|at| {
            let here = Footprint { position: at.position + anywhere(rng), ..**at };
            let there = Footprint { position: here.position + motion(at, shift), ..here };
            listing.threshold(&here) != listing.threshold(&there)
        });
        let (n, share) = (surface.len() as f64, predicted(shift));
        MeasuredShare { shift, share: changes.count() as f64 / n, sigma: (share * (1.0 - share) / n).sqrt() }
    });
    let measured = measured.collect();
    let curve = (0..=CURVE_STEPS).map(|step| f64::from(step) / f64::from(CURVE_STEPS));
    StabilitySeries { name: name.to_owned(), curve: curve.map(|x| [x, predicted(x)]).collect(), measured }
}

fn draw_stability(mut rng: Xoshiro256PlusPlus) -> String {
    const SAMPLES: u32 = 4000;
    // Distances over one octave, so that no lerp factor is preferred.
    let octave = |i: u32| wall(libm::exp2(-8.0 - (f64::from(i) + 0.5) / f64::from(SAMPLES)), DVec2::ZERO);
    let surface: Vec<_> = (0..SAMPLES).map(octave).collect();
    let series = [0.5, 1.0, 2.0].map(|hash_scale| {
        let listing = hashed_alpha(Variant::Isotropic, hash_scale);
        shifts(&format!("hash scale {hash_scale}"), &listing, &surface, true, &mut rng)
    });
    let panel = StabilityPanel { title: String::new(), series: series.into() };
    stability("Thresholds that a small shift changes, isotropic, frontal wall", &[panel])
}

fn draw_stability_grazing(mut rng: Xoshiro256PlusPlus) -> String {
    let fence = Scene::all().into_iter().find(|scene| scene.name == "fence").expect("the fence is built in");
    let surface: Vec<_> = fence.with_resolution([80, 60]).footprints().collect();
    let panels = [Variant::Isotropic, Variant::Anisotropic].map(|variant| {
        let listing = hashed_alpha(variant, 1.0);
        let series = [("shift along screen x", true), ("shift along screen y", false)]
            .map(|(name, along_x)| shifts(name, &listing, &surface, along_x, &mut rng));
        StabilityPanel { title: variant.to_string(), series: series.into() }
    });
    stability("Thresholds that a small shift changes, fence at a grazing angle", &panels)
}

fn draw_noise(_: Xoshiro256PlusPlus) -> String {
    const SIDE: u32 = 96;
    let panels = [1.0, 3.0, 9.0].map(|hash_scale| {
        let listing = hashed_alpha(Variant::Isotropic, hash_scale);
        let pixels = (0..SIDE * SIDE).map(|i| dvec2(f64::from(i % SIDE), f64::from(i / SIDE)));
        NoisePanel {
            title: format!("hash scale {hash_scale}"),
            columns: SIDE as usize,
            thresholds: pixels.map(|pixel| listing.threshold(&upright(0.003, pixel))).collect(),
        }
    });
    noise("Thresholds of a frontal wall for noise of 1, 3 and 9 pixels", &panels)
}

/// The committed matrix; its test keeps it up to date.
fn draw_kill_matrix() -> String {
    let matrix = KillMatrix::committed();
    let claims: Vec<&str> = claims::ALL.iter().map(|claim| claim.id).collect();
    let rows: Vec<KillRow> = specimen::ALL
        .iter()
        .map(|specimen| {
            let rejected = matrix.row(specimen.name).map_or(&[][..], |row| &row.claims);
            let kill = |claim: &&str| match () {
                () if !rejected.contains(claim) => Kill::None,
                () if *claim == specimen.claim => Kill::Named,
                () => Kill::Rejected,
            };
            KillRow { name: specimen.name.to_owned(), kills: claims.iter().map(kill).collect() }
        })
        .collect();
    kill_matrix("Specimens, and the claims that reject them", &claims, &rows)
}
