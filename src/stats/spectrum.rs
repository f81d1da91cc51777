//! The spectrum of an image against the one that its autocovariance predicts.
//!
//! The periodogram of a stationary field, each ordinate divided by its expectation, is nearly a set of
//! independent exponential values of mean 1. The expectation is exact for every size of image, so that nothing
//! is left of leakage; the exponential law is exact for white normal noise and holds in the limit of large
//! images otherwise; noise with flatter tails than the normal one errs on the safe side. What to ask of the ratios: do they follow the exponential law
//! ([`ecdf::kolmogorov_smirnov_exponential`](super::ecdf::kolmogorov_smirnov_exponential)), is one too large
//! ([`fisher_g`](super::fisher_g::fisher_g)), is a range of frequencies off ([`ring_means`]), is a direction
//! ([`sector_means`])?
//!
//! **Noise that is constant on cells is not stationary**, even if the place of its grid is random: a grid of
//! cells with side L repeats its spectrum every 1/L cycles per pixel, under an envelope. Ordinates that far
//! apart are copies of each other. Take a `band` of 1/(2L) for the largest cells: inside it there are no two.

use super::binomial::{poisson_lower_p, poisson_upper_p};
use super::{StatsError, Tails, beta};
use rustfft::FftPlanner;
use rustfft::num_complex::Complex64;
use std::f64::consts::FRAC_PI_4;

/// Directions that [`sector_means`] tells apart.
pub const SECTORS: usize = 4;

/// Holds one ordinate of a periodogram in units of its expectation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ordinate {
    /// Cycles per pixel along the two axes, each in `[-1/2, 1/2]`.
    pub frequency: [f64; 2],
    /// The ordinate divided by its expectation, at least 0, of mean 1.
    pub ratio: f64,
}

/// Holds the mean of many ordinates and its judgement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BandMean {
    /// Number of ordinates.
    pub n: u64,
    /// Mean of their ratios for a ring; divided by the mean of all others for a sector.
    pub mean: f64,
    /// Tails of the mean, by the law of independent exponential values.
    pub tails: Tails,
}

/// Computes the periodogram of an image: |Σ x exp(-2πi k·r/N)|² divided by the number of pixels.
///
/// `image` holds rows of `size[0]` pixels, `size[1]` of them. The result has the same layout, ordinate `(kx,
/// ky)` standing for that many cycles in the image. The first one, the squared sum, is not centred.
///
/// # Errors
/// [`StatsError::LengthMismatch`] if the image has another size, [`StatsError::Empty`] without pixels.
pub fn periodogram(image: &[f64], size: [usize; 2]) -> Result<Vec<f64>, StatsError> {
    let pixels = size[0] * size[1];
    if image.len() != pixels {
        return Err(StatsError::LengthMismatch { left: image.len(), right: pixels });
    }
    if pixels == 0 {
        return Err(StatsError::Empty);
    }
    Ok(transform(image, size).into_iter().map(|z| z.norm_sqr() / pixels as f64).collect())
}

/// Computes the expectation of the periodogram of a field of mean 0 with the given autocovariance.
///
/// `autocovariance` takes a lag in pixels and is even: the same for `-lag`. The expectation is Σ c(l) (1 -
/// |lx|/Nx) (1 - |ly|/Ny) cos(2π k·l/N) over all lags inside the image, exactly; a mean changes the first
/// ordinate only. Layout as in [`periodogram`].
///
/// # Panics
/// If a side of `size` is 0.
#[must_use]
pub fn expected_periodogram(size: [usize; 2], autocovariance: impl Fn([i64; 2]) -> f64) -> Vec<f64> {
    assert!(size[0] > 0 && size[1] > 0, "an image without pixels");
    let [width, height] = size.map(|n| n as i64);
    let mut folded = vec![0.0; size[0] * size[1]];
    for y in 1 - height..height {
        for x in 1 - width..width {
            let weight = (width - x.abs()) as f64 * (height - y.abs()) as f64 / (width * height) as f64;
            let index = y.rem_euclid(height) * width + x.rem_euclid(width);
            folded[index as usize] += weight * autocovariance([x, y]);
        }
    }
    transform(&folded, size).into_iter().map(|z| z.re).collect()
}

/// Divides a periodogram by its expectation, on one half of the plane of frequencies.
///
/// The other half repeats it. Left out are the ordinates that are their own mirror images, whose law is
/// another, and all whose frequency is not below `band`, in cycles per pixel; 1 lets all pass. Both slices have
/// the layout of [`periodogram`].
///
/// # Errors
/// [`StatsError::LengthMismatch`] if a slice does not fit the size, [`StatsError::Empty`] if no ordinate is in
/// the band, [`StatsError::NotFinite`] with a ratio that is NaN, infinite or negative.
pub fn ordinates(
    periodogram: &[f64],
    expected: &[f64],
    size: [usize; 2],
    band: f64,
) -> Result<Vec<Ordinate>, StatsError> {
    let [width, height] = size;
    for slice in [periodogram, expected] {
        if slice.len() != width * height {
            return Err(StatsError::LengthMismatch { left: slice.len(), right: width * height });
        }
    }
    let mut found = Vec::new();
    for kx in 0..=width / 2 {
        let is_own_mirror = kx == 0 || 2 * kx == width;
        for ky in if is_own_mirror { 1..height.div_ceil(2) } else { 0..height } {
            let cycles = if 2 * ky > height { ky as f64 - height as f64 } else { ky as f64 };
            let frequency = [kx as f64 / width as f64, cycles / height as f64];
            if libm::hypot(frequency[0], frequency[1]) >= band {
                continue;
            }
            let ratio = periodogram[ky * width + kx] / expected[ky * width + kx];
            if !(ratio >= 0.0 && ratio.is_finite()) {
                return Err(StatsError::NotFinite { value: ratio });
            }
            found.push(Ordinate { frequency, ratio });
        }
    }
    if found.is_empty() { Err(StatsError::Empty) } else { Ok(found) }
}

/// Averages the ratios over rings of equal width around frequency 0: does a range of frequencies stand out?
///
/// Ring `i` of `rings` holds the frequencies in `[i, i+1) band / rings`, in cycles per pixel; the result has
/// one entry for each ring with ordinates. A sum of n exponential values has a gamma law, which is summed
/// exactly.
///
/// # Panics
/// If `rings` is 0 or `band` is not above 0.
#[must_use]
pub fn ring_means(ordinates: &[Ordinate], rings: usize, band: f64) -> Vec<BandMean> {
    assert!(rings > 0 && band > 0.0, "{rings} rings up to {band}");
    let mut sums = vec![(0, 0.0); rings];
    for ordinate in ordinates {
        let [x, y] = ordinate.frequency;
        if let Some((n, sum)) = sums.get_mut((libm::hypot(x, y) / band * rings as f64) as usize) {
            *n += 1;
            *sum += ordinate.ratio;
        }
    }
    let mean = |(n, sum)| BandMean {
        n,
        mean: sum / n as f64,
        // The n-th arrival of a Poisson process comes after `sum` if there were fewer than n until then.
        tails: Tails { lower: poisson_upper_p(n, sum), upper: poisson_lower_p(n - 1, sum) },
    };
    sums.into_iter().filter(|&(n, _)| n > 0).map(mean).collect()
}

/// Compares the ratios in each direction with those in all others: is the field as isotropic as predicted?
///
/// The directions are sectors of 45 degrees around 0, 45, 90 and 135 degrees, each with its opposite. The ratio
/// of two means of exponential values follows Fisher's F, exactly.
///
/// # Errors
/// [`StatsError::Empty`] if a sector has no ordinates, [`StatsError::Constant`] if the others add up to 0.
pub fn sector_means(ordinates: &[Ordinate]) -> Result<[BandMean; SECTORS], StatsError> {
    let mut sums = [(0_u64, 0.0); SECTORS];
    for ordinate in ordinates {
        let [x, y] = ordinate.frequency;
        let sector = (libm::atan2(y, x) / FRAC_PI_4).round() as i64;
        let (n, sum) = &mut sums[sector.rem_euclid(SECTORS as i64) as usize];
        *n += 1;
        *sum += ordinate.ratio;
    }
    let all: f64 = sums.iter().map(|(_, sum)| sum).sum();
    if sums.iter().any(|&(n, _)| n == 0) {
        return Err(StatsError::Empty);
    }
    if sums.iter().any(|&(_, sum)| sum >= all) {
        return Err(StatsError::Constant);
    }
    Ok(sums.map(|(n, sum)| {
        let others = ordinates.len() as u64 - n;
        let mean = sum / n as f64 / ((all - sum) / others as f64);
        BandMean { n, mean, tails: beta::f_tails(mean, [2 * n, 2 * others]) }
    }))
}

/// The discrete Fourier transform of an image, in its layout.
fn transform(image: &[f64], [width, height]: [usize; 2]) -> Vec<Complex64> {
    let mut planner = FftPlanner::new();
    let mut rows: Vec<Complex64> = image.iter().map(|&x| Complex64::new(x, 0.0)).collect();
    planner.plan_fft_forward(width).process(&mut rows);
    let mut columns: Vec<Complex64> =
        (0..width).flat_map(|x| rows.iter().skip(x).step_by(width)).copied().collect();
    planner.plan_fft_forward(height).process(&mut columns);
    (0..height).flat_map(|y| columns.iter().skip(y).step_by(height)).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::super::calibration::{assert_close, assert_uniform_p};
    use super::super::seed::{rng, uniform01};
    use super::super::{ecdf, fisher_g, normal};
    use super::*;
    use rand::Rng;
    use std::f64::consts::PI;

    /// Uniform noise of mean 0 on square cells of side `cell` pixels; the place of the grid is random.
    fn cells(side: usize, cell: f64, rng: &mut impl Rng) -> Vec<f64> {
        let stride = (side as f64 / cell) as usize + 2;
        let noise: Vec<f64> = (0..stride * stride).map(|_| uniform01(rng) - 0.5).collect();
        let phase = [uniform01(rng), uniform01(rng)];
        let index = |i: usize, axis: usize| (i as f64 / cell + phase[axis]) as usize;
        (0..side * side).map(|i| noise[index(i / side, 1) * stride + index(i % side, 0)]).collect()
    }

    /// The autocovariance of it.
    fn of_cells(cell: f64) -> impl Fn([i64; 2]) -> f64 {
        move |lag| {
            lag.iter().map(|&l| (1.0 - l.unsigned_abs() as f64 / cell).max(0.0)).product::<f64>() / 12.0
        }
    }

    fn ratios(ordinates: &[Ordinate]) -> Vec<f64> {
        ordinates.iter().map(|ordinate| ordinate.ratio).collect()
    }

    #[test]
    fn the_periodogram_is_the_squared_sum() {
        let size = [5, 4];
        let mut rng = rng("stats.spectrum.sum", 0);
        let image: Vec<f64> = (0..20).map(|_| uniform01(&mut rng)).collect();
        let found = periodogram(&image, size).unwrap();
        for (index, ordinate) in found.into_iter().enumerate() {
            let [kx, ky] = [(index % 5) as f64 / 5.0, (index / 5) as f64 / 4.0];
            let (mut re, mut im) = (0.0, 0.0);
            for (i, x) in image.iter().enumerate() {
                let angle = 2.0 * PI * (kx * (i % 5) as f64 + ky * (i / 5) as f64);
                re += x * libm::cos(angle);
                im += x * libm::sin(angle);
            }
            assert_close(ordinate, (re * re + im * im) / 20.0, 1e-12);
        }
    }

    /// The expected square of the sum, term by term.
    #[test]
    fn the_expectation_leaves_no_leakage() {
        let size = [6, 5];
        let autocovariance = of_cells(2.3);
        let expected = expected_periodogram(size, &autocovariance);
        for (index, &ordinate) in expected.iter().enumerate() {
            let [kx, ky] = [(index % 6) as f64 / 6.0, (index / 6) as f64 / 5.0];
            let mut sum = 0.0;
            for (i, j) in (0..30).flat_map(|i| (0..30).map(move |j| (i, j))) {
                let lag = [i % 6 - j % 6, i / 6 - j / 6];
                let angle = 2.0 * PI * (kx * lag[0] as f64 + ky * lag[1] as f64);
                sum += autocovariance(lag) * libm::cos(angle);
            }
            assert_close(ordinate, sum / 30.0, 1e-12);
        }
        let white = expected_periodogram([8, 8], of_cells(1.0));
        assert!(white.iter().all(|x| (x - 1.0 / 12.0).abs() < 1e-15));
    }

    #[test]
    fn each_frequency_of_the_half_plane_comes_once() {
        for (size, count) in [([8, 8], 30), ([7, 8], 27), ([8, 7], 27), ([7, 7], 24), ([1, 9], 4)] {
            let ones = vec![1.0; size[0] * size[1]];
            let found = ordinates(&ones, &ones, size, 1.0).unwrap();
            assert_eq!(found.len(), count, "{size:?}");
            for (i, a) in found.iter().enumerate() {
                for (j, b) in found.iter().enumerate() {
                    let at = |sign: f64| {
                        (0..2).all(|k| (a.frequency[k] - sign * b.frequency[k]).rem_euclid(1.0) == 0.0)
                    };
                    assert!(!at(-1.0) && (i == j || !at(1.0)), "{size:?}: {a:?} {b:?}");
                }
            }
        }
    }

    /// White normal noise, for which all of these laws are exact.
    #[test]
    fn p_is_uniform_on_an_ideal_source() {
        let size = [24, 16];
        let expected = vec![1.0; 24 * 16];
        let image = |rng: &mut _| {
            let image: Vec<f64> =
                (0..24 * 16).map(|_| normal::quantile(uniform01(rng).max(1e-300))).collect();
            ordinates(&periodogram(&image, size).unwrap(), &expected, size, 0.5).unwrap()
        };
        assert_uniform_p("stats.spectrum.exponential", |rng| {
            ecdf::kolmogorov_smirnov_exponential(&mut ratios(&image(rng))).unwrap().p
        });
        assert_uniform_p("stats.spectrum.peak", |rng| fisher_g::fisher_g(&ratios(&image(rng))).unwrap().p);
        assert_uniform_p("stats.spectrum.ring", |rng| ring_means(&image(rng), 4, 0.5)[1].tails.two_sided_p());
        assert_uniform_p("stats.spectrum.sector", |rng| {
            sector_means(&image(rng)).unwrap()[1].tails.two_sided_p()
        });
    }

    /// The smallest p-values of the exponential law, the peak, 8 rings and the sectors, for one image.
    fn verdicts(image: &[f64], expected: &[f64], side: usize, band: f64) -> [f64; 4] {
        let found = ordinates(&periodogram(image, [side; 2]).unwrap(), expected, [side; 2], band).unwrap();
        let least = |means: &[BandMean]| means.iter().map(|m| m.tails.two_sided_p()).fold(1.0, f64::min);
        [
            ecdf::kolmogorov_smirnov_exponential(&mut ratios(&found)).unwrap().p,
            fisher_g::fisher_g(&ratios(&found)).unwrap().p,
            least(&ring_means(&found, 8, band)),
            least(&sector_means(&found).unwrap()),
        ]
    }

    /// The copies outside the band refute sound noise: the exponential law in more than half of the images of
    /// cells two pixels wide.
    #[test]
    fn a_field_of_cells_passes_inside_its_band_only() {
        let (side, runs) = (64, 40);
        let mut rng = rng("stats.spectrum.cells", 0);
        for cell in [1.0, 1.7, 2.0, 3.3] {
            let expected = expected_periodogram([side; 2], of_cells(cell));
            let images: Vec<_> = (0..runs).map(|_| cells(side, cell, &mut rng)).collect();
            let rejected =
                |band| images.iter().filter(|image| verdicts(image, &expected, side, band)[0] < 1e-3).count();
            assert_eq!(rejected(0.5 / cell), 0, "cells of {cell}");
            if cell == 2.0 {
                assert!(rejected(1.0) > runs / 2);
            }
        }
    }

    /// Cells of the predicted size pass. Smaller ones, tall ones and a wave across the image do not.
    #[test]
    fn broken_fields_are_rejected() {
        let (side, cell) = (256, 1.8);
        let band = 0.5 / cell;
        let mut rng = rng("stats.spectrum.broken", 0);
        let sound = cells(side, cell, &mut rng);
        let expected = expected_periodogram([side; 2], of_cells(cell));
        assert!(verdicts(&sound, &expected, side, band).into_iter().all(|p| p > 1e-5));
        let [exponential, _, ring, _] = verdicts(&cells(side, 1.5, &mut rng), &expected, side, band);
        assert!(exponential < 1e-9 && ring < 1e-9, "{exponential} {ring}");
        let tall: Vec<f64> = (0..side * side).map(|i| sound[i / side / 2 * side + i % side]).collect();
        let [.., sector] = verdicts(&tall, &expected, side, band);
        assert!(sector < 1e-9, "{sector}");
        let wave: Vec<f64> = (0..side * side)
            .map(|i| {
                sound[i] + 0.03 * libm::cos(2.0 * PI * (i % side * 20 + i / side * 31) as f64 / side as f64)
            })
            .collect();
        let [_, peak, ..] = verdicts(&wave, &expected, side, band);
        assert!(peak < 1e-9, "{peak}");
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        assert_eq!(periodogram(&[1.0; 5], [2, 3]), Err(StatsError::LengthMismatch { left: 5, right: 6 }));
        let wrong = ordinates(&[1.0; 5], &[1.0; 6], [2, 3], 0.5);
        assert_eq!(wrong.map(|found| found.len()), Err(StatsError::LengthMismatch { left: 5, right: 6 }));
        assert_eq!(periodogram(&[], [0, 3]), Err(StatsError::Empty));
        assert_eq!(ordinates(&[1.0; 4], &[1.0; 4], [2, 2], 1.0), Err(StatsError::Empty));
        assert!(ordinates(&[1.0; 9], &[0.0; 9], [3, 3], 1.0).is_err());
        assert_eq!(sector_means(&[]), Err(StatsError::Empty));
    }
}
