//! Alpha sharpened by its screen derivative before alpha to coverage (Golus 2017): "alpha to coverage" of a blurred edge
//! spreads it over as many pixels as the texture is magnified; divided by its change from pixel to pixel, alpha rises from
//! 0 to 1 within one pixel around a cutoff, whatever the distance.
//!
//! A short effect to start a new one from. [`Phase`] has the three kinds of stages, `draw/setup.rs` what a stage before shading may
//! change, `draw/work.rs` the columns of a tile, [`Role`] what effects are to each other, [`Text`] what shader text has of them.

use super::kind::{About, Bound, Cost, Effect, Per, Phase, Plan, Role, Rules, Text, techniques, tell};
use crate::render::draw::work::{Shading, Work};
use serde::Deserialize;

/// Alpha sharpened around a cutoff.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sharpened {
    /// The alpha at which the silhouette lies, in (0, 1]. Without, it is that of each material that has a test of its own, and
    /// one half elsewhere.
    pub cutoff: Option<f32>,
}

/// The least change of alpha from pixel to pixel that is divided by.
const LEAST_WIDTH: f32 = 0.0001;

/// The twin of [`sharpened`].
const TEXT: &str = "
// Alpha that is 1/2 at the cutoff and rises from 0 to 1 within a pixel; `width` is fwidth(alpha). Golus 2017.
fn sharpened(alpha: f32, cutoff: f32, width: f32) -> f32 {
    return clamp((alpha - cutoff) / max(width, 0.0001) + 0.5, 0.0, 1.0);
}
";

impl Effect for Sharpened {
    const ABOUT: About = About::new(
        "Golus 2017",
        "Sharpens alpha around a cutoff by its change from pixel to pixel, before the samples are tested",
        "texels: three times as many, those of the pixels on the right and below beside the own",
    )
    .bounds(&[("cutoff", Bound::THRESHOLD)])
    .techniques(techniques![
        "sharpened-alpha-to-coverage": "Golus 2017", "sharpened-coverage" / "sharpened",
            "The edges of an alpha map are one pixel wide at every scale; from afar it loses what the alpha test loses.";
    ]);

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Test]).needs(Role::Samples, "several tests in a pixel")
    }

    fn plan(&self, plan: &mut Plan) {
        let cutoff = self.cutoff;
        // Alpha is read once more at each of the two neighbours.
        let price = [(Per::Texel, Cost::texels(2))];
        let around =
            cutoff.map_or("one half, or the cutoff of the material".to_owned(), |cutoff| cutoff.to_string());
        let says = format!("sharpen alpha: around {around}, over its change to the next pixels");
        plan.setup.needs.texture_derivatives = true;
        plan.shade(Phase::Alpha, tell(says, &price, Text::Beside(TEXT)), move |shading, work, _| {
            sharpen(shading, work, cutoff);
        });
    }
}

/// Returns alpha that is 1/2 at the cutoff and rises from 0 to 1 within a pixel; `width` is its `fwidth`: the sum of its
/// absolute changes to the next pixel on the right and to the next below.
///
/// A surface of one alpha has none, and is kept whole from the cutoff on.
#[must_use]
pub fn sharpened(alpha: f32, cutoff: f32, width: f32) -> f32 {
    ((alpha - cutoff) / width.max(LEAST_WIDTH) + 0.5).clamp(0.0, 1.0)
}

/// Sharpens the alphas that are tested. Derivatives are forward differences, each fragment its own: to the alpha at the texture
/// coordinate one pixel on along each screen axis, at the level of the fragment. (The lanes of a hardware quad share theirs.)
/// The two reads more are in the price that the plan states.
fn sharpen(shading: &Shading<'_>, work: &mut Work, cutoff: Option<f32>) {
    let Work { fragments, access, alpha, tested, .. } = work;
    for (at, tested) in tested.iter_mut().enumerate() {
        let texture = shading.texture(fragments.triangle[at]);
        let change = |by: glam::Vec2| {
            let mut next = access[at];
            next.texcoord += by;
            (texture.alpha(&next, &mut 0) * fragments.tint(at)[3] - alpha[at]).abs()
        };
        let cutoff = cutoff.unwrap_or(texture.reference());
        *tested = sharpened(alpha[at], cutoff, change(fragments.dtdx[at]) + change(fragments.dtdy[at]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shader::interpreter::{Column, DeviceModel, Program, Values};

    #[test]
    fn a_linear_edge_becomes_one_pixel_wide_whatever_its_slope() {
        for slope in [1e-3_f32, 0.01, 0.3] {
            let of = |pixels: f32| sharpened(0.5 + pixels * slope, 0.5, slope);
            for (pixels, wanted) in
                [(0.0, 0.5), (0.25, 0.75), (-0.5, 0.0), (0.5, 1.0), (3.0, 1.0), (-3.0, 0.0)]
            {
                assert!((of(pixels) - wanted).abs() < 1e-4, "{slope} {pixels}: {}", of(pixels));
            }
        }
    }

    /// Cutoffs that are not 1/2, and widths below the least and above it.
    #[test]
    fn the_text_for_shaders_computes_the_same() {
        let module = naga::front::wgsl::parse_str(TEXT).unwrap();
        let info =
            naga::valid::Validator::new(Default::default(), Default::default()).validate(&module).unwrap();
        let program = Program::compile(&module, &info, "sharpened").unwrap();
        for (cutoff, width) in [(0.5_f32, 0.0_f32), (0.3, 0.00005), (0.3, 0.0002), (0.8, 0.05), (0.1, 0.7)] {
            let alphas: Vec<f32> =
                (0..=200).map(|k| cutoff + (k - 100) as f32 * width.max(0.0001) * 0.01).collect();
            let columns = [Column::F32(&alphas), Column::F32(&[cutoff]), Column::F32(&[width])];
            let found = program.run(&columns, alphas.len(), &DeviceModel::ACCURATE).unwrap();
            let expected = alphas.iter().map(|&alpha| sharpened(alpha, cutoff, width)).collect();
            assert_eq!(found, [Values::F32(expected)], "{cutoff} {width}");
        }
    }

    #[test]
    fn what_has_one_alpha_is_kept_or_not_as_under_the_alpha_test() {
        assert_eq!([0.0, 0.49, 0.51, 1.0].map(|alpha| sharpened(alpha, 0.5, 0.0)), [0.0, 0.0, 1.0, 1.0]);
    }
}
