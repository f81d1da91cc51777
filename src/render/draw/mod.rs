//! From a scene and a plan to pictures.
//!
//! | module | holds |
//! |---|---|
//! | [`view`], [`shot`] | where the camera stands, and the series of frames of a scene |
//! | [`mesh`], [`rasterise`], [`fragments`] | triangles to fragments |
//! | [`texture`], `level`, `sampler` | what covers surfaces, and how it is read |
//! | [`setup`], [`plan`], [`cost`] | how a frame is set up, what is done to it, and what that costs |
//! | [`work`] | what one frame becomes, and one tile of it |
//! | [`frame`], [`mod@reference`] | a frame by a plan, and as it should be |
//! | [`rays`] | rays, and what is in their way |
//! | `extent`, `hierarchy` | boxes, and boxes within boxes, for those rays |

pub mod cost;
mod extent;
pub mod fragments;
pub mod frame;
mod hierarchy;
mod level;
pub mod mesh;
pub mod plan;
mod project;
pub mod rasterise;
pub mod rays;
pub mod reference;
mod resolve;
mod sampler;
pub mod setup;
pub mod shot;
pub mod texture;
pub mod view;
pub mod work;
