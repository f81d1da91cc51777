//! Where the camera stands in a frame.

use crate::scene::Camera;
use glam::{DQuat, DVec2, DVec3};
use serde::Deserialize;

/// The camera of a scene file.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct View {
    /// The pinhole, in object units.
    pub eye: [f64; 3],
    /// The point that is seen in the middle of the image, in object units.
    pub target: [f64; 3],
    /// The direction that is upwards in the image.
    #[serde(default = "upwards")]
    pub up: [f64; 3],
    /// Half the height of the image at distance one.
    #[serde(default = "half_height")]
    pub half_height: f64,
    /// How it moves; it stands still without.
    pub motion: Option<CameraMotion>,
}

/// CameraMotion of the camera from frame to frame.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraMotion {
    /// Shift of the image to the right and down, in pixels per frame at the distance of the target.
    pub translate: Option<[f64; 2]>,
    /// Factor by which the target is enlarged, per frame.
    pub zoom: Option<f64>,
    /// Roll about the line of sight, in degrees per frame.
    pub rotate: Option<f64>,
}

fn upwards() -> [f64; 3] {
    [0.0, 1.0, 0.0]
}

fn half_height() -> f64 {
    0.4
}

/// What moves the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// All that the scene has.
    All,
    /// The shift alone.
    Translate,
    /// The zoom alone.
    Zoom,
    /// The roll alone.
    Rotate,
}

impl CameraMotion {
    /// Returns the motions that it has, each alone.
    #[must_use]
    pub fn causes(&self) -> Vec<Cause> {
        let all = [
            (Cause::Translate, self.translate.is_some()),
            (Cause::Zoom, self.zoom.is_some()),
            (Cause::Rotate, self.rotate.is_some()),
        ];
        all.into_iter().filter(|&(_, present)| present).map(|(cause, _)| cause).collect()
    }
}

impl Cause {
    /// The name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::Translate => "translate",
            Self::Zoom => "zoom",
            Self::Rotate => "rotate",
        }
    }
}

impl View {
    /// Returns the camera of a frame that is moved by one cause only, `distance` times as far from the target as the
    /// scene says.
    #[must_use]
    pub fn camera(&self, frame: f64, cause: Cause, distance: f64, resolution: [u32; 2]) -> Camera {
        let [eye, target, up] = [self.eye, self.target, self.up].map(DVec3::from);
        let motion = self.motion.unwrap_or(CameraMotion { translate: None, zoom: None, rotate: None });
        let moved = |by: Cause| cause == Cause::All || cause == by;
        let zoom = motion.zoom.filter(|_| moved(Cause::Zoom)).unwrap_or(1.0);
        let roll = motion.rotate.filter(|_| moved(Cause::Rotate)).unwrap_or(0.0).to_radians() * frame;
        let eye = target + (eye - target) * (distance * libm::pow(zoom, -frame));
        let forward = (target - eye).normalize();
        let up = DQuat::from_axis_angle(forward, roll) * up;
        let camera = Camera::look_at(eye, target, up, self.half_height, resolution);
        let [x, y] = motion.translate.filter(|_| moved(Cause::Translate)).unwrap_or([0.0; 2]);
        let shift = DVec2::new(x, y) * (frame * (target - eye).length());
        // The image moves against the camera.
        Camera { eye: camera.eye - camera.direction_dx * shift.x - camera.direction_dy * shift.y, ..camera }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    fn view(motion: CameraMotion) -> View {
        View {
            eye: [1.0, 2.0, 5.0],
            target: [0.0, 0.5, 0.0],
            up: upwards(),
            half_height: 0.4,
            motion: Some(motion),
        }
    }

    #[test]
    fn each_cause_moves_the_image_as_it_says() {
        let motion = CameraMotion { translate: Some([0.5, -0.25]), zoom: Some(1.1), rotate: Some(2.0) };
        let seen =
            |cause, point: DVec3| view(motion).camera(3.0, cause, 1.0, [200, 100]).project(point).unwrap();
        let middle = dvec3_target();
        assert!((seen(Cause::Translate, middle) - dvec2(101.5, 49.25)).length() < 1e-9);
        assert!((seen(Cause::Zoom, middle) - dvec2(100.0, 50.0)).length() < 1e-9);
        let still = View { motion: None, ..view(motion) }.camera(3.0, Cause::All, 1.0, [200, 100]);
        let beside = middle + still.direction_dx.normalize();
        let before = still.project(beside).unwrap() - dvec2(100.0, 50.0);
        let zoomed = seen(Cause::Zoom, beside) - dvec2(100.0, 50.0);
        assert!((zoomed.length() / before.length() - 1.331).abs() < 1e-9);
        let rolled = seen(Cause::Rotate, beside) - dvec2(100.0, 50.0);
        assert!((rolled.angle_to(before).to_degrees().abs() - 6.0).abs() < 1e-9);
    }

    fn dvec3_target() -> DVec3 {
        DVec3::new(0.0, 0.5, 0.0)
    }
}
