//! What is measured of scenes and pictures.
//!
//! | module | holds |
//! |---|---|
//! | [`study`] | all takes of a scene, frame by frame |
//! | [`metrics`], [`layers`], [`depth`], [`picture`] | numbers and pictures |
//! | [`motion`] | where surfaces were in the frame before |
//! | [`predict`] | what a plan will cost |
//! | [`expect`] | what must come out |
//! | [`survey`], [`auto`] | what a scene asks for, and effects chosen from it |

pub mod auto;
pub mod depth;
pub mod expect;
pub mod layers;
pub mod metrics;
pub mod motion;
pub mod picture;
pub mod predict;
pub mod study;
pub mod survey;
