//! The law of the threshold: uniform, whatever the weight and the surface, and only thanks to Eq. 2.

use crate::check::evidence::NamedHistogram;
use crate::check::input::{general_scenes, independent};
use crate::check::judge::{histogram, uniformity};
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

/// Samples of a marginal claim: enough that no group of lerp factors is left out.
fn marginal_size(draw: &Draw) -> usize {
    draw.samples(MARGINAL_SAMPLES).max(2 * LERP_GROUPS * LEAST_GROUP)
}

/// Samples of the marginal claims with their values, or the trial that ends the claim.
fn marginal_samples(subject: &Subject<'_>, claim: &Claim, draw: &Draw) -> Attempt<(Vec<Fragment>, Vec<f64>)> {
    let mut rng = draw.rng(claim.id);
    let samples = independent(subject, &general_scenes(), marginal_size(draw), DRAWS_A_PLACE, &mut rng);
    let values = subject.thresholds(&samples);
    reject_outsiders(subject, &samples, &values)?;
    Ok((samples, values))
}

fn marginal(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let (_, values) = marginal_samples(subject, &MARGINAL, draw)?;
    let pooled = histogram(values);
    let tests: Vec<_> = uniformity(&pooled).into_iter().collect();
    let evidence = Evidence::Histograms(vec![NamedHistogram::new("surfaces in general position", &pooled)]);
    Ok(Trial::worst_of(&tests, pooled.total(), "the pooled thresholds are not uniform".into(), evidence))
}

fn coverage(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let (_, mut values) = marginal_samples(subject, &COVERAGE, draw)?;
    let pooled = histogram(values.iter().copied());
    let n = values.len() as u64;
    Ok(match ecdf::kolmogorov_smirnov(&mut values) {
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
    let (samples, values) = marginal_samples(subject, &BY_LERP_FACTOR, draw)?;
    Ok(uniformity_by_lerp_factor(subject, &samples, &values))
}

fn without_cdf(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(WITHOUT_CDF.id);
    let samples = independent(subject, &general_scenes(), marginal_size(draw), DRAWS_A_PLACE, &mut rng);
    Ok(match subject.interpolated(&samples) {
        None => Trial::without(Conclusion::NotApplicable, "the subject does not tell its interpolated value"),
        Some(values) => uniformity_by_lerp_factor(subject, &samples, &values),
    })
}

fn uniformity_by_lerp_factor(subject: &Subject<'_>, samples: &[Fragment], values: &[f64]) -> Trial {
    let mut groups = vec![Histogram::new(BINS); LERP_GROUPS];
    for (sample, &value) in samples.iter().zip(values) {
        let lerp_factor = subject.nominal(&sample.footprint).lerp_factor;
        let group = ((lerp_factor * LERP_GROUPS as f64) as usize).min(LERP_GROUPS - 1);
        groups[group].add(value);
    }
    let name = |group: usize| {
        let edge = |at: usize| at as f64 / LERP_GROUPS as f64;
        format!("lerp factor {:.4} to {:.4}", edge(group), edge(group + 1))
    };
    let tested: Vec<(usize, ChiSquare)> =
        groups.iter().enumerate().filter_map(|(group, counts)| Some((group, uniformity(counts)?))).collect();
    let worst = tested.iter().min_by(|a, b| a.1.p.total_cmp(&b.1.p));
    let seen = worst.map_or_else(String::new, |(group, test)| {
        format!("{}: chi-square {:.0} over {} dof", name(*group), test.statistic, test.dof)
    });
    let evidence =
        tested.iter().map(|&(group, _)| NamedHistogram::new(name(group), &groups[group])).collect();
    let tests: Vec<_> = tested.iter().map(|&(_, test)| test).collect();
    Trial::worst_of(&tests, tests.iter().map(|test| test.n).sum(), seen, Evidence::Histograms(evidence))
}
