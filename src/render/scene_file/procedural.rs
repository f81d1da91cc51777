//! Alpha maps that need no file: leaves, wires, hair, checkerboards, ramps.

use crate::render::draw::texture::Level;
use glam::{DVec2, dvec2};
use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use serde::Deserialize;

/// A cluster of leaves on a transparent ground.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Leaves {
    /// Number of leaves.
    #[serde(default = "leaf_count")]
    pub count: u32,
    /// Length of a leaf, in shares of the texture.
    #[serde(default = "leaf_length")]
    pub length: f64,
}

/// Crossing diagonal wires, as in a chain-link fence; repeats without a seam.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wire {
    /// Thickness of a wire, in shares of the distance between two.
    pub thickness: f64,
    /// Meshes across the texture.
    #[serde(default = "one")]
    pub meshes: u32,
}

/// Strands of hair from the upper to the lower edge, some of which end early.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hair {
    /// Number of strands.
    pub strands: u32,
    /// Thickness of a strand, in shares of the texture.
    pub thickness: f64,
}

/// A checkerboard of transparent and opaque squares; repeats without a seam.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Checkerboard {
    /// Squares along each side, even.
    pub squares: u32,
}

/// The same alpha everywhere.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Constant {
    /// That alpha, in [0, 1].
    pub alpha: f64,
    /// The colour, in [0, 1].
    #[serde(default = "veil")]
    pub colour: [f64; 3],
}

fn veil() -> [f64; 3] {
    [0.2, 0.3, 0.5]
}

/// Alpha that rises evenly from 0 at the left edge to 1 at the right.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ramp {}

fn leaf_count() -> u32 {
    14
}

fn leaf_length() -> f64 {
    0.36
}

fn one() -> u32 {
    1
}

/// Samples along each side of a texel.
const SAMPLES: u32 = 4;

/// Draws a level: `inside` tells which colour is seen at a point of the unit square, if any; where none is, the texel has
/// the colour `ground`, as an artist would have painted it.
fn draw(size: u32, opaque: f64, ground: [f64; 3], inside: impl Fn(DVec2) -> Option<[f64; 3]>) -> Level {
    let mut level = Level { size: [size, size], alpha: Vec::new(), colour: Vec::new() };
    for y in 0..size {
        for x in 0..size {
            let (mut hits, mut colour) = (0.0, [0.0; 3]);
            for j in 0..SAMPLES {
                for i in 0..SAMPLES {
                    let offset = dvec2(f64::from(i), f64::from(j)) + 0.5;
                    let point =
                        (dvec2(f64::from(x), f64::from(y)) + offset / f64::from(SAMPLES)) / f64::from(size);
                    if let Some(seen) = inside(point) {
                        hits += 1.0;
                        colour = [0, 1, 2].map(|c| colour[c] + seen[c]);
                    }
                }
            }
            let share = hits / f64::from(SAMPLES * SAMPLES);
            level.alpha.push((share * opaque) as f32);
            let colour = if hits > 0.0 { colour.map(|sum| sum / hits) } else { ground };
            level.colour.push(colour.map(|c| (c.clamp(0.0, 1.0) * 65535.0).round() as u16));
        }
    }
    level
}

impl Leaves {
    /// Draws the leaves; `opaque` is the alpha inside them.
    #[must_use]
    pub fn draw(&self, size: u32, opaque: f64, seed: u64) -> Level {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed ^ 0x1eaf);
        // Middle, half axis along, half axis across, brightness.
        let leaves: Vec<(DVec2, DVec2, DVec2, f64)> = (0..self.count)
            .map(|_| {
                let turn = rng.random::<f64>() * core::f64::consts::TAU;
                let length = self.length * (0.6 + 0.4 * rng.random::<f64>());
                let along = dvec2(libm::cos(turn), libm::sin(turn)) * length * 0.5;
                let room = 1.0 - length;
                let centre = dvec2(rng.random::<f64>(), rng.random::<f64>()) * room + length * 0.5;
                (centre, along, along.perp() * 0.38, 0.7 + 0.3 * rng.random::<f64>())
            })
            .collect();
        draw(size, opaque, [0.85, 0.8, 0.62], |point| {
            leaves.iter().rev().find_map(|&(centre, along, across, light)| {
                let from = point - centre;
                let u = from.dot(along) / along.length_squared();
                let v = from.dot(across) / across.length_squared();
                // Pointed at both ends.
                let inside = u.abs() < 1.0 && v.abs() < 1.0 - u * u;
                inside.then(|| [0.16, 0.42, 0.1].map(|c| c * light * if v.abs() < 0.06 { 1.35 } else { 1.0 }))
            })
        })
    }
}

impl Wire {
    /// Draws the wires; `opaque` is the alpha inside them.
    #[must_use]
    pub fn draw(&self, size: u32, opaque: f64) -> Level {
        let half = self.thickness * 0.5;
        draw(size, opaque, [0.9, 0.9, 0.9], |point| {
            let distance = |along: f64| {
                let place = along * f64::from(self.meshes);
                (place - place.round()).abs()
            };
            let near = distance(point.x + point.y).min(distance(point.x - point.y));
            (near < half).then(|| [0.3, 0.32, 0.34].map(|c| c * (1.2 - 0.5 * near / half)))
        })
    }
}

impl Hair {
    /// Draws the strands; `opaque` is the alpha inside them.
    #[must_use]
    pub fn draw(&self, size: u32, opaque: f64, seed: u64) -> Level {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed ^ 0xba17);
        let strands: Vec<[f64; 4]> = (0..self.strands)
            .map(|_| [rng.random(), rng.random(), 0.55 + 0.45 * rng.random::<f64>(), rng.random()])
            .collect();
        draw(size, opaque, [0.8, 0.65, 0.5], |point| {
            strands.iter().find_map(|&[place, wave, length, light]| {
                let bend = 0.02 * libm::sin(6.0 * point.y + 20.0 * wave);
                let half = 0.5 * self.thickness * (1.0 - point.y / length).max(0.0).sqrt();
                let near = (point.x - (0.05 + 0.9 * place + bend)).abs();
                (near < half).then(|| [0.24, 0.15, 0.08].map(|c| c * (0.7 + 0.6 * light)))
            })
        })
    }
}

impl Checkerboard {
    /// Draws the board; `opaque` is the alpha of the opaque squares.
    #[must_use]
    pub fn draw(&self, size: u32, opaque: f64) -> Level {
        draw(size, opaque, [0.1; 3], |point| {
            let [x, y] = [point.x, point.y].map(|c| (c * f64::from(self.squares)).floor() as i64);
            ((x + y).rem_euclid(2) == 0).then_some([0.1; 3])
        })
    }
}

impl Constant {
    /// Draws the one value.
    #[must_use]
    pub fn draw(&self, size: u32) -> Level {
        draw(size, self.alpha, self.colour, |_| Some(self.colour))
    }
}

impl Ramp {
    /// Draws the ramp; `opaque` is the alpha at the right edge.
    #[must_use]
    pub fn draw(&self, size: u32, opaque: f64) -> Level {
        let flat = Constant { alpha: opaque, colour: veil() }.draw(size);
        let share = |at: usize| (at as u32 % size) as f32 + 0.5;
        let alpha =
            flat.alpha.iter().enumerate().map(|(at, alpha)| alpha * share(at) / size as f32).collect();
        Level { alpha, ..flat }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_cover_what_they_say() {
        let wire = Wire { thickness: 0.2, meshes: 2 }.draw(64, 1.0);
        // Two families of wires that cover a fifth each.
        assert!((wire.alphas().mean() - 0.36).abs() < 0.02, "{}", wire.alphas().mean());
        assert_eq!(Checkerboard { squares: 8 }.draw(64, 1.0).alphas().mean(), 0.5);
        assert!((Constant { alpha: 0.3, colour: veil() }.draw(4).alphas().mean() - 0.3).abs() < 1e-7);
        let ramp = Ramp {}.draw(16, 0.8);
        assert!((ramp.alphas().mean() - 0.4).abs() < 1e-6 && ramp.alpha[0] < 0.03 && ramp.alpha[31] > 0.77);
        let leaves = Leaves { count: 14, length: 0.36 }.draw(64, 1.0, 0);
        assert!((0.2..0.5).contains(&leaves.alphas().mean()), "{}", leaves.alphas().mean());
        let hair = Hair { strands: 24, thickness: 0.02 }.draw(64, 1.0, 0);
        assert!((0.1..0.4).contains(&hair.alphas().mean()), "{}", hair.alphas().mean());
    }
}
