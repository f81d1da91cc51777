//! Motions of camera and object, frame by frame.

use crate::scene::{Camera, Fragment, Rectangle, posed};
use glam::{DQuat, DVec3, dvec3};

/// Pixels by which a frame of motion moves the image: three cells or more at every lerp factor.
pub const MOTION_PIXELS: f64 = 3.0;

/// Radians by which a frame of motion turns an object or rolls a camera.
const TURN_A_FRAME: f64 = 0.02;

/// Radians per object unit of the wave that deforms an object and weighs its bones: a quarter of a period in a unit.
const WAVE: [f64; 3] = [1.3, 0.9, -0.7];

/// What moves: a column of the [table of the slides](crate::check::coordinates).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Motion {
    /// The camera moves sideways.
    CameraTranslation,
    /// The camera turns and rolls.
    CameraRotation,
    /// The object moves sideways.
    ObjectTranslation,
    /// The object turns.
    ObjectRotation,
    /// One of two bones turns, and each point follows it by a weight of its own.
    Skinning,
    /// A wave runs through the object.
    Deformation,
}

impl Motion {
    /// Every motion, in the order of the slides.
    pub const ALL: [Self; 6] = [
        Self::CameraTranslation,
        Self::CameraRotation,
        Self::ObjectTranslation,
        Self::ObjectRotation,
        Self::Skinning,
        Self::Deformation,
    ];

    /// The words by which reports name it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::CameraTranslation => "camera translation",
            Self::CameraRotation => "camera rotation",
            Self::ObjectTranslation => "object translation",
            Self::ObjectRotation => "object rotation",
            Self::Skinning => "object skinning",
            Self::Deformation => "object deformation",
        }
    }

    /// Returns the camera after `frames` frames of the motion.
    #[must_use]
    pub fn camera(self, camera: &Camera, surface: &Rectangle, frames: f64) -> Camera {
        match self {
            Self::CameraTranslation => {
                let by = sideways(camera, surface) * frames;
                Camera { eye: camera.eye - by, ..*camera }
            }
            Self::CameraRotation => {
                let yaw = camera.direction_dx.length() * MOTION_PIXELS * frames;
                let turn = DQuat::from_axis_angle(camera.direction_dy.normalize(), yaw)
                    * DQuat::from_axis_angle(camera.forward, TURN_A_FRAME * frames);
                Camera {
                    forward: turn * camera.forward,
                    direction_dx: turn * camera.direction_dx,
                    direction_dy: turn * camera.direction_dy,
                    ..*camera
                }
            }
            Self::ObjectTranslation | Self::ObjectRotation | Self::Skinning | Self::Deformation => *camera,
        }
    }

    /// Returns where a point of the object is in the world after `frames` frames of the motion; before it, object and
    /// world coordinates are the same.
    #[must_use]
    pub fn to_world(self, camera: &Camera, surface: &Rectangle, frames: f64, point: DVec3) -> DVec3 {
        let from_centre = point - surface.centre;
        let turned = || {
            let turn = DQuat::from_axis_angle(dvec3(0.48, -0.6, 0.64), TURN_A_FRAME * frames);
            turn * from_centre + surface.centre
        };
        let wave = || libm::sin(from_centre.dot(DVec3::from_array(WAVE)));
        match self {
            Self::CameraTranslation | Self::CameraRotation => point,
            Self::ObjectTranslation => point + sideways(camera, surface) * frames,
            Self::ObjectRotation => turned(),
            Self::Skinning => point.lerp(turned(), 0.5 + 0.5 * wave()),
            Self::Deformation => point + sideways(camera, surface) * (frames * wave()),
        }
    }

    /// Follows a point of a surface over `frames` frames; `None` where it goes out of sight.
    #[must_use]
    pub fn fragment(
        self,
        camera: &Camera,
        surface: &Rectangle,
        frames: f64,
        point: DVec3,
    ) -> Option<Fragment> {
        let to_world = |point| self.to_world(camera, surface, frames, point);
        posed::fragment(&self.camera(camera, surface, frames), surface, to_world, point)
    }
}

/// The way in the world that moves the middle of the surface by [`MOTION_PIXELS`] on the screen.
fn sideways(camera: &Camera, surface: &Rectangle) -> DVec3 {
    let depth = camera.to_eye(surface.centre).z;
    (camera.direction_dx * 0.8 + camera.direction_dy * 0.6) * (depth * MOTION_PIXELS)
}
