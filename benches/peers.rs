//! Listing 1 in C, compiled by gcc and clang with `-Ofast -march=native` and a vector math library, and in WGSL on every
//! device, beside our batch.
//!
//! The same footprints, in turns; what is missing is skipped with a message. A peer is as exact as a tier of ours where as
//! many of its thresholds have the bits of the reference. A device draws its footprints itself, of a similar law, and is
//! timed by its own clock; lavapipe and SwiftShader run on all cores, and so a line of ours on all threads stands beside.

// Its results are what a reader of the terminal wants.
#![allow(clippy::print_stdout)]

use hashed_alpha::cost::clock::{Contender, race};
use hashed_alpha::cost::pool::{Pool, SLICE, WIDE};
use hashed_alpha::threshold::batch::{Batch, Tier};
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::two_scale::Variant;
use std::fs;
use std::path::Path;
use std::process::Command;

#[cfg(feature = "gpu")]
#[path = "peers/device.rs"]
mod device;

const ROUNDS: usize = 320;
const TURNS: usize = 5;
const SLICES: usize = 32;

/// Compilers with their flags.
const PEERS: [(&str, &[&str]); 4] = [
    ("gcc", &["-Ofast", "-march=native"]),
    ("gcc", &["-Ofast", "-march=native", "-mprefer-vector-width=512"]),
    ("clang", &["-Ofast", "-march=native", "-fveclib=libmvec"]),
    ("clang-19", &["-Ofast", "-march=native", "-fveclib=libmvec"]),
];

fn main() {
    // `cargo test --benches` calls a bench without this; nothing is to be tested here.
    if !std::env::args().any(|argument| argument == "--bench") {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let pool = Pool::<f32>::new(WIDE, SLICES);
    let columns = folder.path().join("columns");
    write_columns(&pool, &columns);
    let listing = HashedAlpha {
        variant: Variant::Isotropic,
        hash: HashKind::Sine,
        hash_scale: 1.0,
        form: CdfForm::Literal,
    };
    let reference: Vec<f32> =
        pool.footprints(0).iter().map(|footprint| listing.threshold(footprint)).collect();
    #[cfg(feature = "gpu")]
    let devices = device::Contestant::all(listing.hash);
    let peers: Vec<_> = PEERS.iter().filter_map(|peer| built(peer, folder.path())).collect();
    let batches = Tier::ALL.map(|tier| Batch { tier, ..Batch::new(listing) });
    for turn in 1..=TURNS {
        println!(
            "turn {turn}: nanoseconds a threshold, fastest and middle round; thresholds with the bits of the reference"
        );
        for batch in batches {
            let mut out = vec![0.0; SLICE];
            batch.thresholds(&pool.columns(0), &mut out);
            let equal = equal_share(&out, &reference);
            let run = |slice| {
                batch.thresholds(&pool.columns(slice), &mut out);
                f64::from(out[0])
            };
            let touch = Box::new(|slice| pool.touch_columns(slice));
            let times = race(&mut [Contender { items: SLICE, run: Box::new(run), touch }], ROUNDS, || ());
            println!(
                "  {:6.2} {:6.2}  {equal:.4}  ours, {}, {}",
                times[0].min, times[0].median, batch.tier, batch.isa
            );
        }
        #[cfg(feature = "gpu")]
        device::race(&devices, &batches, &pool);
        for (name, program) in &peers {
            let thresholds = folder.path().join("thresholds");
            let output = Command::new(program).args([&columns, &thresholds]).arg(ROUNDS.to_string()).output();
            let text = String::from_utf8(output.expect("it was just built").stdout).expect("numbers");
            let bytes = fs::read(&thresholds).expect("it was just written");
            let out: Vec<f32> =
                bytes.as_chunks().0.iter().map(|&number| f32::from_le_bytes(number)).collect();
            let times: Vec<f64> = text.split_whitespace().filter_map(|time| time.parse().ok()).collect();
            println!("  {:6.2} {:6.2}  {:.4}  {name}", times[0], times[1], equal_share(&out, &reference));
        }
    }
}

fn equal_share(found: &[f32], reference: &[f32]) -> f64 {
    let equal = found.iter().zip(reference).filter(|(a, b)| a.to_bits() == b.to_bits()).count();
    equal as f64 / reference.len() as f64
}

/// Writes slice by slice, column by column.
fn write_columns(pool: &Pool<f32>, path: &Path) {
    let mut bytes = Vec::new();
    for slice in 0..SLICES {
        let columns = pool.columns(slice);
        for column in [columns.position, columns.dpdx, columns.dpdy].iter().flatten() {
            bytes.extend(column.iter().flat_map(|x| x.to_le_bytes()));
        }
    }
    fs::write(path, bytes).expect("room for the columns");
}

/// Compiles the listing, or says why not.
fn built((compiler, flags): &(&str, &[&str]), folder: &Path) -> Option<(String, std::path::PathBuf)> {
    let name = format!("{compiler} {}", flags.join(" "));
    let program = folder.join(name.replace(' ', "_"));
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers/listing.c");
    let output = Command::new(compiler).args(*flags).arg(source).arg("-o").arg(&program).arg("-lm").output();
    match output {
        Err(error) => {
            println!("skipped: {name}: {error}");
            None
        }
        Ok(output) if !output.status.success() => {
            println!(
                "skipped: {name}: {}",
                String::from_utf8_lossy(&output.stderr).lines().next().unwrap_or_default()
            );
            None
        }
        Ok(_) => Some((name, program)),
    }
}
