//! Independent hashes out of one, by hashing at another place (§7.2.2, §9).

use super::{Cell, Hash};
use crate::threshold::real::Real;

/// Hashes `cell + offset` in place of `cell`: `hash(hashInput.xyz + offset[i])` of §7.2.2.
///
/// The paper asks for relatively large, uncorrelated offsets. An integral offset shifts the whole field of noise by
/// so many cells; a small fractional one leaves the sine hash correlated with itself.
#[derive(Clone, Copy, Debug)]
pub struct Offset<H, R: Real> {
    /// The hash that is asked.
    pub hash: H,
    /// What is added to the integral coordinates, in cells.
    pub offset: R::Vec3,
}

impl<R: Real, H: Hash<R>> Hash<R> for Offset<H, R> {
    fn hash(&self, cell: &Cell<R>) -> R {
        let [x, y, z] = cell.index.into();
        let [dx, dy, dz] = self.offset.into();
        self.hash.hash(&Cell { index: [x + dx, y + dy, z + dz].into(), octave: cell.octave })
    }
}

#[cfg(test)]
mod tests {
    use super::super::HashKind;
    use super::*;

    #[test]
    fn an_integral_offset_shifts_the_field() {
        let shifted = Offset { hash: HashKind::Mm4, offset: glam::vec3(10.0, -3.0, 0.0) };
        let here = Cell::<f32> { index: glam::vec3(1.0, 2.0, 3.0), octave: 0 };
        let there = Cell::<f32> { index: glam::vec3(11.0, -1.0, 3.0), octave: 0 };
        assert_eq!(shifted.hash(&here), HashKind::Mm4.hash(&there));
    }
}
