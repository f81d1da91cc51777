//! Builtin functions of floats. WGSL derives many from others; they are taken apart in the same way, so that every
//! step is one operation of the device.

use super::super::error::Unsupported;
use super::super::op::{Binary, Register, Unary};
use super::types::scalar_kind;
use super::{Compiler, Value};
use naga::{MathFunction, ScalarKind, TypeInner};

type Result<T> = core::result::Result<T, Unsupported>;

impl Compiler<'_> {
    /// Compiles a builtin function; `ty` is the type of its first argument.
    pub(super) fn math(
        &mut self,
        function: MathFunction,
        ty: &TypeInner,
        arguments: &[Value],
    ) -> Result<Value> {
        if arguments.len() != function.argument_count() {
            return Err(Unsupported::new("a builtin function with a wrong number of arguments"));
        }
        let kind = scalar_kind(ty)?;
        if kind == ScalarKind::Float {
            self.float_math(function, ty, arguments)
        } else {
            self.integer_math(function, kind == ScalarKind::Sint, arguments)
        }
    }

    fn float_math(&mut self, function: MathFunction, ty: &TypeInner, arguments: &[Value]) -> Result<Value> {
        use MathFunction as M;
        if let Some(function) = one_to_one(function) {
            return self.each(&arguments[0], |c, x| c.unary(function, x));
        }
        match (function, arguments) {
            (M::Min, [a, b]) => self.each_2(a, b, Self::min),
            (M::Max, [a, b]) => self.each_2(a, b, Self::max),
            (M::Pow, [a, b]) => self.each_2(a, b, |c, x, y| c.binary(Binary::Pow, x, y)),
            (M::Atan2, [a, b]) => self.each_2(a, b, |c, y, x| c.binary(Binary::Atan2, y, x)),
            (M::Ldexp, [a, b]) => self.each_2(a, b, |c, x, e| c.binary(Binary::Ldexp, x, e)),
            (M::Clamp, [x, low, high]) => self.each_3([x, low, high], Self::clamp),
            (M::Saturate, [x]) => {
                let (zero, one) = (self.float(0.0)?, self.float(1.0)?);
                self.each(x, |c, x| c.clamp(x, zero, one))
            }
            (M::Tan, [x]) => self.each(x, |c, x| {
                let (sine, cosine) = (c.unary(Unary::Sin, x)?, c.unary(Unary::Cos, x)?);
                c.divide(sine, cosine)
            }),
            (M::Radians, [x]) => self.scaled(x, core::f32::consts::PI / 180.0),
            (M::Degrees, [x]) => self.scaled(x, 180.0 / core::f32::consts::PI),
            (M::Modf, [x]) => {
                let whole = self.each(x, |c, x| c.unary(Unary::Trunc, x))?;
                let mut parts = self.each_2(x, &whole, Self::subtract)?;
                parts.extend(whole);
                Ok(parts)
            }
            (M::Frexp, [x]) => {
                let mut parts = self.each(x, |c, x| c.unary(Unary::FrexpFraction, x))?;
                parts.extend(self.each(x, |c, x| c.unary(Unary::FrexpExponent, x))?);
                Ok(parts)
            }
            (M::Fma, [a, b, c]) => self.each_3([a, b, c], |compiler, a, b, c| compiler.fma([a, b, c])),
            (M::Mix, [a, b, t]) => {
                let one = self.float(1.0)?;
                self.each_3([a, b, t], |c, a, b, t| {
                    let rest = c.subtract(one, t)?;
                    let (first, second) = (c.multiply(a, rest)?, c.multiply(b, t)?);
                    c.add(first, second)
                })
            }
            (M::Step, [edge, x]) => {
                let (zero, one) = (self.float(0.0)?, self.float(1.0)?);
                self.each_2(edge, x, |c, edge, x| {
                    let reached = c.binary(Binary::LessEqual, edge, x)?;
                    c.select(reached, one, zero)
                })
            }
            (M::SmoothStep, [low, high, x]) => self.each_3([low, high, x], Self::smooth_step),
            (M::Dot, [a, b]) => Ok(vec![self.dot(a, b)?]),
            (M::Length, [a]) => Ok(vec![self.length(a)?]),
            (M::Distance, [a, b]) => {
                let difference = self.each_2(a, b, Self::subtract)?;
                Ok(vec![self.length(&difference)?])
            }
            (M::Normalize, [a]) => {
                let length = self.length(a)?;
                self.each(a, |c, x| c.divide(x, length))
            }
            (M::Cross, [a, b]) if a.len() == 3 => [(1, 2), (2, 0), (0, 1)]
                .into_iter()
                .map(|(i, j)| {
                    let (first, second) = (self.multiply(a[i], b[j])?, self.multiply(a[j], b[i])?);
                    self.subtract(first, second)
                })
                .collect(),
            (M::FaceForward, [normal, incident, reference]) => {
                let dot = self.dot(reference, incident)?;
                let zero = self.float(0.0)?;
                let faces = self.binary(Binary::Less, dot, zero)?;
                self.each(normal, |c, x| {
                    let negated = c.negate(x)?;
                    c.select(faces, x, negated)
                })
            }
            (M::Reflect, [incident, normal]) => {
                let two = self.float(2.0)?;
                let dot = self.dot(normal, incident)?;
                let twice = self.multiply(two, dot)?;
                self.each_2(incident, normal, |c, i, n| {
                    let along = c.multiply(twice, n)?;
                    c.subtract(i, along)
                })
            }
            (M::Refract, [incident, normal, ratio]) => self.refract(incident, normal, ratio[0]),
            (M::Outer, [column, row]) => self.outer(column, row),
            (M::Transpose, [matrix]) => self.transpose(ty, matrix),
            (M::Determinant, [matrix]) => Ok(vec![self.determinant(matrix)?]),
            (M::Inverse, [matrix]) => self.inverse(matrix),
            (M::Pack4x8snorm, [x]) => self.pack_normalized(x, 8, true),
            (M::Pack4x8unorm, [x]) => self.pack_normalized(x, 8, false),
            (M::Pack2x16snorm, [x]) => self.pack_normalized(x, 16, true),
            (M::Pack2x16unorm, [x]) => self.pack_normalized(x, 16, false),
            (M::Pack2x16float, [x]) => {
                let halves = self.each(x, |c, x| c.unary(Unary::ToF16Bits, x))?;
                self.pack(&halves, 16)
            }
            _ => Err(Unsupported::new(format!("`{function:?}` of floats is not interpreted"))),
        }
    }

    fn scaled(&mut self, value: &[Register], factor: f32) -> Result<Value> {
        let factor = self.float(factor)?;
        self.each(value, |c, x| c.multiply(x, factor))
    }

    /// `min(max(x, low), high)`.
    pub(super) fn clamp(&mut self, x: Register, low: Register, high: Register) -> Result<Register> {
        let above = self.max(x, low)?;
        self.min(above, high)
    }

    /// `t * t * (3 - 2 t)` of `t = clamp((x - low) / (high - low), 0, 1)`.
    fn smooth_step(&mut self, low: Register, high: Register, x: Register) -> Result<Register> {
        let [zero, one, two, three] =
            [self.float(0.0)?, self.float(1.0)?, self.float(2.0)?, self.float(3.0)?];
        let (above, width) = (self.subtract(x, low)?, self.subtract(high, low)?);
        let ratio = self.divide(above, width)?;
        let t = self.clamp(ratio, zero, one)?;
        let squared = self.multiply(t, t)?;
        let twice = self.multiply(two, t)?;
        let rest = self.subtract(three, twice)?;
        self.multiply(squared, rest)
    }

    /// `k = 1 - r r (1 - d d)` with `d = dot(n, i)`; zero where `k < 0`, else `r i - (r d + sqrt(k)) n`.
    fn refract(&mut self, incident: &[Register], normal: &[Register], ratio: Register) -> Result<Value> {
        let (zero, one) = (self.float(0.0)?, self.float(1.0)?);
        let dot = self.dot(normal, incident)?;
        let dot_squared = self.multiply(dot, dot)?;
        let rest = self.subtract(one, dot_squared)?;
        let ratio_squared = self.multiply(ratio, ratio)?;
        let part = self.multiply(ratio_squared, rest)?;
        let k = self.subtract(one, part)?;
        let total = self.binary(Binary::Less, k, zero)?;
        let root = self.unary(Unary::Sqrt, k)?;
        let along = self.multiply(ratio, dot)?;
        let factor = self.add(along, root)?;
        self.each_2(incident, normal, |c, i, n| {
            let (bent, back) = (c.multiply(ratio, i)?, c.multiply(factor, n)?);
            let refracted = c.subtract(bent, back)?;
            c.select(total, zero, refracted)
        })
    }
}

/// Functions of one scalar that the machine has as they are.
fn one_to_one(function: MathFunction) -> Option<Unary> {
    use MathFunction as M;
    Some(match function {
        M::Abs => Unary::Abs,
        M::Sign => Unary::Sign,
        M::Floor => Unary::Floor,
        M::Ceil => Unary::Ceil,
        M::Round => Unary::Round,
        M::Trunc => Unary::Trunc,
        M::Fract => Unary::Fract,
        M::Sqrt => Unary::Sqrt,
        M::InverseSqrt => Unary::InverseSqrt,
        M::Sin => Unary::Sin,
        M::Cos => Unary::Cos,
        M::Asin => Unary::Asin,
        M::Acos => Unary::Acos,
        M::Atan => Unary::Atan,
        M::Sinh => Unary::Sinh,
        M::Cosh => Unary::Cosh,
        M::Tanh => Unary::Tanh,
        M::Asinh => Unary::Asinh,
        M::Acosh => Unary::Acosh,
        M::Atanh => Unary::Atanh,
        M::Exp => Unary::Exp,
        M::Exp2 => Unary::Exp2,
        M::Log => Unary::Ln,
        M::Log2 => Unary::Log2,
        M::QuantizeToF16 => Unary::QuantizeToF16,
        _ => return None,
    })
}
