//! Scenes that simulate only the effects they call for: the file, the plan made of it, the run that carries the plan
//! out, and what is measured of the pictures.
//!
//! | module | holds |
//! |---|---|
//! | [`file`](mod@file) | the TOML form of a scene, checked |
//! | `limits`, `places`, `mistake` | bounds of its numbers, where its keys stand, what was likely meant |
//! | [`effects`], [`tables`] | one optional table an effect, and the list of all |
//! | [`view`], [`surface`], [`texture`] | who looks, what is seen, what covers it |
//! | [`procedural`], [`image_file`], [`gltf_file`] | where textures and meshes come from |
//! | [`prepare`] | a file with all that it names |
//! | [`mesh`], [`rasterise`], [`fragments`] | triangles to fragments |
//! | [`plan`], [`stage`], [`cost`] | effects to stages, what they need, what they cost |
//! | [`survey`], [`auto`] | what is measured of a scene, and effects chosen from it |
//! | [`adjust`], [`temporal`] | textures before the first frame, pictures after each |
//! | [`run`], [`truth`] | a frame by a plan, and as it should be |
//! | [`occlusion`] | rays, and what is in their way |
//! | [`sub_pixel`] | thresholds of what covers a part of its pixel |
//! | [`study`], [`metrics`], [`layers`], [`expect`] | all takes of a scene, what is measured, what must come out |
//! | [`depth`] | the depth buffer, and a smaller one made of it |
//! | [`picture`] | images side by side, differences, sequences |
//! | [`gallery`] | the figures of the sources as scenes |
//!
//! What never lives here: a technique's mathematics, verdicts on thresholds, printing.

pub mod adjust;
pub mod auto;
pub mod cost;
pub mod depth;
pub mod effects;
pub mod expect;
pub mod file;
pub mod fragments;
pub mod gallery;
pub mod gltf_file;
pub mod image_file;
pub mod layers;
mod limits;
pub mod mesh;
pub mod metrics;
mod mistake;
pub mod occlusion;
pub mod picture;
mod places;
pub mod plan;
mod plan_shader;
pub mod prepare;
pub mod procedural;
mod project;
pub mod rasterise;
mod resolve;
pub mod run;
pub mod stage;
pub mod study;
pub mod sub_pixel;
pub mod surface;
pub mod survey;
pub mod tables;
pub mod temporal;
pub mod texture;
pub mod truth;
pub mod view;
