//! What the sources compare with or build upon the hashed threshold: one file a technique, pure functions over numbers.
//!
//! Each file cites its source, computes literally what that says, and tests the sentence that the source says of it.
//! Which effect of a scene shows a technique, and what it costs, is told in the file of that effect.
//!
//! What never lives here: scenes, pictures, files, statistics.

pub mod conservative;
pub mod foveated;
pub mod history;
pub mod jitter;
pub mod multisampling;
pub mod noise_scale;
pub mod occlusion;
pub mod premultiplied;
pub mod prior_work;
