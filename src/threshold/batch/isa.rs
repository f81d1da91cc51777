//! Which vector instructions a loop is compiled for, chosen at run time.
//!
//! The loops are plain Rust over arrays; this file has them compiled once for each instruction set, so that the
//! compiler turns them into its instructions. The generated dispatch checks the processor before it calls.

use core::fmt;
use multiversion::multiversion;

/// A set of vector instructions. No result depends on it, only the time that it takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Isa {
    /// What every machine of the architecture has: SSE2 on x86-64, NEON on AArch64.
    Portable,
    /// AVX2 and fused multiply-add: x86-64-v3.
    Avx2,
    /// AVX-512 (F, BW, CD, DQ, VL): x86-64-v4.
    Avx512,
}

impl Isa {
    /// Every set, the slowest first.
    pub const ALL: [Self; 3] = [Self::Portable, Self::Avx2, Self::Avx512];

    /// The name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Portable if cfg!(target_arch = "aarch64") => "neon",
            Self::Portable => "portable",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }

    /// Returns the sets that this machine has, the slowest first.
    #[must_use]
    pub fn available() -> impl DoubleEndedIterator<Item = Self> {
        Self::ALL.into_iter().filter(|isa| isa.is_available())
    }

    /// Returns the fastest set that this machine has.
    #[must_use]
    pub fn best() -> Self {
        Self::available().next_back().unwrap_or(Self::Portable)
    }

    /// Returns whether this machine has the set.
    #[must_use]
    pub fn is_available(self) -> bool {
        match self {
            Self::Portable => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => {
                Self::Avx2.is_available()
                    && is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512bw")
                    && is_x86_feature_detected!("avx512cd")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
            }
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx2 | Self::Avx512 => false,
        }
    }

    /// Runs a job compiled for this set; for the portable one where the machine does not have it.
    pub(crate) fn run<J: Job>(self, job: J) {
        match self {
            Self::Portable => job.run::<{ cfg!(target_arch = "aarch64") }>(),
            Self::Avx2 => avx2(job),
            Self::Avx512 => avx512(job),
        }
    }
}

impl fmt::Display for Isa {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A loop over blocks.
pub(crate) trait Job {
    /// Does the work. `FUSED`: the machine has a fused multiply-add.
    ///
    /// Must be `#[inline(always)]`, and so must all that it calls in a loop; a closure is not and keeps the
    /// instructions of the function that it was written in.
    fn run<const FUSED: bool>(self);
}

#[multiversion(targets("x86_64+avx2+fma+bmi1+bmi2+lzcnt+movbe+f16c"))]
fn avx2<J: Job>(job: J) {
    job.run::<true>();
}

#[multiversion(targets(
    "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2+lzcnt+movbe+f16c"
))]
fn avx512<J: Job>(job: J) {
    job.run::<true>();
}
