//! What a plan will cost, before anything is drawn.

use crate::render::draw::cost::{Census, Cost};
use crate::render::draw::fragments::{Fragments, Needs, Space};
use crate::render::draw::frame::frame;
use crate::render::draw::plan::Plan;
use crate::render::draw::rasterise::Screen;
use crate::render::draw::shot::{Shot, shots};
use crate::render::draw::texture::Texture;
use crate::render::scene_file::load::Scene;
use rayon::prelude::*;

/// Predicts what all shots of a scene cost by a plan, from the fragments that its geometry makes; nothing is shaded. Only
/// rays start where the alpha test lets a surface show: a plan with rays is drawn once without them. `progress` is told of
/// every frame.
pub fn predict(plan: &Plan, scene: &Scene, textures: &[Texture], progress: &mut dyn FnMut()) -> Cost {
    let pixels = scene.file.resolution.map(u64::from).iter().product();
    let tested = plan.before_rays();
    let mut cost = Cost::default();
    for shot in shots(scene) {
        for index in 0..scene.file.frames.get() {
            let (fragments, texels) = count(plan, scene, textures, &shot, index);
            let shown = tested.as_ref().map_or(0, |tested| {
                let drawn = frame(scene, textures, tested, &shot, index);
                drawn.picture.coverage.iter().filter(|&&share| share > 0.0).count() as u64
            });
            cost += plan.cost_of_frame(Census { fragments, texels, pixels, shown, ..Census::default() });
            progress();
        }
    }
    cost
}

/// Counts the fragments of a frame and the texels that they read.
fn count(plan: &Plan, scene: &Scene, textures: &[Texture], shot: &Shot, index: u32) -> (u64, u64) {
    let setup = &plan.setup;
    let Needs { texture_derivatives, coverage, samples, .. } = setup.needs;
    let needs = Needs { texture_derivatives, coverage, samples, ..Needs::default() };
    let camera = shot.camera(scene, index, setup.places);
    let screen =
        Screen::new(&scene.mesh, &camera, f64::from(index), setup.offset(index), Space::Object, needs);
    (0..screen.tiles())
        .into_par_iter()
        .map_init(Fragments::default, |fragments, tile| {
            screen.fragments(tile, fragments);
            let (corner, _) = screen.tile(tile);
            let texels: u64 = (0..fragments.len())
                .map(|at| {
                    let triangle = &scene.mesh.triangles[fragments.triangle[at] as usize];
                    let texture = &textures[triangle.texture as usize];
                    texture.texels(&setup.access(texture, fragments, corner, at))
                })
                .sum();
            (fragments.len() as u64, texels)
        })
        .reduce(|| (0, 0), |a, b| (a.0 + b.0, a.1 + b.1))
}
