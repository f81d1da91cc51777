//! Noise that fades in: §7.1.

use crate::measure::{CHIS, chis, list, mean, percent, share, visible};
use crate::row::{Measured, Row, judge};
use hashed_alpha::threshold::stage::fade_in::{anisotropy, anisotropy_literal, blend, fade_in};

pub const ROWS: &[Row] = &[
    Row {
        id: "fade.ends",
        place: "§7.1, Eqs. 3, 4",
        sentence: "The blend goes from the traditional test at b = 0 to the hashed one at b = 1.",
        measure: fade_ends,
    },
    Row {
        id: "fade.keeps",
        place: "§7.1, Fig. 12",
        sentence: "Fading the noise in keeps distant geometry.",
        measure: fade_keeps,
    },
    Row {
        id: "fade.quadratic",
        place: "§7.1, Eq. 5",
        sentence: "A linear ramp keeps more noise near the camera than a quadratic one.",
        measure: quadratic,
    },
    Row {
        id: "fade.grazing",
        place: "§7.1.1",
        sentence: "Eq. 5 fails at grazing angles; scaling the level by the anisotropy fixes it.",
        measure: grazing,
    },
    Row {
        id: "fade.anisotropy",
        place: "§7.1.1",
        sentence: "The larger ratio of the two texture derivatives is the degree of anisotropy.",
        measure: anisotropy_of_all,
    },
];

fn fade_ends() -> Measured {
    let wrong = chis().filter(|&chi| fade_in(0.5, chi, 0.0) != 0.5 || fade_in(0.5, chi, 1.0) != chi).count();
    judge(CHIS, wrong == 0, false, format!("{wrong} of {CHIS} thresholds differ from either"))
}

fn fade_keeps() -> Measured {
    let kept = |lod: f64| mean(chis().map(|chi| visible(0.3, fade_in(0.5, chi, blend(lod, 6.0)))));
    let lods = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    let shares = lods.map(kept);
    let seen = format!(
        "alpha 0.3, n = 6, kept at levels 1 to 6: {}; alpha below (1 - b) / 2 vanishes while the noise fades in",
        list(shares)
    );
    judge(6 * CHIS, shares.iter().all(|s| *s > 0.25), (shares[5] - 0.3).abs() < 0.01, seen)
}

fn quadratic() -> Measured {
    let lods = [1.0, 2.0, 3.0, 4.0, 5.0];
    let (square, line) = (lods.map(|lod| blend(lod, 6.0)), lods.map(|lod| lod / 6.0));
    let seen =
        format!("share of noise at levels 1 to 5 of 6: quadratic {}, linear {}", list(square), list(line));
    judge(5_u64, square.iter().zip(&line).all(|(a, b)| a < b), false, seen)
}

/// The share of alpha 0.3 that is kept at a level, with n = 6.
fn kept_at(lod: f64) -> f64 {
    mean(chis().map(|chi| visible(0.3, fade_in(0.5, chi, blend(lod, 6.0)))))
}

fn grazing() -> Measured {
    let levels: Vec<f64> = (1..=10).map(|half| 0.5 * f64::from(half)).collect();
    let ratios = [2.0, 4.0, 8.0, 16.0_f64];
    let pairs: Vec<(f64, f64)> =
        ratios.iter().flat_map(|&r| levels.iter().map(move |&lod| (r, lod))).collect();
    // What a fragment of this alpha keeps where all is noise, but for a tenth.
    let is_kept = |lod: f64| kept_at(lod) > 0.27;
    let scaled = |&(r, lod): &(f64, f64)| anisotropy([r, 1.0]) * lod;
    let (without, with) = (
        share(pairs.iter().map(|(_, lod)| is_kept(*lod))),
        share(pairs.iter().map(|pair| is_kept(scaled(pair)))),
    );
    let far = share(pairs.iter().filter(|pair| scaled(pair) >= 6.0).map(|pair| is_kept(scaled(pair))));
    let [half, one] = [0.5, 1.0].map(|lod| ratios.map(|r| kept_at(r * lod)));
    let seen = format!(
        "alpha 0.3, n = 6, anisotropy 2, 4, 8, 16 at levels 0.5 to 5: kept in {} of the pairs by Eq. 5, in {} with the factor, \
         in {} where anisotropy times level reaches n; below it goes on vanishing: kept {} at level 0.5, {} at level 1",
        percent(without),
        percent(with),
        percent(far),
        list(half),
        list(one)
    );
    judge(
        2 * pairs.len() as u64 * u64::from(CHIS),
        without == 0.0 && with == 1.0,
        without < with && far == 1.0,
        seen,
    )
}

/// How long a footprint is over how wide, by the singular values of its two derivatives.
fn elongation([[a, b], [c, d]]: [[f64; 2]; 2]) -> f64 {
    let (squares, area) = (a * a + b * b + c * c + d * d, (a * d - b * c).abs());
    let root = (squares * squares - 4.0 * area * area).max(0.0).sqrt();
    (0.5 * (squares + root)).sqrt() / (0.5 * (squares - root)).sqrt()
}

/// The ratio of lengths over the elongation, for a texture that is stretched along an axis of the image turned by so many
/// degrees.
fn ratio_of_lengths(stretch: f64, degrees: f64) -> f64 {
    let (sine, cosine) = (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()));
    let columns = [[stretch * cosine, sine], [-stretch * sine, cosine]];
    anisotropy_literal(columns.map(|[x, y]| libm::hypot(x, y))) / elongation(columns)
}

fn anisotropy_of_all() -> Measured {
    let over = |degrees: f64| [2.0, 4.0, 8.0, 16.0].map(|stretch| ratio_of_lengths(stretch, degrees));
    let [straight, slanted, diagonal] = [0.0, 20.0, 45.0].map(over);
    let sheared = [[1.0, 0.0], [0.99, 0.14]];
    let lengths = sheared.map(|[x, y]| libm::hypot(x, y));
    let without_length = [anisotropy_literal([0.0, 1.0]), anisotropy_literal([0.0, 0.0])];
    let seen = format!(
        "over the elongation of the footprint, stretched 2, 4, 8, 16 times: {} along an axis of the image, {} at 20 degrees, {} \
         at 45; derivatives (1, 0) and (0.99, 0.14): {:.1} for {:.1}; with one or both of no length: {}, {}",
        list(straight),
        list(slanted),
        list(diagonal),
        anisotropy_literal(lengths),
        elongation(sheared),
        without_length[0],
        without_length[1]
    );
    let is_right = |ratios: [f64; 4]| ratios.iter().all(|ratio| (ratio - 1.0).abs() < 0.05);
    judge(14_u64, is_right(straight) && is_right(slanted) && is_right(diagonal), is_right(straight), seen)
}
