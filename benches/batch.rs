//! What a threshold costs in a batch: tiers, hashes, joins and instruction sets beside the scalar path.
//!
//! 16,384 footprints, so that columns and thresholds stay in the second cache; the footprints are those of the oblique
//! scene. The scalar path sees them in the same order each time, which flatters it: a branch predictor learns them.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use hashed_alpha::scene::Scene;
use hashed_alpha::threshold::batch::{Batch, Bins, ColumnBuffer, Isa, Lane, Model, Tier};
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::real::Real;
use hashed_alpha::threshold::robust::{Join, Robust};
use hashed_alpha::threshold::two_scale::Variant;

const SAMPLES: usize = 1 << 14;

fn footprints<R: Real>() -> Vec<Footprint<R>> {
    let scene = Scene::all().into_iter().find(|scene| scene.name == "oblique").expect("a built-in scene");
    scene.footprints().step_by(11).take(SAMPLES).map(|footprint| footprint.cast()).collect()
}

fn models() -> Vec<(&'static str, Model)> {
    let listing =
        |variant, hash| Model::from(HashedAlpha { variant, hash, hash_scale: 1.0, form: CdfForm::Literal });
    let robust = |join| Model::from(Robust { join, ..Robust::new(Variant::Isotropic) });
    vec![
        ("listing-1", listing(Variant::Isotropic, HashKind::Sine)),
        ("listing-2", listing(Variant::Anisotropic, HashKind::Sine)),
        ("listing-1-mm4", listing(Variant::Isotropic, HashKind::Mm4)),
        ("listing-1-pcg3d", listing(Variant::Isotropic, HashKind::Pcg3d)),
        ("robust", robust(Join::Interpolate)),
        ("robust-dithered", robust(Join::Dithered)),
        ("robust-inherit", robust(Join::Inherit)),
        ("robust-copula", robust(Join::Copula)),
    ]
}

fn thresholds<R: Lane>(criterion: &mut Criterion, tiers: &[Tier]) {
    let footprints = footprints::<R>();
    let columns: ColumnBuffer<R> = footprints.iter().copied().collect();
    let mut out = vec![R::from_f64(0.0); footprints.len()];
    let mut group = criterion.benchmark_group("batch");
    group.throughput(Throughput::Elements(footprints.len() as u64));
    for (name, model) in models() {
        group.bench_function(format!("{name}/{}/scalar", R::NAME), |b| {
            b.iter(|| out.iter_mut().zip(&footprints).for_each(|(out, at)| *out = model.threshold(at)));
        });
        for (isa, &tier) in Isa::available().flat_map(|isa| tiers.iter().map(move |tier| (isa, tier))) {
            // Without a fused multiply-add the fast tiers emulate it.
            if isa == Isa::Portable && tier != Tier::BitExact {
                continue;
            }
            let batch = Batch { model, tier, isa };
            group.bench_function(format!("{name}/{}/{tier}/{isa}", R::NAME), |b| {
                b.iter(|| batch.thresholds(&columns.columns(), &mut out));
            });
        }
    }
    let batch = Batch::new(Robust::new(Variant::Isotropic));
    let mut bins = Bins::new(1 << 10);
    group.bench_function(format!("robust-binned/{}/{}", R::NAME, batch.isa), |b| {
        b.iter(|| {
            batch.thresholds(&columns.columns(), &mut out);
            bins.add(batch.isa, &out);
        });
    });
    group.finish();
}

fn slices(criterion: &mut Criterion) {
    let x: Vec<f32> = (0..SAMPLES).map(|i| 0.37 * i as f32).collect();
    let mut out = vec![0.0; SAMPLES];
    let mut group = criterion.benchmark_group("slices");
    group.throughput(Throughput::Elements(SAMPLES as u64));
    for isa in Isa::available() {
        group.bench_function(format!("sin/{isa}"), |b| b.iter(|| isa.sin(&x, &mut out)));
        group.bench_function(format!("log2/{isa}"), |b| b.iter(|| isa.log2(&x, &mut out)));
    }
    group.finish();
}

fn all(criterion: &mut Criterion) {
    slices(criterion);
    thresholds::<f32>(criterion, &Tier::ALL);
    thresholds::<f64>(criterion, &[Tier::Fast, Tier::TwoUlp, Tier::BitExact]);
}

criterion_group!(benches, all);
criterion_main!(benches);
