//! Inputs at the edge of the number format: derivatives and positions that are zero, tiny, huge, infinite or NaN, and
//! surfaces so far from the origin that neighbouring pixels have the same position.

use crate::check::shrink::describe;
use crate::check::{Attempt, Claim, Draw, Promise, Subject, Trial, Verdict};
use crate::scene::Fragment;
use crate::stats::seed::uniform01;
use crate::threshold::footprint::Footprint;
use glam::{DVec3, Vec3, vec3};
use rand::rngs::Xoshiro256PlusPlus;

/// Distances from the origin at which `f32` positions are tried, in object units: a large level, a city, a country.
const FAR_COORDINATES: [f32; 3] = [1.0e4, 1.0e5, 1.0e6];

/// Sizes of a pixel there, in units in the last place of the coordinate: from quads with one position to quads with a
/// derivative of one or two units.
const FAR_FOOTPRINTS: [f64; 4] = [0.05, 0.2, 0.5, 1.5];

/// Quads of each size at each distance: a share is known to a hundredth.
const FAR_QUADS: usize = 1 << 13;

/// A table of degenerate footprints; no chance in it.
pub const DEGENERATE: Claim = Claim {
    id: "range.degenerate",
    anchor: "§5, §6.2, Listings 1 and 2 (divisions and logarithms); degenerate inputs not in the paper",
    statement: "a footprint with a zero, tiny, huge, infinite or NaN component is refused or has a threshold in (0, 1]",
    expected: Verdict::Consistent,
    promise: None,
    run: degenerate,
};

/// Quads of a wall on which the pixels lie closer together than `f32` coordinates do.
pub const FAR_FROM_ORIGIN: Claim = Claim {
    id: "range.far_from_origin",
    anchor: "§5, Listings 1 and 2 (objCoord); not in the paper",
    statement: "on a wall 1e4 to 1e6 units from the origin, with pixels of 0.05 to 1.5 units in the last place of an \
                f32 coordinate, every threshold is a number in (0, 1]",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(3.0e-4)),
    run: far_from_origin,
};

/// What takes the place of ordinary components, in `f64`; rounded to `f32`, some are zero or infinite.
const VALUES: [f64; 16] = [
    0.0,
    // The smallest numbers of each format, and one in the subnormal range of each.
    f32::from_bits(1) as f64,
    1.0e-38,
    f64::from_bits(1),
    1.0e-308,
    // A square that under- or overflows in each format.
    1.0e-23,
    1.0e-170,
    1.0e19,
    1.0e160,
    1.0e30,
    1.0e38,
    f32::MAX as f64,
    f64::MAX,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

/// Which components a value takes, one bit each: position x, y, z, then dpdx, then dpdy.
const PLACES: [u32; 20] = [
    // One component.
    0o001, 0o002, 0o004, 0o010, 0o020, 0o040, 0o100, 0o200, 0o400,
    // The position, one derivative, both, everything.
    0o007, 0o070, 0o700, 0o770, 0o777, // Both derivatives along one axis, and along two.
    0o110, 0o220, 0o440, 0o330, 0o550, 0o660,
];

/// A footprint of an ordinary surface.
const ORDINARY: [f64; 9] = [0.31, -1.72, 2.43, 0.0121, 0.0003, -0.0007, 0.0002, 0.0094, 0.0033];

/// The ordinary footprint with `value` at `places`.
fn replaced(value: f64, places: u32) -> Footprint<f64> {
    let vector = |first: usize| {
        let component = |axis: usize| {
            let at = first + axis;
            if places >> at & 1 == 1 { value } else { ORDINARY[at] }
        };
        DVec3::from_array([0, 1, 2].map(component))
    };
    Footprint { position: vector(0), dpdx: vector(3), dpdy: vector(6) }
}

fn is_threshold(value: f64) -> bool {
    value > 0.0 && value <= 1.0
}

fn is_finite(footprint: &Footprint<f64>) -> bool {
    footprint.position.is_finite() && footprint.dpdx.is_finite() && footprint.dpdy.is_finite()
}

fn degenerate(subject: &Subject<'_>, _: &Draw) -> Attempt<Trial> {
    let (mut n, mut refused, mut outside) = (0_u64, 0_u64, 0_u64);
    let mut first = None;
    for value in VALUES {
        for places in PLACES {
            let footprint = subject.precision.round(&replaced(value, places));
            n += 1;
            match subject.threshold(footprint) {
                // Only what is not finite may be refused: a pixel with finite derivatives has to be drawn.
                None if !is_finite(&footprint) => refused += 1,
                Some(threshold) if is_threshold(threshold) => {}
                answer => {
                    outside += 1;
                    first.get_or_insert((footprint, answer));
                }
            }
        }
    }
    let first = first.map_or(String::new(), |(footprint, answer)| {
        let is_like_it = |_: &Fragment, value: f64| {
            !is_threshold(value) && value.is_nan() == answer.is_none_or(f64::is_nan)
        };
        format!("; as in {}", describe(subject, &footprint.into(), is_like_it))
    });
    let seen = format!("{outside} of {n} answers are no number in (0, 1], {refused} are refusals{first}");
    // A fixed table: what is not on it is not seen.
    Ok(Trial { detectable: None, ..outsiders(outside, n, seen) })
}

/// The trial of a claim that every threshold is in (0, 1].
fn outsiders(outside: u64, n: u64, seen: String) -> Trial {
    Trial::counted(outside, n, "thresholds outside (0, 1]", "share of footprints", seen)
}

fn far_from_origin(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(FAR_FROM_ORIGIN.id);
    let (mut n, mut outside) = (0, 0);
    let (mut seen, mut first) = (Vec::new(), None);
    for ratio in FAR_FOOTPRINTS {
        let quads: Vec<Footprint<f64>> = FAR_COORDINATES
            .into_iter()
            .flat_map(|coordinate| std::iter::repeat_n(coordinate, draw.samples(FAR_QUADS)))
            .map(|coordinate| far_quad(coordinate, ratio, &mut rng).cast())
            .collect();
        let thresholds = subject.thresholds(&quads);
        let bad = |threshold: &f64| !is_threshold(*threshold);
        let count = thresholds.iter().filter(|threshold| bad(threshold)).count();
        if let Some(at) = thresholds.iter().position(bad) {
            let is_like_it = |quad: &Fragment, value: f64| {
                let is_far =
                    quad.footprint.position.truncate().min_element() >= f64::from(FAR_COORDINATES[0]);
                is_far && bad(&value) && value.is_nan() == thresholds[at].is_nan()
            };
            first.get_or_insert_with(|| describe(subject, &quads[at].into(), is_like_it));
        }
        let share = 100.0 * count as f64 / quads.len() as f64;
        seen.push(format!("{share:.1} % at {ratio}"));
        n += quads.len() as u64;
        outside += count as u64;
    }
    let first = first.map_or(String::new(), |first| format!("; as in {first}"));
    let seen = format!(
        "no number in (0, 1], by the size of a pixel in units in the last place: {}{first}",
        seen.join(", ")
    );
    Ok(outsiders(outside, n, seen))
}

/// A pixel of a frontal wall of constant z whose pixels are `ratio` units in the last place of `f32` wide: positions
/// rounded to `f32`, and their differences to the next pixels.
fn far_quad(coordinate: f32, ratio: f64, rng: &mut Xoshiro256PlusPlus) -> Footprint<f32> {
    let unit = f64::from(coordinate.next_up()) - f64::from(coordinate);
    let pixel = ratio * unit;
    // Within a hundredth of the coordinate, so that the unit stays what it is.
    let mut place = || f64::from(coordinate) * (1.0 + 0.01 * uniform01(rng));
    let (x, y) = (place(), place());
    let at =
        |column: f64, row: f64| -> Vec3 { vec3((x + column * pixel) as f32, (y + row * pixel) as f32, 0.3) };
    let here = at(0.0, 0.0);
    Footprint { position: here, dpdx: at(1.0, 0.0) - here, dpdy: at(0.0, 1.0) - here }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::seed;

    #[test]
    fn a_value_takes_its_places_and_no_other() {
        let found = replaced(0.0, 0o440);
        assert_eq!((found.dpdx.z, found.dpdy.z), (0.0, 0.0));
        assert_eq!((found.dpdx.x, found.position.z), (ORDINARY[3], ORDINARY[2]));
    }

    #[test]
    fn close_pixels_far_away_often_have_one_position() {
        let mut rng = seed::rng("claims.degenerate.far_quad", 0);
        let still = (0..10_000)
            .map(|_| far_quad(1.0e5, 0.5, &mut rng))
            .filter(|quad| quad.dpdx == Vec3::ZERO && quad.dpdy == Vec3::ZERO)
            .count();
        // A quarter, give or take six standard deviations.
        assert!((2240..2760).contains(&still), "{still}");
    }
}
