//! The paper's claims about its own listings, one named trial each.
//!
//! A claim that a listing is known to fail stands in `check::known`; its trial demands that it is still rejected, and by as much as
//! was measured. `HASHED_ALPHA_BLESS=all cargo test --test paper` measures the sizes anew, the name of a form in place of
//! `all` those of one form; both try nothing.

use hashed_alpha::check::known::{Known, OF_THE_LISTINGS};
use hashed_alpha::check::shaders::interpreted;
use hashed_alpha::check::subject::Precision;
use hashed_alpha::check::{
    Budget, Claim, Draw, Outcome, Reach, RestsOn, Results, Standing, Subject, Suite, Verdict, claims,
    run_claims,
};
use hashed_alpha::shader::interpreter::DeviceModel;
use hashed_alpha::shader::own::{self, Language, Options};
use hashed_alpha::threshold::emulated::{Emulated, ReducedSine};
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::real::Real;
use hashed_alpha::threshold::two_scale::Variant;
use libtest_mimic::{Arguments, Trial};
use std::fmt::Write as _;
use std::path::Path;

/// A form of the listings whose failures are as much the listings' own.
struct Form {
    name: &'static str,
    /// For which reasons it is measured.
    is_for: fn(RestsOn) -> bool,
    /// Seeds over which a size is measured at a budget.
    seeds: [(Budget, u64); 2],
    subjects: fn() -> Vec<Subject<'static>>,
}

/// The listings as they are, on a device whose clamp makes NaN the lower bound, and with a device's sine of large arguments.
const FORMS: [Form; 3] = [
    Form {
        name: "literal",
        is_for: |_| true,
        seeds: [(Budget::Quick, 16), (Budget::Ci, 8)],
        subjects: Subject::paper,
    },
    Form {
        name: "clamped",
        is_for: |reason| reason == RestsOn::DivisionByZero,
        seeds: [(Budget::Quick, 4), (Budget::Ci, 2)],
        subjects: || {
            let clamped = |(variant, precision)| {
                let listing = HashedAlpha::listing(variant);
                Subject::new("clamped", precision, variant, move |footprint| {
                    let threshold = match precision {
                        Precision::F32 => f64::from(listing.threshold::<f32>(&footprint.cast())),
                        Precision::F64 => listing.threshold(footprint),
                    };
                    if threshold.is_nan() { LOWER_BOUND } else { threshold }
                })
            };
            let variants = [Variant::Isotropic, Variant::Anisotropic];
            variants.into_iter().flat_map(|v| Precision::ALL.map(|p| (v, p))).map(clamped).collect()
        },
    },
    Form {
        name: "reduced-sine",
        is_for: |reason| reason == RestsOn::SineFarAway,
        seeds: [(Budget::Quick, 8), (Budget::Ci, 4)],
        subjects: || {
            let reduced = |variant| {
                let listing = HashedAlpha::listing(variant);
                Subject::new("reduced sine", Precision::F32, variant, move |footprint| {
                    listing.threshold::<Emulated<ReducedSine>>(&footprint.cast()).to_f64()
                })
            };
            [Variant::Isotropic, Variant::Anisotropic].map(reduced).into()
        },
    },
];

/// The models of devices whose sine is that of the listings.
const EXACT_SINES: [&str; 3] = ["accurate", "flush to zero", "fused"];

/// The clamp of the listings.
const LOWER_BOUND: f64 = 1.0e-6;

/// The listings as shader files.
const LISTING_1: &str = include_str!("../examples/shaders/listing_sine.wgsl");
const LISTING_2: &str = include_str!("../examples/shaders/listing_anisotropic.wgsl");

/// One more defect of a listing: what is written in place of what, in its shader file.
struct Defect {
    name: &'static str,
    variant: Variant,
    /// Words of the file.
    words: &'static str,
    /// What stands there instead.
    instead: &'static str,
}

/// Defects that show in claims which the listings fail, too.
const DEFECTS: [Defect; DEFECTS_COUNT] = [
    isotropic("12 bits", HASH_1, "return floor(4096.0 * hash(vec2<f32>(hash(value.xy), value.z))) / 4096.0;"),
    isotropic(
        "an integer hash of 11 bits",
        HASH_1,
        "var w = bitcast<vec3<u32>>(vec3<i32>(value)) * 1664525u + 1013904223u;
         w.x += w.y * w.z; w.y += w.z * w.x; w.z += w.x * w.y; w ^= w >> vec3<u32>(16u);
         w.x += w.y * w.z; w.y += w.z * w.x; w.z += w.x * w.y;
         return (f32(w.z >> 21u) + 0.5) / 2048.0;",
    ),
    isotropic(
        "zeros five times as often",
        HASH_1,
        "let h = hash(vec2<f32>(hash(value.xy), value.z)); return select(h, 0.0, h > 0.5 && h < 0.502);",
    ),
    isotropic(
        "the cells up to two from the origin are one",
        HASH_1,
        "let v = select(value, vec3<f32>(0.0), all(abs(value + 0.5) < vec3<f32>(3.0)));
         return hash(vec2<f32>(hash(v.xy), v.z));",
    ),
    isotropic(
        "a copy two octaves down",
        HASH_1,
        "let q = floor(0.25 * value); let v = select(value, q, all(4.0 * q == value));
         return hash(vec2<f32>(hash(v.xy), v.z));",
    ),
    isotropic(
        "planes of constant z have a larger bias",
        HASH_1,
        "let h = hash(vec2<f32>(hash(value.xy), value.z)); return pow(h, 0.7 + 0.6 * hash(vec2<f32>(value.z, 3.0)));",
    ),
    isotropic("z read coarsely", HASH_1, "return hash(vec2<f32>(hash(value.xy), floor(0.125 * value.z)));"),
    isotropic(
        "x and y in 10 bits",
        HASH_1,
        "return hash(vec2<f32>(floor(1024.0 * hash(value.xy)) / 256.0, value.z));",
    ),
    isotropic(
        "no number beyond 6000 units",
        SCALE_1,
        "let pix_scale = select(1.0, 0.0, abs(position.x) > 6000.0) / (hash_scale * max_deriv);",
    ),
    isotropic(
        "no number for small pixels far away",
        SCALE_1,
        "let pix_scale = 1.0 / (hash_scale * select(max_deriv, 0.0, abs(position.x) > 1000.0 && max_deriv < 0.02));",
    ),
    isotropic(
        "constant beyond 30 units",
        HASH_1,
        "return hash(vec2<f32>(hash(clamp(value.xy, vec2<f32>(-900.0), vec2<f32>(900.0))), clamp(value.z, -900.0, 900.0)));",
    ),
    isotropic(
        "faces of cells that tremble",
        "hash3D(floor(pix_scales.x * position)),",
        "hash3D(floor(pix_scales.x * (position + 4.0e-6 * sin(1.0e6 * (dpdx + dpdy))))),",
    ),
    anisotropic(
        "a pop in the middle of an octave",
        "let x = (1.0 - weight)",
        "let x = select(0.0, 0.1, weight > 0.5) + 0.9 * (1.0 - weight)",
    ),
    anisotropic(
        "no number beyond 300 units",
        "let weight =",
        "let weight = select(1.0, sqrt(-length(position)), length(position) > 300.0) *",
    ),
    anisotropic(
        "no number for fine pixels",
        "let weight =",
        "let weight = select(1.0, sqrt(-length(position)), length(dpdx) < 2.0e-3) *",
    ),
    anisotropic(
        "12 bits in Listing 2",
        HASH_2,
        "return floor(4096.0 * noise_plane(vec2<f32>(noise_plane(v.xy), v.z))) / 4096.0;",
    ),
    anisotropic(
        "the cells up to two from the origin are one in Listing 2",
        HASH_2,
        "let w = select(v, vec3<f32>(0.0), all(abs(v + 0.5) < vec3<f32>(3.0)));
         return noise_plane(vec2<f32>(noise_plane(w.xy), w.z));",
    ),
    anisotropic(
        "a copy two octaves down in Listing 2",
        HASH_2,
        "let q = floor(0.25 * v); let w = select(v, q, all(4.0 * q == v));
         return noise_plane(vec2<f32>(noise_plane(w.xy), w.z));",
    ),
];
const DEFECTS_COUNT: usize = 18;

/// Lines of the shader files that most defects take the place of.
const HASH_1: &str = "return hash(vec2<f32>(hash(value.xy), value.z));";
const HASH_2: &str = "return noise_plane(vec2<f32>(noise_plane(v.xy), v.z));";
const SCALE_1: &str = "let pix_scale = 1.0 / (hash_scale * max_deriv);";

const fn isotropic(name: &'static str, words: &'static str, instead: &'static str) -> Defect {
    Defect { name, variant: Variant::Isotropic, words, instead }
}

const fn anisotropic(name: &'static str, words: &'static str, instead: &'static str) -> Defect {
    Defect { name, variant: Variant::Anisotropic, words, instead }
}

/// A shader file of a listing, with other words or without, under a device model.
fn port(variant: Variant, [words, instead]: [&str; 2], model: DeviceModel) -> Subject<'static> {
    let text = if variant == Variant::Anisotropic { LISTING_2 } else { LISTING_1 };
    assert!(text.contains(words), "{words}");
    let text = if words.is_empty() { text.to_owned() } else { text.replace(words, instead) };
    let shader =
        own::parse("port.wgsl", Language::Wgsl, text.as_bytes(), &Options::default()).expect("a shader");
    interpreted("port", &shader, model, variant).expect("what is interpreted")
}

/// What the suite of the paper says of a port, by the claims that the listings fail.
fn of_known_claims(subject: Subject<'static>) -> Results {
    let is_known = |claim: &&Claim| OF_THE_LISTINGS.iter().any(|known| known.check == claim.id);
    let claims: Vec<Claim> = claims::ALL.iter().filter(is_known).copied().collect();
    let draw = Draw { budget: Budget::Quick, reach: Reach::Listings, ..Draw::default() };
    Results::new(run_claims(&claims, &[subject], &draw, || {}), Suite::Paper)
}

fn one_more_defect(defect: &'static Defect) -> Trial {
    Trial::test(format!("one more defect: {}", defect.name), move || {
        let words = [defect.words, defect.instead];
        let results = of_known_claims(port(defect.variant, words, DeviceModel::ACCURATE));
        if results.is_consistent() { Err(format!("it is excused: {results}").into()) } else { Ok(()) }
    })
}

fn sound_port(variant: Variant, model: DeviceModel) -> Trial {
    Trial::test(format!("a port of {variant} under {}", model.name()), move || {
        let results = of_known_claims(port(variant, [""; 2], model));
        if results.is_consistent() { Ok(()) } else { Err(results.to_string().into()) }
    })
}

/// Findings that hold for some rows of cells only: a run may have none of them.
const OF_SOME_ROWS: [&str; 1] = ["hash.lags"];

/// Seeds of which one has such a row.
const SEEDS_OF_A_ROW: core::ops::RangeInclusive<u64> = 1..=16;

fn is_rejected_with_another_seed(outcome: &Outcome) -> bool {
    let claim =
        claims::ALL.iter().find(|claim| claim.id == outcome.check && OF_SOME_ROWS.contains(&claim.id));
    let is_meant =
        |subject: &Subject<'_>| subject.name == outcome.subject && subject.precision == outcome.precision;
    let subject = Subject::paper().into_iter().find(is_meant);
    let (Some(claim), Some(subject)) = (claim, subject) else { return false };
    SEEDS_OF_A_ROW.into_iter().any(|seed| {
        let draw = Draw { budget: Budget::Quick, reach: Reach::Listings, ..Draw::seeded(seed) };
        let outcomes = run_claims(&[*claim], core::slice::from_ref(&subject), &draw, || {});
        outcomes.iter().any(|outcome| outcome.verdict == Verdict::Rejected)
    })
}

fn trial(outcome: &Outcome) -> Trial {
    let name = format!("{} {} {}", outcome.check, outcome.subject, outcome.precision);
    let known = OF_THE_LISTINGS.iter().find(|known| known.is_about(outcome)).map(|known| &known.reason);
    let failure = match (outcome.standing(), known) {
        (Standing::Against | Standing::Unanswered, _) => Some(outcome.to_string()),
        (Standing::AsExpected, Some(_)) if is_rejected_with_another_seed(outcome) => None,
        (Standing::AsExpected | Standing::NotApplicable, Some(reason)) => {
            Some(format!("known to be rejected ({reason}), and is not\n{outcome}"))
        }
        (Standing::Known, _) | (Standing::AsExpected | Standing::NotApplicable, None) => None,
    };
    Trial::test(name, move || failure.map_or(Ok(()), |text| Err(text.into())))
}

/// Measures the sizes of all that a form of the listings is known to fail.
fn measured(form: &Form) -> String {
    let mut text = String::new();
    for (budget, seeds) in form.seeds {
        let is_meant = |known: &&Known| known.rests_on.is_some_and(form.is_for);
        let is_known =
            |claim: &&Claim| OF_THE_LISTINGS.iter().filter(is_meant).any(|known| known.check == claim.id);
        let claims: Vec<Claim> = claims::ALL.iter().filter(is_known).copied().collect();
        let subjects = (form.subjects)();
        let run = |seed| {
            run_claims(
                &claims,
                &subjects,
                &Draw { seed, budget, reach: Reach::Listings, ..Draw::default() },
                || {},
            )
        };
        let runs: Vec<Vec<Outcome>> = (0..seeds).map(run).collect();
        for at in 0..runs[0].len() {
            let of_all = || runs.iter().map(|run| &run[at]);
            // A run of few samples does not always reject; its effect is as large.
            let is_rejected = |of: &&Outcome| {
                let is_about = OF_THE_LISTINGS.iter().filter(is_meant).any(|known| known.is_about(of));
                of.verdict == Verdict::Rejected && is_about
            };
            let Some(first) = of_all().find(is_rejected) else { continue };
            let alike = of_all().filter(|of| of.effect_name == first.effect_name);
            let effects: Vec<f64> = alike.filter_map(|of| of.effect).collect();
            let n = effects.len() as f64;
            let mean = effects.iter().sum::<f64>() / n;
            let squares: f64 = effects.iter().map(|effect| (effect - mean) * (effect - mean)).sum();
            let deviation = (squares / (n - 1.0).max(1.0)).sqrt();
            let Outcome { check, variant, precision, .. } = first;
            let key = format!("{check} {variant} {precision} {} {}", budget.name(), form.name);
            let _ = writeln!(text, "{key} {mean:.4e} {deviation:.1e} {n} {}", first.effect_name);
        }
    }
    text
}

fn main() {
    if let Ok(which) = std::env::var("HASHED_ALPHA_BLESS") {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/check/known_sizes.txt");
        let committed = std::fs::read_to_string(&path).unwrap_or_default();
        let sizes = FORMS.iter().map(|form| {
            let is_its = |line: &&str| line.split(' ').nth(4) == Some(form.name);
            let kept = || committed.lines().filter(is_its).map(|line| format!("{line}\n")).collect();
            if which == "all" || which == form.name { measured(form) } else { kept() }
        });
        std::fs::write(path, sizes.collect::<String>()).expect("the source can be written");
        return;
    }
    let outcomes = run_claims(
        claims::ALL,
        &Subject::paper(),
        &Draw { reach: Reach::Listings, ..Draw::default() },
        || {},
    );
    let results = Results::new(outcomes, Suite::Paper);
    // The others fail what the listings do not: their sine is another one, or their numbers are.
    let models = DeviceModel::ALL.into_iter().filter(|model| EXACT_SINES.contains(&model.name()));
    let variants = [Variant::Isotropic, Variant::Anisotropic];
    let ports =
        variants.into_iter().flat_map(|variant| models.clone().map(move |model| sound_port(variant, model)));
    let trials = results.outcomes.iter().map(trial).chain(DEFECTS.iter().map(one_more_defect)).chain(ports);
    libtest_mimic::run(&Arguments::from_args(), trials.collect()).exit();
}
