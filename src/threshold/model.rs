//! A threshold whose hash was chosen by name: a listing, or the listing with repairs.

use super::footprint::Footprint;
use super::hash::{Hash, HashKind};
use super::hashed::HashedAlpha;
use super::real::Real;
use super::robust::Robust;

/// What makes a threshold of a footprint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Model<H = HashKind> {
    /// A listing, or one of its ablations.
    Hashed(HashedAlpha<H>),
    /// The same before Eq. 2: two hashes mixed, and not uniform.
    BeforeCdf(HashedAlpha<H>),
    /// The listing with repairs.
    Robust(Robust<H>),
}

impl<H> From<HashedAlpha<H>> for Model<H> {
    fn from(hashed: HashedAlpha<H>) -> Self {
        Self::Hashed(hashed)
    }
}

impl<H> From<Robust<H>> for Model<H> {
    fn from(robust: Robust<H>) -> Self {
        Self::Robust(robust)
    }
}

impl<H> Model<H> {
    /// Returns the threshold of one footprint; NaN where [`Robust::threshold`] has an error.
    #[must_use]
    pub fn threshold<R: Real>(&self, footprint: &Footprint<R>) -> R
    where
        H: Hash<R>,
    {
        match self {
            Self::Hashed(hashed) => hashed.threshold(footprint),
            Self::BeforeCdf(hashed) => hashed.trace(footprint).interpolated,
            Self::Robust(robust) => robust.threshold(footprint).unwrap_or(R::from_f64(f64::NAN)),
        }
    }

    /// The hash that is asked for the value of a cell.
    #[must_use]
    pub const fn hash(&self) -> &H {
        match self {
            Self::Hashed(hashed) | Self::BeforeCdf(hashed) => &hashed.hash,
            Self::Robust(robust) => &robust.hash,
        }
    }

    /// The same with another hash in place of its own.
    #[must_use]
    pub fn with_hash<G>(self, hash: G) -> Model<G> {
        match self {
            Self::Hashed(hashed) => Model::Hashed(hashed.with_hash(hash)),
            Self::BeforeCdf(hashed) => Model::BeforeCdf(hashed.with_hash(hash)),
            Self::Robust(robust) => Model::Robust(robust.with_hash(hash)),
        }
    }

    /// The same with a noise of so many pixels.
    #[must_use]
    pub fn with_hash_scale(self, hash_scale: f64) -> Self {
        match self {
            Self::Hashed(hashed) => Self::Hashed(HashedAlpha { hash_scale, ..hashed }),
            Self::BeforeCdf(hashed) => Self::BeforeCdf(HashedAlpha { hash_scale, ..hashed }),
            Self::Robust(robust) => Self::Robust(Robust { hash_scale, ..robust }),
        }
    }

    /// The number of hashes that it computes for one threshold.
    #[must_use]
    pub const fn hashes(&self) -> u64 {
        match self {
            Self::Hashed(hashed) | Self::BeforeCdf(hashed) => hashed.variant.hashes(),
            Self::Robust(robust) => robust.join.hashes(robust.variant),
        }
    }
}
