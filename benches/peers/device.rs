//! Listing 1 in WGSL on the devices of this machine.

use hashed_alpha::cost::pool::Pool;
use hashed_alpha::shader::assemble::assemble;
use hashed_alpha::shader::gpu::adapter::{Adapter, adapters};
use hashed_alpha::shader::gpu::{Choice, Device, Kernel, Program};
use hashed_alpha::threshold::batch::{Batch, ColumnBuffer};
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::pipeline::Pipeline;
use hashed_alpha::threshold::two_scale::Variant;
use std::time::{Duration, Instant};

const THRESHOLDS: u32 = 1 << 20;
const ROUNDS: u32 = 8;

/// Draws the inputs of a threshold on the device.
const FOOTPRINT: &str = include_str!("../drawn_footprint.wgsl");

/// Reads every input and does next to nothing with it.
const INPUTS_ALONE: &str = "
fn threshold(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>) -> f32 {
    return dot(position, dpdx) + dpdy.x + dpdy.y + dpdy.z;
}
";

/// A device with the listing, and with what draws its inputs.
pub struct Contestant {
    name: String,
    listing: Program,
    inputs: Program,
}

impl Contestant {
    /// Opens every device; one that does not answer is left out with a message.
    pub fn all(hash: HashKind) -> Vec<Self> {
        let options = Pipeline::listing(Variant::Isotropic).with_hash(hash);
        let listing = assemble(options).expect("a hash scale of 1 can be written");
        let names: Vec<String> = adapters().iter().map(Adapter::name).collect();
        if names.is_empty() {
            println!("skipped: devices: there is no driver");
        }
        let open = |name: String| {
            let opened = Device::open(&Choice::Name(name.clone())).and_then(|device| {
                let program = |source: &str| {
                    let source = format!("{source}{FOOTPRINT}");
                    let made = "array(bitcast<u32>(drawn_threshold()))";
                    device.compile(&Kernel::of_drawn_words(&source, 1, made))
                };
                Ok((program(&listing)?, program(INPUTS_ALONE)?))
            });
            match opened {
                Ok((listing, inputs)) => Some(Self { name, listing, inputs }),
                Err(error) => {
                    println!("skipped: {name}: {error}");
                    None
                }
            }
        };
        names.into_iter().filter_map(open).collect()
    }
}

/// Prints the fastest and the middle round of every device, and of each of ours on all threads.
pub fn race(contestants: &[Contestant], batches: &[Batch], pool: &Pool<f32>) {
    let footprints = pool.footprints(0).iter().copied().cycle().take(THRESHOLDS as usize);
    let columns: ColumnBuffer<f32> = footprints.collect();
    let mut out = vec![0.0; columns.columns().len()];
    let line = |what: &str, mut run: Box<dyn FnMut(u32) -> Duration + '_>| {
        let mut times: Vec<_> = (0..ROUNDS).map(&mut run).collect();
        times.sort_unstable();
        let nanoseconds = |time: Duration| time.as_secs_f64() * 1e9 / f64::from(THRESHOLDS);
        println!(
            "  {:6.2} {:6.2}          {what}",
            nanoseconds(times[0]),
            nanoseconds(times[times.len() / 2])
        );
    };
    for batch in batches {
        line(
            &format!("ours, {}, {}, {} threads", batch.tier, batch.isa, rayon::current_num_threads()),
            Box::new(|_| {
                let start = Instant::now();
                batch.par_thresholds(&columns.columns(), &mut out);
                start.elapsed()
            }),
        );
    }
    for Contestant { name, listing, inputs } in contestants {
        for (what, program) in [("Listing 1", listing), ("of which inputs", inputs)] {
            line(
                &format!("{what}, {name}"),
                Box::new(|round| {
                    let start = Instant::now();
                    let drawn = program.draw(round, THRESHOLDS).expect("the device answers");
                    drawn.time.unwrap_or_else(|| start.elapsed())
                }),
            );
        }
    }
}
