//! Random numbers that are fixed by a name.
//!
//! A test of a deterministic subject has one random event: the choice of its inputs. It is made by rule, from
//! the name of the test and one seed of the user, never by looking at a p-value.

use rand::rngs::Xoshiro256PlusPlus;
use rand::{Rng, SeedableRng};
use sha2::{Digest, Sha256};

/// Makes the generator that belongs to a name and a seed.
///
/// The 256 bits of state are SHA-256 of the UTF-8 bytes of `name`, one zero byte, and `seed` as 8 bytes,
/// little endian. The same pair gives the same numbers on every platform and in every release; pairs that
/// differ give unrelated streams. `name` must contain no zero byte for that to hold.
#[must_use]
pub fn rng(name: &str, seed: u64) -> Xoshiro256PlusPlus {
    let mut hasher = Sha256::new();
    hasher.update(name.as_bytes());
    hasher.update([0]);
    hasher.update(seed.to_le_bytes());
    Xoshiro256PlusPlus::from_seed(hasher.finalize().into())
}

/// Draws a uniform number from `[0, 1)`: a multiple of 2^-53, all 2^53 of them equally likely.
///
/// Takes the upper 53 bits of one `u64`.
pub fn uniform01(rng: &mut impl Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
}
