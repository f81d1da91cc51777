//! Inputs of the claims: footprints of real surfaces, drawn by rule from the claim's name.
//!
//! Neighbouring pixels share cells and so thresholds; where a claim needs independent values, no two of its
//! footprints touch the same cell.

use super::subject::{Precision, Subject};
use super::tolerance::{DRAWS_A_SAMPLE, PLACEMENT};
use crate::scene::Scene;
use crate::stats::seed::uniform01;
use crate::threshold::footprint::Footprint;
use glam::{DVec3, dvec2, dvec3};
use rand::rngs::Xoshiro256PlusPlus;
use std::collections::HashSet;

/// Draws a place for the object: how far its points are moved from where the scene has them, in object units.
pub fn placement(rng: &mut Xoshiro256PlusPlus) -> DVec3 {
    let mut coordinate = || (2.0 * uniform01(rng) - 1.0) * PLACEMENT;
    dvec3(coordinate(), coordinate(), coordinate())
}

/// Draws a footprint of a scene: a uniform place in the image, and a surface that is seen there.
pub fn footprint(scene: &Scene, rng: &mut Xoshiro256PlusPlus) -> Footprint<f64> {
    let size = scene.camera.size();
    loop {
        let pixel = dvec2(uniform01(rng) * size.x, uniform01(rng) * size.y);
        let surface = (uniform01(rng) * scene.surfaces.len() as f64) as usize;
        if let Some(found) = scene.surfaces[surface].footprint(&scene.camera, pixel) {
            return found;
        }
    }
}

/// Moves a footprint, and rounds it to a precision.
#[must_use]
pub fn moved(footprint: &Footprint<f64>, by: DVec3, precision: Precision) -> Footprint<f64> {
    precision.round(&Footprint { position: footprint.position + by, ..*footprint })
}

/// The cells that earlier samples have used.
#[derive(Debug, Default)]
pub struct UsedCells(HashSet<[i64; 3]>);

impl UsedCells {
    /// Claims the cells of a group of footprints that belong together; returns false, and claims none, if an earlier
    /// group has one of them.
    ///
    /// Cells of different octaves with equal coordinates count as one, since the paper's hash cannot tell them apart.
    pub fn claim(&mut self, subject: &Subject<'_>, group: &[Footprint<f64>]) -> bool {
        let cells: Vec<[i64; 3]> = group
            .iter()
            .flat_map(|footprint| {
                let nominal = subject.nominal(footprint);
                [nominal.coarse_cell, nominal.fine_cell].map(|cell| cell.to_array().map(|c| c as i64))
            })
            .collect();
        let fresh = !cells.iter().any(|cell| self.0.contains(cell));
        if fresh {
            self.0.extend(cells);
        }
        fresh
    }
}

/// Draws `n` footprints of the scenes in turn, no two of which touch the same cell, with the object at a new place
/// every `draws_a_place` draws.
///
/// Returns fewer when the scenes have not enough cells.
#[must_use]
pub fn independent(
    subject: &Subject<'_>,
    scenes: &[Scene],
    n: usize,
    draws_a_place: usize,
    rng: &mut Xoshiro256PlusPlus,
) -> Vec<Footprint<f64>> {
    let mut samples = Vec::with_capacity(n);
    let mut used = UsedCells::default();
    let mut place = DVec3::ZERO;
    for draw in 0..n.saturating_mul(DRAWS_A_SAMPLE) {
        if samples.len() == n {
            break;
        }
        if draw % draws_a_place == 0 {
            place = placement(rng);
        }
        let scene = &scenes[draw % scenes.len()];
        let sample = moved(&footprint(scene, rng), place, subject.precision);
        if used.claim(subject, &[sample]) {
            samples.push(sample);
        }
    }
    samples
}

/// Returns the built-in scenes that lie in general position: what the paper's sentences are about.
#[must_use]
pub fn general_scenes() -> Vec<Scene> {
    Scene::all().into_iter().filter(|scene| scene.general_position).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::seed;
    use crate::threshold::hashed::HashedAlpha;
    use crate::threshold::two_scale::Variant;

    #[test]
    fn no_two_samples_share_a_coarse_cell() {
        let listing = HashedAlpha::listing(Variant::Isotropic);
        let subject = Subject::hashed("paper", Precision::F32, listing);
        let mut rng = seed::rng("sample.independent", 0);
        let samples = independent(&subject, &general_scenes(), 5000, 1000, &mut rng);
        assert_eq!(samples.len(), 5000);
        let cells: HashSet<_> =
            samples.iter().map(|s| subject.nominal(s).coarse_cell.to_array().map(|c| c as i64)).collect();
        assert_eq!(cells.len(), 5000);
    }

    #[test]
    fn a_small_scene_gives_what_it_has() {
        let subject = Subject::hashed("paper", Precision::F64, HashedAlpha::listing(Variant::Isotropic));
        let tiny = [Scene::all()[1].clone().with_resolution([8, 6])];
        let mut rng = seed::rng("sample.tiny", 0);
        let samples = independent(&subject, &tiny, 1000, 1000, &mut rng);
        assert!(!samples.is_empty() && samples.len() < 1000, "{}", samples.len());
    }
}
