//! One kernel a run, for a count of its instructions: `instructions KERNEL [PERCENT]`, without a kernel the names.
//!
//! Times move with the machine's mood, counts do not. `.ci/instructions` runs this under valgrind, which counts what
//! happens within `measured`, and compares with `benches/instructions.txt`. Valgrind has no AVX-512. PERCENT evaluates so
//! many more values: a change that the comparison must see.

// Its results are what a reader of the terminal wants.
#![allow(clippy::print_stdout)]

mod plain;

use hashed_alpha::threshold::batch::{Batch, Bins, ColumnBuffer, Isa, Lane, Model, Tier};
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::real::{Real, log2_f32, sin_f32};
use hashed_alpha::threshold::robust::{Join, Robust};
use hashed_alpha::threshold::two_scale::Variant;
use std::hint::black_box;
use std::process::ExitCode;

/// Values that a kernel evaluates.
const VALUES: usize = 4096;

/// Keeps a value from being optimised away.
fn see(value: f32) {
    black_box(value);
}

/// What is prepared before the count.
type Kernel = Box<dyn Fn()>;

/// Valgrind counts between the entry into this function and the return from it.
#[inline(never)]
fn measured(kernel: &dyn Fn()) {
    kernel();
}

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next();
    let percent: usize = arguments.next().and_then(|text| text.parse().ok()).unwrap_or(0);
    let count = VALUES + VALUES * percent / 100;
    let Some(name) = name else {
        kernels(0).iter().for_each(|(name, _)| println!("{name}"));
        return ExitCode::SUCCESS;
    };
    match kernels(count).into_iter().find(|(known, _)| *known == name) {
        Some((_, kernel)) => {
            // Loads what is loaded once, and has instruction sets detected.
            kernel();
            measured(&*kernel);
            ExitCode::SUCCESS
        }
        None => ExitCode::FAILURE,
    }
}

fn kernels(count: usize) -> Vec<(String, Kernel)> {
    let listing = |variant, hash| HashedAlpha { variant, hash, hash_scale: 1.0, form: CdfForm::Literal };
    let listing_1 = Model::from(listing(Variant::Isotropic, HashKind::Sine));
    let listing_2 = Model::from(listing(Variant::Anisotropic, HashKind::Sine));
    let robust = Model::from(Robust::new(Variant::Isotropic));
    let copula = Model::from(Robust::new(Variant::Anisotropic));
    let dithered = Model::from(Robust { join: Join::Dithered, ..Robust::new(Variant::Isotropic) });
    let inherit = Model::from(Robust { join: Join::Inherit, ..Robust::new(Variant::Isotropic) });
    let models = [
        ("listing-1", listing_1),
        ("listing-2", listing_2),
        ("robust", robust),
        ("robust-copula", copula),
        ("robust-dithered", dithered),
        ("robust-inherit", inherit),
    ];
    let angles: Vec<f32> = (0..count).map(|i| i as f32 * 37.1 - 7.0e4).collect();
    let scales: Vec<f32> = (0..count).map(|i| 0.01 + i as f32 * 0.37).collect();
    let mut all: Vec<(String, Kernel)> = Vec::new();
    for (name, model) in models {
        all.push((format!("scalar-{name}"), one_by_one(model, count)));
    }
    all.push(("scalar-plain-robust".to_owned(), plainly(count)));
    let (x, of_x) = (angles.clone(), scales.clone());
    all.push(("scalar-sine".to_owned(), Box::new(move || x.iter().for_each(|&x| see(sin_f32(x))))));
    all.push(("scalar-logarithm".to_owned(), Box::new(move || of_x.iter().for_each(|&x| see(log2_f32(x))))));
    for isa in [Isa::Portable, Isa::Avx2] {
        for (name, model) in models {
            let batch = Batch { model, tier: Tier::BitExact, isa };
            all.push((format!("{isa}-{name}"), in_batch::<f32>(batch, count)));
        }
        let wide = Batch { model: listing_1, tier: Tier::BitExact, isa };
        all.push((format!("{isa}-listing-1-f64"), in_batch::<f64>(wide, count)));
        let (x, of_x) = (angles.clone(), scales.clone());
        all.push((format!("{isa}-sine"), over_slice(x, move |x, out| isa.sin(x, out))));
        all.push((format!("{isa}-logarithm"), over_slice(of_x, move |x, out| isa.log2(x, out))));
        let values: Vec<f32> = (0..count).map(|i| i as f32 / count as f32).collect();
        all.push((
            format!("{isa}-bins"),
            Box::new(move || {
                let mut bins = Bins::new(1024);
                bins.add(isa, black_box(&values));
                black_box(&bins);
            }),
        ));
    }
    for tier in [Tier::Fast, Tier::TwoUlp] {
        let batch = Batch { model: listing_1, tier, isa: Isa::Avx2 };
        all.push((format!("avx2-listing-1-{tier}"), in_batch::<f32>(batch, count)));
    }
    let batch = Batch { model: listing_1, tier: Tier::TwoUlp, isa: Isa::Avx2 };
    all.push(("avx2-listing-1-f64-two-ulp".to_owned(), in_batch::<f64>(batch, count)));
    all
}

fn over_slice(x: Vec<f32>, function: impl Fn(&[f32], &mut [f32]) + 'static) -> Kernel {
    Box::new(move || {
        let mut out = vec![0.0; x.len()];
        function(black_box(&x), &mut out);
        black_box(&out);
    })
}

fn footprints<R: Real>(count: usize) -> impl Iterator<Item = Footprint<R>> {
    (0..count).map(|i| {
        let t = i as f64;
        let at: Footprint<f64> = Footprint {
            position: glam::dvec3(0.37 * t - 700.0, 3.0 - 0.011 * t, 0.013 * t),
            dpdx: glam::dvec3(0.1 + 1e-4 * t, -0.03, 0.007),
            dpdy: glam::dvec3(0.02, 0.2 - 7e-6 * t, 0.04),
        };
        at.cast()
    })
}

fn one_by_one(model: Model, count: usize) -> Kernel {
    let footprints: Vec<Footprint<f32>> = footprints(count).collect();
    Box::new(move || footprints.iter().for_each(|footprint| see(model.threshold(footprint))))
}

/// The robust threshold of one scale by hand, which has the bits of the library's.
fn plainly(count: usize) -> Kernel {
    let footprints: Vec<Footprint<f32>> = footprints(count).collect();
    let robust = Robust::new(Variant::Isotropic);
    for footprint in &footprints {
        assert_eq!(Ok(plain::robust(footprint)), robust.threshold(footprint), "{footprint:?}");
    }
    Box::new(move || footprints.iter().for_each(|footprint| see(plain::robust(footprint))))
}

fn in_batch<R: Lane>(batch: Batch, count: usize) -> Kernel {
    let columns: ColumnBuffer<R> = footprints(count).collect();
    Box::new(move || {
        let mut out = vec![R::from_f64(0.0); count];
        batch.thresholds(&columns.columns(), &mut out);
        black_box(&out);
    })
}
