//! Stochastic and hashed thresholds: §4 to §6.

use crate::measure::{
    Plane, answer, holds, list, listing, mean, outcome, percent, rms, run_lengths, share, tried, value,
    visible,
};
use crate::row::{Measured, Row, judge};
use glam::{DVec3, dvec3};
use hashed_alpha::check::Subject;
use hashed_alpha::check::subject::Precision::{F32, F64};
use hashed_alpha::stats::{chi_square, ecdf, seed};
use hashed_alpha::threshold::cdf::cdf;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::sine::hash_2d;
use hashed_alpha::threshold::hash::{Cell, Hash, HashKind};
use hashed_alpha::threshold::real::Real;
use hashed_alpha::threshold::robust::{Join, Robust};
use hashed_alpha::threshold::stage::stratify::stratified_literal;
use hashed_alpha::threshold::stochastic::stochastic;
use hashed_alpha::threshold::two_scale::Variant::{self, Anisotropic, Isotropic};
use rand::Rng;

pub const ROWS: &[Row] = &[
    Row {
        id: "stochastic.expectation",
        place: "§4",
        sentence: "The expected visibility under a random threshold is alpha.",
        measure: expectation,
    },
    Row {
        id: "stochastic.convergence",
        place: "§4, Fig. 5",
        sentence: "1, 4, 16, 64 random tests a pixel converge to the ground truth.",
        measure: convergence,
    },
    Row {
        id: "stochastic.twinkle",
        place: "§4",
        sentence: "One random threshold a frame twinkles continuously.",
        measure: twinkle,
    },
    Row {
        id: "stochastic.seeds",
        place: "§4",
        sentence: "Seeds kept between frames steady what stands still; the noise is back whenever something moves.",
        measure: kept_seeds,
    },
    Row {
        id: "hash.two_dimensions",
        place: "§5.1",
        sentence: "The hash of two coordinates is uniform on [0, 1).",
        measure: two_dimensions,
    },
    Row {
        id: "hash.three_dimensions",
        place: "§5.1",
        sentence: "Nesting the two-dimensional hash serves as well for three coordinates.",
        measure: three_dimensions,
    },
    Row {
        id: "hash.others",
        place: "§5.1",
        sentence: "Other hash functions give largely equivalent results.",
        measure: others,
    },
    Row {
        id: "anchor.object",
        place: "§5.2",
        sentence: "Object coordinates give stable hashes under camera motion, rigid motion and skinning.",
        measure: object,
    },
    Row {
        id: "anchor.small_frames",
        place: "§5.2",
        sentence: "With coordinate frames below a pixel (one for each leaf) all stability is lost.",
        measure: small_frames,
    },
    Row {
        id: "layers.screen_and_texture",
        place: "§5.3",
        sentence: "Hashing window or texture coordinates correlates overlapping layers.",
        measure: screen_and_texture,
    },
    Row {
        id: "layers.third_coordinate",
        place: "§5.3",
        sentence: "A third coordinate in the hash trivially removes these correlations.",
        measure: third_coordinate,
    },
    Row {
        id: "stable.sub_pixel",
        place: "§5, §5.4",
        sentence: "A translation below a pixel returns the same hashed value.",
        measure: sub_pixel,
    },
    Row {
        id: "stable.whole_pixel",
        place: "§5.4",
        sentence: "For larger motions thresholds are reused in other pixels.",
        measure: whole_pixel,
    },
    Row {
        id: "scale.size",
        place: "§5.4.1",
        sentence: "The hash scale controls the size of the noise in pixels.",
        measure: size,
    },
    Row {
        id: "zoom.single",
        place: "§5.4.2",
        sentence: "With one continuous scale a motion along the view gives noise as of stochastic alpha testing.",
        measure: single_scale,
    },
    Row {
        id: "zoom.linear",
        place: "§5.4.2",
        sentence: "Two linear scales fail for derivatives below one.",
        measure: linear_scales,
    },
    Row {
        id: "zoom.not_uniform",
        place: "§5.4.2",
        sentence: "Interpolating two uniform values is not uniform: its variance changes during motion.",
        measure: not_uniform,
    },
    Row {
        id: "zoom.cdf",
        place: "§5.4.2, Eq. 2",
        sentence: "The distribution function makes the interpolated value uniform again.",
        measure: distribution_function,
    },
    Row {
        id: "listing_1.uniform",
        place: "Listing 1",
        sentence: "The final threshold is uniform.",
        measure: listing_1_uniform,
    },
    Row {
        id: "listing_1.continuous",
        place: "§5.4.2, Listing 1",
        sentence: "On the way along the view the noise changes slowly and continuously.",
        measure: listing_1_continuous,
    },
    Row {
        id: "listing_1.clamp",
        place: "Listing 1",
        sentence: "The clamp avoids a threshold of 0.",
        measure: clamp,
    },
    Row {
        id: "grazing.elongated",
        place: "§6, Fig. 7",
        sentence: "At grazing angles isotropic noise is elongated along one screen axis, anisotropic noise far less.",
        measure: elongated,
    },
    Row {
        id: "grazing.size",
        place: "§6.2",
        sentence: "Scales an axis make the noise smaller; the factor sqrt(2) brings its size back.",
        measure: square_root_of_two,
    },
    Row {
        id: "grazing.rest",
        place: "§6.1",
        sentence: "Small but variable amounts of anisotropy remain.",
        measure: remaining,
    },
    Row {
        id: "grazing.uniform",
        place: "§6.2, Listing 2",
        sentence: "The anisotropic threshold is uniform.",
        measure: listing_2_uniform,
    },
    Row {
        id: "grazing.every_surface",
        place: "Listing 2",
        sentence: "Listing 2 gives a threshold on every surface.",
        measure: every_surface,
    },
    Row {
        id: "grazing.stable",
        place: "§1, §6",
        sentence: "The anisotropic variant keeps the stability of the isotropic one.",
        measure: listing_2_stable,
    },
    Row {
        id: "grazing.eight_corners",
        place: "§6.2",
        sentence: "Eight corners with trilinear weights do not improve the stability of the hash.",
        measure: eight_corners,
    },
];

const ALPHAS: [f64; 9] = [0.05, 0.1, 0.2, 0.3, 0.5, 0.6, 0.75, 0.9, 0.95];

fn expectation() -> Measured {
    let n = 1 << 16;
    let mut rng = seed::rng("claims.expectation", 0);
    let random: Vec<f64> = (0..n).map(|_| stochastic(rng.next_u32())).collect();
    // Five pixels apart, so that no two share a cell.
    let plane = Plane::tilted(35.0, 0.013, 0.0);
    let of = listing(Isotropic, 1.0);
    let hashed: Vec<f64> =
        (0..n).map(|i| of(&plane.at(5.0 * f64::from(i % 256), 5.0 * f64::from(i / 256)))).collect();
    let worst = |thresholds: &[f64]| {
        ALPHAS
            .map(|alpha| (mean(thresholds.iter().map(|&t| visible(alpha, t))) - alpha).abs())
            .into_iter()
            .fold(0.0, f64::max)
    };
    let (random, hashed) = (worst(&random), worst(&hashed));
    let bound = 4.0 * 0.5 / f64::from(n).sqrt();
    let seen = format!(
        "largest error over nine alphas: stochastic {random:.4}, hashed {hashed:.4}, 4 deviations are {bound:.4}"
    );
    judge(n, random < bound && hashed < bound, random < bound, seen)
}

fn convergence() -> Measured {
    let pixels = 4096;
    let error = |tests: u32| {
        rms((0..pixels).map(|p| {
            let alpha = value([p, 0, 10, 0]);
            mean((0..tests).map(|t| visible(alpha, value([p, t, 11, 0])))) - alpha
        }))
    };
    let errors = [1, 4, 16, 64].map(error);
    let halved = errors.windows(2).all(|pair| (pair[0] / pair[1] - 2.0).abs() < 0.15);
    judge(pixels, halved, errors[3] < errors[0], format!("error {} rms: halved each time", list(errors)))
}

fn twinkle() -> Measured {
    let n = 1 << 15;
    let flips = share((0..n).map(|p| (0.5 >= value([p, 0, 12, 0])) != (0.5 >= value([p, 1, 12, 0]))));
    judge(
        n,
        (flips - 0.5).abs() < 0.02,
        flips > 0.1,
        format!("{} of the pixels of alpha 1/2 flip in each frame", percent(flips)),
    )
}

fn kept_seeds() -> Measured {
    let n = 1 << 15;
    let flips = |moved: u32| {
        share((0..n).map(|p| (0.5 >= value([p, 0, 13, 0])) != (0.5 >= value([p + moved, 0, 13, 0]))))
    };
    let seen = format!(
        "flips at alpha 1/2: {} at rest, {} after a pixel of motion",
        percent(flips(0)),
        percent(flips(1))
    );
    judge(n, flips(0) == 0.0 && (flips(1) - 0.5).abs() < 0.02, false, seen)
}

fn two_dimensions() -> Measured {
    let of = |offset: f64| {
        let mut counts = [0_u64; 64];
        for i in 0..512 * 512 {
            let h = hash_2d((f64::from(i % 512) + offset) as f32, (f64::from(i / 512) + offset) as f32);
            counts[((h * 64.0) as usize).min(63)] += 1;
        }
        chi_square::uniform(&counts).expect("a full table").p
    };
    let near = [1.0, 4096.0, 65_536.0].map(of);
    let far = of(16_777_216.0);
    let seen = format!(
        "chi-square over 64 bins in f32: p = {} for cells from 1, 2^12, 2^16 on; {far:.1e} from 2^24 on, where f32 has no \
         odd numbers",
        list(near)
    );
    let sound = near.into_iter().all(|p| p > 1e-4);
    judge(4 * 512 * 512, sound && far > 1e-4, sound, seen)
}

/// On how many of 64 planes of constant z the hash is not uniform at a level of 1 %, and the rms bias of the share below
/// one half.
fn planes<R: Real>(hash: HashKind) -> (usize, f64) {
    let side = 256;
    let (mut rejected, mut biases) = (0, Vec::new());
    for z in 1..=64 {
        let cell = |i: i32| Cell::<R> {
            index: [i % side, i / side, z].map(|c| R::from_f64(f64::from(c))).into(),
            octave: 0,
        };
        let mut values: Vec<f64> = (0..side * side).map(|i| hash.hash(&cell(i)).to_f64()).collect();
        biases.push(mean(values.iter().map(|&h| visible(0.5, h))) - 0.5);
        let test = ecdf::kolmogorov_smirnov(&mut values).expect("values");
        rejected += usize::from(test.p < 0.01);
    }
    (rejected, rms(biases))
}

fn three_dimensions() -> Measured {
    let [single, double] = [planes::<f32>(HashKind::Sine), planes::<f64>(HashKind::Sine)];
    let sound = planes::<f32>(HashKind::Mm4);
    let seen = format!(
        "planes of constant z that are not uniform (level 1 %, 0.6 of 64 by chance): f32 {}, f64 {}, an integer hash {}; \
         bias at 1/2 {:.4}, {:.4}, {:.4} rms (chance: 0.0020)",
        single.0, double.0, sound.0, single.1, double.1, sound.1
    );
    judge(64 * 65_536, single.0 <= 5, double.0 <= 5, seen)
}

fn others() -> Measured {
    let biases: Vec<(HashKind, f64)> = HashKind::ALL.map(|hash| (hash, planes::<f32>(hash).1)).to_vec();
    let text: Vec<String> = biases.iter().map(|(hash, bias)| format!("{hash} {bias:.4}")).collect();
    let alike = |of_the_paper: bool| {
        biases
            .iter()
            .filter(|(h, _)| of_the_paper || !h.name().starts_with("sine"))
            .all(|(_, bias)| *bias < 0.003)
    };
    let seen = format!("bias of planes of constant z at 1/2, rms (chance: 0.0020): {}", text.join(", "));
    judge(HashKind::ALL.len() as u64 * 64 * 65_536, alike(true), alike(false), seen)
}

fn object() -> Measured {
    let outcome = outcome("coordinates.object", Isotropic, F32);
    judge(outcome.n, holds(&outcome), false, answer(&outcome))
}

fn small_frames() -> Measured {
    let of = listing(Isotropic, 1.0);
    let leaf = |i: u32| Footprint {
        position: dvec3(value([i, 0, 14, 0]), value([i, 1, 14, 0]), value([i, 2, 14, 0])) * 0.4,
        dpdx: DVec3::X,
        dpdy: DVec3::Y,
    };
    let n = 4096;
    let mut thresholds: Vec<u64> = (0..n).map(|i| of(&leaf(i)).to_bits()).collect();
    thresholds.sort_unstable();
    thresholds.dedup();
    let kept = mean((0..n).map(|i| visible(0.1, of(&leaf(i)))));
    let seen = format!(
        "leaves of 0.4 pixels, each in a frame of its own: {} threshold in {n} leaves, alpha 0.1 is kept in {}; it is not \
         noise but a constant",
        thresholds.len(),
        percent(kept)
    );
    judge(n, thresholds.len() > 1000, thresholds.len() < 9, seen)
}

fn screen_and_texture() -> Measured {
    let side = 256_u32;
    let of = listing(Isotropic, 1.0);
    let plane = Plane { dx: DVec3::X, dy: DVec3::Y, origin: DVec3::splat(0.5) };
    let covered = |layer: &dyn Fn(f64) -> Plane| {
        let images = [0.0, 7.0].map(|z| layer(z).image(side, of));
        share((0..images[0].len()).map(|i| images.iter().any(|image| 0.5 >= image[i])))
    };
    let (same, own) =
        (covered(&|_| plane), covered(&|z| Plane { origin: dvec3(900.5, 50.5, z + 0.5), ..plane }));
    let seen = format!(
        "two layers of alpha 1/2 cover {same:.3} with shared coordinates, {own:.3} with a third one (product law: 0.750)"
    );
    judge(side * side, same < 0.52 && own > 0.7, false, seen)
}

fn third_coordinate() -> Measured {
    let [single, double] = [F32, F64].map(|precision| outcome("layers.parallel", Isotropic, precision));
    let seen = format!("{}; {}", answer(&single), answer(&double));
    judge(single.n + double.n, holds(&single), holds(&double), seen)
}

/// The share of thresholds on planes in general position that a shift along x changes; over one octave of sizes.
fn changed(threshold: impl Fn(&Footprint<f64>) -> f64, shift: f64) -> f64 {
    mean((0..16).map(|i| {
        let plane = Plane::tilted(0.0, 0.01 * libm::exp2(f64::from(i) / 16.0), 0.37 * f64::from(i));
        let [before, after] = [0.0, shift].map(|by| {
            let moved = Plane { origin: plane.origin + by * plane.dx, ..plane };
            moved.image(64, &threshold)
        });
        share(before.iter().zip(&after).map(|(a, b)| a != b))
    }))
}

fn sub_pixel() -> Measured {
    let shares = [0.05, 0.125, 0.5].map(|shift| changed(listing(Isotropic, 1.0), shift));
    let seen = format!(
        "a shift of 0.05, 0.125, 0.5 pixels changes {} of the thresholds",
        shares.map(percent).join(", ")
    );
    judge(16 * 4096, shares[2] < 0.01, shares[1] < 0.5, seen)
}

fn whole_pixel() -> Measured {
    let plane = Plane::tilted(50.0, 0.012, 0.2);
    let of = listing(Isotropic, 1.0);
    let same = share((0..1 << 14).map(|i| {
        let (x, y) = (f64::from(i % 128), f64::from(i / 128));
        let moved = Plane { origin: plane.origin + 17.0 * plane.dx, ..plane };
        of(&plane.at(x + 17.0, y)) == of(&moved.at(x, y))
    }));
    judge(
        1 << 14,
        same > 0.99,
        same > 0.9,
        format!("after 17 pixels {} of the thresholds are those of 17 pixels on", percent(same)),
    )
}

fn size() -> Measured {
    let scales = [1.0, 2.0, 4.0, 8.0];
    let runs = scales.map(|scale| {
        mean((0..8).map(|i| {
            let plane = Plane::tilted(0.0, 0.01 * libm::exp2(f64::from(i) / 8.0), 0.5 * f64::from(i));
            run_lengths(&plane.image(96, listing(Isotropic, scale)), 96)[0]
        }))
    });
    let seen = format!("runs of equal thresholds for scales 1, 2, 4, 8: {} pixels", list(runs));
    judge(8 * 4 * 96 * 96, (runs[3] / runs[2] - 2.0).abs() < 0.3 && runs[1] > runs[0], runs.is_sorted(), seen)
}

/// The share of flips at alpha 1/2, and the mean change of the threshold, when the camera comes nearer by 1/500 of the
/// distance, on a surface 500 pixels from its object's origin.
fn nearer(variant: Variant) -> (f64, f64) {
    let of = listing(variant, 1.0);
    let plane = Plane::tilted(20.0, 0.0113, 0.0);
    let plane = Plane { origin: plane.origin.normalize() * (500.0 * 0.0113), ..plane };
    let pairs: Vec<(f64, f64)> = (0..1 << 14)
        .map(|i| {
            let here = plane.at(f64::from(i % 128), f64::from(i / 128));
            let there = Footprint { dpdx: here.dpdx * 0.998, dpdy: here.dpdy * 0.998, ..here };
            (of(&here), of(&there))
        })
        .collect();
    (
        share(pairs.iter().map(|(a, b)| (0.5 >= *a) != (0.5 >= *b))),
        mean(pairs.iter().map(|(a, b)| (a - b).abs())),
    )
}

fn single_scale() -> Measured {
    let (single, two) = (nearer(Variant::Single), nearer(Isotropic));
    let seen = format!(
        "0.2 % nearer, 500 pixels from the origin, alpha 1/2: {} flip (stochastic: 50 %); with the two scales of Listing 1 {}",
        percent(single.0),
        percent(two.0)
    );
    judge(1 << 14, single.0 > 0.45, single.0 > 10.0 * two.0, seen)
}

fn linear_scales() -> Measured {
    let of = listing(Variant::Linear, 1.0);
    let n = 1000;
    let none = share((0..n).map(|i| {
        let size = (f64::from(i) + 0.5) / f64::from(n);
        !of(&Plane::tilted(0.0, size, 0.0).at(3.0, 5.0)).is_finite()
    }));
    judge(
        n,
        none == 1.0,
        none > 0.0,
        format!("{} of the derivatives in (0, 1) give no number", percent(none)),
    )
}

fn mixture(lerp: f64) -> Vec<f64> {
    (0..1 << 17).map(|i| (1.0 - lerp) * value([i, 0, 15, 0]) + lerp * value([i, 1, 15, 0])).collect()
}

fn not_uniform() -> Measured {
    let lerps = [0.0, 0.1, 0.25, 0.5];
    let distances = lerps.map(|lerp| ecdf::kolmogorov_smirnov(&mut mixture(lerp)).expect("values").d);
    let variances = lerps.map(|lerp| 12.0 * mean(mixture(lerp).into_iter().map(|x| (x - 0.5) * (x - 0.5))));
    let seen = format!(
        "weights 0, 0.1, 0.25, 0.5: distance from uniform {}; variance {} of that of a uniform value",
        list(distances),
        list(variances)
    );
    judge(1 << 17, distances[3] > 0.1 && variances[3] < 0.6 && distances[0] < 0.005, false, seen)
}

fn distribution_function() -> Measured {
    let lerps = [0.0, 0.05, 0.1, 0.25, 0.5, 0.8, 0.99];
    let p = lerps.map(|lerp| {
        let mut uniform: Vec<f64> = mixture(lerp).into_iter().map(|x| cdf(x, lerp)).collect();
        ecdf::kolmogorov_smirnov(&mut uniform).expect("values").p
    });
    let seen = format!("Kolmogorov-Smirnov for seven weights: p = {}", list(p));
    judge(7 << 17, p.into_iter().all(|p| p > 1e-4), false, seen)
}

fn listing_1_uniform() -> Measured {
    let [marginal, aligned] =
        ["uniform.marginal", "uniform.constant_z"].map(|claim| outcome(claim, Isotropic, F32));
    let seen = format!("{}; {}", answer(&marginal), answer(&aligned));
    judge(marginal.n + aligned.n, holds(&marginal) && holds(&aligned), holds(&marginal), seen)
}

fn listing_1_continuous() -> Measured {
    let outcome = outcome("continuity.zoom", Isotropic, F32);
    judge(outcome.n, holds(&outcome), false, answer(&outcome))
}

fn clamp() -> Measured {
    let of = listing(Isotropic, 1.0);
    // Derivatives of a power of two: one octave only, so that the hash is seen as it is.
    let plane = Plane { origin: dvec3(0.5, 0.5, 7.5), dx: DVec3::X, dy: DVec3::Y };
    let thresholds = plane.image(1024, of);
    let zeros = thresholds.iter().filter(|&&t| t == 0.0).count();
    let n = 8.try_into().expect("not 0");
    let after =
        thresholds.iter().filter(|&&t| (0..8).any(|i| stratified_literal(t as f32, i, n) == 0.0)).count();
    let seen = format!(
        "{zeros} of the thresholds of Listing 1 are 0; after Eq. 6, which has no clamp, {after} hash values give a 0 in one \
         of eight frames"
    );
    judge(thresholds.len() as u64, zeros == 0 && after == 0, zeros == 0, seen)
}

/// How large the noise is made where its shape is measured: at a scale of 1, runs of a pixel hide it.
const COARSE: f64 = 8.0;

/// The ratios of run lengths along x and along y, on planes of many orientations.
fn ratios(variant: Variant, degrees: f64) -> Vec<f64> {
    (0..24)
        .map(|i| {
            let plane = Plane::tilted(degrees, 0.01 * libm::exp2(f64::from(i) / 24.0), 0.41 * f64::from(i));
            let [x, y] = run_lengths(&plane.image(192, listing(variant, COARSE)), 192);
            x / y
        })
        .collect()
}

fn elongated() -> Measured {
    let [one, two] = [Isotropic, Anisotropic].map(|variant| mean(ratios(variant, 80.0)));
    // A floor that follows the axes but for a hundredth, so that Listing 2 has a threshold.
    let floor = |variant| {
        mean((0..24).map(|i| {
            let size = 0.01 * libm::exp2(f64::from(i) / 24.0);
            let plane = Plane {
                origin: dvec3(3.17, -1.73, 4.31),
                dx: dvec3(1.0, 0.01, 0.0) * size,
                dy: dvec3(0.0, 0.01, 1.0) * (size / libm::cos(80.0_f64.to_radians())),
            };
            let [x, y] = run_lengths(&plane.image(192, listing(variant, COARSE)), 192);
            x / y
        }))
    };
    let [floor_one, floor_two] = [Isotropic, Anisotropic].map(floor);
    let seen = format!(
        "runs along x by runs along y at 80 degrees, scale 8: isotropic {one:.2}, anisotropic {two:.2} in general position; \
         {floor_one:.2}, {floor_two:.2} on a floor that nearly follows the axes"
    );
    let much_less = |one: f64, two: f64| one > 2.0 && two < 0.5 * one;
    let as_said = much_less(one, two) && much_less(floor_one, floor_two);
    judge(2 * 24 * 192 * 192, as_said, much_less(floor_one, floor_two), seen)
}

fn square_root_of_two() -> Measured {
    let runs = |variant, scale| {
        mean((0..24).map(|i| {
            let plane = Plane::tilted(0.0, 0.01 * libm::exp2(f64::from(i) / 24.0), 0.41 * f64::from(i));
            let [x, y] = run_lengths(&plane.image(192, listing(variant, COARSE * scale)), 192);
            (x * y).sqrt()
        }))
    };
    let (one, with) = (runs(Isotropic, 1.0), runs(Anisotropic, 1.0));
    let without = runs(Anisotropic, 0.5_f64.sqrt());
    let seen = format!(
        "scale 8: runs of Listing 1 {one:.3} pixels; of Listing 2 {with:.3}, without the factor {without:.3}"
    );
    judge(
        3 * 24 * 192 * 192,
        (with - one).abs() < (without - one).abs() && without < one,
        without < with,
        seen,
    )
}

fn remaining() -> Measured {
    let mut found = ratios(Anisotropic, 70.0);
    found.sort_by(f64::total_cmp);
    let isotropic = mean(ratios(Isotropic, 70.0));
    let (least, most) = (found[0], found[found.len() - 1]);
    let seen = format!(
        "24 orientations at 70 degrees, scale 8: {least:.2} to {most:.2} (isotropic: {isotropic:.2} in the mean)"
    );
    judge(24 * 192 * 192, most > 1.1 * least && most < isotropic, most > 1.1 * least, seen)
}

fn listing_2_uniform() -> Measured {
    let marginal = outcome("uniform.marginal", Anisotropic, F32);
    judge(marginal.n, holds(&marginal), false, answer(&marginal))
}

fn every_surface() -> Measured {
    let of = listing(Anisotropic, 1.0);
    let none = |plane: Plane| share(plane.image(64, of).into_iter().map(|t| !t.is_finite()));
    let wall = none(Plane { origin: dvec3(0.3, 0.4, 0.5), dx: DVec3::X * 0.1, dy: DVec3::Y * 0.1 });
    let oblique = none(Plane::tilted(40.0, 0.013, 0.0));
    let planes = outcome("planes.axis_aligned", Anisotropic, F32);
    let seen = format!(
        "no number on {} of an axis-aligned wall and {} of an oblique one; {}",
        percent(wall),
        percent(oblique),
        answer(&planes)
    );
    judge(2 * 4096, wall == 0.0, false, seen)
}

fn listing_2_stable() -> Measured {
    let [zoom, shift] =
        ["continuity.zoom", "stability.translate"].map(|claim| outcome(claim, Anisotropic, F32));
    let pops = zoom.effect.unwrap_or(f64::NAN);
    let seen = format!("{}: {pops:.2} jumps a point and octave; {}", answer(&zoom), answer(&shift));
    judge(zoom.n + shift.n, holds(&zoom) && holds(&shift), holds(&shift), seen)
}

fn eight_corners() -> Measured {
    let flips = |join: Join| {
        let robust = Robust { join, ..Robust::new(Anisotropic) };
        mean((0..512).map(|point| {
            let plane = Plane::tilted(30.0, 1.0, f64::from(point));
            let place = [0, 1, 2].map(|axis| 40.0 * value([point, axis, 16, 0]));
            let at = |step: i32| {
                let size = 0.01 * libm::exp2(f64::from(step) / 64.0);
                let footprint =
                    Footprint { position: place.into(), dpdx: plane.dx * size, dpdy: plane.dy * size };
                robust.threshold(&footprint).expect("a finite footprint")
            };
            (0..256).filter(|&step| (0.5 >= at(step)) != (0.5 >= at(step + 1))).count() as f64 / 4.0
        }))
    };
    let (two, eight) = (flips(Join::Interpolate), flips(Join::Copula));
    let subject = Subject::robust::<HashKind>("eight corners", F32, Robust::new(Anisotropic));
    let zoom = tried("continuity.zoom", subject);
    let seen = format!(
        "flips an octave of zoom at alpha 1/2, same hash: two corners {two:.2}, eight corners (joined as normal values) \
         {eight:.2}; {}",
        answer(&zoom)
    );
    judge(2 * 512 * 256, eight > 0.9 * two, false, seen)
}
