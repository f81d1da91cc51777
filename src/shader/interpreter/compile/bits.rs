//! Builtin functions of integers, and packing.

use super::super::error::Unsupported;
use super::super::op::{Binary, Register, Unary};
use super::{Compiler, Value};
use naga::MathFunction;

type Result<T> = core::result::Result<T, Unsupported>;

impl Compiler<'_> {
    pub(super) fn integer_math(
        &mut self,
        function: MathFunction,
        signed: bool,
        arguments: &[Value],
    ) -> Result<Value> {
        use MathFunction as M;
        let (min, max) = if signed {
            (Binary::MinSigned, Binary::MaxSigned)
        } else {
            (Binary::MinUnsigned, Binary::MaxUnsigned)
        };
        match (function, arguments) {
            (M::Abs, [x]) if signed => self.each(x, |c, x| c.unary(Unary::AbsInteger, x)),
            (M::Abs, [x]) => Ok(x.clone()),
            (M::Sign, [x]) if signed => self.each(x, |c, x| c.unary(Unary::SignInteger, x)),
            (M::Min, [a, b]) => self.each_2(a, b, |c, x, y| c.binary(min, x, y)),
            (M::Max, [a, b]) => self.each_2(a, b, |c, x, y| c.binary(max, x, y)),
            (M::Clamp, [x, low, high]) => self.each_3([x, low, high], |c, x, low, high| {
                let above = c.binary(max, x, low)?;
                c.binary(min, above, high)
            }),
            (M::Dot, [a, b]) => {
                let products = self.each_2(a, b, |c, x, y| c.binary(Binary::MultiplyInteger, x, y))?;
                Ok(vec![self.total(&products, Binary::AddInteger)?])
            }
            (M::CountOneBits, [x]) => self.each(x, |c, x| c.unary(Unary::CountOnes, x)),
            (M::CountTrailingZeros, [x]) => self.each(x, |c, x| c.unary(Unary::TrailingZeros, x)),
            (M::CountLeadingZeros, [x]) => self.each(x, |c, x| c.unary(Unary::LeadingZeros, x)),
            (M::ReverseBits, [x]) => self.each(x, |c, x| c.unary(Unary::ReverseBits, x)),
            (M::FirstTrailingBit, [x]) => self.each(x, |c, x| c.unary(Unary::FirstTrailingBit, x)),
            (M::FirstLeadingBit, [x]) => {
                let function = if signed { Unary::FirstLeadingBitSigned } else { Unary::FirstLeadingBit };
                self.each(x, |c, x| c.unary(function, x))
            }
            (M::ExtractBits, [x, offset, count]) => {
                let (offset, count) = self.bit_range(offset[0], count[0])?;
                self.each(x, |c, x| c.extract_bits(signed, x, offset, count))
            }
            (M::InsertBits, [x, bits, offset, count]) => {
                let (offset, count) = self.bit_range(offset[0], count[0])?;
                let mask = self.bit_mask(offset, count)?;
                let outside = self.unary(Unary::Not, mask)?;
                self.each_2(x, bits, |c, x, bits| {
                    let kept = c.binary(Binary::And, x, outside)?;
                    let moved = c.binary(Binary::ShiftLeft, bits, offset)?;
                    let inserted = c.binary(Binary::And, moved, mask)?;
                    c.binary(Binary::Or, kept, inserted)
                })
            }
            (M::Dot4I8Packed | M::Dot4U8Packed, [a, b]) => {
                let signed = function == M::Dot4I8Packed;
                let (a, b) = (self.unpack(a[0], 8, signed)?, self.unpack(b[0], 8, signed)?);
                let products = self.each_2(&a, &b, |c, x, y| c.binary(Binary::MultiplyInteger, x, y))?;
                Ok(vec![self.total(&products, Binary::AddInteger)?])
            }
            (M::Pack4xI8 | M::Pack4xU8, [x]) => self.pack(x, 8),
            (M::Pack4xI8Clamp, [x]) => {
                let (low, high) = (self.word(-128_i32 as u32)?, self.word(127)?);
                let clamped = self.each(x, |c, x| {
                    let above = c.binary(Binary::MaxSigned, x, low)?;
                    c.binary(Binary::MinSigned, above, high)
                })?;
                self.pack(&clamped, 8)
            }
            (M::Pack4xU8Clamp, [x]) => {
                let high = self.word(255)?;
                let clamped = self.each(x, |c, x| c.binary(Binary::MinUnsigned, x, high))?;
                self.pack(&clamped, 8)
            }
            (M::Unpack4xI8, [x]) => self.unpack(x[0], 8, true),
            (M::Unpack4xU8, [x]) => self.unpack(x[0], 8, false),
            (M::Unpack4x8snorm, [x]) => self.unpack_normalized(x[0], 8, true),
            (M::Unpack4x8unorm, [x]) => self.unpack_normalized(x[0], 8, false),
            (M::Unpack2x16snorm, [x]) => self.unpack_normalized(x[0], 16, true),
            (M::Unpack2x16unorm, [x]) => self.unpack_normalized(x[0], 16, false),
            (M::Unpack2x16float, [x]) => {
                let halves = self.unpack(x[0], 16, false)?;
                self.each(&halves, |c, x| c.unary(Unary::FromF16Bits, x))
            }
            _ => Err(Unsupported::new(format!("`{function:?}` of integers is not interpreted"))),
        }
    }

    fn total(&mut self, value: &[Register], function: Binary) -> Result<Register> {
        let (&first, rest) = value.split_first().ok_or_else(|| Unsupported::new("an empty vector"))?;
        rest.iter().try_fold(first, |total, &next| self.binary(function, total, next))
    }

    /// The first bit and the number of bits, cut to those that a word has.
    fn bit_range(&mut self, offset: Register, count: Register) -> Result<(Register, Register)> {
        let all = self.word(32)?;
        let offset = self.binary(Binary::MinUnsigned, offset, all)?;
        let left = self.binary(Binary::SubtractInteger, all, offset)?;
        Ok((offset, self.binary(Binary::MinUnsigned, count, left)?))
    }

    /// The mask of a range; a count of zero gives none, though a shift by 32 is one by zero.
    fn bit_mask(&mut self, offset: Register, count: Register) -> Result<Register> {
        let (all, none, ones) = (self.word(32)?, self.word(0)?, self.word(u32::MAX)?);
        let surplus = self.binary(Binary::SubtractInteger, all, count)?;
        let low = self.binary(Binary::ShiftRightUnsigned, ones, surplus)?;
        let mask = self.binary(Binary::ShiftLeft, low, offset)?;
        let empty = self.binary(Binary::EqualWord, count, none)?;
        self.select(empty, none, mask)
    }

    fn extract_bits(
        &mut self,
        signed: bool,
        x: Register,
        offset: Register,
        count: Register,
    ) -> Result<Register> {
        let mask = self.bit_mask(offset, count)?;
        let masked = self.binary(Binary::And, x, mask)?;
        let low = self.binary(Binary::ShiftRightUnsigned, masked, offset)?;
        if !signed {
            return Ok(low);
        }
        let all = self.word(32)?;
        let surplus = self.binary(Binary::SubtractInteger, all, count)?;
        let high = self.binary(Binary::ShiftLeft, low, surplus)?;
        self.binary(Binary::ShiftRightSigned, high, surplus)
    }

    /// Puts the low bits of every component side by side, the first lowest.
    pub(super) fn pack(&mut self, value: &[Register], width: u32) -> Result<Value> {
        let mask = self.word((1 << width) - 1)?;
        let parts = (0..).zip(value).map(|(i, &x)| {
            let low = self.binary(Binary::And, x, mask)?;
            let distance = self.word(i * width)?;
            self.binary(Binary::ShiftLeft, low, distance)
        });
        let parts = parts.collect::<Result<Value>>()?;
        Ok(vec![self.total(&parts, Binary::Or)?])
    }

    /// `floor(0.5 + scale * clamp(x, low, 1))`, packed.
    pub(super) fn pack_normalized(&mut self, value: &[Register], width: u32, signed: bool) -> Result<Value> {
        let (half, one) = (self.float(0.5)?, self.float(1.0)?);
        let (low, scale) = (self.float(if signed { -1.0 } else { 0.0 })?, self.float(scale(width, signed))?);
        let function = if signed { Unary::FloatToSigned } else { Unary::FloatToUnsigned };
        let whole = self.each(value, |c, x| {
            let clamped = c.clamp(x, low, one)?;
            let scaled = c.multiply(scale, clamped)?;
            let shifted = c.add(half, scaled)?;
            let floor = c.unary(Unary::Floor, shifted)?;
            c.unary(function, floor)
        })?;
        self.pack(&whole, width)
    }

    /// The parts of a word, the lowest first.
    fn unpack(&mut self, packed: Register, width: u32, signed: bool) -> Result<Value> {
        let down = self.word(32 - width)?;
        let function = if signed { Binary::ShiftRightSigned } else { Binary::ShiftRightUnsigned };
        (1..=32 / width)
            .map(|part| {
                let up = self.word(32 - part * width)?;
                let high = self.binary(Binary::ShiftLeft, packed, up)?;
                self.binary(function, high, down)
            })
            .collect()
    }

    /// The parts over their largest value, at least -1.
    fn unpack_normalized(&mut self, packed: Register, width: u32, signed: bool) -> Result<Value> {
        let parts = self.unpack(packed, width, signed)?;
        let (low, scale) = (self.float(-1.0)?, self.float(scale(width, signed))?);
        let function = if signed { Unary::SignedToFloat } else { Unary::UnsignedToFloat };
        self.each(&parts, |c, part| {
            let number = c.unary(function, part)?;
            let ratio = c.divide(number, scale)?;
            if signed { c.max(ratio, low) } else { Ok(ratio) }
        })
    }
}

/// The largest value of a part.
fn scale(width: u32, signed: bool) -> f32 {
    ((1_u32 << (width - u32::from(signed))) - 1) as f32
}
