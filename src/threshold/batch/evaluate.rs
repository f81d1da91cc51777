//! Thresholds of a block: octaves, cells, hashes, join, each a short loop.
//!
//! Every choice is made outside the loops, and every loop stands here once: a hash is one loop whatever is joined.

use super::block::{BLOCK, Block};
use super::cells::Cells;
use super::columns::{BlockColumns, Columns};
use super::isa::Job;
use super::lane::Kernel;
use super::octaves::{Octaves, is_plain, longest_derivative, reaches};
use super::plan::Plan;
use crate::threshold::cdf::{CdfForm, minor_weight};
use crate::threshold::hash::octave_word;
use crate::threshold::model::Model;
use crate::threshold::normal::{normal_cdf, normal_quantile};
use crate::threshold::real::Real;
use crate::threshold::robust::Join;
use crate::threshold::robust::join::{CHOICE, EDGE, interval_word};
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
    cells: Cells<R>,
    /// Octaves that are neither the coarse nor the fine ones of all axes.
    chosen: [Block<i32>; 3],
    /// The last two hashes, in turn.
    hashes: [Block<R>; 2],
    /// Where there is no octave: the two scales, and the weight of the second.
    scales: [Block<R>; 2],
    weight: Block<R>,
    /// The sum of normal quantiles and its variance.
    sum: Block<f64>,
    variance: Block<f64>,
}

impl<R: Kernel> Stages<R> {
    #[inline(always)]
    fn new() -> Self {
        let zeros = [R::from_f64(0.0); BLOCK];
        Self {
            octaves: Octaves::new(),
            cells: Cells::new(),
            chosen: [[0; BLOCK]; 3],
            hashes: [zeros; 2],
            scales: [zeros; 2],
            weight: zeros,
            sum: [0.0; BLOCK],
            variance: [0.0; BLOCK],
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
        match plan.variant {
            Variant::Isotropic | Variant::Anisotropic => self.octaves.find::<FUSED>(plan, block),
            Variant::Linear | Variant::Single => self.scales_without_octave(plan, block),
        }
        if plan.join == Join::Copula {
            (self.sum, self.variance) = ([0.0; BLOCK], [0.0; BLOCK]);
        }
        let looks = plan.looks();
        for look in 0..looks {
            self.find_cells(plan, block, look);
            self.cells.hash::<FUSED>(plan.hash, plan.tier, &mut self.hashes[look % 2]);
            match plan.join {
                Join::Interpolate => {}
                Join::Copula => self.add_quantiles(plan, look),
                Join::Dithered if look < plan.axes => self.choose(look),
                Join::Dithered => {}
            }
        }
        match (plan.variant, plan.join) {
            (Variant::Single, _) => *out = self.hashes[0],
            (_, Join::Interpolate) => self.interpolate(plan, out),
            (_, Join::Copula) => self.normal_cdf(out),
            (_, Join::Dithered) => *out = self.hashes[(looks - 1) % 2],
        }
        self.finish(plan, out);
    }

    /// Finds the cells that are hashed next.
    #[inline(always)]
    fn find_cells(&mut self, plan: &Plan<R>, block: &BlockColumns<'_, R>, look: usize) {
        let Self { octaves, cells, chosen, scales, .. } = self;
        let Octaves { coarse, fine, .. } = octaves;
        if matches!(plan.variant, Variant::Linear | Variant::Single) {
            for i in 0..BLOCK {
                // The derivative stands in for the octave in the one, nothing in the other.
                cells.word[i] = chosen[look][i] as u32;
            }
            cells.at_scale(block, &scales[look]);
            return;
        }
        let chooses = plan.join == Join::Dithered && look < plan.axes;
        let octave: &[Block<i32>; 3] = match plan.join {
            Join::Interpolate if look == 0 => coarse,
            Join::Interpolate => fine,
            Join::Copula => {
                for axis in 0..plan.axes {
                    chosen[axis] = if look >> axis & 1 == 1 { fine[axis] } else { coarse[axis] };
                }
                chosen
            }
            Join::Dithered => {
                if chooses {
                    coarse
                } else {
                    chosen
                }
            }
        };
        if plan.axes == 1 {
            cells.at_octaves::<1>(plan, block, octave);
        } else {
            cells.at_octaves::<3>(plan, block, octave);
        }
        if chooses && plan.axes == 3 {
            cells.index[0] = cells.index[look];
            cells.index[1] = [R::from_f64(0.0); BLOCK];
            cells.index[2] = [R::from_f64(0.0); BLOCK];
            for i in 0..BLOCK {
                cells.word[i] = interval_word(look, coarse[look][i]);
            }
        } else if chooses {
            for i in 0..BLOCK {
                cells.word[i] ^= CHOICE;
            }
        }
    }

    /// Finds the scales of the ablations of §5.4.
    #[inline(always)]
    fn scales_without_octave(&mut self, plan: &Plan<R>, block: &BlockColumns<'_, R>) {
        let one = R::from_f64(1.0);
        let Self { octaves, chosen, scales, weight, .. } = self;
        let [first, second] = scales;
        if plan.variant == Variant::Single {
            for i in 0..BLOCK {
                let (longest, sure) = longest_derivative(block, i);
                first[i] = one / (plan.hash_scale * longest);
                octaves.sure[i] = sure & is_plain(first[i]) & reaches(plan, block, [first[i]; 3], i);
                chosen[0][i] = 0;
            }
            return;
        }
        for i in 0..BLOCK {
            let (longest, sure) = longest_derivative(block, i);
            let (floor, ceil) = (longest.floor(), longest.ceil());
            weight[i] = longest - floor;
            first[i] = one / (plan.hash_scale * floor);
            second[i] = one / (plan.hash_scale * ceil);
            let sure = sure & (longest >= one) & (longest <= R::LARGEST_WORD);
            let plain = is_plain(first[i]) & is_plain(second[i]);
            octaves.sure[i] = sure & plain & reaches(plan, block, [first[i]; 3], i);
            chosen[0][i] = octave_word([floor.word() as i32; 3]) as i32;
            chosen[1][i] = octave_word([ceil.word() as i32; 3]) as i32;
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
                    out[i] = cdf_stable(mix(i), weight[i]);
                }
            }
        }
    }

    /// Adds the normal quantile of a corner's hash with its trilinear weight.
    #[inline(always)]
    fn add_quantiles(&mut self, plan: &Plan<R>, look: usize) {
        let hash = &self.hashes[look % 2];
        for i in 0..BLOCK {
            let mut weight = 1.0;
            for axis in 0..plan.axes {
                let fraction = self.octaves.fraction[axis][i].to_f64();
                weight *= if look >> axis & 1 == 1 { fraction } else { 1.0 - fraction };
            }
            self.sum[i] += weight * normal_quantile(hash[i].to_f64().clamp(EDGE, 1.0 - EDGE));
            self.variance[i] += weight * weight;
        }
    }

    #[inline(always)]
    fn normal_cdf(&self, out: &mut Block<R>) {
        for i in 0..BLOCK {
            out[i] = R::from_f64(normal_cdf(self.sum[i] / self.variance[i].sqrt()));
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

/// [`cdf_literal`](crate::threshold::cdf::cdf_literal) with one division for its three cases.
#[inline(always)]
fn cdf_literal<R: Kernel>(x: R, weight: R) -> R {
    let [half, one, two] = [0.5, 1.0, 2.0].map(R::from_f64);
    let a = minor_weight(weight);
    let below = x < one - a;
    let from_edge = if below { x } else { one - x };
    let middle = below & (x >= a);
    let numerator = if middle { x - half * a } else { from_edge * from_edge };
    let divisor = if middle { one - a } else { two * a * (one - a) };
    let quotient = numerator / divisor;
    if below { quotient } else { one - quotient }
}

/// [`cdf`](crate::threshold::cdf::cdf) with two divisions for its three cases.
#[inline(always)]
fn cdf_stable<R: Kernel>(x: R, weight: R) -> R {
    let [half, one] = [0.5, 1.0].map(R::from_f64);
    let a = minor_weight(weight);
    let from_top = one - x;
    let low = x < a;
    let edge = low | (from_top < a);
    let from_edge = if low { x } else { from_top };
    let quotient = (if edge { from_edge / a } else { x - half * a }) / (one - a);
    let at_edge = half * from_edge * quotient;
    if !edge {
        quotient
    } else if low {
        at_edge
    } else {
        one - at_edge
    }
}
