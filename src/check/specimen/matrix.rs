//! The kill matrix: which claims reject which specimens.
//!
//! The matrix is committed as `matrix.txt`; [`computed`](super::computed) makes it.

use core::fmt;

/// Which claims reject which specimens.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct KillMatrix {
    /// One row a specimen.
    pub rows: Vec<Rejections>,
}

/// The claims that reject one specimen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rejections {
    /// Name of the specimen.
    pub specimen: &'static str,
    /// Identifiers of the claims, in the order of the suite.
    pub claims: Vec<&'static str>,
}

const COMMITTED: &str = include_str!("matrix.txt");

impl KillMatrix {
    /// Reads the committed matrix.
    #[must_use]
    pub fn committed() -> Self {
        let rows = COMMITTED
            .lines()
            .filter_map(|line| line.split_once(':'))
            .map(|(specimen, claims)| Rejections { specimen, claims: claims.split_whitespace().collect() });
        Self { rows: rows.collect() }
    }

    /// Returns the row of a specimen.
    #[must_use]
    pub fn row(&self, specimen: &str) -> Option<&Rejections> {
        self.rows.iter().find(|row| row.specimen == specimen)
    }

    /// Returns how many specimens a claim rejects.
    #[must_use]
    pub fn rejected_by(&self, claim: &str) -> usize {
        self.rows.iter().filter(|row| row.claims.contains(&claim)).count()
    }
}

/// The form in which the matrix is committed: one line a specimen, its name and the claims that reject it.
impl fmt::Display for KillMatrix {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for Rejections { specimen, claims } in &self.rows {
            writeln!(f, "{specimen}: {}", claims.join(" "))?;
        }
        Ok(())
    }
}
