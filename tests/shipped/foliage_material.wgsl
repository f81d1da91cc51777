#define_import_path jungle::foliage

#import bevy_pbr::{
    mesh_view_bindings::{view, globals, lights},
    mesh_functions,
    pbr_fragment::pbr_input_from_standard_material,
    pbr_functions::{alpha_discard, apply_pbr_lighting, main_pass_post_lighting_processing},
    pbr_types::STANDARD_MATERIAL_FLAGS_UNLIT_BIT,
    view_transformations::position_world_to_clip,
}
#ifdef SKINNED
#import bevy_pbr::skinning
#endif

#ifdef PREPASS_PIPELINE
#import bevy_pbr::prepass_io::{VertexOutput, FragmentOutput}
#else
#import bevy_pbr::forward_io::{Vertex, FragmentOutput}
#endif

const GOLDEN: f32 = 0.61803399;
const MIN_THRESHOLD: f32 = 1e-6;

struct FoliageMaterial {
    tint: vec4<f32>,
    wind: vec4<f32>,
    hash_scale: f32,
    translucency: f32,
    flags: u32,
    _pad: f32,
}

@group(2) @binding(100) var<uniform> foliage: FoliageMaterial;
@group(2) @binding(101) var albedo_texture: texture_2d<f32>;
@group(2) @binding(102) var albedo_sampler: sampler;

struct FoliageVarying {
    @builtin(position) position: vec4<f32>,
    @location(0) world_position: vec4<f32>,
    @location(1) world_normal: vec3<f32>,
#ifdef VERTEX_UVS_A
    @location(2) uv: vec2<f32>,
#endif
    @location(6) @interpolate(flat) instance_index: u32,
    @location(7) local_position: vec3<f32>,
}

fn noise2(p: vec2<f32>) -> f32 {
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

fn noise3(p: vec3<f32>) -> f32 {
    return noise2(vec2<f32>(noise2(p.xy), p.z));
}

// Coverage threshold of a point of the surface.
fn hashed_threshold(p: vec3<f32>) -> f32 {
    let ddx = dpdx(p);
    let ddy = dpdx(p);
    let max_deriv = max(length(ddx), length(ddy));
    let pix_scale = 1.0 / (foliage.hash_scale * max_deriv);

    let level = log2(pix_scale);
    let scales = vec2<f32>(exp2(floor(level)), exp2(ceil(level)));
    let alpha = vec2<f32>(noise3(floor(scales.x * p)), noise3(floor(scales.y * p)));
    let lerp_factor = fract(level);

    let x = mix(alpha.x, alpha.y, lerp_factor);
    let a = min(lerp_factor, 1.0 - lerp_factor);
    let cases = vec3<f32>(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))),
    );
    let inner = select(cases.y, cases.x, x < a);
    let at = select(cases.z, inner, x < 1.0 - a);
    return clamp(at, MIN_THRESHOLD, 1.0);
}

#ifndef PREPASS_PIPELINE
@vertex
fn vertex(vertex: Vertex) -> FoliageVarying {
    var out: FoliageVarying;
#ifdef SKINNED
    var model = skinning::skin_model(vertex.joint_indices, vertex.joint_weights);
#else
    var model = mesh_functions::get_world_from_local(vertex.instance_index);
#endif
    let sway = sin(globals.time * foliage.wind.w + dot(vertex.position, foliage.wind.xyz)) * 0.05 * vertex.position.y;
    out.local_position = vertex.position;
    out.world_position = mesh_functions::mesh_position_local_to_world(model, vec4<f32>(vertex.position + vec3<f32>(sway, 0.0, 0.0), 1.0));
    out.position = position_world_to_clip(out.world_position.xyz);
    out.world_normal = mesh_functions::mesh_normal_local_to_world(vertex.normal, vertex.instance_index);
#ifdef VERTEX_UVS_A
    out.uv = vertex.uv;
#endif
    out.instance_index = vertex.instance_index;
    return out;
}
#endif

fn translucent(normal: vec3<f32>) -> vec3<f32> {
    var sum = vec3<f32>(0.0);
    for (var i: u32 = 0u; i < lights.n_directional_lights; i = i + 1u) {
        let l = lights.directional_lights[i];
        sum += max(dot(-normal, l.direction_to_light), 0.0) * l.color.rgb;
    }
    return sum * foliage.translucency;
}

@fragment
fn fragment(in: FoliageVarying, @builtin(front_facing) is_front: bool) -> FragmentOutput {
    let albedo = textureSample(albedo_texture, albedo_sampler, in.uv) * foliage.tint;
    let threshold = hashed_threshold(in.local_position);
    if albedo.a < threshold {
        discard;
    }

    var out: FragmentOutput;
#ifdef PREPASS_PIPELINE
    out.normal = vec4<f32>(in.world_normal * 0.5 + 0.5, 1.0);
#else
    var pbr_input = pbr_input_from_standard_material(in, is_front);
    pbr_input.material.base_color = vec4<f32>(albedo.rgb, 1.0);
    if (pbr_input.material.flags & STANDARD_MATERIAL_FLAGS_UNLIT_BIT) == 0u {
        out.color = apply_pbr_lighting(pbr_input);
        out.color = vec4<f32>(out.color.rgb + translucent(in.world_normal), 1.0);
    } else {
        out.color = pbr_input.material.base_color;
    }
    out.color = main_pass_post_lighting_processing(pbr_input, out.color);
#endif
    return out;
}
