//! What a file calls the values of a fragment: the names that are usual, or those that the user gives (`--map position=pos`).

use super::error::Fault;
use super::options::{ALPHA, Options};
use super::signature::{self, described, described_inner};
use super::usual::{is_usual, meanings, only, sounds_like_position};
use super::waiting::{Item, Place, items, members};
use super::wrapping::{is_made, is_of_another_type, shape, wrap};
use crate::shader::spelling::likely;
use core::fmt;
use naga::{AddressSpace, Function, GlobalVariable, Handle, Module, ScalarKind, Type};
use std::collections::{BTreeMap, BTreeSet};

/// A value of a fragment under the name that the file has for it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Taken {
    /// The name in the file.
    pub name: String,
    /// What it is taken for: a parameter of [`super::Input`], as `position`.
    pub meaning: &'static str,
}

impl fmt::Display for Taken {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, meaning } = self;
        write!(f, "`{name}` is taken for `{meaning}`")
    }
}

/// Wraps `target` in a function whose parameters have the names and types of a fragment's values, for all that the user says
/// or whose name is usual; what has a value by `settings` keeps it. Returns `target` where nothing has another name.
///
/// # Errors
///
/// A name of the user's that is not there, or is no value of a fragment; a type that nothing can be made into.
pub(super) fn map(
    module: &mut Module,
    target: Handle<Function>,
    asked: &Options,
    settings: &mut BTreeMap<String, String>,
    inputs: &BTreeSet<String>,
    uniforms: &[String],
    pixels: &BTreeSet<String>,
) -> Result<Mapped, Fault> {
    let said = &asked.map;
    sized(&items(module, target, &BTreeMap::new()), asked, settings)?;
    let items = items(module, target, settings);
    let mut taken: Vec<(&Item, &'static str)> = Vec::new();
    // The alpha of a test has been taken before.
    for (meaning, name) in said.iter().filter(|(meaning, _)| *meaning != ALPHA) {
        let Some(meaning) = meanings().find(|known| known == meaning) else {
            let known: Vec<_> = meanings().chain([ALPHA]).collect();
            let likely = likely(meaning, &known);
            let known = known.join(", ");
            return Err(Fault::new(format!(
                "--map {meaning}={name}: a fragment has no `{meaning}`.{likely} It has {known}"
            )));
        };
        let Some(item) = items.iter().find(|item| item.is_called(name) && item.setting.is_none()) else {
            let known: Vec<_> = items.iter().map(|item| item.name.as_str()).collect();
            let likely = likely(name, &known);
            let known = if known.is_empty() { "nothing".to_owned() } else { known.join(", ") };
            return Err(Fault::new(format!(
                "--map {meaning}={name}: no `{name}` waits for a value.{likely} What does is {known}"
            )));
        };
        if !is_made(module, meaning, item.ty) {
            let ours = described_inner(module, &signature::type_of(meaning).inner);
            let found = described(module, item.ty);
            return Err(Fault::new(format!(
                "--map {meaning}={name}: `{name}` is {found}, which nothing makes out of {ours}"
            )));
        }
        taken.push((item, meaning));
    }
    for meaning in meanings().filter(|&meaning| !said.contains_key(meaning)) {
        // A name of ours goes before all others, and is refused where its type is another.
        let is_ours = |item: &Item| item.name == meaning && !pixels.contains(&item.name);
        if items.iter().any(|item| {
            is_ours(item) && item.place.is_parameter() && !is_of_another_type(module, meaning, item.ty)
        }) {
            continue;
        }
        let is_free = |item: &&Item| {
            let is_another = meanings().any(|known| known == item.name) && item.name != meaning;
            item.setting.is_none()
                && (!is_another || pixels.contains(&item.name))
                && !said.values().any(|name| item.is_called(name))
        };
        let is_meant = |item: &Item| {
            // In blocks are the positions of lights and of the eye.
            let is_of_block = matches!(item.place, Place::VariableMember(variable, _)
                if module.global_variables[variable].space != AddressSpace::Private
                    || module.global_variables[variable].name.as_ref().is_some_and(|name| uniforms.contains(name)));
            if pixels.contains(&item.name) {
                meaning == "pixel"
            } else {
                is_usual(meaning, &item.name) && (!is_of_block || matches!(meaning, "frame" | "hash_scale"))
            }
        };
        let fits = |item: &&Item| is_meant(item) && is_made(module, meaning, item.ty);
        let found = || items.iter().filter(is_free).filter(fits);
        let parameters = found().filter(|item| matches!(item.place, Place::Parameter(_) | Place::Member(..)));
        let exact = found().filter(|item| is_ours(item));
        if let Some(item) = only(exact).or_else(|| only(parameters)).or_else(|| only(found())) {
            taken.push((item, meaning));
        }
    }
    // Where nothing has a usual name: one that sounds like a position, then the only vector that comes from the fragment.
    let has_position = taken.iter().any(|(_, meaning)| *meaning == "position")
        || items.iter().any(|item| item.name == "position" && item.place.is_parameter());
    if !has_position {
        let is_open = |item: &&Item| {
            let is_free = item.setting.is_none()
                && !pixels.contains(&item.name)
                && !taken.iter().any(|(taken, _)| taken.place == item.place);
            let is_of_fragment = match item.place {
                Place::Parameter(_) | Place::Member(..) => true,
                Place::Variable(_) => inputs.contains(&item.name),
                Place::VariableMember(handle, _) => {
                    module.global_variables[handle].name.as_ref().is_some_and(|name| inputs.contains(name))
                }
            };
            let is_another = meanings().any(|known| known == item.name || is_usual(known, &item.name));
            is_free && is_of_fragment && !is_another
        };
        let has = |item: &&Item, size| shape(&module.types[item.ty].inner) == Some((size, ScalarKind::Float));
        let vectors = || items.iter().filter(is_open).filter(|item| has(item, 3));
        // One of four has no more than its sound to speak for it.
        let sounding = |size| {
            let all = items.iter().filter(is_open).filter(move |item| has(item, size));
            only(all.filter(|item| sounds_like_position(&item.name)))
        };
        let item = sounding(3).or_else(|| only(vectors())).or_else(|| sounding(4));
        taken.extend(item.map(|item| (item, "position")));
    }
    let mut notes: Vec<_> =
        taken.iter().map(|(item, meaning)| Taken { name: item.name.clone(), meaning }).collect();
    let names = notes.iter().map(|taken| taken.name.clone()).collect();
    notes.retain(|taken| taken.name != taken.meaning);
    let has_structures =
        module.functions[target].arguments.iter().any(|argument| members(module, argument.ty).is_some());
    let taken: Vec<_> = taken.into_iter().map(|(item, meaning)| (item.place, item.ty, meaning)).collect();
    refuse_unset(module, &items, &taken, uniforms)?;
    let mut members = BTreeMap::<_, BTreeSet<_>>::new();
    for &(place, ..) in &taken {
        if let Place::VariableMember(variable, member) = place {
            members.entry(variable).or_default().insert(member);
        }
    }
    let target =
        if taken.is_empty() && !has_structures { target } else { wrap(module, target, &taken, &items) };
    Ok(Mapped { target, notes, names, members })
}

/// The size of the noise under the name that the file has for it: what is set by that name is the size that is meant.
fn sized(items: &[Item], asked: &Options, settings: &mut BTreeMap<String, String>) -> Result<(), Fault> {
    const SIZE: &str = "hash_scale";
    let is_size = |item: &&Item| item.name != SIZE && is_usual(SIZE, &item.name);
    let set =
        items.iter().filter(is_size).filter_map(|item| settings.keys().find(|name| item.is_called(name)));
    if !settings.contains_key(SIZE)
        && !asked.map.contains_key(SIZE)
        && let Some(name) = only(set).cloned()
        && let Some(value) = settings.remove(&name)
    {
        settings.insert(SIZE.to_owned(), value);
    }
    let number = settings.get(SIZE).and_then(|value| value.parse::<f64>().ok());
    if let Some(number) = number.filter(|number| !(number.is_finite() && *number > 0.0)) {
        let message = format!("--set {SIZE}={number}: a size of the noise, in pixels, is finite and above 0");
        return Err(Fault::new(message));
    }
    Ok(())
}

/// A function that takes the values of a fragment.
pub(super) struct Mapped {
    pub target: Handle<Function>,
    /// What was taken for what under another name.
    pub notes: Vec<Taken>,
    /// The names of all that has got a value.
    pub names: BTreeSet<String>,
    /// The members of variables that have got a value.
    pub members: BTreeMap<Handle<GlobalVariable>, BTreeSet<usize>>,
}

/// Refuses members of inputs that are read and stand for nothing, beside others that do.
fn refuse_unset(
    module: &Module,
    items: &[Item],
    taken: &[(Place, Handle<Type>, &str)],
    uniforms: &[String],
) -> Result<(), Fault> {
    for item in items {
        let Place::VariableMember(variable, _) = item.place else { continue };
        // What is not set of a uniform is refused with its block.
        if module.global_variables[variable].name.as_ref().is_some_and(|name| uniforms.contains(name)) {
            continue;
        }
        let is_taken = |place: Place| taken.iter().any(|(taken, ..)| *taken == place);
        if module.global_variables[variable].space == AddressSpace::Private && !is_taken(item.place) {
            let Item { full, name, .. } = item;
            let message = format!(
                "`{full}` has no value: what comes from the rest of a program is a value of the fragment (--map position={name}), \
                 or a parameter"
            );
            return Err(Fault::new(message).at(module.global_variables.get_span(variable).to_range()));
        }
    }
    Ok(())
}
