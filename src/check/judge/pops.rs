//! Thresholds of a fixed point from view to view: how often they jump.

use crate::check::judge::Resolution;
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
    jumps: Vec<Jump>,
    /// Where the jump is that goes furthest beyond what is allowed.
    clearest: Option<(f64, [Fragment; 2])>,
    values: Resolution,
    /// Steps between two views.
    pub steps: u64,
}

/// A change that is larger than the join allows.
struct Jump {
    values: [f64; 2],
    /// By how much it goes beyond; infinite where no change was allowed at all.
    excess: f64,
}

impl Pops {
    /// Follows a point along views between which every scale only grows or only shrinks: a continuous join does not jump, one
    /// that takes one of two octaves switches once an octave and axis.
    pub fn add_path(&mut self, subject: &Subject<'_>, views: &[Fragment], thresholds: &[f64]) {
        match subject.join {
            Join::Dithered | Join::Inherit => self.add_switches(subject, views, thresholds),
            Join::Interpolate | Join::Copula => self.add_jumps(subject, views, thresholds),
        }
    }

    /// Notes the steps between views that change the threshold by more than the join allows.
    pub fn add_jumps(&mut self, subject: &Subject<'_>, views: &[Fragment], thresholds: &[f64]) {
        self.steps += views.len() as u64 - 1;
        self.values.extend(thresholds);
        let mut before = subject.nominal(&views[0].footprint);
        for step in 1..views.len() {
            let after = subject.nominal(&views[step].footprint);
            let values = [thresholds[step - 1], thresholds[step]];
            let excess = (values[1] - values[0]).abs() - largest_change(subject, &before, &after);
            if excess > 0.0 {
                self.add(Jump { values, excess }, [views[step - 1], views[step]]);
            }
            before = after;
        }
    }

    /// Notes the switches beyond one an octave and axis.
    fn add_switches(&mut self, subject: &Subject<'_>, views: &[Fragment], thresholds: &[f64]) {
        self.steps += views.len() as u64 - 1;
        let (Some(first), Some(last)) = (views.first(), views.last()) else { return };
        let ends = [first, last].map(|view| log_scale(&subject.nominal(&view.footprint)));
        let axes = if subject.variant == Variant::Anisotropic { 3 } else { 1 };
        let mut octaves: f64 =
            (0..axes).map(|axis| (ends[1][axis].floor() - ends[0][axis].floor()).abs() + 1.0).sum();
        for step in 1..views.len() {
            let values = [thresholds[step - 1], thresholds[step]];
            if values[0] != values[1] {
                octaves -= 1.0;
                if octaves < 0.0 {
                    let jump = Jump { values, excess: f64::INFINITY };
                    self.add(jump, [views[step - 1], views[step]]);
                }
            }
        }
    }

    fn add(&mut self, jump: Jump, views: [Fragment; 2]) {
        if self.clearest.as_ref().is_none_or(|(excess, _)| jump.excess > *excess) {
            self.clearest = Some((jump.excess, views));
        }
        self.jumps.push(jump);
    }

    /// A trial of views of so many motions. Jumps by no more than a step of the subject's own values are none.
    pub fn into_trial(self, subject: &Subject<'_>, motions: f64, effect_name: &'static str) -> Trial {
        let step = self.values.steps();
        let is_pop = |jump: &&Jump| jump.excess > step(jump.values);
        let pops = || self.jumps.iter().filter(is_pop);
        let sizes = || pops().map(|Jump { values: [old, new], .. }| (new - old).abs());
        let count = pops().count() as u64;
        let rate = count as f64 / motions;
        let example = self.clearest.filter(|_| count > 0).map_or_else(String::new, |(excess, pair)| {
            let shown = describe_pair(subject, &pair, |pair, values| {
                if excess.is_infinite() {
                    return values[0] != values[1];
                }
                let [before, after] = pair.map(|view| subject.nominal(&view.footprint));
                (values[1] - values[0]).abs() > largest_change(subject, &before, &after) + step(values)
            });
            format!("; as in {shown}")
        });
        Trial {
            conclusion: Conclusion::Exact { holds: count == 0 },
            statistic: Some(count as f64),
            statistic_name: "pops".into(),
            n: self.steps,
            effect: Some(rate),
            effect_name,
            detectable: Some(detectable_share(motions)),
            seen: format!(
                "{rate:.3} {effect_name}, by {:.3} in the mean and {:.3} at most{example}",
                sizes().sum::<f64>() / count as f64,
                sizes().fold(0.0, f64::max),
            ),
            evidence: Evidence::None,
        }
    }
}
