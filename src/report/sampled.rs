//! What each claim has sampled of the domain, as rows of a table: measured while the claims ran.

use crate::check::{Domain, Outcome};

/// What the columns are. Levels of a logarithm to base two are whole octaves, both ends included.
pub const HEADINGS: [&str; 9] =
    ["sampled by", "octaves", "log2 |p|", "octants", "log2 dx/dy", "lod", "layers", "frames", "hash scale"];

/// Returns one row a claim, over all subjects of the outcomes, in the order in which the claims come first. Claims that asked no
/// subject for a threshold have none.
#[must_use]
pub fn rows(outcomes: &[Outcome]) -> Vec<[String; 9]> {
    let mut domains: Vec<(&str, Domain)> = Vec::new();
    for outcome in outcomes.iter().filter(|outcome| outcome.domain.n > 0) {
        match domains.iter_mut().find(|(check, _)| *check == outcome.check) {
            Some((_, domain)) => domain.extend(&outcome.domain),
            None => domains.push((outcome.check, outcome.domain.clone())),
        }
    }
    domains.iter().map(|(check, domain)| row(check, domain)).collect()
}

fn row(check: &str, domain: &Domain) -> [String; 9] {
    let scales: Vec<String> = domain.hash_scales().iter().map(ToString::to_string).collect();
    let axes = if domain.half_axes() > 0 { format!("+{} axes", domain.half_axes()) } else { String::new() };
    [
        check.to_owned(),
        domain.octaves.to_string(),
        domain.distances.to_string(),
        format!("{}{axes}", domain.octants()),
        domain.ratios.to_string(),
        domain.lods.to_string(),
        domain.layers.to_string(),
        domain.frames_in_words(),
        scales.join(", "),
    ]
}

#[cfg(test)]
mod tests {
    use super::super::example;
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn a_claim_has_one_row_over_all_subjects() {
        let mut outcomes = example::outcomes();
        assert!(rows(&outcomes).is_empty());
        let [first, second, ..] = &mut outcomes[..] else { panic!("two outcomes") };
        second.check = first.check;
        for (outcome, scene) in [first, second].into_iter().zip(Scene::all()) {
            scene.fragments().step_by(1000).for_each(|fragment| outcome.domain.add_all(&[fragment], 1.0));
        }
        let found = rows(&outcomes);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0][7..], ["0", "1"]);
    }
}
