//! What games do against vanishing geometry (§3), as functions of the levels of an alpha map.
//!
//! | module | remedy |
//! |---|---|
//! | [`level_threshold`] | a threshold for each level, from Eq. 1; for each texel, too |
//! | [`scaled_alpha`] | stored alphas scaled for each level or each texel (Castano 2010) |
//! | [`finest_level`] | always the finest level, or none beyond a limit |
//! | [`test_then_blend`] | alpha test first, alpha blending afterwards |
//! | [`supersampling`] | many tests a pixel in the full map |

pub mod finest_level;
pub mod level_threshold;
pub mod scaled_alpha;
pub mod supersampling;
pub mod test_then_blend;

/// One level of an alpha map: alphas in [0, 1], row after row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level<'a> {
    /// `width * height` alphas, row after row.
    pub texels: &'a [f32],
    /// Texels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
}

impl Level<'_> {
    /// Returns the share of texels that pass the alpha test, `a_i / A_i` of Eq. 1; 0 for a level without texels.
    #[must_use]
    pub fn passing_share(&self, threshold: f32) -> f64 {
        share(self.texels.iter().filter(|&&alpha| alpha >= threshold).count(), self.texels.len())
    }

    /// Returns the mean alpha: the coverage that a hashed test keeps in expectation (§4); 0 for a level without texels.
    #[must_use]
    pub fn mean(&self) -> f64 {
        let sum: f64 = self.texels.iter().copied().map(f64::from).sum();
        if self.texels.is_empty() { 0.0 } else { sum / self.texels.len() as f64 }
    }
}

fn share(part: usize, whole: usize) -> f64 {
    if whole == 0 { 0.0 } else { part as f64 / whole as f64 }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::threshold::hash::mm4::murmur3;
    use crate::threshold::hash::open_lattice;

    /// A square map and its side.
    pub(crate) struct Map {
        pub(crate) texels: Vec<f32>,
        pub(crate) side: usize,
    }

    impl Map {
        pub(crate) fn level(&self) -> Level<'_> {
            Level { texels: &self.texels, width: self.side, height: self.side }
        }

        /// The next coarser level by a box filter, as §2 says that mipmaps are made.
        pub(crate) fn coarser(&self) -> Self {
            let side = self.side / 2;
            let at = |x: usize, y: usize| self.texels[y * self.side + x];
            let texels = (0..side * side)
                .map(|i| {
                    let (x, y) = (2 * (i % side), 2 * (i / side));
                    0.25 * (at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1))
                })
                .collect();
            Self { texels, side }
        }

        pub(crate) fn chain(self) -> Vec<Self> {
            let mut levels = vec![self];
            while let Some(last) = levels.last().filter(|last| last.side > 1) {
                let next = last.coarser();
                levels.push(next);
            }
            levels
        }
    }

    /// Wires of one texel every eighth row and column: opaque on 23 % of the map.
    pub(crate) fn fence(side: usize) -> Map {
        let texels =
            (0..side * side).map(|i| f32::from(u8::from(i % side % 8 == 3 || i / side % 8 == 3))).collect();
        Map { texels, side }
    }

    /// Discs of random place and size, opaque on about a third of the map, like the maps of Fig. 2.
    pub(crate) fn leaves(side: usize) -> Map {
        let value = |leaf: u32, which: u32| open_lattice::<f32>(murmur3([leaf, which, 0, 0]));
        let discs: Vec<_> =
            (0..60).map(|leaf| (value(leaf, 0), value(leaf, 1), 0.02 + 0.05 * value(leaf, 2))).collect();
        let inside = |x: f32, y: f32| {
            discs.iter().any(|&(cx, cy, r)| (x - cx) * (x - cx) + (y - cy) * (y - cy) < r * r)
        };
        let place = |i: usize| (i as f32 + 0.5) / side as f32;
        let texels =
            (0..side * side).map(|i| f32::from(u8::from(inside(place(i % side), place(i / side))))).collect();
        Map { texels, side }
    }

    /// "A decreasing percentage of texels pass the alpha test in coarser mips" (§2), while the mean stays.
    #[test]
    fn fewer_texels_pass_in_coarser_levels_of_a_sparse_map() {
        for map in [fence(256), leaves(256)] {
            let chain = map.chain();
            let base = chain[0].level();
            let coarsest = chain[8].level();
            assert!(base.passing_share(0.5) > 0.2 && coarsest.passing_share(0.5) == 0.0);
            assert!((base.mean() - coarsest.mean()).abs() < 1e-5);
        }
        // A dense map gains instead: the sentence needs a mean alpha below the threshold.
        let mut dense = leaves(256);
        dense.texels.iter_mut().for_each(|alpha| *alpha = 1.0 - *alpha);
        assert_eq!(dense.chain()[8].level().passing_share(0.5), 1.0);
    }
}
