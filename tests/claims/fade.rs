//! Noise that fades in: §7.1.

use crate::measure::{CHIS, chis, list, mean, visible};
use crate::row::{Measured, Row, judge};
use hashed_alpha::threshold::fade_in::{anisotropy, anisotropy_literal, blend, fade_in};

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
    let wrong = chis().filter(|&chi| fade_in(chi, 0.0) != 0.5 || fade_in(chi, 1.0) != chi).count();
    judge(CHIS, wrong == 0, false, format!("{wrong} of {CHIS} thresholds differ from either"))
}

fn fade_keeps() -> Measured {
    let kept = |lod: f64| mean(chis().map(|chi| visible(0.3, fade_in(chi, blend(lod, 6.0)))));
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

fn grazing() -> Measured {
    // Sixteen times as long as wide: level 1.5 is read where the longer side has level 5.5.
    let factor = anisotropy([16.0, 1.0]);
    let kept = |lod: f64| mean(chis().map(|chi| visible(0.3, fade_in(chi, blend(lod, 6.0)))));
    let (without, with) = (kept(1.5), kept(factor * 1.5));
    let seen = format!(
        "alpha 0.3, level 1.5, anisotropy 16, n = 6: kept {without:.3} by Eq. 5, {with:.3} with the factor"
    );
    judge(2 * CHIS, without == 0.0 && (with - 0.3).abs() < 0.01, false, seen)
}

fn anisotropy_of_all() -> Measured {
    let lengths = [0.0, 1e-30, 0.25, 1.0, 4.0, 1e30];
    let pairs = lengths.into_iter().flat_map(|x| lengths.into_iter().map(move |y| [x, y]));
    let (with_zero, without): (Vec<_>, Vec<_>) = pairs.partition(|pair| pair.contains(&0.0));
    let wrong =
        |pairs: &[[f64; 2]]| pairs.iter().filter(|pair| !anisotropy_literal(**pair).is_finite()).count();
    let seen = format!(
        "not finite for {} of {} pairs with a 0 among them, for {} of {} others",
        wrong(&with_zero),
        with_zero.len(),
        wrong(&without),
        without.len()
    );
    judge(36_u64, wrong(&with_zero) == 0, wrong(&without) == 0, seen)
}
