//! I3D 2017, where it says more or other than the journal version.

use crate::measure::{Plane, list, listing, mean, percent, rms, share, visible};
use crate::row::{Measured, Row, judge};
use core::num::NonZeroU32;
use hashed_alpha::stats::seed::rng;
use hashed_alpha::technique::jitter::camera_jitter;
use hashed_alpha::threshold::stage::fade_in::{blend_literal, fade_in_literal};
use hashed_alpha::threshold::stochastic::stochastic;
use hashed_alpha::threshold::two_scale::Variant::Isotropic;
use rand::Rng;

pub const ROWS: &[Row] = &[
    Row {
        id: "conference.interval",
        place: "§1",
        sentence: "The random threshold is drawn from (0, 1] (the journal version: [0, 1)).",
        measure: interval,
    },
    Row {
        id: "conference.sub_pixel_noise",
        place: "§5.4.1",
        sentence: "With temporal antialiasing a hash scale of 0.3 to 0.5 allows an average over time.",
        measure: sub_pixel_noise,
    },
    Row {
        id: "conference.delta",
        place: "§5.5.1, Eq. 2",
        sentence: "Hashed thresholds are 0.5 + delta with delta in (-0.5, 0.5].",
        measure: delta,
    },
    Row {
        id: "conference.ramp",
        place: "§5.5.1, Eq. 3",
        sentence: "The ramp is 0 up to level 0, 1 from level n on, and continuous.",
        measure: ramp,
    },
];

fn interval() -> Measured {
    let mut rng = rng("claims.interval", 0);
    let n = 1_u64 << 26;
    let (mut zeros, mut outside) = (0_u32, 0_u32);
    for _ in 0..n {
        let draw = stochastic::<f32>(rng.next_u32());
        zeros += u32::from(draw == 0.0);
        let reversed = 1.0 - draw;
        outside += u32::from(!(reversed > 0.0 && reversed <= 1.0));
    }
    let seen = format!(
        "`drand48()` with 24 bits returned 0, which keeps alpha 0, {zeros} times (expected: 4); 1 less the draw was outside (0, 1] \
         {outside} times"
    );
    judge(n, zeros == 0, outside == 0, seen)
}

/// What the average over eight jittered frames leaves of the variance of one frame, at alpha 1/2.
fn left(scale: f64) -> f64 {
    let of = listing(Isotropic, scale);
    let n = NonZeroU32::new(8).expect("not 0");
    let error = rms((0..4096_u32).map(|p| {
        let plane = Plane::tilted(0.0, 0.01 * libm::exp2(f64::from(p % 16) / 16.0), f64::from(p % 13));
        let (x, y) = (5.0 * f64::from(p % 64), 5.0 * f64::from(p / 64));
        let frame = |i| {
            let [dx, dy] = camera_jitter(i, n);
            visible(0.5, of(&plane.at(x + dx, y + dy)))
        };
        mean((0..8).map(frame)) - 0.5
    }));
    error * error / 0.25
}

fn sub_pixel_noise() -> Measured {
    let found = [1.0, 0.5, 0.3].map(left);
    let seen = format!(
        "eight jittered frames leave {} of the variance of one frame at scales 1, 0.5, 0.3 (independent frames: 0.125)",
        list(found)
    );
    judge(4096_u64, found[1] < 0.5 * found[0] && found[2] < 0.5 * found[0], found[2] < found[0], seen)
}

fn delta() -> Measured {
    let plane = Plane::tilted(30.0, 0.0123, 0.0);
    let image = plane.image(512, listing(Isotropic, 1.0));
    let inside = share(image.iter().map(|t| t - 0.5 > -0.5 && t - 0.5 <= 0.5));
    let same = share(image.iter().map(|&t| fade_in_literal(0.5, t as f32, 1.0) == t as f32));
    let seen = format!(
        "{} of the thresholds of Listing 1 are; 0.5 + delta is the threshold again, bit for bit, in {}",
        percent(inside),
        percent(same)
    );
    judge(image.len() as u64, inside == 1.0, inside > 0.99, seen)
}

fn ramp() -> Measured {
    let n = 10_000;
    let at = |i: i32| blend_literal(f64::from(i) * 1e-3, 6.0);
    let jump = (-1000..9000).map(|i| (at(i + 1) - at(i)).abs()).fold(0.0, f64::max);
    let seen = format!("largest step over 1/1000 level: {jump:.5}; b(0) = {}, b(6) = {}", at(0), at(6000));
    judge(n as u64, jump < 1e-3 && at(0) == 0.0 && at(6000) == 1.0, false, seen)
}
