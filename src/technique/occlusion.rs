//! Hashed ambient occlusion: one ray a pixel, in a direction that stays with the geometry (§9, Fig. 8).

use crate::threshold::footprint::Footprint;
use crate::threshold::hash::mm4::murmur3;
use crate::threshold::hash::offset::Offset;
use crate::threshold::hash::sine::Sine;
use crate::threshold::hash::sine_chi_2::SineChi2;
use crate::threshold::hash::{Cell, Hash};
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::real::Real;
use crate::threshold::robust::{InvalidInput, Robust};
use crate::threshold::stage::independent::ByFrame;
use crate::threshold::two_scale::Variant;
use glam::DVec3;
use rand::SeedableRng;
use rand::rngs::Xoshiro256PlusPlus;

/// Returns chi_1 and chi_2 by the listing and the two functions of §9, `hash(hash(x, y), z)` and `hash(x, hash(y, z))`.
///
/// Literal: NaN where the listing is.
#[must_use]
pub fn chi_by_two_hashes<R: Real>(variant: Variant, footprint: &Footprint<R>) -> [R; 2] {
    let HashedAlpha { hash_scale, form, .. } = HashedAlpha::listing(variant);
    let second = HashedAlpha { variant, hash: SineChi2, hash_scale, form };
    [HashedAlpha::listing(variant).threshold(footprint), second.threshold(footprint)]
}

/// Returns chi_1 and chi_2 by the listing and one hash at two places: `hash3D(in + offset[i])` of §9.
///
/// `offsets` are in cells; the paper asks for relatively large, uncorrelated ones. Literal: NaN where the listing is.
#[must_use]
pub fn chi_by_offsets<R: Real>(variant: Variant, offsets: [R::Vec3; 2], footprint: &Footprint<R>) -> [R; 2] {
    let HashedAlpha { hash_scale, form, .. } = HashedAlpha::listing(variant);
    offsets.map(|offset| {
        let hash = Offset { hash: Sine, offset };
        HashedAlpha { variant, hash, hash_scale, form }.threshold(footprint)
    })
}

/// Returns chi_1 and chi_2 of a robust threshold, told apart by a word of the hash; each in [2^-24, 1]. Not in the paper.
///
/// # Errors
///
/// Those of [`Robust::threshold`].
pub fn chi_by_word<R: Real, H: Hash<R> + Copy>(
    robust: &Robust<H>,
    footprint: &Footprint<R>,
) -> Result<[R; 2], InvalidInput> {
    let Robust { variant, hash, hash_scale, join, repairs } = *robust;
    let of = |frame| {
        Robust { variant, hash: ByFrame { hash, frame }, hash_scale, join, repairs }.threshold(footprint)
    };
    Ok([of(1)?, of(2)?])
}

/// Returns the direction of a cosine-weighted ray about the z axis, of length one: `(sqrt(chi_1) cos(2 pi chi_2),
/// sqrt(chi_1) sin(2 pi chi_2), sqrt(max(0, 1 - chi_1)))`. §9. Both are in [0, 1].
#[must_use]
pub fn cosine_direction([chi_1, chi_2]: [f64; 2]) -> DVec3 {
    let (radius, angle) = (chi_1.sqrt(), core::f64::consts::TAU * chi_2);
    DVec3::new(radius * libm::cos(angle), radius * libm::sin(angle), (1.0 - chi_1).max(0.0).sqrt())
}

/// Turns a direction about the z axis into one about `normal`, which has length one.
#[must_use]
pub fn about(normal: DVec3, direction: DVec3) -> DVec3 {
    let (tangent, bitangent) = normal.any_orthonormal_pair();
    direction.x * tangent + direction.y * bitangent + direction.z * normal
}

/// Returns whether a point is open to the sky along its one ray: `occluded` is asked for the direction.
///
/// The mean over many `chi` is the ambient occlusion of the point, 1 where nothing is in the way.
#[must_use]
pub fn open(normal: DVec3, chi: [f64; 2], occluded: impl FnOnce(DVec3) -> bool) -> bool {
    !occluded(about(normal, cosine_direction(chi)))
}

/// Makes an ordinary generator out of a cell: "a hash returning an integer could seed a more traditional pseudorandom
/// number generator" (§9). The same cell gives the same numbers.
#[must_use]
pub fn generator<R: Real>(cell: &Cell<R>) -> Xoshiro256PlusPlus {
    let words = cell.words();
    let low = murmur3(words);
    let high = murmur3([words[0], words[1], words[2], !words[3]]);
    Xoshiro256PlusPlus::seed_from_u64(u64::from(high) << 32 | u64::from(low))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::threshold::hash::HashKind;
    use crate::threshold::hash::open_lattice;
    use glam::{Vec3, vec3};
    use rand::Rng;

    /// An oblique surface, a pixel at each footprint.
    fn surface(shift: f32) -> impl Iterator<Item = Footprint<f32>> {
        let (dpdx, dpdy) = (vec3(0.011, 0.002, 0.004), vec3(-0.003, 0.013, 0.001));
        (0..64 * 64).map(move |i| {
            let (x, y) = ((i % 64) as f32 + shift, (i / 64) as f32);
            Footprint { position: vec3(3.1, 1.7, 4.3) + x * dpdx + y * dpdy, dpdx, dpdy }
        })
    }

    fn offsets() -> [Vec3; 2] {
        [vec3(1013.0, -377.0, 2311.0), vec3(-1999.0, 743.0, 89.0)]
    }

    type Pair = fn(&Footprint<f32>) -> [f32; 2];
    const PAIRS: [(&str, Pair); 5] = [
        ("two hashes, isotropic", |f| chi_by_two_hashes(Variant::Isotropic, f)),
        ("two hashes, anisotropic", |f| chi_by_two_hashes(Variant::Anisotropic, f)),
        ("offsets", |f| chi_by_offsets(Variant::Isotropic, offsets(), f)),
        ("word, isotropic", |f| chi_by_word(&Robust::new(Variant::Isotropic), f).unwrap()),
        ("word, anisotropic", |f| chi_by_word(&Robust::new(Variant::Anisotropic), f).unwrap()),
    ];

    fn sky(pair: Pair, occluded: fn(DVec3) -> bool) -> f64 {
        let open = surface(0.0).filter(|f| open(DVec3::Z, pair(f).map(f64::from), occluded)).count();
        open as f64 / 4096.0
    }

    /// Cosine-weighted rays see a cone of half-angle t about the normal with the share sin^2 t.
    #[test]
    fn one_ray_a_pixel_gives_the_occlusion_in_the_mean() {
        for (name, pair) in PAIRS {
            // Five deviations of 4096 rays are 0.04; cells are larger than pixels, so that rays repeat.
            assert!((sky(pair, |d| d.z > 0.5_f64.sqrt()) - 0.5).abs() < 0.06, "{name}");
            assert!((sky(pair, |d| d.x > 0.0) - 0.5).abs() < 0.06, "{name}");
            assert!((sky(pair, |d| d.y > 0.0) - 0.5).abs() < 0.06, "{name}");
            assert_eq!(sky(pair, |_| false), 1.0, "{name}");
        }
        // Directions spread evenly over the hemisphere, without the square root, see another share.
        let even = |i: u32| {
            let chi: f64 = open_lattice(murmur3([i, 0, 0, 0]));
            chi > 0.5_f64.sqrt()
        };
        assert!(((0..4096).filter(|&i| even(i)).count() as f64 / 4096.0 - 0.5).abs() > 0.1);
    }

    /// "Noise remains largely stable under motion and stays fixed to the geometry": a tenth of a pixel changes fewer
    /// rays than a generator anchored to the screen does, which changes none in the pixel and all on the surface.
    #[test]
    fn rays_stay_with_the_geometry() {
        for (name, pair) in PAIRS {
            let same = surface(0.0).zip(surface(0.1)).filter(|(a, b)| pair(a) == pair(b)).count();
            assert!(same as f64 > 0.6 * 4096.0, "{name}: {same}");
            // One whole pixel on, the surface shows the rays of the pixel beside.
            let columns = surface(1.0).zip(surface(0.0).skip(1)).enumerate().filter(|(i, _)| i % 64 != 63);
            let kept = columns.filter(|(_, (a, b))| pair(a) == pair(b)).count();
            assert!(kept as f64 > 0.98 * 63.0 * 64.0, "{name}: {kept}");
        }
    }

    #[test]
    fn directions_have_length_one_and_leave_the_surface() {
        let normal = DVec3::new(0.3, -0.5, 0.2).normalize();
        for i in 0..500 {
            let chi = [0, 1].map(|which| open_lattice::<f64>(murmur3([i, which, 0, 0])));
            let direction = about(normal, cosine_direction(chi));
            assert!((direction.length() - 1.0).abs() < 1e-12 && direction.dot(normal) >= 0.0);
            assert!((direction.dot(normal) - (1.0 - chi[0]).sqrt()).abs() < 1e-12);
        }
        assert!(cosine_direction([1.0, 0.3]).is_finite() && cosine_direction([0.0, 0.0]) == DVec3::Z);
    }

    #[test]
    fn a_cell_seeds_one_stream() {
        let cell = |x, octave| Cell::<f32> { index: vec3(x, 2.0, 3.0), octave };
        let first = |cell| generator(&cell).next_u64();
        assert_eq!(first(cell(1.0, 0)), first(cell(1.0, 0)));
        assert_ne!(first(cell(1.0, 0)), first(cell(2.0, 0)));
        assert_ne!(first(cell(1.0, 0)), first(cell(1.0, 1)));
    }

    #[test]
    fn the_paper_hash_has_no_word_to_tell_samples_apart() {
        let footprint = surface(0.0).next().unwrap();
        let robust = Robust { hash: HashKind::Sine, ..Robust::new(Variant::Isotropic) };
        let [chi_1, chi_2] = chi_by_word(&robust, &footprint).unwrap();
        assert_eq!(chi_1, chi_2);
    }
}
