//! `docs/recommendation.md` has what is measured of the recommended thresholds, beside the listings and between other scales.
//!
//! `HASHED_ALPHA_BLESS=all cargo test --test main recommendation::` writes the tables anew.

use hashed_alpha::check::Subject;
use hashed_alpha::check::grain::{self, Plane};
use hashed_alpha::check::motion::{self, Motion};
use hashed_alpha::check::scale_policy::ScalePolicy;
use hashed_alpha::check::subject::Precision;
use hashed_alpha::report::cost::page::replaced;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::robust::{Join, Preset, Robust};
use hashed_alpha::threshold::two_scale::Variant;
use std::path::Path;

/// What a row of the page has.
#[derive(Clone)]
struct Row {
    name: String,
    /// At an alpha of 1/2: on axis planes and at a grazing angle.
    grain: [f64; 2],
    flips_an_octave: f64,
    /// At the greatest stretch.
    runs: [f64; 2],
    flips: [f64; 2],
    /// The greatest share of points that change at once, for each motion.
    worst: [f64; 4],
}

const HEAD: &str = "\
| threshold | grain, axis plane / grazing | flips an octave | runs at 83 degrees, across / along | flips at 1/8 pixel there, across / along | most points at once: zoom / roll / orbit / tilt |
|---|---|---|---|---|---|
";

impl Row {
    fn new(name: &str, subject: &Subject<'_>) -> Self {
        let found = grain::grain(subject, 0).expect("a threshold of every fragment");
        let grain = [Plane::Axis, Plane::Grazing].map(|plane| {
            let is_half = |found: &&grain::Grain| found.plane == plane && found.alpha == 0.5;
            found.iter().find(is_half).expect("an alpha of 1/2").grain
        });
        let zoom = grain::zoom_flips(subject, 0).expect("a threshold of every fragment");
        let runs =
            *motion::runs(subject, 0).expect("a threshold of every fragment").last().expect("stretches");
        let pops = motion::pops(subject, 0).expect("a threshold of every fragment");
        Self {
            name: name.to_owned(),
            grain,
            flips_an_octave: zoom.iter().find(|found| found.alpha == 0.5).expect("an alpha of 1/2").flips,
            runs: runs.lengths,
            flips: runs.flips,
            worst: Motion::ALL
                .map(|motion| pops.iter().find(|pops| pops.motion == motion).expect("every motion").worst),
        }
    }

    fn markdown(&self) -> String {
        let Self { name, grain: [axis, grazing], flips_an_octave, runs, flips, worst } = self;
        let worst = worst.map(|share| format!("{:.1} %", 100.0 * share)).join(" / ");
        format!(
            "| {name} | {axis:.2} / {grazing:.2} | {flips_an_octave:.3} | {:.1} / {:.1} | {:.3} / {:.3} | {worst} |\n",
            runs[0], runs[1], flips[0], flips[1]
        )
    }
}

/// Writes tables between their marks in the page where that is wanted, and compares them otherwise.
fn keep(tables: [(&str, &[Row]); 2]) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/recommendation.md");
    let page = std::fs::read_to_string(&file).expect("the page");
    let written = tables.into_iter().fold(page.clone(), |page, (mark, rows)| {
        let table: String = std::iter::once(HEAD.to_owned()).chain(rows.iter().map(Row::markdown)).collect();
        replaced(&page, mark, &table).expect("marks in the page")
    });
    if std::env::var_os("HASHED_ALPHA_BLESS").is_some() {
        std::fs::write(&file, written).expect("the page can be written");
    } else {
        assert!(written == page, "HASHED_ALPHA_BLESS=all cargo test --test main recommendation::\n{written}");
    }
}

fn policy(name: &str, policy: ScalePolicy) -> Row {
    let robust = Robust::recommended(Preset::of(policy.variant()));
    let threshold =
        move |footprint: &Footprint<f32>| robust.threshold(&policy.applied(footprint)).expect("finite");
    Row::new(name, &Subject::of_f32("policy", policy.variant(), threshold))
}

/// The steady preset changes least, nothing of it changes at once, and no scale between one and three is better at everything.
#[test]
fn the_page_has_what_is_measured_and_the_presets_keep_what_they_promise() {
    let listing = |variant| Subject::hashed("listing", Precision::F32, HashedAlpha::listing(variant));
    let robust = |robust: Robust| Subject::of_model("robust", Precision::F32, robust);
    let dithered = |variant| robust(Robust { join: Join::Dithered, ..Robust::new(variant) });
    let [steady, smooth] = Preset::ALL.map(|preset| robust(Robust::recommended(preset)));
    let presets = [
        Row::new("**steady**", &steady),
        Row::new("**smooth**", &smooth),
        Row::new("Listing 1", &listing(Variant::Isotropic)),
        Row::new("one scale, `dithered`", &dithered(Variant::Isotropic)),
        Row::new("one scale an axis, `dithered`", &dithered(Variant::Anisotropic)),
    ];
    let [steady, smooth, listing, ..] = &presets;
    let named = |row: &Row, name: &str| Row { name: name.to_owned(), ..row.clone() };
    let scales = [
        named(steady, "the longer derivative, `inherit` (steady)"),
        policy("the root of their mean square, `inherit`", ScalePolicy::RootMeanSquare),
        policy("the root of their area, `inherit`", ScalePolicy::Area),
        policy("the shorter derivative, `inherit`", ScalePolicy::Shorter),
        policy("each axis, at least 1/2 of the longest, `copula`", ScalePolicy::EachAxis(0.5)),
        policy("each axis, at least 1/8, `copula`", ScalePolicy::EachAxis(0.125)),
        named(smooth, "each axis, at least 1/32, `copula` (smooth)"),
    ];
    keep([("presets", &presets), ("scales", &scales)]);

    assert!(steady.worst.iter().all(|&share| share <= 0.05), "{:?}", steady.worst);
    assert!(smooth.worst[0] <= 0.05 && smooth.worst[1] <= 0.05, "{:?}", smooth.worst);
    assert!(steady.flips_an_octave < 0.8 * listing.flips_an_octave);
    assert!(smooth.runs[0] < 0.5 * steady.runs[0] && smooth.grain[1] < 0.5 * steady.grain[1]);
    let numbers = |row: &Row| {
        let Row { grain: [_, grazing], flips_an_octave, runs: [across, _], flips: [a, b], .. } = *row;
        [grazing, flips_an_octave, across, a, b]
    };
    for (at, one) in scales.iter().enumerate() {
        for other in scales[at + 1..].iter().chain(&scales[..at]) {
            let pairs = || numbers(one).into_iter().zip(numbers(other));
            let is_as_good = pairs().all(|(one, other)| one <= 1.01 * other);
            let is_better = pairs().any(|(one, other)| one < 0.99 * other);
            assert!(!(is_as_good && is_better), "{} beats {}", one.name, other.name);
        }
    }
}
