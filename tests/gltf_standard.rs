//! What a glTF file says of its alpha is what is drawn: each thing that a material or a primitive can say, with the share of the
//! picture that it must cover, computed by hand from the standard.
//!
//! The quad of every file has sides of 2 and is seen from so far away that it fills half of the picture along each axis: opaque,
//! it covers a quarter.

use hashed_alpha::render::measure::study::{Study, study};
use hashed_alpha::render::scene_file::load::{Scene, prepare};
use hashed_alpha::render::scene_file::read;
use image::{DynamicImage, ImageFormat, RgbaImage};
use std::fmt::Write;
use std::fs;
use std::io::Cursor;
use std::path::Path;

/// What an opaque quad covers.
const QUAD: f64 = 0.25;
/// Alpha of the texels that are called "of 0.3".
const ALPHA: f64 = 77.0 / 255.0;

/// A file in the making.
struct Model {
    bytes: Vec<u8>,
    views: Vec<String>,
    accessors: Vec<String>,
    attributes: String,
    /// Of the primitive, behind its attributes.
    primitive: String,
    more_primitives: String,
    material: String,
    image: Option<Vec<u8>>,
    sampler: &'static str,
    node: String,
    more_nodes: &'static str,
    /// Behind everything else.
    top: String,
}

const CORNERS: [[f32; 3]; 4] = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
const WHOLE: [[f32; 2]; 4] = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
/// Texture coordinates up to 2.
const TWICE: [[f32; 2]; 4] = [[0.0, 2.0], [2.0, 2.0], [2.0, 0.0], [0.0, 0.0]];
const TEXTURE: &str = r#""pbrMetallicRoughness":{"baseColorTexture":{"index":0}}"#;

fn png(alpha: impl Fn(u32, u32) -> u8) -> Vec<u8> {
    let image = RgbaImage::from_fn(16, 16, |x, y| image::Rgba([0, 200, 0, alpha(x, y)]));
    encoded(&image.into(), ImageFormat::Png)
}

fn encoded(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).expect("encoded");
    bytes.into_inner()
}

fn left_half() -> Vec<u8> {
    png(|x, _| if x < 8 { 255 } else { 0 })
}

impl Model {
    /// A quad as a list of two triangles, with texture coordinates from 0 to 1.
    fn new(image: Vec<u8>, material: &str) -> Self {
        let mut model = Self {
            bytes: Vec::new(),
            views: Vec::new(),
            accessors: Vec::new(),
            attributes: String::new(),
            primitive: String::new(),
            more_primitives: String::new(),
            material: material.to_owned(),
            image: Some(image),
            sampler: "{}",
            node: String::new(),
            more_nodes: "",
            top: String::new(),
        };
        model.attribute("POSITION", "VEC3", &CORNERS.concat());
        model.attribute("TEXCOORD_0", "VEC2", &WHOLE.concat());
        let indices = model.shorts("SCALAR", 1, &[0, 1, 2, 0, 2, 3], "");
        model.primitive = format!(r#","indices":{indices}"#);
        model
    }

    fn opaque(material: &str) -> Self {
        Self::new(png(|_, _| 255), material)
    }

    /// Adds an accessor, and returns its number.
    fn accessor(&mut self, bytes: &[u8], kind: u32, name: &str, count: usize, more: &str) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let (offset, view) = (self.bytes.len(), self.views.len());
        self.bytes.extend(bytes);
        self.views.push(format!(r#"{{"buffer":0,"byteOffset":{offset},"byteLength":{}}}"#, bytes.len()));
        self.accessors.push(format!(
            r#"{{"bufferView":{view},"componentType":{kind},"count":{count},"type":"{name}"{more}}}"#
        ));
        self.accessors.len() - 1
    }

    fn floats(&mut self, name: &str, width: usize, values: &[f32]) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.accessor(&bytes, 5126, name, values.len() / width, "")
    }

    fn shorts(&mut self, name: &str, width: usize, values: &[u16], more: &str) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.accessor(&bytes, 5123, name, values.len() / width, more)
    }

    /// Gives the primitive an attribute of floats.
    fn attribute(&mut self, attribute: &str, name: &str, values: &[f32]) {
        let width = match name {
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        let accessor = self.floats(name, width, values);
        self.names(attribute, accessor);
    }

    fn names(&mut self, attribute: &str, accessor: usize) {
        let comma = if self.attributes.is_empty() { "" } else { "," };
        write!(self.attributes, r#"{comma}"{attribute}":{accessor}"#).expect("text");
    }

    fn texcoords(mut self, texcoords: &[[f32; 2]; 4]) -> Self {
        let accessor = self.floats("VEC2", 2, &texcoords.concat());
        self.attributes =
            self.attributes.replace(r#""TEXCOORD_0":1"#, &format!(r#""TEXCOORD_0":{accessor}"#));
        self
    }

    fn colours(mut self, colour: [f32; 4]) -> Self {
        self.attribute("COLOR_0", "VEC4", &[colour; 4].concat());
        self
    }

    fn with(mut self, change: impl FnOnce(&mut Self)) -> Self {
        change(&mut self);
        self
    }

    fn text(&self) -> String {
        let Self {
            views,
            accessors,
            attributes,
            primitive,
            more_primitives,
            material,
            sampler,
            node,
            more_nodes,
            top,
            ..
        } = self;
        let image = self.image.as_ref().map_or_else(String::new, |_| {
            format!(r#""images":[{{"uri":"leaf.img"}}],"samplers":[{sampler}],"textures":[{{"source":0,"sampler":0}}],"#)
        });
        format!(
            r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
            "nodes":[{{"mesh":0{node}}}{more_nodes}],
            "meshes":[{{"primitives":[{{"attributes":{{{attributes}}},"material":0{primitive}}}{more_primitives}]}}],
            "materials":[{{"name":"leaf",{material}}}],{image}
            "accessors":[{}],"bufferViews":[{}],
            "buffers":[{{"byteLength":{},"uri":"data.bin"}}]{top}}}"#,
            accessors.join(","),
            views.join(","),
            self.bytes.len(),
        )
    }

    fn write(&self, folder: &Path) {
        fs::write(folder.join("data.bin"), &self.bytes).expect("written");
        fs::write(folder.join("model.gltf"), self.text()).expect("written");
        if let Some(image) = &self.image {
            fs::write(folder.join("leaf.img"), image).expect("written");
        }
    }

    /// The scene with the file, seen from so far along the z axis.
    fn scene(&self, more: &str, mesh: &str, eye: f64) -> Result<Scene, String> {
        let folder = tempfile::tempdir().expect("a folder");
        self.write(folder.path());
        let text = format!(
            "name = 's'\nresolution = [128, 128]\n{more}\n[camera]\neye = [0.0, 0.0, {eye}]\ntarget = [0.0, 0.0, 0.0]\n\
             half_height = 0.4\n[truth]\nsamples = 4\n[[surface]]\nmesh = {{ file = 'model.gltf'{mesh} }}\n\
             [[effects]]\nname = 'test'\nfixed = {{}}\n[[effects]]\nname = 'hashed'\nrobust = {{}}\n"
        );
        let file = read::read(&text, "s.toml").map_err(|error| error.to_string())?;
        prepare(file, folder.path()).map_err(|error| {
            let cause = std::error::Error::source(&error).expect("a cause");
            format!("{cause}{}", cause.source().map_or_else(String::new, |cause| format!(": {cause}")))
        })
    }

    fn study(&self, more: &str, mesh: &str, eye: f64) -> Study {
        let scene = self.scene(more, mesh, eye).unwrap_or_else(|error| panic!("{error}"));
        study(&scene, &mut |_, _| ())
    }

    /// What the alpha test and the truth cover.
    fn covers(&self) -> [f64; 2] {
        covered(&self.study("", "", 5.0))
    }
}

fn covered(study: &Study) -> [f64; 2] {
    let metrics = &study.takes[0].metrics;
    let truth = study.truth.as_ref().expect("a truth")[0].mean_coverage();
    [metrics["coverage"], truth]
}

#[track_caller]
fn assert_covers(what: &str, found: [f64; 2], expected: [f64; 2]) {
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() <= 0.01 * expected, "{what}: {found} in place of {expected}");
    }
}

/// The coverage of the left and of the right quarter of the quad, by the test.
fn of_edges(model: &Model) -> [f64; 2] {
    let region = |name: &str, left: u32| {
        format!("[[region]]\nname = '{name}'\ncorner = [{left}, 32]\nsize = [16, 64]\n")
    };
    let study = model.study(&(region("left", 32) + &region("right", 80)), "", 5.0);
    let metrics = &study_metrics(&study)["test"];
    [metrics["coverage.left"], metrics["coverage.right"]]
}

fn study_metrics(
    study: &Study,
) -> std::collections::BTreeMap<&str, &hashed_alpha::render::measure::metrics::Metrics> {
    study.takes.iter().map(|take| (take.plan.name.as_str(), &take.metrics)).collect()
}

#[test]
fn alpha_is_taken_as_the_material_says() {
    let thirty = || png(|_, _| 77);
    let blend = |more: &str| format!(r#""alphaMode":"BLEND","pbrMetallicRoughness":{{{more}}}"#);
    let mask = |more: &str| format!(r#""alphaMode":"MASK"{more},{TEXTURE}"#);
    let base = r#""baseColorTexture":{"index":0}"#;
    for (what, model, expected) in [
        ("opaque", Model::opaque(TEXTURE), [QUAD; 2]),
        ("opaque mode does not look at alpha", Model::new(left_half(), TEXTURE), [QUAD; 2]),
        ("mask, half clear", Model::new(left_half(), &mask("")), [QUAD / 2.0; 2]),
        ("mask, 0.3 is above 0.25", Model::new(thirty(), &mask(r#","alphaCutoff":0.25"#)), [QUAD; 2]),
        ("mask, 0.3 is below 0.5", Model::new(thirty(), &mask("")), [0.0; 2]),
        ("mask, nothing is above 1", Model::new(left_half(), &mask(r#","alphaCutoff":1.5"#)), [0.0; 2]),
        ("blend", Model::new(thirty(), &blend(base)), [0.0, QUAD * ALPHA]),
        (
            "factor",
            Model::opaque(&blend(&format!(r#"{base},"baseColorFactor":[1,1,1,0.3]"#))),
            [0.0, QUAD * 0.3],
        ),
        (
            "factor on a mask: 0.6 of 0.302 is 0.18",
            Model::new(
                thirty(),
                &format!(
                    r#""alphaMode":"MASK","alphaCutoff":0.2,"pbrMetallicRoughness":{{{base},"baseColorFactor":[1,1,1,0.6]}}"#
                ),
            ),
            [0.0; 2],
        ),
        (
            "factor alone",
            Model::opaque(&blend(r#""baseColorFactor":[1,1,1,0.7]"#)).with(|m| m.image = None),
            [QUAD, QUAD * 0.7],
        ),
        ("vertex colours", Model::opaque(&blend(base)).colours([1.0, 1.0, 1.0, 0.3]), [0.0, QUAD * 0.3]),
        ("vertex colours of an opaque one", Model::opaque(TEXTURE).colours([1.0, 1.0, 1.0, 0.3]), [QUAD; 2]),
        (
            "vertex colours under a mask: 0.3 of 1 is above 0.25",
            Model::opaque(&mask(r#","alphaCutoff":0.25"#)).colours([1.0, 1.0, 1.0, 0.3]),
            [QUAD; 2],
        ),
        (
            "vertex colours and factor",
            Model::opaque(&blend(&format!(r#"{base},"baseColorFactor":[1,1,1,0.5]"#)))
                .colours([1.0, 1.0, 1.0, 0.5]),
            [0.0, QUAD / 4.0],
        ),
        (
            "specular and glossiness",
            Model::new(
                left_half(),
                r#""alphaMode":"MASK","extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseTexture":{"index":0}}}"#,
            ),
            [QUAD / 2.0; 2],
        ),
    ] {
        assert_covers(what, model.covers(), expected);
    }
}

#[test]
fn vertex_colours_are_numbers_of_every_kind() {
    let blend = format!(r#""alphaMode":"BLEND",{TEXTURE}"#);
    let words = Model::opaque(&blend).with(|model| {
        let colour =
            model.shorts("VEC4", 4, &[65_535, 65_535, 65_535, 19_661].repeat(4), r#","normalized":true"#);
        model.names("COLOR_0", colour);
    });
    assert_covers("words", words.covers(), [0.0, QUAD * 0.3]);
    let bytes = Model::opaque(&blend).with(|model| {
        let colour = model.accessor(&[255, 255, 255, 51].repeat(4), 5121, "VEC4", 4, r#","normalized":true"#);
        model.names("COLOR_0", colour);
    });
    assert_covers("bytes", bytes.covers(), [0.0, QUAD * 0.2]);
    let without_alpha = Model::opaque(&blend).with(|model| model.attribute("COLOR_0", "VEC3", &[0.5; 12]));
    assert_covers("red, green and blue alone", without_alpha.covers(), [QUAD; 2]);
}

#[test]
fn texture_coordinates_are_those_that_the_material_reads() {
    let transformed = |transform: &str| {
        format!(
            r#""alphaMode":"MASK","pbrMetallicRoughness":{{"baseColorTexture":{{"index":0,
            "extensions":{{"KHR_texture_transform":{{{transform}}}}}}}}}"#
        )
    };
    let second = |material: &str| {
        Model::new(left_half(), material).with(|model| model.attribute("TEXCOORD_1", "VEC2", &[0.1; 8]))
    };
    let of_set = r#""alphaMode":"MASK","pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}"#;
    assert_covers("second set", second(of_set).covers(), [QUAD; 2]);
    assert_covers("set of the transform", second(&transformed(r#""texCoord":1"#)).covers(), [QUAD; 2]);
    let of = |transform: &str| Model::new(left_half(), &transformed(transform));
    assert_covers("smaller", of(r#""scale":[0.4,0.4],"offset":[0.05,0]"#).covers(), [QUAD; 2]);
    assert_covers("moved by a half", of(r#""offset":[0.5,0]"#).covers(), [QUAD / 2.0; 2]);
    assert_eq!(of_edges(&of(r#""offset":[0,0]"#)), [1.0, 0.0]);
    assert_eq!(of_edges(&of(r#""offset":[0.5,0]"#)), [0.0, 1.0]);
    // Scaled, turned, moved, in this order: by a quarter turn u becomes v, so that the upper half is opaque; v goes from 0 to
    // 0.25 then, and all is.
    assert_covers("turned", of(r#""rotation":1.5707963267948966,"scale":[1,0.25]"#).covers(), [QUAD; 2]);
    assert_covers(
        "turned the other way",
        of(r#""rotation":-1.5707963267948966,"scale":[1,0.25],"offset":[0.5,0]"#).covers(),
        [QUAD; 2],
    );
    assert_covers("turned without scale", of(r#""rotation":1.5707963267948966"#).covers(), [QUAD / 2.0; 2]);
    let required = of(r#""scale":[0.4,0.4],"offset":[0.05,0]"#).with(|model| {
        model.top =
            r#","extensionsUsed":["KHR_texture_transform"],"extensionsRequired":["KHR_texture_transform"]"#
                .into();
    });
    assert_covers("required", required.covers(), [QUAD; 2]);
}

#[test]
fn samplers_wrap_and_filter_as_they_say() {
    let mask = format!(r#""alphaMode":"MASK",{TEXTURE}"#);
    let quadrant = || png(|x, y| if x < 8 && y < 8 { 255 } else { 0 });
    let wrapped =
        |image, sampler| Model::new(image, &mask).texcoords(&TWICE).with(|model| model.sampler = sampler);
    assert_covers("repeated", wrapped(quadrant(), "{}").covers(), [QUAD / 4.0; 2]);
    let clamped = wrapped(quadrant(), r#"{"wrapS":33071,"wrapT":33071}"#);
    assert_covers("clamped", clamped.covers(), [QUAD / 16.0; 2]);
    let across = wrapped(quadrant(), r#"{"wrapS":33071,"wrapT":10497}"#);
    assert_covers("clamped across, repeated down", across.covers(), [QUAD / 8.0; 2]);
    // Of the four quarters from left to right a repeated half is opaque in the first and the third, a mirrored one in the first
    // and the last.
    assert_eq!(of_edges(&wrapped(left_half(), r#"{"wrapS":10497}"#)), [1.0, 0.0]);
    assert_eq!(of_edges(&wrapped(left_half(), r#"{"wrapS":33648}"#)), [1.0, 1.0]);

    let blend = format!(r#""alphaMode":"BLEND",{TEXTURE}"#);
    let partial = |sampler| {
        let model = Model::new(left_half(), &blend).with(|model| model.sampler = sampler);
        let study = model.study("", "", 5.0);
        study.truth.expect("a truth")[0]
            .coverage
            .iter()
            .filter(|&&share| share > 0.01 && share < 0.99)
            .count()
    };
    // A texel is four pixels wide: between two of them lies a ramp of four, at either edge of the half.
    assert_eq!(partial(r#"{"magFilter":9728,"minFilter":9728}"#), 0);
    assert!(partial(r#"{"magFilter":9729}"#) >= 4 * 64);
    // From afar a sampler with levels reads the mean, one half, which passes everywhere; one without reads single texels of the
    // checkerboard, of which 2.3 lie in a pixel: half of them pass.
    let far = |sampler| {
        let board = png(|x, y| if (x + y) % 2 == 0 { 255 } else { 0 });
        let model = Model::new(board, &mask).texcoords(&TWICE).with(|model| model.sampler = sampler);
        covered(&model.study("", "", 23.0))[0]
    };
    let mean = far(r#"{"magFilter":9728,"minFilter":9984}"#);
    assert!((mean - QUAD * (5.0_f64 / 23.0).powi(2)).abs() < 0.1 * mean, "{mean}");
    let nearest = far(r#"{"magFilter":9728,"minFilter":9728}"#);
    assert!(nearest > 0.25 * mean && nearest < 0.75 * mean, "{nearest} of {mean}");
}

#[test]
fn strips_and_fans_are_triangles() {
    let of = |mode: u32, indices: &[u16]| {
        Model::opaque(TEXTURE).with(|model| {
            let indices = model.shorts("SCALAR", 1, indices, "");
            model.primitive = format!(r#","indices":{indices},"mode":{mode}"#);
        })
    };
    assert_covers("strip", of(5, &[0, 1, 3, 2]).covers(), [QUAD; 2]);
    assert_covers("fan", of(6, &[0, 1, 2, 3]).covers(), [QUAD; 2]);
    let beside = Model::opaque(TEXTURE).with(|model| {
        let half = model.shorts("SCALAR", 1, &[0, 1, 2], "");
        model.primitive = format!(r#","indices":{half}"#);
        let strip = model.shorts("SCALAR", 1, &[0, 1, 3, 2], "");
        model.more_primitives =
            format!(r#",{{"attributes":{{{}}},"material":0,"indices":{strip},"mode":5}}"#, model.attributes);
    });
    assert_covers("a strip beside a list", beside.covers(), [QUAD; 2]);
    let lines = Model::opaque(TEXTURE).with(|model| {
        model.more_primitives =
            format!(r#",{{"attributes":{{{}}},"material":0,"mode":1}}"#, model.attributes);
    });
    let scene = lines.scene("", "", 5.0).expect("read");
    assert_eq!(scene.notes, ["model.gltf: its points and lines are not drawn"]);
}

#[test]
fn copies_stand_where_their_attributes_say() {
    let copies = Model::opaque(TEXTURE).with(|model| {
        let moves = model.floats("VEC3", 3, &[-2.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
        let scales = model.floats("VEC3", 3, &[1.0, 1.0, 1.0, 2.0, 1.0, 1.0]);
        model.node = format!(
            r#","scale":[0.25,0.25,0.25],"extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":
            {{"TRANSLATION":{moves},"SCALE":{scales}}}}}}}"#
        );
        model.top = r#","extensionsUsed":["EXT_mesh_gpu_instancing"],"extensionsRequired":["EXT_mesh_gpu_instancing"]"#.into();
    });
    // A sixteenth of the quad, and one that is twice as wide.
    assert_covers("two copies", copies.covers(), [3.0 * QUAD / 16.0; 2]);
    let turned = Model::opaque(TEXTURE).with(|model| {
        // A quarter turn about y, as shares of the largest short: edge on.
        let turn = model.shorts("VEC4", 4, &[0, 23_170, 0, 23_170], r#","normalized":true"#);
        // Signed shorts.
        let last = model.accessors.pop().expect("one");
        model.accessors.push(last.replace("5123", "5122"));
        model.node =
            format!(r#","extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{"ROTATION":{turn}}}}}}}"#);
        model.top = r#","extensionsUsed":["EXT_mesh_gpu_instancing"]"#.into();
    });
    assert_covers("edge on", turned.covers(), [0.0; 2]);
}

/// Joints and weights for one or two joints, whose nodes follow the mesh.
fn skinned(weights: [f32; 4], nodes: &'static str, joints: &str) -> Model {
    Model::opaque(TEXTURE).with(|model| {
        let of = model.shorts("VEC4", 4, &[0, 1, 0, 0].repeat(4), "");
        model.names("JOINTS_0", of);
        model.attribute("WEIGHTS_0", "VEC4", &weights.repeat(4));
        model.node = r#","skin":0,"translation":[100,0,0]"#.into();
        model.more_nodes = nodes;
        model.top = format!(r#","skins":[{{"joints":{joints}}}]"#);
    })
}

#[test]
fn skinned_meshes_hang_on_their_joints_and_not_on_their_node() {
    let all = |model: Model| {
        let text = model.text();
        assert!(text.contains(r#""scenes":[{"nodes":[0]}]"#));
        let folder = tempfile::tempdir().expect("a folder");
        model.write(folder.path());
        fs::write(
            folder.path().join("model.gltf"),
            text.replace(r#""scenes":[{"nodes":[0]}]"#, r#""scenes":[{"nodes":[0,1]}]"#),
        )
        .expect("written");
        let text = "name = 's'\nresolution = [128, 128]\n[camera]\neye = [0.0, 0.0, 5.0]\ntarget = [0.0, 0.0, 0.0]\n\
                    half_height = 0.4\n[truth]\nsamples = 4\n[[surface]]\nmesh = { file = 'model.gltf' }\n";
        let scene = prepare(read::read(text, "s.toml").expect("sound"), folder.path()).expect("read");
        let xs = scene.mesh.vertices.iter().map(|vertex| vertex.object.x);
        (covered(&study(&scene, &mut |_, _| ())), xs.fold(f64::NEG_INFINITY, f64::max))
    };
    let one = r#",{"name":"bone"}"#;
    let (covers, right) = all(skinned([1.0, 0.0, 0.0, 0.0], one, "[1]"));
    assert_covers("node far away, joint at the origin", covers, [QUAD; 2]);
    assert_eq!(right, 1.0);
    let two = r#",{"translation":[0.5,0,0],"children":[2]},{"translation":[1,0,0]}"#;
    let (_, right) = all(skinned([0.5, 0.5, 0.0, 0.0], two, "[1,2]"));
    assert_eq!(right, 2.0, "half way between joints at 0.5 and 1.5");
    let (_, right) = all(skinned([0.25, 0.25, 0.0, 0.0], two, "[1,2]"));
    assert_eq!(right, 2.0, "weights that are not 1 together");
}

#[test]
fn morph_targets_move_by_their_weights() {
    let model = Model::opaque(TEXTURE).with(|model| {
        let moves =
            model.floats("VEC3", 3, &[[0.0; 3], [-2.0, 0.0, 0.0], [-2.0, 0.0, 0.0], [0.0; 3]].concat());
        model.primitive += &format!(r#","targets":[{{"POSITION":{moves}}}]"#);
        model.node = r#","weights":[0.5]"#.into();
    });
    assert_covers("half as wide", model.covers(), [QUAD / 2.0; 2]);
}

#[test]
fn backs_are_seen_only_of_what_has_two_sides() {
    let seen = |material: &str, node: &str, eye: f64| {
        let model = Model::opaque(&format!("{material}{TEXTURE}")).with(|model| model.node = node.to_owned());
        covered(&model.study("", "", eye))
    };
    let (both, mirrored) = (r#""doubleSided":true,"#, r#","scale":[-1,1,1]"#);
    for (material, node, eye, expected) in [
        ("", "", 5.0, QUAD),
        ("", "", -5.0, 0.0),
        (both, "", 5.0, QUAD),
        (both, "", -5.0, QUAD),
        ("", mirrored, 5.0, QUAD),
        ("", mirrored, -5.0, 0.0),
    ] {
        assert_covers(&format!("{material} {node} from {eye}"), seen(material, node, eye), [expected; 2]);
    }
    let hidden = r#","extensions":{"KHR_node_visibility":{"visible":false}}"#;
    let model = Model::opaque(TEXTURE).with(|model| model.node = hidden.to_owned());
    assert!(model.scene("", "", 5.0).is_err_and(|error| error.contains("no triangles")));
}

#[test]
fn quantized_positions_are_read() {
    let model = Model::opaque(TEXTURE).with(|model| {
        let bytes: Vec<u8> =
            CORNERS.iter().flat_map(|c| c.map(|x| (127.0 * x) as i8 as u8).into_iter().chain([0])).collect();
        let positions = model.accessor(&bytes, 5120, "VEC3", 4, r#","normalized":true"#);
        let view = model.views.last_mut().expect("one");
        *view = view.replace('}', r#","byteStride":4}"#);
        model.attributes = model.attributes.replace(r#""POSITION":0"#, &format!(r#""POSITION":{positions}"#));
        model.top =
            r#","extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"]"#
                .into();
    });
    assert_covers("bytes", model.covers(), [QUAD; 2]);
}

/// Only the base colour is decoded: whatever else a material names may be of any kind.
#[test]
fn images_that_are_not_used_are_not_read() {
    let model = Model::opaque(&format!(r#"{TEXTURE},"normalTexture":{{"index":1}}"#));
    let text = model.text();
    let changed = text
        .replace(r#""images":[{"uri":"leaf.img"}]"#, r#""images":[{"uri":"leaf.img"},{"uri":"gone.ktx2"}]"#)
        .replace(
            r#"[{"source":0,"sampler":0}]"#,
            r#"[{"source":0,"sampler":0},{"extensions":{"KHR_texture_basisu":{"source":1}}}]"#,
        );
    assert_ne!(text, changed);
    let folder = tempfile::tempdir().expect("a folder");
    model.write(folder.path());
    fs::write(folder.path().join("model.gltf"), changed).expect("written");
    let scene = "name = 's'\n[camera]\neye = [0.0, 0.0, 5.0]\ntarget = [0.0, 0.0, 0.0]\n[[surface]]\nmesh = { file = 'model.gltf' }\n";
    let scene = prepare(read::read(scene, "s.toml").expect("sound"), folder.path()).expect("read");
    assert_eq!(scene.notes, Vec::<String>::new());
}

#[test]
fn webp_is_read_where_its_extension_names_it() {
    let image = RgbaImage::from_fn(16, 16, |x, _| image::Rgba([0, 200, 0, if x < 8 { 255 } else { 0 }]));
    let model =
        Model::new(encoded(&image.into(), ImageFormat::WebP), &format!(r#""alphaMode":"MASK",{TEXTURE}"#));
    let folder = tempfile::tempdir().expect("a folder");
    model.write(folder.path());
    let named =
        model.text().replace(r#"{"source":0,"#, r#"{"extensions":{"EXT_texture_webp":{"source":0}},"#);
    fs::write(folder.path().join("model.gltf"), named).expect("written");
    let text = "name = 's'\nresolution = [128, 128]\n[camera]\neye = [0.0, 0.0, 5.0]\ntarget = [0.0, 0.0, 0.0]\n\
                half_height = 0.4\n[truth]\nsamples = 4\n[[surface]]\nmesh = { file = 'model.gltf' }\n";
    let scene = prepare(read::read(text, "s.toml").expect("sound"), folder.path()).expect("read");
    assert_covers("webp", covered(&study(&scene, &mut |_, _| ())), [QUAD / 2.0; 2]);
}

/// A mask whose mean alpha is not what its test shows: the truth is what the standard says, and that is told.
#[test]
fn a_hashed_threshold_on_a_mask_is_told_to_show_something_else() {
    let model = Model::new(png(|_, _| 77), &format!(r#""alphaMode":"MASK","alphaCutoff":0.25,{TEXTURE}"#));
    let scene = model.scene("", "", 5.0).expect("read");
    let [note] = &scene.notes[..] else { panic!("{:?}", scene.notes) };
    assert!(
        note.contains("material `leaf` is tested at 0.25, which keeps 100 %")
            && note.contains("alpha is 30 %"),
        "{note}"
    );
    let hashed = |study: &Study| study_metrics(study)["hashed"]["coverage"];
    let as_said = study(&scene, &mut |_, _| ());
    assert!((hashed(&as_said) - QUAD * ALPHA).abs() < 0.01, "{}", hashed(&as_said));
    let as_coverage = model.study("", ", alpha_mode = 'blend'", 5.0);
    assert_covers("alpha as coverage", covered(&as_coverage), [0.0, QUAD * ALPHA]);
    let opaque = model.study("", ", alpha_mode = 'opaque'", 5.0);
    assert_covers("opaque", covered(&opaque), [QUAD; 2]);
    // Where both agree, nothing is told.
    let sharp = Model::new(left_half(), &format!(r#""alphaMode":"MASK",{TEXTURE}"#));
    assert_eq!(sharp.scene("", "", 5.0).expect("read").notes, Vec::<String>::new());
}

#[test]
fn a_texture_of_the_scene_stands_in_for_one_material() {
    let texture = "[[texture]]\nname = 'half'\nconstant = { alpha = 0.5 }";
    let model = Model::opaque(TEXTURE);
    // The table of textures stands before the camera.
    let with = |mesh: &str| model.scene(texture, mesh, 5.0);
    let scene = with(", textures = { leaf = 'half' }").expect("read");
    assert_covers("stands in", covered(&study(&scene, &mut |_, _| ())), [QUAD, QUAD / 2.0]);
    let unknown = with(", textures = { bark = 'half' }").map(|_| ()).expect_err("no such material");
    assert!(unknown.contains("no material is called `bark`; its materials are `leaf`"), "{unknown}");
    let unknown = with(", textures = { leaf = 'hal' }").map(|_| ()).expect_err("no such texture");
    assert!(unknown.contains("no texture is called `hal`. Did you mean `half`?"), "{unknown}");
}

#[test]
fn what_cannot_be_drawn_is_refused_in_words() {
    let sound = Model::opaque(TEXTURE);
    let refused = |change: &dyn Fn(&mut Model)| {
        let mut model = Model::opaque(TEXTURE);
        change(&mut model);
        model.scene("", "", 5.0).map(|_| ()).expect_err("refused")
    };
    assert!(sound.scene("", "", 5.0).is_ok());
    let requires = |name: &str| {
        let name = name.to_owned();
        refused(&|model| {
            model.top = format!(r#","extensionsUsed":["{name}"],"extensionsRequired":["{name}"]"#)
        })
    };
    for (name, reason) in [
        ("KHR_draco_mesh_compression", "its numbers are packed (KHR_draco_mesh_compression)"),
        ("EXT_meshopt_compression", "its numbers are packed (EXT_meshopt_compression)"),
        ("ACME_everything", "it cannot be drawn without the extension ACME_everything"),
    ] {
        let message = requires(name);
        assert!(message.contains("model.gltf: ") && message.contains(reason), "{message}");
    }
    for (change, reason) in [
        (r#""material":0"#, "`meshes[0].primitives[0].material` names something that is not there"),
        (r#""type":"VEC3""#, "`accessors[0].type` has a value that the standard does not know"),
        (r#""uri":"data.bin""#, "names buffer 0, %FF.bin, which cannot be read"),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        sound.write(folder.path());
        let to = match change {
            r#""material":0"# => r#""material":7"#,
            r#""type":"VEC3""# => r#""type":"VEC5""#,
            _ => r#""uri":"%FF.bin""#,
        };
        fs::write(folder.path().join("model.gltf"), sound.text().replace(change, to)).expect("written");
        let text = "name = 's'\n[camera]\neye = [0.0, 0.0, 5.0]\ntarget = [0.0, 0.0, 0.0]\n[[surface]]\nmesh = { file = 'model.gltf' }\n";
        let error = prepare(read::read(text, "s.toml").expect("sound"), folder.path())
            .map(|_| ())
            .expect_err("refused");
        let message = std::error::Error::source(&error).expect("a cause").to_string();
        assert!(message.contains(reason), "{message}");
    }
    let packed = refused(&|model| model.image = Some(b"\xabKTX 20\xbb\r\n\x1a\n".to_vec()));
    assert!(
        packed.contains("its texture cannot be used") && packed.contains("no sound KTX2 file"),
        "{packed}"
    );
}

/// What the standard allows and few files have.
#[test]
fn attributes_of_other_tools_and_accessors_of_zeros_are_sound() {
    let custom = Model::opaque(TEXTURE).with(|model| {
        let accessor = model.shorts("SCALAR", 1, &[1, 2, 3, 4], "");
        model.names("_BATCHID", accessor);
    });
    assert_covers("an attribute of another tool", custom.covers(), [QUAD; 2]);
    let zeros = Model::opaque(TEXTURE).with(|model| {
        model.accessors.push(r#"{"componentType":5126,"count":4,"type":"VEC3"}"#.to_owned());
        model.primitive += &format!(r#","targets":[{{"POSITION":{}}}]"#, model.accessors.len() - 1);
        model.node = r#","weights":[1.0]"#.into();
    });
    assert_covers("a target that moves nothing", zeros.covers(), [QUAD; 2]);
}

/// Models that break what readers take for granted: no panic, and a reason.
#[test]
fn hostile_files_are_refused_with_a_reason() {
    let blend = || Model::opaque(&format!(r#""alphaMode":"BLEND",{TEXTURE}"#));
    let short = blend().with(|model| {
        let accessor = model.floats("VEC2", 2, &[0.0; 4]);
        model.attributes =
            model.attributes.replace(r#""TEXCOORD_0":1"#, &format!(r#""TEXCOORD_0":{accessor}"#));
    });
    let nowhere = blend()
        .with(|model| model.attributes = model.attributes.replace(r#""POSITION":0"#, r#""POSITION":99"#));
    let uncounted = blend().with(|model| {
        model.node = r#","extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"_ID":0}}}"#.into();
    });
    for (model, reason) in [
        (short, "mesh 0, primitive 0: it has 2 texture coordinates for 4 vertices"),
        (nowhere, "`meshes[0].primitives[0].attributes` names something that is not there"),
        (uncounted, "the instances of node 0 have none of TRANSLATION, ROTATION and SCALE"),
    ] {
        let message = model.scene("", "", 5.0).map(|_| ()).expect_err(reason);
        assert!(message.contains(reason), "{message}");
    }
    let folder = tempfile::tempdir().expect("a folder");
    let sound = Model::opaque(TEXTURE);
    sound.write(folder.path());
    let written = |bytes: &[u8]| {
        fs::write(folder.path().join("model.gltf"), bytes).expect("written");
        let text = "name = 's'\n[camera]\neye = [0.0, 0.0, 5.0]\ntarget = [0.0, 0.0, 0.0]\n[[surface]]\nmesh = { file = 'model.gltf' }\n";
        let read = prepare(read::read(text, "s.toml").expect("sound"), folder.path());
        read.map(|_| ()).map_err(|error| std::error::Error::source(&error).expect("a cause").to_string())
    };
    let old = sound.text().replace(r#""version":"2.0""#, r#""version":"1.0""#);
    for (bytes, reason) in [
        (&b"glTF\x02\0\0\0\0\0\0\0"[..], "it is a GLB of 12 bytes that says it has 0"),
        (b"glTF\x02\0", "it ends within the header of a GLB"),
        (b"# an OBJ", "it is no glTF file: neither JSON nor GLB"),
        (old.as_bytes(), "it is glTF of version 1.0; 2.0 is read here"),
    ] {
        let message = written(bytes).expect_err(reason);
        assert!(message.contains(reason), "{message}");
    }
    assert_eq!(written(&[&b"\xef\xbb\xbf"[..], sound.text().as_bytes()].concat()), Ok(()));
    // Places that no texture has, and that whole numbers cannot count.
    let far = Model::opaque(TEXTURE).texcoords(&[[0.0, 1e30], [1e30, 1e30], [1e30, -3e38], [0.0, 0.0]]);
    assert_covers("far texture coordinates", far.covers(), [QUAD; 2]);
    let without_levels = far.with(|model| model.sampler = r#"{"minFilter":9729}"#);
    assert!(without_levels.covers().iter().all(|share| share.is_finite()));
    let factor = r#""alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorTexture":{"index":0},"baseColorFactor":[1,1,1,1e30]}"#;
    assert_covers("a factor beyond 1", Model::new(left_half(), factor).covers(), [QUAD / 2.0; 2]);
    let boneless = skinned([0.0; 4], r#",{"name":"bone"}"#, "[]");
    let message = boneless.scene("", "", 5.0).map(|_| ()).expect_err("no joints");
    assert!(message.contains("skin 0 has no joints"), "{message}");
}

#[test]
fn what_is_not_simulated_is_told() {
    let told = |top: &str| {
        let model = Model::opaque(TEXTURE).with(|model| model.top = top.to_owned());
        model.scene("", "", 5.0).expect("read").notes
    };
    let used = |name: &str| told(&format!(r#","extensionsUsed":["{name}"]"#));
    assert_eq!(used("ACME_wind"), ["model.gltf: its extension ACME_wind is not simulated"]);
    assert!(used("KHR_materials_transmission")[0].contains("transmission"));
    for of_light in ["KHR_materials_unlit", "KHR_lights_punctual", "KHR_texture_transform"] {
        assert_eq!(used(of_light), Vec::<String>::new(), "{of_light}");
    }
    let without = Model::opaque(TEXTURE).with(|model| model.attributes = r#""POSITION":0"#.into());
    let notes = without.scene("", "", 5.0).expect("read").notes;
    assert_eq!(notes, ["model.gltf: a material reads TEXCOORD_0, which its mesh has not: (0, 0) is read"]);
    let animated = told(r#","animations":[{"channels":[],"samplers":[]}]"#);
    assert_eq!(animated, ["model.gltf: its animations are not played: it stands as its nodes say"]);
}
