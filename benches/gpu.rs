//! Thresholds a second on each device, without transfers: the device draws its inputs itself and times itself. What that
//! costs stands beside it as "inputs alone".
//!
//! A machine without a driver has nothing to measure and says so. `HASHED_ALPHA_ADAPTER` measures one adapter alone.

#![expect(clippy::print_stdout, reason = "says why nothing was measured")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use hashed_alpha::shader::assemble::assemble;
use hashed_alpha::shader::gpu::adapter::{Adapter, CHOICE_VARIABLE, adapters};
use hashed_alpha::shader::gpu::{Choice, Device, Error, Kernel, Program};
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::pipeline::Pipeline;
use hashed_alpha::threshold::two_scale::Variant;
use std::time::{Duration, Instant};

const THRESHOLDS: u32 = 1 << 20;

/// Draws the inputs of a threshold on the device.
const FOOTPRINT: &str = include_str!("drawn_footprint.wgsl");

/// Reads every input and does next to nothing with it.
const INPUTS_ALONE: &str = "
fn threshold(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>) -> f32 {
    return dot(position, dpdx) + dpdy.x + dpdy.y + dpdy.z;
}
";

fn subjects() -> [(&'static str, String); 5] {
    let integer = Pipeline::listing(Variant::Isotropic).with_hash(HashKind::Mm4);
    let text = |pipeline: Pipeline| assemble(pipeline).expect("a hash scale of 1 can be written");
    [
        ("inputs alone", INPUTS_ALONE.to_owned()),
        ("listing 1, sine", text(Pipeline::listing(Variant::Isotropic))),
        ("listing 1, mm4", text(integer)),
        ("robust isotropic", text(Pipeline::robust(Variant::Isotropic))),
        ("robust anisotropic", text(Pipeline::robust(Variant::Anisotropic))),
    ]
}

fn program(device: &Device, source: &str) -> Result<Program, Error> {
    let source = format!("{source}{FOOTPRINT}");
    device.compile(&Kernel::of_drawn_words(&source, 1, "array(bitcast<u32>(drawn_threshold()))"))
}

/// The time of so many runs: that of the device's clock, or that of a wall clock where it has none.
fn time(program: &Program, runs: u64) -> Result<Duration, Error> {
    let mut sum = Duration::ZERO;
    for run in 0..runs {
        let start = Instant::now();
        let drawn = program.draw(run as u32, THRESHOLDS)?;
        sum += drawn.time.unwrap_or_else(|| start.elapsed());
    }
    Ok(sum)
}

fn all(criterion: &mut Criterion) {
    let chosen = match Choice::from_environment() {
        Choice::First => adapters().iter().map(Adapter::name).collect(),
        choice => choice.find().map(|adapter| vec![adapter.name()]).unwrap_or_default(),
    };
    if chosen.is_empty() {
        println!("gpu: nothing to measure: {CHOICE_VARIABLE}={:?}", std::env::var(CHOICE_VARIABLE));
        return;
    }
    let mut group = criterion.benchmark_group("gpu");
    group.throughput(Throughput::Elements(u64::from(THRESHOLDS))).sample_size(10);
    for name in chosen {
        let device = match Device::open(&Choice::Name(name.clone())) {
            Ok(device) => device,
            Err(error) => {
                println!("gpu: {name} left out: {error}");
                continue;
            }
        };
        for (subject, source) in subjects() {
            let program = program(&device, &source).expect("an assembled shader compiles");
            group.bench_function(format!("{subject}/{name}"), |bench| {
                bench.iter_custom(|runs| time(&program, runs).expect("the device answers"));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, all);
criterion_main!(benches);
