//! The ideal source: what every claim must let pass.

use hashed_alpha::threshold::hash::{Cell, Hash, open_lattice};
use hashed_alpha::threshold::real::Real;
use sha2::{Digest, Sha256};

/// A keyed cryptographic hash of the cell and its octave.
#[derive(Clone, Copy)]
pub struct Ideal;

impl<R: Real> Hash<R> for Ideal {
    fn hash(&self, cell: &Cell<R>) -> R {
        let mut digest = Sha256::new_with_prefix(b"ideal source");
        cell.words().iter().for_each(|word| digest.update(word.to_le_bytes()));
        let digest = digest.finalize();
        open_lattice(u32::from_le_bytes([digest[0], digest[1], digest[2], digest[3]]))
    }
}
