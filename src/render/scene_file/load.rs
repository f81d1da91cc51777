//! A scene file made ready to be drawn: its triangles and its textures.

use super::gltf::{self, MeshError};
use super::image::{self, ImageError};
use super::schema::{SceneFile, TextureTable};
use super::surface::Board;
use crate::render::draw::mesh::Mesh;
use crate::render::draw::texture::{Level, Texture, TextureNeeds, TextureSource};
use std::path::Path;
use std::sync::OnceLock;

/// A scene that is ready to be drawn.
#[derive(Clone, Debug)]
pub struct Scene {
    /// What the file says.
    pub file: SceneFile,
    /// Every triangle.
    pub mesh: Mesh,
    sources: Vec<TextureSource>,
    /// Found when it is first asked for.
    parts: OnceLock<Vec<u32>>,
}

/// What stands behind a scene and cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum AssetError {
    /// An image.
    #[error("`texture.image.file`")]
    Image {
        /// The number of the texture in the file, from 0.
        texture: usize,
        /// What is wrong with it.
        source: ImageError,
    },
    /// A mesh.
    #[error("`surface.mesh.file`")]
    Mesh {
        /// The number of the surface in the file, from 0.
        surface: usize,
        /// What is wrong with it.
        source: MeshError,
    },
}

impl AssetError {
    /// Returns the path of the key that names it, for [`error_at`](crate::render::scene_file::read::error_at).
    #[must_use]
    pub fn key(&self) -> String {
        match self {
            Self::Image { texture, .. } => format!("texture.{texture}.image.file"),
            Self::Mesh { surface, .. } => format!("surface.{surface}.mesh.file"),
        }
    }
}

/// Draws the built-in textures, reads those of files, and turns surfaces into triangles; paths are relative to `folder`.
///
/// # Errors
///
/// [`AssetError`] for an image or a mesh that cannot be used; it names the file.
pub fn prepare(file: SceneFile, folder: &Path) -> Result<Scene, AssetError> {
    let mut sources = Vec::new();
    for (texture, table) in file.texture.iter().enumerate() {
        let finest =
            draw(table, file.seed, folder).map_err(|source| AssetError::Image { texture, source })?;
        sources.push(TextureSource { finest, wrap: table.wrap, filter: table.filter });
    }
    let mut mesh = Mesh::default();
    for (index, surface) in file.surface.iter().enumerate() {
        let named = surface
            .texture
            .as_ref()
            .and_then(|name| file.texture.iter().position(|texture| texture.name == *name));
        let named = named.or_else(|| {
            surface.checkerboard.as_ref().map(|_| {
                sources.push(Board::texture());
                sources.len() - 1
            })
        });
        mesh.objects.push(surface.object());
        if let Some(from) = &surface.mesh {
            let found = gltf::read(&folder.join(&from.file), from.scale, named.is_none())
                .map_err(|source| AssetError::Mesh { surface: index, source })?;
            gltf::append(found, index as u32, named, &mut mesh, &mut sources);
        }
        surface.build(&mut mesh, index as u32, named.unwrap_or(0) as u32, file.seed);
    }
    Ok(Scene { file, mesh, sources, parts: OnceLock::new() })
}

impl Scene {
    /// Returns for each triangle the part that it belongs to, see [`Mesh::parts`].
    #[must_use]
    pub fn parts(&self) -> &[u32] {
        self.parts.get_or_init(|| self.mesh.parts())
    }

    /// Builds the textures that a plan needs, with every level.
    #[must_use]
    pub fn textures(&self, needs: &TextureNeeds) -> Vec<Texture> {
        self.sources.iter().map(|source| Texture::new(source, needs)).collect()
    }
}

fn draw(table: &TextureTable, seed: u64, folder: &Path) -> Result<Level, ImageError> {
    let (size, opaque) = (table.size, table.opaque);
    if let Some(leaves) = &table.leaves {
        return Ok(leaves.draw(size, opaque, seed));
    }
    if let Some(wire) = &table.wire {
        return Ok(wire.draw(size, opaque));
    }
    if let Some(hair) = &table.hair {
        return Ok(hair.draw(size, opaque, seed));
    }
    if let Some(board) = &table.checkerboard {
        return Ok(board.draw(size, opaque));
    }
    if let Some(constant) = &table.constant {
        return Ok(constant.draw(size));
    }
    if let Some(ramp) = &table.ramp {
        return Ok(ramp.draw(size, opaque));
    }
    match &table.image {
        Some(image) => image::read(&folder.join(&image.file), image.alpha),
        // A checked file has one of the tables.
        None => Ok(Level { size: [1, 1], alpha: vec![1.0], colour: Vec::new() }),
    }
}
