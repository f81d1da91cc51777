//! Strata of frames (§7.2.3, Eq. 6): [`order`](crate::threshold::stage::order).

use super::kind::{About, Bound, Effect, Plan, Role, Rules, Text, one_of, techniques, tell};
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
    const ABOUT: About = About::new(
        "§7.2.3, Eq. 6",
        "Divides the range of thresholds among frames",
        "nothing but an addition",
    )
    .bounds(&[("frames", Bound::CYCLE)])
    .techniques(techniques![
        "stratified-frames": "§7.2.3, Eq. 6", "temporal-orders" / "ascending, 8",
            "One hash gives n frames a stratum each; in ascending order the average flickers.";
        "alternating-order": "§7.2.3", "temporal-orders" / "alternating, 8",
            "Every other threshold is below one half, and the average flickers less.";
        "van-der-corput": "§7.2.3", "temporal-orders" / "van-der-corput, 8",
            "A low-discrepancy order is better still.";
        "phase-rotated": "not in the paper", "temporal-orders" / "phase-rotated, 8",
            "The order is entered at the stratum of the hash, and alternates for every hash value.";
    ]);

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
