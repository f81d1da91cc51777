//! Coarser levels away from where the viewer looks (§11): [`foveated`](crate::technique::foveated).

use super::kind::{About, Bound, Effect, Plan, Role, Rules, Text, techniques, tell};
use crate::shader::beside;
use crate::technique::foveated::Gaze;
use serde::Deserialize;

/// Coarser levels away from where the viewer looks.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Foveated {
    /// The point looked at, in pixels from the upper left corner of the image.
    pub gaze: [f64; 2],
    /// Up to this distance everything is drawn in full, in pixels, at least 0.
    pub radius: f64,
    /// Growth of the size of a shaded sample beyond the radius, in pixels a pixel, at least 0.
    pub slope: f64,
}

impl Effect for Foveated {
    const ABOUT: About = About::new(
        "§11, Fig. 15 (Patney et al. 2016)",
        "Reads coarser levels away from where the viewer looks",
        "nothing: texels as many, but nearer together",
    )
    .bounds(&[("gaze", Bound::From(-1.0e6, 1.0e6)), ("radius", Bound::From(0.0, 1.0e6)), ("slope", Bound::From(0.0, 1.0e6))])
    .techniques(techniques![
        "foveated": "§11, Fig. 15 (Patney et al. 2016)", "foveated" / "hashed, foveated",
            "Coarser levels away from the gaze lose foliage under a fixed test and keep it under a hashed one.";
    ]);

    fn rules(&self) -> Rules {
        Rules::default().never(Role::Finest, "the first reads coarser levels and the second none")
    }

    fn plan(&self, plan: &mut Plan) {
        let gaze = Gaze { centre: self.gaze, radius: self.radius, slope: self.slope };
        let ([x, y], radius, slope) = (self.gaze, self.radius, self.slope);
        let says = format!(
            "foveate: samples of 1 px within {radius} px of ({x}, {y}), beyond that {slope} px more a pixel"
        );
        let told = tell(says, &[], Text::Beside(beside::COARSER_BY));
        plan.before(told, |setup| setup.gaze = Some(gaze));
    }
}
