//! From a scene and a plan to pictures.
//!
//! | module | holds |
//! |---|---|
//! | [`view`], [`shot`] | where the camera stands, and the series of frames of a scene |
//! | [`mesh`], [`rasterise`], [`fragments`] | triangles to fragments |
//! | [`texture`], [`adjust`] | what covers surfaces, and what is done to it before the first frame |
//! | [`plan`], [`cost`] | what is done to a frame, and what that costs |
//! | [`work`] | what one frame becomes, and one tile of it |
//! | [`frame`], [`reference`] | a frame by a plan, and as it should be |
//! | [`rays`] | rays, and what is in their way |
//! | [`temporal`] | pictures after each frame |

pub mod adjust;
pub mod cost;
pub mod fragments;
pub mod frame;
pub mod mesh;
pub mod plan;
mod plan_shader;
mod project;
pub mod rasterise;
pub mod rays;
pub mod reference;
mod resolve;
pub mod shot;
pub mod sub_pixel;
pub mod temporal;
pub mod texture;
pub mod view;
pub mod work;
