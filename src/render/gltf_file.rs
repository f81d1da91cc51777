//! glTF files: triangles in world coordinates of their scene, and the alpha of their base colour.

use super::file::Channel;
use super::image_file::{self, ImageError};
use super::mesh::{Mesh, Triangle, Vertex};
use super::prepare::Cover;
use super::texture::{Filter, Level, Wrap};
use glam::{DMat4, DVec2, DVec3};
use gltf::image::Format;
use image::{DynamicImage, ImageBuffer};
use std::path::{Path, PathBuf};

/// A mesh file that cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// It is no glTF, a broken one, or misses a file that it names.
    #[error("cannot read {path} as glTF")]
    Read {
        /// The file.
        path: PathBuf,
        /// What the reader says.
        source: Box<gltf::Error>,
    },
    /// It has nothing to draw.
    #[error("{path}: {what}")]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        what: String,
    },
    /// Its texture cannot be used.
    #[error("{path}: its texture cannot be used")]
    Texture {
        /// The file.
        path: PathBuf,
        /// Why.
        source: ImageError,
    },
}

/// What a file holds.
#[derive(Debug)]
pub struct Found {
    vertices: Vec<Vertex>,
    /// Corners, and the index of the texture among `textures`.
    triangles: Vec<([u32; 3], u32)>,
    textures: Vec<Level>,
}

/// Reads every triangle of the file's scene, in units multiplied by `scale`; its own textures only if `textured`.
///
/// # Errors
///
/// [`MeshError`], which names the file.
pub fn read(path: &Path, scale: f64, textured: bool) -> Result<Found, MeshError> {
    let content = |what: String| MeshError::Content { path: path.into(), what };
    let fail = |source| MeshError::Read { path: path.into(), source: Box::new(source) };
    let gltf::Gltf { document, blob } = gltf::Gltf::open(path).map_err(fail)?;
    let folder = path.parent();
    let buffers = gltf::import_buffers(&document, folder, blob).map_err(fail)?;
    let images =
        if textured { gltf::import_images(&document, folder, &buffers).map_err(fail)? } else { Vec::new() };
    let mut found = Found { vertices: Vec::new(), triangles: Vec::new(), textures: Vec::new() };
    let mut of_image = std::collections::BTreeMap::new();
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let scene = scene.ok_or_else(|| content("it has no scene".to_owned()))?;
    let mut open: Vec<(gltf::Node<'_>, DMat4)> =
        scene.nodes().map(|node| (node, DMat4::from_scale(DVec3::splat(scale)))).collect();
    while let Some((node, parent)) = open.pop() {
        let local = node.transform().matrix().map(|column| column.map(f64::from));
        let to_object = parent * DMat4::from_cols_array_2d(&local);
        open.extend(node.children().map(|child| (child, to_object)));
        for primitive in node.mesh().iter().flat_map(gltf::Mesh::primitives) {
            if primitive.mode() != gltf::mesh::Mode::Triangles {
                continue;
            }
            let reader = primitive.reader(|buffer| buffers.get(buffer.index()).map(|data| &data.0[..]));
            let Some(positions) = reader.read_positions() else { continue };
            let mut texcoords = reader.read_tex_coords(0).map(gltf::mesh::util::ReadTexCoords::into_f32);
            let first = found.vertices.len() as u32;
            for position in positions {
                let part = DVec3::from(position.map(f64::from));
                let [u, v] = texcoords.as_mut().and_then(Iterator::next).unwrap_or([0.0; 2]);
                let texcoord = DVec2::new(f64::from(u), f64::from(v));
                let object = to_object.transform_point3(part);
                if !object.is_finite() || !texcoord.is_finite() {
                    return Err(content("a vertex is not a finite point".to_owned()));
                }
                found.vertices.push(Vertex { object, part, texcoord });
            }
            let count = found.vertices.len() as u32 - first;
            let corners: Vec<u32> = match reader.read_indices() {
                Some(indices) => indices.into_u32().collect(),
                None => (0..count).collect(),
            };
            let image = primitive
                .material()
                .pbr_metallic_roughness()
                .base_color_texture()
                .map(|info| info.texture().source().index());
            let texture = match of_image.get(&image) {
                Some(&known) => known,
                None => {
                    let new = found.textures.len() as u32;
                    found.textures.push(level(image.and_then(|index| images.get(index)), path)?);
                    of_image.insert(image, new);
                    new
                }
            };
            for corners in corners.chunks_exact(3) {
                if corners.iter().any(|&corner| corner >= count) {
                    return Err(content("a triangle names a vertex that is not there".to_owned()));
                }
                found.triangles.push(([0, 1, 2].map(|c| first + corners[c]), texture));
            }
        }
    }
    if found.triangles.is_empty() {
        return Err(content("it has no triangles".to_owned()));
    }
    Ok(found)
}

/// Adds what was found to a scene; `named` is the texture that covers all of it in place of its own.
pub fn append(found: Found, object: u32, named: Option<usize>, mesh: &mut Mesh, covers: &mut Vec<Cover>) {
    let (first, first_texture) = (mesh.vertices.len() as u32, covers.len());
    mesh.vertices.extend(found.vertices);
    for (corners, texture) in found.triangles {
        let texture = named.unwrap_or(first_texture + texture as usize) as u32;
        mesh.triangles.push(Triangle { corners: corners.map(|c| first + c), object, texture });
    }
    if named.is_none() {
        let cover = |finest| Cover { finest, wrap: Wrap::Repeat, filter: Filter::Trilinear };
        covers.extend(found.textures.into_iter().map(cover));
    }
}

/// The base colour with its alpha; opaque where the image has no alpha or where there is none.
fn level(image: Option<&gltf::image::Data>, path: &Path) -> Result<Level, MeshError> {
    let Some(data) = image else {
        return Ok(Level { size: [1, 1], alpha: vec![1.0], colour: Vec::new() });
    };
    let (width, height, bytes) = (data.width, data.height, data.pixels.clone());
    let decoded = match data.format {
        Format::R8 => ImageBuffer::from_raw(width, height, bytes).map(DynamicImage::ImageLuma8),
        Format::R8G8 => ImageBuffer::from_raw(width, height, bytes).map(DynamicImage::ImageLumaA8),
        Format::R8G8B8 => ImageBuffer::from_raw(width, height, bytes).map(DynamicImage::ImageRgb8),
        Format::R8G8B8A8 => ImageBuffer::from_raw(width, height, bytes).map(DynamicImage::ImageRgba8),
        wide => {
            let words: Vec<u16> =
                bytes.chunks_exact(2).map(|pair| u16::from_le_bytes([pair[0], pair[1]])).collect();
            match wide {
                Format::R16 => ImageBuffer::from_raw(width, height, words).map(DynamicImage::ImageLuma16),
                Format::R16G16 => ImageBuffer::from_raw(width, height, words).map(DynamicImage::ImageLumaA16),
                Format::R16G16B16 => {
                    ImageBuffer::from_raw(width, height, words).map(DynamicImage::ImageRgb16)
                }
                Format::R16G16B16A16 => {
                    ImageBuffer::from_raw(width, height, words).map(DynamicImage::ImageRgba16)
                }
                _ => None,
            }
        }
    };
    let what = || format!("its texture has a format that is not read here ({:?})", data.format);
    let decoded = decoded.ok_or_else(|| MeshError::Content { path: path.into(), what: what() })?;
    let opaque = DynamicImage::ImageRgba16(decoded.to_rgba16());
    image_file::level(&opaque, Channel::Alpha, path)
        .map_err(|source| MeshError::Texture { path: path.into(), source })
}
