//! `docs/joins.md` has the grain and the flips of every join as they are measured.
//!
//! `HASHED_ALPHA_BLESS=all cargo test --test main joins::` writes them anew.

use glam::dvec3;
use hashed_alpha::check::Subject;
use hashed_alpha::check::grain::Plane;
use hashed_alpha::check::predict::pair_law::PairLaw;
use hashed_alpha::check::subject::Precision;
use hashed_alpha::report::grain::{MARKDOWN_HEAD, Measured};
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::robust::{Join, Robust};
use hashed_alpha::threshold::two_scale::Variant;
use std::path::Path;

/// The joins of each variant: with one scale an axis that of the paper jumps.
const ISOTROPIC: [Join; 4] = Join::ALL;
const ANISOTROPIC: [Join; 3] = [Join::Copula, Join::Dithered, Join::Inherit];

fn subject(variant: Variant, join: Join) -> Subject<'static> {
    Subject::of_model("robust", Precision::F32, Robust { join, ..Robust::new(variant) })
}

fn measured(variant: Variant, join: Join) -> Measured {
    Measured::new(&subject(variant, join), 0).expect("a threshold of every fragment")
}

/// What lies between the marks of the page, and the page without it.
fn marked(page: &str) -> [&str; 3] {
    let (before, rest) = page.split_once("joins:: -->\n").expect("the mark before the table");
    let (table, after) = rest.split_once("<!-- end -->").expect("the mark behind the table");
    [before, table, after]
}

#[test]
fn the_page_has_what_is_measured_and_nesting_keeps_what_it_promises() {
    let isotropic = ISOTROPIC.map(|join| (join, measured(Variant::Isotropic, join)));
    let anisotropic = ANISOTROPIC.map(|join| (join, measured(Variant::Anisotropic, join)));
    let mut table = format!("{MARKDOWN_HEAD}\n");
    for (join, measured) in &isotropic {
        table += &(measured.markdown(&format!("one scale, `{join}`")) + "\n");
    }
    for (join, measured) in &anisotropic {
        table += &(measured.markdown(&format!("one scale an axis, `{join}`")) + "\n");
    }
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/joins.md");
    let page = std::fs::read_to_string(&file).expect("the page");
    let [before, committed, after] = marked(&page);
    if std::env::var_os("HASHED_ALPHA_BLESS").is_some() {
        let page = format!("{before}joins:: -->\n{table}<!-- end -->{after}");
        std::fs::write(&file, page).expect("the page can be written");
    } else {
        assert_eq!(committed, table, "HASHED_ALPHA_BLESS=all cargo test --test main joins::");
    }

    let [_, _, (_, dithered), (_, inherit)] = &isotropic;
    for ((before, after), most) in
        dithered.grain.iter().zip(&inherit.grain).zip([0.95, 0.75, 0.7].into_iter().cycle())
    {
        // Three standard errors of a difference.
        let chance = 3.0 * (before.error * before.error + after.error * after.error).sqrt();
        // Of the grain of cells that are independent: on planes along two axes so much, elsewhere no more.
        let most = if after.plane == Plane::Axis { most * before.grain } else { before.grain } + chance;
        assert!(after.grain <= most, "{after:?}, {most}");
        if after.plane == Plane::Axis {
            assert!(after.flips <= 1.2 * before.flips, "{after:?}, {before:?}");
        }
    }
    for found in &inherit.zoom {
        let expected = 0.75 * 2.0 * found.alpha * (1.0 - found.alpha);
        assert!((found.flips / expected - 1.0).abs() < 0.01 + 4.0 * found.error / expected, "{found:?}");
    }
    let [_, (_, dithered), (_, inherit)] = &anisotropic;
    for (before, after) in dithered.zoom.iter().zip(&inherit.zoom) {
        assert!(after.flips < 0.55 * before.flips, "{after:?}, {before:?}");
    }
}

/// What nesting does to layers one and two cells apart, as the page says it.
#[test]
fn layers_of_one_parent_are_not_independent() {
    let subject = subject(Variant::Isotropic, Join::Inherit);
    let pixel = 1.0 / 64.0;
    let view = Footprint {
        position: dvec3(0.0, 0.0, 0.0),
        dpdx: dvec3(pixel, 0.0, 0.0),
        dpdy: dvec3(0.0, pixel, 0.0),
    };
    let both = |cells: f64| {
        let pair = PairLaw::new(&subject, &subject.nominal(&view), dvec3(0.0, 0.0, cells * pixel));
        0.25 + 0.25 * pair.visibility_correlation(0.5)
    };
    let page = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/joins.md"))
        .expect("the page");
    for cells in [1.0, 2.0] {
        let said = format!("{:.3}", both(cells));
        assert!(page.contains(&said), "{cells} cells apart: {said}");
    }
}
