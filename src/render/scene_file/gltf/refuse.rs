//! What makes a glTF file unreadable here, in words, and what of a readable one is not simulated.

use gltf::json::Path;
use gltf::json::validation::{Error, Validate};

/// Extensions that are simulated.
const SIMULATED: &[&str] = &[
    "EXT_mesh_gpu_instancing",
    "EXT_texture_webp",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_transform",
    "MSFT_texture_dds",
    // Where an image of it is used, the image says whether it can be read.
    "KHR_texture_basisu",
];

/// Extensions that say nothing about where a surface is seen: of light, and of what people know of a file.
const OF_LIGHT: &[&str] = &[
    "EXT_lights_image_based",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_unlit",
    "KHR_xmp_json_ld",
];

/// Extensions that pack the numbers of a mesh.
const PACKED: &[&str] = &["EXT_meshopt_compression", "KHR_draco_mesh_compression", "KHR_meshopt_compression"];

/// Finds what is no glTF file by its first bytes.
///
/// # Errors
///
/// What it is instead.
pub(super) fn check_head(bytes: &[u8]) -> Result<(), String> {
    /// Magic, version and length, before the first chunk.
    const HEAD: usize = 12;
    if !bytes.starts_with(b"glTF") {
        let is_json = bytes.trim_ascii_start().starts_with(b"{");
        return if is_json { Ok(()) } else { Err("it is no glTF file: neither JSON nor GLB".to_owned()) };
    }
    let length = bytes.get(8..HEAD).and_then(|word| <[u8; 4]>::try_from(word).ok()).map(u32::from_le_bytes);
    match length {
        Some(length) if length as usize >= HEAD && length as usize <= bytes.len() => Ok(()),
        Some(length) => Err(format!("it is a GLB of {} bytes that says it has {length}", bytes.len())),
        None => Err("it ends within the header of a GLB".to_owned()),
    }
}

/// Finds what makes a file unreadable: the most helpful reason first.
///
/// # Errors
///
/// That reason.
pub(super) fn check(document: &gltf::Document) -> Result<(), String> {
    let json = document.as_json();
    let is_required = |name: &str| json.extensions_required.iter().any(|required| required == name);
    let lacks_numbers = || {
        json.accessors.iter().any(|accessor| accessor.buffer_view.is_none() && accessor.sparse.is_none())
            || json.buffers.iter().skip(1).any(|buffer| buffer.uri.is_none())
    };
    for packed in PACKED {
        if is_required(packed) || (json.extensions_used.iter().any(|used| used == packed) && lacks_numbers())
        {
            return Err(format!(
                "its numbers are packed ({packed}), which is not read here; export it without compression, or unpack it with \
                 a tool for glTF files"
            ));
        }
    }
    let is_known =
        |name: &str| [SIMULATED, OF_LIGHT].iter().any(|known| known.contains(&name)) || told(name).is_some();
    if let Some(required) = json.extensions_required.iter().find(|required| !is_known(required)) {
        return Err(format!("it cannot be drawn without the extension {required}, which is not read here"));
    }
    let is_2 = |version: &str| version.split('.').next() == Some("2");
    if !is_2(&json.asset.version)
        || json.asset.min_version.as_deref().is_some_and(|least| !["2", "2.0"].contains(&least))
    {
        let least = json.asset.min_version.as_deref().unwrap_or(&json.asset.version);
        return Err(format!("it is glTF of version {least}; 2.0 is read here"));
    }
    // The check below looks attributes up before it has seen them.
    for (mesh, primitive, of) in json.meshes.iter().enumerate().flat_map(|(mesh, of)| {
        of.primitives.iter().enumerate().map(move |(primitive, of)| (mesh, primitive, of))
    }) {
        if of.attributes.values().any(|accessor| accessor.value() >= json.accessors.len()) {
            return Err(format!(
                "`meshes[{mesh}].primitives[{primitive}].attributes` names something that is not there"
            ));
        }
    }
    let mut wrong: Vec<(String, Error)> = Vec::new();
    json.validate(json, Path::new, &mut |path, error| {
        let path = path().as_str().to_owned();
        // Attributes of other tools, and accessors of zeros, are sound.
        let is_sound = path.contains("<invalid semantic name>")
            || (error == Error::Missing && path.starts_with("accessors[") && path.ends_with(".bufferView"));
        // Parts that are never read may be wrong.
        let is_read = !["animations", "cameras", "extensionsRequired", "extensions"]
            .iter()
            .any(|part| path.starts_with(part))
            && ![".min", ".max", ".mimeType"].iter().any(|part| path.ends_with(part));
        if is_read && !is_sound {
            wrong.push((path, error));
        }
    });
    let Some((path, error)) = wrong.first() else { return Ok(()) };
    let what = match error {
        Error::IndexOutOfBounds => "names something that is not there",
        Error::Invalid => "has a value that the standard does not know",
        Error::Missing => "is missing",
        Error::Oversize => "is larger than this machine can address",
        Error::Unsupported => "is not read here",
    };
    let more = match wrong.len() {
        1 => String::new(),
        all => format!(", and so do or are {} more", all - 1),
    };
    Err(format!("`{path}` {what}{more}"))
}

/// What is told where an extension is used that changes what is seen and is not simulated; `None` for one that is not known.
fn told(extension: &str) -> Option<&'static str> {
    Some(match extension {
        "KHR_materials_transmission" | "KHR_materials_volume" | "KHR_materials_diffuse_transmission" => {
            "light that goes through surfaces (transmission) is not simulated: they are as opaque as their alpha"
        }
        "KHR_materials_variants" => "of its variants of materials the first look alone is drawn",
        "MSFT_lod" => "of its levels of detail the finest alone is drawn",
        _ => return None,
    })
}

/// What of a file is not simulated and changes what is seen.
pub(super) fn notes(document: &gltf::Document) -> Vec<String> {
    let json = document.as_json();
    let mut notes = Vec::new();
    for used in &json.extensions_used {
        let is_simulated = [SIMULATED, OF_LIGHT, PACKED].iter().any(|known| known.contains(&used.as_str()));
        match told(used) {
            Some(note) => notes.push(note.to_owned()),
            None if is_simulated => {}
            None => notes.push(format!("its extension {used} is not simulated")),
        }
    }
    if !json.animations.is_empty() {
        notes.push("its animations are not played: it stands as its nodes say".to_owned());
    }
    if json.scenes.len() > 1 {
        notes.push(format!("one of its {} scenes is drawn", json.scenes.len()));
    }
    notes
}
