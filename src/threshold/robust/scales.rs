//! From a footprint to the octaves along each axis, whatever the footprint.

use super::repairs::{Repair, Repairs};
use crate::threshold::footprint::Footprint;
use crate::threshold::hash::{Cell, octave_word};
use crate::threshold::real::{Real, length_of, power_of_two, square_of};
use crate::threshold::two_scale::Variant;

/// The octave and the place within it along each axis. Isotropic scales hold the same value three times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales<R: Real> {
    /// Object units per pixel.
    pub max_derivative: [R; 3],
    /// Cells per object unit before they are cut to octaves.
    pub pixel_scale: [R; 3],
    /// Octave of the coarse cells: 2^octave of them per object unit.
    pub octave: [i32; 3],
    /// Octave of the fine cells, one above.
    pub next_octave: [i32; 3],
    /// Where between the two the scale lies, in [0, 1).
    pub fraction: [R; 3],
}

/// No side of a cell is below this share of the largest coordinate: 2^-21, so that indices stay below 2^22 and an
/// `f32` position has three bits left within a cell.
const LEAST_SHARE_OF_COORDINATE: f64 = 1.0 / 2_097_152.0;

/// No side of a cell is below this share of its longest side: 2^-5, a power of two, so that a side at the limit
/// changes its octave together with the longest one.
const LEAST_SHARE_OF_LONGEST: f64 = 1.0 / 32.0;

/// The longest side of a cell stays between these, where neither it nor its inverse nor an index overflows.
pub(in crate::threshold) fn side_bounds<R: Real>() -> [R; 2] {
    let exponent = R::MAX_EXPONENT * 100 / 127;
    [-exponent, exponent].map(|exponent| R::from_f64(power_of_two(exponent)))
}

/// Finds the octaves of a footprint. `variant` is isotropic, or anisotropic; other variants count as isotropic.
#[inline(always)]
#[must_use]
pub fn robust_scales<R: Real>(
    variant: Variant,
    footprint: &Footprint<R>,
    hash_scale: R,
    repairs: Repairs,
) -> Scales<R> {
    let floors = repairs.contains(Repair::DerivativeFloor);
    let (dx, dy): ([R; 3], [R; 3]) = (footprint.dpdx.into(), footprint.dpdy.into());
    let anisotropic = variant == Variant::Anisotropic;
    let max_derivative = if anisotropic {
        let along = |axis: usize| Real::max(dx[axis].abs(), dy[axis].abs());
        [along(0), along(1), along(2)]
    } else {
        let plain = || Real::max(length_of(dx), length_of(dy));
        [if floors { longest_of_any_size(dx, dy) } else { plain() }; 3]
    };
    // Listing 2 shortens its sides by sqrt(1/2), so that a cell's diagonal in the screen plane counts.
    let numerator = R::from_f64(if anisotropic { 0.707 } else { 1.0 });
    let side = if floors {
        let [smallest, greatest] = side_bounds::<R>();
        // Zero times infinity cannot happen: neither factor is infinite.
        let hash_scale = Real::clamp(hash_scale, smallest, greatest);
        let [x, y, z] = max_derivative;
        let side = |derivative| hash_scale * Real::min(derivative, greatest);
        floored([side(x), side(y), side(z)], footprint.position.into(), [smallest, greatest])
    } else {
        max_derivative.map(|derivative| hash_scale * derivative)
    };
    let [x, y, z] = side;
    let pixel_scale = [numerator / x, numerator / y, numerator / z];
    let split = if repairs.contains(Repair::OneLog2) { by_exponent } else { by_logarithm };
    // One scale is split once.
    let [(x, next_x, fraction_x), (y, next_y, fraction_y), (z, next_z, fraction_z)] = if anisotropic {
        let [x, y, z] = pixel_scale;
        [split(x), split(y), split(z)]
    } else {
        [split(pixel_scale[0]); 3]
    };
    Scales {
        max_derivative,
        pixel_scale,
        octave: [x, y, z],
        next_octave: [next_x, next_y, next_z],
        fraction: [fraction_x, fraction_y, fraction_z],
    }
}

/// Cuts a scale to its octave, the next one and the fraction between them, as the listings do: by one logarithm.
fn by_logarithm<R: Real>(scale: R) -> (i32, i32, R) {
    let log = scale.log2();
    (log.floor().to_i32(), log.ceil().to_i32(), log.fract())
}

/// Cuts a scale to its octave, the next one and the fraction between them, in [0, 1): the octave out of the exponent,
/// the fraction out of the mantissa, so that the two cannot disagree.
///
/// The logarithm of a mantissa has all its digits after the point; that of a scale spends up to seven of them on the
/// octave, and the weight of the join would have an error of half its last digit. What is not a positive number has
/// no exponent and goes by the logarithm. Not in the paper.
#[inline(always)]
#[must_use]
pub fn by_exponent<R: Real>(scale: R) -> (i32, i32, R) {
    let smallest_normal = R::from_f64(power_of_two(1 - R::MAX_EXPONENT));
    if !(scale >= smallest_normal && scale.is_finite()) {
        return by_exponent_of_rare(scale);
    }
    let (octave, fraction) = scale.exponent_and_log2();
    (octave, octave + 1, below_one(fraction))
}

/// [`by_exponent`] of what is no normal number above 0.
#[cold]
#[inline(never)]
fn by_exponent_of_rare<R: Real>(scale: R) -> (i32, i32, R) {
    let wide = scale.to_f64();
    if !(wide > 0.0 && wide.is_finite()) {
        return by_logarithm(scale);
    }
    let (half_mantissa, exponent) = libm::frexp(wide);
    (exponent - 1, exponent, below_one(R::from_f64(2.0 * half_mantissa).log2()))
}

/// Returns a fraction in [0, 1], of which rounding may have made 1, in [0, 1).
#[inline(always)]
pub(in crate::threshold) fn below_one<R: Real>(fraction: R) -> R {
    if fraction < R::from_f64(1.0) { fraction } else { R::from_f64(1.0 - 1.0 / 16_777_216.0) }
}

/// Returns the cell of `position` in the grid with 2^octave cells per object unit along each axis.
///
/// With [`Repair::NestedPhase`] the cells of octave k begin 1/3 of a cell below whole numbers where k is even and 2/3
/// where it is odd; every boundary of one octave is then a boundary of the next one, up to one rounding of 1/3.
#[inline(always)]
#[must_use]
pub fn nested_cell<R: Real>(position: R::Vec3, octave: [i32; 3], repairs: Repairs) -> Cell<R> {
    let position: [R; 3] = position.into();
    let largest = largest_component(position);
    let of = |octave| Grid::of(octave, repairs.contains(Repair::NestedPhase), largest);
    let along_x = of(octave[0]);
    let [along_y, along_z] = if octave[0] == octave[1] && octave[0] == octave[2] {
        [along_x; 2]
    } else {
        [of(octave[1]), of(octave[2])]
    };
    let index = [along_x.index(position[0]), along_y.index(position[1]), along_z.index(position[2])];
    let word = if repairs.contains(Repair::OctaveWord) { octave_word(octave) } else { 0 };
    Cell { index: index.into(), octave: word }
}

/// The cells of one octave along an axis. A cell begins at 1/3 or 2/3 after a whole number, or at that number.
#[derive(Clone, Copy)]
struct Grid<R: Real> {
    cells_per_unit: R,
    /// A coordinate that lies less than this above its nearest whole number is in the cell before.
    low: R,
    /// One that lies so much above it is in the cell after.
    high: R,
    /// Whether every coordinate, counted in cells, is small enough for [`Real::nearest`].
    is_small: bool,
}

impl<R: Real> Grid<R> {
    #[inline(always)]
    fn of(octave: i32, is_nested: bool, largest: R) -> Self {
        let beyond = [-2.0, 2.0].map(R::from_f64);
        let [one, one_third, two_thirds] = [1.0, 1.0 / 3.0, 2.0 / 3.0].map(R::from_f64);
        let (low, high) = match (is_nested, octave & 1) {
            (false, _) => (R::from_f64(0.0), beyond[1]),
            (true, 0) => (two_thirds - one, beyond[1]),
            (true, _) => (beyond[0], one_third),
        };
        let cells_per_unit = R::from_f64(power_of_two(octave));
        Self { cells_per_unit, low, high, is_small: cells_per_unit * largest < R::SMALL }
    }

    #[inline(always)]
    fn index(self, coordinate: R) -> R {
        let scaled = self.cells_per_unit * coordinate;
        let [zero, one] = [0.0, 1.0].map(R::from_f64);
        let nearest = if self.is_small { scaled.nearest() } else { nearest_by_floor(scaled) };
        let above = scaled - nearest;
        let before = if above < self.low { one } else { zero };
        let after = if above >= self.high { one } else { zero };
        nearest - before + after
    }
}

/// Returns the integral value that is nearest to a number, the lower one of two.
#[cold]
#[inline(never)]
fn nearest_by_floor<R: Real>(x: R) -> R {
    let floor = x.floor();
    if x - floor > R::from_f64(0.5) { floor + R::from_f64(1.0) } else { floor }
}

/// Returns the one cell whose hash is looked at where a hash is on trial alone: that of the coarse octave of an isotropic
/// footprint of one pixel, between whole numbers, with its octave. Not in the paper.
#[must_use]
pub fn only_cell<R: Real>(footprint: &Footprint<R>) -> Cell<R> {
    let found = robust_scales(Variant::Isotropic, footprint, R::from_f64(1.0), Repairs::ALL);
    nested_cell::<R>(footprint.position, found.octave, Repairs::ALL.without(Repair::NestedPhase))
}

/// Returns the weight of Listing 2, in [0, 1]: how far a point of the box of octaves lies from its first corner, as a
/// share of the sum of its distances to both.
#[inline(always)]
#[must_use]
pub fn corner_weight<R: Real>(fraction: [R; 3]) -> R {
    let to_floor = length_of(fraction);
    let to_ceil = length_of(fraction.map(|f| R::from_f64(1.0) - f));
    to_floor / (to_floor + to_ceil)
}

/// Raises sides that are too small for the coordinates or for the longest side, and brings all into the bounds.
#[inline(always)]
pub(in crate::threshold) fn floored<R: Real>(
    side: [R; 3],
    position: [R; 3],
    [smallest, greatest]: [R; 2],
) -> [R; 3] {
    let coordinate = largest_component(position) * R::from_f64(LEAST_SHARE_OF_COORDINATE);
    let longest = Real::clamp(Real::max(largest_component(side), coordinate), smallest, greatest);
    let floor = Real::max(longest * R::from_f64(LEAST_SHARE_OF_LONGEST), Real::min(coordinate, greatest));
    let [x, y, z] = side;
    [Real::clamp(x, floor, longest), Real::clamp(y, floor, longest), Real::clamp(z, floor, longest)]
}

#[inline(always)]
fn largest_component<R: Real>([x, y, z]: [R; 3]) -> R {
    Real::max(Real::max(x.abs(), y.abs()), z.abs())
}

/// Returns the larger of two Euclidean lengths; scaled where a plain sum of squares under- or overflows.
#[inline(always)]
fn longest_of_any_size<R: Real>(one: [R; 3], other: [R; 3]) -> R {
    let [a, b] = [square_of(one), square_of(other)];
    let larger = Real::max(a, b);
    let [two, half] = [2.0, 0.5].map(R::from_f64);
    // Well within the squares of the bounds of `safe_length`, so that both ways agree where they meet.
    let least = two * power(LEAST_PLAIN) * power(LEAST_PLAIN);
    let most = half * power(MOST_PLAIN) * power(MOST_PLAIN);
    if larger > least && a < most && b < most {
        // The root of the larger square is the larger root: rounding keeps the order.
        larger.sqrt()
    } else {
        longest_by_scaling(one, other)
    }
}

#[cold]
#[inline(never)]
fn longest_by_scaling<R: Real>(one: [R; 3], other: [R; 3]) -> R {
    Real::max(safe_length(one), safe_length(other))
}

/// Returns the Euclidean length; scaled where the plain sum of squares under- or overflows.
fn safe_length<R: Real>(v: [R; 3]) -> R {
    let plain = square_of(v).sqrt();
    if plain > power(LEAST_PLAIN) && plain < power(MOST_PLAIN) {
        return plain;
    }
    let largest = largest_component(v);
    if largest == R::from_f64(0.0) || !largest.is_finite() {
        return largest;
    }
    largest * length_of(v.map(|c| c / largest))
}

/// Lengths between these powers of two are found without scaling: less than half the range of exponents, so that a square stays
/// within it.
const LEAST_PLAIN: i32 = -50;
const MOST_PLAIN: i32 = 60;

/// Two to a power that is given for the range of `f32`, and stretched to that of `R`, towards zero.
#[inline(always)]
fn power<R: Real>(of_f32: i32) -> R {
    R::from_f64(power_of_two(R::MAX_EXPONENT * of_f32 / 127))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_found_where_squares_are_out_of_range() {
        for size in [1.0e-30_f32, 1.0e-10, 1.0, 1.0e25] {
            let found = safe_length([3.0 * size, -4.0 * size, 0.0]);
            assert!((found / (5.0 * size) - 1.0).abs() < 1e-6, "{found:e}");
        }
        assert_eq!(safe_length([0.0_f64; 3]), 0.0);
        assert_eq!(safe_length([1.0, f64::INFINITY, 0.0]), f64::INFINITY);
    }
}
