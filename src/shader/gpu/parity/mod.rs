//! How far a device agrees with Rust, stage by stage.
//!
//! A stage is one step of a threshold or of what follows it. It is fed with what Rust computed for the stage before, so
//! that a difference shows where it arises and nowhere else. [`stages`] declares what each owes, [`DIFFERENCES`] which
//! devices are known to use the freedom that they have.

mod differences;
mod input;
mod report;
mod stages;

pub use differences::{DIFFERENCES, Difference, expected_difference};
pub use report::{Report, Row};
pub use stages::stages;

use super::{Device, Error, Kernel};
use crate::shader::assemble::assemble;
use crate::threshold::pipeline::Pipeline;

/// What a device owes at a stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Class {
    /// The same bits: only operations that the WGSL specification rounds correctly and that nothing can fuse.
    Bits,
    /// Close to it: within so many units in the last place of Rust's value, or within an absolute distance.
    Bounded {
        /// Units in the last place of Rust's value.
        ulp: f64,
        /// The distance that is allowed whatever the value.
        absolute: f64,
        /// How both follow from "Accuracy of Concrete Floating Point Expressions" of the WGSL specification.
        source: &'static str,
    },
    /// The same law on [0, 1], never the same value: it rests on a sine outside of [-pi, pi], of which the specification
    /// says nothing.
    Law,
}

/// One step of a threshold, on both sides.
#[derive(Clone, Copy, Debug)]
pub struct Stage {
    /// Its name in reports.
    pub name: &'static str,
    /// What a device owes.
    pub class: Class,
    /// What text the functions of the expression come from.
    pub pipeline: fn() -> Pipeline,
    /// WGSL over `word(k)` and `number(k)` that makes an array of words.
    pub expression: &'static str,
    /// Words of an input and of an output.
    pub words: [usize; 2],
    /// Appends the words of the input that belongs to an index.
    pub input: fn(u32, &mut Vec<u32>),
    /// Appends what Rust makes of one input: numbers, by their bits.
    pub reference: fn(&[u32], &mut Vec<f32>),
    /// A piece of the text and what to put in its place for a shader that is wrong, to see whether the comparison sees
    /// it.
    pub wrong: [&'static str; 2],
}

/// What came out of a stage on both sides.
#[derive(Clone, Debug, PartialEq)]
pub struct Outputs {
    /// The inputs, one behind the other.
    pub inputs: Vec<u32>,
    /// The device's numbers, in the order of the inputs.
    pub device: Vec<f32>,
    /// Rust's numbers. For [`Class::Law`] they belong to other inputs, drawn in the same way, so that the two samples
    /// are independent.
    pub rust: Vec<f32>,
}

/// How far two sides agree, value by value. A NaN agrees with any NaN and with nothing else.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// Number of values.
    pub values: usize,
    /// Share of the values that are equal in bits, in [0, 1].
    pub equal: f64,
    /// The greatest distance in units in the last place of Rust's value; infinite where one side alone is NaN.
    pub worst_ulp: f64,
    /// The greatest distance.
    pub worst_absolute: f64,
    /// Index of the input of `worst_ulp`; `None` where all bits are equal.
    pub worst_input: Option<usize>,
    /// Index of an input whose value breaks the bound of the class.
    pub violation: Option<usize>,
}

/// Makes words of a vector.
const THREE: &str = "
fn three(v: vec3<f32>) -> array<u32, 3> {
    return array(bitcast<u32>(v.x), bitcast<u32>(v.y), bitcast<u32>(v.z));
}
";

impl Stage {
    /// Returns the text of the device's side.
    ///
    /// # Errors
    ///
    /// [`Error::Validation`] for a pipeline without a text.
    pub fn kernel(&self) -> Result<Kernel, Error> {
        let source = assemble((self.pipeline)()).map_err(|error| Error::Validation(error.to_string()))?;
        let source = format!("{source}{THREE}");
        Ok(Kernel::of_words(&source, self.words[0], self.words[1], self.expression))
    }

    /// Returns the text with the stage's deliberate error.
    ///
    /// # Errors
    ///
    /// [`Error::Validation`] where the text has no such piece.
    pub fn wrong_kernel(&self) -> Result<Kernel, Error> {
        let mut kernel = self.kernel()?;
        let [right, wrong] = self.wrong;
        if !kernel.source.contains(right) {
            return Err(Error::Validation(format!("the text of {} has no `{right}`", self.name)));
        }
        kernel.source = kernel.source.replace(right, wrong);
        Ok(kernel)
    }

    /// Runs a kernel for this stage over inputs 0 to `count` and Rust beside it.
    ///
    /// # Errors
    ///
    /// Those of [`Program::map`](super::Program::map).
    pub fn outputs(&self, device: &Device, kernel: &Kernel, count: u32) -> Result<Outputs, Error> {
        let inputs = self.inputs(0..count);
        let made = device.compile(kernel)?.map(&inputs)?;
        let others = if self.class == Class::Law { self.inputs(count..2 * count) } else { inputs.clone() };
        let mut rust = Vec::with_capacity(made.len());
        for input in others.chunks(self.words[0]) {
            (self.reference)(input, &mut rust);
        }
        Ok(Outputs { inputs, device: made.into_iter().map(f32::from_bits).collect(), rust })
    }

    fn inputs(&self, indices: core::ops::Range<u32>) -> Vec<u32> {
        let mut words = Vec::with_capacity(indices.len() * self.words[0]);
        for index in indices {
            (self.input)(index, &mut words);
        }
        words
    }

    /// Compares both sides value by value; for [`Class::Law`] the numbers mean little, and nothing is a violation.
    #[must_use]
    pub fn agreement(&self, outputs: &Outputs) -> Agreement {
        let (mut equal, mut worst_ulp, mut worst_absolute) = (0_usize, 0.0_f64, 0.0_f64);
        let (mut worst_input, mut violation) = (None, None);
        for (index, (&device, &rust)) in outputs.device.iter().zip(&outputs.rust).enumerate() {
            if device.to_bits() == rust.to_bits() || device.is_nan() && rust.is_nan() {
                equal += 1;
                continue;
            }
            let input = index / self.words[1];
            // Infinite where one side is NaN or another infinity.
            let distance = (f64::from(device) - f64::from(rust)).abs();
            let distance = if distance.is_nan() { f64::INFINITY } else { distance };
            let ulps = distance / ulp(rust);
            if ulps >= worst_ulp {
                (worst_ulp, worst_input) = (ulps, Some(input));
            }
            worst_absolute = worst_absolute.max(distance);
            let is_within = match self.class {
                Class::Bits => false,
                Class::Bounded { ulp, absolute, .. } => ulps <= ulp || distance <= absolute,
                Class::Law => true,
            };
            if !is_within {
                violation = violation.or(Some(input));
            }
        }
        let values = outputs.device.len().max(outputs.rust.len());
        if outputs.device.len() != outputs.rust.len() {
            violation = Some(0);
        }
        let equal = equal as f64 / values.max(1) as f64;
        Agreement { values, equal, worst_ulp, worst_absolute, worst_input, violation }
    }
}

/// The distance from a number to the next one away from zero, of normal numbers; 2^-149 at and below 2^-126.
fn ulp(x: f32) -> f64 {
    let exponent = ((x.to_bits() >> 23) & 0xff).max(1);
    libm::exp2(f64::from(exponent) - 150.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ulp_is_the_distance_to_the_next_number() {
        for x in [1.0_f32, 1.5, 0.1, 3e-39, 1e30, 0.0] {
            assert_eq!(ulp(x), f64::from(f32::from_bits(x.to_bits() + 1)) - f64::from(x), "{x}");
        }
    }

    #[test]
    fn names_are_different_and_wrong_shaders_differ() {
        for (index, stage) in stages().enumerate() {
            assert!(stages().take(index).all(|other| other.name != stage.name), "{}", stage.name);
            assert_ne!(stage.kernel().unwrap(), stage.wrong_kernel().unwrap(), "{}", stage.name);
        }
    }

    #[test]
    fn differences_are_of_stages_that_may_differ() {
        for difference in DIFFERENCES {
            let stage = stages().find(|stage| stage.name == difference.stage).unwrap();
            assert_ne!(stage.class, Class::Bits, "{}", stage.name);
        }
    }

    #[test]
    fn agreement_counts_and_bounds() {
        let stage = Stage {
            class: Class::Bounded { ulp: 2.0, absolute: 0.0, source: "" },
            ..*stages().next().unwrap()
        };
        let one = |bits: u32| f32::from_bits(1.0_f32.to_bits() + bits);
        let of =
            |device: f32| stage.agreement(&Outputs { inputs: vec![], device: vec![device], rust: vec![1.0] });
        assert_eq!((of(1.0).equal, of(1.0).worst_input), (1.0, None));
        assert_eq!((of(one(2)).worst_ulp, of(one(2)).violation), (2.0, None));
        assert_eq!(of(one(3)).violation, Some(0));
        assert_eq!(of(f32::NAN).violation, Some(0));
    }
}
