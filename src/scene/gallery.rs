//! The built-in scenes.

use super::{Camera, Fragment, Rectangle};
use crate::threshold::footprint::Footprint;
use glam::{DVec2, DVec3, dvec2, dvec3};

/// A camera and what stands in front of it. Surfaces do not hide each other: each is seen as if alone, as alpha
/// tested layers are.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The name by which a user asks for it.
    pub name: &'static str,
    /// What it shows, in one line.
    pub description: &'static str,
    /// Whether the surfaces lie at no special angle to the object's axes.
    pub general_position: bool,
    /// Who looks.
    pub camera: Camera,
    /// What is seen, nearest first.
    pub surfaces: Vec<Rectangle>,
}

const RESOLUTION: [u32; 2] = [1024, 768];

impl Scene {
    /// Returns every built-in scene, in the order in which they are listed to users.
    #[must_use]
    pub fn all() -> Vec<Self> {
        vec![Self::wall(), oblique(), fence(), floor(), cards()]
    }

    /// Returns the wall: a plane of constant z, seen frontally.
    #[must_use]
    pub fn wall() -> Self {
        Self {
            name: "wall",
            description: "a wall of constant z, seen frontally",
            general_position: false,
            camera: Camera::look_at(dvec3(0.4, 0.3, 8.3), dvec3(0.4, 0.3, 0.0), DVec3::Y, 0.4, RESOLUTION),
            surfaces: vec![Rectangle {
                centre: dvec3(0.4, 0.3, 0.3),
                half_u: DVec3::X * 6.0,
                half_v: DVec3::Y * 6.0,
            }],
        }
    }

    /// Returns the footprints of all pixels with analytic derivatives: row by row, and at each pixel surface by
    /// surface.
    pub fn footprints(&self) -> impl Iterator<Item = Footprint<f64>> + '_ {
        self.pixels().flat_map(move |pixel| {
            self.surfaces.iter().filter_map(move |surface| surface.footprint(&self.camera, centre(pixel)))
        })
    }

    /// Returns the footprints of all pixels as a GPU finds them (see [`Rectangle::quad_footprint`]), in the order of
    /// [`Scene::footprints`].
    pub fn quad_footprints(&self) -> impl Iterator<Item = Footprint<f32>> + '_ {
        self.pixels().flat_map(move |pixel| {
            self.surfaces.iter().filter_map(move |surface| surface.quad_footprint(&self.camera, pixel))
        })
    }

    /// Returns the fragment of one surface at a point of the image (pixels from the upper left corner), in frame 0; `None`
    /// where that surface is not seen or does not exist.
    #[must_use]
    pub fn fragment(&self, surface: usize, pixel: DVec2) -> Option<Fragment> {
        let found = self.surfaces.get(surface)?.fragment(&self.camera, pixel)?;
        let ray = self.camera.ray(pixel);
        let nearer = self.surfaces[..surface].iter().filter(|nearer| nearer.hit(&ray).is_some()).count();
        Some(Fragment { layer: nearer as u32, ..found })
    }

    /// Returns the fragments of all pixels in the order of [`Scene::footprints`].
    pub fn fragments(&self) -> impl Iterator<Item = Fragment> + '_ {
        self.pixels().flat_map(move |pixel| self.fragments_at(pixel))
    }

    /// Returns the fragments of all pixels with footprints as a GPU finds them, in the order of
    /// [`Scene::quad_footprints`].
    pub fn quad_fragments(&self) -> impl Iterator<Item = Fragment> + '_ {
        self.pixels().flat_map(move |pixel| {
            self.surfaces.iter().enumerate().filter_map(move |(index, surface)| {
                let footprint = surface.quad_footprint(&self.camera, pixel)?.cast();
                Some(Fragment { footprint, ..self.fragment(index, centre(pixel))? })
            })
        })
    }

    fn fragments_at(&self, pixel: [u32; 2]) -> impl Iterator<Item = Fragment> + '_ {
        (0..self.surfaces.len()).filter_map(move |surface| self.fragment(surface, centre(pixel)))
    }

    /// Returns the scene seen with another number of pixels over the same field of view.
    ///
    /// # Panics
    ///
    /// If the resolution has a zero.
    #[must_use]
    pub fn with_resolution(mut self, [width, height]: [u32; 2]) -> Self {
        assert!(width > 0 && height > 0, "an image needs pixels");
        let pixel = f64::from(self.camera.resolution[1]) / f64::from(height);
        self.camera.direction_dx *= pixel;
        self.camera.direction_dy *= pixel;
        self.camera.resolution = [width, height];
        self
    }

    fn pixels(&self) -> impl Iterator<Item = [u32; 2]> + use<> {
        let [width, height] = self.camera.resolution;
        (0..height).flat_map(move |y| (0..width).map(move |x| [x, y]))
    }
}

/// The centre of a pixel.
fn centre([x, y]: [u32; 2]) -> DVec2 {
    dvec2(f64::from(x) + 0.5, f64::from(y) + 0.5)
}

/// A direction at no special angle to any axis; its components have no simple ratio.
fn askew() -> DVec3 {
    dvec3(0.412_7, 0.636_1, 0.652_3).normalize()
}

/// A square with the given normal, `half` object units from its middle to each side.
fn square(centre: DVec3, normal: DVec3, half: f64) -> Rectangle {
    let half_u = normal.cross(dvec3(0.231, -0.117, 0.966)).normalize() * half;
    Rectangle { centre, half_u, half_v: normal.cross(half_u).normalize() * half }
}

fn oblique() -> Scene {
    let centre = dvec3(0.7, -0.4, 0.9);
    let to_eye = (askew() + dvec3(0.9, -0.3, 0.5)).normalize();
    Scene {
        name: "oblique",
        description: "a plane in general position, tilted against the camera",
        general_position: true,
        camera: Camera::look_at(centre + to_eye * 7.0, centre, dvec3(0.2, 1.0, 0.1), 0.4, RESOLUTION),
        surfaces: vec![square(centre, askew(), 12.0)],
    }
}

fn fence() -> Scene {
    let centre = dvec3(-0.3, 0.6, 0.2);
    let panel = square(centre, askew(), 6.0);
    // Ten degrees above the plane, along one of its sides.
    let to_eye = panel.half_u.normalize() * libm::cos(0.1745) + askew() * libm::sin(0.1745);
    Scene {
        name: "fence",
        description: "a fence panel in general position, at a grazing angle",
        general_position: true,
        camera: Camera::look_at(centre + to_eye * 9.0, centre, askew(), 0.2, RESOLUTION),
        surfaces: vec![panel],
    }
}

fn floor() -> Scene {
    Scene {
        name: "floor",
        description: "a floor of constant y, seen by a walker",
        general_position: false,
        camera: Camera::look_at(dvec3(0.1, 1.6, 0.2), dvec3(2.3, 0.0, -6.1), DVec3::Y, 0.3, RESOLUTION),
        surfaces: vec![Rectangle {
            centre: dvec3(0.0, -0.1, 0.0),
            half_u: DVec3::X * 40.0,
            half_v: DVec3::Z * 40.0,
        }],
    }
}

fn cards() -> Scene {
    let card = |layer: u32| Rectangle {
        centre: dvec3(0.0, 0.0, -0.37 * f64::from(layer)),
        half_u: DVec3::X * 3.0,
        half_v: DVec3::Y * 3.0,
    };
    Scene {
        name: "cards",
        description: "eight parallel cards of constant z, one behind the other, seen from the side",
        general_position: false,
        camera: Camera::look_at(dvec3(2.1, 1.3, 5.2), dvec3(0.0, 0.0, -1.3), DVec3::Y, 0.4, RESOLUTION),
        surfaces: (0..8).map(card).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_is_seen_in_most_pixels_and_twice_alike() {
        for scene in Scene::all() {
            let small = scene.clone().with_resolution([64, 48]);
            let footprints: Vec<_> = small.footprints().collect();
            let wanted = 64 * 48 * small.surfaces.len() / 2;
            assert!(footprints.len() >= wanted, "{}: {} of {wanted}", scene.name, footprints.len());
            assert!(
                footprints.iter().all(|f| f.position.is_finite() && f.dpdx.is_finite() && f.dpdy.is_finite())
            );
            assert_eq!(footprints, small.footprints().collect::<Vec<_>>());
        }
    }

    #[test]
    fn the_fence_is_grazing() {
        let scene = fence();
        let middle = scene.surfaces[0].footprint(&scene.camera, scene.camera.size() / 2.0).unwrap();
        let ratio = middle.dpdx.length() / middle.dpdy.length();
        assert!(!(0.25..=4.0).contains(&ratio), "{ratio}");
    }

    #[test]
    fn axis_aligned_surfaces_do_not_move_along_their_normal() {
        for footprint in Scene::wall().with_resolution([8, 8]).footprints() {
            assert_eq!((footprint.dpdx.z, footprint.dpdy.z), (0.0, 0.0));
        }
        for footprint in floor().with_resolution([8, 8]).footprints() {
            assert!(footprint.dpdx.y.abs() < 1e-15 && footprint.dpdy.y.abs() < 1e-15);
        }
    }

    #[test]
    fn quads_agree_with_analytic_derivatives() {
        let scene = oblique();
        let quads = scene.quad_footprints().step_by(9973);
        for (quad, analytic) in quads.zip(scene.footprints().step_by(9973)) {
            assert!((quad.dpdx.as_dvec3() - analytic.dpdx).length() < 0.01 * analytic.dpdx.length());
            assert!((quad.dpdy.as_dvec3() - analytic.dpdy).length() < 0.01 * analytic.dpdy.length());
        }
    }

    #[test]
    fn layers_count_what_is_nearer_along_the_same_line_of_sight() {
        let scene = cards().with_resolution([64, 48]);
        let fragments: Vec<Fragment> = scene.fragments().collect();
        assert!(fragments.iter().map(|fragment| fragment.footprint).eq(scene.footprints()));
        for pair in fragments.windows(2).filter(|pair| pair[0].pixel == pair[1].pixel) {
            assert!(pair[0].eye.z < pair[1].eye.z && pair[0].layer + 1 == pair[1].layer);
        }
        assert!(fragments.iter().any(|fragment| fragment.layer == 7));
        assert!(scene.quad_fragments().map(|fragment| fragment.footprint.cast()).eq(scene.quad_footprints()));
    }
}
