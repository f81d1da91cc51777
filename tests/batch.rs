//! The batch has the bits of the scalar path: every model, both precisions, every instruction set of the machine.

use crate::budget::budget;
use hashed_alpha::threshold::batch::{BLOCK, Batch, Bins, CHUNK, ColumnBuffer, Isa, Lane, Model, Tier};
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::{Cell, Hash, HashKind};
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::real::sin_f32;
use hashed_alpha::threshold::robust::{Join, Repair, Repairs, Robust};
use hashed_alpha::threshold::two_scale::Variant;
use rand::{RngExt, SeedableRng, rngs::Xoshiro256PlusPlus};
use rayon::prelude::*;

/// Positions and derivatives as scenes have them.
#[derive(Clone, Copy)]
struct Range {
    /// Positions lie in a cube of twice this side about the origin.
    extent: f64,
    /// Derivatives are of the order of two to the power of a number in this range.
    log_derivative: [f64; 2],
}

/// Indices of cells up to 4e4, sines of up to 6e5.
const WIDE: Range = Range { extent: 10.0, log_derivative: [-12.0, -4.0] };
/// Indices of cells up to 512.
const SMALL: Range = Range { extent: 1.0, log_derivative: [-8.0, -4.0] };
/// Derivatives above one object unit, where the linear variant has two scales.
const COARSE: Range = Range { extent: 1000.0, log_derivative: [0.0, 6.0] };

fn random<R: Lane>(range: Range, seed: u64, count: usize) -> Vec<Footprint<R>> {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut vector = |extent: f64| {
        let mut component = || R::from_f64(random.random_range(-extent..extent));
        R::Vec3::from([component(), component(), component()])
    };
    let mut scales = Xoshiro256PlusPlus::seed_from_u64(!seed);
    let [low, high] = range.log_derivative;
    (0..count)
        .map(|_| {
            let scale = libm::exp2(scales.random_range(low..high));
            Footprint { position: vector(range.extent), dpdx: vector(scale), dpdy: vector(scale) }
        })
        .collect()
}

/// Footprints of which one component, or a whole derivative, is a number that the listings stumble over.
fn degenerate<R: Lane>() -> Vec<Footprint<R>> {
    const BAD: [f64; 19] = [
        0.0,
        -0.0,
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        1e-310,
        1e-45,
        1e-39,
        1e-30,
        -1e-15,
        1e9,
        -1e20,
        1e30,
        3e38,
        1e300,
        0.25,
        0.5,
        -1.0,
        4_194_304.0,
    ];
    let ordinary = random::<R>(WIDE, 1, 9);
    let mut all = Vec::new();
    for bad in BAD.map(R::from_f64) {
        for (component, footprint) in ordinary.iter().enumerate() {
            let [mut position, mut dpdx, mut dpdy]: [[R; 3]; 3] =
                [footprint.position.into(), footprint.dpdx.into(), footprint.dpdy.into()];
            [&mut position, &mut dpdx, &mut dpdy][component / 3][component % 3] = bad;
            all.push(Footprint { position: position.into(), dpdx: dpdx.into(), dpdy: dpdy.into() });
        }
        let zero = R::from_f64(0.0);
        let along = |vector: [R; 3]| Footprint { dpdx: vector.into(), dpdy: [zero; 3].into(), ..ordinary[0] };
        all.extend([along([bad; 3]), along([bad, zero, zero])]);
        all.push(Footprint { position: [bad; 3].into(), dpdx: [bad; 3].into(), dpdy: [bad; 3].into() });
    }
    all
}

/// Footprints of nothing but random bits.
fn arbitrary(seed: u64, count: usize) -> Vec<Footprint<f32>> {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut vector = || glam::Vec3::from([0; 3].map(|_| f32::from_bits(random.random())));
    (0..count).map(|_| Footprint { position: vector(), dpdx: vector(), dpdy: vector() }).collect()
}

/// A loop over blocks knows of a hash only what it is; so many hashes share what can be chosen beside it.
const TURNS: usize = 3;

/// Every variant, form, join and repair that can be chosen, each with every third hash in turn, and hash scales that mean
/// nothing.
fn models() -> Vec<Model> {
    let of_hash = |hash: HashKind| {
        let mut models = Vec::new();
        for variant in Variant::ALL {
            for form in CdfForm::ALL {
                for hash_scale in [1.0, 0.3] {
                    let hashed = HashedAlpha { variant, hash, hash_scale, form };
                    models.extend([Model::Hashed(hashed), Model::BeforeCdf(hashed)]);
                }
            }
            for join in Join::ALL {
                let robust = |hash_scale, repairs| Robust { variant, hash, hash_scale, join, repairs };
                models.extend([robust(1.3, Repairs::ALL), robust(1.0, Repairs::NONE)].map(Model::from));
                models
                    .extend(Repair::ALL.map(|repair| Model::from(robust(1.0, Repairs::ALL.without(repair)))));
            }
        }
        models
    };
    let in_turn = |(number, hash)| of_hash(hash).into_iter().skip(number % TURNS).step_by(TURNS);
    let mut models: Vec<Model> = HashKind::ALL.into_iter().enumerate().flat_map(in_turn).collect();
    for hash_scale in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-30, 1e30] {
        for variant in [Variant::Isotropic, Variant::Anisotropic] {
            models.push(HashedAlpha { hash_scale, ..sine(variant) }.into());
            let robust = Robust { hash_scale, ..Robust::new(variant) };
            let unchecked = Robust { repairs: Repairs::ALL.without(Repair::ValidateInputs), ..robust };
            models.extend([robust, unchecked].map(Model::from));
        }
    }
    models
}

/// A listing to the letter.
fn sine(variant: Variant) -> HashedAlpha {
    HashedAlpha { variant, hash: HashKind::Sine, hash_scale: 1.0, form: CdfForm::Literal }
}

/// The hash of cells alone is that of the scalar path, in every bit.
#[test]
fn cells_have_the_hash_of_the_scalar_path() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(5);
    let count = 3 * BLOCK + 7;
    let axes = [0; 3].map(|_| (0..count).map(|_| random.random_range(-40_000_i32..40_000) as f32).collect());
    let [x, y, z]: [Vec<f32>; 3] = axes;
    let word: Vec<u32> = (0..count as u32).collect();
    for hash in HashKind::ALL {
        for isa in Isa::available() {
            let mut values = vec![0.0; count];
            isa.hash(hash, Tier::BitExact, [&x, &y, &z], &word, &mut values);
            for i in 0..count {
                let cell = Cell { index: glam::vec3(x[i], y[i], z[i]), octave: word[i] };
                let expected: f32 = hash.hash(&cell);
                assert_eq!(values[i].to_bits(), expected.to_bits(), "{hash} on {isa}");
            }
        }
    }
}

#[test]
fn the_sine_of_every_tier_has_the_same_bits_on_every_isa() {
    let x: Vec<f32> = (0..1000).map(|i| i as f32 * 37.21 - 20_000.0).collect();
    let on = |isa: Isa, tier| {
        let mut values = vec![0.0; x.len()];
        isa.sin_of(tier, &x, &mut values);
        values
    };
    for tier in Tier::ALL {
        for isa in Isa::available() {
            assert_eq!(on(isa, tier), on(Isa::Portable, tier), "{tier} on {isa}");
        }
        let errors = x.iter().zip(on(Isa::Portable, tier)).map(|(x, sine)| (sine - sin_f32(*x)).abs());
        let worst = errors.fold(0.0, f32::max);
        assert_eq!(worst == 0.0, tier == Tier::BitExact, "{tier}: {worst}");
        assert_eq!(worst > 1e-6, tier == Tier::Coarse, "{tier}: {worst}");
    }
}

fn bits<R: Lane>(value: R) -> u64 {
    if value.is_nan() { f64::NAN.to_bits() } else { value.to_f64().to_bits() }
}

/// Returns the first footprint whose threshold in a batch differs from that of the scalar path.
fn first_difference<R: Lane>(batch: Batch, footprints: &[Footprint<R>]) -> Option<String> {
    let columns: ColumnBuffer<R> = footprints.iter().copied().collect();
    let mut thresholds = vec![R::from_f64(-1.0); footprints.len()];
    batch.thresholds(&columns.columns(), &mut thresholds);
    footprints.iter().zip(thresholds).find_map(|(footprint, threshold)| {
        let expected = batch.model.threshold(footprint);
        (bits(expected) != bits(threshold))
            .then(|| format!("{batch:?} gives {threshold:?}, not {expected:?}, for {footprint:?}"))
    })
}

/// Asserts equal bits on every instruction set.
fn has_the_bits_of_the_scalar_path<R: Lane>(model: Model, footprints: &[Footprint<R>]) {
    for isa in Isa::available() {
        assert_eq!(first_difference(Batch { isa, ..Batch::new(model) }, footprints), None);
    }
}

fn every_model_on_every_isa<R: Lane>() {
    let mut footprints = degenerate::<R>();
    let count = budget().pick(100, 500, 5000);
    for (seed, range) in [WIDE, SMALL, COARSE].into_iter().enumerate() {
        footprints.extend(random::<R>(range, seed as u64, count));
    }
    models().into_par_iter().for_each(|model| has_the_bits_of_the_scalar_path(model, &footprints));
}

#[test]
fn every_model_has_the_bits_of_the_scalar_path_in_f32() {
    every_model_on_every_isa::<f32>();
}

#[test]
fn every_model_has_the_bits_of_the_scalar_path_in_f64() {
    every_model_on_every_isa::<f64>();
}

/// Every variant, hash and join: 2^22 footprints in CI, 2^25 in the nights.
#[test]
fn not_one_bit_differs_in_many_random_thresholds() {
    const TASK: usize = (1 << 17) / HashKind::ALL.len();
    let tasks = budget().pick(1, 1 << 2, 1 << 5);
    let of_hash = |hash: HashKind| {
        let listings = Variant::ALL.map(|variant| Model::from(HashedAlpha { hash, ..sine(variant) }));
        let robust = [Variant::Isotropic, Variant::Anisotropic].into_iter().flat_map(move |variant| {
            Join::ALL.map(|join| Model::from(Robust { hash, join, ..Robust::new(variant) }))
        });
        listings.into_iter().chain(robust)
    };
    let models: Vec<Model> = HashKind::ALL.into_iter().flat_map(of_hash).collect();
    (0..tasks as u64).into_par_iter().for_each(|task| {
        let range = if task % 2 == 0 { WIDE } else { SMALL };
        for (number, &model) in (0..).zip(&models) {
            let seed = task + (number << 32);
            has_the_bits_of_the_scalar_path(model, &random::<f32>(range, seed, TASK));
            has_the_bits_of_the_scalar_path(model, &random::<f64>(range, seed, TASK / 64));
        }
    });
}

#[test]
fn random_bits_have_the_threshold_of_the_scalar_path() {
    let footprints = arbitrary(0, budget().pick(1 << 10, 1 << 14, 1 << 20));
    for variant in [Variant::Isotropic, Variant::Anisotropic] {
        has_the_bits_of_the_scalar_path(Robust::new(variant).into(), &footprints);
        has_the_bits_of_the_scalar_path(sine(variant).into(), &footprints);
    }
}

#[test]
fn the_comparison_sees_a_sine_that_is_two_digits_off() {
    let footprints = random::<f32>(SMALL, 0, 1000);
    for tier in [Tier::Fast, Tier::TwoUlp] {
        let batch = Batch { tier, ..Batch::new(sine(Variant::Isotropic)) };
        assert!(first_difference(batch, &footprints).is_some(), "{tier}");
    }
}

#[test]
fn any_number_of_footprints_is_evaluated() {
    let footprints = random::<f32>(WIDE, 0, 3 * BLOCK + 1);
    for count in [0, 1, 2, 15, 17, BLOCK - 1, BLOCK, BLOCK + 1, 2 * BLOCK + 77, 3 * BLOCK + 1] {
        for variant in Variant::ALL {
            has_the_bits_of_the_scalar_path(sine(variant).into(), &footprints[..count]);
        }
    }
}

fn thresholds(batch: Batch, footprints: &[Footprint<f32>]) -> Vec<f32> {
    let columns: ColumnBuffer<f32> = footprints.iter().copied().collect();
    let mut thresholds = vec![0.0; footprints.len()];
    batch.thresholds(&columns.columns(), &mut thresholds);
    thresholds
}

#[test]
fn every_tier_has_the_same_bits_on_every_isa() {
    let footprints = random::<f32>(WIDE, 0, budget().pick(1 << 10, 1 << 14, 1 << 18));
    for tier in Tier::ALL {
        for model in [Model::from(sine(Variant::Isotropic)), Robust::new(Variant::Anisotropic).into()] {
            let on = |isa| thresholds(Batch { tier, isa, ..Batch::new(model) }, &footprints);
            let portable = on(Isa::Portable).into_iter().map(f32::to_bits).collect::<Vec<_>>();
            for isa in Isa::available() {
                assert!(
                    on(isa).into_iter().map(f32::to_bits).eq(portable.iter().copied()),
                    "{tier} on {isa}"
                );
            }
        }
    }
}

#[test]
fn without_a_sine_the_fast_tiers_are_as_good_as_their_logarithm() {
    let footprints = random::<f32>(WIDE, 0, 1 << 14);
    let robust = Batch::new(Robust::new(Variant::Isotropic));
    let exact = thresholds(robust, &footprints);
    for tier in [Tier::Fast, Tier::TwoUlp] {
        // The threshold changes by at most twice the change of the weight, which is off by 2^-23 and its own rounding.
        let worst = thresholds(Batch { tier, ..robust }, &footprints)
            .into_iter()
            .zip(&exact)
            .map(|(fast, exact)| (fast - exact).abs())
            .fold(0.0, f32::max);
        assert!(worst > 0.0 && worst < 2.0 / 4_194_304.0, "{tier}: {worst:e}");
    }
}

/// Footprints out of their number alone.
fn numbered(first: u64, columns: &mut ColumnBuffer<f32>) {
    for i in 0..columns.position[0].len() {
        let number = first + i as u64;
        let place = |prime: u64| (number.wrapping_mul(prime) % 65_536) as f32 / 1024.0;
        columns.set(
            i,
            &Footprint {
                position: glam::vec3(place(40_503), place(30_011), place(12_289)),
                dpdx: glam::vec3(0.01, 0.002, 0.0),
                dpdy: glam::vec3(0.0, 0.02, 0.01),
            },
        );
    }
}

fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool").install(work)
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let batch = Batch::new(sine(Variant::Isotropic));
    let footprints = random::<f32>(WIDE, 3, 5 * CHUNK + 99);
    let columns: ColumnBuffer<f32> = footprints.iter().copied().collect();
    let alone = thresholds(batch, &footprints);
    for threads in [1, 2, 3] {
        let mut values = vec![0.0; footprints.len()];
        on_threads(threads, || batch.par_thresholds(&columns.columns(), &mut values));
        assert_eq!(values, alone, "{threads} threads");
    }
}

#[test]
fn a_stream_sees_every_threshold_in_order_whatever_the_number_of_threads() {
    let batch = Batch::new(Robust::new(Variant::Isotropic));
    // Several tasks, and a last chunk that is not full.
    let count = 3 * (1 << 18) + 5 * CHUNK + 77;
    let mut buffer = ColumnBuffer::zeroed(count);
    numbered(0, &mut buffer);
    let mut expected = vec![0.0; count];
    batch.thresholds(&buffer.columns(), &mut expected);
    for threads in [1, 2] {
        let streamed: Vec<f32> = on_threads(threads, || {
            batch.stream(
                count as u64,
                numbered,
                Vec::new,
                |seen, thresholds| seen.extend_from_slice(thresholds),
                |earlier, later| earlier.extend(later),
            )
        });
        assert_eq!(streamed, expected, "{threads} threads");
    }
}

#[test]
fn a_stream_counts_as_one_histogram_would() {
    let batch = Batch::new(Robust::new(Variant::Anisotropic));
    let count = 2 * (1 << 18) + 1;
    let streamed = batch.stream(
        count,
        numbered,
        || Bins::new(1 << 10),
        |bins, thresholds| bins.add(batch.isa, thresholds),
        |earlier, later| earlier.merge(&later),
    );
    let mut buffer = ColumnBuffer::zeroed(count as usize);
    numbered(0, &mut buffer);
    let mut values = vec![0.0; count as usize];
    batch.par_thresholds(&buffer.columns(), &mut values);
    let mut bins = Bins::new(1 << 10);
    bins.add(Isa::Portable, &values);
    assert_eq!(streamed, bins);
    assert_eq!(bins.counts().iter().sum::<u64>() + bins.outside(), count);
}

#[test]
fn columns_know_how_many_footprints_they_hold() {
    let (none, some) = (ColumnBuffer::<f32>::zeroed(0), ColumnBuffer::<f64>::zeroed(3));
    assert!(none.columns().is_empty() && !some.columns().is_empty());
    assert_eq!([none.columns().len(), some.columns().len()], [0, 3]);
}
