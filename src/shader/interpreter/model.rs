//! The arithmetic under which a shader runs: that of the reference, or one that a device may have.

use super::machine::Column;
use crate::threshold::emulated::{Arithmetic, CoarseSine, FlushToZero, Fused, Half, ReducedSine, Single};

/// What a device makes of `f32` operations; any [`Arithmetic`] gives one.
///
/// The same definitions serve [`Emulated`](crate::threshold::emulated::Emulated), so that a shader and its Rust twin
/// give the same bits under every model.
#[derive(Clone, Copy, Debug)]
pub struct DeviceModel {
    name: &'static str,
    contracts: bool,
    /// What is left to do after an `f32` operation; nothing where the device has IEEE `f32`.
    round: Option<fn(&Column)>,
    sin: fn(&Column, &Column),
    cos: fn(&Column, &Column),
}

impl DeviceModel {
    /// The reference semantics R32: IEEE `f32` in the order of the source, sine, log2 and exp2 correctly rounded, the
    /// other transcendentals those of libm in `f64`, rounded once.
    pub const ACCURATE: Self = Self { round: None, ..Self::of::<Single>() };
    /// A sine and a cosine with the least accuracy that WGSL permits: [`CoarseSine`].
    pub const COARSE_SINE: Self = Self { round: None, ..Self::of::<CoarseSine>() };
    /// A sine and a cosine of an argument that is reduced in `f32`: [`ReducedSine`].
    pub const REDUCED_SINE: Self = Self { round: None, ..Self::of::<ReducedSine>() };
    /// Every `f32` is a binary16: [`Half`].
    pub const HALF: Self = Self::of::<Half>();
    /// Subnormal results become zero: [`FlushToZero`].
    pub const FLUSH_TO_ZERO: Self = Self::of::<FlushToZero>();
    /// A product that enters a sum is not rounded before: [`Fused`].
    pub const FUSED: Self = Self { round: None, ..Self::of::<Fused>() };

    /// The reference and every model of [`emulated`](crate::threshold::emulated).
    pub const ALL: [Self; 6] =
        [Self::ACCURATE, Self::COARSE_SINE, Self::REDUCED_SINE, Self::HALF, Self::FLUSH_TO_ZERO, Self::FUSED];

    /// Makes a model of an arithmetic.
    #[must_use]
    pub const fn of<A: Arithmetic>() -> Self {
        Self { name: A::NAME, contracts: A::FUSES, round: Some(round::<A>), sin: sin::<A>, cos: cos::<A> }
    }

    /// Returns the name in tables and figures.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// Returns whether a product that enters a sum is not rounded before.
    pub(super) const fn contracts(&self) -> bool {
        self.contracts
    }

    /// Rounds `f32` results to what the device can hold.
    pub(super) fn round(&self, column: &Column) {
        if let Some(round) = self.round {
            round(column);
        }
    }

    pub(super) fn sin(&self, to: &Column, from: &Column) {
        (self.sin)(to, from);
    }

    pub(super) fn cos(&self, to: &Column, from: &Column) {
        (self.cos)(to, from);
    }
}

fn round<A: Arithmetic>(column: &Column) {
    for lane in column {
        lane.set(A::round(f64::from(f32::from_bits(lane.get()))).to_bits());
    }
}

fn sin<A: Arithmetic>(to: &Column, from: &Column) {
    for (to, from) in to.iter().zip(from) {
        to.set(A::sin(f32::from_bits(from.get())).to_bits());
    }
}

fn cos<A: Arithmetic>(to: &Column, from: &Column) {
    for (to, from) in to.iter().zip(from) {
        to.set(A::cos(f32::from_bits(from.get())).to_bits());
    }
}
