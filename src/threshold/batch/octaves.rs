//! From footprints to octaves, block by block: the first half of both listings.

use super::block::{BLOCK, Block};
use super::columns::BlockColumns;
use super::lane::Kernel;
use super::plan::Plan;
use super::tier::Tier;
use crate::threshold::real::Real;
use crate::threshold::robust::scales::floored;

/// The octaves of a block, and where between them each footprint lies. One scale fills the first of three arrays.
pub(super) struct Octaves<R> {
    pub coarse: [Block<i32>; 3],
    pub fine: [Block<i32>; 3],
    pub fraction: [Block<R>; 3],
    /// Whether the loops go the scalar path's way for this footprint; where not, the result does not count.
    pub sure: Block<bool>,
    /// Cells per object unit.
    scale: [Block<R>; 3],
}

impl<R: Kernel> Octaves<R> {
    #[inline(always)]
    pub fn new() -> Self {
        let zero = R::from_f64(0.0);
        Self {
            coarse: [[0; BLOCK]; 3],
            fine: [[0; BLOCK]; 3],
            fraction: [[zero; BLOCK]; 3],
            sure: [false; BLOCK],
            scale: [[zero; BLOCK]; 3],
        }
    }

    /// Finds the octaves of a block.
    #[inline(always)]
    pub fn find<const FUSED: bool>(&mut self, plan: &Plan<R>, block: &BlockColumns<'_, R>) {
        if plan.axes == 3 {
            self.scales_along_axes(plan, block);
        } else {
            self.scales(plan, block);
        }
        for axis in 0..plan.axes {
            self.split::<FUSED>(plan, axis);
        }
        // No cell that is looked at is finer than the fine one. A sum keeps NaN; a maximum would not.
        let mut reach = [R::from_f64(0.0); BLOCK];
        for axis in 0..3 {
            let (fine, position) = (&self.fine[axis.min(plan.axes - 1)], block.position[axis]);
            for i in 0..BLOCK {
                reach[i] = reach[i] + (R::power(fine[i]) * position[i]).abs();
            }
        }
        let largest = plan.largest_cell();
        for i in 0..BLOCK {
            self.sure[i] &= reach[i] <= largest;
        }
    }

    /// Finds the scales of Listing 1.
    #[inline(always)]
    fn scales(&mut self, plan: &Plan<R>, block: &BlockColumns<'_, R>) {
        let one = R::from_f64(1.0);
        for i in 0..BLOCK {
            let (longest, sure) = longest_derivative(block, i);
            let mut side = plan.hash_scale * longest;
            if let Some(bounds) = plan.floor {
                [side, _, _] = floored([side; 3], block.position.map(|axis| axis[i]), bounds);
            }
            self.scale[0][i] = one / side;
            self.sure[i] = sure & is_plain(self.scale[0][i]);
        }
    }

    /// Finds the scales of Listing 2.
    #[inline(always)]
    fn scales_along_axes(&mut self, plan: &Plan<R>, block: &BlockColumns<'_, R>) {
        let numerator = R::from_f64(0.707);
        let [_, largest] = R::SCALES;
        for i in 0..BLOCK {
            let (dx, dy) = (block.dpdx.map(|axis| axis[i]), block.dpdy.map(|axis| axis[i]));
            let derivative = [0, 1, 2].map(|axis| Real::max(dx[axis].abs(), dy[axis].abs()));
            let mut side = derivative.map(|derivative| plan.hash_scale * derivative);
            if let Some(bounds) = plan.floor {
                side = floored(side, block.position.map(|axis| axis[i]), bounds);
            }
            let mut sure = true;
            for axis in 0..3 {
                let scale = numerator / side[axis];
                sure &= (dx[axis].abs() <= largest) & (dy[axis].abs() <= largest) & is_plain(scale);
                self.scale[axis][i] = scale;
            }
            self.sure[i] = sure;
        }
    }

    /// Splits the scales along an axis into octave and fraction.
    #[inline(always)]
    fn split<const FUSED: bool>(&mut self, plan: &Plan<R>, axis: usize) {
        let Self { coarse, fine, fraction, scale, .. } = self;
        let (coarse, fine, fraction, scale) =
            (&mut coarse[axis], &mut fine[axis], &mut fraction[axis], &scale[axis]);
        if plan.tier != Tier::BitExact {
            for i in 0..BLOCK {
                (coarse[i], fraction[i]) = R::octave_fast(scale[i]);
            }
        } else if plan.one_log2 {
            for i in 0..BLOCK {
                (coarse[i], fraction[i]) = R::octave_by_exponent::<FUSED>(scale[i]);
            }
        } else {
            for i in 0..BLOCK {
                (coarse[i], fraction[i]) = R::octave::<FUSED>(scale[i]);
            }
        }
        let zero = R::from_f64(0.0);
        for i in 0..BLOCK {
            let between = plan.one_log2 | (fraction[i] != zero);
            fine[i] = coarse[i].wrapping_add(i32::from(between));
        }
    }
}

/// Returns the longer of the two derivatives, and whether it comes out as with two roots and no scaling.
///
/// The larger root is the root of the larger square: rounding keeps the order.
#[inline(always)]
pub(super) fn longest_derivative<R: Kernel>(block: &BlockColumns<'_, R>, i: usize) -> (R, bool) {
    #[inline(always)]
    fn square<R: Real>(vector: [&Block<R>; 3], i: usize) -> R {
        let [x, y, z] = [vector[0][i], vector[1][i], vector[2][i]];
        x * x + y * y + z * z
    }
    let (dx, dy) = (square(block.dpdx, i), square(block.dpdy, i));
    let longest = Real::max(dx, dy);
    let [smallest, largest] = R::SQUARES;
    (longest.sqrt(), (dx <= largest) & (dy <= largest) & (longest >= smallest))
}

/// Returns whether a scale has an octave, and cells, that do not overflow.
#[inline(always)]
pub(super) fn is_plain<R: Kernel>(scale: R) -> bool {
    let [smallest, largest] = R::SCALES;
    (scale >= smallest) & (scale <= largest)
}

/// Returns whether the cells of a scale have coordinates that add up to at most the largest.
#[inline(always)]
pub(super) fn reaches<R: Kernel>(largest: R, block: &BlockColumns<'_, R>, scale: R, i: usize) -> bool {
    let [x, y, z] = block.position;
    (scale * x[i]).abs() + (scale * y[i]).abs() + (scale * z[i]).abs() <= largest
}
