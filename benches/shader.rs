//! What a threshold costs in the interpreter: both listings and two integer hashes, under the reference arithmetic and
//! under models of devices.
//!
//! Inputs are the footprints of the oblique scene, 65,536 of them, on all threads.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use hashed_alpha::scene::{Fragment, Scene};
use hashed_alpha::shader::interpreter::{Column, DeviceModel, Program};
use hashed_alpha::shader::own::assembled;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::pipeline::Pipeline;
use hashed_alpha::threshold::two_scale::Variant;
use std::hint::black_box;

const SAMPLES: usize = 1 << 16;
const LISTINGS: &str = include_str!("../tests/shader/listings.wgsl");

fn compile(function: &str) -> Program {
    let module = naga::front::wgsl::parse_str(LISTINGS).expect("it parses");
    let info = naga::valid::Validator::new(Default::default(), Default::default())
        .validate(&module)
        .expect("it is valid");
    Program::compile(&module, &info, function).expect("it is interpreted")
}

fn oblique() -> impl Iterator<Item = Footprint<f64>> {
    let scene = Scene::all().into_iter().find(|scene| scene.name == "oblique").expect("a built-in scene");
    let footprints: Vec<_> = scene.footprints().step_by(11).take(SAMPLES).collect();
    footprints.into_iter()
}

fn columns() -> Vec<Vec<f32>> {
    let mut columns = vec![Vec::new(); 9];
    for footprint in oblique() {
        let Footprint::<f32> { position, dpdx, dpdy } = footprint.cast();
        let values = [position, dpdx, dpdy].into_iter().flat_map(|vector| vector.to_array());
        for (column, value) in columns.iter_mut().zip(values) {
            column.push(value);
        }
    }
    columns
}

fn all(criterion: &mut Criterion) {
    let columns = columns();
    let lanes = columns[0].len();
    let mut group = criterion.benchmark_group("interpreter");
    group.throughput(Throughput::Elements(lanes as u64));
    let mut inputs: Vec<_> = columns.iter().map(|column| Column::F32(column)).collect();
    inputs.push(Column::F32(&[1.0]));
    for function in ["isotropic", "anisotropic"] {
        let program = compile(function);
        for model in &DeviceModel::ALL {
            group.bench_function(format!("{function}/{}", model.name()), |b| {
                b.iter(|| program.run(black_box(&inputs), lanes, model));
            });
        }
    }
    let cells =
        [Column::F32(&columns[0]), Column::F32(&columns[1]), Column::F32(&columns[2]), Column::I32(&[3])];
    for function in ["mm4", "pcg3d"] {
        let program = compile(function);
        group.bench_function(function, |b| {
            b.iter(|| program.run(black_box(&cells), lanes, &DeviceModel::ACCURATE));
        });
    }
    // With what a trial adds: words out of fragments and back.
    let fragments: Vec<Fragment> = oblique().map(Fragment::from).collect();
    let shader = assembled("listing", Pipeline::listing(Variant::Isotropic)).expect("it is read");
    let program = shader.program().expect("it is interpreted");
    group.bench_function("fragments", |b| {
        b.iter(|| shader.thresholds(&program, black_box(&fragments), &DeviceModel::ACCURATE));
    });
    group.bench_function("compile", |b| b.iter(|| compile(black_box("isotropic"))));
    group.finish();
}

criterion_group!(benches, all);
criterion_main!(benches);
