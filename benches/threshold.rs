//! What the stages of a threshold cost, one at a time: the paper's hash and every integer hash, both listings, both
//! precisions; and what the statistics cost that judge them.
//!
//! Inputs are the footprints of the oblique scene, 65,536 of them, so that no branch predictor learns them by heart.

mod plain;

use criterion::{
    BatchSize, BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main, measurement::WallTime,
};
use hashed_alpha::scene::Scene;
use hashed_alpha::stats::{binomial, chi_square, ecdf, spectrum, two_sample};
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::{Cell, Hash, HashKind, sine};
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::real::Real;
use hashed_alpha::threshold::robust::{Join, Robust};
use hashed_alpha::threshold::two_scale::Variant;
use std::hint::black_box;

const SAMPLES: usize = 1 << 16;

fn footprints<R: Real>() -> Vec<Footprint<R>> {
    let scene = Scene::all().into_iter().find(|scene| scene.name == "oblique").expect("a built-in scene");
    scene.footprints().step_by(11).take(SAMPLES).map(|footprint| footprint.cast()).collect()
}

fn cells<R: Real>() -> Vec<Cell<R>> {
    footprints::<R>().iter().map(|f| Variant::Isotropic.two_scale(f, R::from_f64(1.0)).ceil_cell).collect()
}

fn sum<R: Real, T>(inputs: &[T], value: impl Fn(&T) -> R) -> R {
    inputs.iter().fold(R::from_f64(0.0), |sum, input| sum + value(black_box(input)))
}

fn hashes<R: Real>(group: &mut BenchmarkGroup<'_, WallTime>) {
    let cells = cells::<R>();
    group.throughput(Throughput::Elements(cells.len() as u64));
    group.bench_function(format!("hash_2d/{}", R::NAME), |b| {
        b.iter(|| {
            sum(&cells, |cell| {
                let [x, y, _] = cell.index.into();
                sine::hash_2d(x, y)
            })
        });
    });
    for kind in HashKind::ALL {
        let name = if kind == HashKind::Sine { "hash_3d" } else { kind.name() };
        group.bench_function(format!("{name}/{}", R::NAME), |b| {
            b.iter(|| sum(&cells, |cell| kind.hash(cell)));
        });
    }
}

fn thresholds<R: Real>(group: &mut BenchmarkGroup<'_, WallTime>) {
    let footprints = footprints::<R>();
    group.throughput(Throughput::Elements(footprints.len() as u64));
    for variant in Variant::ALL {
        for hash in [HashKind::Sine, HashKind::Mm4] {
            let hashed = HashedAlpha { variant, hash, hash_scale: 1.0, form: CdfForm::Literal };
            group.bench_function(format!("{variant}/{hash}/{}", R::NAME), |b| {
                b.iter(|| sum(&footprints, |footprint| hashed.threshold(footprint)));
            });
        }
    }
}

/// A threshold at a time, beside the plain program of the same one.
fn one_at_a_time(group: &mut BenchmarkGroup<'_, WallTime>) {
    let footprints = footprints::<f32>();
    group.throughput(Throughput::Elements(footprints.len() as u64));
    group.bench_function("plain", |b| b.iter(|| sum(&footprints, plain::robust)));
    let listing = HashedAlpha::listing(Variant::Isotropic);
    group.bench_function("Listing 1", |b| {
        b.iter(|| sum(&footprints, |footprint| listing.threshold(footprint)))
    });
    for variant in [Variant::Isotropic, Variant::Anisotropic] {
        for join in Join::ALL {
            let robust = Robust { join, ..Robust::new(variant) };
            let threshold = |footprint: &Footprint<f32>| robust.threshold(footprint).unwrap_or(0.5);
            group.bench_function(format!("{variant}/{join}"), |b| b.iter(|| sum(&footprints, threshold)));
        }
    }
}

fn two_scales<R: Real>(group: &mut BenchmarkGroup<'_, WallTime>) {
    let footprints = footprints::<R>();
    group.throughput(Throughput::Elements(footprints.len() as u64));
    for variant in Variant::ALL {
        group.bench_function(format!("{variant}/{}", R::NAME), |b| {
            b.iter(|| {
                for footprint in &footprints {
                    black_box(variant.two_scale(black_box(footprint), R::from_f64(1.0)));
                }
            });
        });
    }
}

/// Each test over the thresholds of all footprints, in place of which evenly spread numbers in a mixed order stand.
fn statistics(group: &mut BenchmarkGroup<'_, WallTime>) {
    let value = |i: usize| ((i * 40_503) % SAMPLES) as f64 / SAMPLES as f64 + 0.5 / SAMPLES as f64;
    let values: Vec<f64> = (0..SAMPLES).map(value).collect();
    let counts = vec![(SAMPLES / 1024) as u64; 1024];
    group.throughput(Throughput::Elements(SAMPLES as u64));
    group.bench_function("chi_square", |b| b.iter(|| chi_square::uniform(black_box(&counts))));
    group.bench_function("kolmogorov_smirnov", |b| {
        b.iter_batched_ref(|| values.clone(), |v| ecdf::kolmogorov_smirnov(v), BatchSize::LargeInput);
    });
    group.bench_function("two_sample", |b| {
        b.iter_batched_ref(
            || (values.clone(), values.clone()),
            |(left, right)| two_sample::kolmogorov_smirnov(left, right),
            BatchSize::LargeInput,
        );
    });
    group.bench_function("periodogram", |b| {
        b.iter(|| spectrum::periodogram(black_box(&values), [256, SAMPLES / 256]));
    });
    group.bench_function("binomial", |b| {
        b.iter(|| binomial::two_sided_p(black_box(32_000), SAMPLES as u64, 0.5));
    });
}

fn all(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("hash");
    hashes::<f32>(&mut group);
    hashes::<f64>(&mut group);
    group.finish();
    let mut group = criterion.benchmark_group("two_scale");
    two_scales::<f32>(&mut group);
    two_scales::<f64>(&mut group);
    group.finish();
    let mut group = criterion.benchmark_group("one_at_a_time");
    one_at_a_time(&mut group);
    group.finish();
    let mut group = criterion.benchmark_group("statistics");
    statistics(&mut group);
    group.finish();
    let mut group = criterion.benchmark_group("threshold");
    thresholds::<f32>(&mut group);
    thresholds::<f64>(&mut group);
    group.finish();
}

criterion_group!(benches, all);
criterion_main!(benches);
