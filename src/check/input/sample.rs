//! Inputs of the claims: fragments of real surfaces, drawn by rule from the claim's name.
//!
//! Neighbouring pixels share cells and so thresholds; where a claim needs independent values, no two of its
//! fragments touch the same cell. A fragment is one place in all its coordinates, so that a subject may hash any of them.

use crate::check::subject::Precision;
use crate::check::tolerance::{DRAWS_A_SAMPLE, EXACT_POINTS, PLACEMENT};
use crate::check::{Draw, Subject};
use crate::scene::{Camera, Fragment, Rectangle, Scene};
use crate::stats::seed::uniform01;
use crate::threshold::footprint::Footprint;
use core::hash::BuildHasher;
use glam::{DVec2, DVec3, dvec2, dvec3};
use rand::rngs::Xoshiro256PlusPlus;
use rustc_hash::{FxBuildHasher, FxHashSet};

/// Bits of the table of used cells for each cell that it will hold: at most one sample in eight, and of pairs one in four, is
/// drawn again.
const BITS_A_CELL: usize = 8;

/// Bits of the largest table of used cells: a quarter of a gigabyte, one a thread.
const MOST_BITS: usize = 1 << 31;

/// Draws a place for the object: how far its points are moved from where the scene has them, in object units.
pub fn placement(rng: &mut Xoshiro256PlusPlus) -> DVec3 {
    let mut coordinate = || (2.0 * uniform01(rng) - 1.0) * PLACEMENT;
    dvec3(coordinate(), coordinate(), coordinate())
}

/// A fragment with the camera and the surface that it was made of, so that it can be moved.
#[derive(Clone, Copy, Debug)]
pub struct Sighting<'a> {
    /// What is seen.
    pub fragment: Fragment,
    camera: Camera,
    surface: &'a Rectangle,
}

/// Draws a sighting in a scene: a uniform place in the image, and a surface that is seen there.
pub fn sighting<'a>(scene: &'a Scene, rng: &mut Xoshiro256PlusPlus) -> Sighting<'a> {
    let size = scene.camera.size();
    loop {
        let pixel = dvec2(uniform01(rng) * size.x, uniform01(rng) * size.y);
        let index = (uniform01(rng) * scene.surfaces.len() as f64) as usize;
        if let Some(fragment) = scene.fragment(index, pixel) {
            return Sighting { fragment, camera: scene.camera, surface: &scene.surfaces[index] };
        }
    }
}

impl<'a> Sighting<'a> {
    /// The surface that is seen.
    #[must_use]
    pub fn surface(&self) -> &'a Rectangle {
        self.surface
    }

    /// The same place of the world, `by` further in the object's own coordinates; rounded to a precision.
    #[must_use]
    pub fn placed(self, by: DVec3, precision: Precision) -> Self {
        Self { fragment: placed(&self.fragment, by, precision), ..self }
    }

    /// The point that is `by` away, of the object and of the world, seen by the same camera with the same derivatives;
    /// rounded to a precision.
    ///
    /// A point that is not in front of the camera has a pixel of NaN.
    #[must_use]
    pub fn moved(self, by: DVec3, precision: Precision) -> Self {
        let world = self.fragment.world + by;
        let fragment = Fragment {
            world,
            eye: self.camera.to_eye(world),
            pixel: self.camera.project(world).unwrap_or(DVec2::NAN),
            texcoord: self.surface.texcoord(world),
            ..self.fragment
        };
        Self { fragment: placed(&fragment, by, precision), ..self }
    }

    /// The same point seen by a camera that has come closer, along the line of sight, `times` times as near.
    #[must_use]
    pub fn nearer(self, times: f64) -> Self {
        let Footprint { position, dpdx, dpdy } = self.fragment.footprint;
        let to_eye = self.camera.eye - self.fragment.world;
        Self {
            fragment: Fragment {
                footprint: Footprint { position, dpdx: dpdx / times, dpdy: dpdy / times },
                eye: self.fragment.eye / times,
                lod: self.fragment.lod - libm::log2(times),
                ..self.fragment
            },
            camera: Camera { eye: self.fragment.world + to_eye / times, ..self.camera },
            ..self
        }
    }
}

/// Moves a fragment in object coordinates alone, and rounds its footprint to a precision.
#[must_use]
pub fn placed(fragment: &Fragment, by: DVec3, precision: Precision) -> Fragment {
    let footprint = fragment.footprint;
    let footprint = precision.round(&Footprint { position: footprint.position + by, ..footprint });
    Fragment { footprint, ..*fragment }
}

/// The cells that earlier samples have used.
#[derive(Debug)]
pub enum UsedCells {
    /// Each cell, as long as all fit into memory.
    Each(FxHashSet<[i64; 3]>),
    /// One bit for each value of a hash of cells, in words of 64: two cells may share a bit, and the second is then taken for
    /// used. So no cell is ever used twice, whatever the number of samples, in constant memory.
    Bits(Vec<u64>),
}

impl Default for UsedCells {
    fn default() -> Self {
        Self::Each(FxHashSet::default())
    }
}

impl UsedCells {
    /// Makes what tells apart the cells of all samples of a draw, `cells` of them at most.
    #[must_use]
    pub fn of(draw: &Draw, cells: usize) -> Self {
        if draw.doublings == 0 {
            return Self::default();
        }
        let bits = cells.saturating_mul(BITS_A_CELL).clamp(64, MOST_BITS).next_power_of_two();
        Self::Bits(vec![0; bits / 64])
    }

    /// Begins a group that is judged on its own. What has each cell forgets those of the group before; a table of bits keeps
    /// them, since of the many groups of a grown claim more would share cells.
    pub fn next_group(&mut self) {
        if let Self::Each(used) = self {
            used.clear();
        }
    }

    /// Claims the cells of a group of fragments or footprints that belong together; returns false, and claims none, if an
    /// earlier group has one of them.
    ///
    /// Cells of different octaves with equal coordinates count as one, since the paper's hash cannot tell them apart. Where the
    /// children of a cell know of each other, their parents stand for both.
    pub fn claim<F: Copy + Into<Fragment>>(&mut self, subject: &Subject<'_>, group: &[F]) -> bool {
        let cells: Vec<[i64; 3]> = group
            .iter()
            .flat_map(|&fragment| {
                let nominal = subject.nominal(&fragment.into().footprint);
                let cells = if subject.has_kin() {
                    [nominal.parent(subject.nested_phase), nominal.coarse_cell]
                } else {
                    [nominal.coarse_cell, nominal.fine_cell]
                };
                cells.map(|cell| cell.to_array().map(|c| c as i64))
            })
            .collect();
        match self {
            Self::Each(used) => {
                let fresh = !cells.iter().any(|cell| used.contains(cell));
                if fresh {
                    used.extend(cells);
                }
                fresh
            }
            Self::Bits(words) => {
                let place = |cell: &[i64; 3]| {
                    let hash = FxBuildHasher.hash_one(cell);
                    ((hash >> 6) as usize & (words.len() - 1), 1_u64 << (hash & 63))
                };
                let places: Vec<(usize, u64)> = cells.iter().map(place).collect();
                let fresh = !places.iter().any(|&(word, bit)| words[word] & bit != 0);
                if fresh {
                    places.into_iter().for_each(|(word, bit)| words[word] |= bit);
                }
                fresh
            }
        }
    }
}

/// Draws `n` fragments of the scenes in turn, no two of which touch the same cell, with the object at a new place
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
) -> Vec<Fragment> {
    more_independent(subject, scenes, n, draws_a_place, &mut UsedCells::default(), rng)
}

/// The same, of which none touches a cell of the samples before them either.
#[must_use]
pub fn more_independent(
    subject: &Subject<'_>,
    scenes: &[Scene],
    n: usize,
    draws_a_place: usize,
    used: &mut UsedCells,
    rng: &mut Xoshiro256PlusPlus,
) -> Vec<Fragment> {
    let mut samples = Vec::with_capacity(n);
    let mut place = DVec3::ZERO;
    for draw in 0..n.saturating_mul(DRAWS_A_SAMPLE) {
        if samples.len() == n {
            break;
        }
        if draw % draws_a_place == 0 {
            place = placement(rng);
        }
        let scene = &scenes[draw % scenes.len()];
        let sample = sighting(scene, rng).placed(place, subject.precision).fragment;
        if used.claim(subject, &[sample]) {
            samples.push(sample);
        }
    }
    samples
}

/// Fragments of all scenes, in no order.
pub(crate) fn fragments_everywhere(subject: &Subject<'_>, draw: &Draw, claim: &str) -> Vec<Fragment> {
    let mut rng = draw.rng(claim);
    let scenes = Scene::all();
    let count = draw.samples(EXACT_POINTS);
    (0..count)
        .map(|index| {
            let place = placement(&mut rng);
            sighting(&scenes[index % scenes.len()], &mut rng).placed(place, subject.precision).fragment
        })
        .collect()
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
        let cells: FxHashSet<_> = samples
            .iter()
            .map(|s| subject.nominal(&s.footprint).coarse_cell.to_array().map(|c| c as i64))
            .collect();
        assert_eq!(cells.len(), 5000);
    }

    #[test]
    fn a_table_of_bits_never_gives_a_cell_twice() {
        let subject = Subject::hashed("paper", Precision::F32, HashedAlpha::listing(Variant::Isotropic));
        let mut rng = seed::rng("sample.bits", 0);
        let draw = Draw { doublings: 1, ..Draw::default() };
        let mut bits = UsedCells::of(&draw, 8000);
        let mut each = UsedCells::default();
        for _ in 0..4 {
            let samples = more_independent(&subject, &general_scenes(), 1000, 100, &mut bits, &mut rng);
            assert_eq!(samples.len(), 1000);
            assert!(samples.iter().all(|&sample| each.claim(&subject, &[sample])));
        }
        assert!(matches!(UsedCells::of(&Draw::default(), 8000), UsedCells::Each(_)));
    }

    #[test]
    fn a_small_scene_gives_what_it_has() {
        let subject = Subject::hashed("paper", Precision::F64, HashedAlpha::listing(Variant::Isotropic));
        let tiny = [Scene::all()[1].clone().with_resolution([8, 6])];
        let mut rng = seed::rng("sample.tiny", 0);
        let samples = independent(&subject, &tiny, 1000, 1000, &mut rng);
        assert!(!samples.is_empty() && samples.len() < 1000, "{}", samples.len());
    }

    #[test]
    fn a_moved_fragment_is_seen_where_its_point_is() {
        let scene = &general_scenes()[0];
        let mut rng = seed::rng("sample.moved", 0);
        for _ in 0..100 {
            let precision = Precision::F64;
            let here = sighting(scene, &mut rng).placed(placement(&mut rng), precision);
            let there = here.moved(here.fragment.footprint.dpdx * 0.25, precision).fragment;
            let here = here.fragment;
            assert!((there.pixel - here.pixel - dvec2(0.25, 0.0)).length() < 1e-3);
            let motion = there.footprint.position - here.footprint.position;
            assert!((there.world - here.world - motion).length() < 1e-12);
            assert!(((there.eye - here.eye).length() - motion.length()).abs() < 1e-12);
            assert!(there.texcoord != here.texcoord);
        }
    }

    #[test]
    fn what_is_twice_as_near_is_twice_as_large() {
        let scene = &general_scenes()[0];
        let mut rng = seed::rng("sample.nearer", 0);
        let far = sighting(scene, &mut rng);
        let near = far.nearer(2.0);
        let exact = near.surface.fragment(&near.camera, far.fragment.pixel).unwrap();
        assert!((exact.world - far.fragment.world).length() < 1e-12);
        assert!((exact.footprint.dpdx - near.fragment.footprint.dpdx).length() < 1e-14);
        assert!((exact.eye - near.fragment.eye).length() < 1e-12);
        assert!((exact.lod - near.fragment.lod).abs() < 1e-9);
    }
}
