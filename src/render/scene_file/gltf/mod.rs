//! glTF files as the standard says: triangles in the coordinates of their scene, and the alpha that their materials ask for.
//!
//! | module | holds |
//! |---|---|
//! | `accessor` | numbers of every type, checked against where they lie |
//! | `material` | what covers: image, factor, sampler, alpha mode, texture coordinates |
//! | `primitive` | corners: lists, strips, fans; morph targets, skins, vertex colours |
//! | `refuse` | what makes a file unreadable here, and extensions |
//!
//! Light is not simulated, so that metal, normals and what else changes its colour alone is left out without a word. What
//! changes where something is seen and is not simulated is told in [`Found::notes`].

mod accessor;
mod material;
mod primitive;
mod refuse;

use super::decoded::{ImageError, read_file};
use super::limits::MOST_TRIANGLES;
use super::surface::AlphaMode;
use crate::render::draw::mesh::{Mesh, Triangle, Vertex};
use crate::render::draw::texture::TextureSource;
use glam::{DMat2, DMat3, DMat4, DQuat, DVec2, DVec3};
use gltf::buffer;
use gltf::scene::Transform;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Texels of the images of a file, counted for each material that has one: those of eight images of 4096 x 4096.
const MOST_TEXELS: u64 = 1 << 27;

/// What is told of primitives that are no triangles.
const NOT_DRAWN: &str = "its points and lines are not drawn";

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

/// The same, without the file.
enum Failed {
    Content(String),
    Part { part: String, source: gltf::Error },
    Texture(ImageError),
}

impl From<String> for Failed {
    fn from(what: String) -> Self {
        Self::Content(what)
    }
}

impl Failed {
    fn of(self, path: &Path) -> MeshError {
        let path = path.into();
        match self {
            Self::Content(what) => MeshError::Content { path, what },
            Self::Part { part, source } => MeshError::Part { path, part, source: Box::new(source) },
            Self::Texture(source) => MeshError::Texture { path, source },
        }
    }
}

/// How a file is taken.
#[derive(Clone, Debug, Default)]
pub struct Wanted<'a> {
    /// What its units are multiplied by.
    pub scale: f64,
    /// How alpha is taken, whatever its materials say.
    pub alpha_mode: Option<AlphaMode>,
    /// The texture of the scene that stands in for every material that no other does.
    pub all: Option<usize>,
    /// Textures of the scene by the names of the materials that they stand in for.
    pub by_material: BTreeMap<&'a str, usize>,
}

/// What a file holds.
#[derive(Debug, Default)]
pub struct Found {
    vertices: Vec<Vertex>,
    /// Corners, what covers them, and whether they are seen from one side only.
    triangles: Vec<([u32; 3], Covering, bool)>,
    textures: Vec<TextureSource>,
    /// What of the file is not simulated and changes what is seen, a sentence each.
    pub notes: Vec<String>,
}

/// What a material asks of the primitives that it covers.
#[derive(Clone, Copy, Debug)]
struct Cover {
    /// The texture that covers them, among those of the file, or where a texture of the scene stands in, among those.
    texture: Covering,
    /// The set of texture coordinates that is read.
    set: u32,
    /// What is done to texture coordinates: a matrix, and then a shift (`KHR_texture_transform`).
    transform: (DMat2, DVec2),
    /// Whether alpha is taken at all.
    is_opaque: bool,
    /// Whether vertex colours are taken.
    takes_colours: bool,
    /// Whether an image is read.
    has_image: bool,
    /// The least alpha that its own test keeps, if it has one.
    cutoff: Option<f32>,
    single_sided: bool,
}

/// A texture by its number.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Covering {
    /// Among those of the file.
    OfFile(u32),
    /// Among those of the scene.
    OfScene(usize),
}

/// A file that is being read.
struct File<'a> {
    path: &'a Path,
    document: &'a gltf::Document,
    buffers: &'a [buffer::Data],
    wanted: &'a Wanted<'a>,
    /// Texels that may still be decoded.
    texels_left: u64,
    /// What covers the primitives of each material.
    covers: BTreeMap<Option<usize>, Cover>,
    /// Where each node of the scene stands.
    placed: BTreeMap<usize, DMat4>,
    found: Found,
}

/// Reads every triangle of the file's scene, and the images that cover them.
///
/// # Errors
///
/// [`MeshError`], which names the file.
pub fn read(path: &Path, wanted: &Wanted<'_>) -> Result<Found, MeshError> {
    let fail = |source| MeshError::Read { path: path.into(), source: Box::new(source) };
    let bytes = read_file(path).map_err(|source| fail(source.into()))?;
    let content = |what: String| MeshError::Content { path: path.into(), what };
    // Other tools write a mark before the text.
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
    refuse::check_head(bytes).map_err(content)?;
    let gltf::Gltf { document, blob } = gltf::Gltf::from_slice_without_validation(bytes).map_err(fail)?;
    refuse::check(&document).map_err(content)?;
    let buffers = buffers(&document, blob, path.parent()).map_err(|failed| failed.of(path))?;
    let mut file = File {
        path,
        document: &document,
        buffers: &buffers,
        wanted,
        texels_left: MOST_TEXELS,
        covers: BTreeMap::new(),
        placed: BTreeMap::new(),
        found: Found { notes: refuse::notes(&document), ..Found::default() },
    };
    file.read_scene().map_err(|failed| failed.of(path))?;
    Ok(file.found)
}

/// Adds what was found to a scene.
pub fn append(found: Found, object: u32, mesh: &mut Mesh, sources: &mut Vec<TextureSource>) {
    let (first, first_texture) = (mesh.vertices.len() as u32, sources.len());
    mesh.vertices.extend(found.vertices);
    for (corners, covering, single_sided) in found.triangles {
        let texture = match covering {
            Covering::OfFile(texture) => first_texture + texture as usize,
            Covering::OfScene(texture) => texture,
        } as u32;
        mesh.triangles.push(Triangle { corners: corners.map(|c| first + c), object, texture, single_sided });
    }
    sources.extend(found.textures);
}

impl File<'_> {
    fn read_scene(&mut self) -> Result<(), Failed> {
        let scene = self.document.default_scene().or_else(|| self.document.scenes().next());
        let scene = scene.ok_or_else(|| "it has no scene".to_owned())?;
        let known: BTreeSet<&str> =
            self.document.materials().filter_map(|material| material.name()).collect();
        if let Some(name) = self.wanted.by_material.keys().find(|name| !known.contains(*name)) {
            let known: Vec<&str> = known.into_iter().collect();
            let what = match known.is_empty() {
                true => "its materials have no names".to_owned(),
                false => format!("its materials are `{}`", known.join("`, `")),
            };
            return Err(format!("no material is called `{name}`; {what}").into());
        }
        let mut nodes = Vec::new();
        let root = DMat4::from_scale(DVec3::splat(self.wanted.scale));
        let mut open: Vec<(gltf::Node<'_>, DMat4, bool)> =
            scene.nodes().map(|node| (node, root, true)).collect();
        while let Some((node, parent, is_seen)) = open.pop() {
            let to_object = parent * matrix(node.transform());
            if self.placed.insert(node.index(), to_object).is_some() {
                let name = node.name().map_or_else(String::new, |name| format!(" ({name})"));
                let what = "is reached twice, from itself or from two others: nodes must be a tree";
                return Err(format!("node {}{name} {what}", node.index()).into());
            }
            let visibility =
                node.extension_value("KHR_node_visibility").and_then(|found| found.get("visible"));
            let is_seen = is_seen && visibility.and_then(|visible| visible.as_bool()).unwrap_or(true);
            open.extend(node.children().map(|child| (child, to_object, is_seen)));
            nodes.push((node, is_seen));
        }
        let (seen, hidden): (Vec<_>, Vec<_>) = nodes.into_iter().partition(|(_, is_seen)| *is_seen);
        let is_hidden = hidden.iter().any(|(node, _)| node.mesh().is_some());
        for (node, _) in seen {
            self.read_node(&node)?;
        }
        if self.found.triangles.is_empty() {
            let notes = &self.found.notes;
            let why = if is_hidden {
                ": all that has some is hidden"
            } else if notes.iter().any(|note| note == NOT_DRAWN) {
                ": it is made of points and lines, which are not drawn"
            } else {
                ""
            };
            return Err(format!("it has no triangles{why}").into());
        }
        self.found.notes.sort();
        self.found.notes.dedup();
        Ok(())
    }

    fn read_node(&mut self, node: &gltf::Node<'_>) -> Result<(), Failed> {
        let Some(mesh) = node.mesh() else { return Ok(()) };
        // The standard takes the joints of a skin in place of the node's own transformation.
        let joints = node.skin().map(|skin| self.joints(&skin)).transpose()?;
        let copies = match &joints {
            Some(_) => vec![DMat4::IDENTITY],
            None => {
                let to_object = self.placed.get(&node.index()).copied().unwrap_or(DMat4::IDENTITY);
                self.instances(node)?.into_iter().map(|instance| to_object * instance).collect()
            }
        };
        // A skin goes round as its node says, though that does not place it.
        let of_node =
            self.placed.get(&node.index()).map_or(1.0, |placed| DMat3::from_mat4(*placed).determinant());
        let is_skin_mirrored = joints.is_some() && of_node < 0.0;
        let weights = node.weights().or_else(|| mesh.weights()).unwrap_or_default();
        for primitive in mesh.primitives() {
            let read = self.read_primitive(&primitive, weights, joints.as_deref(), &copies, is_skin_mirrored);
            read.map_err(|failed| match failed {
                Failed::Content(what) => {
                    Failed::Content(format!("mesh {}, primitive {}: {what}", mesh.index(), primitive.index()))
                }
                Failed::Part { .. } | Failed::Texture(_) => failed,
            })?;
        }
        Ok(())
    }

    /// Where each joint of a skin takes a vertex.
    fn joints(&self, skin: &gltf::Skin<'_>) -> Result<Vec<DMat4>, Failed> {
        if skin.joints().next().is_none() {
            return Err(format!("skin {} has no joints", skin.index()).into());
        }
        let inverses = skin.inverse_bind_matrices();
        let inverses =
            inverses.map(|found| accessor::read(&found, self.buffers, "inverse bind matrices", &[16]));
        let inverses = inverses.transpose()?;
        skin.joints()
            .enumerate()
            .map(|(at, joint)| {
                let placed = self.placed.get(&joint.index()).copied().ok_or_else(|| {
                    format!("joint {} of skin {} is no node of the scene", joint.index(), skin.index())
                })?;
                match &inverses {
                    None => Ok(placed),
                    Some(inverses) => {
                        let short = || format!("skin {} has fewer matrices than joints", skin.index());
                        let columns = inverses.get(at).and_then(|all| <&[f64; 16]>::try_from(all).ok());
                        Ok(placed * DMat4::from_cols_array(columns.ok_or_else(short)?))
                    }
                }
            })
            .collect()
    }

    /// Where each copy of a node stands in it (`EXT_mesh_gpu_instancing`); once without.
    fn instances(&self, node: &gltf::Node<'_>) -> Result<Vec<DMat4>, Failed> {
        let Some(instancing) = node.extension_value("EXT_mesh_gpu_instancing") else {
            return Ok(vec![DMat4::IDENTITY]);
        };
        let attribute = |name: &str, width: usize| -> Result<Option<accessor::Numbers>, Failed> {
            let index =
                instancing.get("attributes").and_then(|all| all.get(name)).and_then(|index| index.as_u64());
            let Some(index) = index else { return Ok(None) };
            let missing =
                || format!("node {} names accessor {index} as {name}, which is not there", node.index());
            let found = self.document.accessors().nth(index as usize).ok_or_else(missing)?;
            self.limit(found.count() as u64)?;
            Ok(Some(accessor::read(&found, self.buffers, name, &[width])?))
        };
        let (moves, turns, scales) =
            (attribute("TRANSLATION", 3)?, attribute("ROTATION", 4)?, attribute("SCALE", 3)?);
        let unused =
            || format!("the instances of node {} have none of TRANSLATION, ROTATION and SCALE", node.index());
        let counts: Vec<usize> =
            [&moves, &turns, &scales].into_iter().flatten().map(accessor::Numbers::len).collect();
        let count = *counts.first().ok_or_else(unused)?;
        if counts.iter().any(|&other| other != count) {
            return Err(
                format!("the instances of node {} are {counts:?} by its attributes", node.index()).into()
            );
        }
        let of = |numbers: &Option<accessor::Numbers>, at: usize, without: [f64; 4]| -> [f64; 4] {
            let mut found = without;
            let read = numbers.as_ref().and_then(|numbers| numbers.get(at)).unwrap_or_default();
            found.iter_mut().zip(read).for_each(|(to, from)| *to = *from);
            found
        };
        let place = |at: usize| {
            let [[x, y, z, _], scale] = [of(&moves, at, [0.0; 4]), of(&scales, at, [1.0; 4])];
            let turn = DQuat::from_array(of(&turns, at, [0.0, 0.0, 0.0, 1.0])).normalize();
            let scale = DVec3::new(scale[0], scale[1], scale[2]);
            DMat4::from_scale_rotation_translation(scale, turn, DVec3::new(x, y, z))
        };
        Ok((0..count).map(place).collect())
    }

    /// The texture of the scene that stands in for a material.
    fn stands_in(&self, material: &gltf::Material<'_>) -> Option<usize> {
        let own = material.name().and_then(|name| self.wanted.by_material.get(name));
        own.copied().or(self.wanted.all)
    }

    /// What covers the primitives of a material.
    fn cover(&mut self, material: &gltf::Material<'_>) -> Result<Cover, Failed> {
        if let Some(known) = self.covers.get(&material.index()) {
            return Ok(*known);
        }
        let cover = self.cover_of(material)?;
        self.covers.insert(material.index(), cover);
        Ok(cover)
    }

    /// Reads the file that an address names, or what the address itself holds.
    fn bytes_of(&self, uri: &str) -> Result<buffer::Data, gltf::Error> {
        source_bytes(buffer::Source::Uri(uri), &mut None, self.path.parent())
    }

    /// Tells something once.
    fn tell(&mut self, note: String) {
        if !self.found.notes.contains(&note) {
            self.found.notes.push(note);
        }
    }

    /// Refuses vertices or triangles beyond what is drawn.
    fn limit(&self, more: u64) -> Result<(), Failed> {
        let most = self.found.triangles.len().max(self.found.vertices.len()) as u64;
        if most.saturating_add(more) > MOST_TRIANGLES {
            return Err(format!("it has more than {MOST_TRIANGLES} triangles or vertices").into());
        }
        Ok(())
    }
}

fn matrix(transform: Transform) -> DMat4 {
    match transform {
        Transform::Matrix { matrix } => {
            DMat4::from_cols_array_2d(&matrix.map(|column| column.map(f64::from)))
        }
        Transform::Decomposed { translation, rotation, scale } => {
            let turn = DQuat::from_array(rotation.map(f64::from)).normalize();
            let [scale, shift] = [scale, translation].map(|triple| DVec3::from(triple.map(f64::from)));
            DMat4::from_scale_rotation_translation(scale, turn, shift)
        }
    }
}

fn buffers(
    document: &gltf::Document,
    mut blob: Option<Vec<u8>>,
    folder: Option<&Path>,
) -> Result<Vec<buffer::Data>, Failed> {
    let mut buffers = Vec::new();
    for buffer in document.buffers() {
        let part = match buffer.source() {
            buffer::Source::Uri(uri) => named("buffer", buffer.index(), uri),
            buffer::Source::Bin => format!("buffer {}", buffer.index()),
        };
        let data = source_bytes(buffer.source(), &mut blob, folder)
            .map_err(|source| Failed::Part { part: part.clone(), source })?;
        if data.len() < buffer.length() {
            let (is, says) = (data.len(), buffer.length());
            return Err(format!("{part} has {is} bytes in place of {says}").into());
        }
        buffers.push(data);
    }
    Ok(buffers)
}

fn source_bytes(
    source: buffer::Source<'_>,
    blob: &mut Option<Vec<u8>>,
    folder: Option<&Path>,
) -> Result<buffer::Data, gltf::Error> {
    match source {
        buffer::Source::Uri(uri) if !uri.starts_with("data:") => {
            let path = uri.strip_prefix("file://").or(uri.strip_prefix("file:")).unwrap_or(uri);
            if path.contains(':') {
                return Err(gltf::Error::UnsupportedScheme);
            }
            let path = unescaped(path).ok_or(gltf::Error::UnsupportedScheme)?;
            Ok(buffer::Data(read_file(&folder.unwrap_or(Path::new("")).join(path))?))
        }
        buffer::Source::Uri(_) | buffer::Source::Bin => {
            buffer::Data::from_source_and_blob(source, folder, blob)
        }
    }
}

/// An address with its escapes (`%20`) resolved; `None` if that is no text.
fn unescaped(uri: &str) -> Option<String> {
    let mut bytes = Vec::new();
    let mut rest = uri.as_bytes();
    while let [first, behind @ ..] = rest {
        let code = behind.get(..2).and_then(|two| core::str::from_utf8(two).ok());
        let code = code.and_then(|two| u8::from_str_radix(two, 16).ok()).filter(|_| *first == b'%');
        bytes.push(code.unwrap_or(*first));
        rest = &behind[if code.is_some() { 2 } else { 0 }..];
    }
    String::from_utf8(bytes).ok()
}

/// A buffer or an image by the file that its address names.
fn named(what: &str, index: usize, uri: &str) -> String {
    if uri.starts_with("data:") { format!("{what} {index}") } else { format!("{what} {index}, {uri}") }
}
