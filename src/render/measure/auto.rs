//! Chooses effects from what it measures in a scene, and says why.

use super::survey::Survey;
use crate::render::draw::texture::Texture;
use crate::render::effect::Effects;
use crate::render::effect::alpha_to_coverage::AlphaToCoverage;
use crate::render::effect::average::Average;
use crate::render::effect::fade_in::FadeIn;
use crate::render::effect::fixed::Fixed;
use crate::render::effect::premultiplied::Premultiplied;
use crate::render::effect::robust::RobustHash;
use crate::render::effect::temporal::Temporal;
use crate::render::scene_file::load::Scene;
use crate::threshold::stage::coverage::SamplePattern;
use crate::threshold::stage::order::Order;
use crate::threshold::two_scale::Variant;

/// What was chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The effects.
    pub effects: Effects,
    /// Why, effect by effect.
    pub reasons: Vec<String>,
}

/// Coverage that the fixed test may gain or lose before noise is worth its grain.
const TOLERANCE: f64 = 0.05;
/// Share of the fragments, or of the pixels, from which on an effect pays.
const ENOUGH: f64 = 0.1;
/// Distance of colours that is seen as a halo.
const HALO: f64 = 0.05;

/// Chooses effects for a scene; one that calls for nothing gets the plain alpha test.
#[must_use]
pub fn choose(scene: &Scene, textures: &[Texture]) -> Choice {
    let factors = scene.file.distance.iter().flat_map(|distance| distance.factors.iter().copied());
    let mut surveys = vec![(1.0, Survey::new(scene, textures, 1.0))];
    surveys.extend(factors.map(|factor| (factor, Survey::new(scene, textures, factor))));
    let survey = &surveys[0].1;
    let worst = surveys.iter().rev().max_by(|(_, a), (_, b)| a.bias().total_cmp(&b.bias()));
    let (farthest, bias) = worst.map_or((1.0, 0.0), |(factor, survey)| (*factor, survey.bias()));
    let seen = if farthest == 1.0 { String::new() } else { format!(" from {farthest} times the distance") };
    let mut effects = Effects { name: Some("auto".to_owned()), ..Effects::default() };
    let mut reasons = Vec::new();
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let partial = percent(survey.share(survey.partial));
    if bias <= TOLERANCE {
        effects.fixed = Some(Fixed { threshold: None });
        reasons.push(format!(
            "fixed: it gains or loses {}{seen} of the coverage, {} of the fragments have an alpha \
             between 0 and 1; saves 2 hashes for each of {} fragments and all noise",
            percent(bias),
            partial,
            survey.fragments
        ));
        return Choice { effects, reasons };
    }
    let oblique = survey.share(survey.oblique);
    let variant = if oblique > ENOUGH { Variant::Anisotropic } else { Variant::Isotropic };
    let each = if variant == Variant::Anisotropic { 8 } else { 2 };
    effects.robust = Some(RobustHash { variant, ..RobustHash::default() });
    reasons.push(format!(
        "robust, {variant}: the fixed test gains or loses {}{seen} of the coverage; {} of the \
             footprints are more than twice as long as wide; costs {each} hashes for each of {} \
             fragments, risks grain where alpha is between 0 and 1 ({partial} of the fragments)",
        percent(bias),
        percent(oblique),
        survey.fragments
    ));
    if let Some(level) = surveys.iter().filter_map(|(_, survey)| survey.first_wrong_level(TOLERANCE)).min()
        && survey.near() > ENOUGH
        && level > 0
    {
        let anisotropy = variant == Variant::Anisotropic;
        effects.fade_in = Some(FadeIn { full_noise_lod: level as f32, anisotropy, authored: 0.5 });
        reasons.push(format!(
            "fade_in, full noise from level {level}: {} of the fragments are magnified, where the \
             fixed test is right; saves their grain, risks alphas below one half while it fades",
            percent(survey.near())
        ));
    }
    if survey.bleeding > HALO {
        effects.premultiplied = Some(Premultiplied {});
        reasons.push(format!(
            "premultiplied: filtered colours are {} off those of opaque texels; costs a division \
             a pixel, saves halos",
            percent(survey.bleeding)
        ));
    }
    let target = &scene.file.target;
    let layered = survey.pixels[1] as f64 / survey.pixels[0].max(1) as f64;
    if target.samples.get() > 1 {
        let (pattern, price) = if layered > ENOUGH {
            (SamplePattern::Decorrelated, "1 more hash a fragment")
        } else {
            (SamplePattern::Jittered, "no more hashes")
        };
        effects.alpha_to_coverage = Some(AlphaToCoverage { samples: target.samples, pattern });
        reasons.push(format!(
            "alpha_to_coverage, {}: the target has {} samples a pixel, {} of the touched pixels \
             have two layers or more; costs {price} and as many tests as samples, saves grain",
            pattern.name(),
            target.samples,
            percent(layered)
        ));
    }
    if target.history.get() > 1 {
        effects.temporal = Some(Temporal { frames: target.history, order: Order::PhaseRotated });
        effects.average = Some(Average { frames: target.history });
        reasons.push(format!(
            "temporal: the target averages {} frames; costs nothing but a mixture a pixel, saves \
             grain, risks ghosts under motion",
            target.history
        ));
    }
    Choice { effects, reasons }
}
