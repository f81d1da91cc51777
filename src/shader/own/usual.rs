//! The names under which the values of a fragment are usual.

use super::options::Options;
use super::signature;

/// Names of other people for the values of a fragment, without case, underscores and the letters that tell where a value
/// comes from ([`plain`]).
const USUAL: [(&str, &[&str]); 10] = [
    (
        "position",
        &[
            "position",
            "positionos",
            "positionws",
            "positionls",
            "positionmc",
            "pos",
            "p",
            "co",
            "wp",
            "wpos",
            "opos",
            "worldpos",
            "worldposition",
            "objectpos",
            "objectposition",
            "objectspacepos",
            "objectspaceposition",
            "objpos",
            "objcoord",
            "objectcoord",
            "local",
            "localpos",
            "localposition",
            "modelpos",
            "modelposition",
            "samplepos",
            "fragpos",
            "fragposition",
            "inputcoord",
            "hashinputcoord",
            "objposition",
            "positionobject",
            "positionworld",
            "positionlocal",
            "posobject",
            "posos",
            "posws",
            "posworld",
            "poslocal",
            "worldcoord",
            "worldspacepos",
            "worldspaceposition",
            "localspacepos",
            "localspaceposition",
            "localcoord",
            "objpos3d",
            "surfacepos",
            "surfaceposition",
            "vertexposition",
            "vertexpos",
            "hashpos",
            "hashposition",
            "hashcoord",
            "anchor",
            "point",
            "coord",
            "coords",
        ],
    ),
    (
        "dpdx",
        &["dpdx", "ddx", "dx", "dposdx", "dpositiondx", "posdx", "positiondx", "posddx", "ddxpos", "dxpos"],
    ),
    (
        "dpdy",
        &["dpdy", "ddy", "dy", "dposdy", "dpositiondy", "posdy", "positiondy", "posddy", "ddypos", "dypos"],
    ),
    (
        "pixel",
        &[
            "pixel",
            "pixelpos",
            "pixelcoord",
            "fragcoord",
            "glfragcoord",
            "svposition",
            "screenpos",
            "screencoord",
            "pix",
        ],
    ),
    ("texcoord", &["texcoord", "texcoords", "texcoord0", "uv", "uvs", "uv0"]),
    ("lod", &["lod", "mip", "miplevel"]),
    ("frame", &["frame", "frameindex", "framecount", "framenumber", "frameid", "iframe"]),
    ("layer", &["layer", "layerindex"]),
    (
        "hash_scale",
        &[
            "hashscale",
            "alphahashscale",
            "noisescale",
            "noisesize",
            "noisepixels",
            "hashpixels",
            "hashsize",
            "grainsize",
        ],
    ),
    (
        PIXEL_SIZE,
        &[
            "pixelsize",
            "pixelwidth",
            "pixelfootprint",
            "maxderiv",
            "maxderivative",
            "maxd",
            "derivlength",
            "derivativelength",
            "derivlen",
            "ddmax",
            "maxdd",
            "pixderiv",
            "pixelderiv",
            "footprint",
            "texelsize",
        ],
    ),
];

/// The size of a pixel on the surface: the longer of the two derivatives, or of each axis the larger component.
pub(super) const PIXEL_SIZE: &str = "pixel_size";

/// Words in the names of what alphas are compared with.
const OF_THRESHOLDS: [&str; 8] =
    ["thresh", "hash", "noise", "dither", "cutoff", "ref", "stochastic", "scale"];

/// Whether something sounds like the alpha of a fragment: by its name, or as the last component of a colour.
pub(super) fn is_alpha(written: &str) -> bool {
    let mut parts = written.trim_matches(|c: char| c == '(' || c == ')' || c.is_whitespace()).split('.');
    let name = plain(parts.next().unwrap_or_default());
    let is_path = !name.is_empty() && name.bytes().all(|byte| byte.is_ascii_alphanumeric());
    let names_it = |name: &str| {
        ["alpha", "opacity", "coverage"].iter().any(|part| name.contains(part))
            && !OF_THRESHOLDS.iter().any(|part| name.contains(part))
    };
    let mut parts = parts.peekable();
    is_path
        && match parts.peek() {
            None => {
                names_it(&name)
                    || ["color", "colour", "albedo", "basecolor", "diffusecolor", "fragcolor"]
                        .contains(&name.as_str())
            }
            Some(_) => parts.last().is_some_and(|last| matches!(last, "a" | "w") || names_it(&plain(last))),
        }
}

/// What a file may have a name of its own for.
pub(super) fn meanings() -> impl Iterator<Item = &'static str> {
    signature::values().chain([PIXEL_SIZE])
}

/// A name without case and underscores, without `v_`, `u_` and their kin in front, and without the number that Slang puts behind.
fn plain(name: &str) -> String {
    let name = name
        .rsplit_once('_')
        .filter(|(_, end)| end.bytes().all(|b| b.is_ascii_digit()))
        .map_or(name, |(n, _)| n);
    let without = ["variable_", "v_", "u_", "i_", "a_", "g_", "in_", "fs_", "_"]
        .into_iter()
        .find_map(|mark| name.strip_prefix(mark));
    let name = without.unwrap_or(name);
    // vPos, uFrame, gHashScale.
    let mut letters = name.chars();
    let is_marked = matches!(letters.next(), Some('v' | 'u' | 'i' | 'a' | 'g'))
        && letters.next().is_some_and(char::is_uppercase);
    let name = if is_marked { &name[1..] } else { name };
    name.chars().filter(|&letter| letter != '_').flat_map(char::to_lowercase).collect()
}

/// Whether a name is one of those under which a value of a fragment is known.
pub(super) fn is_usual(of: &str, name: &str) -> bool {
    let name = plain(name);
    // Of the size of the noise there are as many names as engines.
    let is_scale =
        of == "hash_scale" && name.contains("hash") && (name.ends_with("scale") || name.ends_with("size"));
    is_scale || USUAL.iter().any(|(known, names)| *known == of && names.contains(&name.as_str()))
}

/// The value of a fragment that a name is known for.
pub(super) fn meaning_of(name: &str) -> Option<&'static str> {
    meanings().find(|&meaning| meaning == name || is_usual(meaning, name))
}

/// Whether a name says that it is a position, and none of a light, of the eye or on the screen.
pub(super) fn sounds_like_position(name: &str) -> bool {
    const OTHERS: [&str; 12] = [
        "light", "cam", "eye", "view", "sun", "probe", "screen", "clip", "ndc", "shadow", "previous", "prev",
    ];
    let name = plain(name);
    let ends = ["position", "pos", "coord", "point", "positionos", "positionws", "posos", "posws"];
    ends.iter().any(|end| name.ends_with(end)) && !OTHERS.iter().any(|other| name.contains(other))
}

/// Finds the position among the vectors of three that a text declares, by the rules of [`map`]; before it is parsed.
pub(super) fn position_among<'n>(names: &[&'n str], asked: &Options) -> Option<&'n str> {
    let free = || names.iter().copied().filter(|&name| !asked.settings.contains_key(name));
    if let Some(said) = asked.map.get("position") {
        return free().find(|name| name == said);
    }
    free().find(|&name| name == "position").or_else(|| only(free().filter(|name| is_usual("position", name))))
}

pub(super) fn only<T>(mut found: impl Iterator<Item = T>) -> Option<T> {
    found.next().filter(|_| found.next().is_none())
}
