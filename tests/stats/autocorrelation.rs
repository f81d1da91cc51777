//! `stats::autocorrelation`.

use super::calibration::{assert_close, assert_uniform_p};
use hashed_alpha::stats::StatsError;
use hashed_alpha::stats::autocorrelation::*;
use hashed_alpha::stats::normal;
use hashed_alpha::stats::seed::uniform01;
use hashed_alpha::stats::variance::Variance;
use rand::Rng;

const SIZE: [usize; 2] = [48, 40];

/// Normal noise, each pixel the sum of a window of `side` by `side` white ones.
fn smooth(side: usize, rng: &mut impl Rng) -> Vec<f64> {
    let [width, height] = [SIZE[0] + side, SIZE[1] + side];
    let white: Vec<f64> = (0..width * height).map(|_| normal::quantile(uniform01(rng).max(1e-300))).collect();
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
