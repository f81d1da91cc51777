//! Which vector instructions a loop is compiled for, chosen at run time.
//!
//! The loops are plain Rust over arrays. This file has them compiled once for each instruction set, so that the
//! compiler turns them into its instructions, and holds the only unsafe code of the crate: a function that is
//! compiled for instructions beyond those of every machine may be called where the machine has them.

use core::fmt;
use std::sync::OnceLock;

/// Names the set of instructions that is used in place of the fastest.
const ISA_VARIABLE: &str = "HASHED_ALPHA_ISA";

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

    /// Returns the fastest set that this machine has, or the one that is [asked for](Isa::asked_for) if it has that.
    #[must_use]
    pub fn best() -> Self {
        static BEST: OnceLock<Isa> = OnceLock::new();
        *BEST.get_or_init(|| {
            let fastest = || Self::available().next_back().unwrap_or(Self::Portable);
            Self::asked_for().ok().flatten().unwrap_or_else(fastest)
        })
    }

    /// Returns the set that the environment variable `HASHED_ALPHA_ISA` names: `portable`, `avx2` or `avx512`. Nothing where it is
    /// not set or empty. No result depends on it: that is what it is there to show.
    ///
    /// # Errors
    ///
    /// In words, if it names no set, or one that this machine does not have; [`Isa::best`] ignores it then.
    pub fn asked_for() -> Result<Option<Self>, String> {
        let Some(asked) = std::env::var_os(ISA_VARIABLE).filter(|asked| !asked.is_empty()) else {
            return Ok(None);
        };
        let names = Self::available().map(Self::name).collect::<Vec<_>>().join(", ");
        match Self::ALL.into_iter().find(|isa| asked == isa.name()) {
            Some(isa) if isa.is_available() => Ok(Some(isa)),
            Some(isa) => {
                Err(format!("{ISA_VARIABLE} is {isa}, which this machine does not have; it has {names}"))
            }
            None => Err(format!("{ISA_VARIABLE} is {asked:?}; this machine has {names}")),
        }
    }

    /// Returns whether this machine has the set.
    #[must_use]
    pub fn is_available(self) -> bool {
        match self {
            Self::Portable => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => x86::has_avx2(),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => x86::has_avx512(),
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx2 | Self::Avx512 => false,
        }
    }

    /// Runs a job compiled for this set; for the portable one where the machine does not have it.
    #[allow(unsafe_code)]
    pub(crate) fn run(self, job: impl Job) {
        match self {
            // SAFETY: the guard has asked the machine for every feature that the function is compiled for.
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 if x86::has_avx2() => unsafe { x86::avx2(job) },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 if x86::has_avx512() => unsafe { x86::avx512(job) },
            // AArch64 has a fused multiply-add in every machine.
            _ => job.run::<{ cfg!(target_arch = "aarch64") }>(),
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
    /// Must be `#[inline(always)]`, and so must all that it calls in a loop: what is not inlined keeps the instructions
    /// of every machine, and that goes for closures, too.
    fn run<const FUSED: bool>(self);
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::Job;

    pub fn has_avx2() -> bool {
        is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma")
    }

    pub fn has_avx512() -> bool {
        has_avx2()
            && is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512bw")
            && is_x86_feature_detected!("avx512cd")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl")
    }

    #[target_feature(enable = "avx2,fma")]
    pub fn avx2(job: impl Job) {
        job.run::<true>();
    }

    #[target_feature(enable = "avx2,fma,avx512f,avx512bw,avx512cd,avx512dq,avx512vl")]
    pub fn avx512(job: impl Job) {
        job.run::<true>();
    }
}
