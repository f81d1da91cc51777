//! How often a threshold passes alpha when the view of its point changes and the point stays where it is.
//!
//! The scales change, and with them the weights of the octaves, until other octaves take their place. How a point that
//! moves changes its threshold is told by [`pair_law`](super::pair_law). Not in the paper; for hashes that are independent and
//! uniform.

use super::nested::share_kept;
use super::shared_cell::copula_joint_visibility;
use crate::check::Subject;
use crate::check::subject::Nominal;
use crate::threshold::cdf::quantile;
use crate::threshold::robust::Join;
use crate::threshold::two_scale::Variant;

/// Returns the probability that exactly one of the thresholds of a point in two views is at most `alpha` in (0, 1),
/// where only the scales differ and the point stays where it is.
///
/// For views at any distance: a threshold that passes alpha twice between them counts as none.
#[must_use]
pub fn flip_between(subject: &Subject<'_>, before: &Nominal, after: &Nominal, alpha: f64) -> f64 {
    let axes = 0..if subject.variant == Variant::Anisotropic { 3 } else { 1 };
    let redrawn = 2.0 * alpha * (1.0 - alpha);
    match subject.join {
        Join::Interpolate => {
            let view = |nominal: &Nominal| Mixture::new(alpha, nominal.lerp_factor);
            if before.coarse_scale == after.coarse_scale {
                view(before).flip_within(&view(after))
            } else if before.fine_scale == after.coarse_scale {
                view(before).flip_across(&view(after))
            } else if before.coarse_scale == after.fine_scale {
                view(after).flip_across(&view(before))
            } else {
                // Listing 2 exchanges both of its cells where one axis passes an octave.
                redrawn
            }
        }
        Join::Copula => {
            let along = |[low, high]: [f64; 2], octaves: f64| match octaves {
                0.0 => libm::cos(angle(high) - angle(low)),
                // The finer cell of one view is the coarser of the other.
                1.0 => libm::sin(angle(low)) * libm::cos(angle(high)),
                _ => 0.0,
            };
            let correlation = axes.map(|axis| on_scale(before, after, axis, along)).product();
            2.0 * (alpha - copula_joint_visibility(correlation, alpha))
        }
        Join::Dithered | Join::Inherit => {
            let share = |octaves: f64| share_kept(subject.join, subject.variant, octaves);
            let kept = |[low, high]: [f64; 2], octaves: f64| {
                if octaves == 0.0 {
                    // Both views choose alike but between their fractions.
                    return 1.0 - (high - low) * (1.0 - share(1.0));
                }
                // Each chooses for itself: the finer octave of the one and the coarser one of the other are nearest.
                let nearest = low * (1.0 - high) * share(octaves - 1.0);
                let farthest = (1.0 - low) * high * share(octaves + 1.0);
                nearest + ((1.0 - low) * (1.0 - high) + low * high) * share(octaves) + farthest
            };
            let kept: f64 = axes.map(|axis| on_scale(before, after, axis, kept)).product();
            (1.0 - kept) * redrawn
        }
    }
}

/// Orders two views by their scale along an axis and calls `value(fractions, octaves_between)`, the coarser one first.
fn on_scale(before: &Nominal, after: &Nominal, axis: usize, value: impl Fn([f64; 2], f64) -> f64) -> f64 {
    let place = |view: &Nominal| (libm::log2(view.coarse_scale[axis]), view.fraction[axis]);
    let (mut low, mut high) = (place(before), place(after));
    if high < low {
        (low, high) = (high, low);
    }
    value([low.1, high.1], high.0 - low.0)
}

/// The angle of the normal mixture within an octave: its weights are in the ratio of the cosine and the sine.
fn angle(fraction: f64) -> f64 {
    libm::atan2(fraction, 1.0 - fraction)
}

/// The paper's join at one lerp factor, and the mixture at which its threshold is alpha.
struct Mixture {
    lerp_factor: f64,
    at_alpha: f64,
}

impl Mixture {
    fn new(alpha: f64, lerp_factor: f64) -> Self {
        Self { lerp_factor, at_alpha: quantile(alpha, lerp_factor) }
    }

    /// The probability of a threshold up to alpha, given one of the two hashes and the weight of the other.
    fn kept(&self, given: f64, weight: f64) -> f64 {
        let left = self.at_alpha - (1.0 - weight) * given;
        if weight > 0.0 { (left / weight).clamp(0.0, 1.0) } else { f64::from(u8::from(left >= 0.0)) }
    }

    /// Where [`Self::kept`] leaves 1 and reaches 0.
    fn corners(&self, weight: f64) -> [f64; 2] {
        [self.at_alpha - weight, self.at_alpha].map(|x| x / (1.0 - weight))
    }

    /// The probability of a flip to a view with the same two cells.
    fn flip_within(&self, other: &Self) -> f64 {
        let views = [self, other];
        let corners = views.map(|view| view.corners(view.lerp_factor));
        sum_of_parts(corners, |from, to| {
            // Both are straight lines here, and may cross.
            let difference = |at: f64| {
                let [a, b] = views.map(|view| view.kept(from + (to - from) * at, view.lerp_factor));
                a - b
            };
            let [low, high] = [difference(0.25), difference(0.75)];
            let [first, last] = [1.5 * low - 0.5 * high, 1.5 * high - 0.5 * low].map(f64::abs);
            let mean = if low.signum() == high.signum() && (first + last) <= 2.0 * (low.abs() + high.abs()) {
                0.5 * (low + high).abs()
            } else {
                0.5 * (first * first + last * last) / (first + last)
            };
            mean * (to - from)
        })
    }

    /// The probability of a flip to a view one octave finer, whose coarse cell is the fine one of this view.
    fn flip_across(&self, finer: &Self) -> f64 {
        let weights = [1.0 - self.lerp_factor, finer.lerp_factor];
        sum_of_parts([self.corners(weights[0]), finer.corners(weights[1])], |from, to| {
            // Two points of Gauss are exact for the product of two straight lines.
            let flip = |at: f64| {
                let given = from + (to - from) * at;
                let [a, b] = [self.kept(given, weights[0]), finer.kept(given, weights[1])];
                a * (1.0 - b) + b * (1.0 - a)
            };
            let apart = 0.5 / 3.0_f64.sqrt();
            0.5 * (flip(0.5 - apart) + flip(0.5 + apart)) * (to - from)
        })
    }
}

/// Sums what is found between neighbouring corners, over [0, 1].
fn sum_of_parts(corners: [[f64; 2]; 2], part: impl Fn(f64, f64) -> f64) -> f64 {
    let [[a, b], [c, d]] = corners;
    let mut places = [0.0, a, b, c, d, 1.0].map(|place| place.clamp(0.0, 1.0));
    places.sort_unstable_by(f64::total_cmp);
    places.windows(2).filter(|pair| pair[0] < pair[1]).map(|pair| part(pair[0], pair[1])).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::subject::Precision;
    use crate::threshold::cdf::cdf;
    use crate::threshold::normal::normal_quantile;
    use glam::DVec3;

    fn subject(variant: Variant, join: Join) -> Subject<'static> {
        let mut subject = Subject::new("", Precision::F64, variant, |_| 0.5_f64);
        subject.join = join;
        subject
    }

    fn view(log_scale: f64) -> Nominal {
        let octave = log_scale.floor();
        Nominal {
            coarse_scale: [libm::exp2(octave); 3],
            fine_scale: [libm::exp2(octave + 1.0); 3],
            coarse_cell: DVec3::ZERO,
            fine_cell: DVec3::ZERO,
            fraction: [log_scale - octave; 3],
            lerp_factor: log_scale - octave,
        }
    }

    /// Flips over an octave of zoom that begins between two octaves, in so many steps.
    fn flips_of_an_octave(join: Join, alpha: f64, steps: u32) -> f64 {
        let subject = subject(Variant::Isotropic, join);
        let views: Vec<Nominal> =
            (0..=steps).map(|step| view(3.4 + f64::from(step) / f64::from(steps))).collect();
        views.windows(2).map(|pair| flip_between(&subject, &pair[0], &pair[1], alpha)).sum()
    }

    #[test]
    fn an_octave_of_zoom_has_its_closed_form() {
        let near = |found: f64, expected: f64| assert!((found - expected).abs() < 2e-4, "{found} {expected}");
        for (alpha, expected) in [(0.05, 0.1651), (0.1, 0.2609), (0.2, 0.3833), (0.3, 0.4532), (0.5, 0.5)] {
            near(flips_of_an_octave(Join::Interpolate, alpha, 4096), expected);
            near(flips_of_an_octave(Join::Interpolate, 1.0 - alpha, 4096), expected);
            near(flips_of_an_octave(Join::Dithered, alpha, 4096), 2.0 * alpha * (1.0 - alpha));
            // One in 256 cells would have to ask a fifth parent.
            let inherited = (0.75 + 1.0 / 256.0) * 2.0 * alpha * (1.0 - alpha);
            near(flips_of_an_octave(Join::Inherit, alpha, 4096), inherited);
            // A quarter turn of a normal vector (Rice 1944).
            let z = normal_quantile(alpha);
            near(flips_of_an_octave(Join::Copula, alpha, 4096), 0.5 * libm::exp(-0.5 * z * z));
        }
    }

    #[test]
    fn flips_of_distant_views_are_what_counting_finds() {
        let n = 120;
        let hashes = || (0..n).map(move |i| (f64::from(i) + 0.5) / f64::from(n));
        let alpha = 0.3;
        for (from, to) in [(3.0, 3.5), (3.1, 3.9), (3.7, 4.2), (3.9, 4.0), (3.5, 4.5), (3.2, 4.9)] {
            let subject = subject(Variant::Isotropic, Join::Interpolate);
            let found = flip_between(&subject, &view(from), &view(to), alpha);
            let back = flip_between(&subject, &view(to), &view(from), alpha);
            assert!((found - back).abs() < 1e-12);
            let [before, after] = [view(from), view(to)];
            let kept = |view: &Nominal, u: f64, v: f64| {
                cdf((1.0 - view.lerp_factor) * u + view.lerp_factor * v, view.lerp_factor) <= alpha
            };
            let next = before.coarse_scale != after.coarse_scale;
            let mut flips = 0;
            for u in hashes() {
                for v in hashes() {
                    for w in hashes().step_by(if next { 1 } else { n as usize }) {
                        let then = if next { kept(&after, v, w) } else { kept(&after, u, v) };
                        flips += u32::from(kept(&before, u, v) != then);
                    }
                }
            }
            let counted = f64::from(flips) / f64::from(n * n * if next { n } else { 1 });
            assert!((found - counted).abs() < 0.01, "{from} {to}: {found} {counted}");
        }
    }
}
