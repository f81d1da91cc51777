//! How many thresholds a motion changes, from the cells that a subject claims to have.

use super::PairLaw;
use crate::check::Subject;
use crate::check::subject::Nominal;
use crate::check::tolerance::MEETING;
use crate::stats::poisson_binomial::{self, PoissonBinomial};
use crate::threshold::footprint::Footprint;
use crate::threshold::robust::Join;
use crate::threshold::stability::change_probability;
use crate::threshold::two_scale::Variant;
use rustc_hash::FxHashMap;

/// The number of thresholds that change, of samples that are independent but for the octaves that they choose.
#[derive(Clone, Default)]
pub(crate) struct Changes {
    /// The expected number.
    pub(crate) mean: f64,
    /// What the variance of the number would be if no two samples shared a choice.
    alone: f64,
    /// By axis, octave and index of an interval: the sum of what its choice decides in each sample, and of its squares.
    choices: FxHashMap<(usize, u64, i64), [f64; 2]>,
}

impl Changes {
    /// Adds a sample that moves.
    pub(crate) fn add(&mut self, subject: &Subject<'_>, here: &Footprint<f64>, motion: glam::DVec3) {
        let nominal = subject.nominal(here);
        let probability = probability(subject, &nominal, motion);
        self.mean += probability;
        self.alone += probability * (1.0 - probability);
        if !(subject.join.switches() && subject.variant == Variant::Anisotropic) {
            return;
        }
        let axes = axes(&nominal, motion);
        for (axis, &Axis { coarse, fine, fraction }) in axes.iter().enumerate() {
            let others: f64 = (0..3).filter(|&other| other != axis).map(|other| axes[other].kept()).product();
            // The standard deviation of the probability that one choice makes.
            let decided = (fine - coarse) * others * (fraction * (1.0 - fraction)).sqrt();
            if decided > 0.0 {
                let interval = (axis, nominal.coarse_scale[axis].to_bits(), nominal.coarse_cell[axis] as i64);
                let [sum, squares] = self.choices.entry(interval).or_default();
                *sum += decided;
                *squares += decided * decided;
            }
        }
    }

    /// Adds other samples.
    pub(crate) fn merge(&mut self, other: &Self) {
        self.mean += other.mean;
        self.alone += other.alone;
        for (interval, [sum, squares]) in &other.choices {
            let [all, all_squares] = self.choices.entry(*interval).or_default();
            *all += sum;
            *all_squares += squares;
        }
    }

    /// Compares a number of changes with the expected one, of which as many as [`MEETING`] may be missing.
    pub(crate) fn compared(&self, changed: u64) -> PoissonBinomial {
        let meetings = MEETING * self.mean;
        let nearest = (changed as f64).clamp(self.mean - meetings, self.mean);
        poisson_binomial::sum_of_events(changed, nearest, self.variance() + meetings)
    }

    /// The variance of the number: two samples that share an interval have a covariance of no more than the product of
    /// what it decides in each.
    pub(crate) fn variance(&self) -> f64 {
        self.alone + self.choices.values().map(|[sum, squares]| sum * sum - squares).sum::<f64>()
    }
}

/// The probability that a motion changes the threshold, from the cells that the subject claims to have.
pub(crate) fn redraw_probability(subject: &Subject<'_>, here: &Footprint<f64>, motion: glam::DVec3) -> f64 {
    probability(subject, &subject.nominal(here), motion)
}

fn probability(subject: &Subject<'_>, nominal: &Nominal, motion: glam::DVec3) -> f64 {
    let whole = motion.to_array();
    let coarse = change_probability(nominal.coarse_scale, whole);
    let fine = change_probability(nominal.fine_scale, whole);
    match (subject.join, subject.variant) {
        // The finer of the two grids decides, since a coarse cell is a union of fine ones.
        (Join::Interpolate | Join::Copula, _) => fine,
        // The coarse cell chooses, and the fine one counts where it was chosen.
        (Join::Dithered | Join::Inherit, Variant::Anisotropic) => {
            1.0 - axes(nominal, motion).iter().map(Axis::kept).product::<f64>()
        }
        (Join::Dithered, _) => coarse + nominal.fraction[0] * (fine - coarse),
        (Join::Inherit, _) => 1.0 - PairLaw::new(subject, nominal, motion).same(),
    }
}

/// A motion along one axis: the probabilities that it leaves the coarse and the fine interval, and that the fine one counts.
struct Axis {
    coarse: f64,
    fine: f64,
    fraction: f64,
}

impl Axis {
    fn kept(&self) -> f64 {
        1.0 - (self.coarse + self.fraction * (self.fine - self.coarse))
    }
}

fn axes(nominal: &Nominal, motion: glam::DVec3) -> [Axis; 3] {
    [0, 1, 2].map(|axis| {
        let part = |scale: [f64; 3]| (motion[axis] * scale[axis]).abs().min(1.0);
        let (coarse, fine) = (part(nominal.coarse_scale), part(nominal.fine_scale));
        Axis { coarse, fine, fraction: nominal.fraction[axis] }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::specimen::ideal;
    use crate::check::subject::Precision;
    use crate::scene::Fragment;
    use crate::stats::seed;
    use glam::{DVec3, dvec3};

    /// A sound hash gives two cells one value now and then, and where every cell is left that is all that does not change.
    #[test]
    fn two_cells_may_have_one_value() {
        let expected = |n: f64| Changes { mean: n, ..Changes::default() };
        for n in [1.0e4, 1.0e6] {
            // One in 4000, as of the sine hash in f32, and one in 500.
            let [of_sine, of_few] =
                [4000.0, 500.0].map(|values| expected(n).compared((n - n / values) as u64).p);
            assert!(of_sine > 0.1, "{n}: {of_sine}");
            assert!(n < 1.0e5 || of_few < 1.0e-9, "{n}: {of_few}");
        }
    }

    /// Points on one line share the few intervals of an axis. Over many keys the number of changes varies as predicted, and
    /// more than it would for points that share nothing.
    #[test]
    fn shared_choices_are_in_the_variance() {
        let (keys, points) = (400_u64, 512);
        let mut rng = seed::rng("stability.shared_choices", 0);
        // Halfway between two octaves, as Listing 2 counts them.
        let derivative = 1.0 / 64.0;
        let motion = DVec3::X * derivative;
        let (mut squares, mut mean, mut variance, mut alone) = (0.0, 0.0, 0.0, 0.0);
        for key in 0..keys {
            let subject = ideal(key, Variant::Anisotropic, Precision::F64, Join::Dithered);
            let before: Vec<Fragment> = (0..points)
                .map(|_| {
                    let [x, y, z] = [(); 3].map(|()| seed::uniform01(&mut rng));
                    let position = dvec3(x, 100.0 * y, 100.0 * z);
                    Footprint { position, dpdx: DVec3::splat(derivative), dpdy: DVec3::ZERO }.into()
                })
                .collect();
            let after: Vec<Fragment> = before
                .iter()
                .map(|Fragment { footprint, .. }| {
                    Footprint { position: footprint.position + motion, ..*footprint }.into()
                })
                .collect();
            let mut expected = Changes::default();
            before.iter().for_each(|fragment| expected.add(&subject, &fragment.footprint, motion));
            let [old, new] = [before, after].map(|fragments| subject.thresholds(&fragments));
            let changed = old.iter().zip(&new).filter(|(a, b)| a != b).count() as f64;
            mean += (changed - expected.mean) / keys as f64;
            squares += (changed - expected.mean).powi(2) / keys as f64;
            variance += expected.variance() / keys as f64;
            alone += expected.alone / keys as f64;
        }
        // Five standard deviations of a mean, and of a variance, over so many keys.
        let tolerance = 5.0 / (keys as f64).sqrt();
        assert!(mean.abs() < tolerance * variance.sqrt(), "{mean} changes too many, variance {variance}");
        let ratio = squares / variance;
        assert!(
            (ratio - 1.0).abs() < tolerance * core::f64::consts::SQRT_2,
            "{ratio} of the variance {variance}"
        );
        assert!(squares > 2.0 * alone, "{squares} for {alone}");
    }
}
