//! The noise as a picture: its autocorrelation and its spectrum, against what cells of the claimed size predict.
//!
//! White noise is the wrong model: neighbouring pixels share cells, so low frequencies are stronger than high ones,
//! by up to a factor of four. The expected periodogram is known exactly, and every image of a patch is divided by it.
//!
//! The ordinates are nearly exponential and nearly independent, so that the law of their sums is known down to its tails.
//! Nearly: noise that is constant on cells is not stationary, and frequencies whose distance is a frequency of the grid
//! belong together. What that adds to the variance was measured on the ideal source; a sum counts as that many fewer
//! ordinates, which makes its law that of groups of ordinates that are copies of each other, and the tails of the ideal
//! source stay below it.

use crate::check::evidence::ComparedShare;
use crate::check::input::Patch;
use crate::check::judge::detectable_change;
use crate::check::judge::replicate_means::{Mean, worst_of};
use crate::check::predict::PairLaw;
use crate::check::subject::Nominal;
use crate::check::tolerance::{POWER, SINGLE_LEVEL, TILT_STRETCH};
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::scene::Fragment;
use crate::stats::autocorrelation::{self, Part};
use crate::stats::chi_square::ChiSquare;
use crate::stats::gamma_sum::{GammaSum, Term};
use crate::stats::spectrum::{self, BandMean, Ordinate, SECTORS};
use crate::stats::{StatsError, Tails, beta, ecdf, fisher_g, normal, power};
use crate::threshold::cdf::MEAN;
use glam::DVec2;
use rand::rngs::Xoshiro256PlusPlus;
use std::rc::Rc;

/// Images of each kind of patch on each side of lerp factor 1/2: enough to see a correlation that is off by a tenth, or a
/// third of the power of the lowest frequencies missing.
const SPECTRUM_IMAGES: usize = 64;

/// Images that share a patch, each at a place of its own: the expected spectrum costs more than an image.
const IMAGES_A_PATCH: usize = 4;

/// Pixels along a side of an image, one claimed size of the noise apart: 256 cells or more.
const SPECTRUM_SIDE: usize = 32;

/// Lags along each axis up to which the autocorrelation is tried, in claimed sizes: a cell is at most two sizes long.
const LAGS: i64 = 4;

/// Rings of frequencies from 0 to half a cycle for each claimed size: the first has eleven ordinates an image.
const RINGS: usize = 6;

/// By how much the variance of a ring is above that of independent ordinates, from the lowest frequencies on: up to 1.03,
/// 0.97, 1.13, 1.26, 1.33 and 1.46 on the ideal source, over every join, 4000 images each; the largest where cells are seen
/// from the side, since their grid repeats within the spectrum.
const RING_COUPLING: [f64; RINGS] = [1.1, 1.1, 1.25, 1.35, 1.45, 1.6];

/// The same for the ratio of a direction to all others: up to 1.20.
const SECTOR_COUPLING: f64 = 1.3;

/// The same for an autocorrelation: up to 1.15.
const LAG_COUPLING: f64 = 1.25;

/// Correlation of pixels at each lag.
pub const AUTOCORRELATION: Claim = Claim {
    id: "spectrum.autocorrelation",
    anchor: "§5.4 (noise of g_HashScale pixels); closed form not in the paper",
    statement: "thresholds of two pixels are as alike, at lags of 0 to 4 sizes of the noise along x and y, as the cells \
                that they share make them",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.12)),
    run: autocorrelation,
};

/// The law of single frequencies.
pub const ORDINATES: Claim = Claim {
    id: "spectrum.ordinates",
    anchor: "§5 (noise without structure); expected spectrum not in the paper",
    statement: "no frequency stands out: the power at each, for what the cells predict, follows the exponential law",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.05)),
    run: ordinates,
};

/// The power in rings of frequencies.
pub const RADIAL: Claim = Claim {
    id: "spectrum.radial",
    anchor: "§5.4 (noise of g_HashScale pixels); expected spectrum not in the paper",
    statement: "coarse and fine structure have the power that the cells predict, ring by ring of the spectrum",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.8)),
    run: radial,
};

/// The power in each direction.
pub const ANISOTROPY: Claim = Claim {
    id: "spectrum.anisotropy",
    anchor: "§6.2 (anisotropy); expected spectrum not in the paper",
    statement: "no direction of the screen has more power, for what the cells predict, than the others",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.3)),
    run: anisotropy,
};

/// Kinds of patches: the ratio of the two derivatives, and what that is called.
const KINDS: [(f64, &str); 3] = [
    (1.0, "frontal"),
    (TILT_STRETCH, "foreshortened along x"),
    (1.0 / TILT_STRETCH, "foreshortened along y"),
];

/// Pixels of an image along x and y.
const SIZE: [usize; 2] = [SPECTRUM_SIDE; 2];

/// Images of one kind of patch on one side of lerp factor 1/2, where an error in the weights has one sign.
struct Group<T> {
    name: String,
    images: Vec<T>,
}

/// Draws `images` of every kind, on either side of lerp factor 1/2, and measures each: `measure` takes the thresholds less their mean, and the autocorrelation
/// that their cells predict at a lag in pixels.
fn measured<T, P>(
    claim: &Claim,
    subject: &Subject<'_>,
    draw: &Draw,
    images: usize,
    prepare: impl Fn(&dyn Fn([i64; 2]) -> f64) -> P,
    measure: impl Fn(&[f64], &P) -> Result<T, StatsError>,
) -> Attempt<Vec<Group<T>>> {
    let mut rng = draw.rng(claim.id);
    let mut groups = Vec::new();
    for (stretch, kind) in KINDS {
        for (above, side) in [(false, "below"), (true, "above")] {
            let mut group = Group { name: format!("{kind}, lerp factor {side} 1/2"), images: Vec::new() };
            for _ in 0..images.div_ceil(IMAGES_A_PATCH) {
                let (patch, nominal) = patch(subject, stretch, above, &mut rng);
                let spacing = subject.hash_scale;
                let fragments: Vec<Fragment> =
                    (0..IMAGES_A_PATCH).flat_map(|_| patch.image(subject, SIZE, spacing, &mut rng)).collect();
                let mut values = subject.thresholds(&fragments);
                reject_outsiders(subject, &fragments, &values)?;
                values.iter_mut().for_each(|value| *value -= MEAN);
                let prepared = prepare(&|lag| {
                    let pixels = DVec2::from_array(lag.map(|l| l as f64)) * spacing;
                    PairLaw::new(subject, &nominal, patch.lag(pixels)).correlation()
                });
                for image in values.chunks_exact(SIZE[0] * SIZE[1]) {
                    group.images.push(measure(image, &prepared).map_err(without_answer)?);
                }
            }
            groups.push(group);
        }
    }
    Ok(groups)
}

/// Draws a patch whose lerp factor is at least 1/2, or below.
fn patch(subject: &Subject<'_>, stretch: f64, above: bool, rng: &mut Xoshiro256PlusPlus) -> (Patch, Nominal) {
    loop {
        let patch = Patch::draw(subject, stretch, rng);
        let nominal = subject.nominal(&patch.footprint());
        if (nominal.lerp_factor >= 0.5) == above {
            return (patch, nominal);
        }
    }
}

fn without_answer(error: StatsError) -> Box<Trial> {
    Box::new(Trial::without(Conclusion::Inconclusive, error.to_string()))
}

/// Pixels that entered.
fn pixels<T>(groups: &[Group<T>]) -> u64 {
    groups.iter().map(|group| (group.images.len() * SIZE[0] * SIZE[1]) as u64).sum()
}

fn lags() -> impl Iterator<Item = [i64; 2]> {
    (0..=LAGS).flat_map(|y| (0..=LAGS).map(move |x| [x, y]))
}

/// What is measured of an image at every lag, less what its cells predict, and the expected spectrum of its patch.
type Lagged = (Vec<f64>, Rc<Vec<f64>>);

/// From an autocovariance at a circular lag to a correlation of pixels: the variance of the threshold is 1/12, and only so
/// many pairs are not across the border.
fn per_correlation([x, y]: [i64; 2]) -> f64 {
    let inside = |lag: i64, side: usize| 1.0 - lag as f64 / side as f64;
    12.0 / (inside(x, SIZE[0]) * inside(y, SIZE[1]))
}

/// The law of the mean error at one lag: each ordinate of each image is a gamma value.
fn law_of(images: &[Lagged], parts: &[Part], scale: f64) -> GammaSum {
    let patches = images.chunk_by(|a, b| Rc::ptr_eq(&a.1, &b.1));
    let terms = patches.flat_map(|patch| {
        let (expected, copies) = (&patch[0].1, patch.len() as f64);
        parts.iter().map(move |part| Term {
            weight: LAG_COUPLING * scale * part.weight * expected[part.index] / images.len() as f64,
            shape: part.shape * copies / LAG_COUPLING,
        })
    });
    GammaSum::new(terms.filter(|term| term.weight != 0.0).collect())
}

fn autocorrelation(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let lags: Vec<([i64; 2], Vec<Part>)> =
        lags().map(|lag| (lag, autocorrelation::parts(SIZE, lag))).collect();
    let at_lag = |(lag, parts): &([i64; 2], Vec<Part>), ordinate: &dyn Fn(usize) -> f64| {
        per_correlation(*lag)
            * parts.iter().map(|part| part.shape * part.weight * ordinate(part.index)).sum::<f64>()
    };
    let measure = |image: &[f64], expected: &Rc<Vec<f64>>| -> Result<Lagged, StatsError> {
        let found = spectrum::periodogram(image, SIZE)?;
        let error = |index: usize| found[index] - expected[index];
        Ok((lags.iter().map(|lag| at_lag(lag, &error)).collect(), Rc::clone(expected)))
    };
    let prepare = |correlation: &dyn Fn([i64; 2]) -> f64| Rc::new(expected_spectrum(correlation));
    let groups =
        measured(&AUTOCORRELATION, subject, draw, draw.samples_at_least(SPECTRUM_IMAGES), prepare, measure)?;
    let (mut means, mut points, mut widest) = (Vec::new(), Vec::new(), None::<GammaSum>);
    for group in &groups {
        let images = group.images.len() as f64;
        let mut of_group = Vec::new();
        for (index, lag) in lags.iter().enumerate() {
            let [x, y] = lag.0;
            let mean = group.images.iter().map(|(errors, _)| errors[index]).sum::<f64>() / images;
            let predicted =
                group.images.iter().map(|(_, expected)| at_lag(lag, &|at| expected[at])).sum::<f64>()
                    / images;
            let law = law_of(&group.images, &lag.1, per_correlation(lag.0));
            let sigma = law.sigma();
            of_group.push(ComparedShare {
                series: format!("lag along y: {y}"),
                x: x as f64,
                measured: predicted + mean,
                predicted,
                sigma,
            });
            let p = law.tails(mean).two_sided_p();
            means.push(Mean { name: format!("{}, lag ({x}, {y})", group.name), mean, sigma, p });
            if widest.as_ref().is_none_or(|widest| sigma > widest.sigma()) {
                widest = Some(law);
            }
        }
        points.push(of_group);
    }
    let detectable = widest.map(|law| {
        let level = 0.5 * SINGLE_LEVEL / means.len() as f64;
        let critical = law.exceeded(level, true).max(-law.exceeded(level, false));
        critical + normal::quantile(POWER) * law.sigma()
    });
    // The picture shows the group with the worst of all.
    let worst = means.iter().enumerate().min_by(|a, b| a.1.p.total_cmp(&b.1.p)).map_or(0, |(index, _)| index);
    let points = points.into_iter().nth(worst / lags.len()).unwrap_or_default();
    let seen = |mean: &Mean| format!("{}: the correlation is off by {:+.3}", mean.name, mean.mean);
    let evidence =
        Evidence::Quantity { abscissa: "lag along x [sizes of the noise]", ordinate: "correlation", points };
    let law = "z, by the law of sums of exponential ordinates";
    Ok(worst_of(&means, law, detectable, pixels(&groups), "error in a correlation", seen, evidence))
}

/// The expected spectrum of an image, of the correlation at each lag in pixels.
fn expected_spectrum(correlation: &dyn Fn([i64; 2]) -> f64) -> Vec<f64> {
    spectrum::expected_periodogram(SIZE, |lag| correlation(lag) / 12.0)
}

/// The ordinates of each image for what its cells predict.
fn periodograms(
    claim: &Claim,
    subject: &Subject<'_>,
    draw: &Draw,
    images: usize,
) -> Attempt<Vec<Group<Vec<Ordinate>>>> {
    let measure = |image: &[f64], expected: &Vec<f64>| {
        spectrum::ordinates(&spectrum::periodogram(image, SIZE)?, expected, SIZE, 1.0)
    };
    measured(claim, subject, draw, images, expected_spectrum, measure)
}

fn ordinates(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    // The exponential law is that of ever larger images: more images of this size would show what they lack.
    let groups = periodograms(&ORDINATES, subject, draw, SPECTRUM_IMAGES)?;
    let images = || groups.iter().flat_map(|group| &group.images);
    let count = images().count();
    let mut ratios: Vec<f64> = images().flatten().map(|ordinate| ordinate.ratio).collect();
    // One frequency that sticks out of its image.
    let tone = images()
        .filter_map(|image| {
            let ratios: Vec<f64> = image.iter().map(|ordinate| ordinate.ratio).collect();
            let found = fisher_g::fisher_g(&ratios).ok()?;
            Some((found, image[found.at].frequency))
        })
        .min_by(|a, b| a.0.p.total_cmp(&b.0.p));
    let points = survival(&ratios);
    let (Ok(distance), Some((tone, [x, y]))) = (ecdf::kolmogorov_smirnov_exponential(&mut ratios), tone)
    else {
        return Ok(Trial::without(Conclusion::Inconclusive, "there were no images"));
    };
    let p_tone = (tone.p * count as f64).min(1.0);
    Ok(Trial {
        conclusion: Conclusion::Probability((2.0 * distance.dkwm.min(p_tone)).min(1.0)),
        statistic: Some(distance.d),
        statistic_name: "Kolmogorov-Smirnov distance from the exponential law".into(),
        n: pixels(&groups),
        effect: Some(distance.d),
        effect_name: "largest error in the share of ordinates above a power",
        detectable: Some(power::detectable_distance_ks(distance.n, 0.5 * SINGLE_LEVEL, POWER)),
        seen: format!(
            "the share of ordinates above a power is off by up to {:.2} %; the strongest frequency of an image is \
             ({x:+.3}, {y:+.3}) cycles per size of the noise, with {:.1} % of its power (p {p_tone:.1e})",
            100.0 * distance.d,
            100.0 * tone.g,
        ),
        evidence: Evidence::Quantity {
            abscissa: "power / predicted",
            ordinate: "share of ordinates above",
            points,
        },
    })
}

/// Shares of the ordinates above round powers.
fn survival(ratios: &[f64]) -> Vec<ComparedShare> {
    let n = ratios.len() as f64;
    let point = |power: f64| {
        let predicted = libm::exp(-power);
        ComparedShare {
            series: "all images".into(),
            x: power,
            measured: ratios.iter().filter(|&&ratio| ratio > power).count() as f64 / n,
            predicted,
            sigma: (predicted * (1.0 - predicted) / n).sqrt(),
        }
    };
    [0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0].map(point).to_vec()
}

fn radial(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let groups = periodograms(&RADIAL, subject, draw, draw.samples_at_least(SPECTRUM_IMAGES))?;
    let centre = |ring: usize| 0.5 * (ring as f64 + 0.5) / RINGS as f64;
    let seen = |mean: &Mean| {
        format!(
            "{} per size of the noise: {:.3} times the power that is predicted",
            mean.name,
            1.0 + mean.mean
        )
    };
    let abscissa = "frequency [cycles per size of the noise]";
    Ok(powers(
        &groups,
        rings,
        |ring| (centre(ring), format!("around {:.2} cycles", centre(ring))),
        seen,
        abscissa,
    ))
}

fn anisotropy(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let groups = periodograms(&ANISOTROPY, subject, draw, draw.samples_at_least(SPECTRUM_IMAGES))?;
    let angle = |sector: usize| 180.0 * sector as f64 / SECTORS as f64;
    let seen = |mean: &Mean| {
        format!(
            "{}: the power is off by {:+.1} % from that of other directions",
            mean.name,
            100.0 * mean.mean
        )
    };
    let name = |sector: usize| (angle(sector), format!("{:.0} degrees", angle(sector)));
    Ok(powers(&groups, sectors, name, seen, "direction [degrees]"))
}

/// The power of a band of frequencies, for what it should be, and the law of that.
struct Band {
    ratio: f64,
    sigma: f64,
    law: Box<dyn Fn(f64) -> Tails>,
}

/// How many degrees of freedom so many exponential values have of which groups belong together.
fn degrees(ordinates: u64, coupling: f64) -> u64 {
    (2.0 * ordinates as f64 / coupling) as u64
}

/// Twice a sum of exponential values is chi-square distributed.
fn rings(ordinates: &[Ordinate]) -> Vec<Band> {
    let band = |(BandMean { n, mean, .. }, coupling): (BandMean, f64)| {
        let dof = degrees(n, coupling);
        let law = move |ratio: f64| ChiSquare::new(ratio * dof as f64, dof, n).tails();
        Band { ratio: mean, sigma: (2.0 / dof as f64).sqrt(), law: Box::new(law) }
    };
    spectrum::ring_means(ordinates, RINGS, 0.5).into_iter().zip(RING_COUPLING).map(band).collect()
}

/// The ratio of two means of exponential values follows Fisher's F.
fn sectors(ordinates: &[Ordinate]) -> Vec<Band> {
    let band = |BandMean { n, mean, .. }: BandMean| {
        let dof = [n, ordinates.len() as u64 - n].map(|n| degrees(n, SECTOR_COUPLING));
        let sigma = dof.map(|dof| 2.0 / dof as f64).iter().sum::<f64>().sqrt();
        Band { ratio: mean, sigma, law: Box::new(move |ratio| beta::f_tails(ratio, dof)) }
    };
    spectrum::sector_means(ordinates).map_or_else(|_| Vec::new(), |found| found.map(band).into())
}

/// Judges the powers of bands of all images together, group by group.
fn powers(
    groups: &[Group<Vec<Ordinate>>],
    bands: impl Fn(&[Ordinate]) -> Vec<Band>,
    place: impl Fn(usize) -> (f64, String),
    seen: impl Fn(&Mean) -> String,
    abscissa: &'static str,
) -> Trial {
    let (mut means, mut points, mut widest) = (Vec::new(), Vec::new(), None::<Band>);
    for group in groups {
        for (index, band) in bands(&group.images.concat()).into_iter().enumerate() {
            let (x, name) = place(index);
            points.push(ComparedShare {
                series: group.name.clone(),
                x,
                measured: band.ratio,
                predicted: 1.0,
                sigma: band.sigma,
            });
            means.push(Mean {
                name: format!("{}, {name}", group.name),
                mean: band.ratio - 1.0,
                sigma: band.sigma,
                p: (band.law)(band.ratio).two_sided_p(),
            });
            if widest.as_ref().is_none_or(|widest| band.sigma > widest.sigma) {
                widest = Some(band);
            }
        }
    }
    let level = SINGLE_LEVEL / means.len() as f64;
    let detectable = widest.map(|band| detectable_change(band.law, level));
    let evidence = Evidence::Quantity { abscissa, ordinate: "power / predicted", points };
    let law = "z, by the law of sums of exponential ordinates";
    worst_of(&means, law, detectable, pixels(groups), "relative error of a power", seen, evidence)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::specimen::ideal;
    use crate::check::subject::Precision;
    use crate::threshold::robust::Join;
    use crate::threshold::two_scale::Variant;

    /// The level of each tail at which the laws are tried: near that of a claim which is rejected in the first round.
    const LEVEL: f64 = 1.0e-9;

    /// The probability of a mean of `n` independent values beyond `critical`, which has the sign of the side: the values are
    /// drawn again with weights that make `critical` their mean (exponential tilting), and the saddle point does the rest.
    ///
    /// With it comes the standard error of its logarithm.
    fn tail(values: &[f64], n: usize, critical: f64) -> [f64; 2] {
        let count = values.len() as f64;
        let moments = |at: f64| {
            let weights: Vec<f64> = values.iter().map(|value| libm::exp(at * value)).collect();
            let sum = |of: &dyn Fn(f64, f64) -> f64| {
                weights.iter().zip(values).map(|(&weight, &value)| of(weight, value)).sum::<f64>()
            };
            let all = sum(&|weight, _| weight);
            let mean = sum(&|weight, value| weight * value) / all;
            let variance = sum(&|weight, value| weight * (value - mean) * (value - mean)) / all;
            let spread = sum(&|weight, _| weight * weight) * count / (all * all) - 1.0;
            (libm::log(all / count), mean, variance, (spread / count).sqrt())
        };
        let (mut low, mut high) = (0.0, 1.0_f64.copysign(critical));
        while moments(high).1.abs() < critical.abs() && high.abs() < 1.0e4 {
            high *= 2.0;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if moments(middle).1.abs() < critical.abs() { low = middle } else { high = middle }
        }
        let (log_moment, _, variance, error) = moments(high);
        let n = n as f64;
        let root = (2.0 * n * (high * critical - log_moment)).sqrt();
        let corrected = root + libm::log(high.abs() * (n * variance).sqrt() / root) / root;
        [normal::upper_p(corrected), n * error]
    }

    /// The largest ratio at which the law has a lower tail below the level, or the smallest at which the upper is.
    fn critical(law: &dyn Fn(f64) -> Tails, above: bool) -> f64 {
        let (mut low, mut high) = if above { (1.0, 16.0) } else { (0.0, 1.0) };
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            let tails = law(middle);
            let inside = if above { tails.upper > LEVEL } else { tails.lower < LEVEL };
            if inside { low = middle } else { high = middle }
        }
        low
    }

    /// Asserts that so many images of the ideal source are no further out than the law says, but for three standard errors.
    fn assert_below(what: &str, values: &[f64], critical: f64) {
        let [p, error] = tail(values, SPECTRUM_IMAGES, critical);
        assert!(p * libm::exp(-3.0 * error) < LEVEL, "{what}: {p:e}, error {error}, at {critical:+}");
    }

    #[test]
    fn tails_of_the_ideal_source_stay_below_their_laws() {
        let many = 8 * SPECTRUM_IMAGES;
        let draw = Draw::seeded(1);
        for (variant, join) in [(Variant::Isotropic, Join::Dithered), (Variant::Anisotropic, Join::Copula)] {
            let subject = ideal(1, variant, Precision::F64, join);
            let parts: Vec<_> = lags().map(|lag| (lag, autocorrelation::parts(SIZE, lag))).collect();
            let prepare = |correlation: &dyn Fn([i64; 2]) -> f64| Rc::new(expected_spectrum(correlation));
            let measure = |image: &[f64], expected: &Rc<Vec<f64>>| {
                let found = spectrum::periodogram(image, SIZE)?;
                let errors = parts.iter().map(|(lag, parts)| {
                    let part =
                        |part: &Part| part.shape * part.weight * (found[part.index] - expected[part.index]);
                    per_correlation(*lag) * parts.iter().map(part).sum::<f64>()
                });
                let lagged = (errors.collect(), Rc::clone(expected));
                Ok((lagged, spectrum::ordinates(&found, expected, SIZE, 1.0)?))
            };
            let groups = measured(&RADIAL, &subject, &draw, many, prepare, measure).expect("thresholds");
            for Group { name, images } in groups {
                let (lagged, ordinates): (Vec<Lagged>, Vec<Vec<Ordinate>>) = images.into_iter().unzip();
                let pooled = ordinates[..SPECTRUM_IMAGES].concat();
                for above in [false, true] {
                    for (ring, band) in rings(&pooled).iter().enumerate() {
                        let values: Vec<f64> = ordinates
                            .iter()
                            .map(|image| spectrum::ring_means(image, RINGS, 0.5)[ring].mean - 1.0)
                            .collect();
                        let critical = critical(&band.law, above) - 1.0;
                        assert_below(&format!("{join}, {name}, ring {ring}"), &values, critical);
                    }
                    for (sector, band) in sectors(&pooled).iter().enumerate() {
                        // The ratio is beyond the critical one where this difference of two sums is beyond 0.
                        let critical = critical(&band.law, above);
                        let values: Vec<f64> = ordinates
                            .iter()
                            .map(|image| {
                                let found = &spectrum::sector_means(image).expect("an image")[sector];
                                let all = image.iter().map(|ordinate| ordinate.ratio).sum::<f64>();
                                let (n, others) = (found.n as f64, (image.len() as u64 - found.n) as f64);
                                let rest = all / (1.0 + found.mean * n / others);
                                (all - rest) / n - critical * rest / others - (1.0 - critical)
                            })
                            .collect();
                        assert_below(&format!("{join}, {name}, sector {sector}"), &values, critical - 1.0);
                    }
                    for (index, (lag, parts)) in parts.iter().enumerate() {
                        let law = law_of(&lagged[..SPECTRUM_IMAGES], parts, per_correlation(*lag));
                        let values: Vec<f64> = lagged.iter().map(|image| image.0[index]).collect();
                        let what = format!("{join}, {name}, lag {lag:?}");
                        assert_below(&what, &values, law.exceeded(LEVEL, above));
                    }
                }
            }
        }
    }
}
