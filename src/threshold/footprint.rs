//! What a fragment knows of its place: the inputs of Listings 1 and 2.

use super::real::Real;

/// A position on a surface and its two screen derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint<R: Real> {
    /// Position in object units (`objCoord` in the paper).
    pub position: R::Vec3,
    /// Change of the position to the next pixel on the right, in object units per pixel (`dFdx(objCoord)`).
    pub dpdx: R::Vec3,
    /// Change of the position to the next pixel along screen y, in object units per pixel (`dFdy(objCoord)`).
    pub dpdy: R::Vec3,
}

impl<R: Real> Footprint<R> {
    /// Makes a footprint of whatever is three numbers: arrays, or vectors of this crate's glam; those of another version by
    /// their `to_array`.
    ///
    /// ```
    /// use hashed_alpha::Footprint;
    ///
    /// let footprint = Footprint::<f32>::new([0.31, -1.72, 2.43], [0.012, 0.0, -0.001], [0.0, 0.009, 0.003]);
    /// assert_eq!(footprint.position, glam::vec3(0.31, -1.72, 2.43));
    /// ```
    #[must_use]
    pub fn new(position: impl Into<[R; 3]>, dpdx: impl Into<[R; 3]>, dpdy: impl Into<[R; 3]>) -> Self {
        let [position, dpdx, dpdy] = [position.into(), dpdx.into(), dpdy.into()].map(R::Vec3::from);
        Self { position, dpdx, dpdy }
    }

    /// Rounds every component to the nearest value of another precision.
    #[must_use]
    pub fn cast<S: Real>(&self) -> Footprint<S> {
        let cast = |v: R::Vec3| S::Vec3::from(v.into().map(|c: R| S::from_f64(c.to_f64())));
        Footprint { position: cast(self.position), dpdx: cast(self.dpdx), dpdy: cast(self.dpdy) }
    }
}
