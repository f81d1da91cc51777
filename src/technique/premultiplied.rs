//! Colour under an alpha test: premultiplied textures, the divide, and the halo that they avoid (§7.3; Glassner 2015).

/// Colour and alpha, each in [0, 1].
pub type Rgba = [f64; 4];

/// Returns `(alpha R, alpha G, alpha B, alpha)`.
#[must_use]
pub fn premultiply([r, g, b, alpha]: Rgba) -> Rgba {
    [alpha * r, alpha * g, alpha * b, alpha]
}

/// Returns the colour to write where a premultiplied texel passes the test: its colour divided by its alpha. §7.3.
///
/// Literal: NaN at alpha 0, which no test with a threshold above 0 passes.
#[must_use]
pub fn divide_literal([r, g, b, alpha]: Rgba) -> [f64; 3] {
    [r / alpha, g / alpha, b / alpha]
}

/// Returns the colour to write where a premultiplied texel passes the test: its colour divided by its alpha, and black
/// at alpha 0. §7.3.
#[must_use]
pub fn divide(texel: Rgba) -> [f64; 3] {
    if texel[3] > 0.0 { divide_literal(texel) } else { [0.0; 3] }
}

/// Returns the mean of texels, component by component, as a mipmap's box filter makes it; zeros for no texels.
#[must_use]
pub fn filtered(texels: &[Rgba]) -> Rgba {
    let count = texels.len().max(1) as f64;
    texels.iter().fold([0.0; 4], |sum, texel| core::array::from_fn(|i| sum[i] + texel[i] / count))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A green leaf, and what the artist painted where it is clear.
    const LEAF: Rgba = [0.0, 1.0, 0.0, 1.0];
    const PAINT: Rgba = [1.0, 0.0, 1.0, 0.0];

    /// "Colors bled from transparent texels" where the threshold is below 1/2; premultiplied ones do not.
    #[test]
    fn a_halo_appears_without_premultiplied_alpha_only() {
        let straight = filtered(&[LEAF, PAINT, PAINT, PAINT]);
        assert_eq!(straight, [0.75, 0.25, 0.75, 0.25]);
        let premultiplied = filtered(&[LEAF, PAINT, PAINT, PAINT].map(premultiply));
        assert_eq!(divide(premultiplied), [0.0, 1.0, 0.0]);
        // Both keep the same alpha, and a traditional test shows neither.
        assert_eq!(straight[3], premultiplied[3]);
        assert!(straight[3] < 0.5);
    }

    /// "We need to divide by alpha to maintain convergence to ground truth": over thresholds spread evenly.
    #[test]
    fn without_the_divide_alpha_counts_twice() {
        let texel = filtered(&[LEAF, PAINT, LEAF, PAINT].map(premultiply));
        let n = 1000;
        let kept = (0..n).filter(|&i| texel[3] >= (f64::from(i) + 0.5) / f64::from(n)).count();
        let visible = kept as f64 / f64::from(n);
        let truth = texel[1];
        assert_eq!(visible * divide(texel)[1], truth);
        assert_eq!(visible * texel[1], 0.5 * truth);
    }

    #[test]
    fn alpha_0_has_no_colour() {
        assert!(divide_literal([0.0; 4])[0].is_nan());
        assert_eq!(divide([0.0; 4]), [0.0; 3]);
        assert_eq!(divide(premultiply([0.3, 0.6, 0.9, 0.5])), [0.3, 0.6, 0.9]);
    }
}
