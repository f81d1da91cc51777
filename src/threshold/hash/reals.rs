//! What hashes made of sums and products of reals have in common: bits that depend on the precision, and on a device that lets
//! products into sums unrounded. None is in the paper.

/// Declares a unit struct that hashes the coordinates of a cell by a function of them and of what takes the fractional part.
macro_rules! real_hash {
    ($(#[$doc:meta])* $name:ident, $hash:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default)]
        pub struct $name;

        impl<R: $crate::threshold::real::Real> $crate::threshold::hash::cell::Hash<R> for $name {
            #[inline(always)]
            fn hash(&self, cell: &$crate::threshold::hash::cell::Cell<R>) -> R {
                $hash(R::fract, cell.index.into())
            }
        }

        impl $crate::threshold::hash::listed::OfBlocks for $name {
            #[inline(always)]
            fn block<R: $crate::threshold::batch::lane::Kernel, const FUSED: bool>(
                _: impl Fn(R) -> R + Copy,
                [x, y, z]: [&$crate::threshold::batch::block::Block<R>; 3],
                _: &$crate::threshold::batch::block::Block<u32>,
                out: &mut $crate::threshold::batch::block::Block<R>,
            ) {
                for i in 0..out.len() {
                    out[i] = $hash(R::lane_fract::<FUSED>, [x[i], y[i], z[i]]);
                }
            }
        }
    };
}

pub(super) use real_hash;
