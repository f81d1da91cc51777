// Stippled depth prepass + shading for ghosted parts in the CAD view.
// Overrides are set by PartRenderer::rebuild_pipelines().

@id(0) override HASH_SCALE: f32 = 1.0;
@id(1) override ENABLE_STIPPLE: bool = true;
@id(2) override EXPOSURE: f32 = 1.0;
@id(3) override SAMPLE_COUNT: u32 = 1u;

struct Camera {
    view: mat4x4<f32>,
    proj: mat4x4<f32>,
    position: vec4<f32>,
    viewport: vec4<f32>,
}

struct Part {
    transform: mat4x4<f32>,
    color: vec4<f32>,
    id: u32,
    selected: u32,
    opacity: f32,
}

@group(0) @binding(0) var<uniform> camera: Camera;
@group(1) @binding(0) var<uniform> part: Part;
@group(1) @binding(1) var t_decal: texture_2d<f32>;
@group(1) @binding(2) var s_decal: sampler;
@group(2) @binding(0) var t_matcap: texture_2d<f32>;
@group(2) @binding(1) var s_matcap: sampler;

struct VertexOut {
    @builtin(position) clip_position: vec4<f32>,
    @location(0) local_pos: vec3<f32>,
    @location(1) view_normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    @location(3) @interpolate(flat) part_id: u32,
}

struct FragmentOut {
    @location(0) color: vec4<f32>,
    @location(1) id: u32,
}

fn hash_plane(v: vec2<f32>) -> f32 {
    let s = sin(17.0 * v.x + 0.1 * v.y);
    let t = sin(13.0 * v.y + v.x);
    return fract(1.0e4 * s * (0.1 + abs(t)));
}

fn hash_cell(v: vec3<f32>) -> f32 { return hash_plane(vec2<f32>(hash_plane(v.xy), v.z)); }

fn stipple_threshold(pos: vec3<f32>) -> f32 {
    let max_deriv = max(length(dpdx(pos)), length(dpdy(pos)));
    let pix_scale = 1.0 / (HASH_SCALE * max_deriv);
    let l = log2(pix_scale);

    let coarse = hash_cell(floor(exp2(floor(l)) * pos));
    let fine = hash_cell(floor(exp2(ceil(l)) * pos));
    let t = fract(l);
    let x = (1.0 - t) * coarse + t * fine;

    // CDF of the interpolated noise, so that every opacity keeps its coverage
    let a = min(t, 1.0 - t);
    if (x < a) {
        return x * x / (2.0 * a * (1.0 - a));
    }
    if (x < 1.0 - a) {
        return (x - 0.5 * a) / (1.0 - a);
    }
    return 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
}

fn matcap(n: vec3<f32>) -> vec3<f32> {
    return textureSampleLevel(t_matcap, s_matcap, n.xy * vec2<f32>(0.49, -0.49) + 0.5, 0.0).rgb;
}

fn selection_tint(color: vec3<f32>) -> vec3<f32> {
    return select(color, mix(color, vec3<f32>(1.0, 0.55, 0.1), 0.5), part.selected != 0u);
}

@fragment
fn fs_stipple(in: VertexOut) -> FragmentOut {
    let decal = textureSample(t_decal, s_decal, in.uv);
    let base = vec4<f32>(mix(part.color.rgb, decal.rgb, decal.a), part.opacity * max(part.color.a, decal.a));

    if (ENABLE_STIPPLE) {
        if (base.a < stipple_threshold(in.local_pos)) { discard; }
    }

    let n = normalize(in.view_normal);
    var out: FragmentOut;
    out.color = vec4<f32>(selection_tint(base.rgb * matcap(n)) * EXPOSURE, 1.0);
    out.id = in.part_id;
    return out;
}

@fragment
fn fs_id(in: VertexOut) -> @location(0) u32 {
    return in.part_id;
}
