// grass.wgsl: blades as crossed quads

struct Camera {
    view_proj: mat4x4<f32>,
    eye: vec4<f32>,
};

struct Model {
    transform: mat4x4<f32>,
    // scale part alone; the cells' size follows it
    scale: mat3x3<f32>,
};

struct Grass {
    hash_scale: f32,
    bend: f32,
    time: f32,
    pad: f32,
};

@group(0) @binding(0) var<uniform> camera: Camera;
@group(1) @binding(0) var<uniform> model: Model;
@group(1) @binding(1) var<uniform> grass: Grass;
@group(2) @binding(0) var t_blade: texture_2d<f32>;
@group(2) @binding(1) var s_blade: sampler;
@group(2) @binding(2) var t_shadow: texture_depth_2d;
@group(2) @binding(3) var s_shadow: sampler_comparison;

struct VsOut {
    @builtin(position) clip: vec4<f32>,
    @location(0) local: vec3<f32>,
    @location(1) uv: vec2<f32>,
    @location(2) shadow_pos: vec3<f32>,
};

@vertex
fn vs_main(@location(0) pos: vec3<f32>, @location(1) uv: vec2<f32>) -> VsOut {
    var out: VsOut;
    let sway = sin(grass.time + pos.x) * grass.bend * uv.y;
    let world = model.transform * vec4<f32>(pos + vec3<f32>(sway, 0.0, 0.0), 1.0);
    out.clip = camera.view_proj * world;
    out.local = pos;
    out.uv = uv;
    out.shadow_pos = world.xyz;
    return out;
}

fn hash2(v: vec2<f32>) -> f32 {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

fn hash3(v: vec3<f32>) -> f32 {
    return hash2(vec2<f32>(hash2(v.xy), v.z));
}

fn shadow(p: vec3<f32>) -> f32 {
    return textureSampleCompareLevel(t_shadow, s_shadow, p.xy * 0.5 + 0.5, p.z);
}

fn threshold(local: vec3<f32>) -> f32 {
    let p = model.scale * local;
    let d = max(length(dpdx(p)), length(dpdy(p)));
    let s = 1.0 / (grass.hash_scale * d);
    let s0 = exp2(floor(log2(s)));
    let s1 = exp2(ceil(log2(s)));
    let n = vec2<f32>(hash3(floor(s0 * p)), hash3(floor(s1 * p)));
    let k = fract(log2(s));
    let x = mix(n.x, n.y, k);
    let a = min(k, 1.0 - k);
    let cases = vec3<f32>(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)),
    );
    // which piece of the curve
    let tau = select(cases.z, select(cases.y, cases.x, x < k), x < 1.0 - k);
    return clamp(tau, 1e-6, 1.0);
}

@fragment
fn fs_main(in: VsOut) -> @location(0) vec4<f32> {
    let c = textureSample(t_blade, s_blade, in.uv);
    let t = threshold(in.local);
    if (c.a < t) {
        discard;
    }
    let lit = 0.35 + 0.65 * shadow(in.shadow_pos);
    return vec4<f32>(c.rgb * lit, 1.0);
}
