//! How a job ends that is not cut short.

/// What the exit code says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// Done, and nothing speaks against a claim.
    Consistent,
    /// A claim was rejected that should hold.
    Rejected,
    /// A mistake in what was typed.
    Usage,
    /// There was nothing to judge.
    NoVerdict,
}
