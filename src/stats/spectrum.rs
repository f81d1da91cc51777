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
