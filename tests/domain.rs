//! What claims sample of the domain is what the README promises, measured and not declared.

use hashed_alpha::check::claims::domain;
use hashed_alpha::check::domain::Levels;
use hashed_alpha::check::specimen::ideal;
use hashed_alpha::check::subject::Precision;
use hashed_alpha::check::{Budget, Claim, Domain, Draw, Reach, claims, run_claims};
use hashed_alpha::threshold::robust::Join;
use hashed_alpha::threshold::two_scale::Variant;

/// The claims about the whole domain.
const EVERYWHERE: [Claim; 5] =
    [domain::UNIFORM, domain::NEIGHBOURS, domain::LAYERS, domain::CHANGES, domain::CONTINUITY];

fn sampled(claim: &Claim, draw: &Draw) -> Domain {
    let subject = ideal(0, Variant::Isotropic, Precision::F32, Join::Interpolate);
    run_claims(&[*claim], &[subject], draw, || {}).remove(0).domain
}

fn lacks(levels: Levels, wanted: core::ops::RangeInclusive<i32>) -> Vec<i32> {
    wanted.filter(|&level| !levels.contains(level)).collect()
}

#[test]
fn the_whole_domain_is_visited_at_every_budget() {
    let draw = Draw { budget: Budget::Quick, ..Draw::default() };
    for claim in EVERYWHERE {
        let found = sampled(&claim, &draw);
        let id = claim.id;
        // In larger cells than the distance a face is at no uniform place, which the changes are about.
        let largest = if id == "domain.changes" { -19 } else { -20 };
        assert_eq!(lacks(found.octaves, largest..=20), [0_i32; 0], "{id}: octaves");
        assert_eq!(lacks(found.distances, 0..=19), [0_i32; 0], "{id}: distances");
        assert_eq!((found.octants(), found.half_axes()), (8, 6), "{id}");
        assert_eq!(lacks(found.ratios, -9..=9), [0_i32; 0], "{id}: ratios");
        assert_eq!(lacks(found.lods, -1..=14), [0_i32; 0], "{id}: levels of detail");
        assert_eq!(lacks(found.layers, 0..=15), [0_i32; 0], "{id}: layers");
        assert!(found.frames.len() > 100, "{id}: {} frames", found.frames.len());
        assert!(found.frames.last().is_some_and(|&last| last > 1 << 28), "{id}: {:?}", found.frames.last());
        assert_eq!(found.hash_scales(), [0.5, 1.0, 2.0, 3.7], "{id}");
        assert_eq!(found.zero_derivatives().len(), 12, "{id}: {:?}", found.zero_derivatives());
        let wide = |ends: Option<[f64; 2]>, low: f64, high: f64| {
            ends.is_some_and(|[least, most]| least < low && most > high)
        };
        assert!(wide(found.pixels, 10.0, 3800.0), "{id}: {:?}", found.pixels);
        assert!(wide(found.texcoords, -7.0, 7.0), "{id}: {:?}", found.texcoords);
    }
}

#[test]
fn another_seed_visits_other_combinations() {
    let of_seed = |seed| {
        let draw = Draw { budget: Budget::Quick, ..Draw::seeded(seed) };
        sampled(&domain::UNIFORM, &draw)
    };
    assert_ne!(of_seed(1).frames, of_seed(2).frames);
    assert_eq!(of_seed(1), of_seed(1));
}

/// Where the listings hold as they stand there is no derivative of zero and no index beyond their sines.
#[test]
fn the_listings_are_asked_only_where_they_hold() {
    let draw = Draw { budget: Budget::Quick, reach: Reach::Listings, ..Draw::default() };
    for claim in EVERYWHERE {
        let found = sampled(&claim, &draw);
        assert_eq!(found.zero_derivatives(), [""; 0], "{}", claim.id);
        assert_eq!(lacks(found.octaves, -18..=15), [0_i32; 0], "{}: octaves", claim.id);
        assert_eq!(lacks(found.distances, 0..=19), [0_i32; 0], "{}: distances", claim.id);
    }
}

/// What the close looks sample does not shrink unseen.
#[test]
fn scenes_of_everyday_size_are_looked_at_closely() {
    let draw = Draw { budget: Budget::Quick, ..Draw::default() };
    for claim in [claims::uniform::MARGINAL, claims::stability::TRANSLATE, claims::frames::STATIC] {
        let found = sampled(&claim, &draw);
        assert_eq!(lacks(found.octaves, 4..=7), [0_i32; 0], "{}: octaves", claim.id);
        assert_eq!(lacks(found.distances, 0..=3), [0_i32; 0], "{}: distances", claim.id);
        assert_eq!(found.octants(), 8, "{}", claim.id);
    }
    let frames = sampled(&claims::frames::STATIC, &draw).frames;
    assert!((0..64).all(|frame| frames.contains(&frame)) && frames.len() > 110, "{} frames", frames.len());
}
