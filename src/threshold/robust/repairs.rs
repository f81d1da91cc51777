//! What the robust threshold does differently, each difference by its name.

use crate::threshold::choice::{UnknownName, by_name};
use core::fmt;
use core::str::FromStr;

/// One difference from Listings 1 and 2. None is in the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
#[non_exhaustive]
pub enum Repair {
    /// Positions, derivatives and the hash scale are checked; what is not a finite number is an error.
    ValidateInputs,
    /// A cell is no smaller than 2^-21 of the largest coordinate and, along an axis, no smaller than 2^-5 of the
    /// largest cell side; lengths neither under- nor overflow.
    DerivativeFloor,
    /// The octave is read off the exponent of the scale, the fraction is the logarithm of its mantissa, and the next
    /// octave is always one above: one rounding cannot move one of the three alone.
    OneLog2,
    /// Cells are cut at 2/3 and 1/3 of a unit in turn, octave by octave, and not at whole numbers, on which the
    /// planes of real models lie.
    NestedPhase,
    /// The octave is part of what is hashed, so equal coordinates in two octaves give two values.
    OctaveWord,
    /// Eq. 2 without a division by zero.
    StableCdf,
    /// The last step brings the threshold into [2^-24, 1].
    FinalClamp,
}

impl Repair {
    /// Every repair, in the order in which they act.
    pub const ALL: [Self; 7] = [
        Self::ValidateInputs,
        Self::DerivativeFloor,
        Self::OneLog2,
        Self::NestedPhase,
        Self::OctaveWord,
        Self::StableCdf,
        Self::FinalClamp,
    ];

    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::ValidateInputs => "validate-inputs",
            Self::DerivativeFloor => "derivative-floor",
            Self::OneLog2 => "one-log2",
            Self::NestedPhase => "nested-phase",
            Self::OctaveWord => "octave-word",
            Self::StableCdf => "stable-cdf",
            Self::FinalClamp => "final-clamp",
        }
    }
}

impl fmt::Display for Repair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Repair {
    type Err = UnknownName;
    fn from_str(name: &str) -> Result<Self, UnknownName> {
        by_name("repair", &Self::ALL, Self::name, name)
    }
}

/// A set of repairs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Repairs(u8);

impl Repairs {
    /// Every repair.
    pub const ALL: Self = Self((1 << Repair::ALL.len()) - 1);
    /// No repair: the listings to the letter.
    pub const NONE: Self = Self(0);

    /// Returns whether a repair is in the set.
    #[inline]
    #[must_use]
    pub const fn contains(self, repair: Repair) -> bool {
        self.0 & (1 << repair as u8) != 0
    }

    /// Returns the set with a repair added.
    #[must_use]
    pub const fn with(self, repair: Repair) -> Self {
        Self(self.0 | (1 << repair as u8))
    }

    /// Returns the set with a repair taken out.
    #[must_use]
    pub const fn without(self, repair: Repair) -> Self {
        Self(self.0 & !(1 << repair as u8))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_repair_is_switched_alone() {
        for repair in Repair::ALL {
            let without = Repairs::ALL.without(repair);
            for other in Repair::ALL {
                assert_eq!(without.contains(other), other != repair);
                assert_eq!(Repairs::NONE.with(repair).contains(other), other == repair);
            }
            assert_eq!(without.with(repair), Repairs::ALL);
            assert_eq!(repair.name().parse(), Ok(repair));
        }
    }
}
