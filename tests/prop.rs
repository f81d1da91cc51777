//! Properties that hold for every input: of the CDF, of a shift by whole cells, and of any chain of techniques.

use crate::mask;
use core::num::NonZeroU32;
use glam::{DVec3, dvec3};
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::cdf::{cdf, cdf_literal, density, quantile};
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::{HashKind, open_lattice, sine};
use hashed_alpha::threshold::hashed::{HashedAlpha, SMALLEST_THRESHOLD};
use hashed_alpha::threshold::robust::{Join, Repairs, Robust, scales};
use hashed_alpha::threshold::stage::fade_in::fade_in;
use hashed_alpha::threshold::stage::order::Order;
use hashed_alpha::threshold::stage::screen_door;
use hashed_alpha::threshold::two_scale::Variant;
use proptest::prelude::*;

fn unit() -> impl Strategy<Value = f64> {
    prop_oneof![8 => 0.0..=1.0, 1 => Just(0.0), 1 => Just(1.0), 1 => Just(0.5), 1 => 0.0..=1e-9]
}

fn vector(size: f64) -> impl Strategy<Value = DVec3> {
    (-size..size, -size..size, -size..size).prop_map(|(x, y, z)| dvec3(x, y, z))
}

fn footprint() -> impl Strategy<Value = Footprint<f64>> {
    (vector(20.0), vector(0.1), vector(0.1)).prop_map(|(position, dpdx, dpdy)| Footprint {
        position,
        dpdx,
        dpdy,
    })
}

/// Any `f32` in [0, 1], every exponent as likely as every other.
fn unit_f32() -> impl Strategy<Value = f32> {
    prop_oneof![(0..=1.0_f32.to_bits()).prop_map(f32::from_bits), 0.0..=1.0_f32]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4096, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn cdf_stays_in_the_unit_interval_for_every_f32(x in unit_f32(), weight in unit_f32()) {
        let value = cdf(x, weight);
        prop_assert!((0.0..=1.0).contains(&value), "cdf({x:?}, {weight:?}) = {value:?}");
    }

    #[test]
    fn cdf_is_monotone_in_every_f32(x in unit_f32(), y in unit_f32(), weight in unit_f32()) {
        let (low, high) = if x < y { (x, y) } else { (y, x) };
        prop_assert!(cdf(low, weight) <= cdf(high, weight));
        let next = f32::from_bits(low.to_bits() + 1).min(1.0);
        prop_assert!(cdf(low, weight) <= cdf(next, weight));
    }

    #[test]
    fn cdf_is_symmetric(x in unit(), weight in unit()) {
        prop_assert!((cdf(x, weight) + cdf(1.0 - x, weight) - 1.0).abs() < 1e-15);
        prop_assert!((cdf(x, weight) - cdf(x, 1.0 - weight)).abs() < 1e-15);
    }

    #[test]
    fn cdf_is_inverted_by_its_quantile(p in unit(), weight in unit()) {
        prop_assert!((cdf(quantile(p, weight), weight) - p).abs() < 1e-14);
    }

    #[test]
    fn cdf_grows_by_its_density(x in 0.0..0.999, weight in 0.001..0.999) {
        let step = 1e-6;
        let slope = (cdf::<f64>(x + step, weight) - cdf(x, weight)) / step;
        let (low, high) = (density(x, weight), density(x + step, weight));
        prop_assert!(slope >= low.min(high) - 1e-8 && slope <= low.max(high) + 1e-8);
    }

    #[test]
    fn literal_cdf_is_the_same_function(x in 0.0..1.0_f64, weight in 1e-6..0.999_999_f64) {
        prop_assert!((cdf(x, weight) - cdf_literal(x, weight)).abs() < 1e-15);
    }

    #[test]
    fn a_shift_by_a_whole_coarse_cell_shifts_both_cells(footprint in footprint(), axis in 0_usize..3, cells in -9_i32..9) {
        let before = Variant::Isotropic.two_scale(&footprint, 1.0);
        // A power of two, so that the shift is exact in both grids unless it rounds the position.
        let shift = DVec3::AXES[axis] * f64::from(cells) * libm::exp2(-f64::from(before.octave[0]));
        let moved = Footprint { position: footprint.position + shift, ..footprint };
        prop_assume!(moved.position - shift == footprint.position);
        let after = Variant::Isotropic.two_scale(&moved, 1.0);
        let step = DVec3::AXES[axis] * f64::from(cells);
        prop_assert_eq!(after.floor_cell.index, before.floor_cell.index + step);
        let finer = if before.lerp_factor == 0.0 { 1.0 } else { 2.0 };
        prop_assert_eq!(after.ceil_cell.index, before.ceil_cell.index + finer * step);
        prop_assert_eq!(after.lerp_factor, before.lerp_factor);
    }

    #[test]
    fn the_fine_grid_subdivides_the_coarse_one(footprint in footprint()) {
        let found = Variant::Isotropic.two_scale(&footprint, 1.0);
        prop_assume!(found.lerp_factor > 0.0);
        let bit = found.ceil_cell.index - 2.0 * found.floor_cell.index;
        prop_assert!(bit.to_array().iter().all(|&b| b == 0.0 || b == 1.0), "{bit}");
    }

    #[test]
    fn thresholds_stay_in_range(footprint in footprint(), kind in 0..HashKind::ALL.len(), form in 0..2_usize) {
        for variant in [Variant::Isotropic, Variant::Anisotropic] {
            let hashed = HashedAlpha { variant, hash: HashKind::ALL[kind], hash_scale: 1.0, form: CdfForm::ALL[form] };
            let double: f64 = hashed.threshold(&footprint);
            let single: f32 = hashed.threshold(&footprint.cast());
            prop_assert!((SMALLEST_THRESHOLD..=1.0).contains(&double), "{double}");
            prop_assert!((SMALLEST_THRESHOLD as f32..=1.0).contains(&single), "{single}");
        }
    }

    #[test]
    fn the_robust_threshold_is_total_in_f32(bits in prop::array::uniform9(any::<u32>()), hash_scale in any::<u64>(), which in 0..6_usize) {
        let [px, py, pz, xx, xy, xz, yx, yy, yz] = bits.map(f32::from_bits);
        let footprint = Footprint::<f32> {
            position: glam::vec3(px, py, pz), dpdx: glam::vec3(xx, xy, xz), dpdy: glam::vec3(yx, yy, yz),
        };
        let variant = [Variant::Isotropic, Variant::Anisotropic][which % 2];
        for hash_scale in [1.0, f64::from_bits(hash_scale)] {
            let robust = Robust { join: Join::ALL[which / 2], hash_scale, ..Robust::new(variant) };
            if let Ok(threshold) = robust.threshold(&footprint) {
                prop_assert!(threshold > 0.0 && threshold <= 1.0, "{threshold} for {footprint:?}");
            }
        }
    }

    #[test]
    fn the_robust_threshold_is_total_in_f64(bits in prop::array::uniform9(any::<u64>()), hash_scale in any::<u64>(), which in 0..6_usize) {
        let [px, py, pz, xx, xy, xz, yx, yy, yz] = bits.map(f64::from_bits);
        let footprint = Footprint::<f64> { position: dvec3(px, py, pz), dpdx: dvec3(xx, xy, xz), dpdy: dvec3(yx, yy, yz) };
        let variant = [Variant::Isotropic, Variant::Anisotropic][which % 2];
        for hash_scale in [1.0, f64::from_bits(hash_scale)] {
            let robust = Robust { join: Join::ALL[which / 2], hash_scale, ..Robust::new(variant) };
            if let Ok(threshold) = robust.threshold(&footprint) {
                prop_assert!(threshold > 0.0 && threshold <= 1.0, "{threshold} for {footprint:?}");
            }
        }
    }

    #[test]
    fn a_new_coarse_cell_is_a_new_fine_cell(here in vector(1000.0), motion in vector(0.01), octave in -4..8_i32) {
        let cells = |position: DVec3| {
            [0, 1].map(|finer| scales::nested_cell::<f64>(position, [octave + finer; 3], Repairs::ALL).index)
        };
        let ([coarse, fine], [coarse_after, fine_after]) = (cells(here), cells(here + motion));
        prop_assert!(coarse == coarse_after || fine != fine_after, "{here} {motion}");
    }

    #[test]
    fn the_sine_hash_stays_in_the_unit_interval(x in -1e6..1e6_f32, y in -1e6..1e6_f32) {
        prop_assert!((0.0..=1.0).contains(&sine::hash_2d(x.floor(), y.floor())));
    }

    /// Hash, temporal order, fade towards an authored threshold, then any kind of mask: in every combination.
    #[test]
    fn alpha_0_never_shows_and_alpha_1_has_no_hole_through_any_chain(
        words in prop::array::uniform4(any::<u32>()), order in 0..Order::ALL.len(), frame in any::<u32>(), n in 1..32_u32,
        authored in 1e-3..=1.0_f64, b in -0.5..1.5_f64,
    ) {
        let n = NonZeroU32::new(n).expect("from 1 on");
        let chi = |word: u32| {
            let hashed = if word.is_multiple_of(7) { 1.0 } else { open_lattice(word) };
            fade_in(authored, Order::ALL[order].threshold(hashed, frame, n), b)
        };
        let xi = [words[1], words[2]].map(open_lattice::<f64>);
        let all = (1_u64 << n.get()) - 1;
        for (alpha, expected) in [(0.0, 0), (1.0, all as u32)] {
            prop_assert_eq!(alpha >= chi(words[0]), alpha == 1.0);
            let masks = [
                mask::fixed_dither(alpha, n),
                mask::hardware(alpha, n),
                mask::stratified(alpha, n, |i| chi(words[0] ^ i)),
                mask::permuted(alpha, n, xi, |i| chi(words[0] ^ i)),
                mask::random_set(alpha, n, xi[0], words[3]),
                mask::by_pixel(alpha, n, [words[0], words[3]]),
            ];
            prop_assert_eq!(masks, [expected; 6]);
            for threshold in [
                screen_door::fixed([words[0], words[1]]),
                screen_door::bayer([words[0], words[1]]),
                screen_door::random_mask([words[0], words[1]], words[2]),
                screen_door::randomised([words[0], words[1]], words[2]),
            ] {
                prop_assert_eq!(alpha >= threshold, alpha == 1.0);
            }
        }
    }
}
