//! The kill matrix, computed.
//!
//! Each entry is a run of its own, one claim on one specimen with seed 0 at [`Budget::Quick`], so that a new claim or
//! specimen changes no other entry. `HASHED_ALPHA_BLESS=new cargo test --test specimens` adds what is missing,
//! `HASHED_ALPHA_BLESS=all` computes every entry again.

use super::ALL;
use super::defect::Specimen;
use super::matrix::{KillMatrix, Rejections};
use crate::check::claim::Claim;
use crate::check::{Budget, Draw, Reach, Standing, claims, run_claims};
use rayon::prelude::*;

/// The draw by which the committed matrix is computed.
pub const DRAW: Draw = Draw { seed: 0, budget: Budget::Quick, round: 0, doublings: 0, reach: Reach::Whole };

/// Computes the matrix on all threads, and takes over from `known` the entries whose specimen and claim both have
/// a place there.
#[must_use]
pub fn computed(known: &KillMatrix) -> KillMatrix {
    let is_rejected = |specimen: &Specimen, claim: &Claim| match known.row(specimen.name) {
        Some(row) if known.rejected_by(claim.id) > 0 => row.claims.contains(&claim.id),
        _ => rejects(claim, specimen),
    };
    let row = |specimen: &Specimen| {
        let rejected: Vec<bool> =
            claims::ALL.par_iter().with_max_len(1).map(|claim| is_rejected(specimen, claim)).collect();
        let claims = claims::ALL.iter().zip(rejected).filter(|(_, rejected)| *rejected);
        Rejections { specimen: specimen.name, claims: claims.map(|(claim, _)| claim.id).collect() }
    };
    KillMatrix { rows: ALL.par_iter().with_max_len(1).map(row).collect() }
}

/// Tries one claim on a specimen: whether it is rejected, or a negative control that is not.
#[must_use]
pub fn rejects(claim: &Claim, specimen: &Specimen) -> bool {
    let outcomes = run_claims(core::slice::from_ref(claim), &[(specimen.subject)()], &DRAW, || {});
    outcomes.iter().any(|outcome| outcome.standing() == Standing::Against)
}
