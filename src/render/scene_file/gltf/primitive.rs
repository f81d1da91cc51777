//! Corners of a primitive of a glTF file: where they stand, what they read, and how they go together to triangles.

use super::accessor::{self, Numbers};
use super::material::stored;
use super::{Cover, Failed, File, NOT_DRAWN};
use crate::render::draw::mesh::Vertex;
use glam::{DMat3, DMat4, DVec2, DVec3, DVec4};
use gltf::Semantic;
use gltf::mesh::Mode;

/// Refuses an attribute that has not an element for each vertex.
fn check_count(what: &str, is: usize, vertices: usize) -> Result<(), Failed> {
    if is == vertices {
        return Ok(());
    }
    Err(format!("it has {is} {what} for {vertices} vertices").into())
}

impl File<'_> {
    /// Adds a primitive, once for each of `copies`; `weights` are those of its morph targets, and `joints`, where it hangs on a
    /// skin, take vertices to the object, turned inside out where the skin is mirrored.
    pub(super) fn read_primitive(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        weights: &[f32],
        joints: Option<&[DMat4]>,
        copies: &[DMat4],
        is_skin_mirrored: bool,
    ) -> Result<(), Failed> {
        let triangles: fn(&[u32]) -> Vec<[u32; 3]> = match primitive.mode() {
            Mode::Triangles => list,
            Mode::TriangleStrip => strip,
            Mode::TriangleFan => fan,
            Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => {
                self.tell(NOT_DRAWN.to_owned());
                return Ok(());
            }
        };
        let Some(positions) = primitive.get(&Semantic::Positions) else { return Ok(()) };
        self.limit(positions.count() as u64)?;
        let parts = self.positions(
            &accessor::read(&positions, self.buffers, "positions", &[3])?,
            primitive,
            weights,
        )?;
        let corners: Vec<u32> = match primitive.indices() {
            Some(indices) => {
                let read = accessor::read(&indices, self.buffers, "indices", &[1])?;
                read.iter().flatten().map(|&index| index as u32).collect()
            }
            None => (0..parts.len() as u32).collect(),
        };
        if corners.iter().any(|&corner| corner as usize >= parts.len()) {
            return Err("a triangle names a vertex that is not there".to_owned().into());
        }
        let triangles = triangles(&corners);
        self.limit((copies.len() as u64).saturating_mul(triangles.len().max(parts.len()) as u64))?;
        let cover = self.cover(&primitive.material())?;
        let texcoords = self.texcoords(primitive, &cover, parts.len())?;
        let tints = self.tints(primitive, &cover, parts.len())?;
        let skinned = joints.map(|joints| self.skinned(primitive, joints, parts.len())).transpose()?;
        for copy in copies {
            let first = self.found.vertices.len() as u32;
            for (at, &part) in parts.iter().enumerate() {
                let to_object = match &skinned {
                    Some(skinned) => skinned.get(at).copied().unwrap_or(DMat4::IDENTITY),
                    None => *copy,
                };
                let object = to_object.transform_point3(part);
                let texcoord = texcoords.get(at).copied().unwrap_or_default();
                let tint = tints.get(at).copied().unwrap_or(DVec4::ONE);
                if !(object.is_finite() && texcoord.is_finite() && tint.is_finite()) {
                    return Err("a vertex is not a finite point".to_owned().into());
                }
                self.found.vertices.push(Vertex { object, part, texcoord, tint });
            }
            // What is mirrored goes round the other way.
            let is_mirrored = is_skin_mirrored || DMat3::from_mat4(*copy).determinant() < 0.0;
            for &[a, b, c] in &triangles {
                let corners = if is_mirrored { [a, c, b] } else { [a, b, c] };
                self.found.triangles.push((corners.map(|c| first + c), cover.texture, cover.single_sided));
            }
        }
        Ok(())
    }

    /// Positions after morph targets, each added by its weight.
    fn positions(
        &self,
        base: &Numbers,
        primitive: &gltf::Primitive<'_>,
        weights: &[f32],
    ) -> Result<Vec<DVec3>, Failed> {
        let mut positions: Vec<DVec3> = base.iter().map(DVec3::from_slice).collect();
        for (target, &weight) in primitive.morph_targets().zip(weights).filter(|(_, weight)| **weight != 0.0)
        {
            let Some(moves) = target.positions() else { continue };
            let moves = accessor::read(&moves, self.buffers, "morphed positions", &[3])?;
            check_count("morphed positions", moves.len(), positions.len())?;
            for (position, by) in positions.iter_mut().zip(moves.iter()) {
                *position += f64::from(weight) * DVec3::from_slice(by);
            }
        }
        Ok(positions)
    }

    fn texcoords(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        cover: &Cover,
        vertices: usize,
    ) -> Result<Vec<DVec2>, Failed> {
        let Some(found) = primitive.get(&Semantic::TexCoords(cover.set)) else {
            if cover.has_image {
                let note = format!(
                    "a material reads TEXCOORD_{}, which its mesh has not: (0, 0) is read",
                    cover.set
                );
                self.tell(note);
            }
            return Ok(Vec::new());
        };
        let (matrix, shift) = cover.transform;
        let read = accessor::read(&found, self.buffers, "texture coordinates", &[2])?;
        check_count("texture coordinates", read.len(), vertices)?;
        Ok(read.iter().map(|pair| matrix * DVec2::from_slice(pair) + shift).collect())
    }

    fn tints(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        cover: &Cover,
        vertices: usize,
    ) -> Result<Vec<DVec4>, Failed> {
        let Some(found) = primitive.get(&Semantic::Colors(0)).filter(|_| cover.takes_colours) else {
            return Ok(Vec::new());
        };
        let read = accessor::read(&found, self.buffers, "vertex colours", &[3, 4])?;
        check_count("vertex colours", read.len(), vertices)?;
        let alpha = |colour: &[f64]| match colour.get(3) {
            Some(alpha) if !cover.is_opaque => alpha.clamp(0.0, 1.0),
            Some(_) | None => 1.0,
        };
        let tints: Vec<DVec4> =
            read.iter().map(|c| DVec4::new(stored(c[0]), stored(c[1]), stored(c[2]), alpha(c))).collect();
        // A tenth is more than what bytes round.
        if let Some(cutoff) = cover.cutoff
            && tints.iter().any(|tint| tint.w < 0.9)
        {
            self.tell(format!(
                "vertex colours change the alpha of a material that is tested at {cutoff}: the truth here is what the test keeps \
                 of their product, a hashed threshold shows the product"
            ));
        }
        Ok(tints)
    }

    /// Where each vertex is taken by its joints.
    fn skinned(
        &self,
        primitive: &gltf::Primitive<'_>,
        joints: &[DMat4],
        vertices: usize,
    ) -> Result<Vec<DMat4>, Failed> {
        let mut all: Vec<(DMat4, f64)> = Vec::new();
        for set in 0.. {
            let (Some(of), Some(weights)) =
                (primitive.get(&Semantic::Joints(set)), primitive.get(&Semantic::Weights(set)))
            else {
                break;
            };
            let of = accessor::read(&of, self.buffers, "joints", &[4])?;
            let weights = accessor::read(&weights, self.buffers, "weights of joints", &[4])?;
            check_count("joints", of.len(), vertices)?;
            check_count("weights of joints", weights.len(), vertices)?;
            all.resize(vertices, (DMat4::ZERO, 0.0));
            for ((sum, total), (of, weights)) in all.iter_mut().zip(of.iter().zip(weights.iter())) {
                for (&joint, &weight) in of.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
                    let missing = || format!("a vertex hangs on joint {joint}, which is not there");
                    *sum += weight * *joints.get(joint as usize).ok_or_else(missing)?;
                    *total += weight;
                }
            }
        }
        if all.is_empty() {
            return Err("a mesh with a skin has no joints or no weights".to_owned().into());
        }
        // Weights are stored in few bits, and their sum is 1 up to that.
        let mean = |(sum, total): (DMat4, f64)| if total > 0.0 { sum * (1.0 / total) } else { joints[0] };
        Ok(all.into_iter().map(mean).collect())
    }
}

fn list(corners: &[u32]) -> Vec<[u32; 3]> {
    corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect()
}

/// Every other triangle goes round the other way.
fn strip(corners: &[u32]) -> Vec<[u32; 3]> {
    let turned = |(at, c): (usize, &[u32])| if at % 2 == 0 { [c[0], c[1], c[2]] } else { [c[0], c[2], c[1]] };
    corners.windows(3).enumerate().map(turned).collect()
}

fn fan(corners: &[u32]) -> Vec<[u32; 3]> {
    let Some((first, rim)) = corners.split_first() else { return Vec::new() };
    rim.windows(2).map(|two| [two[0], two[1], *first]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_strips_and_fans_go_round_as_the_standard_says() {
        let corners = [7, 8, 9, 10, 11];
        assert_eq!(list(&corners), [[7, 8, 9]]);
        assert_eq!(strip(&corners), [[7, 8, 9], [8, 10, 9], [9, 10, 11]]);
        assert_eq!(fan(&corners), [[8, 9, 7], [9, 10, 7], [10, 11, 7]]);
        for too_short in [&[][..], &[1], &[1, 2]] {
            assert_eq!((strip(too_short), fan(too_short)), (vec![], vec![]));
        }
    }
}
