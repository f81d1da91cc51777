//! The ideal source: what every claim must let pass, whatever its key.

use crate::check::Subject;
use crate::check::subject::Precision;
use crate::threshold::hash::{Cell, Hash, open_lattice};
use crate::threshold::real::Real;
use crate::threshold::robust::{Join, Repairs, Robust};
use crate::threshold::two_scale::Variant;
use siphasher::sip::SipHasher24;

/// SipHash-2-4, a keyed pseudorandom function, over the cell's coordinates and its octave.
#[derive(Clone, Copy, Debug)]
pub struct Ideal(SipHasher24);

impl Ideal {
    /// The source of a key; sources of different keys have nothing to do with each other.
    #[must_use]
    pub fn new(key: u64) -> Self {
        Self(SipHasher24::new_with_keys(key, !key))
    }
}

impl<R: Real> Hash<R> for Ideal {
    fn hash(&self, cell: &Cell<R>) -> R {
        let mut bytes = [0; 16];
        for (place, word) in bytes.chunks_exact_mut(4).zip(cell.words()) {
            place.copy_from_slice(&word.to_le_bytes());
        }
        open_lattice((self.0.hash(&bytes) >> 32) as u32)
    }
}

/// The robust threshold with every repair over the [`Ideal`] source of a key.
#[must_use]
pub fn ideal(key: u64, variant: Variant, precision: Precision, join: Join) -> Subject<'static> {
    let robust = Robust { variant, hash: Ideal::new(key), hash_scale: 1.0, join, repairs: Repairs::ALL };
    Subject::robust(format!("ideal:{variant}:{join}"), precision, robust)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_and_cells_are_told_apart() {
        let cell = Cell::<f64> { index: [1.0, 2.0, 3.0].into(), octave: 4 };
        let of = |key: u64, cell: &Cell<f64>| -> f64 { Ideal::new(key).hash(cell) };
        assert_ne!(of(0, &cell), of(1, &cell));
        assert_ne!(of(0, &cell), of(0, &Cell { octave: 5, ..cell }));
        assert_eq!(of(7, &cell), of(7, &cell));
    }

    /// The reference vector of SipHash-2-4: key 00 01 .. 0f, message 00 01 .. 0e.
    #[test]
    fn the_hash_is_siphash_2_4() {
        let message: Vec<u8> = (0..15).collect();
        let hasher = SipHasher24::new_with_keys(0x0706_0504_0302_0100, 0x0f0e_0d0c_0b0a_0908);
        assert_eq!(hasher.hash(&message), 0xa129_ca61_49be_45e5);
    }
}
