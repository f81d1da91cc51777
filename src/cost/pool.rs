//! Footprints in many slices, so that inputs are fresh for the branch predictor and yet in the cache.

use crate::stats::seed;
use crate::threshold::batch::{ColumnBuffer, Columns};
use crate::threshold::footprint::Footprint;
use crate::threshold::real::Real;
use rand::RngExt;

/// How many footprints a slice has: their columns fit the second cache in either precision.
pub const SLICE: usize = 1 << 13;

/// Where footprints lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Positions are even in a cube about the origin with twice this side, in object units.
    pub extent: f64,
    /// Components of derivatives are even within two to the power of an even number in this range, in object units per
    /// pixel.
    pub log_derivative: [f64; 2],
}

/// Indices of cells up to 4e4, arguments of sines up to 7e5.
pub const WIDE: Range = Range { extent: 10.0, log_derivative: [-12.0, -4.0] };

/// Derivatives above one object unit: where the linear variant of §5.4 has two scales, as the others do.
pub const COARSE: Range = Range { extent: 2.0e4, log_derivative: [1.0, 5.0] };

/// Slices of [`SLICE`] footprints, each as structures and as columns.
pub struct Pool<R: Real> {
    footprints: Vec<Footprint<R>>,
    columns: ColumnBuffer<R>,
}

impl<R: Real> Pool<R> {
    /// Draws `slices` slices, always the same.
    #[must_use]
    pub fn new(range: Range, slices: usize) -> Self {
        let footprints: Vec<Footprint<R>> =
            draw(range, "cost.pool", slices * SLICE).iter().map(|footprint| footprint.cast()).collect();
        Self { columns: footprints.iter().copied().collect(), footprints }
    }

    /// Returns a slice as structures; numbers beyond the last begin anew.
    #[must_use]
    pub fn footprints(&self, slice: usize) -> &[Footprint<R>] {
        &self.footprints[self.range(slice)]
    }

    /// Returns a slice as columns; numbers beyond the last begin anew.
    #[must_use]
    pub fn columns(&self, slice: usize) -> Columns<'_, R> {
        self.columns.columns().slice(self.range(slice))
    }

    /// Reads a slice of structures.
    #[must_use]
    pub fn touch_footprints(&self, slice: usize) -> f64 {
        let read = |footprint: &Footprint<R>| {
            let [x, ..]: [R; 3] = footprint.position.into();
            x.to_f64()
        };
        self.footprints(slice).iter().map(read).sum()
    }

    /// Reads a slice of columns.
    #[must_use]
    pub fn touch_columns(&self, slice: usize) -> f64 {
        let columns = self.columns(slice);
        let all = [columns.position, columns.dpdx, columns.dpdy];
        all.iter().flatten().flat_map(|column| column.iter()).map(|x| x.to_f64()).sum()
    }

    fn range(&self, slice: usize) -> core::ops::Range<usize> {
        let slice = slice % (self.footprints.len() / SLICE);
        slice * SLICE..(slice + 1) * SLICE
    }
}

/// Draws `count` footprints that `f32` holds, by the name of the draw.
#[must_use]
pub fn draw(range: Range, name: &str, count: usize) -> Vec<Footprint<f64>> {
    let mut rng = seed::rng(name, 0);
    let [low, high] = range.log_derivative;
    let mut vector = |extent: f64| {
        let mut component = || rng.random_range(-extent..extent);
        glam::dvec3(component(), component(), component())
    };
    let mut scales = seed::rng(name, 1);
    (0..count)
        .map(|_| {
            let scale = libm::exp2(scales.random_range(low..high));
            let drawn: Footprint<f64> =
                Footprint { position: vector(range.extent), dpdx: vector(scale), dpdy: vector(scale) };
            drawn.cast::<f32>().cast()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_of_a_slice_hold_the_same_footprints() {
        let pool = Pool::<f32>::new(WIDE, 2);
        assert_ne!(pool.footprints(0), pool.footprints(1));
        for slice in 0..3 {
            let columns = pool.columns(slice);
            assert_eq!(columns.len(), SLICE);
            for (i, footprint) in pool.footprints(slice).iter().enumerate() {
                assert_eq!(columns.footprint(i), *footprint);
            }
        }
        assert_eq!(pool.footprints(2), pool.footprints(0));
    }
}
