//! From fragments to the values of parameters: as columns for the interpreter, as words for a device.

use super::error::Fault;
use super::isolated::isolated;
use super::{Binding, Input, OwnShader, ShaderError, Value};
use crate::scene::fragment::Fragment;
use crate::shader::interpreter::{Column, DeviceModel, Program, Stopped, Undefined, Values};
use crate::threshold::robust::scales;
use core::fmt::Write as _;

impl Input {
    /// Returns one of the words that it takes in a fragment, one a scalar; floats by their bits, rounded to nearest. A
    /// constant has none.
    fn word(self, fragment: &Fragment, component: usize) -> u32 {
        let float = |value: f64| (value as f32).to_bits();
        let footprint = &fragment.footprint;
        match self {
            Self::Position => float(footprint.position[component]),
            Self::Dpdx => float(footprint.dpdx[component]),
            Self::Dpdy => float(footprint.dpdy[component]),
            Self::Pixel => float(fragment.pixel[component]),
            Self::Texcoord => float(fragment.texcoord[component]),
            Self::Lod => float(fragment.lod),
            Self::Frame => fragment.frame,
            Self::Layer => fragment.layer,
            Self::Cell => scales::only_cell(footprint).words()[component],
            Self::Constant(_) => 0,
        }
    }

    /// Appends the values that it takes in fragments to its columns, one a scalar; those of a constant are there.
    fn append(self, fragments: &[Fragment], columns: &mut [Values]) {
        fn floats<const N: usize>(
            fragments: &[Fragment],
            columns: &mut [Values],
            read: impl Fn(&Fragment) -> [f64; N],
        ) {
            for (component, column) in columns.iter_mut().enumerate() {
                if let Values::F32(column) = column {
                    column.extend(fragments.iter().map(|fragment| read(fragment)[component] as f32));
                }
            }
        }
        fn words<const N: usize>(
            fragments: &[Fragment],
            columns: &mut [Values],
            read: impl Fn(&Fragment) -> [u32; N],
        ) {
            for fragment in fragments {
                for (column, word) in columns.iter_mut().zip(read(fragment)) {
                    if let Values::U32(column) = column {
                        column.push(word);
                    }
                }
            }
        }
        match self {
            Self::Position => floats(fragments, columns, |f| f.footprint.position.to_array()),
            Self::Dpdx => floats(fragments, columns, |f| f.footprint.dpdx.to_array()),
            Self::Dpdy => floats(fragments, columns, |f| f.footprint.dpdy.to_array()),
            Self::Pixel => floats(fragments, columns, |f| f.pixel.into()),
            Self::Texcoord => floats(fragments, columns, |f| f.texcoord.into()),
            Self::Lod => floats(fragments, columns, |f| [f.lod]),
            Self::Frame => words(fragments, columns, |f| [f.frame]),
            Self::Layer => words(fragments, columns, |f| [f.layer]),
            Self::Cell => words(fragments, columns, |f| scales::only_cell(&f.footprint).words()),
            Self::Constant(_) => {}
        }
    }

    /// The number of words that differ from fragment to fragment.
    const fn size(self) -> usize {
        match self {
            Self::Cell => 4,
            Self::Position | Self::Dpdx | Self::Dpdy => 3,
            Self::Pixel | Self::Texcoord => 2,
            Self::Lod | Self::Frame | Self::Layer => 1,
            Self::Constant(_) => 0,
        }
    }
}

/// A column of one value, which is that of every fragment.
fn constant_column(value: Value) -> Values {
    match value {
        Value::F32(value) => Values::F32(vec![value]),
        Value::I32(value) => Values::I32(vec![value]),
        Value::U32(value) => Values::U32(vec![value]),
        Value::Bool(value) => Values::Bool(vec![value]),
    }
}

impl OwnShader {
    /// Makes the function ready for the interpreter.
    ///
    /// # Errors
    ///
    /// [`ShaderError`]: it uses something that is not interpreted.
    pub fn program(&self) -> Result<Program, ShaderError> {
        Program::compile(&self.module, &self.info, &self.function)
            .map_err(|error| self.error_at(error.span, error.message))
    }

    /// Returns the values of every parameter as columns for [`Program::run`]: one a scalar, of one value where it is the
    /// same in every fragment.
    #[must_use]
    pub fn columns(&self, fragments: &[Fragment]) -> Vec<Values> {
        /// Fragments that stay in the first cache while all columns are filled from them.
        const AT_ONCE: usize = 128;
        let empty = |binding: &Binding| match binding.input {
            Input::Constant(constant) => {
                constant.components().iter().map(|&value| constant_column(value)).collect()
            }
            Input::Frame | Input::Layer | Input::Cell => {
                (0..binding.input.size()).map(|_| Values::U32(Vec::with_capacity(fragments.len()))).collect()
            }
            Input::Position | Input::Dpdx | Input::Dpdy | Input::Pixel | Input::Texcoord | Input::Lod => {
                (0..binding.input.size()).map(|_| Values::F32(Vec::with_capacity(fragments.len()))).collect()
            }
        };
        let mut columns: Vec<Vec<Values>> = self.bindings.iter().map(empty).collect();
        for fragments in fragments.chunks(AT_ONCE) {
            for (binding, columns) in self.bindings.iter().zip(&mut columns) {
                binding.input.append(fragments, columns);
            }
        }
        columns.into_iter().flatten().collect()
    }

    /// Runs the function, made ready by [`OwnShader::program`], on every fragment.
    ///
    /// # Errors
    ///
    /// [`ShaderError`]: a loop that does not end, with its place.
    pub fn thresholds(
        &self,
        program: &Program,
        fragments: &[Fragment],
        model: &DeviceModel,
    ) -> Result<Vec<f32>, ShaderError> {
        match self.run(program, fragments, model)? {
            Some(Values::F32(thresholds)) => Ok(thresholds),
            _ => Err(self.another_program()),
        }
    }

    /// Whether it is a hash: a function from one `vec4<u32>`, three indices of a cell and its octave, to `u32`.
    #[must_use]
    pub fn is_hash(&self) -> bool {
        matches!(self.bindings.as_slice(), [Binding { input: Input::Cell, .. }])
    }

    /// Runs a hash, made ready by [`OwnShader::program`], on the coarse cell of every fragment.
    ///
    /// # Errors
    ///
    /// [`ShaderError`]: a loop that does not end, with its place; a function that is no hash.
    pub fn hashes(
        &self,
        program: &Program,
        fragments: &[Fragment],
        model: &DeviceModel,
    ) -> Result<Vec<u32>, ShaderError> {
        match self.run(program, fragments, model)? {
            Some(Values::U32(hashes)) => Ok(hashes),
            _ => Err(self.another_program()),
        }
    }

    fn another_program(&self) -> ShaderError {
        let message = "it is the program of another function".to_owned();
        ShaderError { file: self.file.clone(), place: None, message, is_absent: false }
    }

    /// Counts the operations that the function, made ready by [`OwnShader::program`], takes for a fragment: arithmetic,
    /// comparisons, conversions and assignments of variables alike, and a sine as one.
    ///
    /// # Errors
    ///
    /// [`ShaderError`]: a loop that does not end, with its place.
    pub fn operations(&self, program: &Program, fragment: Fragment) -> Result<u64, ShaderError> {
        let values = self.columns(&[fragment]);
        let columns: Vec<_> = values.iter().map(as_column).collect();
        program.operations(&columns, &DeviceModel::ACCURATE).map_err(|stopped| self.stopped(&stopped))
    }

    /// Says where and why a run ended.
    fn stopped(&self, stopped: &Stopped) -> ShaderError {
        let place = match *stopped {
            Stopped::Endless { span, .. } => self.place(span),
            Stopped::Arguments(_) => None,
        };
        ShaderError { file: self.file.clone(), place, message: stopped.to_string(), is_absent: false }
    }

    /// Runs the function; its result is the last of the values that come back.
    fn run(
        &self,
        program: &Program,
        fragments: &[Fragment],
        model: &DeviceModel,
    ) -> Result<Option<Values>, ShaderError> {
        let values = self.columns(fragments);
        let columns: Vec<_> = values.iter().map(as_column).collect();
        match program.run(&columns, fragments.len(), model) {
            Ok(mut results) => Ok(results.pop()),
            Err(stopped) => Err(self.stopped(&stopped)),
        }
    }

    /// Returns what a program of [`OwnShader::program`] did so far that shading languages leave open, each with its place and
    /// the number of evaluations.
    #[must_use]
    pub fn remarks(&self, program: &Program) -> Vec<String> {
        let said = |Undefined { kind, span, lanes }| {
            let error = self.error_at(span, kind.to_string());
            format!("{error} ({lanes} times)")
        };
        program.undefined().into_iter().map(said).collect()
    }

    /// Returns the module as WGSL text without bindings and entry points, whatever its language was.
    ///
    /// # Errors
    ///
    /// [`ShaderError`]: the module cannot be said in WGSL.
    pub fn wgsl(&self) -> Result<String, ShaderError> {
        let (module, info) = (self.module.clone(), self.info.clone());
        isolated(move || {
            let flags = naga::back::wgsl::WriterFlags::empty();
            naga::back::wgsl::write_string(&module, &info, flags)
                .map_err(|error| Fault::new(format!("it cannot be written as WGSL: {error}")))
        })
        .map_err(|Fault { message, .. }| ShaderError {
            file: self.file.clone(),
            place: None,
            message,
            is_absent: false,
        })
    }

    /// Returns the number of words that a device is sent for one fragment; constants are not sent.
    #[must_use]
    pub fn words_per_fragment(&self) -> usize {
        self.bindings.iter().map(|binding| binding.input.size()).sum()
    }

    /// Returns the words that a device is sent, fragment by fragment.
    #[must_use]
    pub fn words(&self, fragments: &[Fragment]) -> Vec<u32> {
        let mut words = Vec::with_capacity(fragments.len() * self.words_per_fragment());
        for fragment in fragments {
            for Binding { input, .. } in &self.bindings {
                words.extend((0..input.size()).map(|component| input.word(fragment, component)));
            }
        }
        words
    }

    /// Returns the call of the function in WGSL; it reads the k-th word of its fragment as `word(k)`, as a float
    /// `number(k)`.
    #[must_use]
    pub fn call(&self) -> String {
        let mut call = format!("{}(", self.function);
        let mut first = 0;
        for Binding { input, .. } in &self.bindings {
            let numbers: Vec<_> = (first..first + input.size()).map(|k| format!("number({k}u)")).collect();
            // Writing to a string cannot fail.
            let _ = match input {
                Input::Frame | Input::Layer => write!(call, "word({first}u), "),
                Input::Constant(constant) => write!(call, "{}, ", constant.wgsl()),
                Input::Cell => {
                    let words: Vec<_> = (first..first + 4).map(|k| format!("word({k}u)")).collect();
                    write!(call, "vec4<u32>({}), ", words.join(", "))
                }
                _ if numbers.len() == 1 => write!(call, "{}, ", numbers[0]),
                _ => write!(call, "vec{}<f32>({}), ", numbers.len(), numbers.join(", ")),
            };
            first += input.size();
        }
        call.push(')');
        call
    }
}

fn as_column(values: &Values) -> Column<'_> {
    match values {
        Values::F32(values) => Column::F32(values),
        Values::I32(values) => Column::I32(values),
        Values::U32(values) => Column::U32(values),
        Values::Bool(values) => Column::Bool(values),
    }
}
