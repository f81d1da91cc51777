//! Inputs of the claims, drawn by rule: fragments of surfaces, of cells, of patches, of motions.

pub(crate) mod block;
pub mod cell;
pub(crate) mod everywhere;
pub mod motion;
pub mod patch;
pub mod sample;
pub mod view;

pub(crate) use block::{BETWEEN, Block, cube};
pub(crate) use cell::{at_scale, draw_cell, draw_octave, in_cell, numerator, seen_in_cell};
pub(crate) use motion::Motion;
pub(crate) use patch::{Patch, Start, rotation};
pub(crate) use sample::{
    Sighting, UsedCells, fragments_everywhere, general_scenes, independent, more_independent, placed,
    placement, sighting,
};
pub(crate) use view::{tangents, tilted, turned, zoomed};
