//! Cells that are cut wrongly, or that share a hash because it sees only a part of them.

use super::defect::Specimen;
use super::port::{Port, SOUND, cut, ideal_hash};
use crate::threshold::hash::sine::{hash_2d, hash_3d};
use glam::DVec3;

/// Listing 1 with cells of its own.
const fn cut_by(cell: fn(DVec3, i32) -> [f64; 3]) -> Port {
    Port { cell, ..SOUND }
}

/// Listing 1 over the ideal source of other indices.
const fn seeing(hash: fn([f64; 3], i32) -> f64) -> Port {
    Port { hash, ..SOUND }
}

/// Hashes two coordinates into 4096 values, and those with the third.
fn by_few_values([first, second]: [f64; 2], third: f64, octave: i32) -> f64 {
    let value = (ideal_hash([first, second, 0.0], 0) * 4096.0).floor();
    ideal_hash([value, 0.0, third], octave)
}

fn is_odd(index: f64) -> bool {
    index.rem_euclid(2.0) == 1.0
}

pub(super) const FAMILY: &[Specimen] = &[
    Specimen {
        name: "truncation",
        defect: "coordinates are truncated towards zero, as a cast to an integer does, so the cells at zero are twice as wide",
        mend: "round down with floor before the cast",
        claim: "independence.across_zero",
        subject: || cut_by(|position, octave| cut(position, octave, f64::trunc)).subject(),
    },
    Specimen {
        name: "nearest-cell",
        defect: "coordinates are rounded to the nearest whole number and not down, so fine cells do not divide coarse ones (by a \
                 cast to an integer those at zero are twice as wide, too)",
        mend: "round down with floor",
        claim: "exact.cells",
        subject: || {
            cut_by(|position, octave| {
                (position * libm::ldexp(1.0, octave)).to_array().map(|c| libm::trunc(c + 0.5))
            })
            .subject()
        },
    },
    Specimen {
        name: "no-floor",
        defect: "the scaled position is hashed without being rounded down, so every move redraws every \
                 threshold",
        mend: "round down with floor",
        claim: "spectrum.radial",
        subject: || {
            Port {
                cell: |position, octave| (position * libm::ldexp(1.0, octave)).into(),
                hash: |position, _| hash_3d::<f64>(position.into()),
                ..SOUND
            }
            .subject()
        },
    },
    Specimen {
        name: "smooth-noise",
        defect: "the hash is interpolated between the corners of a cell, as value noise is: neither uniform nor constant in it",
        mend: "hash the cell, without interpolation",
        claim: "exact.cells",
        subject: || {
            Port {
                cell: |position, octave| (position * libm::ldexp(1.0, octave)).into(),
                hash: |position, octave| {
                    let (low, within) = (position.map(f64::floor), position.map(|c| c - c.floor()));
                    (0..8)
                        .map(|corner| [0, 1, 2].map(|axis| f64::from(corner >> axis & 1)))
                        .map(|corner| {
                            let weights = [0, 1, 2].map(|axis| {
                                if corner[axis] == 1.0 { within[axis] } else { 1.0 - within[axis] }
                            });
                            let index = [0, 1, 2].map(|axis| low[axis] + corner[axis]);
                            weights.iter().product::<f64>() * ideal_hash(index, octave)
                        })
                        .sum()
                },
                ..SOUND
            }
            .subject()
        },
    },
    Specimen {
        name: "without-x",
        defect: "the hash does not read x, so the noise is made of stripes",
        mend: "hash all three coordinates",
        claim: "independence.neighbours",
        subject: || seeing(|[_, y, z], octave| ideal_hash([0.0, y, z], octave)).subject(),
    },
    Specimen {
        name: "two-dimensional-hash",
        defect: "the hash does not read z, so parallel layers have the same noise",
        mend: "hash all three coordinates",
        claim: "layers.parallel",
        subject: || seeing(|[x, y, _], octave| ideal_hash([x, y, 0.0], octave)).subject(),
    },
    Specimen {
        name: "two-dimensional-sine",
        defect: "the paper's hash of two coordinates stands in for that of three",
        mend: "hash the hash of x and y together with z, or use an integer hash",
        claim: "hash.resonance",
        subject: || seeing(|[x, y, _], _| hash_2d(x, y)).subject(),
    },
    Specimen {
        name: "few-values-of-y-and-z",
        defect: "y and z are hashed into 4096 values before x comes in, so each plane of constant x has a bias",
        mend: "keep all bits of the first hash for the second, or use an integer hash",
        claim: "uniform.constant_x",
        subject: || seeing(|[x, y, z], octave| by_few_values([y, z], x, octave)).subject(),
    },
    Specimen {
        name: "few-values-of-z-and-x",
        defect: "z and x are hashed into 4096 values before y comes in, so each plane of constant y has a bias",
        mend: "keep all bits of the first hash for the second, or use an integer hash",
        claim: "uniform.constant_y",
        subject: || seeing(|[x, y, z], octave| by_few_values([z, x], y, octave)).subject(),
    },
    Specimen {
        name: "few-values-of-x-and-y",
        defect: "x and y are hashed into 4096 values before z comes in, so each plane of constant z has a bias",
        mend: "keep all bits of the first hash for the second, or use an integer hash",
        claim: "uniform.constant_z",
        subject: || seeing(|[x, y, z], octave| by_few_values([x, y], z, octave)).subject(),
    },
    Specimen {
        name: "lowest-bit-dropped",
        defect: "the lowest bit of x is lost before the hash, so cells share a value in twos",
        mend: "hash whole indices",
        claim: "independence.neighbours",
        subject: || seeing(|[x, y, z], octave| ideal_hash([(0.5 * x).floor(), y, z], octave)).subject(),
    },
    Specimen {
        name: "tied-diagonals",
        defect: "cells that are odd in x and y have the hash of the one diagonally below",
        mend: "hash every cell by itself",
        claim: "independence.diagonals",
        subject: || {
            seeing(|[x, y, z], octave| {
                let back = if is_odd(x) && is_odd(y) { 1.0 } else { 0.0 };
                ideal_hash([x - back, y - back, z], octave)
            })
            .subject()
        },
    },
    Specimen {
        name: "sum-of-coordinates",
        defect: "the coordinates are added before they are hashed, so diagonals are all alike",
        mend: "let the hash read each coordinate by itself",
        claim: "independence.diagonals",
        subject: || seeing(|[x, y, z], octave| ideal_hash([x + y + z, 0.0, 0.0], octave)).subject(),
    },
    Specimen {
        name: "xor-of-coordinates",
        defect: "the coordinates are joined by exclusive or before they are hashed, which does not tell their order",
        mend: "let the hash read each coordinate by itself",
        claim: "cells.mirror",
        subject: || {
            seeing(|index, octave| {
                let [x, y, z] = index.map(|c| c as i32);
                ideal_hash([f64::from(x ^ y ^ z), 0.0, 0.0], octave)
            })
            .subject()
        },
    },
    Specimen {
        name: "commuting-coordinates",
        defect: "the hash of x, y and the hash of y, x are the same",
        mend: "let the hash read each coordinate by itself",
        claim: "cells.mirror",
        subject: || seeing(|[x, y, z], octave| ideal_hash([x + y, x * y, z], octave)).subject(),
    },
    Specimen {
        name: "sixteen-bit-indices",
        defect: "indices are clamped to 16 bits, so far from the origin all cells are one",
        mend: "keep 32 bits of each index",
        claim: "cells.window",
        subject: || {
            seeing(|index, octave| ideal_hash(index.map(|c| c.clamp(-32_768.0, 32_767.0)), octave)).subject()
        },
    },
    Specimen {
        name: "eight-bit-indices",
        defect: "indices are clamped to 8 bits, so away from the origin all cells are one",
        mend: "keep 32 bits of each index",
        claim: "cells.window",
        subject: || {
            seeing(|index, octave| ideal_hash(index.map(|c| c.clamp(-128.0, 127.0)), octave)).subject()
        },
    },
    Specimen {
        name: "octave-not-hashed",
        defect: "the hash does not read the octave, so an object of half the size has the same noise, and the origin one threshold",
        mend: "hash the octave as a fourth word",
        claim: "independence.octaves",
        subject: || seeing(|index, _| ideal_hash(index, 0)).subject(),
    },
    Specimen {
        name: "octave-copies-another",
        defect: "every fourth cell along each axis has the hash of the cell two octaves above it",
        mend: "hash the octave as a fourth word",
        claim: "independence.octaves",
        subject: || {
            seeing(|index, octave| {
                if index.iter().all(|c| c.rem_euclid(4.0) == 0.0) {
                    ideal_hash(index.map(|c| c / 4.0), octave - 2)
                } else {
                    ideal_hash(index, octave)
                }
            })
            .subject()
        },
    },
    Specimen {
        name: "octaves-in-twos",
        defect: "every other octave repeats the one above it, cell by cell",
        mend: "hash the octave as a fourth word, and the index of that octave",
        claim: "hash.children",
        subject: || {
            seeing(|index, octave| {
                if octave.rem_euclid(2) == 1 {
                    ideal_hash(index.map(|c| (c / 2.0).floor()), octave - 1)
                } else {
                    ideal_hash(index, octave)
                }
            })
            .subject()
        },
    },
    Specimen {
        name: "antithetic-layers",
        defect: "every other layer of cells has 1 - h for the hash h of the layer below, as if to save a hash",
        mend: "hash every cell by itself",
        claim: "independence.neighbours",
        subject: || {
            seeing(|[x, y, z], octave| {
                if is_odd(z) {
                    1.0 - ideal_hash([x, y, z - 1.0], octave)
                } else {
                    ideal_hash([x, y, z], octave)
                }
            })
            .subject()
        },
    },
];
