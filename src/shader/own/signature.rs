//! The parameters that a user's function may have, and where their values come from.

use super::error::Fault;
use super::setting::{Constant, Value, type_name};
use naga::{Function, Handle, Module, TypeInner};
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

const FRAGMENT: [(&str, &str, Input); 8] = [
    ("position", "vec3<f32>", Input::Position),
    ("dpdx", "vec3<f32>", Input::Dpdx),
    ("dpdy", "vec3<f32>", Input::Dpdy),
    ("pixel", "vec2<f32>", Input::Pixel),
    ("texcoord", "vec2<f32>", Input::Texcoord),
    ("lod", "f32", Input::Lod),
    ("frame", "u32", Input::Frame),
    ("layer", "u32", Input::Layer),
];

/// Says what a function may look like; the end of many messages.
pub(super) fn allowed() -> String {
    let list: Vec<_> = FRAGMENT.iter().map(|(name, wgsl_type, _)| format!("{name}: {wgsl_type}")).collect();
    format!(
        "it returns f32 (float), and its parameters are any of {}, hash_scale: f32, in any order, and numbers or \
         vectors of other names whose value is given by --set NAME=VALUE; or it is a hash, from one vec4<u32> (three indices of \
         a cell and its octave) to u32",
        list.join(", ")
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
        let input = if let Some(&(_, wanted, input)) = FRAGMENT.iter().find(|(name, ..)| *name == parameter) {
            if found != wanted {
                let message =
                    format!("parameter `{parameter}` of `{name}` is {found}, not {wanted}; {}", allowed());
                return Err(fault(message));
            }
            input
        } else {
            let inner = &module.types[argument.ty].inner;
            let Some(wanted) = Constant::form(inner) else {
                let message = format!("parameter `{parameter}` of `{name}` is {found}; {}", allowed());
                return Err(fault(message));
            };
            let written = match settings.remove(&parameter) {
                Some(written) => written,
                None if parameter == "hash_scale" && found == "f32" => "1".to_owned(),
                None => {
                    let message = format!(
                        "parameter `{parameter}` of `{name}` has no value: --set {parameter}={wanted}; {}",
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
pub(super) fn described(module: &Module, ty: Handle<naga::Type>) -> String {
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
