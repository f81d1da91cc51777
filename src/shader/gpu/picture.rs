//! The second way to a threshold: a drawn picture, with positions as the device's rasteriser interpolates them and with
//! its own `dpdx` and `dpdy`.

use super::device::Context;
use super::program::fetch;
use super::{Device, Error};
use crate::scene::{Camera, Rectangle};
use crate::threshold::footprint::Footprint;
use core::fmt::Write as _;
use glam::{DVec3, Vec3};
use wgpu::{
    BufferDescriptor, BufferUsages, Color, CommandEncoderDescriptor, Extent3d, FragmentState, LoadOp,
    MultisampleState, Operations, PipelineCompilationOptions, PrimitiveState, RenderPassColorAttachment,
    RenderPassDescriptor, RenderPipelineDescriptor, ShaderModuleDescriptor, ShaderSource, StoreOp,
    TexelCopyBufferInfo, TexelCopyBufferLayout, TextureDescriptor, TextureDimension, TextureFormat,
    TextureUsages, VertexState,
};

/// A pixel that a device has drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel {
    /// Column and row, from the upper left corner.
    pub place: [u32; 2],
    /// The interpolated position and the device's derivatives of it.
    pub footprint: Footprint<f32>,
    /// What the fragment shader made of them.
    pub threshold: f32,
}

/// What is nearer than this along the optical axis is cut off, in object units.
const NEAR: f64 = 1.0 / 64.0;

/// Draws a rectangle and returns its pixels, row by row.
///
/// `source` is WGSL text with `fn threshold(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>) -> f32`, as
/// [`assemble`](crate::shader::assemble::assemble) writes it for a fixed hash scale. Corners are projected in `f64` and
/// rounded once.
///
/// # Errors
///
/// [`Error::Validation`] for text that is not valid and for an image that the device cannot draw; [`Error::TimedOut`],
/// and those of a lost device.
pub fn draw(
    device: &Device,
    source: &str,
    camera: &Camera,
    rectangle: &Rectangle,
) -> Result<Vec<Pixel>, Error> {
    let [width, height] = camera.resolution;
    let layer = |value: &str| {
        let text = text(source, camera, rectangle, value);
        device.call(move |context| draw_layer(context, text, width, height))
    };
    // Three pictures of four numbers: more at once is beyond what every device can write for one pixel.
    let places = layer("vec4<f32>(position, threshold(position, dx, dy))")?;
    let (along_x, along_y) = (layer("vec4<f32>(dx, 1.0)")?, layer("vec4<f32>(dy, 1.0)")?);
    let vector = |texel: &[f32]| Vec3::new(texel[0], texel[1], texel[2]);
    let texels = places.chunks_exact(4).zip(along_x.chunks_exact(4)).zip(along_y.chunks_exact(4));
    let is_covered = |texel: &[f32]| texel[3] == 1.0;
    Ok((0..height)
        .flat_map(|y| (0..width).map(move |x| [x, y]))
        .zip(texels)
        .filter(|(_, ((_, dx), _))| is_covered(dx))
        .map(|(place, ((position, dx), dy))| Pixel {
            place,
            footprint: Footprint { position: vector(position), dpdx: vector(dx), dpdy: vector(dy) },
            threshold: position[3],
        })
        .collect())
}

/// The shader: corners as constants, and `value` as the colour.
fn text(source: &str, camera: &Camera, rectangle: &Rectangle, value: &str) -> String {
    let (u, v) = (rectangle.half_u, rectangle.half_v);
    let [a, b, c, d] = [-u - v, u - v, u + v, v - u].map(|offset| rectangle.centre + offset);
    let (mut clip, mut positions) = (String::new(), String::new());
    for corner in [a, b, c, a, c, d] {
        let Vec3 { x, y, z } = corner.as_vec3();
        let [clip_x, clip_y, clip_z, clip_w] = projected(camera, corner);
        // Writing to a string cannot fail; the shortest decimal form of a float is read back as that float.
        let _ = write!(positions, "vec3<f32>({x:?}, {y:?}, {z:?}), ");
        let _ = write!(clip, "vec4<f32>({clip_x:?}, {clip_y:?}, {clip_z:?}, {clip_w:?}), ");
    }
    format!(
        "{source}
struct Corner {{
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
}}
@vertex
fn each_corner(@builtin(vertex_index) index: u32) -> Corner {{
    var clip = array<vec4<f32>, 6>({clip});
    var positions = array<vec3<f32>, 6>({positions});
    return Corner(clip[index], positions[index]);
}}
@fragment
fn each_pixel(@location(0) position: vec3<f32>) -> @location(0) vec4<u32> {{
    let dx = dpdx(position);
    let dy = dpdy(position);
    return bitcast<vec4<u32>>({value});
}}
"
    )
}

/// Clip coordinates of a point.
fn projected(camera: &Camera, point: DVec3) -> [f32; 4] {
    let to = point - camera.eye;
    let depth = to.dot(camera.forward);
    let along = |turn: DVec3, pixels: f64| 2.0 * to.dot(turn) / (turn.length_squared() * pixels);
    let size = camera.size();
    let x = along(camera.direction_dx, size.x);
    let y = -along(camera.direction_dy, size.y);
    [x, y, depth - NEAR, depth].map(|c| c as f32)
}

/// Draws one picture of four numbers a pixel.
fn draw_layer(context: &Context, text: String, width: u32, height: u32) -> Result<Vec<f32>, Error> {
    // Not every device draws floats; all draw words.
    const FORMAT: TextureFormat = TextureFormat::Rgba32Uint;
    let (device, queue) = (&context.device, &context.queue);
    let source = ShaderSource::Wgsl(text.into());
    let module = device.create_shader_module(ShaderModuleDescriptor { label: None, source });
    let pipeline = device.create_render_pipeline(&RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: VertexState {
            module: &module,
            entry_point: Some("each_corner"),
            compilation_options: PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: PrimitiveState::default(),
        depth_stencil: None,
        multisample: MultisampleState::default(),
        fragment: Some(FragmentState {
            module: &module,
            entry_point: Some("each_pixel"),
            compilation_options: PipelineCompilationOptions::default(),
            targets: &[Some(FORMAT.into())],
        }),
        multiview_mask: None,
        cache: None,
    });
    let size = Extent3d { width, height, depth_or_array_layers: 1 };
    let texture = device.create_texture(&TextureDescriptor {
        label: None,
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: TextureDimension::D2,
        format: FORMAT,
        usage: TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
    let mut encoder = device.create_command_encoder(&CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_render_pass(&RenderPassDescriptor {
            label: None,
            color_attachments: &[Some(RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: Operations { load: LoadOp::Clear(Color::TRANSPARENT), store: StoreOp::Store },
            })],
            depth_stencil_attachment: None,
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_pipeline(&pipeline);
        pass.draw(0..6, 0..1);
    }
    let bytes_per_row = (16 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let fetched = device.create_buffer(&BufferDescriptor {
        label: None,
        size: u64::from(bytes_per_row) * u64::from(height),
        usage: BufferUsages::MAP_READ | BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let layout =
        TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(bytes_per_row), rows_per_image: None };
    let target = TexelCopyBufferInfo { buffer: &fetched, layout };
    encoder.copy_texture_to_buffer(texture.as_image_copy(), target, size);
    queue.submit([encoder.finish()]);
    let words = fetch(context, &fetched)?;
    let rows = words.chunks(bytes_per_row as usize / 4);
    Ok(rows.flat_map(|row| row[..4 * width as usize].iter().map(|&word| f32::from_bits(word))).collect())
}
