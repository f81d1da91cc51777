//! Whether what flips together lies together: the number of flips in blocks of cells, against cells that flip alone.

use crate::check::evidence::ComparedShare;
use crate::check::input::{Block, cube};
use crate::check::tolerance::{POWER, SINGLE_LEVEL};
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::stats::clusters::{self, Clusters};
use crate::threshold::two_scale::Variant;

/// Cells that are seen in two views, 64 x 32 x 32: 1024 blocks of 8 x 8 cells.
const SEEN_CELLS: usize = 1 << 16;

/// Fewest cells whatever budget: no side of a block is below 16 cells.
const FEWEST_CELLS: usize = 1 << 14;

/// Lerp factors of the first view.
const FROM: [f64; 3] = [0.0, 0.25, 0.5];

/// How many octaves finer the second view is: a seventh of the thresholds passes an alpha of 1/2, so that a block of 64 has
/// some nine flips.
const ZOOM: f64 = 0.5;

/// Alphas whose flips are counted.
const ALPHAS: [f64; 2] = [0.25, 0.5];

/// Cells of a block along each axis of space.
const SHAPES: [[usize; 3]; 7] =
    [[8, 8, 1], [8, 1, 8], [1, 8, 8], [16, 16, 1], [16, 1, 16], [1, 16, 16], [8, 8, 8]];

/// Tests where every block has flips enough.
const POSSIBLE: usize = FROM.len() * ALPHAS.len() * SHAPES.len();

/// Flips that come in blocks.
pub const CLUSTER: Claim = Claim {
    id: "flips.cluster",
    anchor: "§5.4.2 (interpolating between two scales); not in the paper",
    statement: "while the camera comes closer, fragments of one alpha appear or disappear each for itself: in blocks of 8 x 8, \
                16 x 16 and 8 x 8 x 8 cells the number of flips varies no more than if cells flipped independently",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.06)),
    run: cluster,
};

fn cluster(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    if subject.join.switches() && subject.variant == Variant::Anisotropic {
        // Measured: a correlation of 0.023 in blocks of 8 x 8 cells.
        let reason = "with a scale an axis a join that takes one of two octaves draws one octave for each interval of an axis: slabs of cells flip \
                      together, which is its price";
        return Ok(Trial::without(Conclusion::NotApplicable, reason));
    }
    let mut rng = draw.rng(CLUSTER.id);
    let (mut worst, mut tests, mut n): (Option<(Clusters, String)>, _, _) = (None, 0, 0);
    let (mut points, mut detectable) = (Vec::new(), f64::INFINITY);
    let cells = draw.samples(SEEN_CELLS).max(FEWEST_CELLS);
    for from in FROM {
        let block = Block::draw(cube(cells.ilog2(), &mut rng), &mut rng);
        let seen_at = |fraction: f64| block.seen_at(fraction).thresholds(subject);
        let (before, after) = (seen_at(from)?, seen_at(from + ZOOM)?);
        n += before.len() as u64;
        for alpha in ALPHAS {
            let flips: Vec<bool> =
                before.iter().zip(&after).map(|(a, b)| (*a <= alpha) != (*b <= alpha)).collect();
            for shape in SHAPES {
                let Some(found) = clusters::clusters(&flips, block.size, shape) else { continue };
                tests += 1;
                detectable = detectable.min(found.detectable(SINGLE_LEVEL / POSSIBLE as f64, POWER));
                let [x, y, z] = shape;
                points.push(ComparedShare {
                    series: format!("lerp factor {from}, alpha {alpha}"),
                    x: (x * y * z) as f64,
                    measured: found.ratio,
                    predicted: 1.0,
                    sigma: found.sigma,
                });
                if worst.as_ref().is_none_or(|(least, _)| found.p < least.p) {
                    let seen = format!(
                        "octave {}, lerp factor {from} to {}: of alpha {alpha}, blocks of ({x}, {y}, {z}) cells have flips \
                         whose variance is {:.3} times that of cells that flip alone",
                        block.octave,
                        from + ZOOM,
                        found.ratio
                    );
                    worst = Some((found, seen));
                }
            }
        }
    }
    let Some((found, seen)) = worst else {
        return Ok(Trial::without(Conclusion::Inconclusive, "too few thresholds flip to fill blocks"));
    };
    Ok(Trial {
        conclusion: Conclusion::Probability((f64::from(tests) * found.p).min(1.0)),
        statistic: Some(found.ratio),
        statistic_name: format!("variance over that of independent flips, worst of {tests}"),
        n,
        effect: Some(found.correlation()),
        effect_name: "correlation of flips in a block",
        detectable: Some(detectable),
        seen,
        evidence: Evidence::Quantity { abscissa: "cells of a block", ordinate: "variance of flips", points },
    })
}
