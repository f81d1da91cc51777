//! `compare`: two subjects side by side.

use super::args::CompareArgs;
use super::failure::Failure;
use super::subjects::{self, Asked, Family, Place};
use super::{Ending, drivers, output, shader_files};
use hashed_alpha::check::compare::{Agreement, compare};
use hashed_alpha::check::{Draw, Subject};
use std::io::Write;

/// Compares every subject of the first name with its counterpart of the second.
pub fn run(args: &CompareArgs) -> Result<Ending, Failure> {
    shader_files::refuse_strays(&[&args.first, &args.second], &args.shader)?;
    for typed in [&args.first, &args.second] {
        drivers::silence_for(std::slice::from_ref(typed), &args.shader);
    }
    let [left, right] = [&args.first, &args.second]
        .map(|typed| subjects::subjects(std::slice::from_ref(typed), &args.shader));
    let (left, right) = (left?, right?);
    let pairs = pairs(&left, &right);
    if pairs.is_empty() {
        return Err(Failure::Usage(format!(
            "{} and {} have no variant and precision in common",
            args.first, args.second
        )));
    }
    let draw = Draw { seed: args.seed, budget: args.budget, ..Draw::default() };
    let mut results = output::results();
    let mut ending = Ending::Consistent;
    for [a, b] in pairs {
        let line = match compare(a, b, &draw) {
            Ok(found) => {
                if found.agreement == Agreement::DifferentLaws {
                    ending = Ending::Rejected;
                }
                found.to_string()
            }
            Err(reason) => {
                ending = if ending == Ending::Rejected { ending } else { Ending::NoVerdict };
                format!("unavailable: {reason}")
            }
        };
        writeln!(results, "{} and {} in {}: {line}", a.name, b.name, a.precision).map_err(Failure::Output)?;
    }
    let is_our_hash = |asked: &Asked| (asked.place, asked.family) == (Place::Device, Some(Family::Robust));
    if left.iter().chain(&right).any(is_our_hash)
        && let Some(line) = hashes(args)
    {
        writeln!(results, "{line}").map_err(Failure::Output)?;
    }
    results.flush().map_err(Failure::Output)?;
    Ok(ending)
}

/// How many bits of the integer hash, which every robust threshold rests on, are the same on the device as in Rust: a line,
/// or none without a device.
#[cfg(feature = "gpu")]
fn hashes(args: &CompareArgs) -> Option<String> {
    use hashed_alpha::shader::gpu::{Choice, Device, parity};
    use hashed_alpha::threshold::robust::Robust;
    const CELLS: u32 = 1 << 17;
    let name = format!("hash {}", Robust::default().hash);
    let stage = parity::stages().find(|stage| stage.name == name)?;
    let choice = args.shader.adapter.as_deref().map_or_else(Choice::from_environment, Choice::from);
    let device = Device::open(&choice).ok()?;
    let outputs = stage.kernel().and_then(|kernel| stage.outputs(&device, &kernel, CELLS));
    Some(match outputs {
        Ok(outputs) => {
            let found = stage.agreement(&outputs);
            let share = 100.0 * found.equal;
            format!(
                "integer {name} on {}: of {} cells {share:.2} % are equal in bits",
                device.name(),
                found.values
            )
        }
        Err(error) => format!("integer {name}: unavailable: {error}"),
    })
}

#[cfg(not(feature = "gpu"))]
fn hashes(_: &CompareArgs) -> Option<String> {
    None
}

/// Subjects that belong together: of one variant, and of one precision where both have it.
fn pairs<'a>(left: &'a [Asked], right: &'a [Asked]) -> Vec<[&'a Subject<'static>; 2]> {
    let is_twin = |a: &Subject<'_>, b: &Subject<'_>| b.variant == a.variant && b.precision == a.precision;
    let of = |a: &'a Asked| {
        let b = right.iter().find(|b| is_twin(&a.subject, &b.subject))?;
        Some([&a.subject, &b.subject])
    };
    left.iter().filter_map(of).collect()
}
