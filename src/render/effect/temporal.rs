//! Strata of frames (§7.2.3, Eq. 6): [`order`](crate::threshold::stage::order).

use super::kind::{About, Effect, Role, Rules, Technique, one_of};
use crate::render::draw::plan::{Plan, Text, tell};
use crate::render::scene_file::bound::Bound;
use crate::threshold::stage::order::{FrameStrata, Order};
use core::num::NonZeroU32;
use serde::{Deserialize, Deserializer};

/// Strata of frames.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Temporal {
    /// Number of frames that belong together.
    pub frames: NonZeroU32,
    /// Their order.
    #[serde(default = "alternating", deserialize_with = "order")]
    pub order: Order,
}

fn alternating() -> Order {
    Order::Alternating
}

fn order<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Order, D::Error> {
    one_of(deserializer, "order", Order::ALL, Order::name)
}

impl Effect for Temporal {
    const ABOUT: About = About {
        citation: "§7.2.3, Eq. 6",
        does: "Divides the range of thresholds among frames",
        costs: "nothing but an addition",
        bounds: &[("frames", Bound::CYCLE)],
        techniques: &[
            Technique {
                name: "stratified-frames",
                source: "§7.2.3, Eq. 6",
                claim: "One hash gives n frames a stratum each; in ascending order the average flickers.",
                shown: ["temporal-orders", "ascending, 8"],
            },
            Technique {
                name: "alternating-order",
                source: "§7.2.3",
                claim: "Every other threshold is below one half, and the average flickers less.",
                shown: ["temporal-orders", "alternating, 8"],
            },
            Technique {
                name: "van-der-corput",
                source: "§7.2.3",
                claim: "A low-discrepancy order is better still.",
                shown: ["temporal-orders", "van-der-corput, 8"],
            },
            Technique {
                name: "phase-rotated",
                source: "not in the paper",
                claim: "The order is entered at the stratum of the hash, and alternates for every hash value.",
                shown: ["temporal-orders", "phase-rotated, 8"],
            },
        ],
    };

    fn rules(&self) -> Rules {
        Rules::default().needs(Role::Noise)
    }

    fn plan(&self, plan: &mut Plan) {
        let Self { frames, order } = *self;
        let says = format!("temporal: stratum of {frames} frames, {} order", order.name());
        plan.before(tell(says, &[], Text::None), |setup| {
            setup.thresholds(|pipeline| {
                pipeline.frame_strata = Some(FrameStrata { frames, order });
            })
        });
    }
}
