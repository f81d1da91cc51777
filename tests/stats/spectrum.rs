//! `stats::spectrum`.

use super::calibration::{assert_close, assert_uniform_p};
use hashed_alpha::stats::StatsError;
use hashed_alpha::stats::seed::{rng, uniform01};
use hashed_alpha::stats::spectrum::*;
use hashed_alpha::stats::{ecdf, fisher_g, normal};
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
    move |lag| lag.iter().map(|&l| (1.0 - l.unsigned_abs() as f64 / cell).max(0.0)).product::<f64>() / 12.0
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
        let image: Vec<f64> = (0..24 * 16).map(|_| normal::quantile(uniform01(rng).max(1e-300))).collect();
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
        .map(|i| sound[i] + 0.03 * libm::cos(2.0 * PI * (i % side * 20 + i / side * 31) as f64 / side as f64))
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
