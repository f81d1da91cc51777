//! What a new claim and a new specimen cost: in how many files under `src` each is named by hand.
//!
//! A claim is a constant of its family's file and a line of the list, a specimen an entry of its family; a new family of
//! specimens is a line of their list more. The kill matrix is generated, and what is known of the paper's listings is no part
//! of a claim.

use crate::architecture::{code, sources};
use hashed_alpha::check::specimen;
use std::collections::BTreeMap;

/// Files that may name a claim beside its own and the list, each with the reason.
const MORE: [(&str, &str, &str); 3] = [
    ("range::RANGE", "check/diagnosis.rs", "a subject without thresholds is told so, and nothing else"),
    ("range::RANGE", "check/mend/mod.rs", "a clamp in the wrong place is seen before all claims are tried"),
    ("exact::CELLS", "check/mend/mod.rs", "a root of one half in another number of digits moves cells"),
];

type Sources = BTreeMap<String, String>;

/// The claims as they are named in the list.
fn claims(sources: &Sources) -> Vec<String> {
    let list = code(&sources["check/claims/mod.rs"]);
    let all = list.split_once("ALL: &[Claim] = &[").expect("the list").1;
    let all = all.split_once("];").expect("its end").0;
    all.split(',').map(|claim| claim.trim().to_owned()).filter(|claim| !claim.is_empty()).collect()
}

/// The files that name a claim by hand, without those that have a reason to.
fn files_of_claim<'a>(sources: &'a Sources, claim: &str) -> Vec<&'a str> {
    let (family, name) = claim.split_once("::").expect("a path");
    let own = format!("check/claims/{family}.rs");
    let names_it = |file: &str, text: &str| {
        let text = code(text);
        let is_own = file == own && text.contains(&format!("const {name}: Claim"));
        let by_import = text.contains(&format!("claims::{family}::{name}")) || text.contains(claim);
        is_own || by_import || (text.contains(&format!("{family}::{{")) && text.contains(name) && file != own)
    };
    let has_reason = |file: &str| MORE.iter().any(|(of, at, _)| *of == claim && *at == file);
    let files = sources.iter().filter(|(file, text)| names_it(file, text) && !has_reason(file));
    files.map(|(file, _)| file.as_str()).collect()
}

/// The files that name a specimen, of those that may know of specimens: in a shader the same word can be a function.
fn files_of_specimen<'a>(sources: &'a Sources, name: &str) -> Vec<&'a str> {
    let quoted = format!("\"{name}\"");
    let may_know = |file: &str| ["check/", "report/", "cli/"].iter().any(|wing| file.starts_with(wing));
    let names_it =
        |text: &str| text.split("#[cfg(test)]").next().is_some_and(|own| code(own).contains(&quoted));
    let files = sources.iter().filter(|(file, text)| may_know(file) && names_it(text));
    files.map(|(file, _)| file.as_str()).collect()
}

#[test]
fn a_claim_is_named_in_its_own_file_and_in_the_list() {
    let mut sources = sources();
    let claims = claims(&sources);
    assert_eq!(claims.len(), hashed_alpha::check::claims::ALL.len());
    for claim in &claims {
        let files = files_of_claim(&sources, claim);
        assert_eq!(files.len(), 2, "{claim}: {files:?}");
    }
    for (claim, file, reason) in MORE {
        assert!(claims.iter().any(|known| known == claim) && !reason.is_empty());
        assert!(
            code(&sources[file]).contains(claim.rsplit_once("::").expect("a path").1),
            "{file} does not need {claim}"
        );
    }
    sources.insert("report/nosy.rs".into(), "use crate::check::claims::atoms::ZERO;".into());
    assert_eq!(files_of_claim(&sources, "atoms::ZERO").len(), 3);
}

#[test]
fn a_specimen_is_named_in_one_file() {
    let mut sources = sources();
    // An experiment may name one whose slip it tells; no specimen has to have one.
    // In `mend` the same words are functions of shading languages.
    sources.retain(|file, _| !file.starts_with("check/cause/") && !file.starts_with("check/mend/"));
    for specimen in specimen::ALL {
        let files = files_of_specimen(&sources, specimen.name);
        assert_eq!(files.len(), 1, "{specimen:?}: {files:?}");
    }
    sources.insert("report/nosy.rs".into(), "const WORST: &str = \"no-cdf\";".into());
    assert_eq!(files_of_specimen(&sources, "no-cdf").len(), 2);
}
