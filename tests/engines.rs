//! `docs/engines.md` and `examples/engines`: the threshold in the files of engines, ready to paste. Each is written by this test
//! (`HASHED_ALPHA_BLESS=all cargo test --test main engines::`), and each is put on trial as it stands.

use hashed_alpha::check::shaders;
use hashed_alpha::scene::{Fragment, Scene};
use hashed_alpha::shader::export::{Language, export};
use hashed_alpha::shader::interpreter::DeviceModel;
use hashed_alpha::shader::own::{self, Options};
use hashed_alpha::threshold::robust::Robust;
use hashed_alpha::threshold::two_scale::Variant;
use std::fmt::Write as _;
use std::path::Path;

/// An engine, and its file: `before`, the exported text, `after`.
struct Engine {
    name: &'static str,
    file: &'static str,
    language: Language,
    before: &'static str,
    after: &'static str,
    /// The function on trial; empty where it goes without saying.
    function: &'static str,
    /// Where it goes in the engine.
    place: &'static str,
}

const ENGINES: [Engine; 9] = [
    Engine {
        name: "three.js",
        file: "three.js",
        language: Language::GlslEs,
        before: "export const hashedAlpha = /* glsl */`\n",
        after: "
void testHashedAlpha(float alpha, vec3 position) {
    if (alpha < threshold(position, dFdx(position), dFdy(position))) discard;
}
`;

export function useHashedAlpha(material) {
    material.onBeforeCompile = (shader) => {
        shader.vertexShader = 'varying vec3 vObject;\\n' + shader.vertexShader
            .replace('#include <begin_vertex>', '#include <begin_vertex>\\nvObject = position;');
        shader.fragmentShader = 'varying vec3 vObject;\\n' + hashedAlpha + shader.fragmentShader
            .replace('#include <alphatest_fragment>', 'testHashedAlpha(diffuseColor.a, vObject);');
    };
    return material;
}
",
        function: "testHashedAlpha",
        place: "`useHashedAlpha(new MeshStandardMaterial({ map }))` in the place of `alphaHash: true`, whose threshold is that of \
                Listing 1 with noise of 0.05 pixels. Skinned and morphed meshes are tested at their rest position, which is what \
                keeps the noise on the surface",
    },
    Engine {
        name: "Babylon.js",
        file: "babylon.ts",
        language: Language::GlslEs,
        before: "import { MaterialPluginBase, ShaderStore } from '@babylonjs/core';\n\nShaderStore.IncludesShadersStore['hashedAlpha'] = `\n",
        after: "
void testHashedAlpha(float alpha, vec3 position) {
    if (alpha < threshold(position, dFdx(position), dFdy(position))) discard;
}
`;

export class HashedAlphaPlugin extends MaterialPluginBase {
    constructor(material) {
        super(material, 'HashedAlpha', 200, {});
        this._enable(true);
    }
    getCustomCode(stage) {
        return stage === 'vertex'
            ? { CUSTOM_VERTEX_DEFINITIONS: 'varying vec3 vObject;', CUSTOM_VERTEX_UPDATE_POSITION: 'vObject = positionUpdated;' }
            : { CUSTOM_FRAGMENT_DEFINITIONS: 'varying vec3 vObject;\\n#include<hashedAlpha>',
                CUSTOM_FRAGMENT_UPDATE_ALPHA: 'testHashedAlpha(alpha, vObject);' };
    }
}
",
        function: "testHashedAlpha",
        place: "`new HashedAlphaPlugin(material)`, with `material.transparencyMode` left opaque",
    },
    Engine {
        name: "Godot 4",
        file: "godot.gdshader",
        language: Language::GlslEs,
        before: "shader_type spatial;\nrender_mode cull_disabled;\n\nuniform sampler2D albedo_texture : source_color;\nvarying vec3 object_position;\n\n",
        after: "
void vertex() {
    object_position = VERTEX;
}

void fragment() {
    vec4 albedo = texture(albedo_texture, UV);
    if (albedo.a < threshold(object_position, dFdx(object_position), dFdy(object_position))) discard;
    ALBEDO = albedo.rgb;
}
",
        function: "fragment",
        place: "a `ShaderMaterial`; `dFdy` points down the screen there, which does not matter here",
    },
    Engine {
        name: "Bevy",
        file: "bevy.wgsl",
        language: Language::Wgsl,
        before: "#import bevy_pbr::{\n    pbr_fragment::pbr_input_from_standard_material,\n    pbr_functions::apply_pbr_lighting,\n    forward_io::{FragmentOutput},\n}\n\n",
        after: "
struct HashedVertexOutput {
    @builtin(position) position: vec4<f32>,
    @location(0) world_position: vec4<f32>,
    @location(1) world_normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    @location(8) local_position: vec3<f32>,
}

@fragment
fn fragment(in: HashedVertexOutput, @builtin(front_facing) is_front: bool) -> FragmentOutput {
    var input = pbr_input_from_standard_material(in, is_front);
    let alpha = input.material.base_color.a;
    if alpha < threshold(in.local_position, dpdx(in.local_position), dpdy(in.local_position)) {
        discard;
    }
    var out: FragmentOutput;
    out.color = apply_pbr_lighting(input);
    return out;
}
",
        function: "fragment",
        place: "the fragment shader of a `MaterialExtension`, whose vertex shader hands on the position before the model's matrix",
    },
    Engine {
        name: "Unity",
        file: "unity.hlsl",
        language: Language::Hlsl,
        before: "",
        after: "
// A Custom Function node of Shader Graph, whose output goes to Alpha Clip Threshold.
void HashedAlpha_float(float3 Position, out float Threshold)
{
    Threshold = threshold(Position, ddx(Position), ddy(Position));
}

// By hand, in a fragment program.
void ClipHashedAlpha(float alpha, float3 positionOS)
{
    clip(alpha - threshold(positionOS, ddx(positionOS), ddy(positionOS)));
}
",
        function: "ClipHashedAlpha",
        place: "a Custom Function node of that file and the name `HashedAlpha`, with the Position node in object space as its input; or \
                `ClipHashedAlpha` in a shader of your own",
    },
    Engine {
        name: "Unreal",
        file: "unreal.hlsl",
        language: Language::Hlsl,
        before: "",
        after: "
float HashedOpacityMask(float opacity, float3 localPosition)
{
    return opacity < threshold(localPosition, ddx(localPosition), ddy(localPosition)) ? 0.0 : 1.0;
}
",
        function: "HashedOpacityMask",
        place: "a file `.ush` of the project's shader folder, which a Custom node names under Include File Paths; its code is `return \
                HashedOpacityMask(Opacity, Position);`, Position is Local Position, and the result goes to Opacity Mask with a clip \
                value of 0.5",
    },
    Engine {
        name: "Filament",
        file: "filament.fs",
        language: Language::GlslEs,
        before: "",
        after: "
void applyHashedAlpha(inout vec4 baseColor, vec3 position) {
    baseColor.a = baseColor.a < threshold(position, dFdx(position), dFdy(position)) ? 0.0 : 1.0;
}
",
        function: "applyHashedAlpha",
        place: "the `fragment` block of a material with `blending : masked`; `material()` calls \
                `applyHashedAlpha(material.baseColor, variable_object.xyz)` behind `prepareMaterial`, where the variable `object` is \
                set to `getPosition()` in the `vertex` block",
    },
    Engine {
        name: "Blender",
        file: "blender.py",
        language: Language::Glsl,
        before: "import gpu\n\nHASHED_ALPHA = \"\"\"\n",
        after: "
bool is_kept(float alpha, vec3 position) {
    return alpha >= threshold(position, dFdx(position), dFdy(position));
}
\"\"\"


def shader(info: gpu.types.GPUShaderCreateInfo, fragment: str) -> gpu.types.GPUShader:
    \"\"\"Compiles a fragment program that may call is_kept(alpha, position).\"\"\"
    info.fragment_source(HASHED_ALPHA + fragment)
    return gpu.shader.create_from_info(info)
",
        function: "is_kept",
        place: "an add-on that draws with the module `gpu`; EEVEE has a hashed alpha of its own, which a material chooses",
    },
    Engine {
        name: "wgpu",
        file: "wgpu.wgsl",
        language: Language::Wgsl,
        before: "",
        after: "
struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) object_position: vec3<f32>,
    @location(1) uv: vec2<f32>,
}

@group(0) @binding(0) var albedo: texture_2d<f32>;
@group(0) @binding(1) var albedo_sampler: sampler;

@fragment
fn fs_main(in: Varyings) -> @location(0) vec4<f32> {
    let dx = dpdx(in.object_position);
    let dy = dpdy(in.object_position);
    let color = textureSample(albedo, albedo_sampler, in.uv);
    if color.a < threshold(in.object_position, dx, dy) {
        discard;
    }
    return vec4<f32>(color.rgb, 1.0);
}
",
        function: "fs_main",
        place: "the fragment shader; derivatives and the sample are taken before the test, where control flow is still uniform",
    },
];

fn folder() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/engines"))
}

impl Engine {
    /// The whole file.
    fn text(&self) -> String {
        let exported = export(Robust::default(), self.language).unwrap().into_bytes();
        let exported = String::from_utf8(exported).unwrap();
        // An engine says these itself.
        let is_own = |line: &&str| !line.starts_with("#version") && !line.starts_with("precision ");
        let exported: Vec<_> = exported.lines().filter(is_own).collect();
        format!("{}{}\n{}", self.before, exported.join("\n").trim(), self.after)
    }
}

const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/engines.md");

fn page(read: &[(&Engine, Option<own::OwnShader>)]) -> String {
    let mut page = "# In your engine

Each file of [examples/engines](../examples/engines) is ready to paste: the [recommended threshold](recommendation.md) as `hashed-alpha shader` writes it, with the test that an
engine wants behind it. They are written and tried by a test of this repository, as they stand; the engines themselves do not
run there. Another one (`--variant anisotropic`, a hash, the size of the noise) is written by `hashed-alpha shader`, in the same
languages, and takes the place of everything above the test.

The command is the same for what you have there today, in your own words: name your function, or `main`, and what holds the
position ([your shader](your_shader.md)). For a port of a listing say `--suite paper`; for another
threshold than ours say `--nested-phase` and `--join` where they hold, as the first lines of ours do.

"
    .to_owned();
    for (engine, shader) in read {
        let Engine { name, file, function, place, after, .. } = engine;
        let fence = match engine.language {
            Language::Wgsl => "wgsl",
            Language::Hlsl => "hlsl",
            _ => "glsl",
        };
        let said: Vec<_> = shader
            .iter()
            .flat_map(|shader| {
                shader.taken.iter().map(ToString::to_string).chain(shader.notes.iter().cloned())
            })
            .collect();
        let said =
            if said.is_empty() { "every name goes without saying".to_owned() } else { said.join("; ") };
        write!(
            page,
            "## {name}\n\n```text\nhashed-alpha check examples/engines/{file} --function {function}\n```\n\n\
             Where it goes: {place}. What the program takes for what: {said}.\n\nBehind the threshold, [{file}](../examples/engines/{file}) has\n\n\
             ```{fence}\n{}\n```\n\n",
            after.trim()
        )
        .unwrap();
    }
    format!("{}\n", page.trim_end())
}

#[test]
fn every_file_is_written_and_has_the_recommended_thresholds() {
    let is_blessing = std::env::var_os("HASHED_ALPHA_BLESS").is_some();
    let mut read = Vec::new();
    for engine in &ENGINES {
        let path = folder().join(engine.file);
        if is_blessing {
            std::fs::create_dir_all(folder()).unwrap();
            std::fs::write(&path, engine.text()).unwrap();
        }
        assert_eq!(
            std::fs::read_to_string(&path).unwrap(),
            engine.text(),
            "{}: HASHED_ALPHA_BLESS=all",
            engine.file
        );
        let options = Options { function: engine.function.to_owned(), ..Options::default() };
        let shader = match own::read(&path, &options) {
            Ok(shader) => Some(shader),
            Err(error) if error.message.contains("glslangValidator") => None,
            Err(error) => panic!("{error}"),
        };
        if let Some(shader) = &shader {
            let subject =
                shaders::interpreted(engine.file, shader, DeviceModel::ACCURATE, Variant::Isotropic).unwrap();
            let fragments: Vec<Fragment> = Scene::all()[0]
                .footprints()
                .step_by(61)
                .map(|f| Fragment::from(f.cast::<f32>().cast()))
                .collect();
            let found = subject.thresholds(&fragments);
            let is_other = |(fragment, found): &(&Fragment, &f64)| {
                let ours = Robust::default().threshold::<f32>(&fragment.footprint.cast()).expect("finite");
                // A test of an alpha is halved to its threshold.
                found.is_nan() || (f64::from(ours) - **found).abs() > 1.0e-6
            };
            assert!(found.len() > 1000, "{}", found.len());
            let others = fragments.iter().zip(&found).filter(is_other).count();
            assert_eq!(others, 0, "{}: of {} thresholds", engine.file, found.len());
        }
        read.push((engine, shader));
    }
    // Without the compiler of HLSL the page cannot say what it takes for what.
    if read.iter().all(|(_, shader)| shader.is_some()) {
        if is_blessing {
            std::fs::write(PAGE, page(&read)).unwrap();
        }
        assert_eq!(std::fs::read_to_string(PAGE).unwrap(), page(&read), "HASHED_ALPHA_BLESS=all");
    }
    let files = std::fs::read_dir(folder()).unwrap().count();
    assert_eq!(files, ENGINES.len(), "files of examples/engines");
}
