//! A row of the ladder: what was measured, and how exact it is.

use super::clock::Contender;
use super::double_double::RealSine;
use super::law::Law;
use crate::threshold::batch::Model;
use crate::threshold::hash::{Cell, Hash, HashKind};
use crate::threshold::real::Real;
use crate::threshold::robust::Join;
use crate::threshold::two_scale::Variant;

/// One measurement.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What was evaluated: a stage, "literal" or "robust" for a whole threshold, or a point of the statistical axis.
    pub name: &'static str,
    /// How scales come from derivatives; "-" where there are none.
    pub variant: &'static str,
    /// What gives a cell its value; "-" where nothing does.
    pub hash: &'static str,
    /// How the hashes of two octaves become one value; "-" where there is one.
    pub join: &'static str,
    /// The type of the results.
    pub precision: &'static str,
    /// How exact sine and logarithm are: a [`Tier`](crate::threshold::batch::Tier), "std" for the standard library's or "double-double".
    pub tier: &'static str,
    /// The vector instructions; "scalar" for one value after the other.
    pub isa: &'static str,
    /// How many threads shared the work.
    pub threads: usize,
    /// The fastest round, in nanoseconds per value.
    pub ns_min: f64,
    /// The middle round, in nanoseconds per value.
    pub ns_median: f64,
    /// How many times faster than the scalar listing of the standard library in `f32`, whole thresholds as a rule,
    /// by medians of the same run.
    pub ratio: f64,
    /// The share of values that have the bits of the reference semantics.
    pub bits_equal: Option<f64>,
    /// Sine and logarithm: the greatest distance to the exact value. Hashes and thresholds: the mean distance to
    /// what the formula gives as a real number; 1/3 is that of two random numbers.
    pub error: Option<f64>,
    /// The law; thresholds only.
    pub law: Option<Law>,
}

impl Row {
    /// A row without a measurement.
    pub(super) fn of_stage(
        name: &'static str,
        hash: &'static str,
        precision: &'static str,
        tier: &'static str,
        isa: &'static str,
    ) -> Self {
        Self {
            name,
            variant: "-",
            hash,
            join: "-",
            precision,
            tier,
            isa,
            threads: 1,
            ns_min: 0.0,
            ns_median: 0.0,
            ratio: 0.0,
            bits_equal: None,
            error: None,
            law: None,
        }
    }

    pub(super) fn of_model(name: &'static str, model: &Model) -> Self {
        let (variant, hash, join) = match model {
            Model::Hashed(h) | Model::BeforeCdf(h) if h.variant == Variant::Single => {
                (h.variant, h.hash, "-")
            }
            Model::Hashed(h) => (h.variant, h.hash, Join::Interpolate.name()),
            Model::BeforeCdf(h) => (h.variant, h.hash, "no CDF"),
            Model::Robust(r) => (r.variant, r.hash, r.join.name()),
        };
        Self { variant: variant.name(), join, ..Self::of_stage(name, hash.name(), "f32", "", "scalar") }
    }

    /// Whether the row is the one that all ratios refer to.
    #[must_use]
    pub fn is_baseline(&self) -> bool {
        let key = (self.name, self.variant, self.precision, self.tier);
        key == (LITERAL, Variant::Isotropic.name(), f32::NAME, STD)
    }
}

/// The name of rows that are a listing to the letter.
pub const LITERAL: &str = "literal";
/// The name of rows that are the robust threshold.
pub const ROBUST: &str = "robust";
/// The tier of the standard library.
pub(super) const STD: &str = "std";

/// A row that is still to be timed.
pub(super) struct Untimed<'a> {
    pub row: Row,
    pub contender: Contender<'a>,
}

/// What a hash is as a function of real numbers.
pub(super) fn real_hash<R: Real>(kind: HashKind, cell: &Cell<R>) -> R {
    if kind == HashKind::Sine { RealSine.hash(cell) } else { kind.hash(cell) }
}
