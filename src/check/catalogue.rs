//! What the statistics say of each hash of the list: the claims that reject it, and how far its indices may grow.

use crate::check::growth::{End, Plan, Step, course, grow};
use crate::check::{Budget, Claim, Draw, Precision, Subject};
use crate::stats::{chi_square, seed};
use crate::threshold::emulated::{Emulated, Half};
use crate::threshold::hash::{Cell, Hash, HashKind};
use crate::threshold::real::Real;
use rand::RngExt;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Mutex, PoisonError};

/// A claim that rejects a hash.
#[derive(Clone, Debug, PartialEq)]
pub struct Rejection {
    /// Its id.
    pub claim: &'static str,
    /// How often its samples were doubled.
    pub doublings: u32,
    /// Logarithm to base two of its samples.
    pub log2_n: f64,
}

/// What claims say of a hash alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Quality {
    /// How many claims there are about a hash alone.
    pub claims: usize,
    /// Those that reject it, the fewest samples first.
    pub rejections: Vec<Rejection>,
    /// Logarithm to base two of the most samples that a claim has had.
    pub log2_most: f64,
}

/// As `check hash:NAME --until-failure --budget quick --doublings K` makes it, in `f32` alone.
fn plan(kind: HashKind, claims: &[Claim], doublings: u32) -> Plan<'static> {
    let subject = Subject::of_hash(format!("hash:{kind}"), Precision::F32, kind);
    let draw = Draw { budget: Budget::Quick, ..Draw::default() };
    Plan::new(claims, vec![subject], draw, Some(doublings))
}

/// Doubles the samples of claims about a hash until they fail, at most so often.
#[must_use]
pub fn quality(kind: HashKind, claims: &[Claim], doublings: u32) -> Quality {
    let plan = plan(kind, claims, doublings);
    let steps = Mutex::new(Vec::new());
    grow(&plan, &[], || false, |step| steps.lock().unwrap_or_else(PoisonError::into_inner).push(step));
    let steps = steps.into_inner().unwrap_or_else(PoisonError::into_inner);
    let log2 = |step: &Step| libm::log2(step.n.max(1) as f64);
    let mut found = Quality { claims: 0, rejections: Vec::new(), log2_most: 0.0 };
    for (index, claim) in plan.claims.iter().enumerate() {
        let course = course(&steps, 0, index);
        let (end, Some(last)) = (plan.end(&course), course.last()) else { continue };
        if matches!(end, Some(End::NotApplicable | End::Unavailable)) {
            continue;
        }
        found.claims += 1;
        found.log2_most = found.log2_most.max(log2(last));
        if end == Some(End::Failed) {
            found.rejections.push(Rejection {
                claim: claim.id,
                doublings: last.doublings,
                log2_n: log2(last),
            });
        }
    }
    found.rejections.sort_by(|a, b| a.log2_n.total_cmp(&b.log2_n).then(a.claim.cmp(b.claim)));
    found
}

/// Cells that [`range`] hashes at each size of indices.
const CELLS: usize = 1 << 14;

/// Bins of their values.
const BINS: usize = 64;

/// Below this p-value a size of indices is beyond the range: once in a billion for a sound hash.
const LEVEL: f64 = 1e-9;

/// At least one in so many cells has a value of its own: half precision has some five thousand values that come up, the sine hash in `f32`
/// hardly fewer.
const CELLS_A_VALUE: usize = 16;

/// The smallest size of indices that is looked at: there most cells that are drawn are different.
const FIRST: u32 = 6;

/// Returns the largest k below `largest` up to which cells with indices of a size in [2^k, 2^(k + 1)) along each axis have values that are
/// uniform and not few; none where not even those of the first sizes do.
#[must_use]
pub fn range<R: Real>(kind: HashKind, largest: u32) -> Option<u32> {
    (FIRST..largest).take_while(|&k| is_sound_at::<R>(kind, k)).last()
}

/// [`range`] in `f32`, up to indices of 2^31, the largest that are words.
#[must_use]
pub fn range_in_single(kind: HashKind) -> Option<u32> {
    range::<f32>(kind, 31)
}

/// [`range`] in half precision, whose largest number is 65504.
#[must_use]
pub fn range_in_half(kind: HashKind) -> Option<u32> {
    range::<Emulated<Half>>(kind, 15)
}

fn is_sound_at<R: Real>(kind: HashKind, k: u32) -> bool {
    let mut rng = seed::rng("catalogue.range", u64::from(k));
    let size = libm::exp2(f64::from(k));
    let mut counts = [0_u64; BINS];
    let mut seen = BTreeMap::new();
    for _ in 0..CELLS {
        let index = [(); 3].map(|()| {
            let drawn: f64 = rng.random_range(size..2.0 * size);
            R::from_f64(if rng.random() { drawn.floor() } else { -drawn.floor() })
        });
        let value: R = kind.hash(&Cell { index: index.into(), octave: 3 });
        let value = value.to_f64();
        if (0.0..=1.0).contains(&value) {
            counts[((value * BINS as f64) as usize).min(BINS - 1)] += 1;
        }
        seen.insert(index.map(|c| c.to_f64() as i64), value.to_bits());
    }
    let values: BTreeSet<u64> = seen.values().copied().collect();
    let is_varied = CELLS_A_VALUE * values.len() >= seen.len();
    let is_number = counts.iter().sum::<u64>() == CELLS as u64;
    is_number && is_varied && chi_square::uniform(&counts).is_ok_and(|test| test.p > LEVEL)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::claims;

    #[test]
    fn a_lattice_is_rejected_at_once_and_a_mixer_is_not() {
        let all = [claims::uniform::MARGINAL, claims::independence::NEIGHBOURS];
        let of = |kind| quality(kind, &all, 1);
        let weyl = of(HashKind::Weyl);
        assert!(weyl.claims == 2 && weyl.rejections[0].doublings == 0, "{weyl:?}");
        let mixed = of(HashKind::Mm4);
        assert!(mixed.rejections.is_empty() && mixed.log2_most > 10.0, "{mixed:?}");
    }

    #[test]
    fn integers_have_no_end_and_real_numbers_do() {
        assert_eq!([range_in_single(HashKind::Mm4), range_in_half(HashKind::Mm4)], [Some(30), Some(14)]);
        let hoskins = range_in_single(HashKind::Hoskins);
        assert!(hoskins.is_some_and(|k| (16..26).contains(&k)), "{hoskins:?}");
        assert_eq!(range_in_half(HashKind::Sine), None);
    }
}
