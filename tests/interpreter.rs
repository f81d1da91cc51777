//! The interpreter against the Rust functions that a shader repeats, and against shaders that do not behave.

use hashed_alpha::shader::interpreter::{Column, DeviceModel, Program, Values};
use hashed_alpha::threshold::emulated::{
    Arithmetic, CoarseSine, Emulated, FlushToZero, Fused, Half, ReducedSine, Single,
};
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::{Cell, Hash, HashKind};
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::real::Real;
use hashed_alpha::threshold::two_scale::Variant;
use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};

const LISTINGS: &str = include_str!("shader/listings.wgsl");

fn compile(source: &str, function: &str) -> Program {
    let module =
        naga::front::wgsl::parse_str(source).unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
    let info = naga::valid::Validator::new(Default::default(), Default::default())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
    Program::compile(&module, &info, function).unwrap_or_else(|e| panic!("{}", e.in_source(source)))
}

/// Footprints of every size and direction: positions in [-10, 10]^3, derivatives over 20 octaves.
fn columns(count: usize, seed: u64) -> Vec<Vec<f32>> {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut columns = vec![Vec::new(); 9];
    for _ in 0..count {
        let size = libm::exp2(rng.random_range(-16.0..4.0));
        for (index, column) in columns.iter_mut().enumerate() {
            let value =
                if index < 3 { rng.random_range(-10.0..10.0) } else { rng.random_range(-1.0..1.0) * size };
            column.push(value as f32);
        }
    }
    columns
}

fn footprint<R: Real>(columns: &[Vec<f32>], index: usize) -> Footprint<R> {
    let vector = |first: usize| {
        R::Vec3::from([0, 1, 2].map(|axis| R::from_f64(f64::from(columns[first + axis][index]))))
    };
    Footprint { position: vector(0), dpdx: vector(3), dpdy: vector(6) }
}

fn thresholds(function: &str, columns: &[Vec<f32>], model: &DeviceModel) -> Vec<f32> {
    let program = compile(LISTINGS, function);
    let mut inputs: Vec<_> = columns.iter().map(|column| Column::F32(column)).collect();
    inputs.push(Column::F32(&[1.0]));
    let result = program.run(&inputs, columns[0].len(), model).expect("the listing ends");
    let [Values::F32(values)] = <[Values; 1]>::try_from(result).expect("one scalar") else {
        panic!("a float")
    };
    values
}

/// Same bits, or both NaN: IEEE 754 leaves the bits of a NaN open.
fn same(a: f32, b: f32) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

#[test]
fn both_listings_give_the_bits_of_their_rust_twins() {
    let columns = columns(600_000, 1);
    for (variant, name) in [(Variant::Isotropic, "isotropic"), (Variant::Anisotropic, "anisotropic")] {
        let listing = HashedAlpha::listing(variant);
        let values = thresholds(name, &columns, &DeviceModel::ACCURATE);
        for (index, &value) in values.iter().enumerate() {
            let expected = listing.threshold(&footprint::<f32>(&columns, index));
            assert!(same(value, expected), "{name} {index}: {value} is not {expected}");
        }
    }
}

#[test]
fn every_device_model_gives_the_bits_of_the_emulated_listing() {
    fn agrees<A: Arithmetic>(model: &DeviceModel, columns: &[Vec<f32>]) {
        assert_eq!(model.name(), A::NAME);
        for (variant, name) in [(Variant::Isotropic, "isotropic"), (Variant::Anisotropic, "anisotropic")] {
            let listing = HashedAlpha::listing(variant);
            let values = thresholds(name, columns, model);
            assert!(
                values
                    .iter()
                    .zip(thresholds(name, columns, &DeviceModel::of::<A>()))
                    .all(|(&a, b)| same(a, b))
            );
            for (index, &value) in values.iter().enumerate() {
                let expected = listing.threshold(&footprint::<Emulated<A>>(columns, index)).to_f64() as f32;
                assert!(same(value, expected), "{} {name} {index}: {value} is not {expected}", A::NAME);
            }
        }
    }
    let columns = columns(60_000, 2);
    agrees::<Single>(&DeviceModel::ACCURATE, &columns);
    agrees::<CoarseSine>(&DeviceModel::COARSE_SINE, &columns);
    agrees::<ReducedSine>(&DeviceModel::REDUCED_SINE, &columns);
    agrees::<Half>(&DeviceModel::HALF, &columns);
    agrees::<FlushToZero>(&DeviceModel::FLUSH_TO_ZERO, &columns);
    agrees::<Fused>(&DeviceModel::FUSED, &columns);
}

#[test]
fn device_models_differ_from_the_reference() {
    let columns = columns(2_000, 3);
    let reference = thresholds("isotropic", &columns, &DeviceModel::ACCURATE);
    for model in &DeviceModel::ALL[1..] {
        let values = thresholds("isotropic", &columns, model);
        let different = reference.iter().zip(&values).filter(|(a, b)| !same(**a, **b)).count();
        // Subnormal numbers do not occur here.
        assert_eq!(different == 0, model.name() == "flush to zero", "{}: {different}", model.name());
    }
}

#[test]
fn integer_hashes_give_the_bits_of_their_rust_twins() {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(4);
    let count = 600_000;
    let mut coordinate =
        || -> Vec<f32> { (0..count).map(|_| f32::floor(rng.random_range(-1.0e6_f32..1.0e6))).collect() };
    let cell = [coordinate(), coordinate(), coordinate()];
    let octaves: Vec<i32> = (0..count).map(|_| rng.random_range(-30..30)).collect();
    let kinds = [(HashKind::Mm4, "mm4"), (HashKind::Xxhash32, "xxhash32"), (HashKind::Pcg3d, "pcg3d")];
    for (kind, name) in kinds {
        let [x, y, z] = &cell;
        let columns = [Column::F32(x), Column::F32(y), Column::F32(z), Column::I32(&octaves)];
        let result = compile(LISTINGS, name).run(&columns, count, &DeviceModel::ACCURATE).expect("it ends");
        let Values::F32(values) = &result[0] else { panic!("a float") };
        for (i, value) in values.iter().enumerate() {
            let cell = Cell { index: glam::vec3(x[i], y[i], z[i]), octave: octaves[i] as u32 };
            let expected: f32 = kind.hash(&cell);
            assert_eq!(value.to_bits(), expected.to_bits(), "{name} {cell:?}");
        }
    }
}
