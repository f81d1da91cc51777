//! Runs a function of a validated naga module on many lanes at once, without a driver.
//!
//! Not in the paper. A function is compiled once ([`Program::compile`]) to operations on columns of 128 lanes and
//! then run on as many lanes as are wanted ([`Program::run`]), under the reference semantics or under a model of what
//! a device may make of it ([`DeviceModel`]).
//!
//! ```
//! use hashed_alpha::shader::interpreter::{Column, DeviceModel, Program, Values};
//!
//! let source = "fn ramp(x: f32, n: u32) -> f32 {
//!     var sum = 0.0;
//!     for (var i = 0u; i < n; i++) { sum += x; }
//!     return fract(sum);
//! }";
//! let module = naga::front::wgsl::parse_str(source)?;
//! let info = naga::valid::Validator::new(Default::default(), Default::default()).validate(&module)?;
//! let program = Program::compile(&module, &info, "ramp")?;
//! let columns = [Column::F32(&[0.25, 0.5, 0.75]), Column::U32(&[3])];
//! let result = program.run(&columns, 3, &DeviceModel::ACCURATE)?;
//! assert_eq!(result, [Values::F32(vec![0.75, 0.5, 0.25])]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! **What it takes**: all of WGSL that a function can do by itself with numbers of 32 bits and truth values: control
//! flow, calls, pointers, composites, private variables, constants, overrides with a default, every builtin of numbers
//! and bits. What it does not take is refused with its place ([`Unsupported`]): textures, buffers, atomics, barriers,
//! derivatives, `discard`, numbers of 16 or 64 bits.
//!
//! **What it means where WGSL leaves it open**: an index out of range is the last element. A float becomes an integer
//! towards zero and saturates, NaN becomes 0. `min`, `max` and `clamp` keep a NaN in their first argument and drop it
//! from the others, as [`Real`](crate::threshold::real::Real) does. `fract` is `x - floor(x)` and can be 1. `fma`
//! rounds once. `pow` of a negative number is NaN. Sums run from left to right. Of integers `x / 0` is `x`, `x % 0`
//! is 0, overflow wraps, and a shift takes the distance modulo 32. Lanes with an index out of range, or an integer that is
//! divided by zero, are counted ([`Program::undefined`]).
//!
//! **It ends**: a block of lanes has a number of steps ([`Program::steps`]); a loop that uses them up stops the run
//! and is named ([`Stopped::Endless`]).

mod columns;
mod compile;
mod error;
mod kernel;
mod lanes;
mod machine;
mod model;
mod op;
mod program;
mod undefined;

pub use columns::{Column, Kind, Values};
pub use error::{Stopped, Unsupported};
pub use model::DeviceModel;
pub use program::{Parameter, Program};
pub use undefined::{Undefined, UndefinedKind};

use core::ops::Not;
use core::sync::atomic::Ordering;
use lanes::{LANES, Lanes};
use machine::Machine;
use naga::Module;
use naga::valid::ModuleInfo;
use rayon::prelude::*;

impl Program {
    /// The steps of a new program: a thousand times those of a listing, a few hundredths of a second.
    pub const DEFAULT_STEPS: u64 = 1 << 20;

    /// Compiles a function, or an entry point, of a module that naga has validated.
    ///
    /// # Errors
    /// There is no such function, or something in it or in what it calls is not interpreted.
    pub fn compile(module: &Module, info: &ModuleInfo, function: &str) -> Result<Self, Unsupported> {
        compile::compile(module, info, function)
    }

    /// Returns the parameters in order.
    #[must_use]
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Returns the scalars of the result; none where the function returns nothing.
    #[must_use]
    pub fn result(&self) -> &[Kind] {
        &self.result
    }

    /// Returns what all runs so far met that the shading languages leave open, in the order of the function.
    #[must_use]
    pub fn undefined(&self) -> Vec<Undefined> {
        let found = self.undefined.iter().zip(&*self.counts).map(|(&(kind, span), count)| Undefined {
            kind,
            span,
            lanes: count.load(Ordering::Relaxed),
        });
        found.filter(|met| met.lanes > 0).collect()
    }

    /// Runs the function on lanes `0..lanes` and returns one column a scalar of the result.
    ///
    /// `columns` holds one column for every scalar of every parameter, in order; a column of one value is that value
    /// in every lane. The result does not depend on the number of threads.
    ///
    /// # Errors
    /// The columns do not fit the parameters, or a loop does not end.
    pub fn run(
        &self,
        columns: &[Column<'_>],
        lanes: usize,
        model: &DeviceModel,
    ) -> Result<Vec<Values>, Stopped> {
        self.check(columns, lanes)?;
        let width = self.results.len();
        let blocks = lanes.div_ceil(LANES);
        let mut words = vec![[0; LANES]; blocks * width];
        let run = |machine: &mut Machine<'_>, block: usize, words: &mut [[u32; LANES]]| {
            self.load(machine, columns, block * LANES, lanes);
            let beyond = LANES.saturating_sub(lanes - block * LANES);
            machine.wanted = Lanes::MAX >> beyond;
            machine.run(&self.body, self.steps)?;
            for (&register, words) in self.results.iter().zip(words) {
                for (word, lane) in words.iter_mut().zip(machine.column(register)) {
                    *word = lane.get();
                }
            }
            Ok::<(), machine::Endless>(())
        };
        // A function without a result runs too, for the loop that it may not leave.
        let mut nothing = vec![(); blocks];
        let outputs: Vec<&mut [[u32; LANES]]> = if width == 0 {
            nothing.iter_mut().map(|()| &mut [][..]).collect()
        } else {
            words.chunks_exact_mut(width).collect()
        };
        let endless = outputs
            .into_par_iter()
            .enumerate()
            .with_min_len(16)
            .map_init(|| self.machine(model), |machine, (block, words)| run(machine, block, words).err())
            .find_map_first(core::convert::identity);
        if let Some(endless) = endless {
            return Err(Stopped::Endless { span: endless.span, steps: self.steps });
        }
        let column = |(index, &kind): (usize, &Kind)| {
            let words = words.iter().skip(index).step_by(width).flatten().take(lanes);
            Values::collect(kind, words.copied())
        };
        Ok(self.result.iter().enumerate().map(column).collect())
    }

    /// Counts the operations that one run takes where the lanes of `columns` are one: arithmetic, comparisons, conversions and assignments of
    /// variables alike, those of loops as often as they are run.
    ///
    /// # Errors
    /// As [`Program::run`].
    pub fn operations(&self, columns: &[Column<'_>], model: &DeviceModel) -> Result<u64, Stopped> {
        self.check(columns, 1)?;
        let mut machine = self.machine(model);
        self.load(&machine, columns, 0, 1);
        machine.wanted = 1;
        machine
            .run(&self.body, self.steps)
            .map_err(|endless| Stopped::Endless { span: endless.span, steps: self.steps })?;
        Ok(self.steps - machine.steps_left())
    }

    /// Writes arguments from lane `start` on into their registers.
    fn load(&self, machine: &Machine<'_>, columns: &[Column<'_>], start: usize, lanes: usize) {
        for (&register, column) in self.arguments.iter().zip(columns) {
            column.load(start, lanes, machine.column(register));
            if column.kind() == Kind::F32 {
                machine.round(register);
            }
        }
    }

    /// The registers of a thread, constants filled in.
    fn machine<'a>(&'a self, model: &'a DeviceModel) -> Machine<'a> {
        let machine = Machine::new(self.registers, model, &self.counts);
        for &(register, constant) in &self.constants {
            machine.fill(register, constant.bits);
            if constant.float {
                machine.round(register);
            }
        }
        machine
    }

    /// Says which column does not fit.
    fn check(&self, columns: &[Column<'_>], lanes: usize) -> Result<(), Stopped> {
        let wanted = self.parameters.iter().flat_map(|parameter| &parameter.components).count();
        if columns.len() != wanted {
            let message =
                format!("the parameters have {wanted} scalars, but there are {} columns", columns.len());
            return Err(Stopped::Arguments(message));
        }
        let scalars =
            self.parameters.iter().flat_map(|p| p.components.iter().map(move |&kind| (&p.name, kind)));
        for ((name, kind), column) in scalars.zip(columns) {
            if column.kind() != kind {
                let message = format!("parameter `{name}` wants {kind}, not {}", column.kind());
                return Err(Stopped::Arguments(message));
            }
            if (column.len() == 1 || column.len() == lanes).not() {
                let message = format!("parameter `{name}` has {} values for {lanes} lanes", column.len());
                return Err(Stopped::Arguments(message));
            }
        }
        Ok(())
    }
}
