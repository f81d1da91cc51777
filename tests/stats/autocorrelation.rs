//! `stats::autocorrelation`.

use super::calibration::{assert_close, assert_uniform_p};
use hashed_alpha::stats::autocorrelation::*;
use hashed_alpha::stats::gamma_sum::{GammaSum, Term};
use hashed_alpha::stats::normal;
use hashed_alpha::stats::seed::uniform01;
use hashed_alpha::stats::spectrum::periodogram;

fn at_lag(parts: &[Part], ordinates: &[f64]) -> f64 {
    parts.iter().map(|part| part.shape * part.weight * ordinates[part.index]).sum()
}

#[test]
fn parts_add_up_to_the_products_of_pairs() {
    for size in [[3, 2], [4, 4], [5, 3], [8, 6]] {
        let [width, height] = size;
        let image: Vec<f64> = (0..width * height).map(|i| (i * i % 7) as f64 - 2.0).collect();
        let ordinates = periodogram(&image, size).unwrap();
        for lag in [[0, 0], [1, 0], [0, 1], [1, 1], [-1, 1], [2, -1], [7, 5]] {
            let products = (0..width * height).map(|i| {
                let x = (i as i64 % width as i64 + lag[0]).rem_euclid(width as i64) as usize;
                let y = (i as i64 / width as i64 + lag[1]).rem_euclid(height as i64) as usize;
                image[i] * image[y * width + x]
            });
            let mean = products.sum::<f64>() / (width * height) as f64;
            let found = at_lag(&parts(size, lag), &ordinates);
            assert!((found - mean).abs() < 1e-12, "{size:?} {lag:?}: {found} {mean}");
        }
    }
}

/// White normal noise, whose ordinates follow the exponential law exactly.
#[test]
fn p_is_uniform_on_an_ideal_source() {
    let size = [16, 12];
    for (name, lag) in [("variance", [0, 0]), ("diagonal", [1, 2])] {
        let parts = parts(size, lag);
        let terms = parts.iter().map(|&Part { weight, shape, .. }| Term { weight, shape });
        let law = GammaSum::new(terms.filter(|term| term.weight != 0.0).collect());
        let expected: f64 = parts.iter().map(|part| part.shape * part.weight).sum();
        assert_close(law.sigma(), (2.0 / 192.0_f64 / if lag == [0, 0] { 1.0 } else { 2.0 }).sqrt(), 1e-9);
        assert_uniform_p(&format!("stats.autocorrelation.{name}"), |rng| {
            let image: Vec<f64> = (0..192).map(|_| normal::quantile(uniform01(rng).max(1e-300))).collect();
            let ordinates = periodogram(&image, size).unwrap();
            law.tails(at_lag(&parts, &ordinates) - expected).two_sided_p()
        });
    }
}
