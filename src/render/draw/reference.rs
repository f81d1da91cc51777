//! The reference image: every fragment blended in the order of its distance, at many places of each pixel.

use super::cost::Cost;
use super::fragments::{Fragments, Needs, Space};
use super::rasterise::{Screen, TILE};
use super::shot::Shot;
use super::texture::{Texture, TextureNeeds};
use crate::render::effect::kind::Technique;
use crate::render::measure::picture::{LEAF, Picture, SKY};
use crate::render::scene_file::load::Scene;
use glam::DVec2;
use rayon::prelude::*;

/// Colour and coverage of a pixel.
type Seen = ([f32; 3], f32);

/// What the sources say of it.
pub const TECHNIQUE: Technique = Technique {
    name: "sorted-blend",
    source: "§4, Fig. 5",
    claim: "The ground truth to which many stochastic samples converge.",
    shown: ["samples-converge", "64 samples"],
};

/// Returns what the reference needs of textures.
#[must_use]
pub fn texture_needs() -> TextureNeeds {
    TextureNeeds { ideal: true, premultiplied: true, ..TextureNeeds::default() }
}

/// Draws a frame of a shot at `side` x `side` places a pixel; `textures` hold colours multiplied by alpha.
///
/// Each place has derivatives of its own, so that alpha comes from as fine a level as its distance to the next asks for.
#[must_use]
pub fn frame(scene: &Scene, textures: &[Texture], shot: &Shot, index: u32, side: u32) -> (Picture, Cost) {
    let camera = shot.camera(scene, index, side);
    let needs = Needs { texture_derivatives: true, ..Needs::default() };
    let screen = Screen::new(&scene.mesh, &camera, f64::from(index), DVec2::ZERO, Space::Object, needs);
    let tiles: Vec<(Vec<Seen>, Cost)> = (0..screen.tiles())
        .into_par_iter()
        .map_init(Fragments::default, |fragments, tile| {
            screen.fragments(tile, fragments);
            blend(scene, textures, &screen, fragments)
        })
        .collect();
    let mut picture = Picture::sky(camera.resolution);
    let mut cost = Cost { frames: 1, passes: 1, ..Cost::default() };
    for (tile, (pixels, counted)) in tiles.iter().enumerate() {
        cost += *counted;
        let ([left, top], [width, height]) = screen.tile(tile);
        for y in 0..height {
            for x in 0..width {
                let to = ((top + y) * camera.resolution[0] + left + x) as usize;
                (picture.colour[to], picture.coverage[to]) = pixels[(y * TILE + x) as usize];
            }
        }
    }
    (picture.downsample(side), cost)
}

fn blend(scene: &Scene, textures: &[Texture], screen: &Screen, fragments: &Fragments) -> (Vec<Seen>, Cost) {
    let mut order: Vec<usize> = (0..fragments.len()).collect();
    order.sort_by(|&a, &b| {
        let key = |at: usize| (fragments.pixel[at], fragments.depth[at]);
        let ((p, near), (q, far)) = (key(a), key(b));
        p.cmp(&q).then(near.total_cmp(&far)).then(a.cmp(&b))
    });
    let mut cost =
        Cost { fragments: fragments.len() as u64, blends: fragments.len() as u64, ..Cost::default() };
    // Colour so far, and what is still seen of what is behind.
    let mut pixels = vec![([0.0_f32; 3], 1.0_f32); (TILE * TILE) as usize];
    for at in order {
        let triangle = fragments.triangle[at];
        let texture = &textures[scene.mesh.triangles[triangle as usize].texture as usize];
        let access = texture.access(fragments.texcoord[at], fragments.dtdx[at], fragments.dtdy[at]);
        let [red, green, blue, tint] = fragments.tint(at);
        let of_texture = texture.alpha(&access, &mut cost.texels);
        let alpha = match texture.kept(&access, tint, &mut cost.texels) {
            Some(kept) => f32::from(u8::from(kept)),
            None => of_texture * tint,
        };
        // Stored colours are multiplied by the alpha of the texture.
        let share = if of_texture > 0.0 { alpha / of_texture } else { 0.0 };
        let multiplied =
            texture.colour(&access).map_or(LEAF.map(|c| c * alpha), |colour| colour.map(|c| c * share));
        let shade = screen.shade(triangle);
        let (colour, left) = &mut pixels[usize::from(fragments.pixel[at])];
        let tints = [red, green, blue];
        *colour = [0, 1, 2].map(|c| colour[c] + *left * multiplied[c] * tints[c] * shade);
        *left *= 1.0 - alpha;
    }
    let seen = |(colour, left): ([f32; 3], f32)| ([0, 1, 2].map(|c| colour[c] + left * SKY[c]), 1.0 - left);
    (pixels.into_iter().map(seen).collect(), cost)
}
