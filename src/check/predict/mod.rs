//! Closed forms: what a sound hash would give, from the cells and the join that a subject claims to have.

pub mod flips;
pub mod nested;
pub mod pair_law;
pub mod redraw;
pub mod shared_cell;
pub mod slope;

pub(crate) use flips::flip_between;
pub(crate) use nested::same_by_kin;
pub(crate) use pair_law::PairLaw;
pub(crate) use redraw::{Changes, redraw_probability};
pub(crate) use slope::{largest_change, log_scale, octaves_between};
