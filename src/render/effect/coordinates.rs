//! Other coordinates than those of the object to hash in (§5.2, §5.3).

use super::kind::{About, Effect, Role, Rules};
use crate::render::draw::fragments::Space;
use crate::render::draw::plan::{Plan, Text, tell};
use serde::Deserialize;

/// What is hashed.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coordinates {
    /// The coordinates.
    pub space: Space,
}

impl Effect for Coordinates {
    const ABOUT: About = About {
        citation: "§5.2, §5.3",
        does: "Hashes in other than object coordinates",
        costs: "nothing",
        bounds: &[],
        techniques: &[],
    };

    fn rules(&self) -> Rules {
        Rules::default().needs(Role::Hash)
    }

    fn plan(&self, plan: &mut Plan) {
        let says = format!("hash: in {} coordinates", self.space.name());
        plan.before(tell(says, &[], Text::None), |setup| setup.space = self.space);
    }
}
