//! The parameters that a user's function may have, and where their values come from.

use super::error::Fault;
use super::setting::{Value, type_name};
use naga::{Function, Handle, Module, Scalar, TypeInner, VectorSize};
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
    /// The same in every fragment: `hash_scale`, and every parameter of another name.
    Constant(Value),
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
        "it returns f32 (float), and its parameters are any of {}, hash_scale: f32, in any order, and f32, i32, u32 or \
         bool of other names whose value is given by --set NAME=VALUE",
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
            let TypeInner::Scalar(scalar) = module.types[argument.ty].inner else {
                let message = format!("parameter `{parameter}` of `{name}` is {found}; {}", allowed());
                return Err(fault(message));
            };
            let written = match settings.remove(&parameter) {
                Some(written) => written,
                None if parameter == "hash_scale" => "1".to_owned(),
                None => {
                    let message = format!(
                        "parameter `{parameter}` of `{name}` has no value: --set {parameter}=VALUE; {}",
                        allowed()
                    );
                    return Err(fault(message));
                }
            };
            Input::Constant(
                Value::parse(scalar, &written).map_err(|error| fault(format!("{parameter}: {error}")))?,
            )
        };
        bindings.push(Binding { name: parameter, input });
    }
    Ok(bindings)
}

/// The name of a type in messages.
pub(super) fn described(module: &Module, ty: Handle<naga::Type>) -> String {
    match module.types[ty].inner {
        TypeInner::Scalar(scalar) => type_name(scalar).to_owned(),
        TypeInner::Vector { size, scalar } => vector(size, scalar),
        TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. } => {
            "a pointer (an `out` or `inout`)".to_owned()
        }
        TypeInner::Image { .. } | TypeInner::Sampler { .. } => "a texture or sampler".to_owned(),
        _ => module.types[ty].name.clone().unwrap_or_else(|| "neither a number nor a vector".to_owned()),
    }
}

fn vector(size: VectorSize, scalar: Scalar) -> String {
    format!("vec{}<{}>", size as u8, type_name(scalar))
}
