//! What follows from the listings without any chance: where the threshold changes, and by which formula.

use crate::check::input::{Sighting, general_scenes, independent, placement, sighting};
use crate::check::judge::detectable_factor;
use crate::check::predict::same_by_kin;
use crate::check::shrink::{at, describe_pair, shrunk};
use crate::check::tolerance::{DRAWS_A_PLACE, MEETING};
use crate::check::trial::detectable_share;
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Precision, Promise, Subject, Trial, Verdict};
use crate::scene::Fragment;
use crate::stats::binomial;
use crate::stats::seed::uniform01;
use crate::threshold::cdf::cdf;
use glam::{DVec3, dvec3};
use rand::rngs::Xoshiro256PlusPlus;

/// Pairs of a point before and after a motion: about half stay in their cells.
const CELL_PAIRS: usize = 1 << 16;

/// The largest motion along an axis, in sides of the fine cell: three in five points stay in a cell of three axes.
const CELL_MOTION: f64 = 0.3;

/// Weights at which the change of either cell shows in the last bits of an `f32`.
const CELL_WEIGHTS: core::ops::RangeInclusive<f64> = 0.01..=0.99;

/// Samples of which Eq. 2 is computed again.
const FORMULA_SAMPLES: usize = 1 << 16;

/// How far a threshold may be from Eq. 2, in `f32` and `f64`: the clamp at 1e-6, and a dozen roundings of a number below
/// 1 for the logarithm, the weight and the formula.
const CDF_ROUNDING: [f64; 2] = [1.0 / 524_288.0, 1.0e-6];

/// The threshold changes exactly where the position enters another cell.
pub const CELLS: Claim = Claim {
    id: "exact.cells",
    anchor: "§5, Listings 1 and 2 (floor of the scaled position)",
    statement: "while a point moves within its cells, no bit of its threshold changes; where it enters another cell, the \
                threshold is another one",
    expected: Verdict::Consistent,
    // At the quick budget a dithered threshold leaves a fifth of the pairs, of which chance may keep one or two.
    promise: Some(Promise::Linear(1.0e-2)),
    run: cells,
};

/// The threshold is Eq. 2 of the interpolated value.
pub const CDF: Claim = Claim {
    id: "exact.cdf",
    anchor: "§5.4.2, Eq. 2",
    statement: "the threshold is Eq. 2 of the interpolated value and the lerp factor, to the last roundings",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(2.0e-3)),
    run: formula,
};

/// A point before and after it moved by less than a cell, with its derivatives as they were.
fn pair(subject: &Subject<'_>, found: Sighting<'_>, rng: &mut Xoshiro256PlusPlus) -> [Fragment; 2] {
    let first = found.placed(placement(rng), subject.precision);
    let side = DVec3::ONE / DVec3::from_array(subject.nominal(&first.fragment.footprint).fine_scale);
    let mut part = || (2.0 * uniform01(rng) - 1.0) * CELL_MOTION;
    let motion = dvec3(part(), part(), part()) * side;
    [first.fragment, first.moved(motion, subject.precision).fragment]
}

fn cells(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(CELLS.id);
    let scenes = general_scenes();
    let mut pairs = Vec::new();
    for index in 0..draw.samples(CELL_PAIRS) {
        let found = sighting(&scenes[index % scenes.len()], &mut rng);
        let pair = pair(subject, found, &mut rng);
        // Where one octave has all but no weight, its changes drown in rounding.
        if pair.iter().all(|at| CELL_WEIGHTS.contains(&subject.nominal(&at.footprint).lerp_factor)) {
            pairs.extend(pair);
        }
    }
    let thresholds = subject.thresholds(&pairs);
    let (mut within, mut changed, mut across, mut kept) = (0_u64, 0_u64, 0_u64, 0_u64);
    let (mut kin, mut first) = (0.0, None);
    for (pair, value) in pairs.chunks_exact(2).zip(thresholds.chunks_exact(2)) {
        let cells = [&pair[0], &pair[1]].map(|at| subject.nominal(&at.footprint));
        let same = value[0].to_bits() == value[1].to_bits();
        if cells[0].fine_cell == cells[1].fine_cell {
            within += 1;
            changed += u64::from(!same);
            if !same {
                first.get_or_insert([pair[0], pair[1]]);
            }
        } else if !subject.join.switches() || cells[0].coarse_cell != cells[1].coarse_cell {
            // A join that switches reads one of the two cells; both have changed where the coarse one has.
            across += 1;
            kept += u64::from(same);
            kin += same_by_kin(subject, [&cells[0], &cells[1]]);
        }
    }
    if within == 0 || across == 0 {
        return Ok(Trial::without(
            Conclusion::Inconclusive,
            "no point moved within its cells and across them",
        ));
    }
    let chance = across as f64 * MEETING + kin;
    let conclusion = if changed > 0 {
        Conclusion::Exact { holds: false }
    } else {
        Conclusion::Probability(binomial::poisson_upper_p(kept, chance))
    };
    let [changed_share, kept_share] = [changed as f64 / within as f64, kept as f64 / across as f64];
    let first = first.map_or(String::new(), |pair| {
        let in_one_cell = |pair: &[Fragment; 2], [old, new]: [f64; 2]| {
            let [before, after] = pair.map(|at| subject.nominal(&at.footprint));
            before.fine_cell == after.fine_cell && old.to_bits() != new.to_bits()
        };
        format!(", as in {}", describe_pair(subject, &pair, in_one_cell))
    });
    Ok(Trial {
        conclusion,
        statistic: Some((changed + kept) as f64),
        statistic_name: "thresholds that changed within a cell or were kept across".into(),
        n: within + across,
        effect: Some(changed_share.max(kept_share)),
        effect_name: "share of points that moved",
        // A change within is seen once it is there; thresholds that are kept have to be more than chance may keep.
        detectable: Some(
            detectable_share(within as f64).max(detectable_factor(chance) * chance / across as f64),
        ),
        seen: format!(
            "{:.2} % of thresholds change while the point stays in its cells{first}; {:.2} % are kept where it enters another",
            100.0 * changed_share,
            100.0 * kept_share
        ),
        evidence: Evidence::None,
    })
}

fn formula(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(CDF.id);
    let n = draw.samples(FORMULA_SAMPLES);
    let samples = independent(subject, &general_scenes(), n, DRAWS_A_PLACE, &mut rng);
    let Some(interpolated) = subject.interpolated(&samples) else {
        let reason = "the subject does not tell its interpolated value";
        return Ok(Trial::without(Conclusion::NotApplicable, reason));
    };
    let thresholds = subject.thresholds(&samples);
    let allowed = CDF_ROUNDING[usize::from(subject.precision == Precision::F64)];
    let errors = |samples: &[Fragment], thresholds: &[f64], interpolated: &[f64]| -> Vec<f64> {
        let values = samples.iter().zip(thresholds).zip(interpolated);
        let formula = |sample: &Fragment, x| cdf(x, subject.nominal(&sample.footprint).lerp_factor);
        values.map(|((sample, value), &x)| (value - formula(sample, x)).abs()).collect()
    };
    let is_bad = |error: f64| error > allowed || error.is_nan();
    let found = errors(&samples, &thresholds, &interpolated);
    let outside = found.iter().filter(|&&error| is_bad(error)).count() as u64;
    let largest = found.iter().copied().fold(0.0, f64::max);
    let n = samples.len() as u64;
    let first = found.iter().position(|&error| is_bad(error)).map_or(String::new(), |first| {
        let [shown] = shrunk(subject, &[samples[first]], |candidates| {
            let candidates = candidates.as_flattened();
            let interpolated = subject.interpolated(candidates).unwrap_or_default();
            let found = errors(candidates, &subject.thresholds(candidates), &interpolated);
            found.into_iter().map(is_bad).collect()
        });
        format!(", as in {}", at(subject, &shown))
    });
    let seen = format!("{outside} of {n} thresholds are not Eq. 2, by up to {largest:.4}{first}");
    let counted = Trial::counted(
        outside,
        n,
        "largest distance from Eq. 2",
        "share of thresholds that are not Eq. 2",
        seen,
    );
    Ok(Trial { statistic: Some(largest), ..counted })
}
