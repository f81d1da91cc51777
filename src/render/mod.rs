//! Scenes that simulate only the effects they call for: the file, the plan made of it, the run that carries the plan
//! out, and what is measured of the pictures.
//!
//! | module | holds |
//! |---|---|
//! | [`scene_file`] | the TOML form of a scene, checked, with all that it names |
//! | [`effect`] | one optional table an effect, and the list of all |
//! | [`draw`] | from a scene and a plan to pictures |
//! | [`measure`] | what is measured of them |
//! | [`gallery`] | the figures of the sources as scenes |
//!
//! What never lives here: a technique's mathematics, verdicts on thresholds, printing.

pub mod draw;
pub mod effect;
pub mod gallery;
pub mod measure;
pub mod scene_file;
