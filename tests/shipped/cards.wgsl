// Impostor cards: feathers, fur shells, hedges.
//
// The G-buffer is written by a compute rasterizer as well, which has no derivatives; hence dx and dy are arguments all the
// way down.

enable f16;

struct CardMaterial {
    albedo_factor: vec4<f32>,
    noise_px: f32,
    normal_strength: f32,
    shell_count: u32,
    _unused: u32,
}

struct CardVarying {
    @builtin(position) frag_coord: vec4<f32>,
    @location(0) card_position: vec3<f32>,
    @location(1) world_normal: vec3<f32>,
    @location(2) texcoord: vec2<f32>,
}

@group(1) @binding(0) var<uniform> material: CardMaterial;
@group(1) @binding(1) var card_albedo: texture_2d<f32>;
@group(1) @binding(2) var card_sampler: sampler;
@group(2) @binding(0) var<uniform> sun: array<vec4<f32>, 2>;

fn pcg(v: u32) -> u32 {
    let state = v * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

fn cell_to_unit(cell: vec3<i32>) -> f32 {
    let u = bitcast<vec3<u32>>(cell);
    let h = pcg(u.x + pcg(u.y + pcg(u.z)));
    return f32(h >> 8u) / 16777216.0;
}

fn grid(local: vec3<f32>, exponent: f32) -> vec3<i32> {
    return vec3<i32>(floor(local * exp2(exponent)));
}

struct Blend {
    x: f32,
    smaller: f32,
}

fn blend_octaves(local: vec3<f32>, footprint: f32) -> Blend {
    let exponent = -log2(footprint);
    let lower = floor(exponent);
    let part = exponent - lower;
    return Blend(
        mix(cell_to_unit(grid(local, lower)), cell_to_unit(grid(local, lower + 1.0)), part),
        min(part, 1.0 - part),
    );
}

fn cutoff_from_position(local: vec3<f32>, dx: vec3<f32>, dy: vec3<f32>) -> f32 {
    let footprint = material.noise_px * max(length(dx), length(dy));
    let b = blend_octaves(local, footprint);
    let big = 1.0 - b.smaller;
    let area = 2.0 * b.smaller * big;

    var tau: f32;
    let segment = u32(b.x >= b.smaller) + u32(b.x >= big);
    switch segment {
        case 0u: { tau = b.x * b.x / area; }
        case 1u: { tau = (b.x - 0.5 * b.smaller) / big; }
        default: {
            let rest = 1.0 - b.x;
            tau = 1.0 - rest * rest / area;
        }
    }
    return clamp(tau, 1.0e-6, 1.0);
}

fn encode_normal(n: vec3<f32>) -> vec2<f32> {
    let s = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    let folded = (1.0 - abs(s.yx)) * select(vec2<f32>(-1.0), vec2<f32>(1.0), s >= vec2<f32>(0.0));
    return select(folded, s, n.z >= 0.0);
}

fn to_half(c: vec3<f32>) -> vec3<f16> {
    return vec3<f16>(c);
}

struct GBuffer {
    @location(0) albedo: vec4<f32>,
    @location(1) normal: vec2<f32>,
}

@fragment
fn main(v: CardVarying) -> GBuffer {
    let texel = textureSample(card_albedo, card_sampler, v.texcoord) * material.albedo_factor;
    let cutoff = cutoff_from_position(v.card_position, dpdx(v.card_position), dpdy(v.card_position));
    if (texel.a < cutoff) {
        discard;
    }
    let ndl = max(dot(normalize(v.world_normal), sun[0].xyz), 0.0);
    let rgb = to_half(texel.rgb * (sun[1].rgb * ndl + 0.2));
    return GBuffer(vec4<f32>(vec3<f32>(rgb), 1.0), encode_normal(normalize(v.world_normal)));
}
