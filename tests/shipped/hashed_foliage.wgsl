#define_import_path meadow::hashed_foliage

#import bevy_pbr::{
    forward_io::{VertexOutput, FragmentOutput},
    mesh_view_bindings::{view, globals},
    pbr_functions::{
        alpha_discard,
        apply_pbr_lighting,
    },
    pbr_fragment::pbr_input_from_standard_material,
}
#import meadow::wind::sway

#ifdef PREPASS_PIPELINE
#import bevy_pbr::prepass_io::PrepassOutput
#endif

struct HashedFoliage {
    tint: vec4<f32>,
    hash_scale: f32,
#ifdef SIXTEEN_BYTE_ALIGNMENT
    _padding: vec3<f32>,
#endif
}

struct FoliageVertexOutput {
    @builtin(position) clip_position: vec4<f32>,
    @location(0) local_position: vec3<f32>,
    @location(1) world_normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
}

@group(#{MATERIAL_BIND_GROUP}) @binding(0) var<uniform> material: HashedFoliage;
@group(#{MATERIAL_BIND_GROUP}) @binding(1) var leaf_texture: texture_2d<f32>;
@group(#{MATERIAL_BIND_GROUP}) @binding(2) var leaf_sampler: sampler;

fn pcg3d(seed: vec3<u32>) -> vec3<u32> {
    var v = seed * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3<u32>(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

fn cell_noise(cell: vec3<i32>) -> f32 {
    return f32(pcg3d(bitcast<vec3<u32>>(cell)).x >> 8u) * 0x1p-24;
}

fn uniform_of_blend(x: f32, f: f32) -> f32 {
    let a = min(f, 1.0 - f);
    let q = 2.0 * a * (1.0 - a);
    if x < a {
        return x * x / q;
    }
    if x < 1.0 - a {
        return (x - 0.5 * a) / (1.0 - a);
    }
    return 1.0 - (1.0 - x) * (1.0 - x) / q;
}

@fragment
fn fragment(in: FoliageVertexOutput) -> @location(0) vec4<f32> {
    let color = textureSample(leaf_texture, leaf_sampler, in.uv) * material.tint;

    let p = in.local_position;
    let width = max(length(dpdx(p)), length(dpdy(p)));
    let level = log2(1.0 / (material.hash_scale * width));
    let coarse = cell_noise(vec3<i32>(floor(p * exp2(floor(level)))));
    let fine = cell_noise(vec3<i32>(floor(p * exp2(ceil(level)))));
    let f = fract(level);
    let t = clamp(uniform_of_blend(mix(coarse, fine, f), f), 1e-6, 1.0);
    if color.a < t {
        discard;
    }

#ifdef TONEMAP_IN_SHADER
    let lit = tone_mapping(vec4(color.rgb, 1.0), view.color_grading);
    return lit;
#else
    let n = normalize(in.world_normal);
    return vec4<f32>(color.rgb * (0.4 + 0.6 * max(n.y, 0.0)), 1.0);
#endif
}
