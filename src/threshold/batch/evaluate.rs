//! Thresholds of a block: octaves, cells, hashes, join, each a short loop.
//!
//! Every choice is made outside the loops, and every loop stands here once: a hash is one loop whatever is joined.

use super::block::{BLOCK, Block};
use super::cells::{at_octaves, at_scale, hash, words};
use super::columns::{BlockColumns, Columns};
use super::isa::Job;
use super::lane::Kernel;
use super::nested::{Shares, names};
use super::octaves::{Octaves, is_plain, longest_derivative, reaches};
use super::plan::Plan;
use crate::threshold::cdf::{CdfForm, cdf, cdf_literal};
use crate::threshold::hash::octave_word;
use crate::threshold::model::Model;
use crate::threshold::real::Real;
use crate::threshold::robust::Join;
use crate::threshold::robust::join::{CHOICE, interval_word, variance_along};
use crate::threshold::robust::scales::corner_weight;
use crate::threshold::two_scale::Variant;

/// The thresholds of columns, in the order of the footprints.
pub(super) struct Thresholds<'a, R> {
    pub model: &'a Model,
    pub plan: Plan<R>,
    pub columns: Columns<'a, R>,
    pub out: &'a mut [R],
}

impl<R: Kernel> Job for Thresholds<'_, R> {
    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        let mut stages = Stages::new();
        let Self { model, plan, columns, out } = self;
        let (mut tail, mut values) = ([[[R::from_f64(1.0); BLOCK]; 3]; 3], [R::from_f64(0.0); BLOCK]);
        for (at, out) in out.chunks_mut(BLOCK).enumerate() {
            let block = BlockColumns::at(&columns, at * BLOCK, &mut tail);
            stages.evaluate::<FUSED>(&plan, &block, &mut values);
            out.copy_from_slice(&values[..out.len()]);
            scalar_where_nan(model, &columns, at * BLOCK, out);
        }
    }
}

/// Evaluates by the scalar path what the loops were not sure of.
#[inline(always)]
fn scalar_where_nan<R: Kernel>(model: &Model, columns: &Columns<'_, R>, first: usize, out: &mut [R]) {
    let mut any = false;
    for value in out.iter() {
        any |= value.is_nan();
    }
    if any {
        for (i, value) in out.iter_mut().enumerate().filter(|(_, value)| value.is_nan()) {
            *value = model.threshold(&columns.footprint(first + i));
        }
    }
}

/// Every intermediate array of a block.
struct Stages<R> {
    octaves: Octaves<R>,
    /// Cells that are coarse along every axis, and fine along every axis; those that are chosen take the place of the
    /// latter.
    coarse: [Block<R>; 3],
    fine: [Block<R>; 3],
    /// The words of the cells that are hashed.
    word: Block<u32>,
    /// The octaves of the cells that are chosen.
    chosen: [Block<i32>; 3],
    /// What the chosen cells have of their parents.
    shares: Shares,
    /// The last two hashes, in turn.
    hashes: [Block<R>; 2],
    /// Where there is no octave: the two scales, and the weight of the second.
    scales: [Block<R>; 2],
    weight: Block<R>,
    /// The sum of normal quantiles.
    sum: Block<R>,
}

impl<R: Kernel> Stages<R> {
    #[inline(always)]
    fn new() -> Self {
        let zeros = [R::from_f64(0.0); BLOCK];
        Self {
            octaves: Octaves::new(),
            coarse: [zeros; 3],
            fine: [zeros; 3],
            word: [0; BLOCK],
            chosen: [[0; BLOCK]; 3],
            shares: Shares::new(),
            hashes: [zeros; 2],
            scales: [zeros; 2],
            weight: zeros,
            sum: zeros,
        }
    }

    /// Writes the thresholds of a block; NaN for those that the scalar path must decide.
    #[inline(always)]
    fn evaluate<const FUSED: bool>(
        &mut self,
        plan: &Plan<R>,
        block: &BlockColumns<'_, R>,
        out: &mut Block<R>,
    ) {
        let by_octave = matches!(plan.variant, Variant::Isotropic | Variant::Anisotropic);
        if by_octave {
            self.octaves.find::<FUSED>(plan, block);
            at_octaves::<R, FUSED>(plan, block, &self.octaves.coarse, &mut self.coarse);
            if !plan.join.switches() {
                at_octaves::<R, FUSED>(plan, block, &self.octaves.fine, &mut self.fine);
            }
        } else {
            self.scales_without_octave::<FUSED>(plan, block);
        }
        if plan.join == Join::Copula {
            self.sum = [R::from_f64(0.0); BLOCK];
        }
        let looks = plan.looks();
        for look in 0..looks {
            self.look::<FUSED>(plan, block, look);
            match plan.join {
                Join::Interpolate => {}
                Join::Copula => self.add_quantiles(plan, look),
                Join::Dithered | Join::Inherit if look < plan.axes => self.choose(look),
                Join::Dithered | Join::Inherit => {}
            }
        }
        match (plan.variant, plan.join) {
            (Variant::Single, _) => *out = self.hashes[0],
            (_, Join::Interpolate) => self.interpolate(plan, out),
            (_, Join::Copula) => self.normal_cdf(plan, out),
            (Variant::Isotropic, Join::Inherit) => self.shares.of_hashes(&self.hashes[(looks - 1) % 2], out),
            (_, Join::Dithered | Join::Inherit) => *out = self.hashes[(looks - 1) % 2],
        }
        self.finish(plan, out);
    }

    /// Hashes the cells that are looked at next.
    #[inline(always)]
    fn look<const FUSED: bool>(&mut self, plan: &Plan<R>, block: &BlockColumns<'_, R>, look: usize) {
        let zeros = [R::from_f64(0.0); BLOCK];
        let Self { octaves, coarse, fine, word, chosen, shares, scales, .. } = self;
        let chooses = plan.join.switches() && look < plan.axes;
        let index = if matches!(plan.variant, Variant::Linear | Variant::Single) {
            for i in 0..BLOCK {
                // The derivative stands in for the octave in the one, nothing in the other.
                word[i] = chosen[look][i] as u32;
            }
            at_scale::<R, FUSED>(block, &scales[look], coarse);
            coarse.each_ref()
        } else if plan.join.switches() && !chooses {
            at_octaves::<R, FUSED>(plan, block, chosen, fine);
            match (plan.join, plan.axes) {
                (Join::Inherit, 1) => shares.find(plan, fine, &chosen[0], word),
                (Join::Inherit, _) => names(plan, fine, chosen, word),
                (Join::Interpolate | Join::Copula | Join::Dithered, _) => {
                    words(plan, chosen.each_ref(), word);
                }
            }
            fine.each_ref()
        } else if chooses && plan.axes == 3 {
            for i in 0..BLOCK {
                word[i] = interval_word(look, octaves.coarse[look][i]);
            }
            [&coarse[look], &zeros, &zeros]
        } else {
            // One bit of `look` for each axis of a corner; between two cells one for all axes.
            let is_fine = [0, 1, 2].map(|axis| {
                look >> (if plan.join == Join::Copula && plan.axes == 3 { axis } else { 0 }) & 1 == 1
            });
            let axes = [0, 1, 2];
            let octave =
                axes.map(|axis| if is_fine[axis] { &octaves.fine[axis] } else { &octaves.coarse[axis] });
            words(plan, octave, word);
            if chooses {
                for i in 0..BLOCK {
                    word[i] ^= CHOICE;
                }
            }
            axes.map(|axis| if is_fine[axis] { &fine[axis] } else { &coarse[axis] })
        };
        hash::<R, FUSED>(plan.hash, plan.tier, index, word, &mut self.hashes[look % 2]);
    }

    /// Finds the scales of the ablations of §5.4.
    #[inline(always)]
    fn scales_without_octave<const FUSED: bool>(&mut self, plan: &Plan<R>, block: &BlockColumns<'_, R>) {
        let (one, largest) = (R::from_f64(1.0), plan.largest_cell());
        let Self { octaves, chosen, scales, weight, .. } = self;
        let [first, second] = scales;
        if plan.variant == Variant::Single {
            for i in 0..BLOCK {
                let (longest, sure) = longest_derivative(block, i);
                first[i] = one / (plan.hash_scale * longest);
                octaves.sure[i] = sure & is_plain(first[i]) & reaches(largest, block, first[i], i);
                chosen[0][i] = 0;
            }
            return;
        }
        for i in 0..BLOCK {
            let (longest, sure) = longest_derivative(block, i);
            let (floor, ceil) = (longest.lane_floor::<FUSED>(), -(-longest).lane_floor::<FUSED>());
            weight[i] = longest - floor;
            first[i] = one / (plan.hash_scale * floor);
            second[i] = one / (plan.hash_scale * ceil);
            let sure = sure & (longest >= one) & (longest <= R::LARGEST_WORD);
            let plain = is_plain(first[i]) & is_plain(second[i]);
            octaves.sure[i] = sure & plain & reaches(largest, block, first[i], i);
            chosen[0][i] = octave_word([floor.small_word() as i32; 3]) as i32;
            chosen[1][i] = octave_word([ceil.small_word() as i32; 3]) as i32;
        }
    }

    /// Mixes two hashes and makes the mixture uniform.
    #[inline(always)]
    fn interpolate(&mut self, plan: &Plan<R>, out: &mut Block<R>) {
        let one = R::from_f64(1.0);
        let Self { octaves, hashes: [first, second], weight, .. } = self;
        if plan.variant == Variant::Anisotropic {
            let [x, y, z] = &octaves.fraction;
            for i in 0..BLOCK {
                weight[i] = corner_weight([x[i], y[i], z[i]]);
            }
        }
        let weight = if plan.variant == Variant::Isotropic { &octaves.fraction[0] } else { weight };
        let mix = |i: usize| (one - weight[i]) * first[i] + weight[i] * second[i];
        match plan.cdf {
            None => {
                for i in 0..BLOCK {
                    out[i] = mix(i);
                }
            }
            Some(CdfForm::Literal) => {
                for i in 0..BLOCK {
                    out[i] = cdf_literal(mix(i), weight[i]);
                }
            }
            Some(CdfForm::Stable) => {
                for i in 0..BLOCK {
                    out[i] = cdf(mix(i), weight[i]);
                }
            }
        }
    }

    /// Adds the normal quantile of a corner's hash with its trilinear weight.
    #[inline(always)]
    fn add_quantiles(&mut self, plan: &Plan<R>, look: usize) {
        let one = R::from_f64(1.0);
        let Self { octaves, hashes, weight, sum, .. } = self;
        *weight = [one; BLOCK];
        for axis in 0..plan.axes {
            let fraction = &octaves.fraction[axis];
            if look >> axis & 1 == 1 {
                for i in 0..BLOCK {
                    weight[i] = weight[i] * fraction[i];
                }
            } else {
                for i in 0..BLOCK {
                    weight[i] = weight[i] * (one - fraction[i]);
                }
            }
        }
        let hash = &hashes[look % 2];
        for i in 0..BLOCK {
            sum[i] = sum[i] + weight[i] * hash[i].normal_quantile();
        }
    }

    /// Scales the sum of quantiles to unit variance, and makes it uniform.
    #[inline(always)]
    fn normal_cdf(&self, plan: &Plan<R>, out: &mut Block<R>) {
        let Octaves { fraction: [x, y, z], .. } = &self.octaves;
        for i in 0..BLOCK {
            out[i] = variance_along(x[i]);
        }
        if plan.axes == 3 {
            for i in 0..BLOCK {
                out[i] = out[i] * variance_along(y[i]) * variance_along(z[i]);
            }
        }
        for i in 0..BLOCK {
            out[i] = (self.sum[i] / out[i].sqrt()).normal_cdf();
        }
    }

    /// Takes the fine octave of an axis where the fraction is above the last hash.
    #[inline(always)]
    fn choose(&mut self, axis: usize) {
        let Octaves { coarse, fine, fraction, sure, .. } = &mut self.octaves;
        let choice = &self.hashes[axis % 2];
        for i in 0..BLOCK {
            sure[i] &= !choice[i].is_nan();
            let is_fine = fraction[axis][i] > choice[i];
            self.chosen[axis][i] = if is_fine { fine[axis][i] } else { coarse[axis][i] };
        }
    }

    /// Clamps, and marks what the loops are not sure of.
    #[inline(always)]
    fn finish(&self, plan: &Plan<R>, out: &mut Block<R>) {
        let [nan, one] = [f64::NAN, 1.0].map(R::from_f64);
        if let Some(smallest) = plan.smallest {
            for value in out.iter_mut() {
                *value = Real::clamp(*value, smallest, one);
            }
        }
        for (value, sure) in out.iter_mut().zip(&self.octaves.sure) {
            *value = if *sure { *value } else { nan };
        }
    }
}
