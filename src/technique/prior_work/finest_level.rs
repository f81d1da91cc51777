//! Alpha from a finer level than the footprint asks for (§3).

/// Returns the level to read alpha from where none beyond `greatest` (`i_max` of §3) may be read: the smaller of the
/// two. With `greatest` 0 it is always the finest level.
///
/// Levels below 0 (magnification) stay, NaN gives `greatest`. Colour and alpha then come from different levels: two
/// fetches, or no filtering of colour.
#[must_use]
pub fn limited(lod: f64, greatest: f64) -> f64 {
    lod.min(greatest)
}

/// Returns the mean number of texels that lie between two reads of neighbouring pixels where a footprint of level
/// `lod` reads level `read`: `2^(lod - read)`. Above 1 it skips texels: the cache is thrashed and the picture aliases.
#[must_use]
pub fn stride(lod: f64, read: f64) -> f64 {
    libm::exp2(lod - read)
}

#[cfg(test)]
mod tests {
    use super::super::tests::fence;
    use super::*;

    /// The finest level keeps alpha's variance: as many texels pass as in the map, wherever the pixels lie.
    #[test]
    fn the_finest_level_keeps_the_share_of_passing_texels() {
        let chain = fence(256).chain();
        let base = &chain[0];
        let read = limited(4.0, 0.0) as usize;
        assert_eq!(read, 0);
        let step = stride(4.0, 0.0) as usize;
        let kept_at = |phase: usize| {
            let places = (0..256).step_by(step).flat_map(|y| (0..256).step_by(step).map(move |x| (x, y)));
            let places: Vec<_> = places.map(|(x, y)| ((x + phase) % 256, (y + phase) % 256)).collect();
            let kept = places.iter().filter(|&&(x, y)| base.texels[y * 256 + x] >= 0.5).count();
            kept as f64 / places.len() as f64
        };
        let shares: Vec<_> = (0..step).map(kept_at).collect();
        let mean = shares.iter().sum::<f64>() / step as f64;
        assert!(mean > 0.0 && chain[4].level().passing_share(0.5) == 0.0);
        // "Both approaches reduce the temporal stability": a shift of texels turns the whole fence on and off.
        let [least, most] = [f64::min as fn(f64, f64) -> f64, f64::max]
            .map(|pick| shares.iter().copied().reduce(pick).unwrap_or(f64::NAN));
        assert_eq!((least, most), (0.0, 1.0));
    }

    #[test]
    fn levels_up_to_the_limit_are_read_as_they_are() {
        assert_eq!([-1.0, 0.5, 2.0, 7.0].map(|lod| limited(lod, 2.0)), [-1.0, 0.5, 2.0, 2.0]);
        assert_eq!(limited(f64::NAN, 2.0), 2.0);
    }
}
