//! Fragments of one pixel under blending: sorted, naive, and after an alpha test (§3; Moore & Jefferies 2009).

/// A fragment of a pixel: a surface's depth, its alpha and what it shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Distance from the viewer.
    pub depth: f64,
    /// Opacity, in [0, 1].
    pub alpha: f64,
    /// What is seen where it is opaque: radiance of one colour channel.
    pub value: f64,
}

fn over(layer: &Layer, behind: f64) -> f64 {
    layer.alpha * layer.value + (1.0 - layer.alpha) * behind
}

/// Returns the pixel with its fragments blended from back to front: the ground truth of §4 and Fig. 5.
#[must_use]
pub fn sorted(layers: &[Layer], background: f64) -> f64 {
    let mut layers = layers.to_vec();
    layers.sort_by(|a, b| b.depth.total_cmp(&a.depth));
    layers.iter().fold(background, |behind, layer| over(layer, behind))
}

/// Returns the pixel with its fragments blended in the order in which they come, each writing depth: naive blending,
/// whose transparent fragments hide what comes later and lies behind (§3).
#[must_use]
pub fn naive(layers: &[Layer], background: f64) -> f64 {
    let blended = |(behind, nearest): (f64, f64), layer: &Layer| {
        if layer.depth < nearest { (over(layer, behind), layer.depth) } else { (behind, nearest) }
    };
    layers.iter().fold((background, f64::INFINITY), blended).0
}

/// Returns the pixel drawn twice: first what passes the alpha test, opaque and with depth; then the rest, blended in
/// the order in which it comes where it lies before that depth, without writing any. §3.
#[must_use]
pub fn test_then_blend(layers: &[Layer], background: f64, threshold: f64) -> f64 {
    let (solid, thin): (Vec<&Layer>, Vec<_>) = layers.iter().partition(|layer| layer.alpha >= threshold);
    let nearest = solid.into_iter().min_by(|a, b| a.depth.total_cmp(&b.depth));
    let (behind, limit) = nearest.map_or((background, f64::INFINITY), |layer| (layer.value, layer.depth));
    thin.into_iter().filter(|layer| layer.depth < limit).fold(behind, |behind, layer| over(layer, behind))
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEAR_EDGE: Layer = Layer { depth: 1.0, alpha: 0.1, value: 1.0 };
    const FAR_LEAF: Layer = Layer { depth: 2.0, alpha: 1.0, value: 0.5 };

    /// The halo: the background shines through a nearly clear fragment that was drawn first.
    #[test]
    fn naive_blending_hides_an_opaque_fragment_behind_a_transparent_one() {
        let drawn = [NEAR_EDGE, FAR_LEAF];
        assert_eq!(naive(&drawn, 0.0), 0.1);
        assert_eq!(sorted(&drawn, 0.0), 0.1 + 0.9 * 0.5);
    }

    /// "This guarantees transparent fragments never occlude opaque ones."
    #[test]
    fn after_an_alpha_test_the_order_of_an_opaque_fragment_is_of_no_account() {
        for drawn in [[NEAR_EDGE, FAR_LEAF], [FAR_LEAF, NEAR_EDGE]] {
            assert_eq!(test_then_blend(&drawn, 0.0, 0.5), sorted(&drawn, 0.0));
        }
    }

    /// What it does not promise: two transparent fragments still depend on their order, and passing ones turn solid.
    #[test]
    fn it_is_no_sorted_blend() {
        let other = Layer { depth: 1.5, alpha: 0.4, value: 0.0 };
        let [one, two] = [[NEAR_EDGE, other], [other, NEAR_EDGE]].map(|d| test_then_blend(&d, 0.2, 0.5));
        assert_ne!(one, two);
        let glass = [Layer { alpha: 0.6, ..FAR_LEAF }];
        assert_eq!(test_then_blend(&glass, 0.0, 0.5), 0.5);
        assert_eq!(sorted(&glass, 0.0), 0.3);
    }
}
