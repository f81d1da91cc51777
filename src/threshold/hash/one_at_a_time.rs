//! B. Jenkins's "one at a time" ("Hash functions", Dr. Dobb's, 1997) over the words of a cell. The original goes over bytes; over
//! whole words, as in shaders, it takes a quarter of the steps. Not in the paper.

use super::listed::Listed;
use super::words::integer_hash;

#[inline(always)]
fn one_at_a_time_step(state: u32, unit: u32) -> u32 {
    let h = state.wrapping_add(unit);
    let h = h.wrapping_add(h << 10);
    h ^ (h >> 6)
}

#[inline(always)]
fn one_at_a_time_end(state: u32) -> u32 {
    let h = state.wrapping_add(state << 3);
    let h = h ^ (h >> 11);
    h.wrapping_add(h << 15)
}

/// Returns the hash of units, bytes or words.
#[inline(always)]
#[must_use]
pub fn one_at_a_time(units: impl IntoIterator<Item = u32>) -> u32 {
    one_at_a_time_end(units.into_iter().fold(0, one_at_a_time_step))
}

integer_hash! {
    /// [`one_at_a_time`] over x, y, z and the octave.
    OneAtATime, |words| one_at_a_time(words)
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "one-at-a-time",
    reads_octave: true,
    is_exact: true,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/words.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/hash_cell/one_at_a_time.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: [">> 11u", ">> 12u"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate computation in Python.
    #[test]
    fn it_gives_known_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0x0000_0000),
            ([1, 2, 3, 4], 0x8e3e_7c6b),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0x5364_3f41),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0xf812_908b),
        ] {
            assert_eq!(OneAtATime::word(words), expected, "{words:x?}");
        }
    }

    #[test]
    fn over_bytes_it_gives_its_published_bits() {
        let of = |text: &str| one_at_a_time(text.bytes().map(u32::from));
        assert_eq!(of("a"), 0xca2e_9442);
        assert_eq!(of("The quick brown fox jumps over the lazy dog"), 0x519e_91f5);
    }
}
