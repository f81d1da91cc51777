//! What cells that inherit have in common: laws of the join that is nested.
//!
//! The children of a parent make four pairs. One keeps the threshold of the parent, which is independent of the hash of the parent; the
//! others have thirds of [0, 1], which that hash fills. So two thresholds have something in common where both come from the children of one
//! parent: by themselves, or by keeping through the octaves between. What all children of a cell have in common that keeps through as many
//! octaves as are asked for, one in 256, is neglected. Not in the paper.

use crate::check::Subject;
use crate::check::subject::{Nominal, parent};
use crate::threshold::robust::Join;
use crate::threshold::robust::nested::{LEVELS, LONGEST_NAME};
use crate::threshold::two_scale::Variant;
use glam::DVec3;

/// The share of the cells of an octave that have the threshold of their ancestor so many octaves above; with one scale an axis,
/// of the intervals of an axis that have its name.
#[must_use]
pub fn share_kept(join: Join, variant: Variant, octaves: f64) -> f64 {
    let of_each = |kept: f64, longest: u32| {
        let left = f64::from(longest) - octaves;
        // What the child asks of parents, the ancestor asks of more.
        if left > 0.0 { libm::pow(kept, octaves) * (1.0 - libm::pow(kept, left)) } else { 0.0 }
    };
    match (join, variant) {
        (_, _) if octaves == 0.0 => 1.0,
        (Join::Interpolate | Join::Copula | Join::Dithered, _) => 0.0,
        // What has kept a name as long as can be has it still.
        (Join::Inherit, Variant::Anisotropic) => of_each(0.5, LONGEST_NAME + 1),
        (Join::Inherit, _) => of_each(0.25, LEVELS),
    }
}

/// The probability that the threshold of a point is that of its coarse cell.
pub(super) fn reach(fraction: f64) -> f64 {
    (1.0 - fraction) + 0.25 * fraction
}

/// The probability that two footprints of one view have one threshold though they share no cell: opposite children that both keep what
/// their parent has.
pub(crate) fn same_by_kin(subject: &Subject<'_>, [one, other]: [&Nominal; 2]) -> f64 {
    if !subject.has_kin() {
        return 0.0;
    }
    let mut octave = libm::ilogb(one.coarse_scale[0]);
    let mut cells = [one.coarse_cell, other.coarse_cell];
    let mut reach = reach(one.fraction[0]) * reach(other.fraction[0]);
    for _ in 0..LEVELS {
        let parents = cells.map(|cell| parent(cell, octave, subject.nested_phase));
        if parents[0] == parents[1] {
            let opposite = (cells[0] - cells[1]).abs() == DVec3::ONE;
            return if opposite { 0.25 * reach } else { 0.0 };
        }
        (cells, octave, reach) = (parents, octave - 1, reach / 16.0);
    }
    0.0
}

/// The probability that two children of one parent are both visible at `alpha` in [0, 1], where each has a third of its own.
pub(super) fn visible_in_thirds(alpha: f64) -> f64 {
    let (whole, part) = parts(alpha);
    whole * (whole - 1.0 + 2.0 * part) / 6.0
}

/// The same where they share a third, half of it apart.
pub(super) fn visible_in_halves(alpha: f64) -> f64 {
    let (whole, part) = parts(alpha);
    (whole + (2.0 * part - 1.0).max(0.0)) / 3.0
}

/// How many thirds lie below alpha, and how much of the next one.
fn parts(alpha: f64) -> (f64, f64) {
    let thirds = 3.0 * alpha;
    (thirds.floor(), thirds - thirds.floor())
}

/// The correlation of the thresholds of two children with a third of their own: filled alike, or half of it apart.
pub(super) fn correlation_in_thirds(opposite: bool) -> f64 {
    // Covariances in thirds: of two of three places, and of what fills them.
    let filled = if opposite { -1.0 / 24.0 } else { 1.0 / 12.0 };
    12.0 * (-1.0 / 3.0 + filled) / 9.0
}

/// The same where they share a third.
pub(super) const CORRELATION_IN_HALVES: f64 = 12.0 * (2.0 / 3.0 - 1.0 / 24.0) / 9.0;
