#define_import_path canopy::alpha_hash

#import bevy_pbr::{
    pbr_fragment::pbr_input_from_standard_material,
    pbr_functions::alpha_discard,
    mesh_functions,
    mesh_view_bindings::{view, globals},
}

#ifdef PREPASS_PIPELINE
#import bevy_pbr::{
    prepass_io::{FragmentOutput},
    pbr_deferred_functions::deferred_output,
}
#else
#import bevy_pbr::{
    forward_io::{FragmentOutput},
    pbr_functions,
    pbr_functions::{apply_pbr_lighting, main_pass_post_lighting_processing},
    pbr_types::STANDARD_MATERIAL_FLAGS_UNLIT_BIT,
}
#endif

#ifdef CANOPY_WIND
#import canopy::wind::{bend, WindSettings}
#endif

struct HashedAlpha {
    scale: f32,
    fade: f32,
#ifdef SIXTEEN_BYTE_ALIGNMENT
    // WebGL2 structs must be 16 byte aligned.
    _padding: vec2<f32>,
#endif
}

struct CanopyVertexOutput {
    @builtin(position) position: vec4<f32>,
    @location(0) world_position: vec4<f32>,
    @location(1) world_normal: vec3<f32>,
#ifdef VERTEX_UVS_A
    @location(2) uv: vec2<f32>,
#endif
    @location(8) local_position: vec3<f32>,
#ifdef VERTEX_OUTPUT_INSTANCE_INDEX
    @location(9) @interpolate(flat) instance_index: u32,
#endif
}

@group(#{MATERIAL_BIND_GROUP}) @binding(100) var<uniform> hashed: HashedAlpha;

const MIN_THRESHOLD: f32 = 1e-6;

fn hash2(p: vec2<f32>) -> f32 {
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

fn hash3(p: vec3<f32>) -> f32 {
    return hash2(vec2<f32>(hash2(p.xy), p.z));
}

// The distribution of a blend of two uniform random numbers, where `a` is the smaller weight.
fn blend_cdf(x: f32, a: f32) -> f32 {
    if x < a {
        return x * x / (2.0 * a * (1.0 - a));
    } else if x < 1.0 - a {
        return (x - 0.5 * a) / (1.0 - a);
    }
    return 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
}

// Drops the fragment with a probability of 1 - alpha. Has to be called from uniform control flow.
fn alpha_hash_discard(alpha: f32, local_position: vec3<f32>) {
    let dx = length(dpdx(local_position));
    let dy = length(dpdy(local_position));
    let octave = log2(1.0 / (hashed.scale * max(dx, dy)));

    let below = hash3(floor(exp2(floor(octave)) * local_position));
    let above = hash3(floor(exp2(ceil(octave)) * local_position));
    let w = fract(octave);
    let threshold = clamp(blend_cdf(mix(below, above, w), min(w, 1.0 - w)), MIN_THRESHOLD, 1.0);

    if alpha < threshold {
        discard;
    }
}

@fragment
fn fragment(
    in: CanopyVertexOutput,
    @builtin(front_facing) is_front: bool,
) -> FragmentOutput {
    var pbr_input = pbr_input_from_standard_material(in, is_front);

    alpha_hash_discard(pbr_input.material.base_color.a * hashed.fade, in.local_position);
    pbr_input.material.base_color.a = 1.0;

#ifdef PREPASS_PIPELINE
    let out = deferred_output(in, pbr_input);
#else
    var out: FragmentOutput;
    if (pbr_input.material.flags & STANDARD_MATERIAL_FLAGS_UNLIT_BIT) == 0u {
        out.color = apply_pbr_lighting(pbr_input);
    } else {
        out.color = pbr_input.material.base_color;
    }
    out.color = main_pass_post_lighting_processing(pbr_input, out.color);
#endif

    return out;
}
