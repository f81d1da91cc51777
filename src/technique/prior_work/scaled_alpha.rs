//! Alphas that are scaled when the texture is made, so that one threshold does for every level (§3, Castano 2010).

use super::Level;
use super::level_threshold::{level_threshold, texel_thresholds};

/// Returns the factor for a level: `reference / alpha_tau(i)`, with the threshold of Eq. 1; 0 where no texel may pass.
///
/// The paper writes 0.5 for `reference`, the threshold at run time.
#[must_use]
pub fn alpha_scale(level: Level<'_>, wanted_share: f64, reference: f32) -> f32 {
    reference / level_threshold(level, wanted_share)
}

/// Returns the alphas of a level times `scale`, at most 1.
///
/// A texture stores no alpha above 1, so the cut is part of the technique: an alpha test does not see it, a blend and
/// a hashed test do.
#[must_use]
pub fn scaled(level: Level<'_>, scale: f32) -> Vec<f32> {
    level.texels.iter().map(|&alpha| (alpha * scale).min(1.0)).collect()
}

/// Returns the alphas of a level, each times the factor of its own texel: `reference / alpha_tau(i, u, v)` (§3).
///
/// The thresholds are those of [`texel_thresholds`], whose `radius` and base it takes.
#[must_use]
pub fn scaled_by_texel(level: Level<'_>, base: Level<'_>, reference: f32, radius: usize) -> Vec<f32> {
    let thresholds = texel_thresholds(level, base, reference, radius);
    level.texels.iter().zip(thresholds).map(|(&alpha, t)| (alpha * (reference / t)).min(1.0)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::tests::{fence, leaves};
    use super::*;

    /// "Mathematically equivalent": scaled alphas pass 0.5 where plain ones pass the threshold of their level.
    #[test]
    fn scaled_alphas_pass_as_under_the_threshold_of_their_level() {
        for map in [fence(256), leaves(256)] {
            let wanted = map.level().passing_share(0.5);
            for map in map.chain() {
                let level = map.level();
                let threshold = level_threshold(level, wanted);
                let scaled = scaled(level, alpha_scale(level, wanted, 0.5));
                for (scaled, plain) in scaled.iter().zip(level.texels) {
                    assert_eq!(*scaled >= 0.5, *plain >= threshold, "{plain} against {threshold}");
                }
            }
        }
    }

    /// Fig. 10: under a hashed test the scaled map is denser than the map that it stands for.
    #[test]
    fn scaling_dilates_under_a_hashed_test() {
        let map = leaves(256);
        let (truth, wanted) = (map.level().mean(), map.level().passing_share(0.5));
        let chain = map.chain();
        let level = chain[5].level();
        let scaled = scaled(level, alpha_scale(level, wanted, 0.5));
        let dense = Level { texels: &scaled, ..level }.mean();
        assert!((level.mean() - truth).abs() < 1e-5);
        assert!(dense > 1.02 * truth, "{dense} for {truth}");
    }

    #[test]
    fn a_factor_for_each_texel_passes_as_the_threshold_of_each_texel() {
        let chain = leaves(128).chain();
        let (base, level) = (chain[0].level(), chain[3].level());
        let thresholds = texel_thresholds(level, base, 0.5, 2);
        let scaled = scaled_by_texel(level, base, 0.5, 2);
        for ((scaled, plain), threshold) in scaled.iter().zip(level.texels).zip(thresholds) {
            assert_eq!(*scaled >= 0.5, *plain >= threshold);
        }
    }
}
