//! Cells that are tied to others: every value is uniform, and neighbours look independent.

use super::defect::Specimen;
use super::port::{Port, SOUND, ideal_hash};
use crate::threshold::cdf;

/// Listing 1 with another hash of indices and octave.
const fn hashed_by(hash: fn([f64; 3], i32) -> f64) -> Port {
    Port { hash, ..SOUND }
}

/// A part of the ideal source of two of the coordinates.
fn of_two(first: f64, second: f64, octave: i32) -> f64 {
    ideal_hash([first, second, 0.0], octave)
}

/// A power modulo 2^31.
fn power(base: u64, mut exponent: u64) -> u64 {
    let (mut power, mut square) = (1, base);
    while exponent > 0 {
        if exponent & 1 == 1 {
            power = power * square % (1 << 31);
        }
        square = square * square % (1 << 31);
        exponent >>= 1;
    }
    power
}

pub(super) const FAMILY: &[Specimen] = &[
    Specimen {
        name: "period-of-37",
        defect: "indices are reduced modulo 37 before they are hashed, so the noise is a tile of 37 cells",
        mend: "hash whole indices",
        claim: "hash.lags",
        subject: || {
            hashed_by(|index, octave| ideal_hash(index.map(|c| c.rem_euclid(37.0)), octave)).subject()
        },
    },
    Specimen {
        name: "antithetic-at-five",
        defect: "every cell whose x has an odd fifth holds 1 - h for the hash h of the cell five behind it",
        mend: "hash every cell by itself",
        claim: "hash.lags",
        subject: || {
            hashed_by(|[x, y, z], octave| {
                if (x / 5.0).floor().rem_euclid(2.0) == 1.0 {
                    1.0 - ideal_hash([x - 5.0, y, z], octave)
                } else {
                    ideal_hash([x, y, z], octave)
                }
            })
            .subject()
        },
    },
    Specimen {
        name: "mixed-at-three",
        defect: "a twelfth of each hash is that of the cell three further along x, as a blur leaves it",
        mend: "hash every cell by itself",
        claim: "hash.lags",
        subject: || {
            hashed_by(|[x, y, z], octave| {
                let share = 0.08;
                let mixed = (1.0 - share) * ideal_hash([x, y, z], octave)
                    + share * ideal_hash([x + 3.0, y, z], octave);
                cdf::cdf(mixed, share)
            })
            .subject()
        },
    },
    Specimen {
        name: "slanted-period",
        defect: "rows repeat 200 rows further up and 300 cells further along, as a buffer of too few cells makes them",
        mend: "hash whole indices",
        claim: "hash.copies",
        subject: || {
            hashed_by(|[x, y, z], octave| {
                let tiles = (y / 200.0).floor();
                ideal_hash([x - 300.0 * tiles, y - 200.0 * tiles, z], octave)
            })
            .subject()
        },
    },
    Specimen {
        name: "index-bit-lost",
        defect: "bit 6 of y is lost, as by a mask with a wrong digit",
        mend: "hash whole indices",
        claim: "hash.avalanche",
        subject: || {
            hashed_by(|[x, y, z], octave| {
                let kept = y as i32 & !(1 << 6);
                ideal_hash([x, f64::from(kept), z], octave)
            })
            .subject()
        },
    },
    Specimen {
        name: "bit-that-follows-an-index",
        defect: "the sixth digit of the hash is that of another hash, turned over by bit 7 of x",
        mend: "use a hash that mixes all bits, as murmur3 or pcg4d",
        claim: "hash.avalanche",
        subject: || {
            hashed_by(|[x, y, z], octave| {
                let x = x as i32;
                let hash = (ideal_hash([f64::from(x), y, z], octave) * 64.0).floor();
                let rest = ideal_hash([f64::from(x), y, z], octave) * 64.0 - hash;
                let other = ideal_hash([f64::from(x & !(1 << 7)), y, z], octave + 50);
                let digit = (other >= 0.5) ^ (x & (1 << 7) != 0);
                ((hash / 2.0).floor() * 2.0 + f64::from(u8::from(digit)) + rest) / 64.0
            })
            .subject()
        },
    },
    Specimen {
        name: "opposite-of-its-mirror",
        defect: "cells of negative z hold 1 - h for the hash h of their mirror image, as an odd function does",
        mend: "hash the sign as well",
        claim: "cells.symmetry",
        subject: || {
            hashed_by(|[x, y, z], octave| {
                if z < 0.0 {
                    1.0 - ideal_hash([x, y, -1.0 - z], octave)
                } else {
                    ideal_hash([x, y, z], octave)
                }
            })
            .subject()
        },
    },
    Specimen {
        name: "y-and-z-commute",
        defect: "the hash of x, y, z and that of x, z, y are the same",
        mend: "let the hash read each coordinate by itself",
        claim: "cells.symmetry",
        subject: || hashed_by(|[x, y, z], octave| ideal_hash([y + z, y * z, x], octave)).subject(),
    },
    Specimen {
        name: "octave-without-sign",
        defect: "the absolute value of the octave is hashed, so octaves k and -k have the same noise",
        mend: "hash the octave in two's complement",
        claim: "hash.octave_copies",
        subject: || hashed_by(|index, octave| ideal_hash(index, octave.abs())).subject(),
    },
    Specimen {
        name: "octave-not-below-zero",
        defect: "the octave is converted to an unsigned number, which makes 0 of all negative ones",
        mend: "hash the octave in two's complement",
        claim: "hash.octave_avalanche",
        subject: || hashed_by(|index, octave| ideal_hash(index, octave.max(0))).subject(),
    },
    Specimen {
        name: "linear-recurrence",
        defect: "along x the hash is the generator RANDU: three cells in a row satisfy a linear relation, any two look \
                 independent",
        mend: "use a hash that mixes all bits, as murmur3 or pcg4d",
        claim: "hash.triples",
        subject: || {
            hashed_by(|[x, y, z], octave| {
                let start = 2 * (ideal_hash([0.0, y, z], octave) * f64::from(1_u32 << 30)) as u64 + 1;
                // The multiplier has the order 2^29.
                let word = power(65_539, x.rem_euclid(f64::from(1_u32 << 29)) as u64) * start % (1 << 31);
                word as f64 / f64::from(1_u32 << 31)
            })
            .subject()
        },
    },
    Specimen {
        name: "sum-of-two-hashes",
        defect: "a hash of x and z and one of y and z are added modulo 1: three corners of a square tell the fourth",
        mend: "hash all three coordinates together",
        claim: "hash.squares",
        subject: || {
            hashed_by(|[x, y, z], octave| {
                let sum = of_two(x, z, octave) + of_two(z, y, octave + 100);
                sum - sum.floor()
            })
            .subject()
        },
    },
    Specimen {
        name: "octave-of-four-bits",
        defect: "four bits of the octave are hashed, so that an object of 65536 times the size has the same noise",
        mend: "hash the octave as a whole number",
        claim: "hash.octave_copies",
        subject: || hashed_by(|index, octave| ideal_hash(index, octave.rem_euclid(16))).subject(),
    },
    Specimen {
        name: "octave-ends-at-minus-16",
        defect: "octaves below -16 count as -16, so that in very large cells objects of twice the size have the same noise",
        mend: "hash the octave as a whole number",
        claim: "hash.octave_copies",
        subject: || hashed_by(|index, octave| ideal_hash(index, octave.max(-16))).subject(),
    },
    Specimen {
        name: "index-of-sixteen-bits",
        defect: "the index along z is packed into 16 bits, so the noise repeats after 65536 cells",
        mend: "hash whole indices",
        claim: "hash.avalanche",
        subject: || {
            hashed_by(|[x, y, z], octave| ideal_hash([x, y, z.rem_euclid(65536.0)], octave)).subject()
        },
    },
    Specimen {
        name: "one-octant-mirrored",
        defect: "where all three indices are negative they are turned around, so that one octant is the image of another",
        mend: "hash indices in two's complement",
        claim: "cells.symmetry",
        subject: || {
            hashed_by(|index, octave| {
                let is_folded = index.iter().all(|&c| c < 0.0);
                ideal_hash(if is_folded { index.map(|c| -1.0 - c) } else { index }, octave)
            })
            .subject()
        },
    },
    Specimen {
        name: "turned-about-the-diagonal",
        defect: "three hashes, of x and y, y and z, z and x, are added modulo 1: turning the axes in a ring leaves the noise as it is",
        mend: "let one hash read each coordinate by itself",
        claim: "cells.symmetry",
        subject: || {
            hashed_by(|[x, y, z], octave| {
                let sum = of_two(x, y, octave) + of_two(y, z, octave) + of_two(z, x, octave);
                sum - sum.floor()
            })
            .subject()
        },
    },
    Specimen {
        name: "row-on-the-axis",
        defect: "where y and z are in cell 0 the values along x are multiples of the golden ratio: each tells the next",
        mend: "hash the cells on an axis as all others",
        claim: "hash.lags",
        subject: || {
            hashed_by(|[x, y, z], octave| {
                let turned = 0.618_033_988_749_895 * x + ideal_hash([0.0; 3], octave);
                if y == 0.0 && z == 0.0 { turned - turned.floor() } else { ideal_hash([x, y, z], octave) }
            })
            .subject()
        },
    },
    Specimen {
        name: "even-number-in-a-cube",
        defect: "in odd octaves the last of eight cells is turned around where needed, so that an even number of each eight is kept",
        mend: "hash every cell by itself",
        claim: "hash.squares",
        subject: || {
            hashed_by(|index, octave| {
                let value = ideal_hash(index, octave);
                let base = index.map(|c| 2.0 * (c / 2.0).floor());
                if octave & 1 == 0 || index.iter().zip(base).any(|(c, base)| *c == base) {
                    return value;
                }
                let others = (0..7_u8).filter(|corner| {
                    let at = [0, 1, 2].map(|axis| base[axis] + f64::from(corner >> axis & 1));
                    ideal_hash(at, octave) < 0.5
                });
                let is_even = others.count() % 2 == 0;
                if is_even == (value < 0.5) { 1.0 - value } else { value }
            })
            .subject()
        },
    },
];
