//! Shaders on every device of this machine.
//!
//! One trial a claim and adapter. An adapter that is not there has one ignored trial that says so; with
//! `HASHED_ALPHA_REQUIRE=gpu` that is a failure. Adapters that are looked for by name are the three software ones that
//! a machine without a GPU can have; any other that is found is tried as well.
//!
//! Vulkan's loader and Mesa read the environment as it was when the process began. The trials therefore run in a child
//! process of this one, with SwiftShader (it comes with Chromium) added to the drivers and Mesa's layers silenced.

#![expect(clippy::print_stdout, reason = "what was measured, for those who ask with --nocapture")]

use glam::{DVec3, Vec3, dvec2};
use hashed_alpha::check::parity::Law;
use hashed_alpha::cost::{Effort, devices};
use hashed_alpha::scene::{Camera, Fragment, Rectangle, Scene};
use hashed_alpha::shader::assemble::assemble;
use hashed_alpha::shader::gpu::adapter::{Adapter, adapters};
use hashed_alpha::shader::gpu::parity::{Class, Report, Stage, expected_difference, stages};
use hashed_alpha::shader::gpu::picture::{self, Pixel};
use hashed_alpha::shader::gpu::program::drawn_word;
use hashed_alpha::shader::gpu::{Choice, Device, Error, Evaluator, Kernel};
use hashed_alpha::shader::own;
use hashed_alpha::threshold::pipeline::Pipeline;
use hashed_alpha::threshold::robust::Robust;
use hashed_alpha::threshold::two_scale::Variant;
use libtest_mimic::{Arguments, Failed, Trial};
use std::path::Path;
use std::process::{Command, ExitCode, Output};
use std::sync::{Arc, OnceLock};
use std::time::Duration;
use std::{env, fs};

/// Set for child processes: `trials`, or one of the two that must have a process of their own.
const ROLE: &str = "HASHED_ALPHA_GPU_TEST_ROLE";

/// Software adapters: what we call them, and a part of the name by which they are found.
const SOFTWARE: [(&str, &str); 3] =
    [("lavapipe", "vulkan llvmpipe"), ("opengl", "gl llvmpipe"), ("swiftshader", "vulkan swiftshader")];

fn main() -> ExitCode {
    match env::var(ROLE).as_deref() {
        Ok("trials") => {
            libtest_mimic::run(&Arguments::from_args(), trials()).exit();
        }
        Ok("endless") => run_endless(),
        Ok("absent") => {
            let error = Device::open(&Choice::First).map(|device| device.name().to_owned());
            fs::write(env::args().nth(1).expect("a file"), format!("{error:?}")).expect("a file to write");
            ExitCode::SUCCESS
        }
        _ => {
            let mut child = Command::new(env::current_exe().expect("this program"));
            child.args(env::args_os().skip(1)).env(ROLE, "trials").env("NODEVICE_SELECT", "1");
            if let Some(driver) = swiftshader() {
                child.env("VK_ADD_DRIVER_FILES", driver);
            }
            let code = child.status().expect("the trials run").code();
            ExitCode::from(code.and_then(|code| u8::try_from(code).ok()).unwrap_or(101))
        }
    }
}

/// Where Chromium keeps the description of its Vulkan driver.
fn swiftshader() -> Option<&'static str> {
    ["/usr/lib/chromium", "/usr/lib/chromium-browser", "/opt/google/chrome"]
        .iter()
        .map(|folder| format!("{folder}/vk_swiftshader_icd.json").leak() as &str)
        .find(|path| Path::new(path).is_file())
}

type Claim = fn(&Device) -> Result<(), Failed>;

const CLAIMS: [(&str, Claim); 8] = [
    ("the_parity_report_names_where_differences_start", report_names_the_start),
    ("outputs_stand_in_the_order_of_inputs_whatever_the_chunk", outputs_stand_in_order),
    ("words_drawn_on_the_device_are_those_drawn_here", drawn_words_agree),
    ("an_invalid_shader_is_an_error_with_its_place", invalid_shaders_are_errors),
    ("writing_nothing_is_told_from_writing_zero", nothing_is_not_zero),
    ("an_assembled_threshold_follows_the_one_in_rust", assembled_thresholds_follow),
    ("a_drawn_picture_has_the_derivatives_of_its_surface", pictures_have_derivatives),
    ("every_effect_has_a_price_by_the_clock_of_the_device", effects_have_prices),
];

fn trials() -> Vec<Trial> {
    let is_required =
        env::var("HASHED_ALPHA_REQUIRE").is_ok_and(|list| list.split(',').any(|item| item == "gpu"));
    let found = adapters();
    let mut trials =
        vec![Trial::test("without_a_driver_the_error_says_what_was_looked_for", absence_is_an_error)];
    trials.push(Trial::test("without_a_driver_trials_are_ignored_with_the_reason", absence_is_ignored));
    for (label, part) in SOFTWARE {
        if found.iter().any(|adapter| has(adapter, part)) {
            trials.extend(trials_of(label, part));
        } else if is_required {
            let missing = Choice::from(part).find().map(|adapter| adapter.name());
            trials.push(Trial::test(format!("{label}::is_there"), move || {
                Err(Failed::from(format!("HASHED_ALPHA_REQUIRE asks for it: {missing:?}")))
            }));
        } else {
            let name = format!("{label} (no adapter with `{part}` in its name)");
            trials.push(Trial::test(name, || Ok(())).with_ignored_flag(true));
        }
    }
    for other in found.iter().filter(|adapter| !SOFTWARE.iter().any(|(_, part)| has(adapter, part))) {
        let name: &str = other.name().leak();
        trials.extend(trials_of(name, name));
    }
    trials
}

fn has(adapter: &Adapter, part: &str) -> bool {
    adapter.name().to_lowercase().contains(&part.to_lowercase())
}

fn trials_of(label: &'static str, part: &'static str) -> Vec<Trial> {
    // One device for all trials that leave it as it was.
    let shared: Arc<OnceLock<Result<Device, Error>>> = Arc::default();
    let device = move || shared.get_or_init(|| Device::open(&Choice::from(part))).clone();
    let mut trials = Vec::new();
    for (name, claim) in CLAIMS {
        let device = device.clone();
        trials.push(Trial::test(format!("{label}::{name}"), move || claim(&device()?)));
    }
    for stage in stages() {
        let device = device.clone();
        let name = format!("{label}::parity::{}", stage.name.replace([' ', ','], "_"));
        trials.push(Trial::test(name, move || has_parity(&device()?, stage)));
    }
    trials.push(Trial::test(format!("{label}::a_lost_device_answers_with_an_error"), move || {
        losing_is_an_error(&Device::open(&Choice::from(part))?)
    }));
    trials.push(Trial::test(format!("{label}::an_endless_shader_ends_with_an_error"), move || {
        endless_ends(part)
    }));
    trials
}

/// Runs this program in another role.
fn in_child(role: &str, argument: &str, environment: &[(&str, &str)]) -> std::io::Result<Output> {
    Command::new(env::current_exe()?).arg(argument).env(ROLE, role).envs(environment.iter().copied()).output()
}

/// No driver is found where these point.
const NOWHERE: [(&str, &str); 4] = [
    ("VK_DRIVER_FILES", "/nonexistent"),
    ("VK_ADD_DRIVER_FILES", ""),
    ("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent"),
    ("HASHED_ALPHA_REQUIRE", ""),
];

fn absence_is_ignored() -> Result<(), Failed> {
    let output = in_child("trials", "no adapter", &NOWHERE)?;
    let said = String::from_utf8_lossy(&output.stdout);
    let lines: Vec<_> = said.lines().filter(|line| line.contains("(no adapter with `")).collect();
    let are_ignored = lines.iter().all(|line| line.trim_end().ends_with("ignored"));
    if !output.status.success() || lines.len() != SOFTWARE.len() || !are_ignored {
        return Err(format!("{output:?}").into());
    }
    Ok(())
}

fn absence_is_an_error() -> Result<(), Failed> {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("error");
    let output = in_child("absent", &file.display().to_string(), &NOWHERE)?;
    let error = fs::read_to_string(&file)?;
    if !output.status.success() || !error.contains("Unavailable") || !output.stderr.is_empty() {
        return Err(format!("{error} {output:?}").into());
    }
    Ok(())
}

fn outputs_stand_in_order(device: &Device) -> Result<(), Failed> {
    let program = device.compile(&Kernel::of_words("", 2, 1, "array(word(0u) * 3u + word(1u))"))?;
    let inputs: Vec<u32> = (0..200_000).collect();
    let expected: Vec<u32> = inputs.chunks(2).map(|pair| pair[0] * 3 + pair[1]).collect();
    for chunk in [1 << 20, 4096, 777] {
        assert!(program.clone().with_chunk(chunk).map(&inputs)? == expected, "chunk {chunk}");
    }
    assert!(program.map(&[])?.is_empty());
    assert!(matches!(program.map(&[1]), Err(Error::Validation(_))));
    // More workgroups than one dimension has, and more bytes than a binding of 128 MiB.
    let wide = device.compile(&Kernel::of_words("", 9, 1, "array(word(8u))"))?;
    let inputs: Vec<u32> = (0..9 * 4_300_000).collect();
    let outputs = wide.map(&inputs)?;
    assert!(outputs.iter().zip(0..).all(|(&word, i)| word == 9 * i + 8) && outputs.len() == 4_300_000);
    Ok(())
}

fn drawn_words_agree(device: &Device) -> Result<(), Failed> {
    let program =
        device.compile(&Kernel::of_drawn_words("", 2, "array(word(0u), word(5u))"))?.with_chunk(3000);
    let drawn = program.draw(7, 10_000)?;
    for (index, words) in drawn.words.chunks(2).enumerate() {
        assert_eq!(words, [drawn_word(7, index as u32, 0), drawn_word(7, index as u32, 5)]);
    }
    assert_ne!(drawn, program.draw(8, 10_000)?);
    assert_eq!(drawn.time.is_some(), device.has_timestamps());
    Ok(())
}

fn invalid_shaders_are_errors(device: &Device) -> Result<(), Failed> {
    for (source, what) in [
        ("fn twice(x: u32) -> u32 {\n    return gloss;\n}", "wgsl:2:12"),
        ("fn twice(x: u32) -> f32 { return x; }", "twice"),
    ] {
        let error = device.compile(&Kernel::of_words(source, 1, 1, "array(twice(word(0u)))")).err();
        let Some(Error::Validation(message)) = error else {
            return Err(format!("{error:?}").into());
        };
        assert!(message.contains(what), "{message}");
    }
    // The device is as good as before.
    device.compile(&Kernel::of_words("", 1, 1, "array(word(0u))"))?.map(&[1])?;
    Ok(())
}

fn nothing_is_not_zero(device: &Device) -> Result<(), Failed> {
    let zero = device.compile(&Kernel::of_words("", 1, 1, "array(word(0u) * 0u)"))?;
    assert_eq!(zero.map(&[1, 2, 3])?, [0, 0, 0]);
    let mut kernel = Kernel::of_words("", 1, 1, "array(word(0u))");
    kernel.source = kernel.source.replace("if first >=", "if element == 5u || first >=");
    let program = device.compile(&kernel)?.with_chunk(64);
    assert_eq!(program.map(&[7; 100]), Err(Error::NotWritten(5)));
    Ok(())
}

fn losing_is_an_error(device: &Device) -> Result<(), Failed> {
    let program = device.compile(&Kernel::of_words("", 1, 1, "array(word(0u))"))?;
    assert!(matches!(device.destroy(), Err(Error::Lost(_))));
    assert!(matches!(program.map(&[1]), Err(Error::Lost(_))));
    Ok(())
}

/// In a process of its own: the driver's threads run on until it ends.
fn endless_ends(part: &str) -> Result<(), Failed> {
    let output = in_child("endless", part, &[])?;
    if !output.status.success() {
        return Err(format!("{output:?}").into());
    }
    Ok(())
}

fn run_endless() -> ExitCode {
    let choice = Choice::from(env::args().nth(1).expect("an adapter").as_str());
    let timeout = Duration::from_secs(1);
    // Mesa's software drivers leave a shader's loops after 65,535 turns in all and return what there is; so many
    // elements take a minute all the same.
    let source = "
fn endless(x: u32) -> u32 {
    var y = x;
    loop {
        y = y * 3u + 1u;
        if y == x && x == 1u { break; }
    }
    return y;
}";
    let kernel = Kernel::of_words(source, 1, 1, "array(endless(word(0u)))");
    let result = Device::open_with_timeout(&choice, timeout)
        .and_then(|device| device.compile(&kernel)?.map(&[2; 1 << 20]));
    if result == Err(Error::TimedOut(timeout)) { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn assembled_thresholds_follow(device: &Device) -> Result<(), Failed> {
    let fragments: Vec<Fragment> = Scene::all()
        .into_iter()
        .flat_map(|scene| {
            scene.with_resolution([96, 72]).footprints().map(Fragment::from).collect::<Vec<_>>()
        })
        .collect();
    let options = Pipeline::robust(Variant::Isotropic);
    let shader = Evaluator::new(device, &own::assembled("robust", options)?)?;
    let robust = Robust::new(Variant::Isotropic);
    for (fragment, threshold) in fragments.iter().zip(shader.thresholds(&fragments)?) {
        let expected: f32 = robust.threshold(&fragment.footprint.cast())?;
        // The slope of the threshold over the lerp factor is at most 2, and log2 is within 2^-21 on [1, 2).
        assert!((threshold - expected).abs() < 1.7e-6, "{fragment:?}: {threshold}, not {expected}");
    }
    Ok(())
}

/// Inputs of a stage; those of its wrong shader are fewer.
const PARITY_INPUTS: [u32; 2] = [1 << 17, 1 << 13];

/// Every effect has a price there.
fn effects_have_prices(device: &Device) -> Result<(), Failed> {
    let prices = devices::prices(device, Effort::Quick, &|| ())?;
    let missing: Vec<_> =
        prices.iter().filter(|price| price.ns_min.is_nan() || price.ns_min <= 0.0).collect();
    if prices.len() < 20 || !missing.is_empty() {
        return Err(format!("{} prices, of which none: {missing:?}", prices.len()).into());
    }
    Ok(())
}

fn has_parity(device: &Device, stage: &Stage) -> Result<(), Failed> {
    let [count, few] = PARITY_INPUTS;
    let right = stage.outputs(device, &stage.kernel()?, count)?;
    let wrong = stage.outputs(device, &stage.wrong_kernel()?, few)?;
    let (is_same, found) = if stage.class == Class::Law {
        assert!(!Law::of(&wrong.device, &wrong.rust)?.holds(), "the wrong shader was not seen");
        let law = Law::of(&right.device, &right.rust)?;
        (law.holds(), format!("{law:?}"))
    } else {
        assert!(stage.agreement(&wrong).violation.is_some(), "the wrong shader was not seen");
        let agreement = stage.agreement(&right);
        if let Some(input) = agreement.violation {
            let words = &right.inputs[input * stage.words[0]..][..stage.words[0]];
            let [device, rust] =
                [&right.device, &right.rust].map(|all| &all[input * stage.words[1]..][..stage.words[1]]);
            return Err(format!("{words:x?}: {device:?}, not {rust:?} as in Rust; {agreement:?}").into());
        }
        (agreement.equal == 1.0, format!("{agreement:?}"))
    };
    match expected_difference(device.name(), stage.name) {
        Some(known) if is_same => Err(format!("no difference any more: {known:?}").into()),
        None if !is_same && (is_listed(device) || stage.class == Class::Law) => {
            Err(format!("a new difference: {found}").into())
        }
        _ => Ok(()),
    }
}

/// Whether the differences of a device are listed.
fn is_listed(device: &Device) -> bool {
    SOFTWARE.iter().any(|(_, part)| device.name().to_lowercase().contains(part))
}

/// Printed with `--nocapture`.
fn report_names_the_start(device: &Device) -> Result<(), Failed> {
    let report = Report::of(device, PARITY_INPUTS[1])?;
    println!("{report}");
    assert_eq!(report.rows.len(), stages().filter(|stage| stage.class != Class::Law).count());
    if is_listed(device) {
        assert_eq!(report.first_difference().map(|row| row.stage), Some("log2"));
    }
    Ok(())
}

/// The greatest error of the device's derivatives in a picture, relative to their length, and the number of pixels that
/// it is of.
fn derivative_error(camera: &Camera, surface: &Rectangle, pixels: &[Pixel]) -> (f64, usize) {
    let (mut worst, mut count) = (0.0_f64, 0);
    for Pixel { place, footprint, .. } in pixels {
        // The difference between two pixels is the derivative half-way; the two are those of the pixel's own row or
        // column, or those of the first in its quad.
        let [x, y] = place.map(|place| f64::from(place) + 0.5);
        let [left, top] = place.map(|place| f64::from(place & !1) + 0.5);
        let at = |x, y| surface.footprint(camera, dvec2(x, y));
        let (Some(dx), Some(coarse_dx)) = (at(left + 0.5, y), at(left + 0.5, top)) else { continue };
        let (Some(dy), Some(coarse_dy)) = (at(x, top + 0.5), at(left, top + 0.5)) else { continue };
        let error = |found: Vec3, fine: DVec3, coarse: DVec3| {
            let found = found.as_dvec3();
            (found - fine).length().min((found - coarse).length()) / fine.length()
        };
        let dx_error = error(footprint.dpdx, dx.dpdx, coarse_dx.dpdx);
        let dy_error = error(footprint.dpdy, dy.dpdy, coarse_dy.dpdy);
        worst = worst.max(dx_error).max(dy_error);
        count += 1;
    }
    (worst, count)
}

fn pictures_have_derivatives(device: &Device) -> Result<(), Failed> {
    /// No specification says how exactly a rasteriser interpolates. A thousandth moves the lerp factor by 0.0015 and a
    /// threshold by 0.003.
    const LARGEST_ERROR: f64 = 0.001;
    let options = Pipeline::robust(Variant::Isotropic);
    let source = assemble(options)?;
    let robust = Robust::new(Variant::Isotropic);
    let follows = |pixel: &Pixel| {
        robust.threshold(&pixel.footprint).is_ok_and(|threshold| (pixel.threshold - threshold).abs() < 4.1e-6)
    };
    for scene in Scene::all() {
        let (camera, surface) = (&scene.camera, &scene.surfaces[0]);
        let mut pixels = picture::draw(device, &source, camera, surface)?;
        let (error, count) = derivative_error(camera, surface, &pixels);
        println!("{}: {}: {count} pixels, relative error {error:.1e}", device.name(), scene.name);
        assert!(error < LARGEST_ERROR, "{}: {error}", scene.name);
        let seen = Scene { surfaces: vec![*surface], ..scene.clone() }.footprints().count();
        assert!(count.abs_diff(seen) < seen / 100, "{}: {count} of {seen} pixels", scene.name);
        let astray = pixels.iter().find(|pixel| !follows(pixel));
        assert_eq!(astray, None, "{}", scene.name);
        // A hundredth more, and it is seen.
        pixels.iter_mut().for_each(|pixel| pixel.footprint.dpdx *= 1.01);
        assert!(derivative_error(camera, surface, &pixels).0 > LARGEST_ERROR, "{}", scene.name);
    }
    let wall = &Scene::all()[0];
    let wrong = source.replace("scaled - whole >= boundary", "scaled - whole > 1.0 - boundary");
    let pixels = picture::draw(device, &wrong, &wall.camera, &wall.surfaces[0])?;
    assert!(pixels.iter().any(|pixel| !follows(pixel)), "the wrong shader was not seen");
    Ok(())
}
