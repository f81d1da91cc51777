//! Cells that inherit from their parents in another way than the join claims.

use super::defect::Specimen;
use super::port::{cell, ideal_hash, of_footprint};
use crate::check::Subject;
use crate::check::subject::Precision;
use crate::threshold::robust::nested::LEVELS;
use crate::threshold::robust::{Join, Repairs, scales};
use crate::threshold::two_scale::Variant;

/// How a cell finds what it inherits.
#[derive(Clone, Copy)]
struct Rules {
    /// Whether a cell that keeps asks its parent for its threshold, or takes the hash of the parent.
    asks: bool,
    /// Indices of a cell and its octave -> where its parent begins to be counted, 0 or 1.
    begin: fn(i32) -> i64,
    /// Indices of a parent and its octave -> a number in [0, 1) that orders its pairs of children.
    order: fn([i64; 3], i32) -> f64,
    /// Indices of a parent and its octave -> the hash that fills the thirds.
    fill: fn([i64; 3], i32) -> f64,
    /// The order and a pair -> its share: 0 keeps, 1 to 3 have a third each.
    share: fn(f64, i64) -> i64,
}

/// No rule is wrong.
const SOUND: Rules = Rules {
    asks: true,
    begin: |octave| i64::from(octave & 1 == 0),
    order: |index, octave| ideal_hash(index.map(|index| index as f64), octave ^ 0x5bd1_e995),
    fill: |index, octave| ideal_hash(index.map(|index| index as f64), octave),
    share: |order, pair| {
        let twelfth = (12.0 * order) as i64;
        let after_keeper = pair ^ (twelfth & 3);
        if after_keeper == 0 { 0 } else { (after_keeper + (twelfth >> 2) - 1) % 3 + 1 }
    },
};

impl Rules {
    fn subject(self) -> Subject<'static> {
        let mut subject = of_footprint(Precision::F64, move |found| {
            let scales = scales::robust_scales::<f64>(Variant::Isotropic, found, 1.0, Repairs::ALL);
            let (octave, fraction) = (scales.octave[0], scales.fraction[0]);
            let coin = ideal_hash(cell(found.position, octave), octave ^ 0x6a09_e667);
            let octave = if fraction > coin { octave + 1 } else { octave };
            self.inherited(cell(found.position, octave).map(|index| index as i64), octave)
        });
        subject.join = Join::Inherit;
        subject
    }

    fn inherited(self, mut index: [i64; 3], mut octave: i32) -> f64 {
        for level in 1.. {
            let [x, y, z] = index.map(|index| index + (self.begin)(octave));
            let parent = [x >> 1, y >> 1, z >> 1];
            let pair = ((x ^ z) & 1) | (((y ^ z) & 1) << 1);
            let share = (self.share)((self.order)(parent, octave - 1), pair);
            if share == 0 && !self.asks {
                return (self.fill)(parent, octave - 1);
            }
            if share != 0 || level == LEVELS {
                let hash = (self.fill)(parent, octave - 1);
                let value = if z & 1 == 0 {
                    hash
                } else if hash < 0.5 {
                    hash + 0.5
                } else {
                    hash - 0.5
                };
                return if share == 0 { value } else { ((share - 1) as f64 + value) / 3.0 };
            }
            (index, octave) = (parent, octave - 1);
        }
        unreachable!("the last level returns")
    }
}

pub(super) const FAMILY: &[Specimen] = &[
    Specimen {
        name: "parent-of-the-wrong-phase",
        defect: "the parent of a cell is half its index, though the cells of even octaves begin a third earlier: what is kept is the \
                 threshold of a cell that does not contain it",
        mend: "add 1 to the index of an even octave before it is halved",
        claim: "nested.children",
        subject: || Rules { begin: |_| 0, ..SOUND }.subject(),
    },
    Specimen {
        name: "children-in-one-order",
        defect: "the children of every parent are in the same order, so the same places keep their thresholds everywhere",
        mend: "order the children by a hash of the parent",
        claim: "nested.order",
        subject: || Rules { order: |_, _| 0.0, ..SOUND }.subject(),
    },
    Specimen {
        name: "a-third-twice",
        defect: "two pairs of children have the same third of the thresholds, and no pair has another third",
        mend: "give each pair a third of its own",
        claim: "nested.children",
        subject: || Rules { share: |order, pair| (SOUND.share)(order, pair).min(2), ..SOUND }.subject(),
    },
    Specimen {
        name: "neighbours-filled-alike",
        defect: "two parents beside each other along x fill the thirds of their children by one hash",
        mend: "hash every index of the parent",
        claim: "nested.order",
        subject: || {
            Rules { fill: |[x, y, z], octave| (SOUND.fill)([x >> 1, y, z], octave), ..SOUND }.subject()
        },
    },
    Specimen {
        name: "kept-for-one-octave",
        defect: "a cell keeps the hash of its parent's own cell and not what the parent itself has kept: after an octave everything \
                 is new",
        mend: "ask the parent for the threshold that it has, not for its hash",
        claim: "nested.kept",
        subject: || Rules { asks: false, ..SOUND }.subject(),
    },
];
