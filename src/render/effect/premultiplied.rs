//! Colours multiplied by alpha (§7.3): [`premultiplied`](crate::technique::premultiplied).

use super::kind::{About, Effect, Rules, Technique};
use crate::render::draw::plan::{Plan, Text, tell};
use serde::Deserialize;

/// Colours multiplied by alpha.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Premultiplied {}

impl Effect for Premultiplied {
    const ABOUT: About = About {
        citation: "§7.3",
        does: "Stores colours multiplied by alpha and divides after filtering",
        costs: "a division a shaded sample",
        bounds: &[],
        techniques: &[Technique {
            name: "premultiplied-alpha",
            source: "§7.3",
            claim: "Premultiplied colours leave no halo and need a divide.",
            shown: ["halo", "premultiplied"],
        }],
    };

    fn rules(&self) -> Rules {
        Rules::default()
    }

    fn plan(&self, plan: &mut Plan) {
        let says = "premultiply: colours multiplied by alpha when stored, divided after filtering";
        plan.before(tell(says, &[], Text::None), |setup| setup.textures.premultiplied = true);
    }
}
