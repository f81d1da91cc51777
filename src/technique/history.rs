//! What temporal antialiasing makes of a sequence of frames: an exponential average with a history that follows the motion
//! of the camera and is clamped (§7.2; Karis 2014).

use crate::scene::Camera;
use glam::DVec2;

/// Returns the next value of the average: `(1 - weight) history + weight current`.
///
/// `weight` is in (0, 1]; engines take about 0.1 or less.
#[must_use]
pub fn accumulate(history: f64, current: f64, weight: f64) -> f64 {
    (1.0 - weight) * history + weight * current
}

/// Brings the history into the range of the current frame around the pixel, so that what is no longer there fades at
/// once. No neighbours leave it as it is.
///
/// Under a binary test the range is [0, 1] or one value: where all neighbours agree, the history is thrown away.
#[must_use]
pub fn clamp_history(history: f64, neighbourhood: &[f64]) -> f64 {
    let least = neighbourhood.iter().copied().fold(f64::INFINITY, f64::min);
    let most = neighbourhood.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if least <= most { history.clamp(least, most) } else { history }
}

/// Returns the way from where a still surface is seen to where it was seen before, in pixels: the history of the pixel is
/// found there. `None` where it was behind the camera.
///
/// `pixel` is in pixels of the camera `now`, `depth` along its line of sight, in object units; infinite for the sky, which
/// moves when the camera turns.
#[must_use]
pub fn way_back(now: &Camera, before: &Camera, pixel: DVec2, depth: f64) -> Option<DVec2> {
    let direction = now.ray(pixel).direction;
    let [here, there] = if depth.is_finite() {
        [now.eye + direction * depth; 2]
    } else {
        [now.eye + direction, before.eye + direction]
    };
    Some(before.project(there)? - now.project(here)?)
}

/// Returns the variance of the average of independent frames, in variances of one frame: `weight / (2 - weight)`.
///
/// A weight of 0.1 is worth 19 frames. Stratified frames do better.
#[must_use]
pub fn variance_factor(weight: f64) -> f64 {
    weight / (2.0 - weight)
}

/// Returns after how many frames what has vanished counts for no more than `residual` of the average: ghosting time
/// without a clamp, `ceil(ln residual / ln (1 - weight))`. Both are in (0, 1).
#[must_use]
pub fn ghosting_frames(weight: f64, residual: f64) -> f64 {
    (libm::log(residual) / libm::log1p(-weight)).ceil()
}

/// Returns the average after frame `i` of a sequence that has been repeated for ever; `i` counts modulo its length.
/// NaN for an empty sequence.
#[must_use]
pub fn steady_state(sequence: &[f64], weight: f64, i: usize) -> f64 {
    let n = sequence.len();
    let kept = 1.0 - weight;
    let (mut sum, mut share) = (0.0, weight);
    for age in 0..n {
        sum += share * sequence[(i % n + n - age) % n];
        share *= kept;
    }
    // What one round leaves is what the rounds before it add.
    sum * weight / (weight - share)
}

/// Returns the difference between the highest and the lowest average over a repeated sequence: the flicker that stays
/// for ever although nothing moves (§7.2.2, §7.2.3).
#[must_use]
pub fn flicker_range(sequence: &[f64], weight: f64) -> f64 {
    let averages = (0..sequence.len()).map(|i| steady_state(sequence, weight, i));
    let (least, most) = averages
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), a| (f64::min(least, a), f64::max(most, a)));
    most - least
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::threshold::hash::mm4::murmur3;
    use crate::threshold::hash::open_lattice;
    use crate::threshold::stage::order::Order;
    use core::num::NonZeroU32;
    use glam::{DVec3, dvec2, dvec3};

    #[test]
    fn a_repeated_sequence_settles_where_the_closed_form_says() {
        let sequence = [1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0];
        let mut history = 0.3;
        for _ in 0..200 {
            for current in sequence {
                history = accumulate(history, current, 0.1);
            }
        }
        assert!((history - steady_state(&sequence, 0.1, 6)).abs() < 1e-12);
        assert!((steady_state(&[0.7; 5], 0.1, 3) - 0.7).abs() < 1e-12);
        assert!((steady_state(&sequence, 1.0, 3) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn independent_frames_keep_the_variance_said() {
        let weight = 0.1;
        let (mut history, mut sum, mut squares) = (0.5, 0.0, 0.0);
        let n = 200_000;
        for i in 0..n {
            let visible = f64::from(u8::from(0.5 >= open_lattice::<f64>(murmur3([i, 0, 0, 0]))));
            history = accumulate(history, visible, weight);
            sum += history;
            squares += history * history;
        }
        let (mean, square) = (sum / f64::from(n), squares / f64::from(n));
        let factor = (square - mean * mean) / 0.25;
        assert!((factor / variance_factor(weight) - 1.0).abs() < 0.05, "{factor}");
    }

    #[test]
    fn what_vanished_is_forgotten_in_the_time_said() {
        let frames = ghosting_frames(0.1, 0.05);
        assert_eq!(frames, 29.0);
        let mut history = 1.0;
        for _ in 0..frames as u32 {
            history = accumulate(history, 0.0, 0.1);
        }
        assert!(history <= 0.05 && history / 0.9 > 0.05);
    }

    #[test]
    fn a_clamp_forgets_at_once_where_the_neighbours_agree() {
        assert_eq!(clamp_history(0.8, &[0.0; 9]), 0.0);
        assert_eq!(clamp_history(0.8, &[0.0, 1.0, 0.0]), 0.8);
        assert_eq!(clamp_history(0.8, &[]), 0.8);
    }

    #[test]
    fn surfaces_are_found_where_they_were() {
        let camera = |eye: DVec3, up| Camera::look_at(eye, eye + dvec3(0.1, 0.2, -4.0), up, 0.4, [200, 100]);
        let now = camera(dvec3(1.0, 2.0, 5.0), DVec3::Y);
        let pixel = dvec2(31.7, 80.2);
        let point = now.eye + now.ray(pixel).direction * 3.0;
        let turned = camera(now.eye, dvec3(0.3, 1.0, 0.0));
        for (before, turns) in [(camera(dvec3(0.7, 2.1, 5.5), DVec3::Y), false), (turned, true)] {
            let way = way_back(&now, &before, pixel, 3.0).unwrap();
            assert!((pixel + way - before.project(point).unwrap()).length() < 1e-9 && way.length() > 1.0);
            // The sky stays where it is unless the camera turns.
            let sky = way_back(&now, &before, pixel, f64::INFINITY).unwrap();
            assert_eq!(sky.length() > 1e-9, turns, "{sky}");
        }
        assert_eq!(way_back(&now, &now, pixel, 3.0), Some(DVec2::ZERO));
        let ahead = camera(point + dvec3(0.0, 0.0, -1.0), DVec3::Y);
        assert_eq!(way_back(&now, &ahead, pixel, 3.0), None);
    }

    fn mean_flicker(alpha: f64, threshold: impl Fn(f64, u32) -> f64) -> f64 {
        let samples = 2048;
        let one = |s: u32| {
            let chi = (f64::from(s) + 0.5) / f64::from(samples);
            let frames: Vec<_> = (0..8).map(|i| f64::from(u8::from(alpha >= threshold(chi, i)))).collect();
            flicker_range(&frames, 0.1)
        };
        (0..samples).map(one).sum::<f64>() / f64::from(samples)
    }

    /// §7.2.3: reordering reduces the flicker of Eq. 6, and a low-discrepancy order does "even better"; the
    /// phase-rotated order is best, and the paper's first is worse than independent frames at one quarter.
    #[test]
    fn the_orders_flicker_as_ranked() {
        let n = NonZeroU32::new(8).unwrap();
        for alpha in [0.25, 0.5] {
            let of = |order: Order| mean_flicker(alpha, |chi, i| order.threshold(chi, i, n));
            let ranked = [
                Order::Ascending,
                Order::AlternatingLiteral,
                Order::VanDerCorput,
                Order::PhaseRotatedVanDerCorput,
            ]
            .map(of);
            assert!(ranked.is_sorted_by(|a, b| a >= b), "alpha {alpha}: {ranked:?}");
        }
        let independent =
            mean_flicker(0.25, |chi, i| open_lattice(murmur3([(chi * 4096.0) as u32, i, 0, 0])));
        let alternating = mean_flicker(0.25, |chi, i| Order::AlternatingLiteral.threshold(chi, i, n));
        assert!(alternating > independent, "{alternating} {independent}");
    }
}
