//! Thresholds that are broken on purpose: every way in which a port by hand goes wrong, each a few lines.
//!
//! Most are a sound port with one step exchanged. What rejects which is the kill matrix ([`matrix`]); it
//! keeps the claims honest, and tells the author of a rejected threshold what theirs looks like
//! ([`diagnosis`](super::diagnosis)).

mod bias;
mod cdf;
mod cells;
mod clamp;
pub mod computed;
mod defect;
mod derivative;
mod domain;
mod frame;
mod hash;
mod ideal;
mod input;
mod join;
pub mod matrix;
mod nested;
mod octave;
mod pattern;
mod port;
mod relation;
mod repair;

pub use defect::Specimen;
pub use ideal::{Ideal, ideal};

/// The specimens, family by family.
const FAMILIES: [&[Specimen]; 15] = [
    input::FAMILY,
    derivative::FAMILY,
    octave::FAMILY,
    cells::FAMILY,
    hash::FAMILY,
    relation::FAMILY,
    pattern::FAMILY,
    join::FAMILY,
    nested::FAMILY,
    cdf::FAMILY,
    clamp::FAMILY,
    bias::FAMILY,
    repair::FAMILY,
    frame::FAMILY,
    domain::FAMILY,
];

/// Every specimen, in the order of the kill matrix.
pub const ALL: &[Specimen] = &{
    let mut all = [FAMILIES[0][0]; COUNT];
    let (mut family, mut place, mut index) = (0, 0, 0);
    while index < COUNT {
        if place == FAMILIES[family].len() {
            (family, place) = (family + 1, 0);
        } else {
            all[index] = FAMILIES[family][place];
            (place, index) = (place + 1, index + 1);
        }
    }
    all
};

const COUNT: usize = {
    let (mut count, mut family) = (0, 0);
    while family < FAMILIES.len() {
        count += FAMILIES[family].len();
        family += 1;
    }
    count
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::claims;
    use std::collections::HashSet;

    #[test]
    fn names_are_unique_and_claims_exist() {
        let names: HashSet<&str> = ALL.iter().map(|specimen| specimen.name).collect();
        assert_eq!(names.len(), ALL.len());
        for specimen in ALL {
            let in_words = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
            assert!(specimen.name.chars().all(in_words), "{specimen:?}");
            assert!(claims::ALL.iter().any(|claim| claim.id == specimen.claim), "{specimen:?}");
        }
    }
}
