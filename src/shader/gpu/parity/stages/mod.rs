//! The table: every stage, what a device owes there, and an error that the comparison must see. One file a part of the
//! threshold.

use super::Stage;

mod effects;
mod hashes;
mod parts;
mod scales;
mod thresholds;
mod uniform;

/// Returns every stage, in the order of a threshold.
pub fn stages() -> impl Iterator<Item = &'static Stage> {
    [scales::STAGES, hashes::STAGES, hashes::FAR, uniform::STAGES, thresholds::STAGES, effects::STAGES]
        .into_iter()
        .flatten()
}
