//! Variables, and the parts of variables and values.

use super::super::error::Unsupported;
use super::super::op::{Binary, Op, Register, Unary};
use super::super::undefined::UndefinedKind;
use super::{Compiler, Operand, Place, Scope, Value};
use naga::{AddressSpace, Expression, GlobalVariable, Handle, Span};

type Result<T> = core::result::Result<T, Unsupported>;

impl<'a> Compiler<'a> {
    /// The variable of a module, which each lane has for itself.
    pub(super) fn global(&mut self, handle: Handle<GlobalVariable>) -> Result<Place> {
        if let Some(&place) = self.globals.get(&handle) {
            return Ok(place);
        }
        let variable = &self.module.global_variables[handle];
        let name = variable.name.as_deref().unwrap_or("without a name");
        let what = match variable.space {
            AddressSpace::Private => None,
            AddressSpace::Uniform => Some("a uniform buffer"),
            AddressSpace::Storage { .. } => Some("a storage buffer"),
            AddressSpace::Handle => Some("a texture or sampler"),
            AddressSpace::WorkGroup => Some("shared by a workgroup"),
            _ => Some("outside of the shader"),
        };
        if let Some(what) = what {
            return Err(Unsupported::new(format!("variable `{name}` is {what}, which is not interpreted")));
        }
        let size = self.size_of(variable.ty)?;
        let registers = self.allocate(size)?;
        let place = Place { first: registers.first().copied().unwrap_or_default(), offset: None };
        self.globals.insert(handle, place);
        self.before(|compiler| {
            let initial = match variable.init {
                Some(init) => compiler.value(&mut Scope::of_module(compiler.module, compiler.info), init)?,
                None => vec![compiler.word(0)?; size],
            };
            for (&to, from) in registers.iter().zip(initial) {
                compiler.push(Op::Unary { function: Unary::Copy, to, from })?;
            }
            Ok(())
        })?;
        Ok(place)
    }

    /// Compiles something that runs before the function.
    pub(super) fn before<T>(&mut self, compile: impl FnOnce(&mut Self) -> Result<T>) -> Result<T> {
        core::mem::swap(&mut self.block, &mut self.prologue);
        let result = compile(self);
        core::mem::swap(&mut self.block, &mut self.prologue);
        result
    }

    /// Reads a variable. The value is copied, since the variable may change before it is used.
    pub(super) fn load(&mut self, place: Place, size: usize) -> Result<Value> {
        let registers = self.allocate(size)?;
        for (&to, from) in registers.iter().zip(place.first..) {
            self.push(match place.offset {
                None => Op::Unary { function: Unary::Copy, to, from },
                Some(offset) => Op::Gather { to, first: from, offset },
            })?;
        }
        Ok(registers)
    }

    pub(super) fn store(&mut self, place: Place, value: &[Register]) -> Result<()> {
        for (&from, to) in value.iter().zip(place.first..) {
            self.push(match place.offset {
                None => Op::Store { to, from },
                Some(offset) => Op::Scatter { first: to, offset, from },
            })?;
        }
        Ok(())
    }

    /// A member or an element that is known beforehand.
    pub(super) fn access_index(
        &mut self,
        scope: &mut Scope<'a>,
        base: Handle<Expression>,
        index: u32,
    ) -> Result<Operand> {
        let ty = self.pointee(scope.ty(self.module, base));
        let (start, size) = self.member(&ty, index)?;
        Ok(match self.operand(scope, base)? {
            Operand::Value(value) => Operand::Value(value[start..start + size].to_vec()),
            Operand::Pointer(place) => {
                Operand::Pointer(Place { first: place.first + start as Register, ..place })
            }
        })
    }

    /// An element that is computed. An index out of range, a negative one too, means the last element.
    pub(super) fn access(
        &mut self,
        scope: &mut Scope<'a>,
        base: Handle<Expression>,
        index: Handle<Expression>,
        span: Span,
    ) -> Result<Operand> {
        let ty = self.pointee(scope.ty(self.module, base));
        let (count, size) = self.elements(&ty)?;
        let index = self.scalar(scope, index)?;
        let last = self.word(count - 1)?;
        if self.known(index).is_none_or(|index| index >= count) {
            let odd = self.binary(Binary::LessUnsigned, last, index)?;
            self.count(odd, UndefinedKind::Index, span)?;
        }
        let clamped = self.binary(Binary::MinUnsigned, index, last)?;
        let stride = self.word(size as u32)?;
        let offset = self.binary(Binary::MultiplyInteger, clamped, stride)?;
        match self.operand(scope, base)? {
            Operand::Pointer(place) => {
                let offset = match place.offset {
                    Some(outer) => self.binary(Binary::AddInteger, outer, offset)?,
                    None => offset,
                };
                self.arrays.push(place.first..place.first + count * size as Register);
                Ok(Operand::Pointer(Place { offset: Some(offset), ..place }))
            }
            Operand::Value(value) => {
                let registers = self.allocate(value.len())?;
                for (&to, from) in registers.iter().zip(value) {
                    self.push(Op::Unary { function: Unary::Copy, to, from })?;
                }
                let first = registers.first().copied().unwrap_or_default();
                self.arrays.push(first..first + registers.len() as Register);
                self.load(Place { first, offset: Some(offset) }, size).map(Operand::Value)
            }
        }
    }
}
