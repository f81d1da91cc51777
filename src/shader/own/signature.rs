//! The parameters that a user's function may have, and where their values come from.

use super::error::Fault;
use super::setting::{Constant, Value, type_name};
use crate::shader::spelling::likely;
use naga::{Function, Handle, Module, Scalar, Type, TypeInner, VectorSize};
use std::collections::BTreeMap;

/// Where the value of a parameter comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input {
    /// `position`: in object coordinates.
    Position,
    /// `dpdx`: its change to the next pixel on the right.
    Dpdx,
    /// `dpdy`: its change to the next pixel along screen y.
    Dpdy,
    /// `pixel`: the centre of the pixel.
    Pixel,
    /// `texcoord`: the texture coordinates.
    Texcoord,
    /// `lod`: the level of detail of the texture.
    Lod,
    /// `frame`: the index of the frame.
    Frame,
    /// `layer`: the index of the surface along the line of sight.
    Layer,
    /// The only parameter of a hash: the three indices of [the coarse cell](crate::threshold::robust::scales::only_cell) and its
    /// octave as one word.
    Cell,
    /// The same in every fragment: `hash_scale`, and every parameter of another name.
    Constant(Constant),
}

impl Input {
    /// Returns the value of a parameter that is one number and the same in every fragment.
    #[must_use]
    pub fn as_f32(self) -> Option<f32> {
        let Self::Constant(constant) = self else { return None };
        match constant.components() {
            &[Value::F32(value)] => Some(value),
            _ => None,
        }
    }
}

/// A parameter of the function and the source of its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// Its name in the file.
    pub name: String,
    /// Where its value comes from.
    pub input: Input,
}

static FRAGMENT: [(&str, Type, Input); 8] = [
    ("position", VECTOR, Input::Position),
    ("dpdx", VECTOR, Input::Dpdx),
    ("dpdy", VECTOR, Input::Dpdy),
    ("pixel", PAIR, Input::Pixel),
    ("texcoord", PAIR, Input::Texcoord),
    ("lod", scalar(Scalar::F32), Input::Lod),
    ("frame", scalar(Scalar::U32), Input::Frame),
    ("layer", scalar(Scalar::U32), Input::Layer),
];

const VECTOR: Type = plain(TypeInner::Vector { size: VectorSize::Tri, scalar: Scalar::F32 });
const PAIR: Type = plain(TypeInner::Vector { size: VectorSize::Bi, scalar: Scalar::F32 });

const fn scalar(scalar: Scalar) -> Type {
    plain(TypeInner::Scalar(scalar))
}

const fn plain(inner: TypeInner) -> Type {
    Type { name: None, inner }
}

/// The name of the size of the noise, which has a value without being asked.
const HASH_SCALE: &str = "hash_scale";

/// The names of what a fragment gives, and of the size of the noise.
pub(super) fn values() -> impl Iterator<Item = &'static str> {
    FRAGMENT.iter().map(|&(name, ..)| name).chain([HASH_SCALE])
}

/// The type of one of [`values`].
pub(super) fn type_of(value: &str) -> Type {
    let known = FRAGMENT.iter().find(|(name, ..)| *name == value);
    known.map_or(scalar(Scalar::F32), |(_, ty, _)| ty.clone())
}

/// Says what a function may look like; the end of many messages.
pub(super) fn allowed() -> String {
    let module = Module::default();
    let list: Vec<_> = FRAGMENT
        .iter()
        .map(|(name, ty, _)| format!("{name}: {}", described_inner(&module, &ty.inner)))
        .collect();
    format!(
        "it returns f32 (float) or has a test of an alpha, and its parameters are any of {}, hash_scale: f32, in any order and under the usual names or \
         those that --map position=NAME gives, and numbers or vectors of other names whose value is given by --set NAME=VALUE; or \
         it is a hash, from one vec4<u32> (three indices of a cell and its octave) to u32",
        list.join(", ")
    )
}

/// Says that a function is not there, why not, and which ones are.
pub(super) fn absent(name: &str, functions: &BTreeMap<String, Option<String>>) -> String {
    if let Some(Some(condition)) = functions.get(name) {
        return format!(
            "there is no function `{name}` here: it stands behind `{condition}`; --set NAME=VALUE defines a macro that a \
             condition asks for"
        );
    }
    let known = functions.iter().map(|(function, condition)| match condition {
        Some(condition) => format!("{function} (behind `{condition}`)"),
        None => function.clone(),
    });
    let known: Vec<_> = known.collect();
    let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
    let likely = likely(name, &functions.keys().collect::<Vec<_>>());
    format!(
        "there is no function `{name}`.{likely} --function NAME takes one of another name; functions are {known}; {}",
        allowed()
    )
}

/// Says of an entry point that it has no test of an alpha.
pub(super) fn without_test(name: &str) -> String {
    format!(
        "`{name}` has no test of an alpha that is found, as `if (alpha < threshold) discard;` is one: name a function that returns the \
         threshold, or that has such a test (--function NAME); --map alpha=NAME says what is tested"
    )
}

/// Finds where the parameters of a function get their values; takes those that it uses out of `settings`.
///
/// # Errors
///
/// A parameter or a result of another type, and a parameter without a value.
pub(super) fn bind(
    module: &Module,
    function: Handle<Function>,
    name: &str,
    settings: &mut BTreeMap<String, String>,
) -> Result<Vec<Binding>, Fault> {
    let at = module.functions.get_span(function).to_range();
    let function = &module.functions[function];
    let fault = |message: String| Fault::new(message).at(at.clone());
    let result = function.result.as_ref().map_or("nothing".to_owned(), |result| described(module, result.ty));
    if let [only] = function.arguments.as_slice()
        && result == "u32"
        && described(module, only.ty) == "vec4<u32>"
    {
        let name = only.name.clone().unwrap_or_else(|| "cell".to_owned());
        return Ok(vec![Binding { name, input: Input::Cell }]);
    }
    if result != "f32" {
        return Err(fault(format!("`{name}` returns {result}; {}", allowed())));
    }
    let mut bindings = Vec::new();
    for (index, argument) in function.arguments.iter().enumerate() {
        let parameter = argument.name.clone().unwrap_or_else(|| format!("number {}", index + 1));
        let found = described(module, argument.ty);
        let input = if let Some((_, ty, input)) = FRAGMENT.iter().find(|(name, ..)| *name == parameter) {
            let wanted = described_inner(module, &ty.inner);
            if found != wanted {
                let message =
                    format!("parameter `{parameter}` of `{name}` is {found}, not {wanted}; {}", allowed());
                return Err(fault(message));
            }
            *input
        } else {
            let inner = &module.types[argument.ty].inner;
            let Some(wanted) = Constant::form(inner) else {
                let message = format!("parameter `{parameter}` of `{name}` is {found}; {}", allowed());
                return Err(fault(message));
            };
            let written = match settings.remove(&parameter) {
                Some(written) => written,
                None if parameter == HASH_SCALE && found == "f32" => "1".to_owned(),
                None => {
                    let is_like = |ty: &Type| {
                        matches!(ty.inner, TypeInner::Vector { .. })
                            && described_inner(module, &ty.inner) == found
                    };
                    let like = FRAGMENT.iter().find(|(_, ty, _)| is_like(ty));
                    let map = like.map_or_else(String::new, |(value, ..)| {
                        format!(", or --map {value}={parameter} where it changes from fragment to fragment")
                    });
                    let message = format!(
                        "parameter `{parameter}` of `{name}` has no value: --set {parameter}={wanted}{map}; {}",
                        allowed()
                    );
                    return Err(fault(message));
                }
            };
            Input::Constant(Constant::parse(&parameter, inner, &written).map_err(fault)?)
        };
        bindings.push(Binding { name: parameter, input });
    }
    Ok(bindings)
}

/// The name of a type in messages.
pub(super) fn described(module: &Module, ty: Handle<Type>) -> String {
    module.types[ty].name.clone().unwrap_or_else(|| described_inner(module, &module.types[ty].inner))
}

/// The same of a type that has no name of its own.
pub(super) fn described_inner(module: &Module, inner: &TypeInner) -> String {
    match *inner {
        TypeInner::Scalar(scalar) => type_name(scalar).to_owned(),
        TypeInner::Vector { size, scalar } => format!("vec{}<{}>", size as u8, type_name(scalar)),
        TypeInner::Matrix { columns, rows, scalar } => {
            format!("mat{}x{}<{}>", columns as u8, rows as u8, type_name(scalar))
        }
        TypeInner::Array { base, .. } => format!("an array of {}", described(module, base)),
        TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. } => {
            "a pointer (an `out` or `inout`)".to_owned()
        }
        TypeInner::Image { .. } | TypeInner::Sampler { .. } => "a texture or sampler".to_owned(),
        _ => "neither a number nor a vector".to_owned(),
    }
}
