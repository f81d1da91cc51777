//! glTF files: triangles in world coordinates of their scene, and the alpha of their base colour.

use super::image::{Channel, ImageError, level as level_of};
use super::limits::MOST_TRIANGLES;
use crate::render::draw::mesh::{Mesh, Triangle, Vertex};
use crate::render::draw::texture::{Filter, Level, TextureSource, Wrap};
use glam::{DMat4, DVec2, DVec3};
use gltf::accessor::sparse;
use gltf::image::Format;
use gltf::{Semantic, buffer};
use image::{DynamicImage, ImageBuffer};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// A mesh file that cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// It is no glTF, or a broken one.
    #[error("cannot read {path} as glTF")]
    Read {
        /// The file.
        path: PathBuf,
        /// What the reader says.
        source: Box<gltf::Error>,
    },
    /// A buffer or an image that it names cannot be read.
    #[error("{path} names {part}, which cannot be read")]
    Part {
        /// The file.
        path: PathBuf,
        /// The file that it names, or what stands in its place.
        part: String,
        /// What the reader says.
        source: Box<gltf::Error>,
    },
    /// It has nothing to draw, or it is not what it says.
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
    let gltf::Gltf { document, mut blob } = gltf::Gltf::open(path).map_err(fail)?;
    let folder = path.parent();
    let part = |part: String, source| MeshError::Part { path: path.into(), part, source: Box::new(source) };
    let mut buffers = Vec::new();
    for buffer in document.buffers() {
        let name = match buffer.source() {
            buffer::Source::Uri(uri) => named("buffer", buffer.index(), uri),
            buffer::Source::Bin => format!("buffer {}", buffer.index()),
        };
        let data = buffer::Data::from_source_and_blob(buffer.source(), folder, &mut blob)
            .map_err(|source| part(name.clone(), source))?;
        if data.len() < buffer.length() {
            let (is, says) = (data.len(), buffer.length());
            return Err(content(format!("{name} has {is} bytes in place of {says}")));
        }
        buffers.push(data);
    }
    lengths(&document, &buffers).map_err(content)?;
    let mut images = Vec::new();
    for image in document.images().filter(|_| textured) {
        let name = match image.source() {
            gltf::image::Source::Uri { uri, .. } => named("image", image.index(), uri),
            gltf::image::Source::View { .. } => format!("image {}", image.index()),
        };
        let data = gltf::image::Data::from_source(image.source(), folder, &buffers);
        images.push(data.map_err(|source| part(name, source))?);
    }
    let mut found = Found { vertices: Vec::new(), triangles: Vec::new(), textures: Vec::new() };
    let mut of_image = std::collections::BTreeMap::new();
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let scene = scene.ok_or_else(|| content("it has no scene".to_owned()))?;
    let mut open: Vec<(gltf::Node<'_>, DMat4)> =
        scene.nodes().map(|node| (node, DMat4::from_scale(DVec3::splat(scale)))).collect();
    let mut seen = BTreeSet::new();
    while let Some((node, parent)) = open.pop() {
        if !seen.insert(node.index()) {
            let name = node.name().map_or_else(String::new, |name| format!(" ({name})"));
            let what = "is reached twice, from itself or from two others: nodes must be a tree";
            return Err(content(format!("node {}{name} {what}", node.index())));
        }
        let local = node.transform().matrix().map(|column| column.map(f64::from));
        let to_object = parent * DMat4::from_cols_array_2d(&local);
        open.extend(node.children().map(|child| (child, to_object)));
        for primitive in node.mesh().iter().flat_map(gltf::Mesh::primitives) {
            if primitive.mode() != gltf::mesh::Mode::Triangles {
                continue;
            }
            kinds(&primitive).map_err(content)?;
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
            if found.triangles.len().max(found.vertices.len()) as u64 > MOST_TRIANGLES {
                return Err(content(format!("it has more than {MOST_TRIANGLES} triangles or vertices")));
            }
        }
    }
    if found.triangles.is_empty() {
        return Err(content("it has no triangles".to_owned()));
    }
    Ok(found)
}

/// A buffer or an image by the file that its address names.
fn named(what: &str, index: usize, uri: &str) -> String {
    if uri.starts_with("data:") { format!("{what} {index}") } else { format!("{what} {index}, {uri}") }
}

/// Finds what is longer than where it lies: the reader stops at the end without a word, or panics.
fn lengths(document: &gltf::Document, buffers: &[buffer::Data]) -> Result<(), String> {
    for view in document.views() {
        let end = view.offset().checked_add(view.length());
        let length = buffers.get(view.buffer().index()).map_or(0, |data| data.len());
        if end.is_none_or(|end| end > length) {
            return Err(format!("buffer view {} ends beyond its buffer of {length} bytes", view.index()));
        }
    }
    let fits = |count: usize, offset: usize, size: usize, view: &buffer::View<'_>| {
        let stride = view.stride().unwrap_or(size);
        let last = count.saturating_sub(1).checked_mul(stride);
        last.and_then(|last| last.checked_add(offset)?.checked_add(size))
            .is_some_and(|end| end <= view.length())
    };
    for accessor in document.accessors() {
        let (index, count) = (accessor.index(), accessor.count());
        if count as u64 > 3 * MOST_TRIANGLES {
            return Err(format!("accessor {index} has {count} elements, too many"));
        }
        let size = accessor.size();
        let own = accessor.view().is_none_or(|view| fits(count, accessor.offset(), size, &view));
        let sparse = accessor.sparse().is_none_or(|sparse| {
            let (indices, values) = (sparse.indices(), sparse.values());
            let width = match indices.index_type() {
                sparse::IndexType::U8 => 1,
                sparse::IndexType::U16 => 2,
                sparse::IndexType::U32 => 4,
            };
            let count = sparse.count();
            fits(count, indices.offset(), width, &indices.view())
                && fits(count, values.offset(), size, &values.view())
        });
        if !(own && sparse) {
            return Err(format!("accessor {index} has {count} elements, more than its buffer view holds"));
        }
    }
    Ok(())
}

/// Finds numbers of a kind that the reader does not expect.
fn kinds(primitive: &gltf::Primitive<'_>) -> Result<(), String> {
    use gltf::accessor::{DataType, Dimensions};
    let is =
        |what: &str, accessor: Option<gltf::Accessor<'_>>, of: Dimensions, types: &[DataType]| match accessor
        {
            Some(found) if found.dimensions() != of || !types.contains(&found.data_type()) => {
                Err(format!("accessor {} is of the wrong type for {what}", found.index()))
            }
            _ => Ok(()),
        };
    let (bytes, words) = (DataType::U8, DataType::U16);
    is("positions", primitive.get(&Semantic::Positions), Dimensions::Vec3, &[DataType::F32])?;
    let texcoords = primitive.get(&Semantic::TexCoords(0));
    is("texture coordinates", texcoords, Dimensions::Vec2, &[DataType::F32, bytes, words])?;
    is("indices", primitive.indices(), Dimensions::Scalar, &[bytes, words, DataType::U32])
}

/// Adds what was found to a scene; `named` is the texture that sources all of it in place of its own.
pub fn append(
    found: Found,
    object: u32,
    named: Option<usize>,
    mesh: &mut Mesh,
    sources: &mut Vec<TextureSource>,
) {
    let (first, first_texture) = (mesh.vertices.len() as u32, sources.len());
    mesh.vertices.extend(found.vertices);
    for (corners, texture) in found.triangles {
        let texture = named.unwrap_or(first_texture + texture as usize) as u32;
        mesh.triangles.push(Triangle { corners: corners.map(|c| first + c), object, texture });
    }
    if named.is_none() {
        let source = |finest| TextureSource { finest, wrap: Wrap::Repeat, filter: Filter::Trilinear };
        sources.extend(found.textures.into_iter().map(source));
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
    level_of(&opaque, Channel::Alpha, path).map_err(|source| MeshError::Texture { path: path.into(), source })
}
