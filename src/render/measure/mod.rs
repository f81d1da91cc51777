//! What is measured of scenes and pictures.
//!
//! | module | holds |
//! |---|---|
//! | [`study`] | all takes of a scene, frame by frame |
//! | [`metrics`], [`layers`], [`depth`], [`picture`] | numbers and pictures |
//! | [`predict`] | what a plan will cost |
//! | [`expect`] | what must come out |
//! | [`survey`], [`auto`] | what a scene asks for, and effects chosen from it |

pub mod auto;
pub mod depth;
pub mod expect;
pub mod layers;
pub mod metrics;
pub mod picture;
pub mod predict;
pub mod study;
pub mod survey;
