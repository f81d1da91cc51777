//! What a port by hand gets wrong, in the words of the specimen that is broken in that way.

use crate::check::specimen;
use core::fmt;

/// One mistake in one step of a threshold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Slip {
    /// Its name: that of the specimen with this defect, where there is one.
    pub name: &'static str,
    /// What is wrong, in one sentence.
    pub defect: &'static str,
    /// What to change, in one sentence.
    pub mend: &'static str,
}

/// Defect and mend.
impl fmt::Display for Slip {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { defect, mend, .. } = self;
        write!(f, "{defect}: {mend}")
    }
}

/// A slip, and what shows it.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Found {
    /// What is wrong.
    pub slip: Slip,
    /// Where it shows, with a number.
    pub shown: String,
}

pub(super) fn found(slip: Slip, shown: String) -> Found {
    Found { slip, shown }
}

/// Where it shows, what is wrong, what to change.
impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { slip: Slip { name, defect, mend }, shown } = self;
        write!(f, "{name}: {defect} ({shown}); {mend}")
    }
}

/// Slips that no specimen has: they are told by an experiment, and the claims that they fail are those of another one.
const OTHERS: &[Slip] = &[
    Slip {
        name: "noise-of-another-size",
        defect: "cells are not as wide as the hash scale says",
        mend: "multiply the derivative by the hash scale and by nothing else, or declare the size with --hash-scale",
    },
    Slip {
        name: "one-plus-derivative",
        defect: "1 is added to the derivative before it divides, so cells are never smaller than a unit",
        mend: "take 1 / (hash scale * derivative) for the scale, with no more than a tiny floor below the derivative",
    },
    Slip {
        name: "weight-of-the-scale",
        defect: "the weight between the octaves is the fraction of the scale and not of its logarithm",
        mend: "let the weight of the finer octave be the fraction of the logarithm",
    },
    Slip {
        name: "octave-rounded",
        defect: "the octave is the nearest one and not the one below, and the weight is that of the one below",
        mend: "take floor and fraction of one logarithm",
    },
    Slip {
        name: "mean-of-two",
        defect: "the two hashes are averaged whatever the weight, and the CDF has the weight",
        mend: "interpolate between the hashes with the weight that the CDF has",
    },
    Slip {
        name: "finer-cells-uncut",
        defect: "the position is cut to cells at the coarser scale only: the hash at the finer one changes within its cells",
        mend: "take floor of the position at both scales",
    },
    Slip {
        name: "first-case-wrong",
        defect: "the first case of Eq. 2 (x below a) is another formula; the other two are right",
        mend: "x * x / (2 * a * (1 - a)) where x < a, with a = min(lerp factor, 1 - lerp factor)",
    },
    Slip {
        name: "middle-case-wrong",
        defect: "the middle case of Eq. 2 (x from a to 1 - a) is another formula; the other two are right",
        mend: "(x - a / 2) / (1 - a) where a <= x < 1 - a, with a = min(lerp factor, 1 - lerp factor)",
    },
    Slip {
        name: "last-case-wrong",
        defect: "the last case of Eq. 2 (x from 1 - a on) is another formula; the other two are right",
        mend: "1 - (1 - x) * (1 - x) / (2 * a * (1 - a)) where x >= 1 - a, with a = min(lerp factor, 1 - lerp factor)",
    },
    Slip {
        name: "max-for-min-in-a",
        defect: "a of Eq. 2 is the larger one of the lerp factor and 1 - lerp factor, not the smaller one",
        mend: "let a = min(lerp factor, 1 - lerp factor)",
    },
    Slip {
        name: "without-y",
        defect: "the hash does not read y, so the noise is made of stripes",
        mend: "hash all three coordinates",
    },
    Slip {
        name: "coarse-steps",
        defect: "thresholds come in few steps, so only as many alphas can be told apart",
        mend: "leave the threshold as it is, without rounding it",
    },
    Slip {
        name: "reads-the-pixel",
        defect: "the threshold reads the pixel beside the position, so noise swims as the camera moves",
        mend: "leave the pixel out of the hash",
    },
    Slip {
        name: "reads-the-texture-coordinates",
        defect: "the threshold reads the texture coordinates beside the position, so every seam is a tear",
        mend: "leave the texture coordinates out of the hash",
    },
    Slip {
        name: "other-variant",
        defect: "cells are those of the other listing",
        mend: "declare it with --variant",
    },
    Slip {
        name: "other-phase",
        defect: "cells begin between whole numbers, at 1/3 in even octaves and 2/3 in odd ones",
        mend: "that is sound where it is declared: say --nested-phase",
    },
];

/// Returns the slip of a name. Called in constants only, so that the compiler looks every name up.
pub(super) const fn named(name: &'static str) -> Slip {
    let mut at = 0;
    while at < specimen::ALL.len() {
        let specimen = specimen::ALL[at];
        if is_same(specimen.name, name) {
            return Slip { name: specimen.name, defect: specimen.defect, mend: specimen.mend };
        }
        at += 1;
    }
    at = 0;
    while at < OTHERS.len() {
        if is_same(OTHERS[at].name, name) {
            return OTHERS[at];
        }
        at += 1;
    }
    panic!("no slip of this name")
}

const fn is_same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut at = 0;
    while at < a.len() && at < b.len() && a[at] == b[at] {
        at += 1;
    }
    at == a.len() && at == b.len()
}
