//! What a typed subject means: a listing, the robust threshold or a shader file, and where it runs.

use super::args::{On, ShaderArgs};
use super::failure::Failure;
use super::output;
use super::shader_files::ShaderFile;
use hashed_alpha::check::shaders;
use hashed_alpha::check::{Frames, Subject, subject::Precision};
use hashed_alpha::scene::{Fragment, Scene};
use hashed_alpha::shader::interpreter::DeviceModel;
use hashed_alpha::shader::own::{self, OwnShader};
use hashed_alpha::shader::spelling::likely;
use hashed_alpha::threshold::hash::{HashKind, UnknownName};
use hashed_alpha::threshold::pipeline::Pipeline;
use hashed_alpha::threshold::robust::{Join, Robust};
use hashed_alpha::threshold::two_scale::Variant;
use std::path::Path;

/// A subject as it was typed: `paper`, `robust:isotropic`, `gpu:robust`, `cpu:paper`, or a shader file.
struct Typed<'a> {
    /// Where it is to run, where that was typed with it.
    on: Option<On>,
    what: What<'a>,
}

enum What<'a> {
    File(ShaderFile<'a>),
    /// A hash of the list, alone.
    Hash(&'a str),
    BuiltIn(&'a str),
}

impl<'a> Typed<'a> {
    fn of(word: &'a str) -> Self {
        if let Some(file) = ShaderFile::of(word) {
            return Self { on: None, what: What::File(file) };
        }
        if let Some(name) = word.strip_prefix("hash:") {
            return Self { on: None, what: What::Hash(name) };
        }
        let (on, name) = match word.split_once(':') {
            Some(("gpu", name)) => (Some(On::Gpu), name),
            Some(("cpu", name)) => (Some(On::Cpu), name),
            _ => (None, word),
        };
        Self { on, what: What::BuiltIn(name) }
    }
}

/// Whether a subject may run on a device.
pub fn may_need_a_device(word: &str, on: On) -> bool {
    let typed = Typed::of(word);
    match typed.on.unwrap_or(on) {
        _ if matches!(typed.what, What::Hash(_)) => false,
        On::Gpu => true,
        On::Auto => matches!(typed.what, What::File(_)),
        On::Cpu | On::DeviceModel => false,
    }
}

/// Whether a subject is one of this program's own, in Rust.
pub fn is_in_rust(word: &str, on: On) -> bool {
    let typed = Typed::of(word);
    match typed.what {
        What::File(_) => false,
        What::Hash(_) => true,
        What::BuiltIn(_) => matches!(typed.on.unwrap_or(on), On::Auto | On::Cpu),
    }
}

/// The families of thresholds that this program has itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// The listings to the letter.
    Paper,
    /// The robust threshold.
    Robust,
    /// A hash of the list, alone.
    Hash,
}

/// Where a subject runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Here, in Rust.
    Rust,
    /// In the interpreter, as accurately as it can.
    Interpreter,
    /// In the interpreter, under a model of a device of this name.
    Model(&'static str),
    /// On a device.
    Device,
}

/// A subject that was asked for.
pub struct Asked {
    /// The subject.
    pub subject: Subject<'static>,
    /// Its name without the place where it runs.
    pub name: String,
    /// Where it runs.
    pub place: Place,
    /// Its family; none for a file.
    pub family: Option<Family>,
    /// Path of its file, with line and column of its function where they are known; none for a subject of this program.
    pub written: Option<(String, Option<[usize; 2]>)>,
}

/// Returns the subjects that were typed, each once: built-in ones by their name or its part before a colon, `gpu:` before it
/// for a device and `cpu:` for what has no prefix; files by their name.
pub fn subjects(typed: &[String], args: &ShaderArgs) -> Result<Vec<Asked>, Failure> {
    let mut found: Vec<Asked> = Vec::new();
    for word in typed {
        add(&mut found, of_word(word, args)?);
    }
    Ok(found)
}

/// The subjects that a word stands for.
fn of_word(word: &str, args: &ShaderArgs) -> Result<Vec<Asked>, Failure> {
    let typed = Typed::of(word);
    match &typed.what {
        What::File(typed) => file(typed, args),
        What::Hash(name) => hash(name),
        What::BuiltIn(name) => {
            built_in(name, typed.on.unwrap_or(args.on), args)?.ok_or_else(|| unknown(word))
        }
    }
}

/// Adds subjects that are not there yet.
fn add(found: &mut Vec<Asked>, more: Vec<Asked>) {
    for asked in more {
        let is_same = |a: &Subject<'_>, b: &Subject<'_>| a.name == b.name && a.precision == b.precision;
        if !found.iter().any(|other| is_same(&other.subject, &asked.subject)) {
            found.push(asked);
        }
    }
}

/// The same of those files that can be read. One without such a function and without a test of an alpha is passed over with a note; the
/// others are told on stderr and counted.
pub fn readable(typed: &[String], args: &ShaderArgs) -> Result<(Vec<Asked>, usize), Failure> {
    let mut found: Vec<Asked> = Vec::new();
    let mut unread = 0;
    for word in typed {
        match of_word(word, args) {
            Ok(more) => add(&mut found, more),
            Err(Failure::Shader(error)) if error.is_absent => {
                let function = &args.function;
                let why = format!("it has no function `{function}`, and no hashed test of an alpha");
                output::remark("note", format_args!("{word} is passed over: {why}"));
            }
            Err(failure @ (Failure::Shader(_) | Failure::File { .. })) => {
                output::remark("error", failure.message());
                unread += 1;
            }
            Err(failure) => return Err(failure),
        }
    }
    Ok((found, unread))
}

fn unknown(word: &str) -> Failure {
    let file = word.rsplit_once('#').map_or(word, |(file, _)| file);
    if let Some(instead) = own::instead_of(Path::new(file)) {
        return Failure::Usage(format!("{file}: {instead}"));
    }
    let mut known: Vec<String> = [
        "paper",
        "paper:isotropic",
        "paper:anisotropic",
        "recommended",
        "recommended:steady",
        "recommended:smooth",
        "robust",
    ]
    .map(str::to_owned)
    .into();
    for variant in ["robust:isotropic", "robust:anisotropic"] {
        known.push(variant.to_owned());
        known.extend(Join::ALL.map(|join| format!("{variant}:{join}")));
    }
    let likely = likely(word, &known);
    Failure::Usage(format!(
        "unknown subject `{word}`.{likely} Known are paper:isotropic, paper:anisotropic, robust:isotropic, \
         robust:anisotropic, recommended:steady, recommended:smooth (the robust ones with a join behind them, too, as robust:isotropic:inherit), each with gpu: before \
         it too, hash: with the name of a hash behind it, and files of shaders, as my.glsl, or of programs that hold one, as \
         my.js"
    ))
}

/// Returns a hash of the list alone: in both precisions where they differ.
fn hash(name: &str) -> Result<Vec<Asked>, Failure> {
    let kind: HashKind = name.parse().map_err(|error: UnknownName| {
        let likely = likely(name, &HashKind::ALL.map(HashKind::name));
        Failure::Usage(format!("{error}.{likely}"))
    })?;
    let precisions = if kind.is_exact() { &Precision::ALL[..1] } else { &Precision::ALL[..] };
    let name = format!("hash:{kind}");
    let asked = |&precision: &Precision| Asked {
        subject: Subject::of_hash(name.as_str(), precision, kind),
        name: name.clone(),
        place: Place::Rust,
        family: Some(Family::Hash),
        written: None,
    };
    Ok(precisions.iter().map(asked).collect())
}

/// Returns the subjects of a family, or of one variant of it; nothing where there is none of that name.
fn built_in(name: &str, on: On, args: &ShaderArgs) -> Result<Option<Vec<Asked>>, Failure> {
    let mut words = name.split(':');
    let family = words.next();
    let mut more: Vec<&str> = words.collect();
    // A join of the robust threshold stands last.
    let join: Option<Join> = more.last().and_then(|word| word.parse().ok());
    let (family, mut all) = match (family, join) {
        (Some("paper"), _) => (Family::Paper, Subject::paper()),
        (Some("recommended"), None) => (Family::Robust, Subject::recommended()),
        (Some("robust"), None) => (Family::Robust, Subject::all_repairs()),
        (Some("robust"), Some(join)) => {
            more.pop();
            (Family::Robust, Subject::all_repairs_by(join))
        }
        _ => return Ok(None),
    };
    all.retain(|subject| match more[..] {
        [] => true,
        // `robust:isotropic`, `recommended:steady`.
        [word] => subject.name.split(':').nth(1) == Some(word),
        _ => false,
    });
    if all.is_empty() {
        return Ok(None);
    }
    if matches!(on, On::Auto | On::Cpu) {
        let here = |subject: Subject<'static>| {
            let name = subject.name.clone();
            Asked { subject, name, place: Place::Rust, family: Some(family), written: None }
        };
        return Ok(Some(all.into_iter().map(here).collect()));
    }
    all.retain(|subject| subject.precision == Precision::F32);
    let mut found = Vec::new();
    for twin in all {
        let pipeline = match family {
            Family::Paper => Pipeline::listing(twin.variant),
            Family::Robust | Family::Hash => Robust { join: twin.join, ..Robust::new(twin.variant) }.into(),
        };
        let shader = own::assembled(&twin.name, pipeline)?;
        let claims = Claimed {
            variant: twin.variant,
            join: twin.join,
            nested_phase: twin.nested_phase,
            hash_scale: 1.0,
            frames: Frames::Static,
        };
        found.extend(placed(&twin.name, &shader, on, args, &claims, Some(family))?);
    }
    Ok(Some(found))
}

/// What a shader claims of itself.
pub struct Claimed {
    pub variant: Variant,
    join: Join,
    nested_phase: bool,
    hash_scale: f64,
    frames: Frames,
}

impl Claimed {
    /// What the options say of a shader file.
    pub fn of(typed: &ShaderFile<'_>, args: &ShaderArgs, options: &own::Options, shader: &OwnShader) -> Self {
        let stated = typed.claims(args);
        let set = || options.settings.get("hash_scale").and_then(|value| value.parse().ok());
        // Under another name that is known for it.
        let taken = || shader.hash_scale().map(f64::from);
        let variant = stated.variant.unwrap_or(Variant::Isotropic);
        let preset = Robust::new(variant).join;
        Self {
            variant,
            join: stated.join.unwrap_or(if stated.nested_phase { preset } else { Join::Interpolate }),
            nested_phase: stated.nested_phase,
            hash_scale: stated.hash_scale.or_else(set).or_else(taken).unwrap_or(1.0),
            frames: args.frames,
        }
    }

    /// A subject that claims it.
    pub fn by(&self, mut subject: Subject<'static>) -> Subject<'static> {
        subject.join = self.join;
        subject.nested_phase = self.nested_phase;
        subject.hash_scale = self.hash_scale;
        subject.frames = self.frames;
        subject
    }
}

fn file(typed: &ShaderFile<'_>, args: &ShaderArgs) -> Result<Vec<Asked>, Failure> {
    let options = typed.options(args)?;
    if let Some(folder) = args.include.iter().find(|folder| !folder.is_dir()) {
        return Err(Failure::Usage(format!("-I {}: there is no such folder", folder.display())));
    }
    let shader = own::read(Path::new(typed.path), &options)?;
    if !shader.taken.is_empty() {
        let said: Vec<_> = shader.taken.iter().map(ToString::to_string).collect();
        output::remark("note", format_args!("in {} {}", typed.name(), said.join(", ")));
    }
    for name in shader.taken.iter().filter(|taken| taken.meaning == "position").map(|taken| &taken.name) {
        let plain = name.to_ascii_lowercase();
        if plain.contains("world") || plain.ends_with("ws") {
            let why =
                "thresholds stay with the world and not with an object that moves (docs/coordinates.md)";
            output::remark("note", format_args!("`{name}` sounds like a position in world space: {why}"));
        }
    }
    shader.notes.iter().for_each(|note| output::remark("note", format_args!("in {} {note}", typed.name())));
    let place = shader.defined_at.map(|place| [place.line, place.column]);
    let written = Some((typed.path.to_owned(), place));
    if shader.is_hash() {
        let hashes = own_hash(&typed.name(), &shader, args)?;
        return Ok(hashes.into_iter().map(|asked| Asked { written: written.clone(), ..asked }).collect());
    }
    let claims = Claimed::of(typed, args, &options, &shader);
    let name = typed.name();
    let remarks = stops(&shader, claims.variant)?;
    let subjects = placed(&name, &shader, args.on, args, &claims, None)?;
    if subjects.iter().any(|asked| asked.place == Place::Device) {
        // A device does not tell.
        remarks.iter().for_each(|remark| output::remark("note", remark));
    }
    Ok(subjects.into_iter().map(|asked| Asked { written: written.clone(), ..asked }).collect())
}

/// Puts a shader's hash where it is wanted: integers are the same everywhere, so that the interpreter stands for every device.
fn own_hash(name: &str, shader: &OwnShader, args: &ShaderArgs) -> Result<Vec<Asked>, Failure> {
    if matches!(args.on, On::Gpu | On::DeviceModel) {
        let message =
            format!("{name} is a hash of whole numbers, which runs in the interpreter: leave out --on");
        return Err(Failure::Usage(message));
    }
    let subject = shaders::interpreted_hash(name, shader, DeviceModel::ACCURATE)?;
    let (name, place, family) = (name.to_owned(), Place::Interpreter, Some(Family::Hash));
    Ok(vec![Asked { subject, name, place, family, written: None }])
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
    family: Option<Family>,
) -> Result<Vec<Asked>, Failure> {
    let interpreted = |name: String, model| {
        shaders::interpreted(name, shader, model, claims.variant).map_err(Failure::from)
    };
    let accurate =
        || Ok::<_, Failure>((Place::Interpreter, interpreted(name.to_owned(), DeviceModel::ACCURATE)?));
    let on_device = || Ok::<_, Failure>((Place::Device, on_device(name, shader, args, claims.variant)?));
    let subjects = match on {
        On::Cpu => vec![accurate()?],
        On::DeviceModel => DeviceModel::ALL
            .into_iter()
            .map(|model| {
                let subject = interpreted(format!("{}:{name}", model.name()), model)?;
                Ok((Place::Model(model.name()), subject))
            })
            .collect::<Result<_, Failure>>()?,
        On::Gpu => vec![on_device()?],
        On::Auto => {
            let refused = match on_device() {
                Ok((_, subject)) if subject.failure().is_some() => {
                    Err(subject.failure().unwrap_or_default().to_owned())
                }
                Ok(placed) => Ok(placed),
                Err(failure) => Err(failure.message()),
            };
            vec![match refused {
                Ok(placed) => placed,
                Err(reason) => {
                    output::remark("note", format_args!("{name} runs in the interpreter: {reason}"));
                    accurate()?
                }
            }]
        }
    };
    let claiming = |(place, subject): (Place, Subject<'static>)| {
        let subject = claims.by(subject);
        Asked { subject, name: name.to_owned(), place, family, written: None }
    };
    Ok(subjects.into_iter().map(claiming).collect())
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
        Ok(found
            .iter()
            .map(|Asked { subject, .. }| format!("{} {}", subject.name, subject.precision))
            .collect())
    }

    #[test]
    fn a_name_before_a_colon_stands_for_all_behind_it() {
        let isotropic = ["paper:isotropic f32", "paper:isotropic f64"];
        assert_eq!(names(&["paper:isotropic"], &[]).unwrap(), isotropic);
        assert_eq!(names(&["cpu:paper:isotropic"], &[]).unwrap(), isotropic);
        assert_eq!(names(&["paper", "paper:isotropic"], &[]), names(&["paper"], &[]));
        assert_eq!(names(&["paper"], &[]).unwrap().len(), 4);
        let error = names(&["paper", "pap"], &[]).unwrap_err();
        let wanted = "unknown subject `pap`. Did you mean `paper`? Known are paper:isotropic, ";
        assert!(error.starts_with(wanted), "{error}");
    }

    #[test]
    fn a_hash_stands_alone_in_both_precisions_where_they_differ() {
        assert_eq!(names(&["hash:mm4"], &["--on", "gpu"]).unwrap(), ["hash:mm4 f32"]);
        assert_eq!(names(&["hash:sine"], &[]).unwrap(), ["hash:sine f32", "hash:sine f64"]);
        let error = names(&["hash:pcg3"], &[]).unwrap_err();
        assert!(
            error.starts_with("unknown hash `pcg3`; known are sine, ") && error.contains("mean `pcg3d`?"),
            "{error}"
        );
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
