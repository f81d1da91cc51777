//! Many samples a pixel in the full map (§3).

/// Returns the mean of `sample` over the centres of `side * side` equal parts of a pixel; the arguments are in (0, 1).
/// NaN for a side of 0.
#[must_use]
pub fn supersampled(side: u32, mut sample: impl FnMut(f64, f64) -> f64) -> f64 {
    let place = |i: u32| (f64::from(i) + 0.5) / f64::from(side);
    let sum: f64 =
        (0..side).flat_map(|y| (0..side).map(move |x| (x, y))).map(|(x, y)| sample(place(x), place(y))).sum();
    sum / (f64::from(side) * f64::from(side))
}

/// Returns how many samples along each side of a pixel read every texel of the finest level: `2^ceil(lod)`, at least 1.
///
/// The square of it is what a footprint of that level costs; it has no bound, as §3 says. Levels count up to 31.
#[must_use]
pub fn side_needed(lod: f64) -> u32 {
    1 << lod.ceil().clamp(0.0, 31.0) as u32
}

#[cfg(test)]
mod tests {
    use super::super::tests::leaves;
    use super::*;

    /// "With sufficiently dense supersampling, one can always access the full resolution texture."
    #[test]
    fn enough_samples_of_binary_alpha_are_the_filtered_alpha() {
        let chain = leaves(256).chain();
        let (base, coarse) = (&chain[0], &chain[4]);
        let side = side_needed(4.0);
        for (i, &expected) in coarse.texels.iter().enumerate() {
            let corner = (16 * (i % 16), 16 * (i / 16));
            let test = |x: f64, y: f64| {
                let (column, row) = (corner.0 + (16.0 * x) as usize, corner.1 + (16.0 * y) as usize);
                f64::from(u8::from(base.texels[row * 256 + column] >= 0.5))
            };
            assert_eq!(supersampled(side, test), f64::from(expected));
            // Half as many along a side are not enough for every pixel.
            assert!((supersampled(side / 2, test) - f64::from(expected)).abs() < 0.2);
        }
        let wrong = coarse.texels.iter().enumerate().filter(|&(i, &expected)| {
            let corner = (16 * (i % 16), 16 * (i / 16));
            let value = supersampled(4, |x, y| {
                f64::from(
                    base.texels[(corner.1 + (16.0 * y) as usize) * 256 + corner.0 + (16.0 * x) as usize],
                )
            });
            value != f64::from(expected)
        });
        assert!(wrong.count() > 20);
    }

    #[test]
    fn the_cost_doubles_along_each_side_with_each_level() {
        assert_eq!([-2.0, 0.0, 0.3, 1.0, 5.0, 99.0].map(side_needed), [1, 1, 2, 2, 32, 1 << 31]);
    }
}
