//! A function `threshold` in WGSL, evaluated over fragments.

use super::{Device, Error, Kernel, Program};
use crate::scene::Fragment;
use crate::shader::assemble::{self, Parameter, ShaderOptions, assemble};

/// A function `threshold`, compiled for a device.
#[derive(Clone, Debug)]
pub struct Evaluator {
    program: Program,
    pack: Vec<fn(&Fragment, &Constants, &mut Vec<u32>)>,
    constants: Constants,
}

/// What a function may ask for and no fragment knows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constants {
    /// Size of the noise in pixels, above 0.
    pub hash_scale: f32,
    /// Index of the sample within the pixel.
    pub sample_index: u32,
}

impl Default for Constants {
    /// A noise of one pixel, the first sample.
    fn default() -> Self {
        Self { hash_scale: 1.0, sample_index: 0 }
    }
}

impl Evaluator {
    /// Compiles WGSL text that holds `fn threshold(...) -> f32` with these parameters, and no binding or entry point.
    ///
    /// # Errors
    ///
    /// [`Error::Validation`] for text that is not valid and for a parameter that a fragment does not know (the lengths
    /// of the texture coordinate's derivatives); those of a lost device.
    pub fn new(
        device: &Device,
        source: &str,
        parameters: &[Parameter],
        constants: Constants,
    ) -> Result<Self, Error> {
        let (mut pack, mut arguments, mut words) = (Vec::new(), Vec::new(), 0);
        for &parameter in parameters {
            let Some(packed) = packing(parameter) else {
                return Err(Error::Validation(format!("a fragment has no `{}`", parameter.name)));
            };
            let (argument, taken) = argument(parameter.wgsl_type, words)
                .ok_or_else(|| Error::Validation(format!("a parameter of type {}", parameter.wgsl_type)))?;
            arguments.push(argument);
            words += taken;
            pack.push(packed);
        }
        let expression = format!("array(bitcast<u32>(threshold({})))", arguments.join(", "));
        let kernel = Kernel::of_words(source, words.max(1), 1, &expression);
        Ok(Self { program: device.compile(&kernel)?, pack, constants })
    }

    /// Compiles the assembled text of `options`.
    ///
    /// # Errors
    ///
    /// Those of [`Evaluator::new`]; [`Error::Validation`] for options that cannot be written.
    pub fn assembled(device: &Device, options: &ShaderOptions, constants: Constants) -> Result<Self, Error> {
        let source = assemble(options).map_err(|error| Error::Validation(error.to_string()))?;
        Self::new(device, &source, &options.parameters(), constants)
    }

    /// Evaluates every fragment, its coordinates rounded to `f32`; in the order of the fragments.
    ///
    /// # Errors
    ///
    /// Those of [`Program::map`].
    pub fn thresholds(&self, fragments: &[Fragment]) -> Result<Vec<f32>, Error> {
        let mut words = Vec::new();
        for fragment in fragments {
            let before = words.len();
            for pack in &self.pack {
                pack(fragment, &self.constants, &mut words);
            }
            if words.len() == before {
                // A function without parameters; a storage binding cannot be empty.
                words.push(0);
            }
        }
        Ok(self.program.map(&words)?.into_iter().map(f32::from_bits).collect())
    }
}

/// How a fragment fills a parameter; `None` where it cannot.
fn packing(parameter: Parameter) -> Option<fn(&Fragment, &Constants, &mut Vec<u32>)> {
    Some(match parameter {
        assemble::POSITION => |f, _, words| push(words, f.footprint.position.to_array()),
        assemble::DPDX => |f, _, words| push(words, f.footprint.dpdx.to_array()),
        assemble::DPDY => |f, _, words| push(words, f.footprint.dpdy.to_array()),
        assemble::PIXEL => |f, _, words| push(words, f.pixel.to_array()),
        assemble::LOD => |f, _, words| push(words, [f.lod]),
        assemble::FRAME => |f, _, words| words.push(f.frame),
        assemble::LAYER => |f, _, words| words.push(f.layer),
        assemble::HASH_SCALE => |_, constants, words| words.push(constants.hash_scale.to_bits()),
        assemble::SAMPLE_INDEX => |_, constants, words| words.push(constants.sample_index),
        _ => return None,
    })
}

fn push<const N: usize>(words: &mut Vec<u32>, numbers: [f64; N]) {
    words.extend(numbers.map(|number| (number as f32).to_bits()));
}

/// The expression that reads an argument of this type from word `first` on, and the number of its words.
fn argument(wgsl_type: &str, first: usize) -> Option<(String, usize)> {
    let numbers = |count: usize| {
        let list: Vec<_> = (first..first + count).map(|k| format!("number({k}u)")).collect();
        format!("vec{count}<f32>({})", list.join(", "))
    };
    match wgsl_type {
        "f32" => Some((format!("number({first}u)"), 1)),
        "u32" => Some((format!("word({first}u)"), 1)),
        "vec2<f32>" => Some((numbers(2), 2)),
        "vec3<f32>" => Some((numbers(3), 3)),
        _ => None,
    }
}
