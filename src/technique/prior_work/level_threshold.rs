//! Thresholds that keep the share of passing texels in every level (§3, Eq. 1).

use super::{Level, share};

/// The smallest threshold that is chosen, 2^-24, so that alpha 0 never passes.
const SMALLEST: f32 = 1.0 / 16_777_216.0;

/// Returns the threshold under which a level passes a share of its texels that is as near as possible to
/// `wanted_share`; in (0, 1], or infinity where none may pass. Eq. 1 with `wanted_share = a_0 / A_0`.
///
/// It is the middle between the last alpha that passes and the first that does not, so that rounding cannot move
/// either across. Equal alphas pass together; of two shares that are equally near it takes the larger one. In a
/// level of few texels the nearest share can be far away, in the last one it is 0 or 1.
#[must_use]
pub fn level_threshold(level: Level<'_>, wanted_share: f64) -> f32 {
    threshold_of(level.texels.to_vec(), wanted_share)
}

fn threshold_of(mut alphas: Vec<f32>, wanted_share: f64) -> f32 {
    let count = alphas.len();
    alphas.retain(|&alpha| alpha >= SMALLEST);
    alphas.sort_unstable_by(|a, b| b.total_cmp(a));
    // Only between two different alphas, or after the last, can the passing end.
    let ends = (1..=alphas.len()).filter(|&k| k == alphas.len() || alphas[k - 1] > alphas[k]);
    let miss = |passing: usize| (share(passing, count) - wanted_share).abs();
    let best = ends.fold(0, |best, k| if miss(k) <= miss(best) { k } else { best });
    match best {
        0 => f32::INFINITY,
        k => {
            let below = alphas.get(k).copied().unwrap_or(0.0);
            (0.5 * (alphas[k - 1] + below)).max(SMALLEST)
        }
    }
}

/// Returns a threshold for each texel of a level, `alpha_tau(i, u, v)` of §3: within a window around the texel, the
/// share of passing texels is that of the base map under the same window.
///
/// The paper asks how such thresholds are to be computed; this is one answer and not the paper's. `radius` is that
/// of the square window, in texels of `level`, cut off at its borders; with radius 0 a texel passes where at least
/// half of the base texels under it do. The base must be `2^k` times as wide and as high as the level.
#[must_use]
pub fn texel_thresholds(level: Level<'_>, base: Level<'_>, reference: f32, radius: usize) -> Vec<f32> {
    let ratio = base.width.checked_div(level.width).unwrap_or(0);
    let window = |centre: usize, size: usize| centre.saturating_sub(radius)..(centre + radius + 1).min(size);
    let local = |x: usize, y: usize| {
        let (columns, rows) = (window(x, level.width), window(y, level.height));
        let alphas = rows.clone().flat_map(|row| {
            columns.clone().filter_map(move |column| level.texels.get(row * level.width + column).copied())
        });
        let under = (rows.start * ratio..rows.end * ratio).flat_map(|row| {
            (columns.start * ratio..columns.end * ratio)
                .filter_map(move |column| base.texels.get(row * base.width + column).copied())
        });
        let (passing, all) =
            under.fold((0, 0), |(passing, all), alpha| (passing + usize::from(alpha >= reference), all + 1));
        threshold_of(alphas.collect(), share(passing, all))
    };
    (0..level.width * level.height).map(|i| local(i % level.width, i / level.width)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::tests::{fence, leaves};
    use super::*;

    /// Eq. 1: the ratio is kept in every level that has enough texels to hold it.
    #[test]
    fn the_share_of_passing_texels_is_kept() {
        let chain = leaves(256).chain();
        let wanted = chain[0].level().passing_share(0.5);
        for map in &chain[..5] {
            let level = map.level();
            let kept = level.passing_share(level_threshold(level, wanted));
            let fixed = level.passing_share(0.5);
            assert!((kept - wanted).abs() <= 0.5 / level.texels.len() as f64 + 0.02, "{}: {kept}", map.side);
            assert!((kept - wanted).abs() <= (fixed - wanted).abs());
        }
    }

    /// "Even perfect per-level thresholds do not prevent geometry disappearing": the last texel is there or not.
    #[test]
    fn the_last_level_is_all_or_nothing() {
        let chain = fence(64).chain();
        let last = chain[6].level();
        let wanted = chain[0].level().passing_share(0.5);
        assert!(wanted > 0.2 && wanted < 0.3);
        assert_eq!(last.passing_share(level_threshold(last, wanted)), 0.0);
    }

    /// "Content affects this threshold, so it differs between textures."
    #[test]
    fn the_threshold_differs_between_maps() {
        let of = |map: super::super::tests::Map| {
            let wanted = map.level().passing_share(0.5);
            level_threshold(map.chain()[4].level(), wanted)
        };
        assert!((of(fence(256)) - of(leaves(256))).abs() > 0.02);
    }

    #[test]
    fn ties_pass_together_and_alpha_0_never_does() {
        let texels = [0.0, 0.25, 0.25, 0.75];
        let level = Level { texels: &texels, width: 2, height: 2 };
        assert_eq!(level_threshold(level, 0.25), 0.5);
        assert_eq!(level_threshold(level, 0.75), 0.125);
        assert_eq!(level_threshold(level, 1.0), 0.125);
        assert_eq!(level_threshold(level, 0.0), f32::INFINITY);
        // One or three of four: equally near, the larger share wins.
        assert_eq!(level_threshold(level, 0.5), 0.125);
        assert_eq!(level_threshold(Level { texels: &[], width: 0, height: 0 }, 0.5), f32::INFINITY);
    }

    #[test]
    fn a_window_of_one_texel_passes_by_majority() {
        let chain = leaves(64).chain();
        let (base, level) = (chain[0].level(), chain[3].level());
        let thresholds = texel_thresholds(level, base, 0.5, 0);
        for (alpha, threshold) in level.texels.iter().zip(&thresholds) {
            assert_eq!(alpha >= threshold, *alpha >= 0.5);
        }
        // A window over the whole level is the threshold of the level.
        let whole = texel_thresholds(level, base, 0.5, 64);
        assert!(whole.iter().all(|&t| t == level_threshold(level, base.passing_share(0.5))));
    }
}
