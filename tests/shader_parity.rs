//! The assembled WGSL against its Rust twins, on the interpreter: which are the same bits, and how far the others are
//! apart.

use core::num::{NonZeroU16, NonZeroU32};
use hashed_alpha::scene::fragment::Fragment;
use hashed_alpha::shader::assemble::{
    Coverage, FadeIn, ScreenDoor, ShaderOptions, Source, Strata, Stratify, assemble,
};
use hashed_alpha::shader::beside;
use hashed_alpha::shader::export::{self, export};
use hashed_alpha::shader::interpreter::DeviceModel;
use hashed_alpha::shader::own::{self, OwnShader};
use hashed_alpha::technique::conservative;
use hashed_alpha::technique::foveated::Gaze;
use hashed_alpha::technique::occlusion::cosine_direction;
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::integer::pcg4d;
use hashed_alpha::threshold::hash::{HashKind, open_lattice};
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::robust::{Join, Repairs, Robust};
use hashed_alpha::threshold::stage::stipple::{self, Density};
use hashed_alpha::threshold::stage::{coverage, fade_in, mask, order::Order, screen_door, stratify};
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

fn read(options: &ShaderOptions, settings: &[(&str, &str)]) -> OwnShader {
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
    let mut fragments = fragments(4000);
    fragments.extend(degenerate());
    for form in CdfForm::ALL {
        for variant in Variant::ALL {
            for hash in HashKind::ALL {
                for hash_scale in [1.0, 0.3] {
                    let options = ShaderOptions {
                        hash,
                        source: Source::Listing(form),
                        hash_scale: Some(hash_scale),
                        ..ShaderOptions::listing(variant)
                    };
                    let found = run(&read(&options, &[]), &fragments);
                    let twin = HashedAlpha { variant, hash, hash_scale: f64::from(hash_scale), form };
                    for (fragment, found) in fragments.iter().zip(found) {
                        let wanted: f32 = twin.threshold(&fragment.footprint.cast());
                        assert!(same(found, wanted), "{options:?}\n{fragment:?}\n{found} {wanted}");
                    }
                }
            }
        }
    }
}

fn robust_twin(options: &ShaderOptions, fragments: &[Fragment]) -> Vec<f32> {
    let Source::Robust(join) = options.source else { panic!("{options:?}") };
    let twin = Robust {
        variant: options.variant,
        hash: options.hash,
        hash_scale: options.hash_scale.map_or(1.0, f64::from),
        join,
        repairs: Repairs::ALL,
    };
    fragments.iter().map(|fragment| twin.threshold(&fragment.footprint.cast()).unwrap_or(0.5)).collect()
}

/// How far a robust threshold may be from its twin.
///
/// Octave, fraction, cells and hashes are the same bits. The copula takes normal quantiles in `f32` in the place of
/// `f64`; the dithered join only compares.
fn bound(join: Join) -> f64 {
    match join {
        Join::Interpolate | Join::Dithered => 0.0,
        Join::Copula => libm::exp2(-20.0),
    }
}

#[test]
fn robust_thresholds_are_those_of_rust() {
    let fragments = fragments(20_000);
    for join in Join::ALL {
        for variant in [Variant::Isotropic, Variant::Anisotropic] {
            for hash in HashKind::ALL {
                let options =
                    ShaderOptions { hash, source: Source::Robust(join), ..ShaderOptions::robust(variant) };
                let found = run(&read(&options, &[]), &fragments);
                let (share, largest) = difference(&found, &robust_twin(&options, &fragments));
                assert!(largest <= bound(join), "{join} {variant} {hash}: {share} differ, by {largest:e}");
            }
        }
    }
}

#[test]
fn degenerate_footprints_have_the_robust_threshold_of_rust() {
    let fragments = degenerate();
    for join in Join::ALL {
        for variant in [Variant::Isotropic, Variant::Anisotropic] {
            let options = ShaderOptions { source: Source::Robust(join), ..ShaderOptions::robust(variant) };
            let found = run(&read(&options, &[]), &fragments);
            assert!(found.iter().all(|&threshold| threshold > 0.0 && threshold <= 1.0));
            let (share, largest) = difference(&found, &robust_twin(&options, &fragments));
            assert!(largest <= bound(join), "{join} {variant}: {share} differ, by {largest:e}");
        }
    }
}

/// The effects in Rust on what the source gave.
fn effects_twin(
    options: &ShaderOptions,
    fragment: &Fragment,
    sample: u32,
    texel: [f32; 2],
    value: f32,
) -> f32 {
    let literal = options.source == Source::Listing(CdfForm::Literal);
    let mut value = value;
    if let Some(Stratify { frames, order }) = options.stratify {
        let n = NonZeroU32::from(frames);
        let frame = fragment.frame % n;
        value = match order {
            Order::Ascending if literal => stratify::stratified_literal(value, frame, n),
            Order::AlternatingLiteral if literal => {
                stratify::stratified_literal(value, stratify::alternating_literal(frame, n), n)
            }
            _ => order.threshold(value, frame, n),
        };
    }
    if let Some(Coverage { samples, strata }) = options.coverage {
        let n = NonZeroU32::from(samples);
        let [x, y] = fragment.pixel.to_array().map(|c| c as u32);
        let frame = options.stratify.map_or(0, |stratify| fragment.frame % NonZeroU32::from(stratify.frames));
        let words = pcg4d([x, y, frame, fragment.layer]);
        let xi = [open_lattice::<f32>(words[1]), open_lattice(words[2])];
        let stratum = match (strata, literal) {
            (Strata::InOrder, _) => sample,
            (Strata::Decorrelated, true) => coverage::decorrelated_literal(xi, sample, n),
            (Strata::Decorrelated, false) => coverage::decorrelated(xi, sample, n),
            (Strata::Shuffled, _) => mask::shuffled(words[3], sample, n),
        };
        value = if literal {
            coverage::jittered_literal(value, stratum, n)
        } else {
            coverage::jittered(value, stratum, n)
        };
    }
    if let Some(FadeIn { full_noise_lod, anisotropy }) = options.fade_in {
        let ratio = match (anisotropy, literal) {
            (false, _) => 1.0,
            (true, true) => fade_in::anisotropy_literal(texel),
            (true, false) => fade_in::anisotropy(texel),
        };
        let lod = fragment.lod as f32 * ratio;
        value = if literal {
            fade_in::fade_in_literal(value, fade_in::blend_literal(lod, full_noise_lod))
        } else {
            fade_in::fade_in(value, fade_in::blend(lod, full_noise_lod))
        };
    }
    value
}

#[test]
fn effects_are_the_same_bits() {
    let fragments = fragments(1000);
    let size = |n| NonZeroU16::new(n).unwrap();
    for source in [Source::Listing(CdfForm::Literal), Source::Listing(CdfForm::Stable)] {
        let plain =
            ShaderOptions { source, hash: HashKind::Mm4, ..ShaderOptions::listing(Variant::Isotropic) };
        let base = run(&read(&plain, &[]), &fragments);
        let orders = if source == Source::Listing(CdfForm::Literal) {
            &[Order::Ascending, Order::AlternatingLiteral][..]
        } else {
            &Order::ALL
        };
        for frames in [1, 2, 7, 8] {
            for order in orders.iter().copied() {
                for (strata, anisotropy) in [
                    (Strata::InOrder, true),
                    (Strata::Decorrelated, false),
                    (Strata::Decorrelated, true),
                    (Strata::Shuffled, false),
                ] {
                    for texel in [[1.0, 1.0], [0.0, 1.0], [0.0, 0.0], [3.0, 0.5], [0.25, 9.0]] {
                        let options = ShaderOptions {
                            stratify: Some(Stratify { frames: size(frames), order }),
                            coverage: Some(Coverage { samples: size(frames + 1), strata }),
                            fade_in: Some(FadeIn { full_noise_lod: 6.0, anisotropy }),
                            ..plain
                        };
                        let sample = u32::from(frames) / 2;
                        let written =
                            [sample.to_string(), format!("{:?}", texel[0]), format!("{:?}", texel[1])];
                        let mut settings = vec![("sample_index", written[0].as_str())];
                        if anisotropy {
                            settings.extend([("texel_dx", &*written[1]), ("texel_dy", &*written[2])]);
                        }
                        let found = run(&read(&options, &settings), &fragments);
                        for ((fragment, &base), found) in fragments.iter().zip(&base).zip(found) {
                            let wanted = effects_twin(&options, fragment, sample, texel, base);
                            assert!(
                                same(found, wanted),
                                "{options:?} {texel:?}\n{fragment:?}\n{found} {wanted}"
                            );
                        }
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
    let plain = ShaderOptions { hash: HashKind::Mm4, ..ShaderOptions::listing(Variant::Isotropic) };
    let base = run(&read(&plain, &[]), &fragments);
    for strata in [Strata::Decorrelated, Strata::Shuffled] {
        let coverage = Some(Coverage { samples: NonZeroU16::new(8).unwrap(), strata });
        let options = ShaderOptions { coverage, ..plain };
        assert!(!options.parameters().iter().any(|parameter| parameter.name == "frame"));
        let found = run(&read(&options, &[("sample_index", "5")]), &fragments);
        for ((fragment, &base), found) in fragments.iter().zip(&base).zip(found) {
            let wanted = effects_twin(&options, fragment, 5, [1.0; 2], base);
            assert!(same(found, wanted), "{options:?}\n{fragment:?}\n{found} {wanted}");
        }
    }
}

#[test]
fn screen_doors_and_stipple_are_the_same_bits() {
    let mut fragments = fragments(1000);
    for (index, fragment) in (0..).zip(&mut fragments) {
        fragment.pixel = glam::dvec2(f64::from(index % 37) + 0.5, f64::from(index / 37) + 0.5);
    }
    let sources =
        [ScreenDoor::Fixed, ScreenDoor::RandomMask(5), ScreenDoor::Randomised].map(Source::ScreenDoor);
    for source in sources.into_iter().chain([Density::High, Density::Low].map(Source::Stipple)) {
        let options = ShaderOptions { source, ..ShaderOptions::listing(Variant::Isotropic) };
        for (fragment, found) in fragments.iter().zip(run(&read(&options, &[]), &fragments)) {
            let pixel = fragment.pixel.to_array().map(|c| c as u32);
            let wanted = match source {
                Source::ScreenDoor(ScreenDoor::RandomMask(seed)) => screen_door::random_mask(pixel, seed),
                Source::ScreenDoor(ScreenDoor::Randomised) => screen_door::randomised(pixel, fragment.layer),
                Source::Stipple(density) => stipple::threshold(density, pixel, 0.5),
                _ => screen_door::fixed(pixel),
            };
            assert!(same(found, wanted), "{source:?} {fragment:?}: {found} {wanted}");
        }
    }
}

#[test]
fn pixel_masks_are_the_same_bits() {
    let fragments = fragments(1000);
    for samples in [1, 3, 8] {
        let samples = NonZeroU16::new(samples).unwrap();
        let options = ShaderOptions {
            source: Source::PixelMask(samples),
            ..ShaderOptions::listing(Variant::Isotropic)
        };
        let sample = u32::from(samples.get()) / 2;
        let written = sample.to_string();
        let found = run(&read(&options, &[("sample_index", &written)]), &fragments);
        for (fragment, found) in fragments.iter().zip(found) {
            let pixel = fragment.pixel.to_array().map(|c| c as u32);
            let wanted = mask::turned(mask::pixel_value(pixel), sample, samples.into());
            assert!(same(found, wanted), "{samples} {fragment:?}: {found} {wanted}");
        }
    }
}

#[test]
fn a_text_with_another_constant_is_seen() {
    let fragments = fragments(1000);
    let options = ShaderOptions { hash: HashKind::Mm4, ..ShaderOptions::listing(Variant::Isotropic) };
    let text = assemble(&options).unwrap().replace("0x85ebca6bu", "0x85ebca6du");
    let shader =
        own::parse("broken", own::Language::Wgsl, text.as_bytes(), &own::Options::default()).unwrap();
    let (share, _) = difference(&run(&shader, &fragments), &run(&read(&options, &[]), &fragments));
    assert!(share > 0.9, "{share}");
}

#[test]
fn a_coefficient_that_is_off_by_a_ten_thousandth_is_seen() {
    let fragments = fragments(1000);
    let options = ShaderOptions::robust(Variant::Anisotropic);
    let text = assemble(&options).unwrap().replace("0.11113527", "0.11123527");
    let shader =
        own::parse("broken", own::Language::Wgsl, text.as_bytes(), &own::Options::default()).unwrap();
    let (_, largest) = difference(&run(&shader, &fragments), &robust_twin(&options, &fragments));
    assert!(largest > bound(Join::Copula), "{largest:e}");
}

/// WGSL, GLSL and SPIR-V that were exported and read back are the same function.
#[test]
fn exports_read_back_are_the_same_bits() {
    let mut fragments = fragments(1000);
    fragments.extend(degenerate());
    for variant in [Variant::Isotropic, Variant::Anisotropic] {
        let joins = Join::ALL
            .map(|join| ShaderOptions { source: Source::Robust(join), ..ShaderOptions::robust(variant) });
        for options in joins.into_iter().chain([ShaderOptions::listing(variant)]) {
            let wanted = run(&read(&options, &[]), &fragments);
            for (language, read_as) in [
                (export::Language::Wgsl, own::Language::Wgsl),
                (export::Language::Glsl, own::Language::Glsl),
                (export::Language::GlslEs, own::Language::Glsl),
                (export::Language::SpirV, own::Language::SpirV),
            ] {
                let bytes = export(&options, language).unwrap();
                let shader = own::parse(language.name(), read_as, &bytes, &own::Options::default()).unwrap();
                let (share, largest) = difference(&run(&shader, &fragments), &wanted);
                assert_eq!(share, 0.0, "{language} {options:?}: {largest}");
            }
        }
    }
}
