//! The size of the noise: how far one has to go along the screen until the threshold changes.

use crate::check::evidence::ComparedShare;
use crate::check::input::{Patch, Start};
use crate::check::judge::replicate_means;
use crate::check::judge::replicate_means::Mean;
use crate::check::predict::redraw_probability;
use crate::check::tolerance::TILT_STRETCH;
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Draw, Evidence, Promise, Subject, Trial, Verdict};
use glam::DVec2;
use rand::rngs::Xoshiro256PlusPlus;

/// Scan lines of each kind, along each screen axis: sees a size of the noise that is off by a tenth, which four hundred
/// would not.
const SCAN_LINES: usize = 1 << 10;

/// Steps of a scan line, an eighth of the claimed size each: four times that size, so that lines of any patch change some
/// cells and the count of changes is not all chance.
const SCAN_STEPS: u32 = 32;

/// Steps of a scan line within the claimed size: also the smallest cells, half of that size, are left by one step in
/// four only.
const STEPS_A_SIZE: f64 = 8.0;

/// Mean run length on surfaces that face the camera.
pub const FRONTAL: Claim = Claim {
    id: "noise_scale.frontal",
    anchor: "§5.4 (noise of g_HashScale pixels); closed form not in the paper",
    statement: "on surfaces that face the camera, runs of equal thresholds along screen x and y are as long in pixels as \
                the claimed hash scale predicts",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.25)),
    run: |subject, draw| trial(&FRONTAL, &[(1.0, "frontal")], subject, draw),
};

/// The same on surfaces that are seen at an angle: one screen axis after the other has the longer derivative.
pub const TILTED: Claim = Claim {
    id: "noise_scale.tilted",
    anchor: "§5.4.2, §6.2 (the larger derivative, per axis in Listing 2); closed form not in the paper",
    statement: "on tilted surfaces, runs of equal thresholds along screen x and y are as long in pixels as the claimed \
                hash scale predicts from the derivatives",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.25)),
    run: |subject, draw| {
        let tilts = [(TILT_STRETCH, "foreshortened along x"), (1.0 / TILT_STRETCH, "foreshortened along y")];
        trial(&TILTED, &tilts, subject, draw)
    },
};

/// Groups of lerp factors in the picture.
const PICTURE_GROUPS: usize = 8;

/// One walk over a patch.
struct Line {
    lerp_factor: f64,
    changes: f64,
    expected: f64,
}

fn trial(claim: &Claim, kinds: &[(f64, &str)], subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(claim.id);
    let (mut means, mut lengths, mut points) = (Vec::new(), Vec::new(), Vec::new());
    let mut n = 0;
    for &(stretch, kind) in kinds {
        for (along, axis) in [(DVec2::X, "x"), (DVec2::Y, "y")] {
            let name = format!("{kind}, run along {axis}");
            let lines = lines(subject, stretch, along, draw.samples_at_least(SCAN_LINES), &mut rng)?;
            n += lines.len() as u64 * u64::from(SCAN_STEPS);
            let expected = lines.iter().map(|line| line.expected).sum::<f64>() / lines.len() as f64;
            let relative: Vec<f64> =
                lines.iter().map(|line| (line.changes - line.expected) / expected).collect();
            let Some(mean) = Mean::of(name.clone(), &relative) else { continue };
            lengths.push((name.clone(), run_length(subject, &lines, |line| line.changes)));
            points.extend(picture(subject, &name, &lines));
            means.push(mean);
        }
    }
    let seen = |worst: &Mean| {
        let length = lengths.iter().find(|(name, _)| *name == worst.name).map_or(f64::NAN, |found| found.1);
        let predicted = length * (1.0 + worst.mean);
        format!("{}: mean run length {length:.3} pixels, {predicted:.3} are predicted", worst.name)
    };
    let evidence =
        Evidence::Quantity { abscissa: "lerp factor", ordinate: "mean run length [pixels]", points };
    let replicates = draw.samples_at_least(SCAN_LINES);
    let law = format!("Student's t, {} dof", replicates - 1);
    let detectable = replicate_means::detectable(&means, replicates);
    let effect_name = "relative error in changes per pixel";
    Ok(replicate_means::worst_of(&means, &law, detectable, n, effect_name, seen, evidence))
}

/// Walks along a screen axis, each time over a patch of its own at a place of its own.
fn lines(
    subject: &Subject<'_>,
    stretch: f64,
    along: DVec2,
    n: usize,
    rng: &mut Xoshiro256PlusPlus,
) -> Attempt<Vec<Line>> {
    let step = along * (subject.hash_scale / STEPS_A_SIZE);
    let mut fragments = Vec::with_capacity(n * (SCAN_STEPS as usize + 1));
    let mut lines = Vec::with_capacity(n);
    for _ in 0..n {
        let patch = Patch::draw(subject, stretch, rng);
        let footprint = patch.footprint();
        lines.push(Line {
            lerp_factor: subject.nominal(&footprint).lerp_factor,
            changes: 0.0,
            expected: f64::from(SCAN_STEPS) * redraw_probability(subject, &footprint, patch.lag(step)),
        });
        let start = Start::draw(rng);
        fragments.extend((0..=SCAN_STEPS).map(|k| patch.fragment(subject, &start, step * f64::from(k))));
    }
    let values = subject.thresholds(&fragments);
    reject_outsiders(subject, &fragments, &values)?;
    for (line, values) in lines.iter_mut().zip(values.chunks_exact(SCAN_STEPS as usize + 1)) {
        line.changes = values.windows(2).filter(|pair| pair[0] != pair[1]).count() as f64;
    }
    Ok(lines)
}

/// Mean run length in pixels: the length of all lines for the number of changes.
fn run_length<'l>(
    subject: &Subject<'_>,
    lines: impl IntoIterator<Item = &'l Line>,
    changes: impl Fn(&Line) -> f64,
) -> f64 {
    let (mut length, mut all) = (0.0, 0.0);
    for line in lines {
        length += f64::from(SCAN_STEPS) * subject.hash_scale / STEPS_A_SIZE;
        all += changes(line);
    }
    length / all
}

/// Measured and predicted run lengths by lerp factor.
fn picture(subject: &Subject<'_>, name: &str, lines: &[Line]) -> Vec<ComparedShare> {
    let group = |line: &Line| ((line.lerp_factor * PICTURE_GROUPS as f64) as usize).min(PICTURE_GROUPS - 1);
    let point = |at: usize| {
        let here: Vec<&Line> = lines.iter().filter(|line| group(line) == at).collect();
        let excess: Vec<f64> = here.iter().map(|line| line.changes - line.expected).collect();
        let spread = Mean::of("", &excess)?;
        let length = |changes: fn(&Line) -> f64| run_length(subject, here.iter().copied(), changes);
        let predicted = length(|line| line.expected);
        let expected = here.iter().map(|line| line.expected).sum::<f64>() / here.len() as f64;
        Some(ComparedShare {
            series: name.to_owned(),
            x: (at as f64 + 0.5) / PICTURE_GROUPS as f64,
            measured: length(|line| line.changes),
            predicted,
            // The inverse of a count is as uncertain as the count, relative to itself.
            sigma: predicted * spread.sigma / expected,
        })
    };
    (0..PICTURE_GROUPS).filter_map(point).collect()
}
