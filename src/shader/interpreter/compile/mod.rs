//! From a naga function to steps on registers.
//!
//! Every value is taken apart into scalars, one register each, and every call is compiled in place: WGSL has no
//! recursion, so a pointer is then nothing but a variable and an offset that are known here.

mod access;
mod bits;
mod cast;
mod emit;
mod expression;
mod math;
mod matrix;
mod operator;
mod reuse;
mod statement;
mod types;

use super::columns::Kind;
use super::error::Unsupported;
use super::op::{Block, Product, Register};
use super::program::{Constant, Parameter, Program};
use super::undefined::UndefinedKind;
use core::ops::Range;
use core::sync::atomic::AtomicU64;
use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{Arena, Expression, Function, GlobalVariable, Handle, Module, Override, Span, TypeInner};
use std::collections::{HashMap, HashSet};

/// The largest number of registers: 32 MiB a thread.
const MOST_REGISTERS: u32 = 1 << 16;
/// The largest number of operations, every call counted in full.
const MOST_OPERATIONS: usize = 1 << 20;
/// How deeply calls and blocks may be nested; the machine recurses as deep.
const DEEPEST_NESTING: usize = 200;

/// A value: one register a scalar, in the order of its members, elements or columns.
type Value = Vec<Register>;

/// What a naga expression stands for.
#[derive(Clone)]
enum Operand {
    Value(Value),
    Pointer(Place),
}

/// A variable or a part of one.
#[derive(Clone, Copy)]
struct Place {
    /// The register of the part, but for the offset.
    first: Register,
    /// How many registers further on it is, a word a lane.
    offset: Option<Register>,
}

/// Where the expressions come from: a function, or the initial values of the module.
struct Scope<'a> {
    expressions: &'a Arena<Expression>,
    types: Types<'a>,
    arguments: Vec<Operand>,
    locals: Vec<Place>,
    operands: HashMap<Handle<Expression>, Operand>,
    exit: Exit,
}

enum Types<'a> {
    Function(&'a FunctionInfo),
    Module(&'a ModuleInfo),
}

/// What a return does.
enum Exit {
    /// It is the last thing in the function: its value is the value of the call.
    AtEnd(Value),
    /// The lanes write their value here and are gone until the end of the call.
    Anywhere(Value),
}

/// Everything that is known while a function is compiled.
struct Compiler<'a> {
    module: &'a Module,
    info: &'a ModuleInfo,
    registers: u32,
    operations: usize,
    nesting: usize,
    block: Block,
    /// Runs before the function: initial values of module variables, and overrides.
    prologue: Block,
    /// Registers of constants by their bits; floats apart, since a device rounds them.
    constants: HashMap<Constant, Register>,
    globals: HashMap<Handle<GlobalVariable>, Place>,
    overrides: HashMap<Handle<Override>, Value>,
    /// Registers of which one is chosen by an offset.
    arrays: Vec<Range<Register>>,
    /// Registers that hold a product.
    products: HashMap<Register, Product>,
    /// What can happen, and where; calls of a function count together.
    undefined: Vec<(UndefinedKind, Span)>,
}

/// Compiles a function or an entry point; see [`Program::compile`].
pub(super) fn compile(module: &Module, info: &ModuleInfo, name: &str) -> Result<Program, Unsupported> {
    let (function, function_info) = find(module, info, name)?;
    let mut compiler = Compiler {
        module,
        info,
        registers: 0,
        operations: 0,
        nesting: 0,
        block: Block::default(),
        prologue: Block::default(),
        constants: HashMap::new(),
        globals: HashMap::new(),
        overrides: HashMap::new(),
        arrays: Vec::new(),
        products: HashMap::new(),
        undefined: Vec::new(),
    };
    let (mut parameters, mut arguments, mut columns) = (Vec::new(), Vec::new(), Vec::new());
    for argument in &function.arguments {
        let ty = &module.types[argument.ty].inner;
        if matches!(ty, TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. }) {
            return Err(Unsupported::new("a parameter of the function itself cannot be a pointer"));
        }
        let components = compiler.kinds(ty)?;
        let value = compiler.allocate(components.len())?;
        columns.extend(&value);
        arguments.push(Operand::Value(value));
        parameters.push(Parameter { name: argument.name.clone().unwrap_or_default(), components });
    }
    let result = match &function.result {
        Some(result) => compiler.kinds(&module.types[result.ty].inner)?,
        None => Vec::new(),
    };
    let results = compiler.call(function, function_info, arguments)?;
    let mut body = compiler.prologue;
    body.0.append(&mut compiler.block.0);
    let mut constants: Vec<_> = compiler.constants.into_iter().map(|(word, to)| (to, word)).collect();
    constants.sort_unstable_by_key(|&(to, _)| to);
    let outside = columns.iter().chain(&results).copied().chain(constants.iter().map(|&(to, _)| to));
    let kept: HashSet<Register> = outside.chain(compiler.arrays.into_iter().flatten()).collect();
    let (renamed, registers) =
        reuse::reuse(&mut body, compiler.registers, |register| kept.contains(&register));
    let renamed = |register: Register| renamed[register as usize];
    Ok(Program {
        parameters,
        result,
        arguments: columns.into_iter().map(renamed).collect(),
        results: results.into_iter().map(renamed).collect(),
        constants: constants.into_iter().map(|(to, word)| (renamed(to), word)).collect(),
        body,
        registers: registers as usize,
        counts: compiler.undefined.iter().map(|_| AtomicU64::new(0)).collect(),
        undefined: compiler.undefined,
        steps: Program::DEFAULT_STEPS,
    })
}

fn find<'a>(
    module: &'a Module,
    info: &'a ModuleInfo,
    name: &str,
) -> Result<(&'a Function, &'a FunctionInfo), Unsupported> {
    let function = module.functions.iter().find(|(_, function)| function.name.as_deref() == Some(name));
    if let Some((handle, function)) = function {
        return Ok((function, &info[handle]));
    }
    match module.entry_points.iter().position(|entry_point| entry_point.name == name) {
        Some(index) => Ok((&module.entry_points[index].function, info.get_entry_point(index))),
        None => Err(Unsupported::new(format!("there is no function `{name}`"))),
    }
}

impl<'a> Scope<'a> {
    /// The scope of initial values.
    fn of_module(module: &'a Module, info: &'a ModuleInfo) -> Self {
        Self {
            expressions: &module.global_expressions,
            types: Types::Module(info),
            arguments: Vec::new(),
            locals: Vec::new(),
            operands: HashMap::new(),
            exit: Exit::AtEnd(Vec::new()),
        }
    }

    /// The type of an expression.
    fn ty<'t>(&'t self, module: &'t Module, expression: Handle<Expression>) -> &'t TypeInner {
        match self.types {
            Types::Function(info) => info[expression].ty.inner_with(&module.types),
            Types::Module(info) => info[expression].inner_with(&module.types),
        }
    }
}

/// Says in one word what a scalar is, or why it is not taken.
fn kind(scalar: naga::Scalar) -> Result<Kind, Unsupported> {
    use naga::ScalarKind;
    match (scalar.kind, scalar.width) {
        (ScalarKind::Float, 4) => Ok(Kind::F32),
        (ScalarKind::Sint, 4) => Ok(Kind::I32),
        (ScalarKind::Uint, 4) => Ok(Kind::U32),
        (ScalarKind::Bool, _) => Ok(Kind::Bool),
        (_, width) => Err(Unsupported::new(format!(
            "numbers of {} bits are not interpreted; use 32 bits",
            u32::from(width) * 8
        ))),
    }
}
