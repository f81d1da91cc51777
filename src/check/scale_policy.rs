//! Which size of cells a footprint asks for: what lies between one scale for all axes and one for each.
//!
//! Listing 1 takes the longer of the two derivatives (§5.1), Listing 2 the longest along each axis of the object (§6). A policy here gives a
//! footprint other derivatives, from which a threshold finds the scales of the policy; the threshold itself stays as it is. Only the two of
//! the paper are in its listings.

use crate::threshold::footprint::Footprint;
use crate::threshold::two_scale::Variant;
use glam::{Vec3, vec3};

/// A way from two derivatives to the sides of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ScalePolicy {
    /// One side, as long as the longer derivative: a pixel never steps over a cell (Listing 1).
    Longer,
    /// One side, the root of the mean square of both derivatives: it does not change when the camera turns about the line of sight.
    RootMeanSquare,
    /// One side, the root of the area between both derivatives.
    Area,
    /// One side, as long as the shorter derivative.
    Shorter,
    /// A side for each axis, but none below this share, in (0, 1], of the longest (Listing 2 has no such share).
    EachAxis(f32),
}

impl ScalePolicy {
    /// The variant whose scales it feeds.
    #[must_use]
    pub const fn variant(self) -> Variant {
        match self {
            Self::Longer | Self::RootMeanSquare | Self::Area | Self::Shorter => Variant::Isotropic,
            Self::EachAxis(_) => Variant::Anisotropic,
        }
    }

    /// Returns the footprint whose scales are those of the policy: derivatives are exchanged, the position stays.
    #[must_use]
    pub fn applied(self, footprint: &Footprint<f32>) -> Footprint<f32> {
        let &Footprint { position, dpdx, dpdy } = footprint;
        let of_length = |length: f32| Footprint { position, dpdx: vec3(length, 0.0, 0.0), dpdy: Vec3::ZERO };
        let [one, other] = [dpdx.length(), dpdy.length()];
        match self {
            Self::Longer => of_length(one.max(other)),
            Self::RootMeanSquare => of_length((0.5 * (one * one + other * other)).sqrt()),
            Self::Area => of_length(dpdx.cross(dpdy).length().sqrt()),
            Self::Shorter => of_length(one.min(other)),
            Self::EachAxis(share) => {
                let sides = dpdx.abs().max(dpdy.abs());
                let dpdx = sides.max(Vec3::splat(share * sides.max_element()));
                Footprint { position, dpdx, dpdy: Vec3::ZERO }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::threshold::robust::Robust;

    fn footprint() -> Footprint<f32> {
        Footprint::new([0.31, -1.72, 2.43], [0.012, 0.003, -0.007], [0.002, 0.094, 0.033])
    }

    /// The policies of the paper leave thresholds as they are.
    #[test]
    fn longer_is_the_isotropic_threshold_and_each_axis_the_anisotropic_one() {
        for (policy, variant) in [
            (ScalePolicy::Longer, Variant::Isotropic),
            (ScalePolicy::EachAxis(1.0 / 32.0), Variant::Anisotropic),
        ] {
            assert_eq!(policy.variant(), variant);
            let of = |footprint| Robust::new(variant).threshold(&footprint).expect("finite");
            assert!((of(policy.applied(&footprint())) - of(footprint())).abs() < 1e-5, "{policy:?}");
        }
    }

    /// Sides lie between the shorter and the longer derivative; seen from the front all are one.
    #[test]
    fn one_side_lies_between_the_derivatives() {
        let side = |policy: ScalePolicy, footprint| policy.applied(&footprint).dpdx.x;
        let [shorter, area, mean, longer] =
            [ScalePolicy::Shorter, ScalePolicy::Area, ScalePolicy::RootMeanSquare, ScalePolicy::Longer]
                .map(|policy| side(policy, footprint()));
        assert!(shorter < area && area < mean && mean < longer, "{shorter} {area} {mean} {longer}");
        let front = Footprint { dpdx: Vec3::X * 0.25, dpdy: Vec3::Y * 0.25, ..footprint() };
        for policy in [ScalePolicy::Shorter, ScalePolicy::Area, ScalePolicy::RootMeanSquare] {
            assert_eq!(side(policy, front), 0.25, "{policy:?}");
        }
        let flat = ScalePolicy::EachAxis(0.25).applied(&front);
        assert_eq!(flat.dpdx, vec3(0.25, 0.25, 0.0625));
    }
}
