//! Thresholds of a fixed point from view to view: how often they jump.

use crate::check::predict::{largest_change, log_scale};
use crate::check::shrink::describe_pair;
use crate::check::trial::detectable_share;
use crate::check::{Conclusion, Evidence, Subject, Trial};
use crate::scene::Fragment;
use crate::threshold::robust::Join;
use crate::threshold::two_scale::Variant;

/// Changes that are too large, or too many.
#[derive(Default)]
pub(crate) struct Pops {
    count: u64,
    /// Steps between two views.
    pub steps: u64,
    sum: f64,
    largest: f64,
    first: String,
}

impl Pops {
    /// Follows a point along views between which every scale only grows or only shrinks: a continuous join does not jump, the dithered
    /// one switches once an octave and axis.
    pub fn add_path<F: Copy + Into<Fragment>>(
        &mut self,
        subject: &Subject<'_>,
        views: &[F],
        thresholds: &[f64],
    ) {
        match subject.join {
            Join::Dithered => self.add_switches(subject, views, thresholds),
            Join::Interpolate | Join::Copula => self.add_jumps(subject, views, thresholds),
        }
    }

    /// Counts the steps between views that change the threshold by more than the join allows.
    pub fn add_jumps<F: Copy + Into<Fragment>>(
        &mut self,
        subject: &Subject<'_>,
        views: &[F],
        thresholds: &[f64],
    ) {
        self.steps += views.len() as u64 - 1;
        let nominal = |view: F| subject.nominal(&view.into().footprint);
        let mut before = nominal(views[0]);
        for step in 1..views.len() {
            let after = nominal(views[step]);
            let jump = (thresholds[step] - thresholds[step - 1]).abs();
            if jump > largest_change(subject, &before, &after) {
                let pair = [views[step - 1], views[step]].map(Into::into);
                self.add(jump, || {
                    describe_pair(subject, &pair, |pair, [old, new]| {
                        let [before, after] = pair.map(|view| subject.nominal(&view.footprint));
                        (new - old).abs() > largest_change(subject, &before, &after)
                    })
                });
            }
            before = after;
        }
    }

    /// Counts the switches beyond one an octave and axis.
    fn add_switches<F: Copy + Into<Fragment>>(
        &mut self,
        subject: &Subject<'_>,
        views: &[F],
        thresholds: &[f64],
    ) {
        self.steps += views.len() as u64 - 1;
        let (Some(&first), Some(&last)) = (views.first(), views.last()) else { return };
        let ends = [first, last].map(|view| log_scale(&subject.nominal(&view.into().footprint)));
        let axes = if subject.variant == Variant::Anisotropic { 3 } else { 1 };
        let mut octaves: f64 =
            (0..axes).map(|axis| (ends[1][axis].floor() - ends[0][axis].floor()).abs() + 1.0).sum();
        for step in 1..views.len() {
            let jump = (thresholds[step] - thresholds[step - 1]).abs();
            if jump > 0.0 {
                octaves -= 1.0;
                if octaves < 0.0 {
                    let pair = [views[step - 1], views[step]].map(Into::into);
                    self.add(jump, || describe_pair(subject, &pair, |_, [old, new]| old != new));
                }
            }
        }
    }

    fn add(&mut self, jump: f64, place: impl Fn() -> String) {
        if self.count == 0 {
            self.first = place();
        }
        self.count += 1;
        self.sum += jump;
        self.largest = self.largest.max(jump);
    }

    /// A trial of views of so many motions.
    pub fn into_trial(self, motions: f64, effect_name: &'static str) -> Trial {
        let rate = self.count as f64 / motions;
        Trial {
            conclusion: Conclusion::Exact { holds: self.count == 0 },
            statistic: Some(self.count as f64),
            statistic_name: "pops".into(),
            n: self.steps,
            effect: Some(rate),
            effect_name,
            detectable: Some(detectable_share(motions)),
            seen: format!(
                "{rate:.3} {effect_name}, by {:.3} in the mean and {:.3} at most; as in {}",
                self.sum / self.count as f64,
                self.largest,
                self.first
            ),
            evidence: Evidence::None,
        }
    }
}
