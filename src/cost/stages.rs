//! The stages of the hash alone: sine, logarithm, hash of a cell.

use super::baseline;
use super::clock::Contender;
use super::double_double::{DoubleDouble, RealSine};
use super::pool::SLICE;
use super::row::{Row, Untimed, real_hash};
use crate::stats::seed;
use crate::threshold::batch::{Isa, Tier};
use crate::threshold::hash::{Cell, Hash, HashKind};
use crate::threshold::real::{log2_f32, sin_f32};
use rand::RngExt;

/// Arguments of sines, scales, and cells, a slice each per item.
pub(super) struct StageInputs {
    angles: Vec<Vec<f32>>,
    scales: Vec<Vec<f32>>,
    cells: Vec<[Vec<f32>; 3]>,
    words: Vec<u32>,
}

/// Arguments of the sines of wide scenes.
const LARGEST_ANGLE: f32 = 6.0e5;
/// Indices of the cells of wide scenes.
const LARGEST_INDEX: f32 = 3.0e4;

impl StageInputs {
    pub fn new(slices: usize) -> Self {
        let mut rng = seed::rng("cost.stages", 0);
        let mut column =
            |largest: f32| -> Vec<f32> { (0..SLICE).map(|_| rng.random_range(-largest..largest)).collect() };
        Self {
            angles: (0..slices).map(|_| column(LARGEST_ANGLE)).collect(),
            scales: (0..slices).map(|_| column(12.0).into_iter().map(libm::exp2f).collect()).collect(),
            cells: (0..slices)
                .map(|_| [(); 3].map(|()| column(LARGEST_INDEX).into_iter().map(f32::floor).collect()))
                .collect(),
            words: (0..SLICE as u32).map(|i| i % 13).collect(),
        }
    }
}

/// A function over slices of `f32`, its reference in `f32`, and its exact value.
struct Stage<'a> {
    name: &'static str,
    inputs: &'a [Vec<f32>],
    rounded: fn(f32) -> f32,
    exact: fn(f64) -> f64,
}

impl<'a> Stage<'a> {
    /// Times a function and compares it over the first slice.
    fn entry(
        &self,
        precision: &'static str,
        tier: &'static str,
        isa: &'static str,
        function: impl Fn(&[f32], &mut [f64]) + 'a,
        timed: impl Fn(&[f32], &mut [f32]) + 'a,
    ) -> Untimed<'a> {
        let inputs = self.inputs;
        let mut found = vec![0.0; SLICE];
        function(&inputs[0], &mut found);
        let equal = |(&x, &value): (&f32, &f64)| (value as f32).to_bits() == (self.rounded)(x).to_bits();
        let same = inputs[0].iter().zip(&found).filter(|&pair| equal(pair)).count();
        let error = inputs[0]
            .iter()
            .zip(&found)
            .map(|(&x, value)| (value - (self.exact)(f64::from(x))).abs())
            .fold(0.0, f64::max);
        let row = Row {
            bits_equal: Some(same as f64 / SLICE as f64),
            error: Some(error),
            ..Row::of_stage(self.name, "-", precision, tier, isa)
        };
        let mut out = vec![0.0; SLICE];
        let run = move |slice: usize| {
            timed(&inputs[slice % inputs.len()], &mut out);
            f64::from(out[slice % SLICE])
        };
        let touch = move |slice: usize| inputs[slice % inputs.len()].iter().map(|&x| f64::from(x)).sum();
        Untimed { row, contender: Contender { items: SLICE, run: Box::new(run), touch: Box::new(touch) } }
    }

    /// One value after the other, in `f32`.
    fn scalar(&self, tier: &'static str, function: fn(f32) -> f32) -> Untimed<'a> {
        let each = move |x: &[f32], out: &mut [f32]| {
            out.iter_mut().zip(x).for_each(|(out, &x)| *out = function(x));
        };
        self.single(tier, "scalar", each)
    }

    fn single(
        &self,
        tier: &'static str,
        isa: &'static str,
        function: impl Fn(&[f32], &mut [f32]) + Copy + 'a,
    ) -> Untimed<'a> {
        let widened = move |x: &[f32], wide: &mut [f64]| {
            let mut out = vec![0.0; x.len()];
            function(x, &mut out);
            wide.iter_mut().zip(out).for_each(|(wide, value)| *wide = f64::from(value));
        };
        self.entry("f32", tier, isa, widened, function)
    }

    /// One value after the other, in another arithmetic.
    fn wide(&self, precision: &'static str, function: fn(f64) -> f64) -> Untimed<'a> {
        let wide = move |x: &[f32], out: &mut [f64]| {
            out.iter_mut().zip(x).for_each(|(out, &x)| *out = function(f64::from(x)));
        };
        let timed = move |x: &[f32], out: &mut [f32]| {
            out.iter_mut().zip(x).for_each(|(out, &x)| *out = function(f64::from(x)) as f32);
        };
        self.entry(precision, precision, "scalar", wide, timed)
    }
}

/// Every tier of every stage.
pub(super) fn stages<'a>(inputs: &'a StageInputs) -> Vec<Untimed<'a>> {
    let sine = Stage { name: "sine", inputs: &inputs.angles, rounded: sin_f32, exact: libm::sin };
    let best = Isa::best();
    let mut entries: Vec<Untimed<'a>> = Tier::ALL
        .into_iter()
        .filter(|&tier| tier != Tier::BitExact)
        .map(|tier| sine.single(tier.name(), best.name(), move |x, out| best.sin_of(tier, x, out)))
        .collect();
    entries.push(sine.scalar("std", baseline::sin_f32));
    entries.push(sine.scalar(Tier::BitExact.name(), sin_f32));
    entries.extend(
        Isa::available()
            .map(|isa| sine.single(Tier::BitExact.name(), isa.name(), move |x, out| isa.sin(x, out))),
    );
    entries.push(sine.wide("f64", baseline::sin_f64));
    entries.push(sine.wide("double-double", |x| DoubleDouble::new(x).sin().to_f64()));

    let logarithm = Stage { name: "logarithm", inputs: &inputs.scales, rounded: log2_f32, exact: libm::log2 };
    entries.push(logarithm.scalar("std", baseline::log2_f32));
    entries.push(logarithm.scalar(Tier::BitExact.name(), log2_f32));
    entries.extend(
        Isa::available()
            .map(|isa| logarithm.single(Tier::BitExact.name(), isa.name(), move |x, out| isa.log2(x, out))),
    );
    entries.push(logarithm.wide("f64", baseline::log2_f64));

    for kind in HashKind::ALL {
        for tier in Tier::ALL.into_iter().filter(|&tier| kind == HashKind::Sine || tier == Tier::BitExact) {
            entries.push(hash(inputs, kind, tier.name(), best.name(), move |index, word, out| {
                best.hash(kind, tier, index, word, out);
            }));
        }
    }
    entries.push(one_by_one(inputs, HashKind::Sine, "std", |cell| baseline::hash_f32(cell.index)));
    for kind in [HashKind::Sine, HashKind::Mm4, HashKind::Pcg3d] {
        entries.push(one_by_one(inputs, kind, Tier::BitExact.name(), move |cell| kind.hash(cell)));
    }
    entries.push(one_by_one(inputs, HashKind::Sine, "double-double", |cell| RealSine.hash(cell)));
    entries
}

/// A hash of cells one after the other.
pub(super) fn one_by_one<'a>(
    inputs: &'a StageInputs,
    kind: HashKind,
    tier: &'static str,
    function: impl Fn(&Cell<f32>) -> f32 + 'a,
) -> Untimed<'a> {
    hash(inputs, kind, tier, "scalar", move |[x, y, z], word, out| {
        for (i, out) in out.iter_mut().enumerate() {
            *out = function(&Cell { index: glam::vec3(x[i], y[i], z[i]), octave: word[i] });
        }
    })
}

pub(super) fn hash<'a>(
    inputs: &'a StageInputs,
    kind: HashKind,
    tier: &'static str,
    isa: &'static str,
    function: impl Fn([&[f32]; 3], &[u32], &mut [f32]) + 'a,
) -> Untimed<'a> {
    let columns = |slice: usize| inputs.cells[slice % inputs.cells.len()].each_ref().map(Vec::as_slice);
    let mut out = vec![0.0; SLICE];
    function(columns(0), &inputs.words, &mut out);
    let [x, y, z] = columns(0);
    let (mut same, mut error) = (0, 0.0);
    for (i, &value) in out.iter().enumerate() {
        let cell = Cell { index: glam::vec3(x[i], y[i], z[i]), octave: inputs.words[i] };
        let rounded: f32 = kind.hash(&cell);
        let exact: f32 = real_hash(kind, &cell);
        same += usize::from(rounded.to_bits() == value.to_bits());
        error += f64::from((value - exact).abs());
    }
    let row = Row {
        bits_equal: Some(same as f64 / SLICE as f64),
        error: Some(error / SLICE as f64),
        ..Row::of_stage("hash", kind.name(), "f32", tier, isa)
    };
    let run = move |slice: usize| {
        function(columns(slice), &inputs.words, &mut out);
        f64::from(out[slice % SLICE])
    };
    let touch =
        move |slice: usize| columns(slice).iter().flat_map(|axis| axis.iter()).map(|&x| f64::from(x)).sum();
    Untimed { row, contender: Contender { items: SLICE, run: Box::new(run), touch: Box::new(touch) } }
}
