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
