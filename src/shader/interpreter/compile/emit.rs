//! Operations, one a function; each gives its result a register of its own.

use super::super::error::Unsupported;
use super::super::op::{Binary, Contracted, Op, Product, Register, Unary};
use super::super::program::Constant;
use super::super::undefined::UndefinedKind;
use super::{Compiler, MOST_OPERATIONS, MOST_REGISTERS, Value};
use naga::Span;

type Result<T> = core::result::Result<T, Unsupported>;

impl Compiler<'_> {
    /// Refuses more registers than there may be.
    pub(super) fn check_size(&self, more: usize) -> Result<()> {
        if more > (MOST_REGISTERS - self.registers) as usize {
            return Err(Unsupported::new(format!(
                "variables and values of more than {MOST_REGISTERS} scalars are not interpreted"
            )));
        }
        Ok(())
    }

    /// Returns new registers, one after the other.
    pub(super) fn allocate(&mut self, count: usize) -> Result<Value> {
        self.check_size(count)?;
        let first = self.registers;
        self.registers += count as u32;
        Ok((first..self.registers).collect())
    }

    fn register(&mut self) -> Result<Register> {
        self.check_size(1)?;
        self.registers += 1;
        Ok(self.registers - 1)
    }

    pub(super) fn push(&mut self, op: Op) -> Result<()> {
        self.operations += 1;
        if self.operations > MOST_OPERATIONS {
            return Err(Unsupported::new(format!(
                "more than {MOST_OPERATIONS} operations, calls included, are not interpreted"
            )));
        }
        self.block.compute(op);
        Ok(())
    }

    /// The register of a constant word that is no float.
    pub(super) fn word(&mut self, bits: u32) -> Result<Register> {
        self.constant(Constant { bits, float: false })
    }

    pub(super) fn float(&mut self, value: f32) -> Result<Register> {
        self.constant(Constant { bits: value.to_bits(), float: true })
    }

    fn constant(&mut self, constant: Constant) -> Result<Register> {
        if let Some(&register) = self.constants.get(&constant) {
            return Ok(register);
        }
        let register = self.register()?;
        self.constants.insert(constant, register);
        Ok(register)
    }

    /// Counts the lanes in which `odd` is true.
    pub(super) fn count(&mut self, odd: Register, kind: UndefinedKind, span: Span) -> Result<()> {
        let known = self.undefined.iter().position(|&known| known == (kind, span));
        let met = known.unwrap_or_else(|| {
            self.undefined.push((kind, span));
            self.undefined.len() - 1
        });
        self.push(Op::Count { odd, met })
    }

    /// The word that a register holds in all lanes, where that is known here.
    pub(super) fn known(&self, register: Register) -> Option<u32> {
        self.constants.iter().find(|&(_, &constant)| constant == register).map(|(constant, _)| constant.bits)
    }

    pub(super) fn unary(&mut self, function: Unary, from: Register) -> Result<Register> {
        let to = self.register()?;
        self.push(Op::Unary { function, to, from })?;
        Ok(to)
    }

    pub(super) fn binary(&mut self, function: Binary, left: Register, right: Register) -> Result<Register> {
        let to = self.register()?;
        self.push(Op::Binary { function, to, left, right })?;
        Ok(to)
    }

    pub(super) fn select(
        &mut self,
        condition: Register,
        accept: Register,
        reject: Register,
    ) -> Result<Register> {
        let to = self.register()?;
        self.push(Op::Select { to, condition, accept, reject })?;
        Ok(to)
    }

    pub(super) fn fma(&mut self, arguments: [Register; 3]) -> Result<Register> {
        let to = self.register()?;
        self.push(Op::Fma { to, arguments })?;
        Ok(to)
    }

    pub(super) fn negate(&mut self, from: Register) -> Result<Register> {
        let to = self.unary(Unary::Negate, from)?;
        if let Some(&product) = self.products.get(&from) {
            self.products.insert(to, Product { negated: !product.negated, ..product });
        }
        Ok(to)
    }

    pub(super) fn multiply(&mut self, left: Register, right: Register) -> Result<Register> {
        let to = self.binary(Binary::Multiply, left, right)?;
        self.products.insert(to, Product { factors: [left, right], negated: false });
        Ok(to)
    }

    pub(super) fn add(&mut self, left: Register, right: Register) -> Result<Register> {
        self.sum(Binary::Add, left, right)
    }

    pub(super) fn subtract(&mut self, left: Register, right: Register) -> Result<Register> {
        self.sum(Binary::Subtract, left, right)
    }

    /// A sum or difference; of two products the left one stays exact where the device contracts.
    fn sum(&mut self, function: Binary, left: Register, right: Register) -> Result<Register> {
        let subtract = function == Binary::Subtract;
        let products = [left, right].map(|register| self.products.get(&register).copied());
        let contracted = match products {
            [Some(product), _] => Contracted { product, addend: right, negate_addend: subtract },
            [None, Some(product)] => Contracted {
                product: Product { negated: product.negated != subtract, ..product },
                addend: left,
                negate_addend: false,
            },
            [None, None] => return self.binary(function, left, right),
        };
        let to = self.register()?;
        self.push(Op::Sum { function, to, left, right, contracted })?;
        Ok(to)
    }

    pub(super) fn divide(&mut self, left: Register, right: Register) -> Result<Register> {
        self.binary(Binary::Divide, left, right)
    }

    pub(super) fn min(&mut self, left: Register, right: Register) -> Result<Register> {
        self.binary(Binary::Min, left, right)
    }

    pub(super) fn max(&mut self, left: Register, right: Register) -> Result<Register> {
        self.binary(Binary::Max, left, right)
    }

    /// The sum of the products of the components, from left to right.
    pub(super) fn dot(&mut self, left: &[Register], right: &[Register]) -> Result<Register> {
        let mut sum = None;
        for (&left, &right) in left.iter().zip(right) {
            let product = self.multiply(left, right)?;
            sum = Some(match sum {
                Some(sum) => self.add(sum, product)?,
                None => product,
            });
        }
        sum.ok_or_else(|| Unsupported::new("a vector without components"))
    }

    /// The root of the sum of squares; of a scalar its absolute value.
    pub(super) fn length(&mut self, value: &[Register]) -> Result<Register> {
        if let &[only] = value {
            return self.unary(Unary::Abs, only);
        }
        let squared = self.dot(value, value)?;
        self.unary(Unary::Sqrt, squared)
    }

    /// Applies a function of one scalar to every component.
    pub(super) fn each(
        &mut self,
        value: &[Register],
        mut f: impl FnMut(&mut Self, Register) -> Result<Register>,
    ) -> Result<Value> {
        value.iter().map(|&component| f(self, component)).collect()
    }

    /// Applies a function of two scalars to every pair of components; a scalar goes with every component.
    pub(super) fn each_2(
        &mut self,
        left: &[Register],
        right: &[Register],
        mut f: impl FnMut(&mut Self, Register, Register) -> Result<Register>,
    ) -> Result<Value> {
        let count = left.len().max(right.len());
        (0..count).map(|i| f(self, component(left, i), component(right, i))).collect()
    }

    /// The same for three.
    pub(super) fn each_3(
        &mut self,
        [a, b, c]: [&[Register]; 3],
        mut f: impl FnMut(&mut Self, Register, Register, Register) -> Result<Register>,
    ) -> Result<Value> {
        let count = a.len().max(b.len()).max(c.len());
        (0..count).map(|i| f(self, component(a, i), component(b, i), component(c, i))).collect()
    }
}

/// A component of a vector, or the scalar that stands for all; a value has at least one.
fn component(value: &[Register], index: usize) -> Register {
    if value.len() == 1 { value[0] } else { value[index] }
}
