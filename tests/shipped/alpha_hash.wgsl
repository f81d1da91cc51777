// Forward pass for alpha hashed meshes. Bind groups: 0 frame, 1 material, 2 object.

struct Frame {
    view_proj: mat4x4f,
    eye: vec3f,
    time: f32,
    jitter: vec2f,
    index: u32,          // only the resolve pass looks at it
    light_count: u32,
}

struct Light {
    position_or_dir: vec4f,
    color: vec4f,
}

struct Material {
    base_color: vec4f,
    emissive: vec3f,
    roughness: f32,
    hash_scale: f32,
    cutoff: f32,
    flags: u32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> lights: array<Light>;
@group(1) @binding(0) var<uniform> material: Material;
@group(1) @binding(1) var base_texture: texture_2d<f32>;
@group(1) @binding(2) var base_sampler: sampler;
@group(2) @binding(0) var<uniform> model: mat4x4f;

const FLAG_ALPHA_HASH: u32 = 1u << 3u;
const PI = 3.14159265;

struct Vertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
}

struct Varyings {
    @builtin(position) clip: vec4f,
    @location(0) local: vec3f,
    @location(1) world: vec3f,
    @location(2) normal: vec3f,
    @location(3) uv: vec2f,
}

@vertex
fn vs_main(v: Vertex) -> Varyings {
    var out: Varyings;
    let world = model * vec4f(v.position, 1.0);
    out.clip = frame.view_proj * world;
    out.local = v.position;
    out.world = world.xyz;
    out.normal = (model * vec4f(v.normal, 0.0)).xyz;
    out.uv = v.uv;
    return out;
}

fn pcg3d(seed: vec3u) -> vec3u {
    var v = seed * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3u(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

fn cell_noise(cell: vec3f) -> f32 {
    let h = pcg3d(bitcast<vec3u>(vec3i(cell)));
    return f32(h.z >> 8u) * 0x1p-24f;
}

fn hashed_threshold(p: vec3f) -> f32 {
    let deriv = max(length(dpdx(p)), length(dpdy(p)));
    let pix_scale = 1.0 / (material.hash_scale * deriv);
    let level = log2(pix_scale);

    let n0 = cell_noise(floor(p * exp2(floor(level))));
    let n1 = cell_noise(floor(p * exp2(ceil(level))));
    let w = fract(level);
    let x = mix(n0, n1, w);

    let a = min(w, 1.0 - w);
    var tau = (x - 0.5 * a) / (1.0 - a);
    tau = select(tau, x * x / (2.0 * a * (1.0 - a)), x < a);
    tau = select(tau, 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)), x >= 1.0 - a);
    return clamp(tau, 1e-6, 1.0);
}

fn ggx(n_dot_h: f32, roughness: f32) -> f32 {
    let a2 = roughness * roughness * roughness * roughness;
    let d = n_dot_h * n_dot_h * (a2 - 1.0) + 1.0;
    return a2 / (PI * d * d);
}

fn shade(albedo: vec3f, n: vec3f, world: vec3f) -> vec3f {
    let v = normalize(frame.eye - world);
    var sum = material.emissive + albedo * 0.03;
    for (var i = 0u; i < frame.light_count; i++) {
        let light = lights[i];
        let l = normalize(light.position_or_dir.xyz - world * light.position_or_dir.w);
        let h = normalize(l + v);
        let n_dot_l = max(dot(n, l), 0.0);
        sum += light.color.rgb * n_dot_l * (albedo / PI + ggx(max(dot(n, h), 0.0), material.roughness) * 0.04);
    }
    return sum;
}

@fragment
fn fs_main(in: Varyings, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let base = textureSample(base_texture, base_sampler, in.uv) * material.base_color;
    let hashed = hashed_threshold(in.local);   // outside of the branch, or the validator complains
    let cutoff = select(material.cutoff, hashed, (material.flags & FLAG_ALPHA_HASH) != 0u);
    if (base.a < cutoff) {
        discard;
    }

    let n = normalize(select(-in.normal, in.normal, front));
    let lit = shade(base.rgb, n, in.world);
    return vec4f(lit / (1.0 + lit), 1.0);
}
