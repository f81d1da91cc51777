//! The ladder: every tier of every stage and of the whole threshold, its time beside its error and its law.

use super::clock::{Contender, race};
use super::law::{Evaluate, Samples};
use super::pool::{COARSE, Pool, SLICE, WIDE};
use super::row::{LITERAL, ROBUST, Row, STD, Untimed, real_hash};
use super::stages::{StageInputs, stages};
use super::{Effort, baseline, sizes};
use crate::threshold::batch::{Batch, Bins, ColumnBuffer, Isa, Lane, Model, Tier};
use crate::threshold::cdf::CdfForm;
use crate::threshold::footprint::Footprint;
use crate::threshold::hash::{Cell, Hash, HashKind};
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::real::Real;
use crate::threshold::robust::{Join, Robust};
use crate::threshold::two_scale::Variant;
use std::hint::black_box;

/// [`real_hash`] of a kind.
#[derive(Clone, Copy)]
struct RealHash(HashKind);

impl<R: Real> Hash<R> for RealHash {
    fn hash(&self, cell: &Cell<R>) -> R {
        real_hash(self.0, cell)
    }
}

/// The threshold in `f64` over hashes of real numbers.
fn real_threshold(model: &Model, footprint: &Footprint<f64>) -> f64 {
    model.with_hash(RealHash(*model.hash())).threshold(footprint)
}

/// The inputs of thresholds.
struct Pools {
    single: Pool<f32>,
    double: Pool<f64>,
    coarse: Pool<f32>,
}

/// What thresholds are compared with and measured on.
struct Judge {
    footprints: Vec<Footprint<f64>>,
    samples: Samples,
}

impl Judge {
    /// Fills in what does not depend on time.
    fn row(&self, row: Row, model: &Model, evaluate: &Evaluate<'_>) -> Row {
        let values = evaluate(&self.footprints);
        let (mut same, mut distance) = (0, 0.0);
        for (footprint, value) in self.footprints.iter().zip(&values) {
            let reference: f32 = model.threshold(&footprint.cast());
            same += usize::from(reference.to_bits() == (*value as f32).to_bits());
            distance += (value - real_threshold(model, footprint)).abs();
        }
        let count = values.len() as f64;
        Row {
            bits_equal: Some(same as f64 / count),
            error: Some(distance / count),
            law: Some(self.samples.law(evaluate)),
            ..row
        }
    }

    /// A threshold in vector instructions.
    fn batch<'a, R: Lane>(&self, name: &'static str, batch: Batch, pool: &'a Pool<R>) -> Untimed<'a> {
        let evaluate = move |footprints: &[Footprint<f64>]| {
            let columns: ColumnBuffer<R> = footprints.iter().map(|footprint| footprint.cast()).collect();
            let mut out = vec![R::from_f64(0.0); footprints.len()];
            batch.par_thresholds(&columns.columns(), &mut out);
            out.into_iter().map(R::to_f64).collect()
        };
        let tier = batch.tier.name();
        let row =
            Row { precision: R::NAME, tier, isa: batch.isa.name(), ..Row::of_model(name, &batch.model) };
        let mut out = [R::from_f64(0.0); SLICE];
        let run = move |slice: usize| {
            batch.thresholds(&pool.columns(slice), &mut out);
            out[slice % SLICE].to_f64()
        };
        let touch = move |slice| pool.touch_columns(slice);
        Untimed {
            row: self.row(row, &batch.model, &evaluate),
            contender: Contender { items: SLICE, run: Box::new(run), touch: Box::new(touch) },
        }
    }

    /// A threshold one footprint after the other.
    fn scalar<'a, R: Real>(
        &self,
        (name, tier): (&'static str, &'static str),
        model: Model,
        pool: &'a Pool<R>,
        threshold: impl Fn(&Footprint<R>) -> R + Copy + Sync + 'a,
    ) -> Untimed<'a> {
        let evaluate = move |footprints: &[Footprint<f64>]| {
            footprints.iter().map(|footprint| threshold(&footprint.cast()).to_f64()).collect()
        };
        let row = Row { precision: R::NAME, tier, ..Row::of_model(name, &model) };
        let mut out = [R::from_f64(0.0); SLICE];
        let run = move |slice: usize| {
            for (out, footprint) in out.iter_mut().zip(pool.footprints(slice)) {
                *out = threshold(footprint);
            }
            out[slice % SLICE].to_f64()
        };
        let touch = move |slice| pool.touch_footprints(slice);
        Untimed {
            row: self.row(row, &model, &evaluate),
            contender: Contender { items: SLICE, run: Box::new(run), touch: Box::new(touch) },
        }
    }

    /// Whole thresholds in every tier, and the statistical axis.
    fn thresholds<'a>(&self, pools: &'a Pools, done: &dyn Fn()) -> Vec<Untimed<'a>> {
        let Pools { single, double, coarse } = pools;
        let best = Isa::best();
        let exact = Tier::BitExact;
        let mut entries = Vec::new();
        let mut add = |entry| {
            entries.push(entry);
            done();
        };
        let (listing_1, listing_2) =
            (listing(Variant::Isotropic, HashKind::Sine), listing(Variant::Anisotropic, HashKind::Sine));
        add(self.scalar((LITERAL, STD), listing_1, single, baseline::listing_1_f32));
        add(self.scalar((LITERAL, exact.name()), listing_1, single, move |f| listing_1.threshold(f)));
        for tier in Tier::ALL {
            for isa in Isa::available().filter(|&isa| isa == best || isa == Isa::Avx2 || tier == exact) {
                add(self.batch(LITERAL, Batch { model: listing_1, tier, isa }, single));
            }
        }
        add(self.scalar((LITERAL, STD), listing_1, double, baseline::listing_1_f64));
        add(self.scalar((LITERAL, exact.name()), listing_1, double, move |f| listing_1.threshold(f)));
        for tier in [Tier::Fast, Tier::TwoUlp, exact] {
            for isa in Isa::available().filter(|&isa| isa == best || isa == Isa::Avx2 || tier == exact) {
                add(self.batch(LITERAL, Batch { model: listing_1, tier, isa }, double));
            }
        }
        let real = move |footprint: &Footprint<f64>| real_threshold(&listing_1, footprint);
        let mut row = self.scalar((LITERAL, "double-double"), listing_1, double, real);
        row.row.precision = "double-double";
        add(row);
        add(self.scalar((LITERAL, STD), listing_2, single, baseline::listing_2_f32));
        for tier in Tier::ALL {
            add(self.batch(LITERAL, Batch { model: listing_2, tier, isa: best }, single));
        }
        for hash in HashKind::ALL.into_iter().filter(|&hash| hash != HashKind::Sine) {
            for tier in [Tier::Fast, exact] {
                let model = listing(Variant::Isotropic, hash);
                add(self.batch(LITERAL, Batch { model, tier, isa: best }, single));
            }
        }
        let integer = listing(Variant::Isotropic, Robust::HASH);
        add(self.scalar((LITERAL, exact.name()), integer, single, move |f| integer.threshold(f)));
        for hash in HashKind::ALL {
            let model = Robust { hash, ..Robust::new(Variant::Isotropic) }.into();
            for tier in [Tier::Fast, exact] {
                add(self.batch(ROBUST, Batch { model, tier, isa: best }, single));
            }
        }
        let robust = Model::from(Robust::new(Variant::Isotropic));
        add(self.scalar((ROBUST, exact.name()), robust, single, move |f| robust.threshold(f)));
        add(self.batch(ROBUST, Batch::new(robust), double));
        for join in Join::ALL {
            let model = Robust { join, ..Robust::new(Variant::Anisotropic) }.into();
            for tier in [Tier::Fast, exact] {
                add(self.batch(ROBUST, Batch { model, tier, isa: best }, single));
            }
        }
        for (name, model) in statistical_axis() {
            add(self.batch(name, Batch::new(model), coarse));
        }
        entries
    }
}

/// How many footprints a streamed row makes, evaluates and hands on: several tasks a thread.
const STREAMED: usize = 1 << 21;

/// Thresholds of footprints that are made as they are needed, on one and two threads, seen or counted in bins.
///
/// No rows where threads cannot be had.
fn streamed<'a>() -> Vec<Untimed<'a>> {
    let mut entries = Vec::new();
    for threads in [1, 2] {
        for binned in [false, true] {
            let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(threads).build() else { continue };
            let batch = Batch::new(Robust::new(Variant::Isotropic));
            let name = if binned { "robust, streamed and binned" } else { "robust, streamed" };
            let row = Row {
                tier: batch.tier.name(),
                isa: batch.isa.name(),
                threads,
                ..Row::of_model(name, &batch.model)
            };
            let see = move |bins: &mut Bins, thresholds: &[f32]| {
                if binned {
                    bins.add(batch.isa, thresholds);
                } else {
                    black_box(thresholds);
                }
            };
            let start = || Bins::new(1 << 10);
            let run = move |_| {
                let merge = |earlier: &mut Bins, later: Bins| earlier.merge(&later);
                let bins = pool.install(|| batch.stream(STREAMED as u64, sizes::grid, start, see, merge));
                bins.counts()[0] as f64
            };
            let contender = Contender { items: STREAMED, run: Box::new(run), touch: Box::new(|_| 0.0) };
            entries.push(Untimed { row, contender });
        }
    }
    entries
}

/// A listing to the letter with a hash.
fn listing(variant: Variant, hash: HashKind) -> Model {
    HashedAlpha { variant, hash, hash_scale: 1.0, form: CdfForm::Literal }.into()
}

/// What may be left out of a threshold, or put in its place, and what that does to its law; all with one hash.
#[must_use]
pub fn statistical_axis() -> [(&'static str, Model); 7] {
    let hashed =
        |variant| HashedAlpha { variant, hash: Robust::HASH, hash_scale: 1.0, form: CdfForm::Stable };
    let robust = |join| Robust { join, ..Robust::new(Variant::Isotropic) }.into();
    [
        ("one scale", hashed(Variant::Single).into()),
        ("linear", hashed(Variant::Linear).into()),
        ("two scales without CDF", Model::BeforeCdf(hashed(Variant::Isotropic))),
        ("two scales with CDF", hashed(Variant::Isotropic).into()),
        ("copula", robust(Join::Copula)),
        ("dithered", robust(Join::Dithered)),
        ("inherit", robust(Join::Inherit)),
    ]
}

/// How many steps [`ladder`] reports.
#[must_use]
pub fn steps(effort: Effort) -> u64 {
    rounds(effort) as u64 + 60
}

fn rounds(effort: Effort) -> usize {
    effort.pick(3, 96)
}

/// Measures the ladder in one interleaved run; `done` is called after each of about [`steps`] steps.
#[must_use]
pub fn ladder(effort: Effort, done: &dyn Fn()) -> Vec<Row> {
    let slices = effort.pick(2, 32);
    let pools = Pools {
        single: Pool::new(WIDE, slices),
        double: Pool::new(WIDE, slices),
        coarse: Pool::new(COARSE, slices),
    };
    let footprints = pools.double.footprints(0).to_vec();
    let judge = Judge { footprints, samples: Samples::new(effort) };
    let inputs = StageInputs::new(slices);
    let mut entries = stages(&inputs);
    entries.extend(judge.thresholds(&pools, done));
    entries.extend(streamed());
    let (mut rows, mut contenders): (Vec<Row>, Vec<Contender<'_>>) =
        entries.into_iter().map(|entry| (entry.row, entry.contender)).unzip();
    let times = race(&mut contenders, rounds(effort), done);
    for (row, time) in rows.iter_mut().zip(&times) {
        (row.ns_min, row.ns_median) = (time.min, time.median);
    }
    let baseline = rows.iter().find(|row| row.is_baseline()).map_or(f64::NAN, |row| row.ns_median);
    for row in &mut rows {
        row.ratio = baseline / row.ns_median;
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quick_ladder_tells_the_tiers_apart() {
        let rows = ladder(Effort::Quick, &|| ());
        let baseline: Vec<_> = rows.iter().filter(|row| row.is_baseline()).collect();
        assert_eq!(baseline.len(), 1);
        let find = |name: &str, precision: &str, tier: &str, isa: &str| {
            rows.iter()
                .find(|r| {
                    (r.name, r.precision, r.tier, r.isa, r.variant)
                        == (name, precision, tier, isa, Variant::Isotropic.name())
                })
                .unwrap_or_else(|| panic!("{name} {precision} {tier} {isa}"))
        };
        let best = Isa::best().name();
        let equal = |tier, isa| find(LITERAL, "f32", tier, isa).bits_equal.unwrap_or(-1.0);
        assert_eq!(equal("bit-exact", best), 1.0);
        assert_eq!(equal("bit-exact", "scalar"), 1.0);
        let (std, two_ulp, fast, coarse) = (
            equal("std", "scalar"),
            equal("two-ulp", best),
            equal("fast", best),
            equal("wgsl-minimum", best),
        );
        assert!(
            0.8 < std && std < 1.0 && two_ulp < std && fast < two_ulp && coarse < fast,
            "{std} {two_ulp} {fast} {coarse}"
        );
        let error = |precision, tier| find(LITERAL, precision, tier, "scalar").error.unwrap_or(-1.0);
        assert_eq!(error("double-double", "double-double"), 0.0);
        assert!(error("f64", "bit-exact") < 0.2 && error("f32", "bit-exact") > 0.25);
        let law = |name: &str| rows.iter().find(|r| r.name == name).and_then(|r| r.law).unwrap();
        assert!(law("two scales without CDF").ks > 2.0 * law("two scales with CDF").ks);
        assert!(law("one scale").flips_per_octave > 2.0 * law("dithered").flips_per_octave);
        assert!(rows.iter().all(|row| row.ns_min > 0.0 && row.ns_min <= row.ns_median && row.ratio > 0.0));
    }
}
