//! A scene file made ready to be drawn: its triangles and its textures.

use super::gltf::{self, MeshError, Wanted};
use super::image::{self, ImageError};
use super::schema::{SceneFile, TextureTable};
use super::surface::Board;
use crate::render::draw::mesh::Mesh;
use crate::render::draw::texture::{Level, Sampler, Texture, TextureNeeds, TextureSource};
use std::path::Path;
use std::sync::OnceLock;

/// A scene that is ready to be drawn.
#[derive(Clone, Debug)]
pub struct Scene {
    /// What the file says.
    pub file: SceneFile,
    /// Every triangle.
    pub mesh: Mesh,
    /// What of its files is not simulated and changes what is seen, a sentence each with the file.
    pub notes: Vec<String>,
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
    let mut notes = Vec::new();
    for (texture, table) in file.texture.iter().enumerate() {
        let levels = draw(table, file.seed, folder, &mut notes)
            .map_err(|source| AssetError::Image { texture, source })?;
        let sampler = Sampler::new(table.wrap, table.filter);
        sources.push(TextureSource { levels, sampler, cutoff: None });
    }
    let mut mesh = Mesh::default();
    for (index, surface) in file.surface.iter().enumerate() {
        let find = |name: &String| file.texture.iter().position(|texture| texture.name == *name);
        let named = surface.texture.as_ref().and_then(find);
        let named = named.or_else(|| {
            surface.checkerboard.as_ref().map(|_| {
                sources.push(Board::texture());
                sources.len() - 1
            })
        });
        mesh.objects.push(surface.object());
        if let Some(from) = &surface.mesh {
            let textures = from.textures.iter();
            let wanted = Wanted {
                scale: from.scale,
                alpha_mode: from.alpha_mode,
                all: named,
                by_material: textures.filter_map(|(of, name)| Some((of.as_str(), find(name)?))).collect(),
            };
            let found = gltf::read(&folder.join(&from.file), &wanted)
                .map_err(|source| AssetError::Mesh { surface: index, source })?;
            notes.extend(found.notes.iter().map(|note| format!("{}: {note}", from.file.display())));
            gltf::append(found, index as u32, &mut mesh, &mut sources);
        }
        surface.build(&mut mesh, index as u32, named.unwrap_or(0) as u32, file.seed);
    }
    Ok(Scene { file, mesh, notes, sources, parts: OnceLock::new() })
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

/// The levels that a texture comes with: of a drawn one the finest, of an image those of its file.
fn draw(
    table: &TextureTable,
    seed: u64,
    folder: &Path,
    notes: &mut Vec<String>,
) -> Result<Vec<Level>, ImageError> {
    let (size, opaque) = (table.size, table.opaque);
    if let Some(image) = &table.image {
        return image::read(image, folder, notes);
    }
    Ok(vec![finest(table, size, opaque, seed)])
}

fn finest(table: &TextureTable, size: u32, opaque: f64, seed: u64) -> Level {
    if let Some(leaves) = &table.leaves {
        return leaves.draw(size, opaque, seed);
    }
    if let Some(wire) = &table.wire {
        return wire.draw(size, opaque);
    }
    if let Some(hair) = &table.hair {
        return hair.draw(size, opaque, seed);
    }
    if let Some(board) = &table.checkerboard {
        return board.draw(size, opaque);
    }
    if let Some(constant) = &table.constant {
        return constant.draw(size);
    }
    match &table.ramp {
        Some(ramp) => ramp.draw(size, opaque),
        // A checked file has one of the tables.
        None => Level { size: [1, 1], alpha: vec![1.0], colour: Vec::new() },
    }
}
