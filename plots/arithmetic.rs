//! Which arithmetic keeps the law of the sine hash, and up to which index.

use hashed_alpha::report::figure::validity::{ValiditySeries, validity};
use hashed_alpha::stats::chi_square;
use hashed_alpha::threshold::emulated::{
    Arithmetic, CoarseSine, Emulated, FlushToZero, Fused, Half, ReducedSine,
};
use hashed_alpha::threshold::hash::mm4::Mm4;
use hashed_alpha::threshold::hash::sine::hash_2d;
use hashed_alpha::threshold::hash::{Cell, Hash};
use hashed_alpha::threshold::real::Real;
use rayon::prelude::*;

const SIDE: u32 = 256;
const BINS: usize = 64;

pub fn draw_validity() -> String {
    let series = [
        series("f32", sine::<f32>),
        series(ReducedSine::NAME, sine::<Emulated<ReducedSine>>),
        series(CoarseSine::NAME, sine::<Emulated<CoarseSine>>),
        series(Half::NAME, sine::<Emulated<Half>>),
        series(FlushToZero::NAME, sine::<Emulated<FlushToZero>>),
        series(Fused::NAME, sine::<Emulated<Fused>>),
        series("integer hash, f32", integer::<f32>),
        series("integer hash, half", integer::<Emulated<Half>>),
    ];
    // Chi-square of 63 degrees of freedom lies between these with a probability of 1 - 1e-6.
    let chance = 18.6 / 63.0..138.0 / 63.0;
    validity("Uniformity of the hash of 256 x 256 cells in other arithmetics", &series, chance)
}

fn sine<R: Real>([x, y]: [f64; 2]) -> f64 {
    hash_2d(R::from_f64(x), R::from_f64(y)).to_f64()
}

fn integer<R: Real>([x, y]: [f64; 2]) -> f64 {
    let index = [x, y, 0.0].map(R::from_f64).into();
    Hash::<R>::hash(&Mm4, &Cell { index, octave: 0 }).to_f64()
}

fn series(name: &str, hash: fn([f64; 2]) -> f64) -> ValiditySeries {
    let ratio = |exponent: i32| {
        let first = libm::exp2(f64::from(exponent));
        // From 2^24 on, `f32` takes two neighbours for one.
        let step = if exponent < 24 { 1 } else { 2 };
        let mut counts = [0; BINS];
        for i in 0..SIDE * SIDE {
            let value = hash([first + f64::from(step * (i % SIDE)), f64::from(i / SIDE)]);
            counts[((value * BINS as f64) as usize).min(BINS - 1)] += 1;
        }
        let chi = chi_square::uniform(&counts).expect("a window has cells");
        [f64::from(exponent), chi.statistic / chi.dof as f64]
    };
    ValiditySeries { name: name.to_owned(), points: (0..=24).into_par_iter().map(ratio).collect() }
}
