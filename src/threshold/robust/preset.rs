//! What a recommended threshold is for: two presets. Not in the paper; `docs/recommendation.md` has the numbers and the reasons.

use crate::threshold::choice::{UnknownName, by_name};
use crate::threshold::two_scale::Variant;
use core::fmt;
use core::str::FromStr;

/// What a recommended threshold is for, where one goal is bought with the other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Preset {
    /// As little as possible changes while camera and objects move: one scale, and cells that inherit from those of the octave before. Take it
    /// unless you see long streaks at grazing angles.
    #[default]
    Steady,
    /// Short noise at grazing angles, and thresholds that glide in place of switching: one scale an axis, joined by the copula. It takes more
    /// time, and more than twice as much changes under zoom.
    Smooth,
}

impl Preset {
    /// Every preset, the one to begin with first.
    pub const ALL: [Self; 2] = [Self::Steady, Self::Smooth];

    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Steady => "steady",
            Self::Smooth => "smooth",
        }
    }

    /// The preset whose scales come from the derivatives in a way; those without a robust form count as isotropic.
    #[must_use]
    pub const fn of(variant: Variant) -> Self {
        match variant {
            Variant::Anisotropic => Self::Smooth,
            Variant::Isotropic | Variant::Linear | Variant::Single => Self::Steady,
        }
    }
}

impl fmt::Display for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Preset {
    type Err = UnknownName;
    fn from_str(name: &str) -> Result<Self, UnknownName> {
        by_name("preset", &Self::ALL, Self::name, name)
    }
}
