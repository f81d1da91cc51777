//! A sound threshold whose steps can be exchanged one by one, as a port by hand may get one of them wrong.

use super::ideal::Ideal;
use crate::check::Subject;
use crate::check::subject::Precision;
use crate::scene::Fragment;
use crate::threshold::cdf;
use crate::threshold::footprint::Footprint;
use crate::threshold::hash::{Cell, Hash};
use crate::threshold::real::Real;
use crate::threshold::robust::scales::{self, Scales};
use crate::threshold::robust::{Repairs, Robust};
use crate::threshold::two_scale::Variant;
use glam::DVec3;

/// Listing 1 as one would write it for a second time, step by step.
#[derive(Clone, Copy)]
pub(super) struct Port {
    /// What is read of a fragment: a position and its two derivatives.
    pub read: fn(&Fragment) -> Footprint<f64>,
    /// Octave and fraction of the scale -> the octaves that are hashed and the weight of the second.
    pub octaves: fn(i32, f64) -> ([i32; 2], f64),
    /// Position and octave -> indices of the cell.
    pub cell: fn(DVec3, i32) -> [f64; 3],
    /// Indices of a cell and its octave -> a value in (0, 1).
    pub hash: fn([f64; 3], i32) -> f64,
    /// Two hashes and the weight of the second -> one value.
    pub join: fn([f64; 2], f64) -> f64,
    /// That value and the weight -> a uniform one.
    pub cdf: fn(f64, f64) -> f64,
    /// The last step.
    pub clamp: fn(f64) -> f64,
}

/// No step is wrong.
pub(super) const SOUND: Port = Port {
    read: |fragment| fragment.footprint,
    octaves: |octave, fraction| ([octave, octave + 1], fraction),
    cell,
    hash: ideal_hash,
    join: |[coarse, fine], t| (1.0 - t) * coarse + t * fine,
    cdf: cdf::cdf,
    clamp: |threshold| threshold.clamp(1.0e-6, 1.0),
};

/// The indices of the cell of an octave, between whole numbers as the robust threshold has them.
pub(super) fn cell(position: DVec3, octave: i32) -> [f64; 3] {
    scales::nested_cell::<f64>(position, [octave; 3], Repairs::ALL).index.into()
}

/// The same with another way of rounding than down.
pub(super) fn cut(position: DVec3, octave: i32, round: fn(f64) -> f64) -> [f64; 3] {
    let phase = if octave & 1 == 0 { 1.0 / 3.0 } else { 2.0 / 3.0 };
    (position * libm::ldexp(1.0, octave) + phase).to_array().map(round)
}

/// The value of the ideal source, with the one key that all specimens have.
pub(super) fn ideal_hash(index: [f64; 3], octave: i32) -> f64 {
    Ideal::new(0).hash(&Cell::<f64> { index: index.into(), octave: octave as u32 })
}

impl Port {
    /// Puts the port on trial.
    pub fn subject(self) -> Subject<'static> {
        let threshold = move |fragment: &Fragment| Some(self.joined_and_threshold(fragment)?.1);
        let joined = move |fragment: &Fragment| Some(self.joined_and_threshold(fragment)?.0);
        let mut subject = Subject::of_fragments("specimen", Precision::F64, Variant::Isotropic, threshold)
            .with_interpolated(joined);
        subject.nested_phase = true;
        subject
    }

    fn joined_and_threshold(&self, fragment: &Fragment) -> Option<(f64, f64)> {
        if !is_finite(&fragment.footprint) {
            return None;
        }
        let read = (self.read)(fragment);
        let found: Scales<f64> = scales::robust_scales(Variant::Isotropic, &read, 1.0, Repairs::ALL);
        let (octaves, weight) = (self.octaves)(found.octave[0], found.fraction[0]);
        let hashes = octaves.map(|octave| (self.hash)((self.cell)(read.position, octave), octave));
        let joined = (self.join)(hashes, weight);
        Some((joined, (self.clamp)((self.cdf)(joined, weight))))
    }
}

/// Puts a function on trial that claims cells like those of the sound port, and refuses what is not finite.
pub(super) fn of_footprint(
    precision: Precision,
    threshold: impl Fn(&Footprint<f64>) -> f64 + Send + Sync + 'static,
) -> Subject<'static> {
    let of_finite = move |found: &Footprint<f64>| is_finite(found).then(|| threshold(found));
    let mut subject = Subject::new("specimen", precision, Variant::Isotropic, of_finite);
    subject.nested_phase = true;
    subject
}

fn is_finite(Footprint { position, dpdx, dpdy }: &Footprint<f64>) -> bool {
    position.is_finite() && dpdx.is_finite() && dpdy.is_finite()
}

/// A function of cells in the place of a hash, for the robust threshold in either precision.
#[derive(Clone, Copy)]
pub(super) struct HashedBy(pub fn([f64; 3], i32) -> f64);

impl<R: Real> Hash<R> for HashedBy {
    fn hash(&self, cell: &Cell<R>) -> R {
        let index: [R; 3] = cell.index.into();
        R::from_f64((self.0)(index.map(R::to_f64), cell.octave as i32))
    }
}

/// The robust threshold over the ideal source, with the join of [`Robust::new`].
pub(super) fn robust(variant: Variant) -> Robust<HashedBy> {
    let Robust { hash_scale, join, repairs, .. } = Robust::new(variant);
    Robust { variant, hash: HashedBy(ideal_hash), hash_scale, join, repairs }
}
