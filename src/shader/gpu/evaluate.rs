//! A shader's function, evaluated over fragments on a device.

use super::{Device, Error, Kernel, Program};
use crate::scene::Fragment;
use crate::shader::own::{OwnShader, ShaderError};

/// A shader, compiled for a device.
#[derive(Clone, Debug)]
pub struct Evaluator {
    program: Program,
    shader: OwnShader,
}

impl Evaluator {
    /// Compiles a shader.
    ///
    /// # Errors
    ///
    /// [`ShaderError`]: the shader cannot be said in WGSL, or the device does not take it.
    pub fn new(device: &Device, shader: &OwnShader) -> Result<Self, ShaderError> {
        let source = shader.wgsl()?;
        let expression = format!("array(bitcast<u32>({}))", shader.call());
        // A storage binding cannot be empty.
        let words = shader.words_per_fragment().max(1);
        let program = device.compile(&Kernel::of_words(&source, words, 1, &expression));
        let program = program.map_err(|error| shader.error_at(naga::Span::UNDEFINED, error.to_string()))?;
        Ok(Self { program, shader: shader.clone() })
    }

    /// Evaluates every fragment, its coordinates rounded to `f32`; in the order of the fragments.
    ///
    /// # Errors
    ///
    /// Those of [`Program::map`].
    pub fn thresholds(&self, fragments: &[Fragment]) -> Result<Vec<f32>, Error> {
        let mut words = self.shader.words(fragments);
        if words.is_empty() {
            words.resize(fragments.len(), 0);
        }
        Ok(self.program.map(&words)?.into_iter().map(f32::from_bits).collect())
    }
}
