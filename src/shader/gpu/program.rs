//! One WGSL function over many inputs.

use super::device::Context;
use super::{Device, Error};
use std::time::Duration;
use wgpu::{
    BindGroupDescriptor, BindGroupEntry, Buffer, BufferDescriptor, BufferUsages, ComputePassDescriptor,
    ComputePassTimestampWrites, ComputePipelineDescriptor, MapMode, PipelineCompilationOptions,
    QuerySetDescriptor, QueryType, ShaderModuleDescriptor, ShaderSource,
};

/// What every word of the output holds before the shader runs: a signalling NaN, which no arithmetic makes, so that
/// "wrote nothing" is not mistaken for a value.
pub const SENTINEL: u32 = 0x7fba_dbad;

/// The most elements of one dispatch; a time limit counts for each.
pub const LARGEST_CHUNK: usize = 1 << 20;

/// A compute shader that makes one output of each input.
///
/// Binding 0 of group 0 is the input, a read-only storage array; binding 1 the output, a writable one. Invocation i of
/// the entry point reads input i and writes output i, and does nothing beyond the length of the output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Kernel {
    /// The whole WGSL module.
    pub source: String,
    /// Its entry point.
    pub entry_point: String,
    /// Invocations of a workgroup, in one dimension.
    pub workgroup_size: u32,
    /// 32-bit words of one input; 0 for inputs that the shader makes itself out of the first index and a seed.
    pub words_in: usize,
    /// 32-bit words of one output.
    pub words_out: usize,
}

const WORKGROUP_SIZE: u32 = 64;

impl Kernel {
    /// Wraps an expression over `source`, which holds functions and constants but no bindings.
    ///
    /// The expression sees its input as `word(k)` and `number(k)`, the k-th word as `u32` and as `f32`, and makes an
    /// `array<u32, words_out>`.
    #[must_use]
    pub fn of_words(source: &str, words_in: usize, words_out: usize, expression: &str) -> Self {
        let read = format!("given_words[element * {words_in}u + k]");
        Self::wrapped(source, [words_in, words_out], &read, expression)
    }

    /// Wraps an expression as [`Kernel::of_words`] does; its words are not read but drawn: `word(k)` of element i is
    /// [`drawn_word`] of the seed, i and k.
    #[must_use]
    pub fn of_drawn_words(source: &str, words_out: usize, expression: &str) -> Self {
        let draw = "drawn_word(given_words[1], given_words[0] + element, k)";
        let source = format!("{source}\n{}", include_str!("draw.wgsl"));
        Self::wrapped(&source, [0, words_out], draw, expression)
    }

    fn wrapped(source: &str, [words_in, words_out]: [usize; 2], word: &str, expression: &str) -> Self {
        let wrapper = format!(
            "
@group(0) @binding(0) var<storage, read> given_words: array<u32>;
@group(0) @binding(1) var<storage, read_write> made_words: array<u32>;
var<private> element: u32;
fn word(k: u32) -> u32 {{ return {word}; }}
fn number(k: u32) -> f32 {{ return bitcast<f32>(word(k)); }}
@compute @workgroup_size({WORKGROUP_SIZE})
fn every_element(@builtin(global_invocation_id) invocation: vec3u) {{
    element = invocation.x;
    let first = element * {words_out}u;
    if first >= arrayLength(&made_words) {{ return; }}
    var made: array<u32, {words_out}> = {expression};
    for (var k = 0u; k < {words_out}u; k++) {{ made_words[first + k] = made[k]; }}
}}
"
        );
        Self {
            source: format!("{source}\n{wrapper}"),
            entry_point: "every_element".to_owned(),
            workgroup_size: WORKGROUP_SIZE,
            words_in,
            words_out,
        }
    }
}

/// Returns the k-th word of element `index` of the stream `seed`: three rounds of the PCG hash. The same bits as the
/// WGSL function of the same name.
#[must_use]
pub fn drawn_word(seed: u32, index: u32, k: u32) -> u32 {
    use crate::threshold::hash::pcg_nested::pcg;
    pcg(k.wrapping_add(pcg(index.wrapping_add(pcg(seed)))))
}

/// A kernel, compiled for a device.
#[derive(Clone, Debug)]
pub struct Program {
    device: Device,
    index: usize,
    words_in: usize,
    words_out: usize,
    chunk: usize,
    workgroup_size: u32,
}

/// The outputs of elements that the device drew itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drawn {
    /// Those of each element, one behind the other.
    pub words: Vec<u32>,
    /// How long the program ran on the device, without transfers; `None` where the device has no clock.
    pub time: Option<Duration>,
}

impl Device {
    /// Compiles a kernel.
    ///
    /// # Errors
    ///
    /// [`Error::Validation`] for a module that is not valid or has no such entry point, and those of a lost device.
    pub fn compile(&self, kernel: &Kernel) -> Result<Program, Error> {
        let Kernel { source, entry_point, workgroup_size, words_in, words_out } = kernel.clone();
        let index = self.call(move |context| {
            let source = ShaderSource::Wgsl(source.into());
            let module = context.device.create_shader_module(ShaderModuleDescriptor { label: None, source });
            context.programs.push(context.device.create_compute_pipeline(&ComputePipelineDescriptor {
                label: None,
                layout: None,
                module: &module,
                entry_point: Some(&entry_point),
                compilation_options: PipelineCompilationOptions::default(),
                cache: None,
            }));
            Ok(context.programs.len() - 1)
        })?;
        let limits = self.limits();
        let most_bytes = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        let by_bytes = most_bytes / (4 * words_in.max(words_out).max(1) as u64);
        let by_groups = u64::from(limits.max_compute_workgroups_per_dimension) * u64::from(workgroup_size);
        let chunk = by_bytes.min(by_groups).min(LARGEST_CHUNK as u64) as usize;
        Ok(Program { device: self.clone(), index, words_in, words_out, chunk, workgroup_size })
    }
}

impl Program {
    /// Returns the program with dispatches of at most `elements` (at least one, at most the limit of the device).
    #[must_use]
    pub fn with_chunk(mut self, elements: usize) -> Self {
        self.chunk = elements.clamp(1, self.chunk);
        self
    }

    /// Evaluates inputs that stand one behind the other, each of [`Kernel::words_in`] words; the outputs stand in the
    /// same order, whatever the number of dispatches.
    ///
    /// # Errors
    ///
    /// [`Error::NotWritten`] for an element that the shader leaves out, [`Error::TimedOut`] where a dispatch does not
    /// end, [`Error::Validation`] for a number of words that is not a whole number of inputs, and those of a lost device.
    pub fn map(&self, words: &[u32]) -> Result<Vec<u32>, Error> {
        if self.words_in == 0 || !words.len().is_multiple_of(self.words_in) {
            let message = format!("{} words are no inputs of {} each", words.len(), self.words_in);
            return Err(Error::Validation(message));
        }
        let mut outputs = Vec::with_capacity(words.len() / self.words_in * self.words_out);
        for chunk in words.chunks(self.chunk * self.words_in) {
            let first = outputs.len() / self.words_out;
            outputs.extend(self.dispatch(chunk.to_vec(), chunk.len() / self.words_in, first)?.0);
        }
        Ok(outputs)
    }

    /// Evaluates `count` elements that the device draws from the stream `seed`: nothing is sent.
    ///
    /// # Errors
    ///
    /// Those of [`Program::map`]; a kernel that reads inputs draws none.
    pub fn draw(&self, seed: u32, count: u32) -> Result<Drawn, Error> {
        if self.words_in != 0 {
            return Err(Error::Validation("the kernel reads inputs and draws none".to_owned()));
        }
        let mut drawn = Drawn { words: Vec::new(), time: Some(Duration::ZERO) };
        for first in (0..count).step_by(self.chunk) {
            let elements = self.chunk.min((count - first) as usize);
            let (output, time) = self.dispatch(vec![first, seed], elements, first as usize)?;
            drawn.words.extend(output);
            drawn.time = drawn.time.zip(time).map(|(sum, time)| sum + time);
        }
        Ok(drawn)
    }

    /// Runs one chunk; `first` is the index of its first element, for the message.
    fn dispatch(
        &self,
        input: Vec<u32>,
        elements: usize,
        first: usize,
    ) -> Result<(Vec<u32>, Option<Duration>), Error> {
        let (index, words) = (self.index, elements * self.words_out);
        let groups = elements.div_ceil(self.workgroup_size as usize) as u32;
        let has_clock = self.device.has_timestamps();
        let found = self.device.call(move |context| run(context, index, &input, words, groups, has_clock))?;
        let missing = found.0.chunks(self.words_out).position(|o| o.iter().all(|&word| word == SENTINEL));
        match missing {
            Some(element) => Err(Error::NotWritten(first + element)),
            None => Ok(found),
        }
    }
}

/// Sends the input, runs a program and fetches its output.
fn run(
    context: &Context,
    program: usize,
    input: &[u32],
    words_out: usize,
    groups: u32,
    has_clock: bool,
) -> Result<(Vec<u32>, Option<Duration>), Error> {
    let (device, queue) = (&context.device, &context.queue);
    let Some(pipeline) = context.programs.get(program) else {
        return Err(Error::Validation("a program of another device".to_owned()));
    };
    let bytes_out = 4 * words_out as u64;
    let buffer = |size: u64, usage: BufferUsages| {
        device.create_buffer(&BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
    };
    let given = buffer(4 * input.len() as u64, BufferUsages::STORAGE | BufferUsages::COPY_DST);
    queue.write_buffer(&given, 0, bytemuck::cast_slice(input));
    let made = buffer(bytes_out, BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST);
    queue.write_buffer(&made, 0, bytemuck::cast_slice(&vec![SENTINEL; words_out]));
    let fetched = buffer(bytes_out, BufferUsages::MAP_READ | BufferUsages::COPY_DST);

    let bind_group = device.create_bind_group(&BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            BindGroupEntry { binding: 0, resource: given.as_entire_binding() },
            BindGroupEntry { binding: 1, resource: made.as_entire_binding() },
        ],
    });
    let clock = has_clock.then(|| {
        let queries =
            device.create_query_set(&QuerySetDescriptor { label: None, ty: QueryType::Timestamp, count: 2 });
        let resolved = buffer(16, BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC);
        (queries, resolved, buffer(16, BufferUsages::MAP_READ | BufferUsages::COPY_DST))
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let timestamp_writes = clock.as_ref().map(|(queries, ..)| ComputePassTimestampWrites {
            query_set: queries,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        });
        let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor { label: None, timestamp_writes });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &bind_group, &[]);
        pass.dispatch_workgroups(groups, 1, 1);
    }
    encoder.copy_buffer_to_buffer(&made, 0, &fetched, 0, bytes_out);
    if let Some((queries, resolved, read)) = &clock {
        encoder.resolve_query_set(queries, 0..2, resolved, 0);
        encoder.copy_buffer_to_buffer(resolved, 0, read, 0, 16);
    }
    queue.submit([encoder.finish()]);
    let output = fetch(context, &fetched)?;
    let time = match &clock {
        Some((.., read)) => {
            let ticks = fetch(context, read)?;
            let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&ticks);
            let nanoseconds =
                ticks[1].saturating_sub(ticks[0]) as f64 * f64::from(queue.get_timestamp_period());
            Some(Duration::from_nanos(nanoseconds as u64))
        }
        None => None,
    };
    Ok((output, time))
}

/// Waits for a buffer and copies its words.
pub(super) fn fetch(context: &Context, buffer: &Buffer) -> Result<Vec<u32>, Error> {
    buffer.map_async(MapMode::Read, .., |_| {});
    context.wait()?;
    let view = buffer.get_mapped_range(..).map_err(|error| Error::Validation(error.to_string()))?;
    let words = bytemuck::pod_collect_to_vec(&view);
    drop(view);
    buffer.unmap();
    Ok(words)
}
