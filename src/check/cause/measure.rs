//! From the derivatives of a position to the logarithm of the scale: the sound way and the wrong ones.

use super::slip::{Slip, named};
use crate::check::input::numerator;
use crate::threshold::two_scale::Variant;
use glam::{DVec3, dvec3};

/// A way of measuring the size of a pixel along each axis; with one scale for all axes, three times the same.
#[derive(Clone, Copy)]
struct Size {
    slip: Option<Slip>,
    of: fn(DVec3, DVec3) -> DVec3,
}

/// A way of making a scale out of a size, given the numerator of the variant and the hash scale.
#[derive(Clone, Copy)]
struct Scale {
    slip: Option<Slip>,
    of: fn(f64, f64, DVec3) -> DVec3,
    /// What the hash scale is multiplied by.
    times: f64,
}

/// A way of taking the logarithm.
#[derive(Clone, Copy)]
struct Logarithm {
    slip: Option<Slip>,
    per_octave: f64,
}

const fn size(slip: &'static str, of: fn(DVec3, DVec3) -> DVec3) -> Size {
    Size { slip: Some(named(slip)), of }
}

const ISOTROPIC: &[Size] = &[
    Size { slip: None, of: |x, y| DVec3::splat(x.length().max(y.length())) },
    size("dfdx-twice", |x, _| DVec3::splat(x.length())),
    size("min-for-max", |x, y| DVec3::splat(x.length().min(y.length()))),
    size("fwidth", |x, y| DVec3::splat((x.abs() + y.abs()).length())),
    size("length-of-sum", |x, y| DVec3::splat((x + y).length())),
    size("sum-of-lengths", |x, y| DVec3::splat(x.length() + y.length())),
    size("area-of-a-pixel", |x, y| DVec3::splat(x.cross(y).length().sqrt())),
    size("largest-component", |x, y| DVec3::splat(x.abs().max(y.abs()).max_element())),
    size("derivative-without-z", |x, y| DVec3::splat(x.truncate().length().max(y.truncate().length()))),
];

const ANISOTROPIC: &[Size] = &[
    Size { slip: None, of: |x, y| x.abs().max(y.abs()) },
    size("dfdx-twice", |x, _| x.abs()),
    size("min-for-max", |x, y| x.abs().min(y.abs())),
    size("fwidth", |x, y| x.abs() + y.abs()),
    size("length-of-sum", |x, y| (x + y).abs()),
];

const fn scale(slip: &'static str, of: fn(f64, f64, DVec3) -> DVec3) -> Scale {
    Scale { slip: Some(named(slip)), of, times: 1.0 }
}

const SOUND: Scale =
    Scale { slip: None, of: |numerator, hash_scale, size| numerator / (hash_scale * size), times: 1.0 };

const SCALES: &[Scale] = &[
    SOUND,
    scale("hash-scale-ignored", |numerator, _, size| numerator / size),
    scale("hash-scale-divides", |numerator, hash_scale, size| numerator * hash_scale / size),
    scale("squared-length", |numerator, hash_scale, size| numerator / (hash_scale * size * size)),
    scale("one-plus-derivative", |numerator, hash_scale, size| numerator / (1.0 + hash_scale * size)),
    scale("missing-sqrt-half", |_, hash_scale, size| 1.0 / (hash_scale * size)),
    // Numbers that people write, as 0.05 and 3; powers of two between them are told by the cells.
    Scale { times: 1.2, ..OTHER_SIZE },
    Scale { times: 1.25, ..OTHER_SIZE },
    Scale { times: 1.4, ..OTHER_SIZE },
    Scale { times: 1.5, ..OTHER_SIZE },
    Scale { times: 1.6, ..OTHER_SIZE },
    Scale { times: 1.75, ..OTHER_SIZE },
    Scale { times: 1.8, ..OTHER_SIZE },
];

/// Cells of another size than the hash scale says.
const OTHER_SIZE: Scale = Scale { slip: Some(named("noise-of-another-size")), ..SOUND };

/// Seen through what a threshold shows of single cells it is the sound scale with fine and coarse exchanged: the size of cells
/// tells the two apart.
const INVERSE: Scale = scale("inverse-scale", |_, hash_scale, size| hash_scale * size);

const LOGARITHMS: &[Logarithm] = &[
    Logarithm { slip: None, per_octave: 1.0 },
    Logarithm { slip: Some(named("natural-logarithm")), per_octave: core::f64::consts::LN_2 },
    Logarithm { slip: Some(named("natural-logarithm")), per_octave: core::f64::consts::LOG10_2 },
];

/// The logarithms of lengths among which a view is sought.
const LENGTHS: [f64; 2] = [-48.0, 48.0];

/// A view has been found where its logarithm is no further than this from the one that is wanted.
const CLOSE: f64 = 1.0e-12;

/// One way from derivatives to the logarithm of the scale.
#[derive(Clone, Copy)]
pub(super) struct Measure {
    pub variant: Variant,
    hash_scale: f64,
    size: Size,
    scale: Scale,
    logarithm: Logarithm,
}

impl Measure {
    /// The way of the listing.
    pub fn sound(variant: Variant, hash_scale: f64) -> Self {
        Self { variant, hash_scale, size: sizes(variant)[0], scale: SCALES[0], logarithm: LOGARITHMS[0] }
    }

    /// The ways of measuring a pixel, each with the sound scale; the sound one first.
    pub fn sizes(variant: Variant, hash_scale: f64) -> impl Iterator<Item = Self> {
        let sound = Self::sound(variant, hash_scale);
        sizes(variant).iter().map(move |&size| Self { size, ..sound })
    }

    /// The same size with every scale and logarithm that can be told from the sound ones, the fewest slips first.
    pub fn with_scales(self) -> Vec<Self> {
        let all = SCALES
            .iter()
            .flat_map(|&scale| LOGARITHMS.iter().map(move |&logarithm| Self { scale, logarithm, ..self }));
        let sound = Self { scale: SCALES[0], logarithm: LOGARITHMS[0], ..self };
        let mut all: Vec<Self> = all
            .filter(|other| other.slips().count() == sound.slips().count() || !other.looks_like(&sound))
            .collect();
        all.sort_by_key(|measure| measure.slips().count());
        all
    }

    /// The same with the inverse of the scale.
    pub fn inverse(self) -> Self {
        Self { scale: INVERSE, ..self }
    }

    /// What is wrong with it.
    pub fn slips(&self) -> impl Iterator<Item = Slip> + use<> {
        self.size.slip.into_iter().chain(self.slips_of_scale())
    }

    /// What is wrong with it once the pixel is measured.
    pub fn slips_of_scale(&self) -> impl Iterator<Item = Slip> + use<> {
        [self.scale.slip, self.logarithm.slip].into_iter().flatten()
    }

    /// Whether it has no slip but those of these names, where there are any.
    pub fn is_among(&self, names: Option<&[&str]>) -> bool {
        names.is_none_or(|names| self.slips().all(|slip| names.contains(&slip.name)))
    }

    /// How many times as wide cells are as they should be, but for whole octaves.
    pub fn times(&self) -> f64 {
        self.scale.times
    }

    /// Whether the two differ by whole octaves at most, which the cells tell.
    fn looks_like(&self, other: &Self) -> bool {
        let lengths = [0.03, 0.11, 0.7].map(DVec3::splat);
        let differences = lengths.map(|d| (self.log_scale(d, d) - other.log_scale(d, d)).x);
        differences.into_iter().all(|d| (d - d.round()).abs() < 1.0e-9 && (d - differences[0]).abs() < 1.0e-9)
    }

    /// The logarithm of the scale along each axis.
    pub fn log_scale(&self, dpdx: DVec3, dpdy: DVec3) -> DVec3 {
        let size = (self.size.of)(dpdx, dpdy);
        let scale = (self.scale.of)(numerator(self.variant), self.hash_scale * self.scale.times, size);
        DVec3::from_array(scale.to_array().map(|scale| libm::log2(scale) * self.logarithm.per_octave))
    }

    /// Derivatives at which the logarithm of the scale is a given one; none where there are none.
    pub fn view(&self, log_scale: DVec3) -> Option<[DVec3; 2]> {
        let [x, y, z] = log_scale.to_array();
        let along_x = self.length(x)?;
        let along = |log: f64| if log == x { Some(along_x) } else { self.length(log) };
        let dpdx = dvec3(along_x, along(y)?, along(z)?);
        Some([dpdx, dpdx * dvec3(1.0, 1.0, -1.0)])
    }

    /// The component of all derivatives at which the logarithm of the scale is a given one.
    fn length(&self, wanted: f64) -> Option<f64> {
        let at = |log: f64| {
            let d = DVec3::splat(libm::exp2(log));
            self.log_scale(d, d * dvec3(1.0, 1.0, -1.0)).x
        };
        let [mut low, mut high] = LENGTHS;
        let rises = at(high) > at(low);
        if (at(low) > wanted) != (at(high) < wanted) && (at(low) < wanted) != (at(high) > wanted) {
            return None;
        }
        // Nearly all are straight lines: the chord ends there at once, and the middle everywhere.
        let [mut below, mut above] = [low, high].map(at);
        for step in 0..128 {
            let chord = low + (high - low) * ((wanted - below) / (above - below));
            let is_inside = step % 2 == 0 && chord > low && chord < high;
            let between = if is_inside { chord } else { 0.5 * (low + high) };
            let value = at(between);
            if (value - wanted).abs() < CLOSE {
                return Some(libm::exp2(between));
            }
            if (value < wanted) == rises {
                (low, below) = (between, value)
            } else {
                (high, above) = (between, value)
            }
        }
        let found = 0.5 * (low + high);
        ((at(found) - wanted).abs() < 1.0e-6).then(|| libm::exp2(found))
    }
}

fn sizes(variant: Variant) -> &'static [Size] {
    if variant == Variant::Anisotropic { ANISOTROPIC } else { ISOTROPIC }
}
