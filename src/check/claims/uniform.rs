//! The law of the threshold: uniform, whatever the weight and the surface, and only thanks to Eq. 2.

use crate::check::evidence::NamedHistogram;
use crate::check::input::{UsedCells, general_scenes, independent, more_independent};
use crate::check::judge::uniformity;
use crate::check::tolerance::{BINS, DRAWS_A_PLACE, LEAST_GROUP, LERP_GROUPS, POWER, SINGLE_LEVEL};
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::scene::Fragment;
use crate::stats::chi_square::ChiSquare;
use crate::stats::histogram::Histogram;
use crate::stats::{ecdf, power};

/// Samples of a claim about a marginal law: sees an excess chi-square of 7e-4 a sample, a tenth of the loss from
/// leaving out Eq. 2 at a lerp factor of 0.01.
const MARGINAL_SAMPLES: usize = 1 << 18;

/// Bins in which a grown claim of coverage looks for the largest error: a distance of 1e-6 at most is lost between two edges.
const COVERAGE_EDGES: usize = 1 << 20;

/// Pooled chi-square over surfaces in general position.
pub const MARGINAL: Claim = Claim {
    id: "uniform.marginal",
    anchor: "§5, §5.4.2",
    statement: "thresholds on surfaces in general position, pooled, are uniform on [0, 1)",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(2.0e-3)),
    run: marginal,
};

/// Kolmogorov-Smirnov: the share of thresholds below alpha, for every alpha at once.
pub const COVERAGE: Claim = Claim {
    id: "uniform.coverage",
    anchor: "§4 (expected visibility is alpha)",
    statement: "for every alpha, a fragment of that alpha is kept with probability alpha",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.02)),
    run: coverage,
};

/// Chi-square within groups of the lerp factor.
pub const BY_LERP_FACTOR: Claim = Claim {
    id: "uniform.by_lerp_factor",
    anchor: "Eq. 2",
    statement: "thresholds are uniform at every lerp factor, on both sides of 1/2",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.04)),
    run: by_lerp_factor,
};

/// The same for the interpolated value: must be rejected, or Eq. 2 would have no reason.
pub const WITHOUT_CDF: Claim = Claim {
    id: "uniform.without_cdf",
    anchor: "§5.4.2 (interpolating two uniform values)",
    statement: "the interpolated value would be uniform without Eq. 2 (negative control: must be rejected)",
    expected: Verdict::Rejected,
    promise: Some(Promise::Linear(0.04)),
    run: without_cdf,
};

/// Fewest samples of a group of lerp factors: 80 expected in every bin, so that the promised excess of 0.04 is seen in the smallest
/// of [`LERP_GROUPS`]. With an anisotropic subject some groups are hardly ever met.
const LEAST_IN_GROUP: usize = 80 * BINS;

/// Fewest samples of a marginal claim: enough that no group of lerp factors is left out.
const LEAST_MARGINAL: usize = 2 * LERP_GROUPS * LEAST_GROUP;

/// Hands over the samples of a marginal claim with their values, chunk by chunk, or the trial that ends the claim.
fn marginal_samples(
    subject: &Subject<'_>,
    claim: &Claim,
    draw: &Draw,
    mut each: impl FnMut(Vec<Fragment>, Vec<f64>),
) -> Attempt<()> {
    let mut rng = draw.rng(claim.id);
    let scenes = general_scenes();
    let n = draw.stream_at_least(MARGINAL_SAMPLES, LEAST_MARGINAL);
    let mut used = UsedCells::of(draw, 2 * n);
    for chunk in draw.chunks(n) {
        let samples = more_independent(subject, &scenes, chunk, DRAWS_A_PLACE, &mut used, &mut rng);
        let values = subject.thresholds(&samples);
        reject_outsiders(subject, &samples, &values)?;
        each(samples, values);
    }
    Ok(())
}

fn marginal(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut pooled = Histogram::new(BINS);
    marginal_samples(subject, &MARGINAL, draw, |_, values| pooled.extend(values))?;
    let tests: Vec<_> = uniformity(&pooled).into_iter().collect();
    let evidence = Evidence::Histograms(vec![NamedHistogram::new("surfaces in general position", &pooled)]);
    Ok(Trial::worst_of(&tests, pooled.total(), "the pooled thresholds are not uniform".into(), evidence))
}

fn coverage(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut pooled = Histogram::new(BINS);
    let mut edges = Histogram::new(if draw.doublings == 0 { 1 } else { COVERAGE_EDGES });
    let mut kept = Vec::new();
    marginal_samples(subject, &COVERAGE, draw, |_, values| {
        pooled.extend(values.iter().copied());
        if draw.doublings == 0 {
            kept = values;
        } else {
            edges.extend(values);
        }
    })?;
    let n = pooled.total();
    let found = if draw.doublings == 0 {
        ecdf::kolmogorov_smirnov(&mut kept)
    } else {
        ecdf::distance_at_edges(&edges)
    };
    Ok(match found {
        Err(_) => Trial::without(Conclusion::Inconclusive, "the scenes gave no samples"),
        Ok(distance) => Trial {
            // The bound holds at every n and for atoms too, where the asymptotic law does not.
            conclusion: Conclusion::Probability(distance.dkwm),
            statistic: Some(distance.d),
            statistic_name: "Kolmogorov-Smirnov distance".into(),
            n,
            effect: Some(distance.d),
            effect_name: "largest error in coverage",
            detectable: Some(power::detectable_distance_ks(n, SINGLE_LEVEL, POWER)),
            seen: format!("coverage is off by up to {:.2} %", 100.0 * distance.d),
            evidence: Evidence::Histograms(vec![NamedHistogram::new(
                "surfaces in general position",
                &pooled,
            )]),
        },
    })
}

fn by_lerp_factor(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut groups = ByLerpFactor::default();
    marginal_samples(subject, &BY_LERP_FACTOR, draw, |samples, values| {
        groups.add(subject, &samples, &values);
    })?;
    Ok(groups.judged())
}

fn without_cdf(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(WITHOUT_CDF.id);
    let n = draw.samples(MARGINAL_SAMPLES).max(LEAST_MARGINAL);
    let samples = independent(subject, &general_scenes(), n, DRAWS_A_PLACE, &mut rng);
    Ok(match subject.interpolated(&samples) {
        None => Trial::without(Conclusion::NotApplicable, "the subject does not tell its interpolated value"),
        Some(values) => {
            let mut groups = ByLerpFactor::default();
            groups.add(subject, &samples, &values);
            groups.judged()
        }
    })
}

/// Histograms of thresholds, one for each group of lerp factors.
struct ByLerpFactor(Vec<Histogram>);

impl Default for ByLerpFactor {
    fn default() -> Self {
        Self(vec![Histogram::new(BINS); LERP_GROUPS])
    }
}

impl ByLerpFactor {
    fn add(&mut self, subject: &Subject<'_>, samples: &[Fragment], values: &[f64]) {
        for (sample, &value) in samples.iter().zip(values) {
            let lerp_factor = subject.nominal(&sample.footprint).lerp_factor;
            let group = ((lerp_factor * LERP_GROUPS as f64) as usize).min(LERP_GROUPS - 1);
            self.0[group].add(value);
        }
    }

    fn judged(&self) -> Trial {
        let Self(groups) = self;
        let name = |group: usize| {
            let edge = |at: usize| at as f64 / LERP_GROUPS as f64;
            format!("lerp factor {:.4} to {:.4}", edge(group), edge(group + 1))
        };
        let tested: Vec<(usize, ChiSquare)> = groups
            .iter()
            .enumerate()
            .filter(|(_, counts)| counts.total() >= LEAST_IN_GROUP as u64)
            .filter_map(|(group, counts)| Some((group, uniformity(counts)?)))
            .collect();
        let worst = tested.iter().min_by(|a, b| a.1.p.total_cmp(&b.1.p));
        let seen = worst.map_or_else(String::new, |(group, test)| {
            format!("{}: chi-square {:.0} over {} dof", name(*group), test.statistic, test.dof)
        });
        let evidence =
            tested.iter().map(|&(group, _)| NamedHistogram::new(name(group), &groups[group])).collect();
        let tests: Vec<_> = tested.iter().map(|&(_, test)| test).collect();
        let n = tests.iter().map(|test| test.n).sum();
        Trial::worst_of(&tests, n, seen, Evidence::Histograms(evidence))
    }
}
