//! Shaders on trial: a file of the user's or our own text, in the interpreter or on a device.

use super::Subject;
use super::subject::Precision;
use crate::scene::Fragment;
use crate::shader::interpreter::{Column, DeviceModel, Kind, Program, Stopped, Unsupported, Values};
use crate::shader::own::{Input, OwnShader, ShaderError};
use crate::threshold::two_scale::Variant;

/// Puts a shader on trial in the interpreter, under the arithmetic of a device model.
///
/// # Errors
///
/// [`ShaderError`], with its place: something in the shader is not interpreted.
pub fn interpreted(
    name: impl Into<String>,
    shader: &OwnShader,
    model: DeviceModel,
    variant: Variant,
) -> Result<Subject<'static>, ShaderError> {
    let program = Program::compile(&shader.module, &shader.info, &shader.function)
        .map_err(|Unsupported { message, span }| shader.error_at(span, message))?;
    let shader = shader.clone();
    let thresholds = move |fragments: &[Fragment]| {
        let owned = columns(&shader, &program, fragments);
        let columns: Vec<Column<'_>> = owned.iter().map(borrowed).collect();
        match program.run(&columns, fragments.len(), &model) {
            Ok(results) => match results.as_slice() {
                [Values::F32(values)] => Ok(values.iter().copied().map(f64::from).collect()),
                _ => Err("the function does not return one f32".to_owned()),
            },
            Err(Stopped::Endless { span, steps }) => {
                let message = format!("a loop does not end, or takes more than {steps} steps");
                Err(shader.error_at(span, message).to_string())
            }
            Err(stopped @ Stopped::Arguments(_)) => Err(stopped.to_string()),
        }
    };
    Ok(Subject::batched(name, Precision::F32, variant, thresholds))
}

/// One column a scalar of the parameters; one value where it is the same in all fragments.
fn columns(shader: &OwnShader, program: &Program, fragments: &[Fragment]) -> Vec<Values> {
    let mut columns = Vec::new();
    for (binding, parameter) in shader.bindings.iter().zip(program.parameters()) {
        let constant = matches!(binding.input, Input::Constant(_));
        let rows: Vec<Vec<u32>> = if constant {
            fragments.first().map(|first| binding.input.words(first)).into_iter().collect()
        } else {
            fragments.iter().map(|fragment| binding.input.words(fragment)).collect()
        };
        for (component, &kind) in parameter.components.iter().enumerate() {
            let words = rows.iter().map(|row| row[component]);
            columns.push(match kind {
                Kind::F32 => Values::F32(words.map(f32::from_bits).collect()),
                Kind::I32 => Values::I32(words.map(|word| word as i32).collect()),
                Kind::U32 => Values::U32(words.collect()),
                Kind::Bool => Values::Bool(words.map(|word| word != 0).collect()),
            });
        }
    }
    columns
}

fn borrowed(values: &Values) -> Column<'_> {
    match values {
        Values::F32(values) => Column::F32(values),
        Values::I32(values) => Column::I32(values),
        Values::U32(values) => Column::U32(values),
        Values::Bool(values) => Column::Bool(values),
    }
}

/// Puts a shader on trial on a device.
///
/// # Errors
///
/// [`ShaderError`]: the shader cannot be written as WGSL, or the device does not take it.
#[cfg(feature = "gpu")]
pub fn on_device(
    name: impl Into<String>,
    shader: &OwnShader,
    device: &crate::shader::gpu::Device,
    variant: Variant,
) -> Result<Subject<'static>, ShaderError> {
    use crate::shader::gpu::Kernel;
    let words = shader.words_per_fragment();
    let expression = format!("array(bitcast<u32>({}))", shader.call());
    let kernel = Kernel::of_words(&shader.wgsl()?, words.max(1), 1, &expression);
    let program =
        device.compile(&kernel).map_err(|error| shader.error_at(naga::Span::UNDEFINED, error.to_string()))?;
    let shader = shader.clone();
    let thresholds = move |fragments: &[Fragment]| {
        let mut packed = shader.words(fragments);
        if words == 0 {
            // A storage binding cannot be empty.
            packed.resize(fragments.len(), 0);
        }
        let found = program.map(&packed).map_err(|error| error.to_string())?;
        Ok(found.into_iter().map(|word| f64::from(f32::from_bits(word))).collect())
    };
    Ok(Subject::batched(name, Precision::F32, variant, thresholds))
}
