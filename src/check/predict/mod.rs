//! Closed forms: what a sound hash would give, from the cells and the join that a subject claims to have.

pub mod flips;
pub mod pair_law;
pub mod redraw;
pub mod shared_cell;
pub mod slope;
