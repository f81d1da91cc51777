//! Does a field repeat itself as predicted? Autocorrelation of images and series.
//!
//! A series is an image of one row. The mean of the field is known, not estimated, so that an estimate at one
//! lag is the plain average of the products at that distance.

use super::{StatsError, chi_square::ChiSquare, normal};

/// Holds the autocovariance of an image at one lag and its judgement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Autocovariance {
    /// Average product of two pixels at that distance, less the mean each.
    pub estimate: f64,
    /// What it should be.
    pub expected: f64,
    /// Standard deviation of the estimate.
    pub standard_error: f64,
    /// Standard score: (estimate - expected) / standard error.
    pub z: f64,
    /// Two-sided p-value of `z` by the normal law, which holds in the limit of large images.
    pub p: f64,
}

/// Tests the autocovariance of an image at one lag, in pixels.
///
/// `image` holds rows of `size[0]` pixels around `mean`; `autocovariance` takes a lag and is even. The standard
/// error is Bartlett's, with the exact weights of a finite image: with c for the autocovariance and M for the
/// pairs, the variance is Σ w(u) (c(u)² + c(u+l) c(u-l)) / M², where w(u) counts the pairs of pairs at distance
/// u. It is exact for a normal field at any lag, and for independent values of any law at a lag that is not 0.
/// For others it lacks the fourth cumulant. Where that matters, measure several independent images and judge
/// the mean of their estimates by [`Variance::mean_p`](super::variance::Variance::mean_p), which assumes nothing
/// of the field.
///
/// # Errors
/// [`StatsError::LengthMismatch`] if the image has another size, [`StatsError::Empty`] if the lag leaves no
/// pairs, [`StatsError::Constant`] if the standard error is not above 0.
pub fn autocovariance(
    image: &[f64],
    size: [usize; 2],
    mean: f64,
    autocovariance: impl Fn([i64; 2]) -> f64,
    lag: [i64; 2],
) -> Result<Autocovariance, StatsError> {
    let estimate = estimate(image, size, mean, lag)?;
    let standard_error = standard_error(size, &autocovariance, lag);
    if !(standard_error > 0.0 && standard_error.is_finite()) {
        return Err(StatsError::Constant);
    }
    let expected = autocovariance(lag);
    let z = (estimate - expected) / standard_error;
    Ok(Autocovariance { estimate, expected, standard_error, z, p: normal::two_sided_p(z) })
}

/// Averages the products of all pairs of pixels at a lag, less the mean each: the estimate of the
/// autocovariance.
///
/// # Errors
/// [`StatsError::LengthMismatch`] if the image has another size, [`StatsError::Empty`] if the lag leaves no
/// pairs.
pub fn estimate(image: &[f64], size: [usize; 2], mean: f64, lag: [i64; 2]) -> Result<f64, StatsError> {
    if image.len() != size[0] * size[1] {
        return Err(StatsError::LengthMismatch { left: image.len(), right: size[0] * size[1] });
    }
    let [columns, rows] = overlap(size, lag);
    if columns <= 0 || rows <= 0 {
        return Err(StatsError::Empty);
    }
    // The pair of a pixel is on its right or left, and always below or in the same row.
    let [dx, dy] = if lag[1] < 0 { lag.map(|l| -l) } else { lag };
    let (left, right) = ((-dx).max(0) as usize, dx.max(0) as usize);
    let (columns, below) = (columns as usize, dy as usize);
    let sum: f64 = (0..rows as usize)
        .map(|row| {
            let first = &image[row * size[0] + left..][..columns];
            let second = &image[(row + below) * size[0] + right..][..columns];
            first.iter().zip(second).map(|(a, b)| (a - mean) * (b - mean)).sum::<f64>()
        })
        .sum();
    Ok(sum / (columns as i64 * rows) as f64)
}

/// Bartlett's standard error for a finite image.
fn standard_error(size: [usize; 2], c: impl Fn([i64; 2]) -> f64, lag: [i64; 2]) -> f64 {
    let [columns, rows] = overlap(size, lag);
    let mut sum = 0.0;
    for y in 1 - rows..rows {
        for x in 1 - columns..columns {
            let weight = ((columns - x.abs()) * (rows - y.abs())) as f64;
            let around = c([x + lag[0], y + lag[1]]) * c([x - lag[0], y - lag[1]]);
            sum += weight * (c([x, y]).powi(2) + around);
        }
    }
    sum.sqrt() / (columns * rows) as f64
}

/// Columns and rows of the pixels that have a pair; not above 0 if there are none.
fn overlap(size: [usize; 2], lag: [i64; 2]) -> [i64; 2] {
    [0, 1].map(|axis| size[axis] as i64 - lag[axis].abs())
}

/// Tests whether a series has any serial correlation up to a lag: Ljung and Box.
///
/// The statistic n (n+2) Σ r(l)²/(n-l), over lags 1 to `lags`, is chi-square distributed in the limit of many
/// values; the mean and the variance are those of the series. The effect is that of n values. Source: Ljung and
/// Box 1978, Biometrika 65.
///
/// # Errors
/// [`StatsError::Empty`] without lags or with fewer than 3 values a lag, [`StatsError::Constant`] if the series does not
/// vary (or is not finite).
pub fn ljung_box(series: &[f64], lags: usize) -> Result<ChiSquare, StatsError> {
    if lags == 0 || series.len() < 3 * lags {
        return Err(StatsError::Empty);
    }
    let n = series.len() as f64;
    let mean = series.iter().sum::<f64>() / n;
    let products =
        |lag: usize| -> f64 { series.iter().zip(&series[lag..]).map(|(a, b)| (a - mean) * (b - mean)).sum() };
    let squares = products(0);
    if !(squares > 0.0 && squares.is_finite()) {
        return Err(StatsError::Constant);
    }
    let sum: f64 = (1..=lags).map(|lag| (products(lag) / squares).powi(2) / (n - lag as f64)).sum();
    Ok(ChiSquare::new(n * (n + 2.0) * sum, lags as u64, series.len() as u64))
}

#[cfg(test)]
mod tests {
    use super::super::calibration::{assert_close, assert_uniform_p};
    use super::super::seed::{rng, uniform01};
    use super::super::variance::Variance;
    use super::*;
    use rand::Rng;

    const SIZE: [usize; 2] = [48, 40];

    /// Normal noise, each pixel the sum of a window of `side` by `side` white ones.
    fn smooth(side: usize, rng: &mut impl Rng) -> Vec<f64> {
        let [width, height] = [SIZE[0] + side, SIZE[1] + side];
        let white: Vec<f64> =
            (0..width * height).map(|_| normal::quantile(uniform01(rng).max(1e-300))).collect();
        let window = |i: usize| {
            let (x, y) = (i % SIZE[0], i / SIZE[0]);
            (0..side * side).map(|j| white[(y + j / side) * width + x + j % side]).sum()
        };
        (0..SIZE[0] * SIZE[1]).map(window).collect()
    }

    fn of_windows(side: i64) -> impl Fn([i64; 2]) -> f64 {
        move |lag| lag.iter().map(|l| (side - l.abs()).max(0) as f64).product()
    }

    #[test]
    fn pairs_are_those_at_the_lag() {
        let image = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        for (lag, sum) in [
            ([0, 0], 91.0 / 6.0),
            ([1, 0], (2.0 + 6.0 + 20.0 + 30.0) / 4.0),
            ([0, 1], (4.0 + 10.0 + 18.0) / 3.0),
            ([1, 1], (5.0 + 12.0) / 2.0),
            ([-1, 1], (8.0 + 15.0) / 2.0),
            ([2, -1], 12.0),
        ] {
            assert_close(estimate(&image, [3, 2], 0.0, lag).unwrap(), sum, 1e-15);
            assert_close(estimate(&image, [3, 2], 0.0, lag.map(|l| -l)).unwrap(), sum, 1e-15);
        }
        assert_close(estimate(&image, [6, 1], 3.5, [1, 0]).unwrap(), 8.75 / 5.0, 1e-15);
        assert_eq!(estimate(&image, [3, 2], 0.0, [3, 0]), Err(StatsError::Empty));
        assert!(estimate(&image, [3, 3], 0.0, [0, 0]).is_err());
        assert_eq!(autocovariance(&image, [3, 2], 0.0, |_| 0.0, [1, 0]), Err(StatsError::Constant));
    }

    /// White noise: σ⁴/M, and 2σ⁴/M at lag 0.
    #[test]
    fn white_noise_has_a_known_error() {
        let white = |lag| if lag == [0, 0] { 3.0 } else { 0.0 };
        assert_close(standard_error([20, 10], white, [2, -1]), 3.0 / 162_f64.sqrt(), 1e-14);
        assert_close(standard_error([20, 10], white, [0, 0]), 3.0 * 0.01_f64.sqrt(), 1e-14);
    }

    #[test]
    fn p_is_uniform_on_an_ideal_source() {
        for (lag, side) in [([1, 0], 1), ([2, 1], 2), ([1, -2], 3)] {
            assert_uniform_p(&format!("stats.autocorrelation.{side}"), |rng| {
                let image = smooth(side, rng);
                autocovariance(&image, SIZE, 0.0, of_windows(side as i64), lag).unwrap().p
            });
        }
        assert_uniform_p("stats.autocorrelation.ljung_box", |rng| {
            let series: Vec<f64> = (0..1000).map(|_| uniform01(rng)).collect();
            ljung_box(&series, 8).unwrap().p
        });
        // Independent images, judged by their own spread.
        assert_uniform_p("stats.autocorrelation.replicas", |rng| {
            let estimates: Vec<f64> =
                (0..6).map(|_| estimate(&smooth(2, rng), SIZE, 0.0, [1, 1]).unwrap()).collect();
            Variance::of(&estimates).unwrap().mean_p(1.0)
        });
    }

    /// A field one pixel too smooth; a series in which every tenth value is the last one again.
    #[test]
    fn what_repeats_itself_is_rejected() {
        let mut rng = rng("stats.autocorrelation.broken", 0);
        let image = smooth(3, &mut rng);
        assert!(autocovariance(&image, SIZE, 0.0, of_windows(2), [2, 0]).unwrap().p < 1e-9);
        let mut series: Vec<f64> = (0..10_000).map(|_| uniform01(&mut rng)).collect();
        assert!(ljung_box(&series, 8).unwrap().p > 1e-4);
        (10..10_000).step_by(10).for_each(|i| series[i] = series[i - 1]);
        assert!(ljung_box(&series, 8).unwrap().p < 1e-9);
    }

    /// By hand, for six values.
    #[test]
    fn the_statistic_matches_the_definition() {
        let c = ljung_box(&[1.0, 2.0, 3.0, 4.0, 5.0, 4.0], 2).unwrap();
        let x = [1.0, 2.0, 3.0, 4.0, 5.0, 4.0].map(|x| x - 19.0 / 6.0);
        let r = |lag: usize| {
            (lag..6).map(|i| x[i] * x[i - lag]).sum::<f64>() / x.map(|x| x * x).iter().sum::<f64>()
        };
        assert_close(c.statistic, 48.0 * (r(1).powi(2) / 5.0 + r(2).powi(2) / 4.0), 1e-14);
        assert_eq!((c.dof, c.n), (2, 6));
        assert_eq!(ljung_box(&[1.0, 2.0], 1), Err(StatsError::Empty));
        assert_eq!(ljung_box(&[1.0; 9], 2), Err(StatsError::Constant));
    }
}
