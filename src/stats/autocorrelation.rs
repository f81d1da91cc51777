//! Does a field repeat itself as predicted? Autocorrelation of images and series.
//!
//! A series is an image of one row. The mean of the field is known, not estimated, so that an estimate at one
//! lag is the plain average of the products at that distance.

use super::StatsError;

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

/// Columns and rows of the pixels that have a pair; not above 0 if there are none.
fn overlap(size: [usize; 2], lag: [i64; 2]) -> [i64; 2] {
    [0, 1].map(|axis| size[axis] as i64 - lag[axis].abs())
}

#[cfg(test)]
mod tests {
    use super::super::calibration::{assert_close, assert_uniform_p};
    use super::super::normal;
    use super::super::seed::uniform01;
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
    }

    /// Independent images, judged by their own spread.
    #[test]
    fn p_is_uniform_on_an_ideal_source() {
        assert_uniform_p("stats.autocorrelation.replicas", |rng| {
            let estimates: Vec<f64> =
                (0..6).map(|_| estimate(&smooth(2, rng), SIZE, 0.0, [1, 1]).unwrap()).collect();
            Variance::of(&estimates).unwrap().mean_p(1.0)
        });
    }
}
