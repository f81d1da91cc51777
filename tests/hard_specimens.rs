//! The claims about continuity, cells and atoms reject what is broken in just their way, and pass an ideal source.

mod ideal;

use hashed_alpha::check::claims::{self, Claim};
use hashed_alpha::check::{Draw, Subject, Verdict, run_claims, subject::Precision};
use hashed_alpha::threshold::cdf::{CdfForm, cdf};
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::{Cell, Hash, HashKind, sine::hash_2d};
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::real::{Real, log2_f32};
use hashed_alpha::threshold::robust::scales::cell;
use hashed_alpha::threshold::robust::{Join, Repair, Repairs, Robust};
use hashed_alpha::threshold::two_scale::Variant;
use ideal::Ideal;

const HARD: [&str; 3] = ["continuity.", "cells.", "atoms."];

fn ideal(variant: Variant, join: Join) -> Robust<Ideal> {
    Robust { variant, hash: Ideal, hash_scale: 1.0, join, repairs: Repairs::ALL }
}

fn claim_named(id: &str) -> Claim {
    claims::ALL.iter().copied().find(|claim| claim.id == id).expect("a claim of that name")
}

fn assert_rejected_by(claim: &str, subject: Subject<'_>) {
    let [outcome] = &run_claims(&[claim_named(claim)], &[subject], &Draw::default(), || {})[..] else {
        panic!("one claim, one outcome")
    };
    assert_eq!(outcome.verdict, Verdict::Rejected, "{outcome:?}");
    assert!(outcome.finding.as_ref().is_some_and(|finding| !finding.is_empty()), "{outcome:?}");
}

fn isotropic<'a>(threshold: impl Fn(&Footprint<f64>) -> f64 + Send + Sync + 'a) -> Subject<'a> {
    Subject::new("specimen", Precision::F64, Variant::Isotropic, threshold)
}

/// Listing 1 with a hash of one's own.
fn with_hash<'a, H: Hash<f32> + Hash<f64> + Copy + Send + 'a>(hash: H) -> Subject<'a> {
    let listing = HashedAlpha { variant: Variant::Isotropic, hash, hash_scale: 1.0, form: CdfForm::Stable };
    Subject::hashed("specimen", Precision::F64, listing)
}

#[test]
fn an_ideal_source_passes() {
    let hard: Vec<Claim> = claims::ALL
        .iter()
        .copied()
        .filter(|claim| HARD.iter().any(|family| claim.id.starts_with(family)))
        .collect();
    assert!(HARD.iter().all(|family| hard.iter().any(|claim| claim.id.starts_with(family))));
    let continuous = [
        ideal(Variant::Isotropic, Join::Interpolate),
        ideal(Variant::Isotropic, Join::Copula),
        ideal(Variant::Isotropic, Join::Dithered),
        ideal(Variant::Anisotropic, Join::Copula),
        ideal(Variant::Anisotropic, Join::Dithered),
    ];
    for robust in continuous {
        for precision in Precision::ALL {
            let subject = Subject::robust("ideal", precision, robust);
            for outcome in run_claims(&hard, &[subject], &Draw::default(), || {}) {
                assert!(outcome.as_expected(), "{} {} {precision}: {outcome:?}", robust.variant, robust.join);
            }
        }
    }
}

#[test]
fn one_weight_for_three_scales_jumps() {
    for claim in ["zoom", "rotation", "tilt", "octave_boundary"] {
        let jumping = ideal(Variant::Anisotropic, Join::Interpolate);
        let subject = Subject::robust("specimen", Precision::F64, jumping);
        assert_rejected_by(&format!("continuity.{claim}"), subject);
    }
}

/// Says which of the two cells it is, and not which octave.
fn salted_by_role(footprint: &Footprint<f64>) -> f64 {
    let found = Variant::Isotropic.two_scale(footprint, 1.0);
    let coarse: f64 = Ideal.hash(&Cell { octave: 0, ..found.floor_cell });
    let fine: f64 = Ideal.hash(&Cell { octave: 1, ..found.ceil_cell });
    cdf((1.0 - found.lerp_factor) * coarse + found.lerp_factor * fine, found.lerp_factor)
}

#[test]
fn a_salt_by_role_jumps_at_every_octave() {
    assert_rejected_by("continuity.octave_boundary", isotropic(salted_by_role));
    assert_rejected_by("continuity.zoom", isotropic(salted_by_role));
}

#[test]
fn the_nearest_octave_jumps_between_octaves() {
    let nearest = |footprint: &Footprint<f64>| {
        let scale = Variant::Isotropic.two_scale(footprint, 1.0).pixel_scale[0];
        let octave = libm::round(libm::log2(scale)) as i32;
        Ideal.hash(&cell::<f64>(footprint.position, [octave; 3], Repairs::ALL))
    };
    for claim in ["continuity.zoom", "continuity.rotation", "continuity.tilt"] {
        assert_rejected_by(claim, isotropic(nearest));
    }
}

#[test]
fn an_octave_from_the_exponent_disagrees_with_a_rounded_logarithm() {
    let mixed = |footprint: &Footprint<f64>| {
        let scale = Variant::Isotropic.two_scale(&footprint.cast::<f32>(), 1.0).pixel_scale[0];
        let octave = (scale.to_bits() >> 23) as i32 - 127;
        let lerp_factor = f64::from(Real::fract(log2_f32(scale)));
        let hash = |octave| Ideal.hash(&cell::<f64>(footprint.position, [octave; 3], Repairs::ALL));
        let (coarse, fine): (f64, f64) = (hash(octave), hash(octave + 1));
        cdf((1.0 - lerp_factor) * coarse + lerp_factor * fine, lerp_factor)
    };
    let subject = Subject::new("specimen", Precision::F32, Variant::Isotropic, mixed);
    assert_rejected_by("continuity.octave_boundary", subject);
}

#[test]
fn a_dither_that_is_drawn_anew_with_every_view_switches_too_often() {
    let flickering = |footprint: &Footprint<f64>| {
        let found = Variant::Isotropic.two_scale(footprint, 1.0);
        let view = footprint.dpdy.x.to_bits() ^ footprint.dpdy.y.to_bits().rotate_left(17);
        let draw: f64 = Ideal.hash(&Cell { octave: (view ^ (view >> 32)) as u32, ..found.floor_cell });
        Ideal.hash(if found.lerp_factor > draw { &found.ceil_cell } else { &found.floor_cell })
    };
    for claim in ["continuity.zoom", "continuity.tilt"] {
        let mut subject = isotropic(flickering);
        subject.join = Join::Dithered;
        assert_rejected_by(claim, subject);
    }
}

#[test]
fn a_dither_with_a_salt_by_role_switches_at_every_octave() {
    let by_role = |footprint: &Footprint<f64>| {
        let found = Variant::Isotropic.two_scale(footprint, 1.0);
        let draw: f64 = Ideal.hash(&Cell { octave: 2, ..found.floor_cell });
        Ideal.hash(&if found.lerp_factor > draw {
            Cell { octave: 1, ..found.ceil_cell }
        } else {
            Cell { octave: 0, ..found.floor_cell }
        })
    };
    for claim in ["continuity.zoom", "continuity.octave_boundary"] {
        let mut subject = isotropic(by_role);
        subject.join = Join::Dithered;
        assert_rejected_by(claim, subject);
    }
}

#[test]
fn without_the_octave_the_origin_has_one_threshold() {
    for variant in [Variant::Isotropic, Variant::Anisotropic] {
        let repairs = Repairs::ALL.without(Repair::OctaveWord);
        let robust = Robust { repairs, ..Robust::new(variant) };
        assert_rejected_by("cells.origin", Subject::robust::<HashKind>("specimen", Precision::F64, robust));
    }
}

/// Keeps coordinates in 16 bits, as a vertex format does.
#[derive(Clone, Copy)]
struct Short;

impl<R: Real> Hash<R> for Short {
    fn hash(&self, cell: &Cell<R>) -> R {
        let short = cell.index.into().map(|c| R::from_f64(c.to_f64().clamp(-32_768.0, 32_767.0)));
        Ideal.hash(&Cell { index: short.into(), octave: cell.octave })
    }
}

#[test]
fn coordinates_in_16_bits_end() {
    assert_rejected_by("cells.window", with_hash(Short));
}

/// The paper's hash of two coordinates, with nothing for the third.
#[derive(Clone, Copy)]
struct TwoDimensional;

impl<R: Real> Hash<R> for TwoDimensional {
    fn hash(&self, cell: &Cell<R>) -> R {
        let [x, y, _] = cell.index.into();
        hash_2d(x, y)
    }
}

/// Does not tell the order of x and y.
#[derive(Clone, Copy)]
struct Commuting;

impl<R: Real> Hash<R> for Commuting {
    fn hash(&self, cell: &Cell<R>) -> R {
        let [x, y, z] = cell.index.into();
        Ideal.hash(&Cell { index: [x + y, x * y, z].into(), octave: cell.octave })
    }
}

#[test]
fn mirrored_and_exchanged_cells_are_told_apart() {
    assert_rejected_by("cells.mirror", with_hash(TwoDimensional));
    assert_rejected_by("cells.mirror", with_hash(Commuting));
}

/// Cuts the value to 11 bits, as a texture of noise might hold it.
#[derive(Clone, Copy)]
struct ElevenBits;

impl<R: Real> Hash<R> for ElevenBits {
    fn hash(&self, cell: &Cell<R>) -> R {
        let value: R = Ideal.hash(cell);
        (value * R::from_f64(2048.0)).floor() * R::from_f64(1.0 / 2048.0)
    }
}

#[test]
fn a_hash_of_few_bits_is_zero_too_often() {
    assert_rejected_by("atoms.zero", with_hash(ElevenBits));
}
