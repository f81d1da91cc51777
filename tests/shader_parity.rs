//! The assembled WGSL against its Rust twins, on the interpreter: which are the same bits, and how far the others are
//! apart.

use core::num::NonZeroU32;
use hashed_alpha::scene::fragment::Fragment;
use hashed_alpha::shader::assemble::{ShaderOptions, assemble};
use hashed_alpha::shader::beside;
use hashed_alpha::shader::export::{self, export};
use hashed_alpha::shader::interpreter::DeviceModel;
use hashed_alpha::shader::own::{self, OwnShader};
use hashed_alpha::technique::conservative;
use hashed_alpha::technique::foveated::Gaze;
use hashed_alpha::technique::occlusion::cosine_direction;
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::pipeline::{
    FadeIn, FrameStrata, Inputs, Pipeline, SamplePattern, SampleStrata, ScreenDoor, Source,
};
use hashed_alpha::threshold::robust::{Join, Robust};
use hashed_alpha::threshold::stage::order::Order;
use hashed_alpha::threshold::stage::stipple::Density;
use hashed_alpha::threshold::two_scale::Variant;
use rand::{RngExt, SeedableRng, rngs::Xoshiro256PlusPlus};

/// Positions over eleven octaves, derivatives over sixteen, in general position; values that `f32` holds.
fn fragments(count: usize) -> Vec<Fragment> {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(0x5a17);
    let mut uniform = |low: f32, high: f32| f64::from(rng.random_range(low..high));
    (0..count)
        .map(|i| {
            let size = f64::from(libm::exp2(uniform(-1.0, 10.0)) as f32);
            let derivative = libm::exp2(uniform(-14.0, 2.0));
            let mut vector = |scale: f64| {
                let mut component = || f64::from((uniform(-1.0, 1.0) * scale) as f32);
                glam::DVec3::new(component(), component(), component())
            };
            let footprint =
                Footprint { position: vector(size), dpdx: vector(derivative), dpdy: vector(derivative) };
            Fragment {
                pixel: glam::dvec2(f64::from(i as u32 % 1920) + 0.5, f64::from(i as u32 / 1920) + 0.5),
                lod: f64::from(uniform(-2.0, 9.0) as f32),
                frame: i as u32 * 7 % 64,
                layer: i as u32 % 5,
                ..footprint.into()
            }
        })
        .collect()
}

fn read(options: impl Into<ShaderOptions>, settings: &[(&str, &str)]) -> OwnShader {
    let text = assemble(options).unwrap();
    let settings = settings.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    let own_options = own::Options { settings, ..own::Options::default() };
    own::parse("assembled", own::Language::Wgsl, text.as_bytes(), &own_options).unwrap()
}

fn run(shader: &OwnShader, fragments: &[Fragment]) -> Vec<f32> {
    let program = shader.program().unwrap_or_else(|error| panic!("{error}"));
    shader.thresholds(&program, fragments, &DeviceModel::ACCURATE).unwrap()
}

fn same(a: f32, b: f32) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// The share of thresholds that differ, and the largest difference.
fn difference(found: &[f32], wanted: &[f32]) -> (f64, f64) {
    assert_eq!(found.len(), wanted.len());
    let differ = found.iter().zip(wanted).filter(|&(&a, &b)| !same(a, b)).count();
    let largest =
        found.iter().zip(wanted).map(|(&a, &b)| if same(a, b) { 0.0 } else { f64::from((a - b).abs()) });
    (differ as f64 / found.len() as f64, largest.fold(0.0, f64::max))
}

fn degenerate() -> Vec<Fragment> {
    let values = [0.0, -0.0, 1e-45, 1e-30, 0.25, -3.0, 1e10, 3e38, f32::INFINITY, f32::NAN].map(f64::from);
    let mut fragments = Vec::new();
    for position in values {
        for dpdx in values {
            for dpdy in values {
                let footprint = Footprint {
                    position: glam::dvec3(position, 0.3, position),
                    dpdx: glam::dvec3(dpdx, 0.0, dpdx),
                    dpdy: glam::dvec3(0.0, dpdy, dpdx),
                };
                fragments.push(footprint.into());
            }
        }
    }
    fragments
}

/// The functions beside the threshold, called with the coordinates of the position.
#[test]
fn functions_beside_the_threshold_are_those_of_rust() {
    let fragments = fragments(2000);
    let fraction = |x: f64| x - x.floor();
    let found = |chunk: &str, call: &str| {
        let text = format!(
            "{chunk}fn threshold(position: vec3<f32>) -> f32 {{ let p = abs(position); return {call}; }}"
        );
        let shader =
            own::parse("beside", own::Language::Wgsl, text.as_bytes(), &own::Options::default()).unwrap();
        run(&shader, &fragments)
    };
    let expect = |found: Vec<f32>, wanted: &dyn Fn([f64; 3]) -> f64| {
        for (fragment, found) in fragments.iter().zip(found) {
            let place = fragment.footprint.position.abs().to_array().map(|c| f64::from(c as f32));
            let wanted = wanted(place);
            assert!(
                (f64::from(found) - wanted).abs() <= 4e-6 * (1.0 + wanted.abs()),
                "{place:?}: {found} {wanted}"
            );
        }
    };
    expect(found(beside::CORRECTED, "corrected(p.x, fract(p.y) + 0.001)"), &|[x, y, _]| {
        conservative::corrected(x, fraction(y) + 0.001)
    });
    expect(found(beside::COARSER_BY, "coarser_by(p.xy, vec2<f32>(100.0, 50.0), p.z, 0.05)"), &|[x, y, z]| {
        Gaze { centre: [100.0, 50.0], radius: z, slope: 0.05 }.coarser_by([x, y])
    });
    for (axis, name) in ["x", "y", "z"].iter().enumerate() {
        let call = format!("cosine_direction(fract(p.xy)).{name}");
        expect(found(beside::COSINE_DIRECTION, &call), &|[x, y, _]| {
            cosine_direction([x, y].map(fraction))[axis]
        });
    }
}

#[test]
fn listings_are_the_same_bits() {
    let mut fragments = fragments(28_000 / HashKind::ALL.len());
    fragments.extend(degenerate());
    for form in CdfForm::ALL {
        for variant in Variant::ALL {
            for hash in HashKind::ALL {
                for hash_scale in [1.0, f64::from(0.3_f32)] {
                    let twin = HashedAlpha { variant, hash, hash_scale, form };
                    let found = run(&read(Pipeline::from(twin), &[]), &fragments);
                    for (fragment, found) in fragments.iter().zip(found) {
                        let wanted: f32 = twin.threshold(&fragment.footprint.cast());
                        assert!(same(found, wanted), "{twin:?}\n{fragment:?}\n{found} {wanted}");
                    }
                }
            }
        }
    }
}

fn robust_twin(twin: Robust, fragments: &[Fragment]) -> Vec<f32> {
    fragments.iter().map(|fragment| twin.threshold(&fragment.footprint.cast()).unwrap_or(0.5)).collect()
}

/// Every step is the same bits, those of the copula too.
#[test]
fn robust_thresholds_are_those_of_rust() {
    let fragments = fragments(140_000 / HashKind::ALL.len());
    for join in Join::ALL {
        for variant in [Variant::Isotropic, Variant::Anisotropic] {
            for hash in HashKind::ALL {
                let robust = Robust { hash, join, ..Robust::new(variant) };
                let found = run(&read(Pipeline::from(robust), &[]), &fragments);
                let (share, largest) = difference(&found, &robust_twin(robust, &fragments));
                assert!(share == 0.0, "{join} {variant} {hash}: {share} differ, by {largest:e}");
            }
        }
    }
}

#[test]
fn degenerate_footprints_have_the_robust_threshold_of_rust() {
    let fragments = degenerate();
    for join in Join::ALL {
        for variant in [Variant::Isotropic, Variant::Anisotropic] {
            let robust = Robust { join, ..Robust::new(variant) };
            let found = run(&read(Pipeline::from(robust), &[]), &fragments);
            assert!(found.iter().all(|&threshold| threshold > 0.0 && threshold <= 1.0));
            let (share, largest) = difference(&found, &robust_twin(robust, &fragments));
            assert!(share == 0.0, "{join} {variant}: {share} differ, by {largest:e}");
        }
    }
}

/// What a pipeline reads of a fragment.
fn inputs(fragment: &Fragment, texel: [f32; 2]) -> Inputs<f32> {
    Inputs {
        pixel: fragment.pixel.to_array().map(|c| c as u32),
        frame: fragment.frame,
        layer: fragment.layer,
        lod: fragment.lod as f32,
        texel,
        ..fragment.footprint.cast().into()
    }
}

/// Text and Rust give the same bits of a sample of every fragment.
fn expect_same(pipeline: Pipeline, fragments: &[Fragment], sample: u32, texel: [f32; 2]) {
    let written = [sample.to_string(), format!("{:?}", texel[0]), format!("{:?}", texel[1])];
    let mut settings = Vec::new();
    for (key, value) in ["sample_index", "texel_dx", "texel_dy"].into_iter().zip(&written) {
        if ShaderOptions::from(pipeline).parameters().iter().any(|parameter| parameter.name == key) {
            settings.push((key, value.as_str()));
        }
    }
    for (fragment, found) in fragments.iter().zip(run(&read(pipeline, &settings), fragments)) {
        let wanted = pipeline.threshold(&inputs(fragment, texel), sample, &mut || panic!("a random number"));
        assert!(same(found, wanted), "{pipeline:?} {texel:?}\n{fragment:?}\n{found} {wanted}");
    }
}

#[test]
fn stages_are_the_same_bits() {
    let fragments = fragments(1000);
    let size = |n| NonZeroU32::new(n).unwrap();
    for form in CdfForm::ALL {
        let plain = Pipeline { form, ..Pipeline::listing(Variant::Isotropic).with_hash(HashKind::Mm4) };
        for frames in [1, 2, 7, 8] {
            for order in Order::ALL {
                for (pattern, anisotropy) in [
                    (SamplePattern::Jittered, true),
                    (SamplePattern::Decorrelated, false),
                    (SamplePattern::Decorrelated, true),
                    (SamplePattern::Shuffled, false),
                ] {
                    for texel in [[1.0, 1.0], [0.0, 1.0], [0.0, 0.0], [3.0, 0.5], [0.25, 9.0]] {
                        let pipeline = Pipeline {
                            frame_strata: Some(FrameStrata { frames: size(frames), order }),
                            sample_strata: Some(SampleStrata { samples: size(frames + 1), pattern }),
                            fade_in: Some(FadeIn { anisotropy, ..FadeIn::default() }),
                            ..plain
                        };
                        expect_same(pipeline, &fragments, frames / 2, texel);
                    }
                }
            }
        }
    }
}

/// Eq. 9 hashes the order of the strata: it stays from frame to frame where the threshold does.
#[test]
fn strata_without_frames_are_the_same_bits() {
    let fragments = fragments(1000);
    for pattern in [SamplePattern::Decorrelated, SamplePattern::Shuffled] {
        let strata = SampleStrata { samples: NonZeroU32::new(8).unwrap(), pattern };
        let plain = Pipeline::listing(Variant::Isotropic).with_hash(HashKind::Mm4);
        let pipeline = Pipeline { sample_strata: Some(strata), ..plain };
        let parameters = ShaderOptions::from(pipeline).parameters();
        assert!(!parameters.iter().any(|parameter| parameter.name == "frame"));
        expect_same(pipeline, &fragments, 5, [1.0; 2]);
    }
}

#[test]
fn sources_of_the_pixel_are_the_same_bits() {
    let mut fragments = fragments(1000);
    for (index, fragment) in (0..).zip(&mut fragments) {
        fragment.pixel = glam::dvec2(f64::from(index % 37) + 0.5, f64::from(index / 37) + 0.5);
    }
    let doors =
        [ScreenDoor::Fixed, ScreenDoor::RandomMask(5), ScreenDoor::Randomised].map(Source::ScreenDoor);
    let stipples = Density::ALL.map(|density| Source::Stipple { density, kept: 0.5 });
    for source in doors.into_iter().chain(stipples) {
        expect_same(source.into(), &fragments, 0, [1.0; 2]);
    }
    for pattern in [SamplePattern::Regular, SamplePattern::ByPixel] {
        for samples in [1, 3, 8] {
            let strata = SampleStrata { samples: NonZeroU32::new(samples).unwrap(), pattern };
            let pipeline = Pipeline { sample_strata: Some(strata), ..Pipeline::default() };
            expect_same(pipeline, &fragments, samples / 2, [1.0; 2]);
        }
    }
}

#[test]
fn a_text_with_another_constant_is_seen() {
    let fragments = fragments(1000);
    let pipeline = Pipeline::listing(Variant::Isotropic).with_hash(HashKind::Mm4);
    let text = assemble(pipeline).unwrap().replace("0x85ebca6bu", "0x85ebca6du");
    let shader =
        own::parse("broken", own::Language::Wgsl, text.as_bytes(), &own::Options::default()).unwrap();
    let (share, _) = difference(&run(&shader, &fragments), &run(&read(pipeline, &[]), &fragments));
    assert!(share > 0.9, "{share}");
}

#[test]
fn a_coefficient_that_is_off_by_a_ten_thousandth_is_seen() {
    let fragments = fragments(1000);
    let robust = Robust::new(Variant::Anisotropic);
    let text = assemble(Pipeline::from(robust)).unwrap().replace("- 1.1511043", "- 1.1512194");
    let shader =
        own::parse("broken", own::Language::Wgsl, text.as_bytes(), &own::Options::default()).unwrap();
    let (_, largest) = difference(&run(&shader, &fragments), &robust_twin(robust, &fragments));
    assert!(largest > 1e-5, "{largest:e}");
}

/// WGSL, GLSL and SPIR-V that were exported and read back are the same function.
#[test]
fn exports_read_back_are_the_same_bits() {
    let mut fragments = fragments(1000);
    fragments.extend(degenerate());
    for variant in [Variant::Isotropic, Variant::Anisotropic] {
        let joins = Join::ALL.map(|join| Pipeline::from(Robust { join, ..Robust::new(variant) }));
        for pipeline in joins.into_iter().chain([Pipeline::listing(variant)]) {
            let wanted = run(&read(pipeline, &[]), &fragments);
            for (language, read_as) in [
                (export::Language::Wgsl, own::Language::Wgsl),
                (export::Language::Glsl, own::Language::Glsl),
                (export::Language::GlslEs, own::Language::Glsl),
                (export::Language::SpirV, own::Language::SpirV),
            ] {
                let bytes = export(pipeline, language).unwrap().into_bytes();
                let shader = own::parse(language.name(), read_as, &bytes, &own::Options::default()).unwrap();
                let (share, largest) = difference(&run(&shader, &fragments), &wanted);
                assert_eq!(share, 0.0, "{language} {pipeline:?}: {largest}");
            }
        }
    }
}
