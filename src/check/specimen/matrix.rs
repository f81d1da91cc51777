//! The kill matrix: which claims reject which specimens.
//!
//! Each entry is a run of its own, one claim on one specimen with seed 0 at [`Budget::Quick`], so that a new claim or
//! specimen changes no other entry. The matrix is committed as `matrix.txt`.
//! `HASHED_ALPHA_BLESS=new cargo test --test specimens` adds what is missing there, `HASHED_ALPHA_BLESS=all` computes
//! every entry again.

use super::{ALL, Specimen};
use crate::check::claims::{self, Claim};
use crate::check::{Budget, Draw, run_claims};
use core::fmt;
use rayon::prelude::*;

/// Which claims reject which specimens.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct KillMatrix {
    /// One row a specimen.
    pub rows: Vec<Row>,
}

/// The claims that reject one specimen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// Name of the specimen.
    pub specimen: &'static str,
    /// Identifiers of the claims, in the order of the suite.
    pub claims: Vec<&'static str>,
}

/// The draw by which the committed matrix is computed.
pub const DRAW: Draw = Draw { seed: 0, budget: Budget::Quick, round: 0 };

const COMMITTED: &str = include_str!("matrix.txt");

impl KillMatrix {
    /// Reads the committed matrix.
    #[must_use]
    pub fn committed() -> Self {
        let rows = COMMITTED
            .lines()
            .filter_map(|line| line.split_once(':'))
            .map(|(specimen, claims)| Row { specimen, claims: claims.split_whitespace().collect() });
        Self { rows: rows.collect() }
    }

    /// Computes the matrix on all threads, and takes over from `known` the entries whose specimen and claim both have
    /// a place there.
    #[must_use]
    pub fn computed(known: &Self) -> Self {
        let is_rejected = |specimen: &Specimen, claim: &Claim| match known.row(specimen.name) {
            Some(row) if known.rejected_by(claim.id) > 0 => row.claims.contains(&claim.id),
            _ => rejects(claim, specimen),
        };
        let row = |specimen: &Specimen| {
            let rejected: Vec<bool> =
                claims::ALL.par_iter().with_max_len(1).map(|claim| is_rejected(specimen, claim)).collect();
            let claims = claims::ALL.iter().zip(rejected).filter(|(_, rejected)| *rejected);
            Row { specimen: specimen.name, claims: claims.map(|(claim, _)| claim.id).collect() }
        };
        Self { rows: ALL.par_iter().with_max_len(1).map(row).collect() }
    }

    /// Returns the row of a specimen.
    #[must_use]
    pub fn row(&self, specimen: &str) -> Option<&Row> {
        self.rows.iter().find(|row| row.specimen == specimen)
    }

    /// Returns how many specimens a claim rejects.
    #[must_use]
    pub fn rejected_by(&self, claim: &str) -> usize {
        self.rows.iter().filter(|row| row.claims.contains(&claim)).count()
    }
}

/// Tries one claim on a specimen: whether it is rejected, or a negative control that is not.
#[must_use]
pub fn rejects(claim: &Claim, specimen: &Specimen) -> bool {
    let outcomes = run_claims(core::slice::from_ref(claim), &[(specimen.subject)()], &DRAW, || {});
    outcomes.iter().any(|outcome| outcome.is_answered() && !outcome.as_expected())
}

/// The form in which the matrix is committed: one line a specimen, its name and the claims that reject it.
impl fmt::Display for KillMatrix {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for Row { specimen, claims } in &self.rows {
            writeln!(f, "{specimen}: {}", claims.join(" "))?;
        }
        Ok(())
    }
}
