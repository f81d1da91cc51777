//! How exact a batch is.

use core::fmt;

/// How exact the sine and the logarithm of a batch are.
///
/// The figures are those of `f32`. In `f64` the sine of [`Tier::TwoUlp`] is within two units of *its* last place and that of
/// [`Tier::Fast`] within 2^-50, for arguments up to 2^30; [`Tier::Coarse`] is the same.
///
/// Each tier has the same bits on every machine. One without fused multiply-add emulates it for the faster tiers, which
/// are slow there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Tier {
    /// Sine within 2^-11 for arguments up to pi, which is all that WGSL promises; beyond, the error grows with the
    /// argument, and the law of the hash suffers with it. Octave by the exponent.
    Coarse,
    /// Sine within 2^-22 for arguments up to 2^20, octave by the exponent. Same law as the exact tier, other values:
    /// the hash turns the last digit of a sine into another number.
    Fast,
    /// Sine within 2.1 units in the last place for arguments up to 2^20, octave by the exponent.
    TwoUlp,
    /// Sine and logarithm correctly rounded: bit for bit the scalar path.
    #[default]
    BitExact,
}

impl Tier {
    /// Every tier, the fastest first.
    pub const ALL: [Self; 4] = [Self::Coarse, Self::Fast, Self::TwoUlp, Self::BitExact];

    /// The name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Coarse => "wgsl-minimum",
            Self::Fast => "fast",
            Self::TwoUlp => "two-ulp",
            Self::BitExact => "bit-exact",
        }
    }
}

impl fmt::Display for Tier {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
