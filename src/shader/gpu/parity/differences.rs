//! Which devices are known to use the freedom that the WGSL specification gives them.

/// A stage at which devices differ from Rust: within its bound, or, where a law is all that is owed, in that law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The [`Stage::name`](super::Stage::name).
    pub stage: &'static str,
    /// Parts of the adapters' names, in small letters.
    pub adapters: &'static [&'static str],
    /// Why.
    pub reason: &'static str,
}

const LAVAPIPE: &str = "vulkan llvmpipe";
const OPENGL: &str = "gl llvmpipe";
const SWIFTSHADER: &str = "vulkan swiftshader";
const ALL: &[&str] = &[LAVAPIPE, OPENGL, SWIFTSHADER];

const LOGARITHM: &str = "log2 by a polynomial that is not correctly rounded";

const fn of_all(stage: &'static str, reason: &'static str) -> Difference {
    Difference { stage, adapters: ALL, reason }
}

const fn of_swiftshader(stage: &'static str, reason: &'static str) -> Difference {
    Difference { stage, adapters: &[SWIFTSHADER], reason }
}

/// Every known difference. One that does not occur any more is as much of a finding as a new one.
pub const DIFFERENCES: &[Difference] = &[
    of_all("log2", LOGARITHM),
    of_all("fraction from the mantissa", LOGARITHM),
    of_swiftshader(
        "hash sine, far cells",
        "a sine whose argument is reduced by a rounded 1/(2 pi): from 2^17 on",
    ),
    of_swiftshader(
        "hash sine_chi_2, far cells",
        "the same; its outer hash is that of a coordinate: from 2^13 on",
    ),
    of_all("threshold listing 1, mm4", LOGARITHM),
    of_all("threshold listing 2, mm4", LOGARITHM),
    of_all("threshold robust isotropic interpolate", LOGARITHM),
    of_all("threshold robust isotropic copula", LOGARITHM),
    of_all("threshold robust anisotropic interpolate", LOGARITHM),
    of_all("threshold robust anisotropic copula", LOGARITHM),
];

/// Returns the known difference of an adapter at a stage; `None` where all bits, or the laws, are equal.
#[must_use]
pub fn expected_difference(adapter: &str, stage: &str) -> Option<&'static Difference> {
    let adapter = adapter.to_lowercase();
    DIFFERENCES
        .iter()
        .find(|known| known.stage == stage && known.adapters.iter().any(|part| adapter.contains(part)))
}
