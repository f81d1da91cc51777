//! One ray a pixel into the open, with noise that stays with the surface (§9, Fig. 8):
//! [`occlusion`](crate::technique::occlusion).

use super::kind::{
    About, Bound, Cost, Diagnostic, Effect, Per, Phase, Plan, Role, Rules, Text, by_name, techniques, tell,
    two_scales,
};
use crate::render::draw::work::{NONE, PIXELS, Shading, TileResult, Work};
use crate::shader::beside;
use crate::technique::occlusion::{chi_by_offsets, chi_by_two_hashes, chi_by_word, generator};
use crate::threshold::footprint::Footprint;
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::model::Model;
use crate::threshold::robust::Robust;
use crate::threshold::two_scale::Variant;
use glam::{DVec2, Vec3, vec3};
use rand::RngExt;
use rand::rngs::Xoshiro256PlusPlus;
use serde::Deserialize;

/// One ray a pixel into the open.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Occlusion {
    /// How far something may be in the way, in object units, above 0.
    pub reach: f64,
    /// Where the two numbers of a ray come from.
    #[serde(default)]
    pub chi: Chi,
    /// How the scales of what is hashed are chosen from derivatives: isotropic or anisotropic.
    #[serde(default = "isotropic", deserialize_with = "by_name")]
    pub variant: Variant,
}

fn isotropic() -> Variant {
    Variant::Isotropic
}

/// The two numbers of a ray (§9).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Chi {
    /// Two hashes of one cell, by the listing.
    #[default]
    TwoHashes,
    /// One hash of two cells far apart, by the listing.
    Offsets,
    /// The robust threshold, twice by a word of its hash; not in the paper.
    Word,
    /// An ordinary generator, seeded by the coarse cell of the listing.
    Seeded,
    /// Fresh random numbers in every pixel and frame: what hashing is compared with.
    Random,
}

impl Chi {
    /// Every way to choose, the paper's first.
    pub const ALL: [Self; 5] = [Self::TwoHashes, Self::Offsets, Self::Word, Self::Seeded, Self::Random];

    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::TwoHashes => "two-hashes",
            Self::Offsets => "offsets",
            Self::Word => "word",
            Self::Seeded => "seeded",
            Self::Random => "random",
        }
    }
}

impl Effect for Occlusion {
    const ABOUT: About = About::new(
        "§9, Fig. 8",
        "Traces one ray a pixel into the open, in a direction that stays with the surface",
        "rays: 1 for each pixel that shows a surface; hashes or random numbers: 2 values a ray",
    )
    .bounds(&[("reach", Bound::LENGTH)])
    .techniques(techniques![
        "hashed-occlusion": "§9, Fig. 8", "occlusion" / "two hashes, anisotropic",
            "One ray a pixel, with noise that stays fixed to the geometry.";
        "hash-seeded-generator": "§9", "occlusion" / "seeded",
            "A hash that returns an integer seeds an ordinary generator.";
    ]);

    fn rules(&self) -> Rules {
        Rules::of(&[Role::Test, Role::Pixels])
            .never(Role::SecondPass, "the first needs one surface a pixel and the second shows several")
    }

    fn check(&self, _: &Plan) -> Result<(), Diagnostic> {
        two_scales(self.variant, "occlusion")
    }

    fn plan(&self, plan: &mut Plan) {
        let table = *self;
        let Self { reach, chi, variant } = table;
        let from = match chi {
            Chi::TwoHashes => format!("two hashes of the {variant} listing"),
            Chi::Offsets => format!("two offsets of the {variant} listing"),
            Chi::Word => format!("two words of the robust {variant} threshold"),
            Chi::Seeded => format!("a generator seeded by the coarse cell, {variant}"),
            Chi::Random => "fresh random numbers".to_owned(),
        };
        plan.setup.rays = true;
        plan.setup.needs.footprint = true;
        plan.setup.needs.frame |= chi == Chi::Random;
        let says = format!(
            "occlude: one ray from the nearest that is kept, up to {reach} units, by {from}; triangles are solid"
        );
        let told = tell(says, &[(Per::Shown, table.cost())], Text::Beside(beside::COSINE_DIRECTION));
        plan.shade(Phase::Trace, told, move |shading, work, result| trace(shading, work, &table, result));
    }
}

impl Occlusion {
    /// What one ray costs.
    fn cost(&self) -> Cost {
        let [hashes, randoms] = match self.chi {
            Chi::TwoHashes | Chi::Offsets => [Model::from(HashedAlpha::listing(self.variant)).hashes(), 0],
            Chi::Word => [Model::from(Robust::new(self.variant)).hashes(), 0],
            // Two words of the cell.
            Chi::Seeded => [1, 1],
            Chi::Random => [0, 1],
        };
        Cost::rays(1) + Cost::hashes(2 * hashes) + Cost::randoms(2 * randoms)
    }
}

/// The offsets of chi_1 and chi_2 in cells: large and without relation, as §9 asks; the values are ours.
const OFFSETS: [Vec3; 2] = [vec3(1013.0, -377.0, 2311.0), vec3(-1999.0, 743.0, 89.0)];

/// Returns the two numbers of a ray by a table, each in [0, 1]; NaN where a listing gives none. `rng` is for those that
/// belong to no place.
fn chi(table: &Occlusion, footprint: &Footprint<f32>, rng: &mut Xoshiro256PlusPlus) -> [f64; 2] {
    let variant = table.variant;
    let hashed = match table.chi {
        Chi::TwoHashes => chi_by_two_hashes(variant, footprint),
        Chi::Offsets => chi_by_offsets(variant, OFFSETS, footprint),
        Chi::Word => chi_by_word(&Robust::new(variant), footprint).unwrap_or([f32::NAN; 2]),
        Chi::Seeded => {
            let mut seeded = generator(&variant.two_scale(footprint, 1.0).floor_cell);
            return [seeded.random(), seeded.random()];
        }
        Chi::Random => return [rng.random(), rng.random()],
    };
    hashed.map(f64::from)
}

/// Traces the ray of every pixel that shows a surface, from the nearest.
fn trace(shading: &Shading<'_>, work: &mut Work, table: &Occlusion, result: &mut TileResult) {
    let Some(occluders) = shading.occluders else { return };
    let Work { fragments, kept, rng, .. } = work;
    let mut nearest = vec![NONE; PIXELS];
    for at in (0..fragments.len()).filter(|&at| kept[at] != 0) {
        let held = &mut nearest[usize::from(fragments.pixel[at])];
        if *held == NONE || fragments.depth[at] < fragments.depth[*held as usize] {
            *held = at as u32;
        }
    }
    let columns = fragments.footprint.columns();
    for (pixel, &at) in nearest.iter().enumerate().filter(|(_, at)| **at != NONE) {
        let at = at as usize;
        let corner = DVec2::from(shading.place(fragments, at).map(f64::from));
        let ray = shading.camera.ray(corner + 0.5 - shading.setup.offset(shading.frame));
        let point = ray.origin + ray.direction * f64::from(fragments.depth[at]);
        let chi = chi(table, &columns.footprint(at), rng);
        let is_open = occluders.is_open(fragments.triangle[at], point, shading.camera.eye, chi, table.reach);
        result.rays[pixel] = [1, u16::from(is_open)];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;

    #[test]
    fn every_way_to_choose_a_ray_gives_numbers_and_says_its_price() {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(1);
        let footprint = Footprint {
            position: vec3(3.1, 1.7, 4.3),
            dpdx: vec3(0.011, 0.002, 0.004),
            dpdy: vec3(-0.003, 0.013, 0.001),
        };
        for chi_of in Chi::ALL {
            for variant in [Variant::Isotropic, Variant::Anisotropic] {
                let table = Occlusion { reach: 1.0, chi: chi_of, variant };
                let of = |rng: &mut Xoshiro256PlusPlus| chi(&table, &footprint, rng);
                let (one, two) = (of(&mut rng), of(&mut rng));
                assert!(one.iter().all(|chi| (0.0..=1.0).contains(chi)) && one[0] != one[1], "{table:?}");
                assert_eq!(one == two, chi_of != Chi::Random, "{table:?}");
                let cost = table.cost();
                assert_eq!((cost.rays, cost.hashes > 0), (1, chi_of != Chi::Random));
                assert_eq!(cost.randoms > 0, matches!(chi_of, Chi::Random | Chi::Seeded));
            }
        }
    }
}
