//! What is evaluated, as the loops want it: every choice made once, every constant computed once.

use super::lane::Kernel;
use super::tier::Tier;
use crate::threshold::cdf::CdfForm;
use crate::threshold::hash::HashKind;
use crate::threshold::hashed::{HashedAlpha, SMALLEST_THRESHOLD};
use crate::threshold::model::Model;
use crate::threshold::real::Real;
use crate::threshold::robust::{Join, Repair, Robust, SMALLEST_ROBUST_THRESHOLD, scales::side_bounds};
use crate::threshold::two_scale::Variant;

/// The choices that a threshold is made of.
#[derive(Clone, Copy)]
pub(super) struct Plan<R> {
    pub variant: Variant,
    /// How many scales there are.
    pub axes: usize,
    pub hash: HashKind,
    pub tier: Tier,
    pub hash_scale: R,
    /// The bounds of a cell's side where the derivative has a floor.
    pub floor: Option<[R; 2]>,
    /// Whether the next octave is always one above.
    pub one_log2: bool,
    pub nested_phase: bool,
    pub octave_word: bool,
    pub join: Join,
    /// The form of Eq. 2 where there is one.
    pub cdf: Option<CdfForm>,
    /// The smallest threshold where the last step is a clamp.
    pub smallest: Option<R>,
}

impl<R: Kernel> Plan<R> {
    pub fn new(model: &Model, tier: Tier) -> Self {
        match model {
            Model::Hashed(hashed) => Self::of_listing(hashed, tier),
            Model::BeforeCdf(hashed) => Self { cdf: None, smallest: None, ..Self::of_listing(hashed, tier) },
            Model::Robust(robust) => Self::of_robust(robust, tier),
        }
    }

    fn of_listing(hashed: &HashedAlpha, tier: Tier) -> Self {
        let two_octaves = matches!(hashed.variant, Variant::Isotropic | Variant::Anisotropic);
        let clamps = two_octaves || hashed.form == CdfForm::Stable;
        Self {
            variant: hashed.variant,
            axes: axes(hashed.variant),
            hash: hashed.hash,
            tier,
            hash_scale: R::from_f64(hashed.hash_scale),
            floor: None,
            one_log2: false,
            nested_phase: false,
            octave_word: hashed.hash.reads_octave(),
            join: Join::Interpolate,
            cdf: two_octaves.then_some(hashed.form),
            smallest: clamps.then_some(R::from_f64(SMALLEST_THRESHOLD)),
        }
    }

    fn of_robust(robust: &Robust, tier: Tier) -> Self {
        let repairs = robust.repairs;
        let anisotropic = robust.variant == Variant::Anisotropic;
        let bounds = side_bounds::<R>();
        let floor = repairs.contains(Repair::DerivativeFloor).then_some(bounds);
        let refused = repairs.contains(Repair::ValidateInputs)
            && !(robust.hash_scale.is_finite() && robust.hash_scale > 0.0);
        // NaN leaves every footprint to the scalar path.
        let hash_scale = R::from_f64(if refused { f64::NAN } else { robust.hash_scale });
        let final_clamp = repairs.contains(Repair::FinalClamp);
        let smallest = if final_clamp { SMALLEST_ROBUST_THRESHOLD } else { SMALLEST_THRESHOLD };
        let stable = repairs.contains(Repair::StableCdf);
        Self {
            variant: if anisotropic { Variant::Anisotropic } else { Variant::Isotropic },
            axes: axes(robust.variant),
            hash: robust.hash,
            tier,
            hash_scale: floor.map_or(hash_scale, |[low, high]| Real::clamp(hash_scale, low, high)),
            floor,
            one_log2: repairs.contains(Repair::OneLog2),
            nested_phase: repairs.contains(Repair::NestedPhase),
            octave_word: repairs.contains(Repair::OctaveWord) && robust.hash.reads_octave(),
            join: robust.join,
            cdf: Some(if stable { CdfForm::Stable } else { CdfForm::Literal }),
            smallest: Some(R::from_f64(smallest)),
        }
    }

    /// The largest coordinate of a cell that the loops can hash.
    pub fn largest_cell(&self) -> R {
        match (self.hash.entry().is_exact, self.tier) {
            (true, _) => R::LARGEST_WORD,
            (false, Tier::BitExact) => R::LARGEST_SINE,
            (false, Tier::TwoUlp | Tier::Fast | Tier::Coarse) => R::LARGEST_FAST_SINE,
        }
    }

    /// How many cells of a footprint are hashed.
    pub fn looks(&self) -> usize {
        match (self.variant, self.join) {
            (Variant::Single, _) => 1,
            (Variant::Linear, _) | (_, Join::Interpolate) => 2,
            (_, Join::Copula) => 1 << self.axes,
            (_, Join::Dithered | Join::Inherit) => self.axes + 1,
        }
    }
}

fn axes(variant: Variant) -> usize {
    if variant == Variant::Anisotropic { 3 } else { 1 }
}
