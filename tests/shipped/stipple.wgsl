//! Stippled transparency for the preview window.
//!
//! Pipeline constants are given by `PipelineCompilationOptions { constants, .. }` on the Rust side; it's
//! `&'static str` keys there, so do not rename what's below.

enable f16;

override hash_scale: f32 = 1.0;
override exposure: f32 = 1.0;
@id(7) override max_lights: u32 = 4u;
override use_shadow: bool = true;

const MIN_THRESHOLD: f32 = 1e-6;
const TAU: f32 = 6.283185307179586;

alias Point = vec3<f32>;

struct Light {
    position: vec3<f32>,
    colour: vec3<f32>,
}

struct Lights {
    count: u32,
    items: array<Light, 16>,
}

@group(0) @binding(0) var<uniform> view_projection: mat4x4<f32>;
@group(0) @binding(1) var<storage, read> lights: Lights;
@group(1) @binding(0) var albedo: texture_2d<f32>;
@group(1) @binding(1) var albedo_sampler: sampler;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) object: vec3<f32>,
    @location(1) world: vec3<f32>,
    @location(2) normal: vec3<f32>,
    @location(3) uv: vec2<f32>,
}

fn hash_plane(v: vec2<f32>) -> f32 {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

fn hash_space(v: Point) -> f32 {
    return hash_plane(vec2(hash_plane(v.xy), v.z));
}

/// Width of one pixel on the object.
fn pixel_width(object: ptr<function, Point>) -> f32 {
    return max(length(dpdx(*object)), length(dpdy(*object)));
}

/// Uniform in (0, 1]; cells of about one pixel.
fn stipple_threshold(object: Point) -> f32 {
    var copy = object;
    let level = log2(1.0 / (hash_scale * pixel_width(&copy)));
    var x = 0.0;
    let blend = fract(level);
    for (var octave = 0u; octave < 2u; octave++) {
        let weight = select(blend, 1.0 - blend, octave == 0u);
        let cells = exp2(floor(level) + f32(octave));
        x += weight * hash_space(floor(cells * object));
    }

    let a = min(blend, 1.0 - blend);
    let rest = 1.0 - a;
    var threshold: f32;
    if x < a {
        threshold = x * x / (2.0 * a * rest);
    } else if x < rest {
        threshold = (x - 0.5 * a) / rest;
    } else {
        threshold = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * rest);
    }
    return clamp(threshold, MIN_THRESHOLD, 1.0);
}

fn shade(world: Point, normal: vec3<f32>) -> vec3<f32> {
    var sum = vec3<f32>(0.05);
    for (var i = 0u; i < min(lights.count, max_lights); i++) {
        let to = lights.items[i].position - world;
        sum += lights.items[i].colour * max(dot(normal, normalize(to)), 0.0) / max(dot(to, to), 1e-3);
    }
    return sum * exposure;
}

@fragment
fn fs_stipple(in: Varyings) -> @location(0) vec4<f32> {
    let texel = textureSample(albedo, albedo_sampler, in.uv);
    let threshold = stipple_threshold(in.object);
    if texel.a < threshold {
        discard;
    }
    return vec4<f32>(texel.rgb * shade(in.world, normalize(in.normal)), 1.0);
}
