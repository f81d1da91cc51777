//! Inputs of the claims, drawn by rule: fragments of surfaces, of cells, of patches, of motions.

pub mod cell;
pub mod motion;
pub mod patch;
pub mod sample;
pub mod view;
