//! The claims about cells, Eq. 2 and the hash of single cells reject what is broken in just their way.

use hashed_alpha::check::subject::Precision;
use hashed_alpha::check::{Draw, Subject, Verdict, claims, run_claims};
use hashed_alpha::threshold::cdf::cdf;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::{Cell, Hash, HashKind, sine::hash_2d};
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::real::Real;
use hashed_alpha::threshold::robust::Robust;
use hashed_alpha::threshold::two_scale::Variant;

fn assert_rejected_by(claim: &str, subject: Subject<'_>) {
    let claim = claims::ALL.iter().copied().find(|known| known.id == claim).expect("a claim of that name");
    let [outcome] = &run_claims(&[claim], &[subject], &Draw::default(), || {})[..] else {
        panic!("one claim, one outcome")
    };
    assert_eq!(outcome.verdict, Verdict::Rejected, "{outcome}");
}

/// A hash of `f64` words, of an index and an octave word.
#[derive(Clone, Copy)]
struct Of(fn([f64; 3], u32) -> f64);

impl<R: Real> Hash<R> for Of {
    fn hash(&self, cell: &Cell<R>) -> R {
        let index: [R; 3] = cell.index.into();
        R::from_f64((self.0)(index.map(R::to_f64), cell.octave))
    }
}

fn mm4(index: [f64; 3], octave: u32) -> f64 {
    HashKind::Mm4.hash(&Cell::<f64> { index: index.into(), octave })
}

/// The robust threshold with a hash of one's own.
fn with_hash(hash: fn([f64; 3], u32) -> f64) -> Subject<'static> {
    let Robust { variant, hash_scale, join, repairs, .. } = Robust::new(Variant::Isotropic);
    Subject::robust("specimen", Precision::F32, Robust { variant, hash: Of(hash), hash_scale, join, repairs })
}

/// Listing 1 with positions moved by half a fine cell: what `round` in place of `floor` does.
fn rounded_cells() -> Subject<'static> {
    let listing = HashedAlpha::listing(Variant::Isotropic);
    Subject::new("rounded_cells", Precision::F64, Variant::Isotropic, move |footprint| {
        let found = Variant::Isotropic.two_scale(footprint, 1.0);
        let half = 0.5 * libm::exp2(-(f64::from(found.octave[0]) + 1.0));
        listing.threshold(&Footprint { position: footprint.position + half, ..*footprint })
    })
}

/// Listing 1 that adds a little of the position itself, as a smoothed hash does.
fn smoothed_hash() -> Subject<'static> {
    let listing = HashedAlpha::listing(Variant::Isotropic);
    Subject::new("smoothed_hash", Precision::F64, Variant::Isotropic, move |footprint| {
        let within = footprint.position.x - footprint.position.x.floor();
        0.999 * listing.threshold(footprint) + 0.001 * within
    })
}

/// Every other cell along x has the threshold of its neighbour.
fn cells_in_twos() -> Subject<'static> {
    with_hash(|[x, y, z], octave| mm4([(x / 2.0).floor(), y, z], octave))
}

/// Eq. 2 with a (1 - a) where 2 a (1 - a) belongs.
fn cdf_without_its_two() -> Subject<'static> {
    let listing = HashedAlpha::listing(Variant::Isotropic);
    let wrong = move |footprint: &Footprint<f64>| {
        let found = listing.trace(footprint);
        let a = found.two_scale.lerp_factor.min(1.0 - found.two_scale.lerp_factor);
        let x = found.interpolated;
        if x < a { x * x / (a * (1.0 - a)) } else { cdf(x, found.two_scale.lerp_factor) }.clamp(1e-6, 1.0)
    };
    Subject::new("cdf_without_its_two", Precision::F64, Variant::Isotropic, wrong)
        .with_interpolated(move |footprint| listing.trace(footprint).interpolated)
}

/// Every second octave repeats the one above it.
fn octaves_in_twos() -> Subject<'static> {
    with_hash(|index, octave| {
        if octave % 2 == 1 { mm4(index.map(|i| (i / 2.0).floor()), octave - 1) } else { mm4(index, octave) }
    })
}

/// A lattice of irrational steps: uniform, and its differences are constants.
fn additive_recurrence() -> Subject<'static> {
    with_hash(|[x, y, z], octave| {
        let at =
            0.819_172_513_396 * x + 0.671_043_606_703 * y + 0.549_700_477_901 * z + 0.31 * f64::from(octave);
        (at - at.floor()).clamp(1e-7, 1.0 - 1e-7)
    })
}

/// A table of 256 values.
fn byte_table() -> Subject<'static> {
    with_hash(|index, octave| ((mm4(index, octave) * 256.0).floor() + 0.5) / 256.0)
}

/// The sine hash of x and y alone.
fn sine_hash_of_two_coordinates() -> Subject<'static> {
    with_hash(|[x, y, _], _| hash_2d(x, y).clamp(1e-7, 1.0 - 1e-7))
}

#[test]
fn cells_are_where_the_listing_cuts_them() {
    assert_rejected_by("exact.cells", rounded_cells());
    assert_rejected_by("exact.cells", smoothed_hash());
    assert_rejected_by("exact.cells", cells_in_twos());
}

#[test]
fn eq_2_is_computed_again() {
    assert_rejected_by("exact.cdf", cdf_without_its_two());
}

#[test]
fn an_octave_is_no_copy_of_its_parent() {
    assert_rejected_by("hash.children", octaves_in_twos());
}

#[test]
fn a_lattice_is_no_noise() {
    assert_rejected_by("hash.differences", additive_recurrence());
}

#[test]
fn few_values_meet_too_often() {
    assert_rejected_by("hash.values", byte_table());
}

#[test]
fn the_sine_hash_of_two_coordinates_resonates() {
    assert_rejected_by("hash.resonance", sine_hash_of_two_coordinates());
}
