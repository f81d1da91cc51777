//! Planes that follow an axis: the bias of the sine hash on them, cells that flicker, derivatives of zero.

use glam::{DVec2, DVec3, dvec2, dvec3};
use hashed_alpha::report::figure::planes::{
    PlaneBias, PlaneChanges, ThresholdMap, plane_bias, plane_changes, threshold_maps,
};
use hashed_alpha::scene::raster::Raster;
use hashed_alpha::scene::{Camera, Rectangle};
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::real::Real;
use hashed_alpha::threshold::robust::Robust;
use hashed_alpha::threshold::two_scale::Variant;
use rand::RngExt;
use rand::rngs::Xoshiro256PlusPlus;
use rayon::prelude::*;

/// A threshold of a footprint in `f32`; NaN where it is none.
type Threshold = fn(&Footprint<f32>) -> f32;

fn literal<R: Real>(variant: Variant, footprint: &Footprint<R>) -> R {
    HashedAlpha::listing(variant).threshold(footprint)
}

fn robust(variant: Variant, footprint: &Footprint<f32>) -> f32 {
    Robust::new(variant).threshold(footprint).unwrap_or(f32::NAN)
}

pub fn draw_planes() -> String {
    const SIDE: u32 = 256;
    const PIXELS: f64 = (SIDE * SIDE) as f64;
    // One cell a pixel, all weight on the coarse octave: the threshold is one hash.
    let at = |z: u32, pixel: u32| Footprint::<f64> {
        position: dvec3(f64::from(pixel % SIDE) + 0.5, f64::from(pixel / SIDE) + 0.5, f64::from(z) + 0.5),
        dpdx: DVec3::X,
        dpdy: DVec3::Y,
    };
    let bias = |passes: fn(&Footprint<f64>) -> bool| {
        let of_plane = |z: u32| {
            let kept = (0..SIDE * SIDE).filter(|&pixel| passes(&at(z, pixel))).count();
            kept as f64 / PIXELS - 0.5
        };
        (0..256).into_par_iter().map(of_plane).collect()
    };
    let panels = [
        PlaneBias {
            name: "Listing 1 in f32".to_owned(),
            bias: bias(|at| literal::<f32>(Variant::Isotropic, &at.cast()) <= 0.5),
        },
        PlaneBias {
            name: "Listing 1 in f64".to_owned(),
            bias: bias(|at| literal(Variant::Isotropic, at) <= 0.5),
        },
        PlaneBias {
            name: "robust in f32".to_owned(),
            bias: bias(|at| robust(Variant::Isotropic, &at.cast()) <= 0.5),
        },
    ];
    plane_bias(
        "Coverage of planes of constant z at alpha 0.5, 256 x 256 pixels each",
        &panels,
        0.5 / PIXELS.sqrt(),
    )
}

pub fn draw_dyadic(mut rng: Xoshiro256PlusPlus) -> String {
    const VIEWS: usize = 24;
    const SIDE: u32 = 96;
    const SHIFT: f64 = 0.012;
    let planes = [0.0, 0.1, 0.3, 0.5, 1.0, 3.0];
    let series: [(&str, Threshold); 4] = [
        ("Listing 1", |at| literal(Variant::Isotropic, at)),
        ("Listing 2", |at| literal(Variant::Anisotropic, at)),
        ("robust, isotropic", |at| robust(Variant::Isotropic, at)),
        ("robust, anisotropic", |at| robust(Variant::Anisotropic, at)),
    ];
    let cameras: Vec<_> = (0..VIEWS).map(|_| [0; 5].map(|_| rng.random_range(-1.0..1.0_f64))).collect();
    let view = |z: f64, [x, y, tilt_x, tilt_y, distance]: [f64; 5]| {
        let target = dvec3(7.0 * x, 7.0 * y, z);
        let eye = target + dvec3(1.3 * tilt_x, 1.3 * tilt_y, 1.0).normalize() * (3.0 + distance);
        let camera = Camera::look_at(eye, target, dvec3(0.2, 1.0, 0.1), 0.3, [SIDE; 2]);
        (camera, Rectangle { centre: target, half_u: DVec3::X * 1.7, half_v: DVec3::Y * 1.7 })
    };
    // A pixel counts where both thresholds are numbers.
    let share = |z: f64, threshold: Threshold| {
        let counts = cameras.par_iter().map(|&parameters| {
            let (camera, wall) = view(z, parameters);
            let at = |shift| Raster::new(&camera, &wall, shift).expect("the wall is in front of the camera");
            let (still, moved) = (at(DVec2::ZERO), at(dvec2(SHIFT, 0.0)));
            let (mut changed, mut seen) = (0_u32, 0_u32);
            for pixel in (0..SIDE * SIDE).map(|i| [i % SIDE, i / SIDE]) {
                let (Some(before), Some(after)) = (still.footprint(pixel), moved.footprint(pixel)) else {
                    continue;
                };
                let values = [threshold(&before), threshold(&after)];
                if values.iter().all(|value| !value.is_nan()) {
                    seen += 1;
                    // Between octaves a threshold moves a little with the footprint; a new cell moves it more.
                    changed += u32::from((values[0] - values[1]).abs() > 1.0e-3);
                }
            }
            [changed, seen]
        });
        let [changed, seen] = counts.reduce(|| [0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
        f64::from(changed) / f64::from(seen)
    };
    let series = series.map(|(name, threshold)| PlaneChanges {
        name: name.to_owned(),
        share: planes.map(|z| share(z, threshold)).into(),
    });
    let title =
        format!("Thresholds that a shift of {SHIFT} pixels changes, tilted views of planes of constant z");
    let names = planes.map(|z| format!("z = {z}"));
    plane_changes(&title, &names.each_ref().map(String::as_str), &series)
}

pub fn draw_room() -> String {
    const SIZE: [u32; 2] = [144, 144];
    let camera = Camera::look_at(dvec3(0.5, 0.3, 4.2), dvec3(-0.3, 0.1, -3.0), DVec3::Y, 0.5, SIZE);
    // A box that is open towards the camera: floor, ceiling and three walls.
    let [low, high] = [dvec3(-2.0, -1.0, -3.0), dvec3(2.1, 1.5, 3.0)];
    let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
    let wall = |(axis, side): (usize, DVec3)| {
        let mut centre = middle;
        centre[axis] = side[axis];
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        Rectangle { centre, half_u: DVec3::AXES[u] * half[u], half_v: DVec3::AXES[v] * half[v] }
    };
    let walls = [(0, low), (0, high), (1, low), (1, high), (2, low)].map(wall);
    let rasters = walls.map(|wall| Raster::new(&camera, &wall, DVec2::ZERO).expect("walls are in front"));
    let seen = |pixel: [u32; 2]| rasters.iter().find_map(|raster| raster.footprint(pixel));
    let pixels = || (0..SIZE[0] * SIZE[1]).map(|i| [i % SIZE[0], i / SIZE[0]]);
    let map = |title: &str, threshold: Threshold| ThresholdMap {
        title: title.to_owned(),
        columns: SIZE[0] as usize,
        thresholds: pixels().map(|pixel| seen(pixel).map(|at| f64::from(threshold(&at)))).collect(),
    };
    let maps = [
        map("Listing 2", |at| literal(Variant::Anisotropic, at)),
        map("robust", |at| robust(Variant::Anisotropic, at)),
    ];
    threshold_maps("Thresholds in a room whose walls follow the axes", &maps)
}
