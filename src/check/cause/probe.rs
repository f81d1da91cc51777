//! What a threshold shows of single cells: it is asked where one octave has all weight.

use super::measure::Measure;
use crate::check::Subject;
use crate::scene::Fragment;
use crate::stats::seed;
use crate::threshold::footprint::Footprint;
use glam::{DVec2, DVec3, dvec3};
use rand::rngs::Xoshiro256PlusPlus;

/// The weight of the finer octave where the coarser one is meant to have all: so small that it does not show, and so large that
/// the rounding of a logarithm does not take it to the other side of an octave.
pub(super) const ALONE: f64 = 1.0e-4;

/// Two thresholds that are nearer than this are one: what is left of the other octave moves them.
pub(super) const SAME: f64 = 1.0e-3;

/// Positions lie within this of the origin along each axis, in object units.
const NEAR: f64 = 8.0;

/// Logarithms of the lengths of derivatives, to base two: cells of half a unit and less at a hash scale of 1.
const LENGTHS: [f64; 2] = [-8.0, -1.0];

/// How much longer one derivative is than the other at most, in octaves.
const RATIO: f64 = 3.0;

/// Surfaces in general position around the origin, as many as asked for: no axis of the object without a derivative.
pub(super) fn places(count: usize, hash_scale: f64, rng: &mut Xoshiro256PlusPlus) -> Vec<Fragment> {
    let mut signed = || 2.0 * seed::uniform01(rng) - 1.0;
    let mut direction = || loop {
        let v = dvec3(signed(), signed(), signed());
        if (0.1..1.0).contains(&v.length_squared()) && v.abs().min_element() > 0.1 * v.abs().max_element() {
            return v.normalize();
        }
    };
    let draw = |index: usize| {
        let [u, v] = [direction(), direction()];
        (index, u, v)
    };
    let directions: Vec<_> = (0..count).map(draw).collect();
    let mut between = |[low, high]: [f64; 2]| low + (high - low) * seed::uniform01(rng);
    directions
        .into_iter()
        .map(|(index, u, v)| {
            let position = dvec3(between([-NEAR, NEAR]), between([-NEAR, NEAR]), between([-NEAR, NEAR]));
            let length = libm::exp2(between(LENGTHS)) / hash_scale;
            let ratio = libm::exp2(between([-RATIO, 0.0]));
            let [along_x, along_y] = if index % 2 == 0 { [1.0, ratio] } else { [ratio, 1.0] };
            let footprint = Footprint { position, dpdx: u * length * along_x, dpdy: v * length * along_y };
            let pixel = DVec2::new((index % 512) as f64, (index / 512) as f64 * 7.0) + 0.5;
            Fragment {
                world: position,
                eye: position,
                pixel,
                texcoord: DVec2::new(between([0.0, 1.0]), between([0.0, 1.0])),
                lod: between([0.0, 4.0]),
                ..Fragment::from(footprint)
            }
        })
        .collect()
}

/// A subject, and the way from derivatives to scales that it is taken to have.
pub(super) struct Probe<'s> {
    pub subject: &'s Subject<'s>,
    pub measure: Measure,
    /// Octaves by which the cells that it shows alone are finer than they should be.
    pub finer: i32,
    /// Weight of the finer octave where cells are looked at.
    pub lean: f64,
}

impl Probe<'_> {
    /// The same fragment, seen so that the octave of each axis has all weight; none where no view does that.
    pub fn alone(&self, fragment: &Fragment, octave: DVec3) -> Option<Fragment> {
        // A scale that ends at an octave comes to it from below.
        self.seen_at(fragment, octave + ALONE).or_else(|| self.seen_at(fragment, octave - ALONE))
    }

    /// The same fragment in a view with the same derivative along each axis, at a given logarithm of the scale.
    pub fn seen_at(&self, fragment: &Fragment, log_scale: DVec3) -> Option<Fragment> {
        let [dpdx, dpdy] = self.measure.view(log_scale)?;
        let footprint = Footprint { position: fragment.footprint.position, dpdx, dpdy };
        Some(Fragment { footprint: self.subject.precision.round(&footprint), ..*fragment })
    }

    /// The threshold of each place in cells of octave 0, that octave alone; NaN where there is no view of it.
    pub fn cells(&self, places: &[DVec3]) -> Vec<f64> {
        self.cells_at(0, places)
    }

    /// The same in cells of another octave.
    pub fn cells_at(&self, octave: i32, places: &[DVec3]) -> Vec<f64> {
        let side = libm::exp2(f64::from(-octave - self.finer));
        let places: Vec<DVec3> = places.iter().map(|&place| place * side).collect();
        self.seen(DVec3::splat(f64::from(octave)), &places)
    }

    /// The threshold at positions, in a view in which one octave of each axis has all weight.
    pub fn seen(&self, octave: DVec3, positions: &[DVec3]) -> Vec<f64> {
        let view = self.measure.view(octave + self.lean).or_else(|| self.measure.view(octave - self.lean));
        let Some([dpdx, dpdy]) = view else { return vec![f64::NAN; positions.len()] };
        let fragment = |&position: &DVec3| {
            let footprint = self.subject.precision.round(&Footprint { position, dpdx, dpdy });
            Fragment { world: position, eye: position, pixel: DVec2::splat(0.5), ..footprint.into() }
        };
        let fragments: Vec<Fragment> = positions.iter().map(fragment).collect();
        self.subject.thresholds(&fragments)
    }

    /// Whether most cells have one threshold, which then says nothing of their hash.
    pub fn is_mute(&self, rng: &mut Xoshiro256PlusPlus) -> bool {
        let mut index = || (seed::uniform01(rng) * 100.0).floor() + 0.45;
        let pairs: Vec<_> = (0..256).map(|_| [(); 2].map(|()| dvec3(index(), index(), index()))).collect();
        self.share(&pairs) > 0.5
    }

    /// The share of pairs of places that have one threshold.
    pub fn share(&self, pairs: &[[DVec3; 2]]) -> f64 {
        self.share_of(pairs, |a, b| (a - b).abs() < SAME)
    }

    /// The share of pairs of places whose thresholds are in a relation.
    pub fn share_of(&self, pairs: &[[DVec3; 2]], holds: impl Fn(f64, f64) -> bool) -> f64 {
        let values = self.cells(pairs.as_flattened());
        let holding = values.chunks_exact(2).filter(|pair| holds(pair[0], pair[1])).count();
        holding as f64 / pairs.len() as f64
    }
}
