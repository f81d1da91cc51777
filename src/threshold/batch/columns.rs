//! Footprints as a structure of arrays.

use super::block::Block;
use crate::threshold::footprint::Footprint;
use crate::threshold::real::Real;

/// Footprints as nine columns of equal length, borrowed.
#[derive(Clone, Copy, Debug)]
pub struct Columns<'a, R> {
    /// Positions along each axis, in object units.
    pub position: [&'a [R]; 3],
    /// Their change to the next pixel on the right, in object units per pixel.
    pub dpdx: [&'a [R]; 3],
    /// Their change to the next pixel along screen y, in object units per pixel.
    pub dpdy: [&'a [R]; 3],
}

impl<R: Real> Columns<'_, R> {
    /// Returns the number of footprints.
    #[must_use]
    pub fn len(&self) -> usize {
        self.position[0].len()
    }

    /// Returns whether there is no footprint.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns one footprint.
    ///
    /// # Panics
    /// If there are not so many.
    #[must_use]
    pub fn footprint(&self, at: usize) -> Footprint<R> {
        let read = |columns: [&[R]; 3]| columns.map(|column| column[at]).into();
        Footprint { position: read(self.position), dpdx: read(self.dpdx), dpdy: read(self.dpdy) }
    }

    /// Returns a part of the footprints.
    ///
    /// # Panics
    /// If the range ends beyond them.
    #[must_use]
    pub fn slice(&self, range: core::ops::Range<usize>) -> Self {
        let cut = |columns: [_; 3]| columns.map(|column: &[R]| &column[range.clone()]);
        Self { position: cut(self.position), dpdx: cut(self.dpdx), dpdy: cut(self.dpdy) }
    }

    pub(super) fn is_as_long_as(&self, out: &[R]) -> bool {
        [self.position, self.dpdx, self.dpdy].iter().flatten().all(|column| column.len() == out.len())
    }
}

/// Footprints as nine columns, owned.
#[derive(Clone, Debug, Default)]
pub struct ColumnBuffer<R> {
    /// Positions along each axis, in object units.
    pub position: [Vec<R>; 3],
    /// Their change to the next pixel on the right, in object units per pixel.
    pub dpdx: [Vec<R>; 3],
    /// Their change to the next pixel along screen y, in object units per pixel.
    pub dpdy: [Vec<R>; 3],
}

impl<R: Real> ColumnBuffer<R> {
    /// Makes columns of `len` zeros.
    #[must_use]
    pub fn zeroed(len: usize) -> Self {
        let column = || [0; 3].map(|_| vec![R::from_f64(0.0); len]);
        Self { position: column(), dpdx: column(), dpdy: column() }
    }

    /// Borrows the columns.
    #[must_use]
    pub fn columns(&self) -> Columns<'_, R> {
        fn borrow<R>(columns: &[Vec<R>; 3]) -> [&[R]; 3] {
            columns.each_ref().map(Vec::as_slice)
        }
        Columns { position: borrow(&self.position), dpdx: borrow(&self.dpdx), dpdy: borrow(&self.dpdy) }
    }

    /// Overwrites one footprint.
    ///
    /// # Panics
    /// If there are not so many.
    pub fn set(&mut self, at: usize, footprint: &Footprint<R>) {
        let write = |columns: &mut [Vec<R>; 3], vector: R::Vec3| {
            let components: [R; 3] = vector.into();
            for (column, component) in columns.iter_mut().zip(components) {
                column[at] = component;
            }
        };
        write(&mut self.position, footprint.position);
        write(&mut self.dpdx, footprint.dpdx);
        write(&mut self.dpdy, footprint.dpdy);
    }
}

impl<R: Real> FromIterator<Footprint<R>> for ColumnBuffer<R> {
    fn from_iter<I: IntoIterator<Item = Footprint<R>>>(footprints: I) -> Self {
        let footprints = footprints.into_iter();
        let column = || [0; 3].map(|_| Vec::with_capacity(footprints.size_hint().0));
        let mut buffer = Self { position: column(), dpdx: column(), dpdy: column() };
        for footprint in footprints {
            for (columns, vector) in [
                (&mut buffer.position, footprint.position),
                (&mut buffer.dpdx, footprint.dpdx),
                (&mut buffer.dpdy, footprint.dpdy),
            ] {
                let components: [R; 3] = vector.into();
                columns.iter_mut().zip(components).for_each(|(column, component)| column.push(component));
            }
        }
        buffer
    }
}

/// One block of columns.
#[derive(Clone, Copy)]
pub(super) struct BlockColumns<'a, R> {
    pub position: [&'a Block<R>; 3],
    pub dpdx: [&'a Block<R>; 3],
    pub dpdy: [&'a Block<R>; 3],
}

impl<'a, R: Real> BlockColumns<'a, R> {
    /// Takes the block that begins at `first`. Where fewer are left, they are copied over the beginning of `tail`.
    #[inline(always)]
    pub fn at(columns: &Columns<'a, R>, first: usize, tail: &'a mut [[Block<R>; 3]; 3]) -> Self {
        #[inline(always)]
        fn take<'a, R: Real>(
            columns: [&'a [R]; 3],
            first: usize,
            tail: &'a mut [Block<R>; 3],
        ) -> [&'a Block<R>; 3] {
            let [x, y, z] = columns.map(|column| &column[first..]);
            if let (Some(x), Some(y), Some(z)) = (x.first_chunk(), y.first_chunk(), z.first_chunk()) {
                return [x, y, z];
            }
            for (tail, rest) in tail.iter_mut().zip([x, y, z]) {
                tail[..rest.len()].copy_from_slice(rest);
            }
            tail.each_ref()
        }
        let [position, dpdx, dpdy] = tail;
        Self {
            position: take(columns.position, first, position),
            dpdx: take(columns.dpdx, first, dpdx),
            dpdy: take(columns.dpdy, first, dpdy),
        }
    }
}
