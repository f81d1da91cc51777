//! The laws of a threshold in the whole domain in which it is used: near and far, in cells of every octave, at every angle.
//!
//! The claims of the other families look closely at scenes of everyday size; these look everywhere, at each place less closely. What
//! they sample is `check/input/everywhere.rs`. Each is judged in the whole domain, in every level of every dimension, and in every
//! setting.

use crate::check::evidence::NamedHistogram;
use crate::check::input::everywhere::{Dimension, DistinctCells, Sampler, Setting, Settings, distinct};
use crate::check::judge::pools::Pools;
use crate::check::judge::pops::Pops;
use crate::check::predict::{Changes, largest_change};
use crate::check::tolerance::{BINS, LEAST_GROUP, POWER, SINGLE_LEVEL};
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::scene::Fragment;
use crate::stats::histogram::Histogram;
use crate::stats::seed::uniform01;
use crate::stats::{chi_square, power};
use crate::threshold::footprint::Footprint;
use glam::DVec3;
use rand::rngs::Xoshiro256PlusPlus;

/// Samples of the uniform law in each setting: a threshold that is constant there shows there alone.
const SAMPLES: usize = 256;

/// Pairs of thresholds in each setting.
const PAIRS: usize = 128;

/// Thresholds that are moved in each setting.
const MOVED: usize = 128;

/// Shifts in pixels: within the smallest cell at every lerp factor, about a cell, and two cells or more.
const SHIFTS: [f64; 3] = [0.125, 0.7, 2.5];

/// Bins along each side of a table of pairs: 64 expected in each square of the smallest group.
const SIDE: usize = 8;

/// Views of a point while its scale goes through an octave: the steepest interpolation then moves by less than 0.02 a step, the
/// steepest copula by less than 0.3, where a pop has a mean of a third.
const VIEWS: usize = 129;

/// How far behind the first layer the second lies, in cells of the larger kind.
const BEHIND: [f64; 2] = [4.0, 64.0];

/// The law of one threshold.
pub const UNIFORM: Claim = Claim {
    id: "domain.uniform",
    anchor: "§4, §5 (expected visibility is alpha)",
    statement: "near and far, in cells of every octave, at every angle, level of detail, layer, frame and noise size, for every \
                alpha, a fragment of that alpha is kept with probability alpha",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.2)),
    run: uniform,
};

/// Two cells side by side.
pub const NEIGHBOURS: Claim = Claim {
    id: "domain.neighbours",
    anchor: "§5.1 (hash outputs replace independent random numbers)",
    statement: "everywhere in the domain, the thresholds of two neighbouring cells are independent",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.15)),
    run: |subject, draw| pairs(&NEIGHBOURS, subject, draw, neighbour),
};

/// Two surfaces, one behind the other.
pub const LAYERS: Claim = Claim {
    id: "domain.layers",
    anchor: "§5.3 (layers at one pixel)",
    statement: "everywhere in the domain, the thresholds of two surfaces that are seen at one pixel are independent",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.15)),
    run: |subject, draw| pairs(&LAYERS, subject, draw, behind),
};

/// How many thresholds a motion changes: the size of the noise.
pub const CHANGES: Claim = Claim {
    id: "domain.changes",
    anchor: "§5, §5.4 (noise of g_HashScale pixels); closed form not in the paper",
    statement: "everywhere in the domain, a shift by 0.125, 0.7 or 2.5 pixels along screen x or y changes the share of thresholds that \
                the size of the cells predicts",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.25)),
    run: changes,
};

/// No pops.
pub const CONTINUITY: Claim = Claim {
    id: "domain.continuity",
    anchor: "§5.4.2 (no discontinuities while the scale changes)",
    statement: "everywhere in the domain, while the camera comes closer by an octave, the threshold of a fixed point changes without \
                jumps",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.02)),
    run: continuity,
};

/// The part of the domain in which a test was least likely under the claim.
struct Worst {
    p: f64,
    tests: u64,
    effect: f64,
    seen: String,
}

impl Worst {
    fn new() -> Self {
        Self { p: 1.0, tests: 0, effect: 0.0, seen: String::new() }
    }

    fn add(&mut self, p: f64, effect: f64, seen: impl FnOnce() -> String) {
        self.tests += 1;
        if p < self.p {
            (self.p, self.effect, self.seen) = (p, effect, seen());
        }
    }

    /// The probability that counts all tests.
    fn conclusion(&self) -> Conclusion {
        Conclusion::Probability((self.p * self.tests as f64).min(1.0))
    }
}

fn uniform(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(UNIFORM.id);
    let settings = Settings::draw(subject, draw, &mut rng);
    let mut cells = DistinctCells::new(subject, draw);
    let mut pools = Pools::new(Histogram::new(BINS));
    settings.each(subject, |subject, some| {
        let groups: Vec<Vec<[Fragment; 1]>> = some
            .iter()
            .map(|setting| {
                let sampler = Sampler::new(subject, setting);
                distinct(SAMPLES, &mut cells, || {
                    let fragment = sampler.fragment(&mut rng);
                    Some(([fragment], [subject.nominal(&fragment.footprint)]))
                })
            })
            .collect();
        let samples: Vec<Fragment> = groups.iter().flatten().flatten().copied().collect();
        let values = subject.thresholds(&samples);
        reject_outsiders(subject, &samples, &values)?;
        let mut values = values.into_iter();
        for (setting, group) in some.iter().zip(&groups) {
            let mut histogram = Histogram::new(BINS);
            histogram.extend(values.by_ref().take(group.len()));
            pools.add(&settings, setting, histogram, Histogram::merge);
        }
        Ok(())
    })?;
    let mut worst = Worst::new();
    let mut smallest = u64::MAX;
    for (name, histogram) in pools.levels() {
        let (n, error) = (histogram.total(), coverage_error(histogram));
        let seen = || format!("in {name} the share that is kept is off by up to {:.2} %", 100.0 * error);
        if n >= LEAST_GROUP as u64 {
            smallest = smallest.min(n);
            if let Ok(test) = chi_square::uniform(histogram.counts()) {
                worst.add(test.p, error, seen);
            }
        }
        worst.add(bound(n, error), error, seen);
    }
    for (name, histogram) in pools.settings().filter(|(_, histogram)| histogram.total() > 0) {
        let (n, error) = (histogram.total(), coverage_error(histogram));
        worst.add(bound(n, error), error, || {
            format!(
                "of {n} thresholds at {name} the share that is kept is off by up to {:.2} %",
                100.0 * error
            )
        });
    }
    let whole = pools.levels().next().map(|(name, histogram)| NamedHistogram::new(name, histogram));
    Ok(Trial {
        conclusion: worst.conclusion(),
        statistic: Some(worst.effect),
        statistic_name: format!("largest error in coverage, worst of {}", worst.tests),
        n: pools.levels().next().map_or(0, |(_, histogram)| histogram.total()),
        effect: Some(worst.effect),
        effect_name: "error in coverage in a part of the domain",
        detectable: (smallest < u64::MAX)
            .then(|| power::detectable_distance_ks(smallest, SINGLE_LEVEL / worst.tests as f64, POWER)),
        seen: worst.seen,
        evidence: Evidence::Histograms(whole.into_iter().collect()),
    })
}

/// The largest distance of the share below an edge of a bin from that edge.
fn coverage_error(histogram: &Histogram) -> f64 {
    let (n, bins) = (histogram.total() as f64, histogram.counts().len() as f64);
    let mut below = 0;
    let error = |(place, &count): (usize, &u64)| {
        below += count;
        (below as f64 / n - (place + 1) as f64 / bins).abs()
    };
    histogram.counts().iter().enumerate().map(error).fold(0.0, f64::max)
}

/// The bound of Dvoretzky, Kiefer, Wolfowitz and Massart on the probability of such a distance: it holds for every n.
fn bound(n: u64, distance: f64) -> f64 {
    (2.0 * libm::exp(-2.0 * n as f64 * distance * distance)).min(1.0)
}

/// The second fragment of a pair, from the first.
type Partner = fn(&Subject<'_>, &Fragment, &mut Xoshiro256PlusPlus) -> Fragment;

/// The same place in the next cell along an axis, one to either side, as far as the precision of a position goes.
fn neighbour(subject: &Subject<'_>, here: &Fragment, rng: &mut Xoshiro256PlusPlus) -> Fragment {
    let side = subject.nominal(&here.footprint).coarse_scale.map(|scale| 1.0 / scale);
    let axis = (3.0 * uniform01(rng)) as usize;
    let sign = if uniform01(rng) < 0.5 { -1.0 } else { 1.0 };
    moved(subject, here, DVec3::AXES[axis] * (sign * side[axis]))
}

/// The same pixel on another layer, that many cells behind.
fn behind(subject: &Subject<'_>, here: &Fragment, rng: &mut Xoshiro256PlusPlus) -> Fragment {
    let side = subject.nominal(&here.footprint).coarse_scale.map(|scale| 1.0 / scale);
    let [near, far] = BEHIND;
    // In half of the pairs one looks along an axis of the object, as at the walls of a room.
    let direction = if uniform01(rng) < 0.5 {
        DVec3::AXES[(3.0 * uniform01(rng)) as usize]
    } else {
        DVec3::from_array([(); 3].map(|()| 2.0 * uniform01(rng) - 1.0)).normalize_or(DVec3::Z)
    };
    let away = DVec3::from_array(side) * direction;
    let there = moved(subject, here, away * (near + (far - near) * uniform01(rng)));
    Fragment { pixel: here.pixel, layer: here.layer + 1 + (3.0 * uniform01(rng)) as u32, ..there }
}

fn moved(subject: &Subject<'_>, here: &Fragment, by: DVec3) -> Fragment {
    let footprint =
        subject.precision.round(&Footprint { position: here.footprint.position + by, ..here.footprint });
    let by = footprint.position - here.footprint.position;
    Fragment { footprint, world: here.world + by, eye: here.eye + by, ..*here }
}

/// Counts of pairs, and the sum of products of their deviations from 1/2, in units in which each has a variance of 1.
#[derive(Clone)]
struct Table {
    counts: Vec<u64>,
    n: u64,
    products: f64,
}

impl Table {
    fn new() -> Self {
        Self { counts: vec![0; SIDE * SIDE], n: 0, products: 0.0 }
    }

    fn add(&mut self, first: f64, second: f64) {
        let bin = |value: f64| ((value * SIDE as f64) as usize).min(SIDE - 1);
        self.counts[bin(first) * SIDE + bin(second)] += 1;
        self.n += 1;
        self.products += 12.0 * (first - 0.5) * (second - 0.5);
    }

    fn merge(&mut self, other: &Self) {
        self.counts.iter_mut().zip(&other.counts).for_each(|(sum, count)| *sum += count);
        self.n += other.n;
        self.products += other.products;
    }

    fn correlation(&self) -> f64 {
        self.products / self.n as f64
    }

    /// Bernstein's bound on the probability of such a mean of products, which have a variance of 1 and are at most 3; it holds for
    /// every n.
    fn bound(&self) -> f64 {
        let r = self.correlation().abs();
        (2.0 * libm::exp(-0.5 * self.n as f64 * r * r / (1.0 + r))).min(1.0)
    }
}

fn pairs(claim: &Claim, subject: &Subject<'_>, draw: &Draw, partner: Partner) -> Attempt<Trial> {
    let mut rng = draw.rng(claim.id);
    let settings = Settings::draw(subject, draw, &mut rng);
    let mut cells = DistinctCells::new(subject, draw);
    let mut pools = Pools::new(Table::new());
    settings.each(subject, |subject, some| {
        let groups: Vec<Vec<[Fragment; 2]>> = some
            .iter()
            .map(|setting| {
                let sampler = Sampler::new(subject, setting);
                distinct(PAIRS, &mut cells, || {
                    let here = sampler.fragment(&mut rng);
                    let there = partner(subject, &here, &mut rng);
                    let nominal = [here, there].map(|fragment| subject.nominal(&fragment.footprint));
                    let [a, b] = &nominal;
                    // Where the position is too coarse for a step of one cell there is no pair.
                    (a.coarse_cell != b.coarse_cell && a.fine_cell != b.fine_cell)
                        .then_some(([here, there], nominal))
                })
            })
            .collect();
        let samples: Vec<Fragment> = groups.iter().flatten().flatten().copied().collect();
        let values = subject.thresholds(&samples);
        reject_outsiders(subject, &samples, &values)?;
        let mut values = values.chunks_exact(2);
        for (setting, group) in some.iter().zip(&groups) {
            let mut table = Table::new();
            values.by_ref().take(group.len()).for_each(|pair| table.add(pair[0], pair[1]));
            pools.add(&settings, setting, table, Table::merge);
        }
        Ok(())
    })?;
    let mut worst = Worst::new();
    let mut smallest = u64::MAX;
    for (name, table) in pools.levels().filter(|(_, table)| table.n > 0) {
        let seen = || format!("in {name}: correlation {:+.3}", table.correlation());
        if table.n >= LEAST_GROUP as u64 {
            smallest = smallest.min(table.n);
            if let Ok(test) = chi_square::uniform(&table.counts) {
                worst.add(test.p, test.effect, seen);
            }
        }
        worst.add(table.bound(), table.correlation().abs(), seen);
    }
    for (name, table) in pools.settings().filter(|(_, table)| table.n > 0) {
        worst.add(table.bound(), table.correlation().abs(), || {
            format!("of {} pairs at {name}: correlation {:+.3}", table.n, table.correlation())
        });
    }
    let whole = pools.levels().next();
    let dof = (SIDE * SIDE - 1) as u64;
    Ok(Trial {
        conclusion: worst.conclusion(),
        statistic: Some(worst.effect),
        statistic_name: format!("excess chi-square per pair or correlation, worst of {}", worst.tests),
        n: whole.map_or(0, |(_, table)| table.n),
        effect: Some(worst.effect),
        effect_name: "excess chi-square per pair, or correlation, in a part of the domain",
        detectable: (smallest < u64::MAX).then(|| {
            power::detectable_effect_chi_square(dof, smallest, SINGLE_LEVEL / worst.tests as f64, POWER)
        }),
        seen: worst.seen,
        evidence: whole.map_or(Evidence::None, |(_, table)| Evidence::Pairs {
            side: SIDE,
            counts: table.counts.clone(),
        }),
    })
}

/// Thresholds that a motion changed, beside those that it should.
#[derive(Clone, Default)]
struct Moved {
    n: u64,
    changed: u64,
    expected: Changes,
}

impl Moved {
    fn merge(&mut self, other: &Self) {
        self.n += other.n;
        self.changed += other.changed;
        self.expected.merge(&other.expected);
    }

    fn error(&self) -> f64 {
        (self.changed as f64 - self.expected.mean) / self.n as f64
    }
}

fn changes(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(CHANGES.id);
    let settings = Settings::draw(subject, draw, &mut rng);
    let mut pools = Pools::new(Moved::default());
    settings.each(subject, |subject, some| {
        // The closed form is about faces of cells at uniform places.
        let some: Vec<&Setting> = some.iter().filter(|setting| setting.has_uniform_phases()).collect();
        let mut samples = Vec::with_capacity(2 * MOVED * some.len());
        let mut slopes = Vec::with_capacity(MOVED * some.len());
        let mut expected = Vec::with_capacity(some.len());
        for &setting in &some {
            let sampler = Sampler::new(subject, setting);
            let mut changes = Changes::default();
            for at in 0..MOVED {
                let here = sampler.fragment(&mut rng);
                let along = if at % 2 == 0 { here.footprint.dpdx } else { here.footprint.dpdy };
                let there =
                    moved(subject, &here, along * (SHIFTS[at / 2 % SHIFTS.len()] * subject.hash_scale));
                changes.add(subject, &here.footprint, there.footprint.position - here.footprint.position);
                let [before, after] = [here, there].map(|fragment| subject.nominal(&fragment.footprint));
                slopes.push(largest_change(subject, &before, &after));
                samples.extend([here, there]);
            }
            expected.push(changes);
        }
        let values = subject.thresholds(&samples);
        reject_outsiders(subject, &samples, &values)?;
        let groups = values.chunks_exact(2 * MOVED).zip(slopes.chunks_exact(MOVED));
        for ((&setting, expected), (values, slopes)) in some.iter().zip(expected).zip(groups) {
            // Where the distance from the origin bounds the size of a cell, moving changes the scale a little, too.
            let pairs = values.chunks_exact(2).zip(slopes);
            let changed = pairs.filter(|(pair, slope)| (pair[0] - pair[1]).abs() > **slope).count() as u64;
            pools.add(&settings, setting, Moved { n: MOVED as u64, changed, expected }, Moved::merge);
        }
        Ok(())
    })?;
    let mut worst = Worst::new();
    let mut sigma = 0.0_f64;
    let mut judge = |name: &str, moved: &Moved| {
        let share = |count: f64| count / moved.n as f64;
        worst.add(moved.expected.compared(moved.changed).p, moved.error().abs(), || {
            let (changed, predicted) = (share(moved.changed as f64), share(moved.expected.mean));
            format!("in {name}: {changed:.3} of thresholds change, {predicted:.3} are predicted")
        });
    };
    for (name, moved) in pools.levels() {
        judge(name, moved);
        if moved.n >= LEAST_GROUP as u64 {
            sigma = sigma.max(moved.expected.variance().sqrt() / moved.n as f64);
        }
    }
    pools.settings().for_each(|(name, moved)| judge(name, moved));
    Ok(Trial {
        conclusion: worst.conclusion(),
        statistic: Some(worst.effect),
        statistic_name: format!("error in the share that changes, worst of {}", worst.tests),
        n: pools.levels().next().map_or(0, |(_, moved)| moved.n),
        effect: Some(worst.effect),
        effect_name: "error in the share that changes in a part of the domain",
        detectable: (sigma > 0.0)
            .then(|| power::detectable_shift_z(sigma, SINGLE_LEVEL / worst.tests as f64, POWER)),
        seen: worst.seen,
        evidence: Evidence::None,
    })
}

fn continuity(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(CONTINUITY.id);
    let settings = Settings::draw(subject, draw, &mut rng);
    let mut pops = Pops::default();
    let mut points = 0_u64;
    settings.each(subject, |subject, some| {
        let mut views = Vec::with_capacity(VIEWS * some.len());
        for setting in some {
            let sampler = Sampler::new(subject, setting);
            let position = sampler.position(&mut rng);
            let octave = f64::from(setting.level(Dimension::Octave)) + uniform01(&mut rng);
            let [dpdx, dpdy] = sampler.derivatives(octave, &mut rng);
            let first = sampler.at(position, dpdx, dpdy, &mut rng);
            // A threshold that is spread over frames goes around the unit interval; in its first stratum it does not.
            let first = Fragment { frame: subject.frames.first_again(first.frame), ..first };
            views.extend((0..VIEWS).map(|view| {
                let closer = libm::exp2(-(view as f64) / (VIEWS - 1) as f64);
                let [dpdx, dpdy] = [dpdx * closer, dpdy * closer];
                let footprint = subject.precision.round(&Footprint { position, dpdx, dpdy });
                Fragment { footprint, ..first }
            }));
        }
        let values = subject.thresholds(&views);
        reject_outsiders(subject, &views, &values)?;
        for (views, values) in views.chunks_exact(VIEWS).zip(values.chunks_exact(VIEWS)) {
            pops.add_path(subject, views, values);
            points += 1;
        }
        Ok(())
    })?;
    Ok(pops.into_trial(subject, points as f64, "pops per point and octave in the domain"))
}
