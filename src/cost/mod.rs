//! What accuracy costs: the same threshold in many tiers, timed in one run, with its error and its law beside the time.
//!
//! | module | answers |
//! |---|---|
//! | [`ladder`](mod@ladder) | what does each digit of a sine, a hash, a threshold cost? |
//! | [`law`] | how uniform is a threshold, and how often does it change what is seen? |
//! | [`effects`] | what does each effect of the paper add? |
//! | `devices` (feature `gpu`) | what does it add on a device, by the device's own clock? |
//! | `techniques` (feature `render`) | what does each technique add to a whole frame of the scene that shows it? |
//! | `drawing` (feature `render`) | how does the time of a frame grow with triangles and pixels? |
//! | `hashes` (feature `shader`) | what does each hash of the list cost? |
//! | [`sizes`] | do time and memory grow with the number of samples? |
//! | [`clock`] | how things are timed so that the ratios mean something |
//! | [`pool`] | the footprints that are evaluated |
//! | [`baseline`] | the listings as a user writes them, with the sine of the standard library |
//! | [`double_double`] | the paper's hash with 106 bits |
//!
//! What never lives here: a verdict, a picture, a printed line. Not in the paper, but for its Table 1.

pub mod baseline;
pub mod clock;
#[cfg(feature = "gpu")]
pub mod devices;
pub mod double_double;
#[cfg(feature = "render")]
pub mod drawing;
pub mod effects;
#[cfg(feature = "shader")]
pub mod hashes;
pub mod ladder;
pub mod law;
pub mod pool;
pub mod row;
pub mod sizes;
mod stages;
#[cfg(feature = "render")]
pub mod techniques;

pub use ladder::ladder;
pub use row::Row;

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// A few seconds: enough to see that all of it works.
    Quick,
    /// About a minute on one core.
    Full,
}

impl Effort {
    /// Picks by effort.
    pub(crate) const fn pick<T: Copy>(self, quick: T, full: T) -> T {
        match self {
            Self::Quick => quick,
            Self::Full => full,
        }
    }
}
