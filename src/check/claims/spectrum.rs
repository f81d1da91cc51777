//! The noise as a picture: its autocorrelation and its spectrum, against what cells of the claimed size predict.
//!
//! White noise is the wrong model: neighbouring pixels share cells, so low frequencies are stronger than high ones,
//! by up to a factor of four. The expected periodogram is known exactly, and every image of a patch is divided by it.
//!
//! Noise that is constant on cells is not stationary: frequencies whose distance is a frequency of the grid belong
//! together. So what is tested by a closed law is one image against the next, not one frequency against the next.

use crate::check::evidence::ComparedShare;
use crate::check::input::Patch;
use crate::check::judge::replicate_means;
use crate::check::judge::replicate_means::Mean;
use crate::check::predict::PairLaw;
use crate::check::subject::Nominal;
use crate::check::tolerance::{POWER, SINGLE_LEVEL, TILT_STRETCH};
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::scene::Fragment;
use crate::stats::spectrum::{self, Ordinate, SECTORS};
use crate::stats::{StatsError, autocorrelation, ecdf, fisher_g, power};
use crate::threshold::cdf::MEAN;
use glam::DVec2;
use rand::rngs::Xoshiro256PlusPlus;

/// Images of each kind of patch on each side of lerp factor 1/2: enough for a usable tail of Student's law, and to see a
/// correlation that is off by a tenth, or half the power of the lowest frequencies missing.
const SPECTRUM_IMAGES: usize = 64;

/// Images that share a patch, each at a place of its own: the expected spectrum costs more than an image.
const IMAGES_A_PATCH: usize = 4;

/// Pixels along a side of an image, one claimed size of the noise apart: 256 cells or more.
const SPECTRUM_SIDE: usize = 32;

/// Lags along each axis up to which the autocorrelation is tried, in claimed sizes: a cell is at most two sizes long.
const LAGS: i64 = 4;

/// Rings of frequencies from 0 to half a cycle for each claimed size: the first has eleven ordinates an image.
const RINGS: usize = 6;

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

fn autocorrelation(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    // Of each image, measured and predicted correlation at every lag.
    let prepare = |correlation: &dyn Fn([i64; 2]) -> f64| lags().map(correlation).collect::<Vec<f64>>();
    let measure = |image: &[f64], predicted: &Vec<f64>| {
        lags()
            .zip(predicted)
            .map(|(lag, &predicted)| {
                Ok([12.0 * autocorrelation::estimate(image, SIZE, 0.0, lag)?, predicted])
            })
            .collect::<Result<Vec<[f64; 2]>, StatsError>>()
    };
    let groups =
        measured(&AUTOCORRELATION, subject, draw, draw.samples_at_least(SPECTRUM_IMAGES), prepare, measure)?;
    let (mut means, mut points) = (Vec::new(), Vec::new());
    for group in &groups {
        let mut of_group = Vec::new();
        for (index, [x, y]) in lags().enumerate() {
            let column: Vec<[f64; 2]> = group.images.iter().map(|image| image[index]).collect();
            let errors: Vec<f64> = column.iter().map(|[measured, predicted]| measured - predicted).collect();
            let Some(mean) = Mean::of(format!("{}, lag ({x}, {y})", group.name), &errors) else { continue };
            let predicted = column.iter().map(|pair| pair[1]).sum::<f64>() / column.len() as f64;
            of_group.push(ComparedShare {
                series: format!("lag along y: {y}"),
                x: x as f64,
                measured: predicted + mean.mean,
                predicted,
                sigma: mean.sigma,
            });
            means.push(mean);
        }
        points.push(of_group);
    }
    // The picture shows the group with the worst of all.
    let worst = means.iter().enumerate().min_by(|a, b| a.1.p.total_cmp(&b.1.p)).map_or(0, |(index, _)| index);
    let shown = worst / lags().count();
    let points = points.into_iter().nth(shown).unwrap_or_default();
    let seen = |mean: &Mean| format!("{}: the correlation is off by {:+.3}", mean.name, mean.mean);
    let evidence =
        Evidence::Quantity { abscissa: "lag along x [sizes of the noise]", ordinate: "correlation", points };
    Ok(replicate_means::worst_of(&means, pixels(&groups), "error in a correlation", seen, evidence))
}

/// The ordinates of each image for what its cells predict.
fn periodograms(
    claim: &Claim,
    subject: &Subject<'_>,
    draw: &Draw,
    images: usize,
) -> Attempt<Vec<Group<Vec<Ordinate>>>> {
    let prepare = |correlation: &dyn Fn([i64; 2]) -> f64| {
        spectrum::expected_periodogram(SIZE, |lag| correlation(lag) / 12.0)
    };
    let measure = |image: &[f64], expected: &Vec<f64>| {
        spectrum::ordinates(&spectrum::periodogram(image, SIZE)?, expected, SIZE, 1.0)
    };
    measured(claim, subject, draw, images, prepare, measure)
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
    let band = |ring: usize| 0.5 * (ring as f64 + 0.5) / RINGS as f64;
    let rings = |image: &Vec<Ordinate>| {
        spectrum::ring_means(image, RINGS, 0.5).into_iter().map(|ring| ring.mean - 1.0).collect()
    };
    let name = |ring: usize| format!("around {:.2} cycles", band(ring));
    let seen = |mean: &Mean| {
        format!(
            "{} per size of the noise: {:.3} times the power that is predicted",
            mean.name,
            1.0 + mean.mean
        )
    };
    let abscissa = "frequency [cycles per size of the noise]";
    Ok(powers(&groups, rings, band, name, seen, abscissa))
}

fn anisotropy(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let groups = periodograms(&ANISOTROPY, subject, draw, draw.samples_at_least(SPECTRUM_IMAGES))?;
    let angle = |sector: usize| 180.0 * sector as f64 / SECTORS as f64;
    let sectors = |image: &Vec<Ordinate>| {
        let all = image.iter().map(|ordinate| ordinate.ratio).sum::<f64>() / image.len() as f64;
        let mean = |of: spectrum::BandMean| {
            // From the mean of all others back to the mean of the sector itself, which has an expectation.
            let share = of.n as f64 / image.len() as f64;
            of.mean * all / (1.0 - share + share * of.mean) - all
        };
        spectrum::sector_means(image).map_or_else(|_| Vec::new(), |found| found.map(mean).to_vec())
    };
    let name = |sector: usize| format!("{:.0} degrees", angle(sector));
    let seen = |mean: &Mean| {
        format!("{}: the power is off by {:+.1} % from that of all directions", mean.name, 100.0 * mean.mean)
    };
    Ok(powers(&groups, sectors, angle, name, seen, "direction [degrees]"))
}

/// Judges relative errors of power, one a band of each image, group by group.
fn powers(
    groups: &[Group<Vec<Ordinate>>],
    errors: impl Fn(&Vec<Ordinate>) -> Vec<f64>,
    abscissa_of: impl Fn(usize) -> f64,
    name: impl Fn(usize) -> String,
    seen: impl Fn(&Mean) -> String,
    abscissa: &'static str,
) -> Trial {
    let (mut means, mut points) = (Vec::new(), Vec::new());
    for group in groups {
        let images: Vec<Vec<f64>> = group.images.iter().map(&errors).collect();
        for band in 0..images.iter().map(Vec::len).min().unwrap_or(0) {
            let errors: Vec<f64> = images.iter().map(|image| image[band]).collect();
            let Some(mean) = Mean::of(format!("{}, {}", group.name, name(band)), &errors) else { continue };
            points.push(ComparedShare {
                series: group.name.clone(),
                x: abscissa_of(band),
                measured: 1.0 + mean.mean,
                predicted: 1.0,
                sigma: mean.sigma,
            });
            means.push(mean);
        }
    }
    let evidence = Evidence::Quantity { abscissa, ordinate: "power / predicted", points };
    replicate_means::worst_of(&means, pixels(groups), "relative error of a power", seen, evidence)
}
