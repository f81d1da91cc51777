//! Boxes along the axes, and rays that meet them.

use glam::DVec3;

/// A box along the axes.
#[derive(Clone, Copy, Debug)]
pub(in crate::render) struct Extent {
    pub(in crate::render) low: DVec3,
    pub(in crate::render) high: DVec3,
}

impl Extent {
    /// The box of nothing.
    pub(in crate::render) const EMPTY: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    /// The least box around points.
    pub(in crate::render) fn around(points: &[DVec3]) -> Self {
        points.iter().fold(Self::EMPTY, |extent, &point| extent.with_point(point))
    }

    /// The least box around this one and a point.
    pub(in crate::render) fn with_point(&self, point: DVec3) -> Self {
        self.with(&Self { low: point, high: point })
    }

    /// The least box around this one and another.
    pub(in crate::render) fn with(&self, other: &Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The same, larger by `margin` on every side.
    pub(in crate::render) fn widened(&self, margin: f64) -> Self {
        Self { low: self.low - margin, high: self.high + margin }
    }

    pub(in crate::render) fn middle(&self) -> DVec3 {
        0.5 * self.low + 0.5 * self.high
    }

    /// Lengths along the axes.
    pub(in crate::render) fn sides(&self) -> DVec3 {
        self.high - self.low
    }

    /// Half of its surface.
    pub(in crate::render) fn surface(&self) -> f64 {
        let [x, y, z] = self.sides().to_array();
        x * y + y * z + z * x
    }
}

/// A ray from a point up to a distance.
#[derive(Clone, Copy, Debug)]
pub(in crate::render) struct Ray {
    pub(in crate::render) origin: DVec3,
    /// Of length one.
    pub(in crate::render) direction: DVec3,
    pub(in crate::render) reach: f64,
    /// One over the direction.
    inverse: DVec3,
}

impl Ray {
    pub(in crate::render) fn new(origin: DVec3, direction: DVec3, reach: f64) -> Self {
        // A product with infinity may be no number.
        let inverse = direction.recip().clamp(DVec3::MIN, DVec3::MAX);
        Self { origin, direction, reach, inverse }
    }

    /// Returns whether it meets a box, up to rounding. It meets every box around one that it meets: distances keep the order
    /// of sides, whatever is rounded.
    pub(in crate::render) fn meets(&self, extent: &Extent) -> bool {
        let to_low = (extent.low - self.origin) * self.inverse;
        let to_high = (extent.high - self.origin) * self.inverse;
        let begins = to_low.min(to_high).max_element();
        let ends = to_low.max(to_high).min_element();
        begins <= ends && begins <= self.reach && ends >= 0.0
    }
}
