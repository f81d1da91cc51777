//! What each hash of the list costs: alone, in a threshold, and in operations of a shader.

use super::Effort;
use super::clock::{Contender, race};
use super::pool::{Pool, SLICE, WIDE};
use super::stages::{StageInputs, hash, one_by_one};
use crate::scene::Fragment;
use crate::shader::own::{ShaderError, assembled};
use crate::threshold::batch::{Batch, Isa, Tier};
use crate::threshold::footprint::Footprint;
use crate::threshold::hash::{Hash, HashKind};
use crate::threshold::robust::Robust;
use crate::threshold::two_scale::Variant;
use glam::dvec3;

/// Nanoseconds of a hash, the fastest round of a run in which all hashes took turns; bit-exact, on one core.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HashTime {
    /// One cell after the other.
    pub alone: f64,
    /// A cell among thousands, in the vector instructions of the machine.
    pub batch: f64,
    /// A robust threshold with one scale, in a batch.
    pub threshold: f64,
}

/// How many steps [`times`] reports.
#[must_use]
pub fn steps(effort: Effort) -> u64 {
    rounds(effort) as u64
}

fn rounds(effort: Effort) -> usize {
    effort.pick(3, 192)
}

/// Times every hash of the list, in its order; `done` is called after each of [`steps`] rounds.
#[must_use]
pub fn times(effort: Effort, done: &dyn Fn()) -> Vec<HashTime> {
    let slices = effort.pick(2, 32);
    let inputs = StageInputs::new(slices);
    let pool: Pool<f32> = Pool::new(WIDE, slices);
    let (isa, exact) = (Isa::best(), Tier::BitExact);
    let mut contenders = Vec::new();
    for kind in HashKind::ALL {
        contenders.push(one_by_one(&inputs, kind, exact.name(), move |cell| kind.hash(cell)).contender);
        let block =
            move |index: [&[f32]; 3], word: &[u32], out: &mut [f32]| isa.hash(kind, exact, index, word, out);
        contenders.push(hash(&inputs, kind, exact.name(), isa.name(), block).contender);
        let batch = Batch::new(of(kind));
        let (pool, mut out) = (&pool, [0.0; SLICE]);
        let run = move |slice: usize| {
            batch.thresholds(&pool.columns(slice), &mut out);
            f64::from(out[slice % SLICE])
        };
        let touch = move |slice| pool.touch_columns(slice);
        contenders.push(Contender { items: SLICE, run: Box::new(run), touch: Box::new(touch) });
    }
    let times = race(&mut contenders, rounds(effort), done);
    times
        .chunks_exact(3)
        .map(|of| HashTime { alone: of[0].min, batch: of[1].min, threshold: of[2].min })
        .collect()
}

/// The threshold in which a hash is priced.
fn of(kind: HashKind) -> Robust {
    Robust { hash: kind, ..Robust::new(Variant::Isotropic) }
}

/// Counts the operations of WGSL, two hashes among them, that the robust threshold with one scale takes with a hash: arithmetic,
/// comparisons, conversions and assignments of variables alike, and a sine as one.
///
/// # Errors
///
/// [`ShaderError`]: the text cannot be interpreted.
pub fn operations(kind: HashKind) -> Result<u64, ShaderError> {
    let shader = assembled(kind.name(), of(kind))?;
    let footprint = Footprint {
        position: dvec3(0.31, -1.72, 2.43),
        dpdx: dvec3(0.0121, 0.0003, -0.0007),
        dpdy: dvec3(0.0002, 0.0094, 0.0033),
    };
    shader.operations(&shader.program()?, Fragment::from(footprint))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quick_race_times_every_hash() {
        let times = times(Effort::Quick, &|| ());
        assert_eq!(times.len(), HashKind::ALL.len());
        assert!(times.iter().all(|time| time.alone > 0.0 && time.batch > 0.0 && time.threshold > 0.0));
    }

    /// One sum and one mixer are less than four rounds of MurmurHash3, and those less than six of TEA.
    #[test]
    fn operations_are_counted_and_differ_by_the_hash() {
        let of = |kind| operations(kind).expect("an interpreted threshold");
        assert!(
            of(HashKind::LowbiasLinear) < of(HashKind::Mm4),
            "{} {}",
            of(HashKind::LowbiasLinear),
            of(HashKind::Mm4)
        );
        assert!(of(HashKind::Mm4) < of(HashKind::Tea3));
    }
}
