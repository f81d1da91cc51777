//! What is measured of pictures.

use super::depth::DepthBuffer;
use super::layers::LayerSums;
use super::motion::Along;
use super::picture::{Picture, Region};
use crate::render::draw::shot::Shot;
use crate::render::draw::view::Cause;
use crate::render::draw::work::Frame;
use crate::technique::foveated::Gaze;
use image::GrayImage;
use image_compare::Algorithm;
use std::collections::{BTreeMap, VecDeque};

/// Measured numbers by name.
///
/// | name | meaning |
/// |---|---|
/// | `coverage` | mean share of the image that is covered, over all frames |
/// | `coverage_ratio` | that, as a share of the truth's |
/// | `rmse`, `rmse_coverage` | root mean square error of colour and of coverage to the truth, mean over frames |
/// | `rmse.object`, `rmse_coverage.object` | the same over the pixels that a surface touches, without the background |
/// | `rmse_of_mean` | that of the coverage of the mean over frames |
/// | `coverage.NAME`, `coverage_ratio.NAME` | the first two within a region of the scene |
/// | `ssim` | structural similarity of luminance to the truth, mean over frames |
/// | `flips.surface` | change of coverage a frame at a point of the nearest surface, followed through its motion |
/// | `flips.pixel` | change of coverage a frame, per pixel that a surface touches in both, whatever moves below it |
/// | `changed` | change of coverage a frame over the whole image, as a share of the mean coverage |
/// | `flips.surface.translate`, `.zoom`, `.rotate`, `flips.pixel.translate`, ... | the same with one cause of motion alone |
/// | `layer_correlation` | correlation of the visibilities of the first two layers, where both are partly transparent |
/// | `coverage_ratio.gaze`, `.periphery` | the coverage ratio within the circle around the gaze, and outside |
/// | `ghosting` | share of the coverage that is shown where no surface is in that frame; of takes that mix frames |
/// | `swing` | difference between the highest and the lowest coverage of a pixel in the last eight frames, mean over touched pixels; of the same takes |
/// | `open` | share of the rays that are open, over all frames |
/// | `open_flips` | change of that share a frame, per pixel with a ray in both |
/// | `open_run_ratio` | `run_ratio` of open and occluded pixels |
/// | `depth.phantoms` | share of the depths of a smaller buffer at which there is nothing |
/// | `depth.occlusion` | mean share of the neighbours of a pixel that are nearer than it |
/// | `run_x`, `run_y` | mean length of runs of equal visibility along the rows and the columns, in pixels, as far as the image goes |
/// | `run_ratio` | `run_y / run_x` |
///
/// Those of another distance end in `@` and its factor.
pub type Metrics = BTreeMap<String, f64>;

/// What is measured beyond what every scene is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Asked {
    /// Correlation of the first two layers.
    pub layers: bool,
    /// What frames leave behind in later ones.
    pub ghosts: bool,
    /// The circle around the gaze and its outside, each alone.
    pub gaze: Option<Gaze>,
}

/// Sums over the frames of a shot.
#[derive(Clone, Debug, Default)]
pub struct Measured {
    shots: u32,
    regions: Vec<Region>,
    depth: Option<DepthBuffer>,
    sums: Sums,
}

#[derive(Clone, Debug, Default)]
struct Sums {
    frames: f64,
    coverage: f64,
    /// Coverage of each region, and that of the truth.
    regions: Vec<[f64; 2]>,
    depth: BTreeMap<&'static str, f64>,
    truth: Option<ErrorSums>,
    before: Option<(Vec<f32>, Vec<bool>)>,
    /// Change of coverage, and pixels that were compared.
    flips: [f64; 2],
    /// The same at points of surfaces.
    surface: [f64; 2],
    /// Change of coverage over all pixels, and the number of frames that were compared.
    changed: [f64; 2],
    /// Coverage where no surface is, and all.
    ghosts: Option<[f64; 2]>,
    /// Coverage of the latest frames.
    latest: VecDeque<Vec<f32>>,
    touched: Vec<bool>,
    open: Option<OpenSums>,
    runs: [Runs; 2],
    layers: Option<LayerSums>,
    /// Coverage and that of the truth, within the circle around the gaze and outside.
    gaze: Option<[[f64; 2]; 2]>,
    /// Coverage of all frames.
    mean: Vec<f32>,
}

#[derive(Clone, Debug, Default)]
struct OpenSums {
    /// Rays, and those that are open.
    rays: [u64; 2],
    before: Vec<Option<f32>>,
    /// Change of the share, and pixels that were compared.
    flips: [f64; 2],
    runs: [Runs; 2],
}

#[derive(Clone, Debug)]
struct ErrorSums {
    coverage: f64,
    rmse: f64,
    rmse_coverage: f64,
    /// Of colour and coverage, over touched pixels.
    object: [f64; 2],
    ssim: f64,
    mean: Vec<f32>,
}

impl Measured {
    /// Prepares to measure regions and the depth buffer beside the whole picture.
    #[must_use]
    pub fn new(regions: &[Region], depth: Option<&DepthBuffer>) -> Self {
        Self { regions: regions.to_vec(), depth: depth.cloned(), ..Self::default() }
    }

    /// Begins a shot.
    pub fn begin(&mut self) {
        self.sums = Sums { regions: vec![[0.0; 2]; self.regions.len()], ..Sums::default() };
        self.shots += 1;
    }

    /// Tells whether no shot has ended yet.
    #[must_use]
    pub fn is_first_shot(&self) -> bool {
        self.shots == 1
    }

    /// Adds a frame; `truth` as it should be, and `along` where its surfaces were in the frame before, if there was one.
    pub fn add(&mut self, frame: &Frame, truth: Option<&Picture>, along: Option<&Along<'_>>, asked: Asked) {
        let picture = &frame.picture;
        let sums = &mut self.sums;
        sums.frames += 1.0;
        sums.coverage += picture.mean_coverage();
        if let Some((before, touched)) = &sums.before {
            for at in (0..before.len()).filter(|&at| touched[at] && frame.touched[at]) {
                sums.flips[0] += f64::from((picture.coverage[at] - before[at]).abs());
                sums.flips[1] += 1.0;
            }
            if let Some([changed, compared]) = along.map(|along| along.changes(picture, before)) {
                sums.surface = [sums.surface[0] + changed, sums.surface[1] + compared];
            }
            let changes = before.iter().zip(&picture.coverage).map(|(a, b)| f64::from((a - b).abs()));
            sums.changed[0] += changes.sum::<f64>() / before.len().max(1) as f64;
            sums.changed[1] += 1.0;
        }
        sums.before = Some((picture.coverage.clone(), frame.touched.clone()));
        let size = picture.size.map(|side| side as usize);
        runs(size, |at| frame.touched[at].then(|| picture.coverage[at] >= 0.5), &mut sums.runs);
        if !frame.rays.is_empty() {
            sums.open.get_or_insert_default().add(size, &frame.rays);
        }
        if asked.ghosts {
            let [ghosts, all] = sums.ghosts.get_or_insert_default();
            for (&share, &touched) in picture.coverage.iter().zip(&frame.touched) {
                *ghosts += if touched { 0.0 } else { f64::from(share) };
                *all += f64::from(share);
            }
            if sums.latest.len() == CYCLE {
                sums.latest.pop_front();
            }
            sums.latest.push_back(picture.coverage.clone());
            sums.touched.clone_from(&frame.touched);
        }
        for (region, [found, right]) in self.regions.iter().zip(&mut sums.regions) {
            *found += within(region, picture);
            *right += truth.map_or(0.0, |truth| within(region, truth));
        }
        if let (Some(table), Some(depth)) = (&self.depth, &frame.depth) {
            for (name, value) in depth.measures(table) {
                *sums.depth.entry(name).or_default() += value;
            }
        }
        if asked.layers {
            let layers = sums.layers.get_or_insert_default();
            layers.covariance += frame.layers.covariance;
            layers.deviation += frame.layers.deviation;
        }
        if let Some(truth) = truth {
            if let Some(gaze) = &asked.gaze {
                add_around(gaze, picture, truth, sums.gaze.get_or_insert_default());
            }
            let errors = sums.truth.get_or_insert_with(|| ErrorSums {
                coverage: 0.0,
                rmse: 0.0,
                rmse_coverage: 0.0,
                object: [0.0; 2],
                ssim: 0.0,
                mean: vec![0.0; truth.coverage.len()],
            });
            errors.coverage += truth.mean_coverage();
            errors.rmse += root_mean_square(picture.colour.as_flattened(), truth.colour.as_flattened());
            errors.rmse_coverage += root_mean_square(&picture.coverage, &truth.coverage);
            let at = |value: &dyn Fn(usize) -> f64| {
                let touched = (0..frame.touched.len()).filter(|&at| frame.touched[at]);
                let (sum, count) =
                    touched.fold((0.0, 0.0), |(sum, count), at| (sum + value(at), count + 1.0));
                (sum / f64::max(count, 1.0)).sqrt()
            };
            errors.object[0] += at(&|at| {
                let apart = picture.colour[at].iter().zip(&truth.colour[at]).map(|(a, b)| f64::from(a - b));
                apart.map(|apart| apart * apart).sum::<f64>() / 3.0
            });
            errors.object[1] += at(&|at| f64::from(picture.coverage[at] - truth.coverage[at]).powi(2));
            errors.ssim += similarity(picture, truth);
            errors.mean.iter_mut().zip(&truth.coverage).for_each(|(sum, share)| *sum += share);
        }
        sums.mean.resize(picture.coverage.len(), 0.0);
        sums.mean.iter_mut().zip(&picture.coverage).for_each(|(sum, share)| *sum += share);
    }

    /// Ends a shot and writes what it showed.
    pub fn end(&mut self, shot: &Shot, metrics: &mut Metrics) {
        let sums = core::mem::take(&mut self.sums);
        let frames = sums.frames.max(1.0);
        let suffix = if shot.distance == 1.0 && self.shots == 1 {
            String::new()
        } else {
            format!("@{}", shot.distance)
        };
        let mut put = |name: &str, value: f64| {
            metrics.insert(format!("{name}{suffix}"), value);
        };
        let flips = [("flips.pixel", sums.flips), ("flips.surface", sums.surface)];
        let flips = flips.into_iter().filter(|(_, [_, compared])| *compared > 0.0);
        let flips = flips.map(|(name, [changed, compared])| (name, changed / compared));
        if shot.cause != Cause::All {
            metrics.extend(flips.map(|(name, share)| (format!("{name}.{}", shot.cause.name()), share)));
            return;
        }
        put("coverage", sums.coverage / frames);
        for (region, [found, right]) in self.regions.iter().zip(&sums.regions) {
            put(&format!("coverage.{}", region.name), found / frames);
            if sums.truth.is_some() {
                put_ratio(&mut put, &format!("coverage_ratio.{}", region.name), *found, *right);
            }
        }
        flips.for_each(|(name, share)| put(name, share));
        let [changed, compared] = sums.changed;
        if compared > 0.0 {
            put("changed", changed / compared / (sums.coverage / frames).max(f64::MIN_POSITIVE));
        }
        let [run_x, run_y] = sums.runs.map(Runs::length);
        put("run_x", run_x);
        put("run_y", run_y);
        put("run_ratio", run_y / run_x.max(f64::MIN_POSITIVE));
        if let Some([ghosts, all]) = sums.ghosts {
            put("ghosting", ghosts / all.max(f64::MIN_POSITIVE));
            put("swing", swing(&sums.latest, &sums.touched));
        }
        if let Some(open) = &sums.open {
            put("open", open.rays[1] as f64 / open.rays[0].max(1) as f64);
            if open.flips[1] > 0.0 {
                put("open_flips", open.flips[0] / open.flips[1]);
            }
            let [x, y] = open.runs.map(Runs::length);
            put("open_run_ratio", y / x.max(f64::MIN_POSITIVE));
        }
        for (name, sum) in &sums.depth {
            put(name, sum / frames);
        }
        if let Some(layers) = sums.layers {
            put("layer_correlation", layers.covariance / layers.deviation.max(f64::MIN_POSITIVE));
        }
        for (name, [shown, right]) in ["gaze", "periphery"].iter().zip(sums.gaze.into_iter().flatten()) {
            put_ratio(&mut put, &format!("coverage_ratio.{name}"), shown, right);
        }
        if let Some(errors) = &sums.truth {
            put_ratio(&mut put, "coverage_ratio", sums.coverage, errors.coverage);
            put("rmse", errors.rmse / frames);
            put("rmse_coverage", errors.rmse_coverage / frames);
            put("rmse.object", errors.object[0] / frames);
            put("rmse_coverage.object", errors.object[1] / frames);
            put("ssim", errors.ssim / frames);
            put("rmse_of_mean", root_mean_square(&sums.mean, &errors.mean) / frames);
        }
    }
}

/// Puts the share that a coverage has of what is right: 1 where both are nothing, and no number where only the second is.
fn put_ratio(put: &mut impl FnMut(&str, f64), name: &str, shown: f64, right: f64) {
    if right > 0.0 {
        put(name, shown / right);
    } else if shown == 0.0 {
        put(name, 1.0);
    }
}

fn add_around(gaze: &Gaze, picture: &Picture, truth: &Picture, sums: &mut [[f64; 2]; 2]) {
    let width = picture.size[0] as usize;
    for (at, (&shown, &right)) in picture.coverage.iter().zip(&truth.coverage).enumerate() {
        let place = [at % width, at / width].map(|along| along as f64 + 0.5);
        let outside = usize::from(!gaze.is_near(place));
        sums[outside][0] += f64::from(shown);
        sums[outside][1] += f64::from(right);
    }
}

/// The mean coverage of the pixels of a region.
fn within(region: &Region, picture: &Picture) -> f64 {
    let [columns, rows] = [0, 1].map(|axis| {
        let end = region.corner[axis].saturating_add(region.size[axis]).min(picture.size[axis]);
        region.corner[axis]..end
    });
    let of_row = |y: u32| columns.clone().map(move |x| y * picture.size[0] + x);
    let shares: Vec<f64> = rows.flat_map(of_row).map(|at| f64::from(picture.coverage[at as usize])).collect();
    shares.iter().sum::<f64>() / shares.len().max(1) as f64
}

fn root_mean_square(a: &[f32], b: &[f32]) -> f64 {
    let squares: f64 = a.iter().zip(b).map(|(a, b)| f64::from(a - b) * f64::from(a - b)).sum();
    (squares / a.len().max(1) as f64).sqrt()
}

/// Structural similarity of luminance, 1 for equal pictures.
fn similarity(a: &Picture, b: &Picture) -> f64 {
    let grey = |picture: &Picture| -> GrayImage { image::DynamicImage::from(picture.to_rgb()).to_luma8() };
    image_compare::gray_similarity_structure(&Algorithm::MSSIMSimple, &grey(a), &grey(b))
        // Pictures of one scene have one size.
        .map_or(f64::NAN, |similarity| similarity.score)
}

/// Frames over which a swing is measured: as many as temporal antialiasing commonly has.
const CYCLE: usize = 8;

fn swing(latest: &VecDeque<Vec<f32>>, touched: &[bool]) -> f64 {
    let pixels: Vec<usize> = (0..touched.len()).filter(|&at| touched[at]).collect();
    let of = |&at: &usize| {
        let shares = latest.iter().map(|frame| frame[at]);
        let (least, most) = shares.fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), s| (a.min(s), b.max(s)));
        f64::from(most - least)
    };
    pixels.iter().map(of).sum::<f64>() / pixels.len().max(1) as f64
}

impl OpenSums {
    fn add(&mut self, size: [usize; 2], rays: &[[u16; 2]]) {
        let share = |&[rays, open]: &[u16; 2]| (rays > 0).then(|| f32::from(open) / f32::from(rays));
        let now: Vec<Option<f32>> = rays.iter().map(share).collect();
        for [rays, open] in rays {
            self.rays = [self.rays[0] + u64::from(*rays), self.rays[1] + u64::from(*open)];
        }
        for (before, now) in self.before.iter().zip(&now) {
            if let (Some(before), Some(now)) = (before, now) {
                self.flips = [self.flips[0] + f64::from((before - now).abs()), self.flips[1] + 1.0];
            }
        }
        runs(size, |at| now[at].map(|share| share >= 0.5), &mut self.runs);
        self.before = now;
    }
}

/// Runs of pixels along an axis that are seen alike.
#[derive(Clone, Copy, Debug, Default)]
struct Runs {
    /// Neighbours that both are seen, and those of them that are seen differently.
    pairs: f64,
    differ: f64,
    /// Pixels that are seen, and stretches of them without a gap.
    pixels: f64,
    stretches: f64,
}

impl Runs {
    /// The mean length of a run, in pixels: by how often neighbours differ, so that a run which a border cuts is not taken for a short
    /// one; and no longer than a stretch.
    fn length(self) -> f64 {
        let stretch = self.pixels / self.stretches.max(1.0);
        if self.differ > 0.0 { stretch.min(self.pairs / self.differ) } else { stretch }
    }
}

/// Counts runs of pixels along each axis.
fn runs([width, height]: [usize; 2], seen: impl Fn(usize) -> Option<bool>, runs: &mut [Runs; 2]) {
    for y in 0..height {
        for x in 0..width {
            let Some(here) = seen(y * width + x) else { continue };
            let left = (x > 0).then(|| seen(y * width + x - 1)).flatten();
            let above = (y > 0).then(|| seen((y - 1) * width + x)).flatten();
            for (before, runs) in [left, above].into_iter().zip(runs.iter_mut()) {
                runs.pixels += 1.0;
                match before {
                    None => runs.stretches += 1.0,
                    Some(before) => {
                        runs.pairs += 1.0;
                        runs.differ += f64::from(u8::from(before != here));
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(coverage: Vec<f32>) -> Frame {
        let colour = coverage.iter().map(|&share| [share; 3]).collect();
        let touched = vec![true; coverage.len()];
        Frame { picture: Picture { size: [16, 16], colour, coverage }, touched, ..Frame::default() }
    }

    fn stripes(period: usize) -> Vec<f32> {
        (0..256).map(|at| f32::from(u8::from((at % 16 / period).is_multiple_of(2)))).collect()
    }

    const SHOT: Shot = Shot { cause: Cause::All, distance: 1.0 };

    #[test]
    fn a_picture_that_is_the_truth_has_no_error_and_one_that_is_not_has() {
        let truth = frame(stripes(2)).picture;
        let mut metrics = Metrics::default();
        for (coverage, right) in [(stripes(2), true), (stripes(1), false)] {
            let mut measured = Measured::default();
            measured.begin();
            measured.add(&frame(coverage), Some(&truth), None, Asked::default());
            measured.end(&SHOT, &mut metrics);
            for error in ["rmse", "rmse_of_mean", "rmse.object", "rmse_coverage.object"] {
                assert_eq!(metrics[error] == 0.0, right, "{error}");
            }
            assert_eq!((metrics["ssim"] - 1.0).abs() < 1e-9, right, "{}", metrics["ssim"]);
            assert_eq!(metrics["coverage_ratio"], 1.0);
        }
        assert!(!metrics.contains_key("flips.pixel") && !metrics.contains_key("layer_correlation"));
    }

    #[test]
    fn ghosts_and_swings_are_measured_of_takes_that_mix_frames() {
        let (mut measured, mut metrics) = (Measured::default(), Metrics::default());
        let asked = Asked { ghosts: true, ..Asked::default() };
        measured.begin();
        for share in [0.9, 0.2, 0.3, 0.2, 0.3, 0.2, 0.3, 0.2, 0.3] {
            let mut half = frame(vec![share; 256]);
            half.touched[..64].fill(false);
            measured.add(&half, None, None, asked);
        }
        measured.end(&SHOT, &mut metrics);
        assert!((metrics["ghosting"] - 0.25).abs() < 1e-6);
        // The first of nine frames counts no more.
        assert!((metrics["swing"] - 0.1).abs() < 1e-6);
    }

    #[test]
    fn regions_are_measured_alone() {
        let region = |name: &str, corner, size| Region { name: name.to_owned(), corner, size };
        let regions = [region("left", [0, 3], [1, 9]), region("beyond", [2, 8], [40, u32::MAX])];
        let (mut measured, mut metrics) = (Measured::new(&regions, None), Metrics::default());
        measured.begin();
        measured.add(&frame(stripes(1)), Some(&frame(stripes(2)).picture), None, Asked::default());
        measured.end(&SHOT, &mut metrics);
        assert_eq!((metrics["coverage.left"], metrics["coverage_ratio.left"]), (1.0, 1.0));
        assert_eq!((metrics["coverage.beyond"], metrics["coverage"]), (0.5, 0.5));
        assert_eq!(metrics["coverage_ratio.beyond"], 7.0 / 6.0);
    }

    #[test]
    fn runs_and_flips_are_counted() {
        let mut measured = Measured::default();
        let mut metrics = Metrics::default();
        measured.begin();
        measured.add(&frame(stripes(2)), None, None, Asked::default());
        measured.add(
            &frame(stripes(2).iter().map(|share| 1.0 - share).collect()),
            None,
            None,
            Asked::default(),
        );
        measured.end(&SHOT, &mut metrics);
        assert_eq!(metrics["flips.pixel"], 1.0);
        // Every pixel changes, half of them are covered.
        assert_eq!(metrics["changed"], 2.0);
        // Seven edges among fifteen neighbours of a row; a column is one run, which ends with the image.
        assert!((metrics["run_x"] - 15.0 / 7.0).abs() < 1e-12);
        assert_eq!(metrics["run_y"], 16.0);
    }

    #[test]
    fn errors_are_measured_where_the_object_is() {
        let mut quarter = frame(stripes(1));
        (0..256).for_each(|at| quarter.touched[at] = at < 64);
        let mut truth = frame(stripes(1)).picture;
        truth.coverage[..32].iter_mut().for_each(|share| *share = 1.0 - *share);
        let (mut measured, mut metrics) = (Measured::default(), Metrics::default());
        measured.begin();
        measured.add(&quarter, Some(&truth), None, Asked::default());
        measured.end(&SHOT, &mut metrics);
        // Half of the touched pixels are wrong, an eighth of all.
        assert!((metrics["rmse_coverage.object"] - 0.5_f64.sqrt()).abs() < 1e-9);
        assert!((metrics["rmse_coverage"] - 0.125_f64.sqrt()).abs() < 1e-9);
    }
}
