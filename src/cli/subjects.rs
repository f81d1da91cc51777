//! What a typed subject means: a listing, the robust threshold or a shader file, and where it runs.

use super::args::{On, ShaderArgs};
use super::failure::Failure;
use super::output;
use super::shader_files::ShaderFile;
use hashed_alpha::check::shaders;
use hashed_alpha::check::{Subject, subject::Precision};
use hashed_alpha::scene::{Fragment, Scene};
use hashed_alpha::shader::interpreter::DeviceModel;
use hashed_alpha::shader::own::{self, OwnShader};
use hashed_alpha::threshold::pipeline::Pipeline;
use hashed_alpha::threshold::robust::{Join, Robust};
use hashed_alpha::threshold::two_scale::Variant;
use std::path::Path;

/// Returns the subjects that were typed, each once: built-in ones by their name or its part before a colon, `gpu:` before it
/// for a device and `cpu:` for what has no prefix; files by their name.
pub fn subjects(typed: &[String], args: &ShaderArgs) -> Result<Vec<Subject<'static>>, Failure> {
    let mut found: Vec<Subject<'static>> = Vec::new();
    for word in typed {
        let more = ShaderFile::of(word).map_or_else(|| built_in(word, args), |typed| file(&typed, args))?;
        for subject in more {
            if !found.iter().any(|other| other.name == subject.name && other.precision == subject.precision) {
                found.push(subject);
            }
        }
    }
    Ok(found)
}

/// Whether a subject is one of this program's own, in Rust.
pub fn is_in_rust(word: &str, on: On) -> bool {
    let runs_here = match word.split_once(':') {
        Some(("gpu", _)) => false,
        Some(("cpu", _)) => true,
        _ => matches!(on, On::Auto | On::Cpu),
    };
    runs_here && ShaderFile::of(word).is_none()
}

fn built_in(word: &str, args: &ShaderArgs) -> Result<Vec<Subject<'static>>, Failure> {
    let (on, name) = match word.split_once(':') {
        Some(("gpu", name)) => (On::Gpu, name),
        Some(("cpu", name)) => (On::Cpu, name),
        _ => (args.on, word),
    };
    let mut all = Subject::paper();
    all.extend(Subject::all_repairs());
    all.retain(|subject| {
        subject.name.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with(':'))
    });
    if all.is_empty() {
        return Err(Failure::Usage(format!(
            "unknown subject `{word}`; known are paper:isotropic, paper:anisotropic, robust:isotropic, \
             robust:anisotropic, each with gpu: before it too, and files that end in .wgsl, .glsl, .frag, .vert, .comp, .fs, .vs or .spv"
        )));
    }
    if matches!(on, On::Auto | On::Cpu) {
        return Ok(all);
    }
    all.retain(|subject| subject.precision == Precision::F32);
    let mut found = Vec::new();
    for twin in all {
        let literal = twin.name.starts_with("paper");
        let pipeline = if literal { Pipeline::listing } else { Pipeline::robust }(twin.variant);
        let shader = own::assembled(&twin.name, pipeline)?;
        let claims = Claimed {
            variant: twin.variant,
            join: twin.join,
            nested_phase: twin.nested_phase,
            hash_scale: 1.0,
            frames: 1,
        };
        found.extend(placed(&twin.name, &shader, on, args, &claims)?);
    }
    Ok(found)
}

/// What a shader claims of itself.
struct Claimed {
    variant: Variant,
    join: Join,
    nested_phase: bool,
    hash_scale: f64,
    frames: u32,
}

fn file(typed: &ShaderFile<'_>, args: &ShaderArgs) -> Result<Vec<Subject<'static>>, Failure> {
    let options = typed.options(args)?;
    let set = || options.settings.get("hash_scale").and_then(|value| value.parse().ok());
    let hash_scale = args.hash_scale.or_else(set).unwrap_or(1.0);
    let shader = own::read(Path::new(typed.path), &options)?;
    let preset = Robust::new(args.variant).join;
    let claims = Claimed {
        variant: args.variant,
        join: args.join.unwrap_or(if args.nested_phase { preset } else { Join::Interpolate }),
        nested_phase: args.nested_phase,
        hash_scale,
        frames: args.frames,
    };
    let name = typed.name();
    let remarks = stops(&shader, args.variant)?;
    let subjects = placed(&name, &shader, args.on, args, &claims)?;
    if subjects.iter().any(|subject| subject.name.starts_with("gpu:")) {
        // A device does not tell.
        remarks.iter().for_each(|remark| output::remark("note", remark));
    }
    Ok(subjects)
}

/// Runs a few fragments in the interpreter: an endless loop comes to light there, before the first claim; drivers hang on
/// it or leave it without a word. Returns what else comes to light.
fn stops(shader: &OwnShader, variant: Variant) -> Result<Vec<String>, Failure> {
    // What is not interpreted may still run on a device.
    let Ok(subject) = shaders::interpreted("", shader, DeviceModel::ACCURATE, variant) else {
        return Ok(Vec::new());
    };
    let few: Vec<Fragment> = Scene::all()[0].footprints().step_by(4099).map(Fragment::from).collect();
    let _ = subject.thresholds(&few);
    subject.failure().map_or_else(|| Ok(subject.remarks()), |reason| Err(Failure::Usage(reason.to_owned())))
}

/// Puts a shader where it is wanted.
fn placed(
    name: &str,
    shader: &OwnShader,
    on: On,
    args: &ShaderArgs,
    claims: &Claimed,
) -> Result<Vec<Subject<'static>>, Failure> {
    let interpreted = |name: String, model| {
        shaders::interpreted(name, shader, model, claims.variant).map_err(Failure::from)
    };
    let mut subjects = match on {
        On::Cpu => vec![interpreted(name.to_owned(), DeviceModel::ACCURATE)?],
        On::DeviceModel => DeviceModel::ALL
            .into_iter()
            .map(|model| interpreted(format!("{}:{name}", model.name()), model))
            .collect::<Result<_, _>>()?,
        On::Gpu => vec![on_device(name, shader, args, claims.variant)?],
        On::Auto => {
            let refused = match on_device(name, shader, args, claims.variant) {
                Ok(subject) if subject.failure().is_none() => Ok(subject),
                Ok(subject) => Err(subject.failure().unwrap_or_default().to_owned()),
                Err(failure) => Err(failure.message()),
            };
            vec![match refused {
                Ok(subject) => subject,
                Err(reason) => {
                    output::remark("note", format_args!("{name} runs in the interpreter: {reason}"));
                    interpreted(name.to_owned(), DeviceModel::ACCURATE)?
                }
            }]
        }
    };
    for subject in &mut subjects {
        subject.join = claims.join;
        subject.nested_phase = claims.nested_phase;
        subject.hash_scale = claims.hash_scale;
        subject.frames = claims.frames;
    }
    Ok(subjects)
}

/// Puts a shader on the device that is wanted; without one, a subject that says so.
#[cfg(feature = "gpu")]
fn on_device(
    name: &str,
    shader: &OwnShader,
    args: &ShaderArgs,
    variant: Variant,
) -> Result<Subject<'static>, Failure> {
    use hashed_alpha::shader::gpu::{Choice, Device};
    let choice = args.adapter.as_deref().map_or_else(Choice::from_environment, Choice::from);
    let name = format!("gpu:{name}");
    match Device::open(&choice) {
        Ok(device) => {
            let subject = shaders::on_device(name.as_str(), shader, &device, variant)?;
            output::remark("note", format_args!("{name} runs on {}", device.name()));
            Ok(subject)
        }
        Err(error) => Ok(unavailable(name, variant, error.to_string())),
    }
}

#[cfg(not(feature = "gpu"))]
fn on_device(
    name: &str,
    _: &OwnShader,
    _: &ShaderArgs,
    variant: Variant,
) -> Result<Subject<'static>, Failure> {
    let reason = "no GPU: this program was built without the feature `gpu`".to_owned();
    Ok(unavailable(format!("gpu:{name}"), variant, reason))
}

/// A subject that cannot be run, and has been asked.
fn unavailable(name: String, variant: Variant, reason: String) -> Subject<'static> {
    let subject = Subject::batched(name, Precision::F32, variant, move |_| Err(reason.clone()));
    let _ = subject.thresholds::<Fragment>(&[]);
    subject
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Typed {
        #[command(flatten)]
        shader: ShaderArgs,
    }

    fn names(typed: &[&str], options: &[&str]) -> Result<Vec<String>, String> {
        let args = Typed::parse_from(["hashed-alpha"].iter().chain(options)).shader;
        let typed: Vec<String> = typed.iter().map(ToString::to_string).collect();
        let found = subjects(&typed, &args).map_err(|error| error.to_string())?;
        Ok(found.iter().map(|subject| format!("{} {}", subject.name, subject.precision)).collect())
    }

    #[test]
    fn a_name_before_a_colon_stands_for_all_behind_it() {
        let isotropic = ["paper:isotropic f32", "paper:isotropic f64"];
        assert_eq!(names(&["paper:isotropic"], &[]).unwrap(), isotropic);
        assert_eq!(names(&["cpu:paper:isotropic"], &[]).unwrap(), isotropic);
        assert_eq!(names(&["paper", "paper:isotropic"], &[]), names(&["paper"], &[]));
        assert_eq!(names(&["paper"], &[]).unwrap().len(), 4);
        let error = names(&["paper", "pap"], &[]).unwrap_err();
        assert!(error.starts_with("unknown subject `pap`; known are paper:isotropic, "), "{error}");
    }

    #[test]
    fn a_shader_runs_under_every_device_model() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/shaders/listing_sine.wgsl");
        let found = names(&[file], &["--on", "device-model"]).unwrap();
        assert_eq!(found.len(), DeviceModel::ALL.len());
        assert!(found.contains(&"half:listing_sine.wgsl f32".to_owned()), "{found:?}");
        assert_eq!(names(&[file], &["--on", "cpu"]).unwrap(), ["listing_sine.wgsl f32"]);
    }
}
