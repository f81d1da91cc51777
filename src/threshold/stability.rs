//! Closed forms for the share of thresholds that a small motion changes.
//!
//! None is in the paper, which claims that sub-pixel translations return the same value (§5) and that hashed alpha is
//! about as stable as the traditional test (§11). All assume that positions are spread evenly over the cells.

/// Returns the probability that a displacement moves a point into another cell of a grid.
///
/// `cells_per_unit` holds the scale of the grid along each axis, `displacement` the motion in object units. The value
/// is `1 - prod max(0, 1 - |v_i| s_i)`, in [0, 1]. With the scale of the finer grid it is the probability that the
/// threshold changes; with the coarser one, that both hashes change.
#[must_use]
pub fn change_probability(cells_per_unit: [f64; 3], displacement: [f64; 3]) -> f64 {
    let kept: f64 =
        cells_per_unit.iter().zip(displacement).map(|(s, v)| (1.0 - (v * s).abs()).max(0.0)).product();
    1.0 - kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_along_one_axis_changes_its_share_of_the_cell() {
        assert_eq!(change_probability([4.0, 4.0, 4.0], [0.0625, 0.0, 0.0]), 0.25);
        assert_eq!(change_probability([4.0, 4.0, 4.0], [0.0, -0.3, 0.0]), 1.0);
        assert_eq!(change_probability([4.0, 4.0, 4.0], [0.0; 3]), 0.0);
    }

    #[test]
    fn axes_are_independent() {
        assert_eq!(change_probability([1.0, 2.0, 4.0], [0.5, 0.25, 0.125]), 1.0 - 0.125);
    }
}
