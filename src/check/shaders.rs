//! Shaders on trial: a file of the user's or our own text, in the interpreter or on a device.

use super::Subject;
use super::subject::Precision;
use crate::scene::Fragment;
use crate::shader::interpreter::DeviceModel;
use crate::shader::own::{OwnShader, ShaderError};
use crate::threshold::two_scale::Variant;

/// Puts a shader on trial in the interpreter, under the arithmetic of a device model. Its remarks are what it did that
/// shading languages leave open ([`Program::undefined`](crate::shader::interpreter::Program::undefined)).
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
    let program = shader.program()?;
    let shader = shader.clone();
    let (its_program, its_shader) = (program.clone(), shader.clone());
    let has_scale = shader.hash_scale().is_some();
    let (same_program, same_shader) = (program.clone(), shader.clone());
    let thresholds = move |fragments: &[Fragment]| shader.thresholds(&program, fragments, &model);
    let subject = batched(name, variant, thresholds).with_remarks(move || its_shader.remarks(&its_program));
    if !has_scale {
        return Ok(subject);
    }
    // The noise size is an argument of the program, which stays what it is.
    Ok(subject.with_hash_scales(move |times, fragments| {
        let found = same_shader.rescaled(times).thresholds(&same_program, fragments, &model);
        widened(found)
    }))
}

/// Puts a hash in a shading language on trial in the interpreter: a function from three indices of a cell and its octave to 32
/// bits, of which the value v becomes the threshold (v + 1/2) / 2^32. All 32 bits count, where hashes of the list keep 23.
///
/// # Errors
///
/// [`ShaderError`], with its place: something in the shader is not interpreted.
pub fn interpreted_hash(
    name: impl Into<String>,
    shader: &OwnShader,
    model: DeviceModel,
) -> Result<Subject<'static>, ShaderError> {
    let program = shader.program()?;
    let shader = shader.clone();
    let (its_program, its_shader) = (program.clone(), shader.clone());
    let thresholds = move |fragments: &[Fragment]| {
        let hashes = shader.hashes(&program, fragments, &model).map_err(|error| error.to_string())?;
        Ok(hashes.into_iter().map(|word| (f64::from(word) + 0.5) / 4_294_967_296.0).collect())
    };
    let mut subject = Subject::batched(name, Precision::F64, Variant::Isotropic, thresholds);
    subject.bare_hash = true;
    Ok(subject.with_remarks(move || its_shader.remarks(&its_program)))
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
    let evaluator = crate::shader::gpu::Evaluator::new(device, shader)?;
    let subject = batched(name, variant, move |fragments: &[Fragment]| evaluator.thresholds(fragments));
    if shader.hash_scale().is_none() {
        return Ok(subject);
    }
    let (shader, device) = (shader.clone(), device.clone());
    Ok(subject.with_hash_scales(move |times, fragments| {
        let evaluator = crate::shader::gpu::Evaluator::new(&device, &shader.rescaled(times));
        widened(evaluator.map_err(|error| error.to_string())?.thresholds(fragments))
    }))
}

fn batched<E: core::fmt::Display>(
    name: impl Into<String>,
    variant: Variant,
    thresholds: impl Fn(&[Fragment]) -> Result<Vec<f32>, E> + Send + Sync + 'static,
) -> Subject<'static> {
    Subject::batched(name, Precision::F32, variant, move |fragments| widened(thresholds(fragments)))
}

fn widened<E: core::fmt::Display>(found: Result<Vec<f32>, E>) -> Result<Vec<f64>, String> {
    Ok(found.map_err(|error| error.to_string())?.into_iter().map(f64::from).collect())
}
