//! The arithmetic under which a shader runs: that of the reference, or one that a device may have.

use super::lanes::Column;
use crate::threshold::batch::{Isa, isa::Job};
use crate::threshold::emulated::{Arithmetic, CoarseSine, FlushToZero, Fused, Half, ReducedSine, Single};

/// What a device makes of `f32` operations; any [`Arithmetic`] gives one.
///
/// The same definitions serve [`Emulated`](crate::threshold::emulated::Emulated), so that a shader and its Rust twin
/// give the same bits under every model.
#[derive(Clone, Copy, Debug)]
pub struct DeviceModel {
    name: &'static str,
    /// Whether a product that enters a sum is not rounded before.
    pub(super) contracts: bool,
    /// What is left to do after an `f32` operation; nothing where the device has IEEE `f32`.
    round: Option<fn(Isa, &Column)>,
    /// Its own sine; none where it is the reference, rounded as every operation is.
    pub(super) sin: Option<fn(Isa, &Column, &Column)>,
    pub(super) cos: fn(Isa, &Column, &Column),
}

impl DeviceModel {
    /// The reference semantics R32: IEEE `f32` in the order of the source, sine, log2 and exp2 correctly rounded, the
    /// other transcendentals those of libm in `f64`, rounded once.
    pub const ACCURATE: Self = Self { round: None, sin: None, ..Self::of::<Single>() };
    /// A sine and a cosine with the least accuracy that WGSL permits: [`CoarseSine`].
    pub const COARSE_SINE: Self = Self { round: None, ..Self::of::<CoarseSine>() };
    /// A sine and a cosine of an argument that is reduced in `f32`: [`ReducedSine`].
    pub const REDUCED_SINE: Self = Self { round: None, ..Self::of::<ReducedSine>() };
    /// Every `f32` is a binary16: [`Half`].
    pub const HALF: Self = Self { sin: None, ..Self::of::<Half>() };
    /// Subnormal results become zero: [`FlushToZero`].
    pub const FLUSH_TO_ZERO: Self = Self { sin: None, ..Self::of::<FlushToZero>() };
    /// A product that enters a sum is not rounded before: [`Fused`].
    pub const FUSED: Self = Self { round: None, sin: None, ..Self::of::<Fused>() };

    /// The reference and every model of [`emulated`](crate::threshold::emulated).
    pub const ALL: [Self; 6] =
        [Self::ACCURATE, Self::COARSE_SINE, Self::REDUCED_SINE, Self::HALF, Self::FLUSH_TO_ZERO, Self::FUSED];

    /// Makes a model of an arithmetic.
    #[must_use]
    pub const fn of<A: Arithmetic>() -> Self {
        Self {
            name: A::NAME,
            contracts: A::FUSES,
            round: Some(round::<A>),
            sin: Some(sin::<A>),
            cos: cos::<A>,
        }
    }

    /// Returns the name in tables and figures.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// Rounds `f32` results to what the device can hold.
    pub(super) fn round(&self, isa: Isa, column: &Column) {
        if let Some(round) = self.round {
            round(isa, column);
        }
    }
}

fn round<A: Arithmetic>(isa: Isa, column: &Column) {
    each(isa, column, column, |x| A::round(f64::from(x)));
}

fn sin<A: Arithmetic>(isa: Isa, to: &Column, from: &Column) {
    each(isa, to, from, A::sin);
}

fn cos<A: Arithmetic>(isa: Isa, to: &Column, from: &Column) {
    each(isa, to, from, A::cos);
}

/// Applies a function to every lane.
fn each(isa: Isa, to: &Column, from: &Column, f: impl Fn(f32) -> f32) {
    isa.run(Each { to, from, f });
}

struct Each<'a, F> {
    to: &'a Column,
    from: &'a Column,
    f: F,
}

impl<F: Fn(f32) -> f32> Job for Each<'_, F> {
    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        for (to, from) in self.to.iter().zip(self.from) {
            to.set((self.f)(f32::from_bits(from.get())).to_bits());
        }
    }
}
