//! What a compiled function is made of: scalar operations on registers, and blocks of steps that choose lanes.

use naga::Span;

/// Index of a column of 32-bit words, one word a lane.
pub(super) type Register = u32;

/// A function of one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Unary {
    /// The same word, read as a float: where a bit pattern becomes a number of the device.
    Float,
    Copy,
    Negate,
    Abs,
    Floor,
    Ceil,
    Round,
    Trunc,
    Fract,
    Sign,
    Sqrt,
    InverseSqrt,
    Sin,
    Cos,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    Exp,
    Exp2,
    Ln,
    Log2,
    FrexpFraction,
    FrexpExponent,
    QuantizeToF16,
    ToF16Bits,
    FromF16Bits,
    IsNan,
    IsInf,
    FloatToSigned,
    FloatToUnsigned,
    FloatToBool,
    SignedToFloat,
    UnsignedToFloat,
    IntegerToBool,
    BoolToInteger,
    BoolToFloat,
    NegateInteger,
    AbsInteger,
    SignInteger,
    /// Complement, of integers and of truth values.
    Not,
    CountOnes,
    TrailingZeros,
    LeadingZeros,
    ReverseBits,
    FirstTrailingBit,
    FirstLeadingBit,
    FirstLeadingBitSigned,
}

impl Unary {
    /// Whether the result is a float that the device rounds, as against one that it can hold anyway.
    pub(super) fn rounds(self) -> bool {
        use Unary::*;
        matches!(
            self,
            Float
                | Fract
                | Sqrt
                | InverseSqrt
                | Sin
                | Cos
                | Asin
                | Acos
                | Atan
                | Sinh
                | Cosh
                | Tanh
                | Asinh
                | Acosh
                | Atanh
                | Exp
                | Exp2
                | Ln
                | Log2
                | FrexpFraction
                | QuantizeToF16
                | FromF16Bits
                | SignedToFloat
                | UnsignedToFloat
        )
    }
}

/// A function of two words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Min,
    Max,
    Pow,
    Atan2,
    Ldexp,
    Less,
    LessEqual,
    Equal,
    NotEqual,
    AddInteger,
    SubtractInteger,
    MultiplyInteger,
    DivideSigned,
    DivideUnsigned,
    RemainderSigned,
    RemainderUnsigned,
    MinSigned,
    MinUnsigned,
    MaxSigned,
    MaxUnsigned,
    LessSigned,
    LessUnsigned,
    LessEqualSigned,
    LessEqualUnsigned,
    EqualWord,
    NotEqualWord,
    And,
    Or,
    Xor,
    ShiftLeft,
    ShiftRightSigned,
    ShiftRightUnsigned,
}

impl Binary {
    /// Whether the result is a float that the device rounds.
    pub(super) fn rounds(self) -> bool {
        use Binary::*;
        matches!(self, Add | Subtract | Multiply | Divide | Pow | Atan2 | Ldexp)
    }
}

/// A product that may enter a sum unrounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Product {
    pub(super) factors: [Register; 2],
    pub(super) negated: bool,
}

/// One scalar operation on all lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Op {
    Unary {
        function: Unary,
        to: Register,
        from: Register,
    },
    Binary {
        function: Binary,
        to: Register,
        left: Register,
        right: Register,
    },
    /// [`Binary::Add`] or [`Binary::Subtract`], of which one side is a product. A device that contracts computes
    /// `product + addend` with one rounding.
    Sum {
        function: Binary,
        to: Register,
        left: Register,
        right: Register,
        contracted: Contracted,
    },
    /// `a * b + c` with one rounding, on every device.
    Fma {
        to: Register,
        arguments: [Register; 3],
    },
    /// `accept` where `condition` is true, else `reject`.
    Select {
        to: Register,
        condition: Register,
        accept: Register,
        reject: Register,
    },
    /// The word of the register that stands `offset` (a word a lane, in bounds) after `first`.
    Gather {
        to: Register,
        first: Register,
        offset: Register,
    },
    /// Writes the active lanes only.
    Store {
        to: Register,
        from: Register,
    },
    /// Writes the active lanes only, each to the register that stands `offset` after `first`.
    Scatter {
        first: Register,
        offset: Register,
        from: Register,
    },
    /// Counts the active lanes where `odd` is true, for the undefined behaviour of that index.
    Count {
        odd: Register,
        met: usize,
    },
}

/// The contracted form of a sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Contracted {
    pub(super) product: Product,
    pub(super) addend: Register,
    pub(super) negate_addend: bool,
}

/// A run of operations, or a choice of lanes.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Step {
    Compute(Vec<Op>),
    If {
        condition: Register,
        accept: Block,
        reject: Block,
    },
    Switch {
        selector: Register,
        cases: Vec<Case>,
    },
    Loop {
        body: Block,
        continuing: Block,
        break_if: Option<Register>,
        span: Span,
    },
    /// The body of a function that returns from more than its end; all lanes come back.
    Call {
        body: Block,
    },
    Break,
    Continue,
    Return,
}

/// One case of a switch.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Case {
    /// The selector's word; none for the default.
    pub(super) value: Option<u32>,
    pub(super) body: Block,
    pub(super) falls_through: bool,
}

/// Steps in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Block(pub(super) Vec<Step>);

impl Block {
    pub(super) fn compute(&mut self, op: Op) {
        if let Some(Step::Compute(ops)) = self.0.last_mut() {
            ops.push(op);
        } else {
            self.0.push(Step::Compute(vec![op]));
        }
    }
}
