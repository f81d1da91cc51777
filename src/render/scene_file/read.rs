//! Scene files: TOML in, a checked [`SceneFile`] or an error with file, line, column and the likely remedy out.

use super::diagnostic::{Diagnostic, place, plain, suggest};
use super::limits;
use super::schema::{SceneFile, Takes};
use super::spans::{Span, Spans};
use crate::render::effect::plan::{check as check_effects, plan};
use crate::render::measure::expect;
use crate::shader::spelling::likely;

/// A scene file that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}:{line}:{column}: {message}")]
pub struct FileError {
    /// Name of the file.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// What is wrong, and what would be right.
    pub message: String,
}

/// Reads a scene.
///
/// # Errors
///
/// [`FileError`] for text that is no TOML, a key that does not exist (with the one that was likely meant), a value out of
/// its range, a surface without a texture, or two tables where one is meant. It points at the key.
pub fn read(text: &str, file: &str) -> Result<SceneFile, FileError> {
    let at = |span: Option<Span>, message: String| {
        let (line, column) = place(text, span.map_or(0, |span| span.start));
        FileError { file: file.to_owned(), line, column, message }
    };
    let broken = |error: &toml::de::Error| error.message().trim().replace('\n', "; ");
    let spans = Spans::new(text).map_err(|error| at(error.span(), broken(&error)))?;
    limits::numbers(&spans).map_err(|(span, message)| at(span, message))?;
    let scene: SceneFile = toml::from_str(text).map_err(|error| {
        let message = broken(&error);
        let around = error.span().and_then(|span| spans.around(span.start));
        match (suggest(&message), around) {
            (Some(message), _) => at(error.span(), message),
            (None, Some((key, span))) => at(Some(span), plain(&key, &message)),
            (None, None) => at(error.span(), plain("", &message)),
        }
    })?;
    let told = |wrong: Diagnostic| at(spans.key(&wrong.key), wrong.message);
    check(&scene).and_then(|()| limits::totals(&scene)).map_err(told)?;
    Ok(scene)
}

/// Finds what is wrong with a scene after its resolution or its number of frames was changed.
///
/// # Errors
///
/// What that is, with the limit.
pub fn check_changed(scene: &SceneFile) -> Result<(), String> {
    check_camera(scene).and_then(|()| limits::totals(scene)).map_err(|wrong| wrong.message)
}

/// Makes an error of what stands behind a key: `key` is its path with the number of each table in a list, from 0.
#[must_use]
pub fn error_at(text: &str, file: &str, key: &str, message: String) -> FileError {
    let span = Spans::new(text).ok().and_then(|spans| spans.key(key));
    let (line, column) = place(text, span.map_or(0, |span| span.start));
    FileError { file: file.to_owned(), line, column, message }
}

/// What is wrong between keys, and with words.
fn check(scene: &SceneFile) -> Result<(), Diagnostic> {
    check_name("name", &scene.name)?;
    check_camera(scene)?;
    for (index, texture) in scene.texture.iter().enumerate() {
        let (key, name) = (format!("texture.{index}.name"), &texture.name);
        exactly_one(key.clone(), &format!("texture `{name}`"), &texture.kinds())?;
        if scene.texture[..index].iter().any(|other| other.name == *name) {
            return Err(Diagnostic::new(key, format!("two textures are called `{name}`")));
        }
    }
    let names: Vec<&str> = scene.texture.iter().map(|texture| texture.name.as_str()).collect();
    for (index, surface) in scene.surface.iter().enumerate() {
        let what = format!("surface {}", index + 1);
        let key = |name: &str| format!("surface.{index}.{name}");
        exactly_one(key("texture"), &what, &surface.kinds())?;
        if let Some(board) = &surface.checkerboard
            && !board.size.iter().all(|side| side / board.square <= 1.0e6)
        {
            let message =
                format!("{what}: `checkerboard.size` has more than a million of its squares in a row");
            return Err(Diagnostic::new(key("checkerboard.square"), message));
        }
        for (material, name) in surface.mesh.iter().flat_map(|mesh| &mesh.textures) {
            if !names.contains(&name.as_str()) {
                let message = format!("no texture is called `{name}`.{}", likely(name, &names));
                return Err(Diagnostic::new(key(&format!("mesh.textures.{material}")), message));
            }
        }
        match &surface.texture {
            Some(name) if !names.contains(&name.as_str()) => {
                let likely = likely(name, &names);
                let message = format!("no texture is called `{name}`.{likely}");
                return Err(Diagnostic::new(key("texture"), message));
            }
            Some(_) if surface.checkerboard.is_some() => {
                let message = "a checkerboard has a texture of its own; take `texture` away";
                return Err(Diagnostic::new(key("texture"), message));
            }
            None if surface.mesh.is_none() && surface.checkerboard.is_none() => {
                return Err(Diagnostic::new(key(""), format!("{what} has no `texture`")));
            }
            Some(_) | None => {}
        }
    }
    for (index, region) in scene.region.iter().enumerate() {
        if (0..2).any(|axis| region.corner[axis] >= scene.resolution[axis]) {
            let message = format!("`region.corner` of `{}` is outside of the picture", region.name);
            return Err(Diagnostic::new(format!("region.{index}.corner"), message));
        }
    }
    if let Some(depth) = &scene.depth
        && scene.resolution.iter().any(|side| *side < depth.ratio.get())
    {
        return Err(Diagnostic::new("depth.ratio", "`depth.ratio` leaves no pixel of the picture"));
    }
    let sets = match &scene.effects {
        Takes::Auto => &[][..],
        Takes::Sets(sets) => sets,
    };
    let mut takes: Vec<String> = Vec::new();
    for (index, set) in sets.iter().enumerate() {
        let key = format!("effects.{index}");
        check_effects(set).map_err(|wrong| wrong.within(&key))?;
        let name = plan(set).name;
        if takes.contains(&name) {
            let message = format!("two takes are called `{name}`; give one another `name`");
            return Err(Diagnostic::new(format!("{key}.name"), message));
        }
        takes.push(name);
    }
    let takes = (!takes.is_empty()).then_some(&takes[..]);
    scene.expect.iter().enumerate().try_for_each(|(index, expectation)| {
        expect::check_words(expectation, takes).map_err(|wrong| wrong.within(&format!("expect.{index}")))
    })
}

/// Names become those of files.
fn check_name(key: &str, name: &str) -> Result<(), Diagnostic> {
    let known = |letter: char| letter.is_alphanumeric() || " -_.".contains(letter);
    let length = name.chars().count();
    if !(1..=100).contains(&length) || name.starts_with(['.', ' ']) || !name.chars().all(known) {
        let message = format!(
            "`{key}` is {name:?}; it must be 1 to 100 letters, digits, spaces, `-`, `_` and `.`, and begin with neither \
             a point nor a space: files are called so"
        );
        return Err(Diagnostic::new(key, message));
    }
    Ok(())
}

/// The camera must see in some direction, in every frame.
fn check_camera(scene: &SceneFile) -> Result<(), Diagnostic> {
    let wrong = |key: &str, message: &str| Err(Diagnostic::new(key, message));
    let camera = &scene.camera;
    let [eye, target, up] = [camera.eye, camera.target, camera.up].map(glam::DVec3::from);
    let to_eye = eye - target;
    if to_eye.length() <= 1e-12 * eye.length().max(target.length()) {
        return wrong("camera.eye", "`camera.eye` is at `camera.target`: there is no line of sight");
    }
    if up.length() < 1e-12 {
        return wrong("camera.up", "`camera.up` has no direction: its length is 0");
    }
    if up.normalize().cross(to_eye.normalize()).length() <= 1e-9 {
        return wrong("camera.up", "`camera.up` must not be along the line of sight");
    }
    let zoom = camera.motion.and_then(|motion| motion.zoom).unwrap_or(1.0);
    let nearest = libm::pow(zoom, -f64::from(scene.frames.get() - 1));
    if !(1e-9..=1e9).contains(&nearest) {
        let message = format!(
            "`camera.motion.zoom` is {zoom}: the last of {} frames is seen from {nearest:.1e} times the distance, which \
             must be from 1e-9 to 1e9",
            scene.frames
        );
        return Err(Diagnostic::new("camera.motion.zoom", message));
    }
    Ok(())
}

/// A texture or a surface has one kind.
fn exactly_one(key: String, what: &str, kinds: &[(&str, bool)]) -> Result<(), Diagnostic> {
    let names =
        |kinds: &[&(&str, bool)], by: &str| kinds.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(by);
    let present: Vec<_> = kinds.iter().filter(|(_, present)| *present).collect();
    let message = match present.len() {
        1 => return Ok(()),
        0 => format!(
            "{what} has no kind; add exactly one of: {}",
            names(&kinds.iter().collect::<Vec<_>>(), ", ")
        ),
        _ => format!("{what} is {} at once; keep one", names(&present, " and ")),
    };
    Err(Diagnostic::new(key, message))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOUND: &str = "\
name = \"card\"
[camera]
eye = [0.0, 0.0, 5.0]
target = [0.0, 0.0, 0.0]
[[texture]]
name = \"leaf\"
leaves = {}
[[surface]]
texture = \"leaf\"
card = { size = [1.0, 1.0] }
[effects.hashed]
variant = \"anisotropic\"
";

    fn wrong(from: &str, to: &str) -> String {
        assert!(SOUND.contains(from));
        read(&SOUND.replace(from, to), "s.toml").unwrap_err().to_string()
    }

    #[test]
    fn a_sound_scene_is_read() {
        let scene = read(SOUND, "s.toml").unwrap();
        let Takes::Sets(sets) = &scene.effects else { panic!() };
        assert!(sets[0].hashed.is_some() && sets[0].fixed.is_none());
        assert_eq!(
            read(&SOUND.replace("[effects.hashed]\nvariant = \"anisotropic\"", ""), "").unwrap().effects,
            Takes::default()
        );
        let auto = SOUND.replace("[effects.hashed]\nvariant = \"anisotropic\"", "");
        assert_eq!(read(&format!("effects = \"auto\"\n{auto}"), "").unwrap().effects, Takes::Auto);
    }

    #[test]
    fn mistakes_are_named_with_their_place_and_the_likely_word() {
        for (from, to, expected) in [
            ("variant", "varient", "s.toml:12:1: unknown key `varient`. Did you mean `variant`?"),
            (
                "[effects.hashed]",
                "[effects.hasht]",
                "s.toml:11:10: unknown key `hasht`. Did you mean `hashed`?",
            ),
            ("anisotropic", "anistropic", "s.toml:12:11: unknown"),
            (
                "texture = \"leaf\"",
                "texture = \"leav\"",
                "s.toml:9:1: no texture is called `leav`. Did you mean `leaf`?",
            ),
            ("leaves = {}", "", "s.toml:6:1: texture `leaf` has no kind"),
            ("leaves = {}", "leaves = {}\nconstant = { alpha = 0.5 }", "is leaves and constant at once"),
            ("0.0, 0.0, 5.0", "0.0, 0.0", "s.toml:3:1: `camera.eye`: "),
            ("[camera]", "[camera", "s.toml:2:8: "),
            (
                "eye = [0.0, 0.0, 5.0]",
                "eye = [0.0, 0.0, 0.0]",
                "s.toml:3:1: `camera.eye` is at `camera.target`",
            ),
            (
                "eye = [0.0, 0.0, 5.0]",
                "eye = [0.0, 5.0, 0.0]",
                "s.toml:2:2: `camera.up` must not be along the line of sight",
            ),
            (
                "name = \"card\"",
                "name = \"card\"\nresolution = [0, 5]",
                "s.toml:2:1: `resolution` is 0; it must be from 1 to 16384",
            ),
            ("variant = \"anisotropic\"", "[effects.fixed]", "hashed"),
            ("card = { size = [1.0, 1.0] }", "sphere = 1", "unknown key `sphere`"),
            (
                "card = { size = [1.0, 1.0] }",
                "checkerboard = { size = [1.0, 1.0], square = 0.1 }",
                "s.toml:9:1: a checkerboard has a texture of its own",
            ),
            (
                "texture = \"leaf\"\ncard = { size = [1.0, 1.0] }",
                "checkerboard = { size = [1.0, 1.0], square = 0.0 }",
                "s.toml:9:37: `surface.checkerboard.square` is 0.0; it must be from 1e-15 to 1e15",
            ),
        ] {
            let message = wrong(from, to);
            assert!(message.contains(expected), "{to}: {message}");
        }
    }

    /// Whatever a number may not be, whichever key has it.
    #[test]
    fn numbers_are_finite_and_bounded_and_told_at_their_key() {
        let mut otherwise = Vec::new();
        let card = "texture = \"leaf\"\ncard = { size = [1.0, 1.0] }";
        let effect = "[effects.hashed]\nvariant = \"anisotropic\"";
        for (from, to, expected) in [
            (
                "size = [1.0, 1.0]",
                "size = [nan, 1.0]",
                "s.toml:10:10: `surface.card.size` is nan; it must be from 1e-15",
            ),
            ("size = [1.0, 1.0]", "size = [-1.0, 1.0]", "`surface.card.size` is -1.0"),
            (
                "size = [1.0, 1.0]",
                "size = [1.0, 1.0], repeat = [1e19, 1]",
                "s.toml:10:29: `surface.card.repeat` is 1e19",
            ),
            (
                "eye = [0.0",
                "eye = [1e300",
                "s.toml:3:1: `camera.eye` is 1e300; it must be from -1e15 to 1e15",
            ),
            ("eye = [0.0", "up = [nan, 0.0, 0.0]\neye = [0.0", "`camera.up` is nan"),
            ("eye = [0.0", "up = [0.0, 0.0, 0.0]\neye = [0.0", "s.toml:3:1: `camera.up` has no direction"),
            (
                "eye = [0.0",
                "half_height = 0\neye = [0.0",
                "`camera.half_height` is 0; it must be from 1e-6 to 1e6",
            ),
            ("[camera]", "frames = 0\n[camera]", "s.toml:2:1: `frames` is 0; it must be from 1 to 100000"),
            ("[camera]", "frames = 99999999999999999999999\n[camera]", "`frames` is 99999999999999999999999"),
            ("[camera]", "seed = -1\n[camera]", "`seed` is -1"),
            ("[camera]", "resolution = [16384, 16384]\n[camera]", "s.toml:2:1: 16384 x 16384 pixels"),
            ("[camera]", "frames = 100000\n[camera]", "s.toml:2:1: `frames` is 100000: those of all takes"),
            (
                "[camera]",
                "frames = 2.5\n[camera]",
                "s.toml:2:1: `frames`: invalid type: number `2.5`, expected a whole number",
            ),
            (
                "leaves = {}",
                "leaves = { count = 4000000000 }",
                "s.toml:7:12: `texture.leaves.count` is 4000000000",
            ),
            (
                "leaves = {}",
                "constant = { alpha = 1.5 }",
                "`texture.constant.alpha` is 1.5; it must be from 0 to 1",
            ),
            (
                "leaves = {}",
                "wire = { thickness = -0.1 }",
                "`texture.wire.thickness` is -0.1; it must be above 0 and at most 1",
            ),
            (
                "leaves = {}",
                "hair = { strands = 100000, thickness = 0.1 }",
                "`texture.hair.strands` is 100000",
            ),
            ("leaves = {}", "leaves = {}\nsize = 5000", "`texture.size` is 5000; it must be from 1 to 4096"),
            (
                "card = { size = [1.0, 1.0] }",
                "fence = { panels = 0, size = [1, 1] }",
                "`surface.fence.panels` is 0",
            ),
            (
                "card = { size = [1.0, 1.0] }",
                "stack = { cards = 4097, size = [1, 1], distance = 1 }",
                "it must be from 1 to 4096",
            ),
            (
                card,
                "texture = \"leaf\"\nfence = { panels = 2000000, size = [1, 1] }\n[[surface]]\n\
                 texture = \"leaf\"\nfence = { panels = 2000000, size = [1, 1] }",
                "s.toml:11:1: up to surface 2 there are 8000000 triangles; at most 4194304",
            ),
            (effect, "[truth]\nsamples = 65", "s.toml:12:1: `truth.samples` is 65; it must be from 1 to 64"),
            (
                effect,
                "[truth]\nsamples = 64",
                "s.toml:12:1: 320 x 240 pixels with 64 x 64 places each are more",
            ),
            (effect, "[distance]\nfactors = [1e300]", "s.toml:12:1: `distance.factors` is 1e300"),
            (
                effect,
                "[inset]\ncorner = [0, 0]\nsize = [9000, 9000]\ntimes = 64",
                "s.toml:11:2: the pictures beside",
            ),
            (effect, "[depth]\nratio = 300", "s.toml:12:1: `depth.ratio` leaves no pixel"),
            (
                effect,
                "[[region]]\nname = \"r\"\ncorner = [320, 0]\nsize = [1, 1]",
                "s.toml:13:1: `region.corner` of `r`",
            ),
            (
                effect,
                "[region]\nname = \"r\"",
                "s.toml:11:2: `region`: invalid type: table, expected a list, as `[[region]]`",
            ),
            (
                effect,
                "[effects.hashed]\nhash_scale = 1e-40",
                "s.toml:12:1: `effects.hashed.hash_scale` is 1e-40",
            ),
            (effect, "[effects.fixed]\nthreshold = 0", "`effects.fixed.threshold` is 0; it must be above 0"),
            (effect, "[effects.fixed]\nthreshold = \"a\"", "invalid type: string \"a\", expected a number"),
            (effect, "[effects.hashed]\n[effects.average]\nframes = 0", "`effects.average.frames` is 0"),
            (effect, "[effects.robust]\nvariant = \"iso\"", "variant `iso`. Known here: isotropic, ani"),
            (effect, "[effects.robust]\nhash = \"foo\"", "unknown hash `foo`. Known here: sine"),
            (effect, "[effects.robust]\njoin = \"x\"", "unknown join `x`. Known here: interpolate"),
            (effect, "[[effects]]\n[[effects]]\n", "two takes are called `alpha test`"),
            (effect, "[[effects]]\n[[effects]]\nfade_in = {}", "s.toml:13:1: `fade_in` needs"),
            ("[camera]", "camera = 1\n[other]", "`camera`: invalid type: number `1`, expected a table"),
        ] {
            let message = wrong(from, to);
            if !message.contains(expected) {
                otherwise.push((expected, message));
            }
        }
        assert!(otherwise.is_empty(), "{otherwise:#?}");
        let zoom = "frames = 5000\nresolution = [64, 48]\n[camera]\nmotion = { zoom = 1.01 }";
        assert!(
            wrong("[camera]", zoom)
                .contains("s.toml:5:12: `camera.motion.zoom` is 1.01: the last of 5000 frames")
        );
    }

    #[test]
    fn names_are_those_of_files() {
        for name in ["", " ", ".hidden", "../../evil", "a/b", "a\\\\b", "a\\nb", "<b>", "a\\u0000"] {
            let message = wrong("name = \"card\"", &format!("name = \"{name}\""));
            assert!(message.contains("s.toml:1:1: `name` is"), "{message}");
        }
        for name in ["card 2.5", "Bäume_1", "a-b"] {
            assert_eq!(read(&SOUND.replace("card\"", &format!("{name}\"")), "").unwrap().name, name);
        }
    }

    #[test]
    fn expectations_name_takes_and_have_bounds() {
        let expect = |rest: &str| {
            format!("[effects.hashed]\n[[expect]]\ntake = \"hashed\"\nmetric = \"coverage\"\n{rest}")
        };
        let effect = "[effects.hashed]\nvariant = \"anisotropic\"";
        for (rest, expected) in [
            ("", "s.toml:14:1: there is no bound"),
            ("at_least = nan", "s.toml:15:1: `expect.at_least` is nan"),
            ("at_least = 2\nat_most = 1", "s.toml:15:1: nothing is at least 2 and at most 1"),
            (
                "at_least = 0\nthan = \"hasht\"",
                "s.toml:16:1: no take is called `hasht`. Did you mean `hashed`?",
            ),
        ] {
            let message = wrong(effect, &expect(rest));
            assert!(message.contains(expected), "{rest}: {message}");
        }
        assert!(read(&SOUND.replace(effect, &expect("at_least = 0.0")), "").is_ok());
    }
}
