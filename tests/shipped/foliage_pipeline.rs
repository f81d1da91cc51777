//! Pipeline for foliage: instanced cards with hashed coverage.

use bytemuck::{Pod, Zeroable};
use wgpu::util::DeviceExt;

/// Uniforms of the fragment stage.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct FoliageUniforms {
    pub tint: [f32; 4],
    pub sun_direction: [f32; 3],
    pub hash_scale: f32,
}

const SHADER: &str = r#"
struct Camera {
    view_proj: mat4x4<f32>,
    eye: vec3<f32>,
    time: f32,
}

struct Foliage {
    tint: vec4<f32>,
    sun_direction: vec3<f32>,
    hash_scale: f32,
}

@group(0) @binding(0) var<uniform> camera: Camera;
@group(1) @binding(0) var<uniform> foliage: Foliage;
@group(1) @binding(1) var leaf: texture_2d<f32>;
@group(1) @binding(2) var leaf_sampler: sampler;

struct VertexIn {
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    @location(3) offset: vec3<f32>,
}

struct VertexOut {
    @builtin(position) clip: vec4<f32>,
    @location(0) local: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
}

@vertex
fn vs_main(in: VertexIn) -> VertexOut {
    var out: VertexOut;
    let sway = sin(camera.time + in.offset.x) * 0.05 * in.position.y;
    let world = in.position + in.offset + vec3<f32>(sway, 0.0, 0.0);
    out.clip = camera.view_proj * vec4<f32>(world, 1.0);
    out.local = in.position;
    out.normal = in.normal;
    out.uv = in.uv;
    return out;
}

fn hash2(p: vec2<f32>) -> f32 {
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

fn hash3(p: vec3<f32>) -> f32 {
    return hash2(vec2<f32>(hash2(p.xy), p.z));
}

fn coverage_threshold(p: vec3<f32>) -> f32 {
    let d = max(length(dpdx(p)), length(dpdy(p)));
    let level = log2(1.0 / (foliage.hash_scale * d));
    let lo = hash3(floor(exp2(floor(level)) * p));
    let hi = hash3(floor(exp2(ceil(level)) * p));
    let t = fract(level);
    let x = mix(lo, hi, t);
    let a = min(t, 1.0 - t);
    var threshold = 0.0;
    if x < a {
        threshold = x * x / (2.0 * a * (1.0 - a));
    } else if x < 1.0 - a {
        threshold = (x - a) / (1.0 - a);
    } else {
        threshold = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    }
    return clamp(threshold, 1e-6, 1.0);
}

@fragment
fn fs_main(in: VertexOut, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let color = textureSample(leaf, leaf_sampler, in.uv) * foliage.tint;
    let keep = color.a >= coverage_threshold(in.local);
    if !keep {
        discard;
    }
    let n = normalize(select(-in.normal, in.normal, front));
    let light = 0.2 + 0.8 * max(dot(n, foliage.sun_direction), 0.0);
    return vec4<f32>(color.rgb * light, 1.0);
}
"#;

pub struct FoliagePipeline {
    pipeline: wgpu::RenderPipeline,
    uniforms: wgpu::Buffer,
}

impl FoliagePipeline {
    pub fn new(device: &wgpu::Device, layout: &wgpu::PipelineLayout, format: wgpu::TextureFormat) -> Self {
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("foliage"),
            source: wgpu::ShaderSource::Wgsl(SHADER.into()),
        });
        let uniforms = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("foliage uniforms"),
            contents: bytemuck::bytes_of(&FoliageUniforms { tint: [1.0; 4], sun_direction: [0.0, 1.0, 0.0], hash_scale: 1.0 }),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        });
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("foliage"),
            layout: Some(layout),
            vertex: wgpu::VertexState { module: &module, entry_point: Some("vs_main"), buffers: &[], compilation_options: Default::default() },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fs_main"),
                targets: &[Some(format.into())],
                compilation_options: Default::default(),
            }),
            primitive: wgpu::PrimitiveState { cull_mode: None, ..Default::default() },
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            multiview: None,
            cache: None,
        });
        Self { pipeline, uniforms }
    }
}
