//! Frames with hashes of their own (§7.2.2): [`independent`](crate::threshold::stage::independent).

use super::kind::{About, Bound, Diagnostic, Effect, Plan, Role, Rules, Text, techniques, tell};
use crate::threshold::hash::HashKind;
use crate::threshold::pipeline::Source;
use crate::threshold::stage::independent::{Independence, IndependentBy};
use core::num::NonZeroU32;
use serde::Deserialize;

/// A hash of its own for each frame.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Independent {
    /// Number of frames that belong together.
    pub frames: NonZeroU32,
    /// How their hashes are made independent.
    #[serde(default, with = "ByName")]
    pub by: IndependentBy,
}

/// The names by which a user asks for a way.
#[derive(Deserialize)]
#[serde(remote = "IndependentBy", rename_all = "kebab-case")]
enum ByName {
    Offset,
    Word,
}

impl Effect for Independent {
    const ABOUT: About =
        About::new("§7.2.2", "Hashes at another place in every frame", "nothing but an addition a hash")
            .bounds(&[("frames", Bound::CYCLE)])
            .techniques(techniques![
                "independent-hashes": "§7.2.2", "temporal-orders" / "independent, 8",
                    "Offsets in hash space give independent thresholds for each frame; the average flickers.";
                "frame-word": "not in the paper", "temporal-orders" / "word, 8",
                    "The same by a word that the hash reads.";
            ]);

    fn rules(&self) -> Rules {
        Rules::default().needs(Role::Hash, "a hashed threshold")
    }

    fn check(&self, plan: &Plan) -> Result<(), Diagnostic> {
        let Some(Source::Hash(model)) = plan.setup.pipeline.map(|pipeline| pipeline.source) else {
            return Ok(());
        };
        if self.by == IndependentBy::Offset || model.hash().reads_octave() {
            return Ok(());
        }
        let known: Vec<_> =
            HashKind::ALL.into_iter().filter(|hash| hash.reads_octave()).map(HashKind::name).collect();
        let needs = format!(
            "`independent.by` = \"word\" needs a hash that reads the word: one of {}",
            known.join(", ")
        );
        Err(Diagnostic::new("by", needs))
    }

    fn plan(&self, plan: &mut Plan) {
        let Self { frames, by } = *self;
        let how = match by {
            IndependentBy::Offset => "at another place",
            IndependentBy::Word => "with another word",
        };
        let told = tell(format!("hash: {how} in each of {frames} frames"), &[], Text::None);
        plan.before(told, |setup| {
            setup.thresholds(|pipeline| {
                pipeline.independence = Some(Independence { frames, by });
            })
        });
    }
}
