#import bevy_pbr::{
    pbr_fragment::pbr_input_from_standard_material,
    pbr_functions::alpha_discard,
}

#ifdef PREPASS_PIPELINE
#import bevy_pbr::{
    prepass_io::{VertexOutput, FragmentOutput},
    pbr_deferred_functions::deferred_output,
}
#else
#import bevy_pbr::{
    forward_io::{VertexOutput, FragmentOutput},
    pbr_functions::{apply_pbr_lighting, main_pass_post_lighting_processing},
}
#endif

struct HashedFoliage {
    hash_scale: f32,
    tint_strength: f32,
#ifdef SIXTEEN_BYTE_ALIGNMENT
    _webgl2_padding: vec2<f32>,
#endif
}

@group(#{MATERIAL_BIND_GROUP}) @binding(100)
var<uniform> foliage: HashedFoliage;

fn hash2(v: vec2<f32>) -> f32 {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

fn hash3(v: vec3<f32>) -> f32 {
    return hash2(vec2<f32>(hash2(v.xy), v.z));
}

@fragment
fn fragment(
    in: VertexOutput,
    @builtin(front_facing) is_front: bool,
) -> FragmentOutput {
    var pbr_input = pbr_input_from_standard_material(in, is_front);
    let p = in.world_position.xyz;

    let max_deriv = max(length(dpdx(p)), length(dpdy(p)));
    let pix_scale = 1.0 / (foliage.hash_scale * max_deriv);
    let level = log2(pix_scale);
    let scales = exp2(vec2<f32>(floor(level), ceil(level)));
    let h = vec2<f32>(hash3(floor(scales.x * p)), hash3(floor(scales.y * p)));
    let f = fract(level);
    let x = mix(h.x, h.y, f);
    let a = min(f, 1.0 - f);
    let low = x * x / (2.0 * a * (1.0 - a));
    let mid = (x - 0.5 * a) / (1.0 - a);
    let high = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    let picked = select(high, select(mid, low, x < a), x < 1.0 - a);
    let cutoff = clamp(picked, 1.0e-6, 1.0);
    if pbr_input.material.base_color.a < cutoff {
        discard;
    }
    pbr_input.material.base_color.a = 1.0;

#ifdef PREPASS_PIPELINE
    let out = deferred_output(in, pbr_input);
#else
    var out: FragmentOutput;
    out.color = apply_pbr_lighting(pbr_input);
    out.color = main_pass_post_lighting_processing(pbr_input, out.color);
#endif
    return out;
}
