//! Other coordinates than those of the object to hash in (§5.2, §5.3).

use super::kind::{About, Effect, Plan, Role, Rules, Text, tell};
use crate::render::draw::fragments::Space;
use serde::Deserialize;

/// What is hashed.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coordinates {
    /// The coordinates.
    pub space: Space,
}

impl Effect for Coordinates {
    const ABOUT: About = About::new("§5.2, §5.3", "Hashes in other than object coordinates", "nothing");

    fn rules(&self) -> Rules {
        Rules::default().needs(Role::Hash)
    }

    fn plan(&self, plan: &mut Plan) {
        let says = format!("hash: in {} coordinates", self.space.name());
        plan.before(tell(says, &[], Text::None), |setup| setup.space = self.space);
    }
}
