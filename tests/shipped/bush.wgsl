// bush.wgsl: undergrowth, drawn indirectly (see cull_bushes.wgsl for where `visible` comes from)

struct Globals {
    clip_from_world: mat4x4f,
    camera: vec3f,
    elapsed: f32,
    sun: vec3f,
    frame_index: u32,
    fog_color: vec3f,
    fog_density: f32,
}

struct Bush {
    position: vec3f,
    size: f32,
    hue: f32,
    sway: f32,
}

var<push_constant> lod: u32;

@group(0) @binding(0) var<uniform> globals: Globals;
@group(0) @binding(1) var<storage, read> bushes: array<Bush>;
@group(0) @binding(2) var<storage, read> visible: array<u32>;
@group(0) @binding(3) var leaf_atlas: texture_2d_array<f32>;
@group(0) @binding(4) var leaf_sampler: sampler;

const NOISE_SCALE: f32 = 1.0;

struct Interpolated {
    @builtin(position) clip: vec4f,
    @location(0) object: vec3f,
    @location(1) world: vec3f,
    @location(2) uv: vec2f,
    @location(3) @interpolate(flat) bush: u32,
}

@vertex
fn vertex_main(
    @builtin(instance_index) instance: u32,
    @location(0) position: vec3f,
    @location(1) uv: vec2f,
) -> Interpolated {
    let index = visible[instance];
    let bush = bushes[index];
    let phase = globals.elapsed * 1.7 + bush.position.x;
    let bent = position + vec3f(sin(phase), 0.0, cos(phase * 0.7)) * bush.sway * position.y;

    var o: Interpolated;
    o.object = position;
    o.world = bush.position + bent * bush.size;
    o.clip = globals.clip_from_world * vec4f(o.world, 1.0);
    o.uv = uv;
    o.bush = index;
    return o;
}

fn noise(p: vec3f) -> f32 {
    let q = fract(1e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
    return fract(1e4 * sin(17.0 * q + 0.1 * p.z) * (0.1 + abs(sin(13.0 * p.z + q))));
}

fn cdf(x: f32, a: f32) -> f32 {
    let b = 1.0 - a;
    var y = 1.0 - 0.5 * (1.0 - x) * (1.0 - x) / (a * b);
    if x < a {
        y = 0.5 * x * x / (a * b);
    } else if x < b {
        y = (x - 0.5 * a) / b;
    }
    return y;
}

/// `true` where nothing is to be drawn
fn should_discard(alpha: f32, pos: vec3f) -> bool {
    let d_dx = dpdx(pos);
    let d_dy = dpdx(pos);
    let scale = 1.0 / (NOISE_SCALE * max(length(d_dx), length(d_dy)));

    let octave = log2(scale);
    let s0 = exp2(floor(octave));
    let s1 = exp2(ceil(octave));
    let t = fract(octave);

    let x = mix(noise(floor(s0 * pos)), noise(floor(s1 * pos)), t);
    let tau = clamp(cdf(x, min(t, 1.0 - t)), 1e-6, 1.0);
    return alpha < tau;
}

fn hue_shift(c: vec3f, h: f32) -> vec3f {
    let k = vec3f(0.57735);
    return c * cos(h) + cross(k, c) * sin(h) + k * dot(k, c) * (1.0 - cos(h));
}

@fragment
fn fragment_main(in: Interpolated) -> @location(0) vec4f {
    let leaf = textureSample(leaf_atlas, leaf_sampler, in.uv, lod);
    let gone = should_discard(leaf.a, in.object);
    if gone {
        discard;
    }

    let c = hue_shift(leaf.rgb, bushes[in.bush].hue);
    let n = normalize(in.object * vec3f(1.0, 0.6, 1.0));     // there aren't any normals, a ball will do
    let lit = c * (0.3 + 0.7 * max(dot(n, globals.sun), 0.0));

    let d = distance(globals.camera, in.world) * globals.fog_density;
    return vec4f(mix(globals.fog_color, lit, exp(-d * d)), 1.0);
}
