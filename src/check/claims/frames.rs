//! Thresholds over the frames of one point, and over the frames of one pixel.

use crate::check::evidence::ComparedShare;
use crate::check::input::everywhere::any_frame;
use crate::check::input::{fragments_everywhere, general_scenes, placement, sighting};
use crate::check::judge::{detectable_error, equality};
use crate::check::predict::PairLaw;
use crate::check::shrink::{at, shrunk};
use crate::check::tolerance::{ALPHAS, WIDE};
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Frames, Promise, Subject, Trial, Verdict};
use crate::scene::Fragment;
use crate::stats::normal;
use std::collections::HashMap;

/// Frames at which all points of a static threshold are asked: neighbours, powers of two, the last one; or as many periods.
const FRAMES: [u32; 6] = [0, 1, 2, 7, 1024, u32::MAX];

/// Frames that follow each other from the first one, and as many at random, at which some of the points are asked.
const MORE_FRAMES: u32 = 64;

/// One point in so many of those.
const FEWER_POINTS: usize = 16;

/// Frames of any size from which a period is followed.
const MORE_STARTS: usize = 14;

/// What roundings of `f32` leave between two thresholds of one point in different strata: the sum, the part after the
/// point and the clamp at 2^-24.
const STRATUM_ROUNDING: f64 = 1.0 / 4_194_304.0;

/// Points whose steps through a sequence are compared.
const SEQUENCE_POINTS: usize = 1 << 10;

/// Frames from the first one on over which a sequence is followed.
const SEQUENCE_FRAMES: u32 = 256;

/// What roundings leave between the steps of two points: a sum of the threshold and a multiple of a frame below 256, both in
/// `f32`.
const SEQUENCE_ROUNDING: f64 = 1.0 / 32_768.0;

/// The widest gap that a sequence may leave, in mean distances: what the golden ratio and reversed digits stay below.
const WIDEST_GAP: f64 = 2.0;

/// Pixels by which the image moves in a frame or period where the noise of one pixel is followed.
const DRIFT: f64 = 0.15;

/// Frames or periods between two thresholds of one pixel: within the fine cell, across it, and beyond the coarse one.
const FRAME_LAGS: [u32; 4] = [1, 2, 5, 16];

/// Points at each lag and of each exponential average: a correlation of 0.05 shows.
const FRAME_POINTS: usize = 1 << 15;

/// Weight of the newest frame in an exponential average: that of common temporal antialiasing.
const NEWEST: f64 = 0.1;

/// A threshold knows of the frame where it stands among those over which it spreads, and a static one nothing.
pub const STATIC: Claim = Claim {
    id: "frames.static",
    anchor: "§5 (stable over time), §7.2.3",
    statement: "the threshold of a point is the same in every frame, bit for bit; one that spreads over n frames has the same \
                again n frames later",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(8.0e-3)),
    run: unchanging,
};

/// A threshold that spreads over n frames takes each stratum once.
pub const STRATIFIED: Claim = Claim {
    id: "frames.stratified",
    anchor: "§7.2.3, Eq. 6",
    statement: "in any n frames that follow each other, the thresholds of a point are chi + j / n modulo 1 for j = 0 to \
                n - 1, in whatever order",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(8.0e-3)),
    run: stratified,
};

/// A threshold that goes through a sequence takes the same steps everywhere, and they fill the interval.
pub const SEQUENCE: Claim = Claim {
    id: "frames.sequence",
    anchor: "not in the paper",
    statement: "where thresholds go through a sequence of frames, all points take the same step, modulo 1, from the first frame to \
                any other; and 8, 16, 32 and 64 frames that follow each other leave no gap of more than twice their mean distance",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(8.0e-3)),
    run: sequence,
};

/// What a pixel shows while the surface moves under it.
pub const SERIAL: Claim = Claim {
    id: "frames.serial",
    anchor: "§5 (sub-pixel translations); closed form not in the paper",
    statement: "while a surface moves by 0.15 pixels a frame, or in the n frames over which thresholds spread, the thresholds \
                of one pixel are correlated from one time to the next as the size of the cells predicts",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.15)),
    run: serial,
};

/// What temporal antialiasing makes of the strata.
pub const AVERAGE: Claim = Claim {
    id: "frames.average",
    anchor: "§7.2.3, Eq. 6 (temporal antialiasing); closed form not in the paper",
    statement: "the exponential average over frames of whether a fragment of one alpha is kept has the variance of its \
                strata, and no more than that of independent frames",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.02)),
    run: average,
};

/// The end of a claim about strata where there are none.
fn no_strata() -> Attempt<Trial> {
    let reason = "the subject does not claim to spread its thresholds over frames";
    Ok(Trial::without(Conclusion::NotApplicable, reason))
}

/// The thresholds of points in one frame.
fn in_frame(subject: &Subject<'_>, points: &[Fragment], frame: u32) -> Vec<f64> {
    subject.thresholds(&points.iter().map(|point| Fragment { frame, ..*point }).collect::<Vec<_>>())
}

fn unchanging(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let points = fragments_everywhere(subject, draw, STATIC.id);
    if subject.frames == Frames::Sequence {
        let reason = "the subject claims to go through a sequence of frames";
        return Ok(Trial::without(Conclusion::NotApplicable, reason));
    }
    let whole = |frame: u32| subject.frames.period_start(frame);
    let in_frames = |points: &[Fragment], frames: &[u32]| {
        frames.iter().map(|&frame| in_frame(subject, points, frame)).collect::<Vec<_>>()
    };
    let tried = |points: &[Fragment], frames: &[u32]| {
        equality(
            subject,
            points,
            &in_frames(points, frames),
            |_, points| in_frames(points, frames),
            "in another frame",
        )
    };
    let mut rng = draw.rng("frames.static, more frames");
    let any = (0..MORE_FRAMES).map(|_| subject.frames.first_again(any_frame(&mut rng)));
    let more: Vec<u32> = (0..MORE_FRAMES).map(whole).chain(any).collect();
    let some: Vec<Fragment> = points.iter().copied().step_by(FEWER_POINTS).collect();
    let (of_all, of_some) = (tried(&points, &FRAMES.map(whole)), tried(&some, &more));
    let holds = |trial: &Trial| trial.conclusion == Conclusion::Exact { holds: true };
    Ok(if holds(&of_all) && !holds(&of_some) { of_some } else { of_all })
}

/// Thresholds of points in general position over `n` frames from one on: frame by frame.
fn over(subject: &Subject<'_>, points: &[Fragment], from: u32, n: u32) -> Attempt<Vec<Vec<f64>>> {
    let frames = (from..from + n).map(|frame| {
        let values = in_frame(subject, points, frame);
        reject_outsiders(subject, points, &values).map(|()| values)
    });
    frames.collect()
}

fn general_points(subject: &Subject<'_>, n: usize, draw: &Draw, claim: &str) -> Vec<Fragment> {
    let mut rng = draw.rng(claim);
    let scenes = general_scenes();
    let point = |index: usize| {
        let place = placement(&mut rng);
        sighting(&scenes[index % scenes.len()], &mut rng).placed(place, subject.precision).fragment
    };
    (0..n).map(point).collect()
}

fn stratified(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let Frames::Strata(n) = subject.frames else { return no_strata() };
    let n = n.get();
    let points = general_points(subject, draw.samples(FRAME_POINTS / 8), draw, STRATIFIED.id);
    let stratum = 1.0 / f64::from(n);
    let (mut bad, mut largest, mut first) = (0_u64, 0.0_f64, None);
    // From the first frame on, from one in the middle of a period, and from any.
    let mut rng = draw.rng("frames.stratified, more frames");
    let mut starts = vec![0, 4 * n + n / 2];
    starts.extend((0..MORE_STARTS).map(|_| any_frame(&mut rng).min(u32::MAX - n)));
    let parts = points.chunks(points.len().div_ceil(starts.len()));
    let errors = |points: &[Fragment], from: u32| -> Attempt<Vec<f64>> {
        let frames = over(subject, points, from, n)?;
        let error = |at: usize| {
            let mut values: Vec<f64> = frames.iter().map(|frame| frame[at]).collect();
            values.sort_unstable_by(f64::total_cmp);
            // Around the circle, the last next to the first.
            let around = values[0] + 1.0 - values[values.len() - 1];
            let gaps = values.windows(2).map(|pair| pair[1] - pair[0]).chain([around]);
            gaps.map(|gap| (gap - stratum).abs()).fold(0.0, f64::max)
        };
        Ok((0..points.len()).map(error).collect())
    };
    for (points, from) in parts.zip(starts) {
        for (point, error) in points.iter().zip(errors(points, from)?) {
            largest = largest.max(error);
            if error > STRATUM_ROUNDING {
                bad += 1;
                first.get_or_insert((*point, from));
            }
        }
    }
    let first = first.map_or(String::new(), |(point, from)| {
        let [shown] = shrunk(subject, &[point], |candidates| {
            let candidates = candidates.as_flattened();
            let found = errors(candidates, from).unwrap_or_else(|_| vec![0.0; candidates.len()]);
            found.into_iter().map(|error| error > STRATUM_ROUNDING).collect()
        });
        let shown = Fragment { frame: from, ..shown };
        format!("; as in {}, in the {n} frames from there on", at(subject, &shown))
    });
    let seen = format!(
        "{:.2} % of points do not take each stratum once{first}",
        100.0 * bad as f64 / points.len() as f64
    );
    let name = "largest error of a distance between neighbouring strata";
    let counted =
        Trial::counted(bad, points.len() as u64, name, "share of points without every stratum", seen);
    Ok(Trial { statistic: Some(largest), ..counted })
}

/// The largest gap between `n` frames that follow each other, times `n`: 1 for strata, 1.9 at most for the golden ratio, below 2 for
/// numbers with their digits turned around, some 4 for values drawn at random. And the first of the frames.
fn widest_gap(steps: &[f64], n: usize) -> (f64, usize) {
    let gap = |from: usize| {
        let mut values = steps[from..from + n].to_vec();
        values.sort_unstable_by(f64::total_cmp);
        let around = values[0] + 1.0 - values[n - 1];
        values.windows(2).map(|pair| pair[1] - pair[0]).fold(around, f64::max) * n as f64
    };
    (0..steps.len() / n)
        .map(|window| (gap(window * n), window * n))
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap_or((0.0, 0))
}

fn sequence(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    if subject.frames != Frames::Sequence {
        return Ok(Trial::without(
            Conclusion::NotApplicable,
            "the subject does not claim to go through a sequence of frames",
        ));
    }
    let points = general_points(subject, draw.samples(SEQUENCE_POINTS), draw, SEQUENCE.id);
    let mut rng = draw.rng("frames.sequence, frames");
    let any = (0..MORE_FRAMES).map(|_| any_frame(&mut rng));
    let frames: Vec<u32> = (0..SEQUENCE_FRAMES).chain(any).collect();
    let first = in_frame(subject, &points, 0);
    reject_outsiders(subject, &points, &first)?;
    let (mut steps, mut bad, mut largest, mut worst_frame) = (Vec::new(), 0, 0.0_f64, None);
    for &frame in &frames {
        let values = in_frame(subject, &points, frame);
        reject_outsiders(subject, &points, &values)?;
        let step = |(value, first): (&f64, &f64)| (value - first).rem_euclid(1.0);
        let found: Vec<f64> = values.iter().zip(&first).map(step).collect();
        let common = common_step(&found);
        let strays = |step: &&f64| {
            let from = (*step - common).rem_euclid(1.0);
            from.min(1.0 - from) > SEQUENCE_ROUNDING
        };
        let strays = found.iter().filter(strays).count() as u64;
        if strays > 0 {
            worst_frame.get_or_insert(frame);
        }
        bad += strays;
        steps.push(common);
    }
    let consecutive = &steps[..SEQUENCE_FRAMES as usize];
    let mut uneven = None;
    for n in [8, 16, 32, 64] {
        let (gap, from) = widest_gap(consecutive, n);
        largest = largest.max(gap);
        if gap > WIDEST_GAP {
            uneven.get_or_insert(format!(
                "; {n} frames from frame {from} on leave a gap of {gap:.2} mean distances"
            ));
        }
    }
    let n = points.len() as u64 * frames.len() as u64;
    let stray = worst_frame.map_or(String::new(), |frame| format!(", first in frame {frame}"));
    let seen = format!(
        "{:.2} % of steps from the first frame are not those of the other points{stray}{}",
        100.0 * bad as f64 / n as f64,
        uneven.as_deref().unwrap_or_default()
    );
    // Steps that do not fill the interval are those of every point.
    let bad = if uneven.is_some() { n } else { bad };
    let counted =
        Trial::counted(bad, n, "largest gap, in mean distances", "share of steps that are wrong", seen);
    Ok(Trial { statistic: Some(largest), ..counted })
}

/// The step around which the steps of points lie closest, modulo 1: that of the point with the most others within rounding.
fn common_step(steps: &[f64]) -> f64 {
    let mut sorted = steps.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let near = |at: usize| {
        let (low, high) = (sorted[at] - SEQUENCE_ROUNDING, sorted[at] + SEQUENCE_ROUNDING);
        sorted.partition_point(|&step| step <= high) - sorted.partition_point(|&step| step < low)
    };
    (0..sorted.len()).max_by_key(|&at| near(at)).map_or(0.0, |at| sorted[at])
}

/// A mean that was measured: its expectation, and the standard deviation of the mean.
struct Mean {
    name: String,
    x: f64,
    measured: f64,
    predicted: f64,
    sigma: f64,
}

impl Mean {
    /// The mean of values beside the mean of what each was expected to be.
    fn of(name: String, x: f64, values: impl Iterator<Item = (f64, f64)>) -> Self {
        let (mut n, mut measured, mut predicted, mut squares) = (0.0, 0.0, 0.0, 0.0);
        for (value, expected) in values {
            n += 1.0;
            measured += value;
            predicted += expected;
            squares += (value - expected) * (value - expected);
        }
        Self { name, x, measured: measured / n, predicted: predicted / n, sigma: squares.sqrt() / n }
    }

    fn z(&self) -> f64 {
        let difference = self.measured - self.predicted;
        if difference == 0.0 { 0.0 } else { difference / self.sigma }
    }
}

/// A trial that rests on the worst of several means.
fn worst_mean(means: &[Mean], n: usize, effect_name: &'static str, axes: [&'static str; 2]) -> Trial {
    let Some(worst) = means.iter().max_by(|a, b| a.z().abs().total_cmp(&b.z().abs())) else {
        return Trial::without(Conclusion::Inconclusive, "nothing was measured");
    };
    let points: Vec<ComparedShare> = means
        .iter()
        .map(|mean| ComparedShare {
            series: mean.name.clone(),
            x: mean.x,
            measured: mean.measured,
            predicted: mean.predicted,
            sigma: mean.sigma,
        })
        .collect();
    let effect = means.iter().map(|mean| (mean.measured - mean.predicted).abs()).fold(0.0, f64::max);
    Trial {
        conclusion: Conclusion::Probability((means.len() as f64 * normal::two_sided_p(worst.z())).min(1.0)),
        statistic: Some(worst.z()),
        statistic_name: format!("z, worst of {}", means.len()),
        n: n as u64,
        effect: Some(effect),
        effect_name,
        detectable: detectable_error(&points),
        seen: format!(
            "{} at {}: {:.5}, {:.5} is predicted",
            worst.name, worst.x, worst.measured, worst.predicted
        ),
        evidence: Evidence::Quantity { abscissa: axes[0], ordinate: axes[1], points },
    }
}

fn serial(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(SERIAL.id);
    let n = draw.samples(FRAME_POINTS);
    let mut means = Vec::new();
    for scene in general_scenes() {
        for lag in FRAME_LAGS {
            let (mut before, mut after, mut expected) = (Vec::new(), Vec::new(), Vec::new());
            for _ in 0..n {
                let place = placement(&mut rng) * WIDE;
                let here = sighting(&scene, &mut rng).placed(place, subject.precision);
                let motion = here.fragment.footprint.dpdx * (f64::from(lag) * DRIFT);
                let pair = PairLaw::new(subject, &subject.nominal(&here.fragment.footprint), motion);
                expected.push(pair.correlation());
                // The same pixel, where another point of the surface has come.
                let there = here.moved(motion, subject.precision).fragment;
                before.push(here.fragment);
                after.push(Fragment {
                    pixel: here.fragment.pixel,
                    frame: subject.frames.period_start(lag),
                    ..there
                });
            }
            let (old, new) = (subject.thresholds(&before), subject.thresholds(&after));
            reject_outsiders(subject, &before, &old)?;
            reject_outsiders(subject, &after, &new)?;
            // A uniform value has a variance of 1/12.
            let products = old.iter().zip(&new).map(|(a, b)| 12.0 * (a - 0.5) * (b - 0.5));
            let name = scene.name.to_owned();
            means.push(Mean::of(name, f64::from(lag), products.zip(expected)));
        }
    }
    let axes = ["frames", "correlation"];
    Ok(worst_mean(&means, means.len() * n, "error in the correlation", axes))
}

/// Weights of an exponential average over frames that repeat with a period, the newest frame last; they add up to 1.
fn exponential_weights(period: u32) -> Vec<f64> {
    let powers: Vec<f64> = (0..period).rev().map(|age| libm::pow(1.0 - NEWEST, f64::from(age))).collect();
    let sum: f64 = powers.iter().sum();
    powers.iter().map(|power| power / sum).collect()
}

/// The average of whether thresholds keep a fragment.
fn kept(thresholds: impl Iterator<Item = f64>, weights: &[f64], alpha: f64) -> f64 {
    thresholds.zip(weights).filter(|(threshold, _)| *threshold <= alpha).map(|(_, weight)| weight).sum()
}

/// Variance of the average for strata that are visited in one order, over a uniform chi: which frames keep a fragment is
/// constant between the places where one of them passes alpha.
fn variance(order: &[u32], weights: &[f64], alpha: f64) -> f64 {
    let around = |place: f64| place - place.floor();
    let offsets = || order.iter().map(|&stratum| f64::from(stratum) / order.len() as f64);
    let mut places: Vec<f64> =
        offsets().flat_map(|offset| [around(-offset), around(alpha - offset)]).chain([0.0, 1.0]).collect();
    places.sort_unstable_by(f64::total_cmp);
    let within = |pair: &[f64]| {
        let chi = pair[0].midpoint(pair[1]);
        let error = kept(offsets().map(|offset| around(chi + offset)), weights, alpha) - alpha;
        (pair[1] - pair[0]) * error * error
    };
    places.windows(2).map(within).sum()
}

fn average(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let Frames::Strata(strata) = subject.frames else { return no_strata() };
    let strata = strata.get();
    let n = draw.samples(FRAME_POINTS);
    let points = general_points(subject, n, draw, AVERAGE.id);
    let frames = over(subject, &points, 0, strata)?;
    let weights = exponential_weights(strata);
    // The strata of the frames, counted from that of the first.
    let strata = f64::from(strata);
    let order = |at: usize| -> Vec<u32> {
        let stratum = |frame: &Vec<f64>| ((frame[at] - frames[0][at]) * strata).round().rem_euclid(strata);
        frames.iter().map(|frame| stratum(frame) as u32).collect()
    };
    let of_independent: f64 = weights.iter().map(|weight| weight * weight).sum();
    let (mut means, mut exceeds) = (Vec::new(), None);
    for alpha in ALPHAS {
        let mut known: HashMap<Vec<u32>, f64> = HashMap::new();
        let bound = alpha * (1.0 - alpha) * of_independent;
        let pairs = (0..points.len()).map(|at| {
            let error = kept(frames.iter().map(|frame| frame[at]), &weights, alpha) - alpha;
            let order = order(at);
            let expected = match known.get(&order) {
                Some(&expected) => expected,
                None => {
                    let expected = variance(&order, &weights, alpha);
                    if expected > bound {
                        exceeds = Some(format!(
                            "strata in the order {order:?} have a variance of {expected:.5} at an alpha of {alpha}, \
                             more than the {bound:.5} of independent frames"
                        ));
                    }
                    known.insert(order, expected);
                    expected
                }
            };
            (error * error, expected)
        });
        means.push(Mean::of("average over frames".into(), alpha, pairs));
    }
    let axes = ["alpha", "variance of the average"];
    let trial = worst_mean(&means, n, "error in the variance", axes);
    Ok(match exceeds {
        Some(seen) => Trial { conclusion: Conclusion::Exact { holds: false }, seen, ..trial },
        None => trial,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_weights_leave_the_variance_of_one_stratum() {
        for (order, alpha) in [([0, 2, 1, 3], 0.3), ([3, 2, 1, 0], 0.5), ([0, 1, 2, 3], 0.9)] {
            let part = 4.0 * alpha - f64::floor(4.0 * alpha);
            let found = variance(&order, &[0.25; 4], alpha);
            assert!((found - part * (1.0 - part) / 16.0).abs() < 1e-12, "{order:?} {alpha}: {found}");
        }
    }

    #[test]
    fn a_single_stratum_has_the_variance_of_one_frame() {
        assert!((variance(&[0], &[1.0], 0.3) - 0.21).abs() < 1e-12);
        let weights = exponential_weights(8);
        assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12 && weights[7] > weights[0]);
    }
}
