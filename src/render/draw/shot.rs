//! The series of frames of a scene.

use super::view::Cause;
use crate::render::scene_file::load::Scene;
use crate::scene::Camera;

/// One series of frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shot {
    /// What moves the camera.
    pub cause: Cause,
    /// How far it is, as a multiple of what the scene says.
    pub distance: f64,
}

impl Shot {
    /// Returns the camera of a frame, with `side` x `side` pixels for each pixel of the scene.
    #[must_use]
    pub fn camera(&self, scene: &Scene, frame: u32, side: u32) -> Camera {
        let camera =
            scene.file.camera.camera(f64::from(frame), self.cause, self.distance, scene.file.resolution);
        // Motion is in pixels of the scene, however many places each of them has.
        Camera {
            direction_dx: camera.direction_dx / f64::from(side),
            direction_dy: camera.direction_dy / f64::from(side),
            resolution: camera.resolution.map(|pixels| pixels * side),
            ..camera
        }
    }
}

/// Returns the shots of a scene: as it is; with each of several causes of motion alone; from each other distance.
#[must_use]
pub fn shots(scene: &Scene) -> Vec<Shot> {
    let mut shots = vec![Shot { cause: Cause::All, distance: 1.0 }];
    let causes = scene.file.camera.motion.map(|motion| motion.causes()).unwrap_or_default();
    if causes.len() > 1 && scene.file.frames.get() > 1 {
        shots.extend(causes.into_iter().map(|cause| Shot { cause, distance: 1.0 }));
    }
    let factors = scene.file.distance.iter().flat_map(|distance| &distance.factors);
    shots.extend(factors.map(|&distance| Shot { cause: Cause::All, distance }));
    shots
}
