//! Colours multiplied by alpha (§7.3): [`premultiplied`](crate::technique::premultiplied).

use super::kind::{About, Effect, Plan, Rules, Text, techniques, tell};
use serde::Deserialize;

/// Colours multiplied by alpha.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Premultiplied {}

impl Effect for Premultiplied {
    const ABOUT: About = About::new(
        "§7.3",
        "Stores colours multiplied by alpha and divides after filtering",
        "a division a shaded sample",
    )
    .techniques(techniques![
        "premultiplied-alpha": "§7.3", "halo" / "premultiplied",
            "Premultiplied colours leave no halo and need a divide.";
    ]);

    fn rules(&self) -> Rules {
        Rules::default()
    }

    fn plan(&self, plan: &mut Plan) {
        let says = "premultiply: colours multiplied by alpha when stored, divided after filtering";
        plan.before(tell(says, &[], Text::None), |setup| setup.textures.premultiplied = true);
    }
}
