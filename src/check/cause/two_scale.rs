//! Which way from derivatives to a scale, which join, which correction and which last step a threshold has: the one under which
//! its values follow from what it shows of single cells.

use super::cells::Faces;
use super::join::{CASES, CORRECTIONS, Correction, FORMS, Form, Sight, WEIGHTLESS, case_of};
use super::law::{Bend, Law, Undone, follows, laws, nearest, unique};
use super::measure::Measure;
use super::probe::{ALONE, Probe, SAME, places};
use super::slip::{Found, Slip, found, named};
use crate::check::Subject;
use crate::scene::Fragment;
use crate::stats::seed;
use crate::threshold::footprint::Footprint;
use crate::threshold::robust::scales::corner_weight;
use crate::threshold::two_scale::Variant;
use glam::{DVec3, dvec3};
use rand::rngs::Xoshiro256PlusPlus;

/// Places at which a way is tried.
const PLACES: usize = 384;

/// A threshold has come out where it is no further than this from what follows.
const NEAR: f64 = 0.012;

/// The share of places at which it comes out, under the way that a threshold has: the rest lies at an octave, or on a face.
const EXPLAINED: f64 = 0.9;

/// The share at which no other way is sought.
const SURE: f64 = 0.97;

/// A way with one more slip has to explain so much more.
const MORE: f64 = 0.03;

/// The most slips that are told at once.
const MOST_SLIPS: usize = 2;

/// Cells whose law is looked at.
const CELLS: usize = 4096;

/// Different thresholds at as many places, up to which they come in steps.
const FEW: usize = CELLS / 8;

/// One way, and how much it explains.
pub(super) struct Explained {
    pub measure: Measure,
    form: Form,
    correction: Correction,
    law: Law,
    /// Share of places, in [0, 1].
    share: f64,
    /// The same of the sound way.
    sound: f64,
    count: usize,
    /// Whether single cells are uniform.
    is_uniform: bool,
    /// The case of Eq. 2 that alone is wrong, with what shows it.
    case: Option<Found>,
}

/// What is seen of some places under one way to a scale.
struct Seen {
    sights: Vec<(Sight, f64)>,
    laws: Vec<Law>,
}

/// Cells around the origin, one place in each.
pub(super) fn any_cells(count: usize, rng: &mut Xoshiro256PlusPlus) -> Vec<DVec3> {
    let mut index = || ((seed::uniform01(rng) - 0.5) * 2000.0).floor() + 0.45;
    (0..count).map(|_| dvec3(index(), index(), index())).collect()
}

/// A way in which a pixel is measured.
pub(super) struct Measured {
    pub measure: Measure,
    /// The share of places that have one threshold with another view of one scale, in this way and in the sound one.
    shares: [f64; 2],
}

impl Measured {
    /// What is wrong with it.
    pub fn found(&self, subject: &Subject<'_>) -> Vec<Found> {
        const OTHER: Slip = named("other-variant");
        let [own, sound] = self.shares.map(|share| 100.0 * share);
        let shown = format!(
            "two views of a point at one scale have one threshold at {own:.0} % of {PLACES} points if measured so, at {sound:.0} % as \
             the listing does"
        );
        let variant = self.measure.variant;
        let other =
            (variant != subject.variant).then(|| found(OTHER, format!("{shown}; they are {variant}")));
        other.into_iter().chain(self.measure.slips().map(|slip| found(slip, shown.clone()))).collect()
    }
}

/// Finds the way in which a pixel is measured: the one under which any two views of one scale have one threshold, whatever the
/// hash and the join; the sound one where it is.
pub(super) fn measured(
    subject: &Subject<'_>,
    places: &[Fragment],
    among: Option<&[&str]>,
) -> Option<Measured> {
    let before = subject.thresholds(places);
    let share = |measure: &Measure| {
        let probe = Probe { subject, measure: *measure, finer: 0, lean: ALONE };
        let view = |fragment: &Fragment| {
            let log = measure.log_scale(fragment.footprint.dpdx, fragment.footprint.dpdy);
            probe.seen_at(fragment, log)
        };
        let views: Option<Vec<Fragment>> = places.iter().map(view).collect();
        let Some(views) = views else { return 0.0 };
        let after = subject.thresholds(&views);
        let same = before.iter().zip(&after).filter(|(a, b)| (*a - *b).abs() < SAME).count();
        same as f64 / places.len() as f64
    };
    let other =
        if subject.variant == Variant::Anisotropic { Variant::Isotropic } else { Variant::Anisotropic };
    let mut sound = None;
    let mut best: Option<Measured> = None;
    for variant in [subject.variant, other] {
        for measure in Measure::sizes(variant, subject.hash_scale).filter(|measure| measure.is_among(among)) {
            let share = share(&measure);
            let sound = *sound.get_or_insert(share);
            if share >= EXPLAINED && best.as_ref().is_none_or(|best| share > best.shares[0] + MORE) {
                best = Some(Measured { measure, shares: [share, sound] });
            }
        }
    }
    best
}

fn see(
    subject: &Subject<'_>,
    measure: Measure,
    places: &[Fragment],
    rng: &mut Xoshiro256PlusPlus,
) -> Option<Seen> {
    let probe = Probe { subject, measure, finer: 0, lean: ALONE };
    let mut asked = Vec::with_capacity(places.len() * 5);
    let mut places_of = Vec::with_capacity(places.len());
    for fragment in places {
        let log = measure.log_scale(fragment.footprint.dpdx, fragment.footprint.dpdy);
        let (octave, fraction) = (log.floor(), log - log.floor());
        let weight_of = |fraction: DVec3| match measure.variant {
            Variant::Anisotropic => corner_weight(fraction.to_array()),
            Variant::Isotropic | Variant::Linear | Variant::Single => fraction.x,
        };
        let scale = DVec3::from_array(log.to_array().map(libm::exp2));
        let weights = [weight_of(fraction), weight_of(scale - scale.floor())];
        let nearest = (log + 0.5).floor();
        let octaves = [octave - 1.0, octave, octave + 1.0, octave + 2.0, nearest, nearest + 1.0];
        let alone = octaves.map(|octave| {
            probe.alone(fragment, octave).map(|view| {
                asked.push(view);
                asked.len() - 1
            })
        });
        places_of.push((alone, asked.len(), weights));
        asked.push(*fragment);
    }
    let values = subject.thresholds(&asked);
    let sight = |(alone, own, [weight, of_scale]): ([Option<usize>; 6], usize, [f64; 2])| {
        let [below, coarse, fine, above, nearest, next] =
            alone.map(|at| at.map_or(f64::NAN, |at| values[at]));
        (
            Sight { alone: [below, coarse, fine, above], nearest: [nearest, next], weight, of_scale },
            values[own],
        )
    };
    let sights: Vec<(Sight, f64)> = places_of.into_iter().map(sight).collect();
    // Where octaves do not differ, everything follows from everything.
    let differ = sights.iter().filter(|(s, _)| (s.alone[1] - s.alone[2]).abs() >= NEAR).count();
    let single = probe.cells(&any_cells(CELLS, rng));
    (2 * differ >= places.len() && !single.iter().any(|value| value.is_nan()))
        .then(|| Seen { sights, laws: laws(&single) })
}

fn explained_share(
    seen: &Seen,
    form: &Form,
    correction: &Correction,
    bend: Bend,
    undone: Option<&Undone>,
    near: f64,
) -> f64 {
    let hash = |value: f64| {
        let straight = bend.straight(value);
        undone.map_or(straight, |undone| undone.value(straight))
    };
    let comes_out = |(sight, value): &&(Sight, f64)| {
        let sight = Sight { alone: sight.alone.map(hash), nearest: sight.nearest.map(hash), ..*sight };
        let (x, weight) = (form.of)(&sight);
        let bent = bend.bent((correction.of)(x, weight));
        // Some clamp, and some do not.
        (bent - value).abs() < near || (bent.clamp(0.0, 1.0) - value).abs() < near
    };
    seen.sights.iter().filter(comes_out).count() as f64 / seen.sights.len() as f64
}

/// Places at which ways are tried.
pub(super) fn some_places(subject: &Subject<'_>, rng: &mut Xoshiro256PlusPlus) -> Vec<Fragment> {
    let rounded =
        |fragment: Fragment| Fragment { footprint: subject.precision.round(&fragment.footprint), ..fragment };
    places(PLACES, subject.hash_scale, rng).into_iter().map(rounded).collect()
}

/// Looks for the way that explains a threshold with the fewest slips; none where none does.
pub(super) fn explain(
    subject: &Subject<'_>,
    size: Measure,
    places: &[Fragment],
    steps: Option<&Steps>,
    among: Option<&[&str]>,
    rng: &mut Xoshiro256PlusPlus,
) -> Option<Explained> {
    // Each of three thresholds may be half a step away.
    let near = steps.map_or(NEAR, |steps| (1.5 / steps.count as f64).max(NEAR));
    let scales = among;
    // Two hashes without a weight look like one hash with any correction.
    let among = among.filter(|names| !WEIGHTLESS.iter().any(|(slip, _)| names.contains(&slip.name)));
    let is_sought =
        |slip: Option<Slip>| among.is_none_or(|names| slip.is_some_and(|slip| names.contains(&slip.name)));
    let undone: Vec<Option<Undone>> =
        CORRECTIONS.iter().map(|c| is_sought(c.slip).then(|| Undone::of(c.of, ALONE)).flatten()).collect();
    let mut sound = None;
    let mut best: Option<Explained> = None;
    let mut first = None;
    for measure in size.with_scales().into_iter().filter(|measure| measure.is_among(scales)) {
        // What a way with as many slips explains is not explained better.
        if best.as_ref().is_some_and(|best| best.share >= SURE && best.count <= measure.slips().count()) {
            break;
        }
        let Some(seen) = see(subject, measure, places, rng) else { continue };
        let as_it_is = Law { slip: None, shown: String::new(), bend: Bend::Clamp([0.0, 1.0]) };
        if first.is_none() {
            first = Some((measure, by_case(&seen, near)));
        }
        let is_uniform = seen.laws.iter().any(|law| law.slip.is_none());
        let is_tried =
            |slip: Option<Slip>| slip.is_none_or(|slip| among.is_none_or(|names| names.contains(&slip.name)));
        // What shows one cell alone is told by its law.
        let is_among =
            |form: &&Form| among.is_none() || form.is_weightless || form.is_reversed || is_tried(form.slip);
        let bent = seen.laws.iter().filter(|law| law.slip.is_some() && is_tried(law.slip)).cloned();
        for law in core::iter::once(as_it_is).chain(bent) {
            for form in FORMS.iter().filter(|form| is_among(form)) {
                for (correction, undone) in CORRECTIONS.iter().zip(&undone) {
                    if !is_tried(correction.slip) {
                        continue;
                    }
                    let slips = [law.slip, form.slip, correction.slip].into_iter().flatten();
                    let count = measure.slips().count() + slips.count();
                    let is_sound = correction.slip.is_none();
                    if count > MOST_SLIPS || !is_sound && undone.is_none() {
                        continue;
                    }
                    let undone = undone.as_ref().filter(|_| !is_sound);
                    let share = explained_share(&seen, form, correction, law.bend, undone, near);
                    let sound = *sound.get_or_insert(share);
                    let is_better = best
                        .as_ref()
                        .is_none_or(|best| share > best.share + MORE * (count as f64 - best.count as f64));
                    let least = if count == 0 { EXPLAINED } else { SURE };
                    if share >= least && is_better {
                        best = Some(Explained {
                            measure,
                            form: *form,
                            correction: *correction,
                            law: law.clone(),
                            share,
                            sound,
                            count,
                            is_uniform,
                            case: None,
                        });
                    }
                }
            }
        }
    }
    // What more than one slip explains, one case alone explains better.
    let case = first.and_then(|(measure, case)| Some((measure, case?)));
    match case {
        Some((measure, case)) if best.as_ref().is_none_or(|best| best.count > 1) => Some(Explained {
            measure,
            form: FORMS[0],
            correction: CORRECTIONS[0],
            law: Law { slip: None, shown: String::new(), bend: Bend::Clamp([0.0, 1.0]) },
            share: EXPLAINED,
            sound: 0.0,
            count: 1,
            is_uniform: true,
            case: Some(case),
        }),
        Some(_) | None => best,
    }
}

/// The case of Eq. 2 at whose values thresholds do not come out, where they do at those of the other two.
fn by_case(seen: &Seen, near: f64) -> Option<Found> {
    /// The share that comes out of a case that is wrong, at most: lines meet.
    const WRONG: f64 = 0.6;
    /// Fewer places say nothing of a case.
    const FEWEST: u32 = 20;
    let (mut all, mut right) = ([0_u32; 3], [0_u32; 3]);
    for (sight, value) in &seen.sights {
        let (x, weight) = (FORMS[0].of)(sight);
        if let Some(case) = case_of(x, weight, near) {
            all[case] += 1;
            right[case] += u32::from(((CORRECTIONS[0].of)(x, weight) - value).abs() < near);
        }
    }
    let share = |case: usize| f64::from(right[case]) / f64::from(all[case].max(1));
    let wrong: Vec<usize> = (0..3).filter(|&case| share(case) < WRONG).collect();
    let [case] = wrong[..] else { return None };
    let is_known = all.iter().all(|&all| all >= FEWEST);
    let others = (0..3).filter(|&other| other != case).map(share).fold(1.0, f64::min);
    let shown = format!(
        "{:.0} % of thresholds follow from those of their cells in this case, at least {:.0} % in each of the others",
        100.0 * share(case),
        100.0 * others
    );
    (is_known && others >= EXPLAINED).then(|| found(CASES[case], shown))
}

impl Explained {
    fn shown(&self) -> String {
        format!(
            "with it {:.0} % of thresholds follow from those of their cells, without it {:.0} %",
            100.0 * self.share,
            100.0 * self.sound
        )
    }

    /// What is wrong on the way from the size of a pixel to that of the cells.
    pub fn of_scale(&self, faces: &Faces) -> Vec<Found> {
        const HALF: Slip = named("half-the-noise");
        const SIZE: Slip = named("noise-of-another-size");
        let mut all: Vec<Found> =
            self.measure.slips_of_scale().map(|slip| found(slip, self.shown())).collect();
        // Where the weights are exchanged the finer cell shows alone, and without a weight both.
        let shows_finer = faces.finer == 1 && (self.form.is_weightless || self.form.is_reversed);
        let octaves = if shows_finer { 0 } else { faces.finer };
        let times = self.measure.times() * libm::exp2(f64::from(-octaves));
        if times != 1.0 {
            all.retain(|found| found.slip != SIZE);
            let shown = format!("cells are {times} times as wide as they should be");
            all.push(found(if times == 0.5 { HALF } else { SIZE }, shown));
        }
        all
    }

    /// Whether single cells are bent and the threshold is not: then their hash is.
    pub fn has_bent_hash(&self) -> bool {
        self.law.slip.is_none() && !self.is_uniform && !self.form.is_weightless
    }

    /// What is wrong from the hashes on.
    pub fn of_join(&self, probe: &Probe<'_>, faces: &Faces) -> Vec<Found> {
        const SWAPPED: Slip = named("weights-swapped");
        let mut all: Vec<Found> = self.case.iter().cloned().collect();
        if let Some(slip) = self.form.slip {
            let slip = if self.form.is_reversed && faces.finer == 1 {
                SWAPPED
            } else if self.form.is_weightless && (faces.finer == 1 || faces.of_two) {
                weightless(probe).unwrap_or(slip)
            } else {
                slip
            };
            all.push(found(slip, self.shown()));
        }
        if let Some(slip) = self.correction.slip {
            all.push(found(slip, self.shown()));
        }
        if let Some(slip) = self.law.slip {
            all.push(found(slip, self.law.shown.clone()));
        }
        all
    }
}

/// Two hashes that are joined whatever the weight, by the law of what comes of it.
fn weightless(probe: &Probe<'_>) -> Option<Slip> {
    const HALF: Slip = named("weight-always-half");
    let rng = &mut seed::rng("cause.weightless", 0);
    let probe = Probe { finer: 0, ..*probe };
    let cells = any_cells(CELLS, rng);
    let values = probe.cells(&cells);
    // Another fine cell of the same coarse one, wherever cells begin.
    let moved = |by: f64| {
        let beside: Vec<DVec3> = cells.iter().map(|cell| cell + by).collect();
        let moved: f64 = probe.cells(&beside).iter().zip(&values).map(|(a, b)| (a - b).abs()).sum();
        Some(moved).filter(|&moved| moved > 0.01 * CELLS as f64)
    };
    let moved = [0.1, -0.35].into_iter().filter_map(moved).fold(f64::INFINITY, f64::min);
    // Of two values that have nothing to do with each other it is a third in the mean.
    if follows(&values, |x| x) && moved < 0.29 * CELLS as f64 {
        return Some(HALF);
    }
    nearest(&values, WEIGHTLESS).copied()
}

/// Thresholds in steps, or at an end where none should be.
pub(super) struct Steps {
    pub found: Found,
    /// Whether they are numbers of 16 bits.
    pub are_halves: bool,
    /// How many different ones there are.
    count: usize,
}

/// Whether thresholds come in steps, or are 0, or have no more than 11 bits.
pub(super) fn steps(subject: &Subject<'_>, rng: &mut Xoshiro256PlusPlus) -> Option<Steps> {
    const ZERO: Slip = named("clamped-at-zero");
    const STEPS: Slip = named("coarse-steps");
    const HALF: Slip = named("half-precision");
    /// More values than a table of 8 bits has.
    const HALVES: usize = 300;
    /// Thresholds that are asked for at the origin.
    const AT_ORIGIN: usize = 32;
    let mut some = places(CELLS, subject.hash_scale, rng);
    let values = subject.thresholds(&some);
    // Of the numbers below 2^-14 there are more.
    let has_half = |value: &f64| {
        let significand = libm::frexp(*value).0 * 2048.0;
        significand == significand.floor() || value.is_nan() || *value < 6.2e-5
    };
    if values.iter().all(has_half) && unique(&values).len() > HALVES {
        let shown = format!("all of {CELLS} thresholds are numbers of 16 bits");
        return Some(Steps { found: found(HALF, shown), are_halves: true, count: FEW });
    }
    let (count, zeros) = (unique(&values).len(), values.iter().filter(|&&value| value == 0.0).count());
    let shown = format!("{CELLS} thresholds have {count} different values, and {zeros} are 0");
    let is_negative = values.iter().any(|&value| value < 0.0);
    if zeros > 0 && !is_negative {
        return Some(Steps { found: found(ZERO, shown), are_halves: false, count });
    }
    // Many hashes of cell (0, 0, 0) are 0.
    some.truncate(AT_ORIGIN);
    for Fragment { footprint, world, eye, .. } in &mut some {
        let length = footprint.dpdx.length().min(footprint.dpdy.length()) * subject.hash_scale;
        footprint.position = subject
            .precision
            .round(&Footprint { position: DVec3::splat(0.05 * length), ..*footprint })
            .position;
        (*world, *eye) = (footprint.position, footprint.position);
    }
    let at_origin = subject.thresholds(&some).into_iter().filter(|&value| value == 0.0).count();
    if 2 * at_origin > AT_ORIGIN && !is_negative {
        let shown = format!("{at_origin} of {AT_ORIGIN} thresholds in cell (0, 0, 0) are 0");
        return Some(Steps { found: found(ZERO, shown), are_halves: false, count });
    }
    (count <= FEW && count > 1).then(|| Steps { found: found(STEPS, shown), are_halves: false, count })
}

/// Where no way is found: the laws of thresholds at a few weights, against those of a single slip in the join or the correction,
/// under every scale that the size of a pixel may become.
pub(super) fn by_law(probe: &Probe<'_>, rng: &mut Xoshiro256PlusPlus) -> Vec<Found> {
    const WEIGHTS: [f64; 5] = [ALONE, 0.25, 0.5, 0.7, 0.9];
    /// Hashes of the law that is expected.
    const HASHES: usize = 1 << 14;
    /// Quantiles that are compared.
    const QUANTILES: usize = 200;
    /// Mean distance of quantiles of two samples of one law, at most.
    const ALIKE: f64 = 0.02;
    /// Distance at which the sound law is another one.
    const UNLIKE: f64 = 0.03;
    let quantiles = |mut values: Vec<f64>| -> Vec<f64> {
        values.sort_unstable_by(f64::total_cmp);
        let at = |step: usize| values[step * values.len() / QUANTILES + values.len() / (2 * QUANTILES)];
        (0..QUANTILES).map(|step| at(step).clamp(0.0, 1.0)).collect()
    };
    let hashes: Vec<[f64; 4]> = (0..HASHES).map(|_| core::array::from_fn(|_| seed::uniform01(rng))).collect();
    let expected = |form: &Form, correction: &Correction, weight: f64| {
        let value = |&alone: &[f64; 4]| {
            let nearest = if weight < 0.5 { [alone[1], alone[2]] } else { [alone[2], alone[3]] };
            let (x, t) = (form.of)(&Sight { alone, nearest, weight, of_scale: libm::exp2(weight) - 1.0 });
            (correction.of)(x, t)
        };
        quantiles(hashes.iter().map(value).collect())
    };
    let singles = FORMS
        .iter()
        .map(|form| (form.slip, form, &CORRECTIONS[0]))
        .chain(CORRECTIONS[1..].iter().map(|correction| (correction.slip, &FORMS[0], correction)));
    let ways: Vec<(Option<Slip>, Vec<Vec<f64>>)> = singles
        .map(|(slip, form, correction)| (slip, WEIGHTS.map(|w| expected(form, correction, w)).to_vec()))
        .collect();
    let mut best: Option<(f64, f64, Measure, Option<Slip>)> = None;
    for measure in probe.measure.with_scales() {
        let seen = WEIGHTS.map(|weight| {
            let probe = Probe { measure, lean: weight, finer: 0, ..*probe };
            probe.cells(&any_cells(CELLS, rng))
        });
        if seen.iter().flatten().any(|value| value.is_nan()) {
            continue;
        }
        let seen = seen.map(quantiles);
        let distance = |way: &[Vec<f64>]| {
            let of_weight = |(seen, expected): (&Vec<f64>, &Vec<f64>)| {
                let differences = seen.iter().zip(expected).map(|(a, b)| (a - b).abs());
                differences.sum::<f64>() / QUANTILES as f64
            };
            seen.iter().zip(way).map(of_weight).fold(0.0, f64::max)
        };
        let sound = distance(&ways[0].1);
        for (slip, way) in &ways {
            let here = distance(way);
            if best.as_ref().is_none_or(|(least, ..)| here + 0.002 < *least) {
                best = Some((here, sound, measure, *slip));
            }
        }
    }
    match best {
        Some((distance, sound, measure, Some(slip))) if distance < ALIKE && sound > UNLIKE => {
            let shown = format!(
                "the law of thresholds at {} weights is that of this slip to {distance:.3}, and {sound:.3} from uniform",
                WEIGHTS.len()
            );
            measure.slips_of_scale().chain([slip]).map(|slip| found(slip, shown.clone())).collect()
        }
        Some(_) | None => Vec::new(),
    }
}
