//! What an effect is: a table of a scene file with its words, the bounds of its numbers, what it does not go with, and the
//! stages that it adds to a plan.

pub use crate::render::draw::cost::{Cost, Per};
pub use crate::render::draw::plan::{Phase, Plan, Text, tell};
pub use crate::render::scene_file::bound::Bound;
pub use crate::render::scene_file::diagnostic::Diagnostic;
use crate::threshold::two_scale::Variant;
use core::fmt::{Debug, Display};
use core::num::NonZeroU32;
use core::str::FromStr;
use serde::de::{DeserializeOwned, Error as _};
use serde::{Deserialize, Deserializer};

/// One optional table of a scene file. Present means simulated, absent means that nothing of it exists.
pub trait Effect: Clone + Debug + PartialEq + DeserializeOwned {
    /// What is known of it without looking at a scene.
    const ABOUT: About;

    /// Says what it is to other effects, and what it does not go with.
    fn rules(&self) -> Rules;

    /// Finds what is wrong with its values, in the plan of the whole set: the key within its table, and what.
    ///
    /// # Errors
    ///
    /// That diagnostic. By default nothing is wrong: single numbers are checked by their bounds as they are read.
    fn check(&self, _plan: &Plan) -> Result<(), Diagnostic> {
        Ok(())
    }

    /// Adds its stages.
    fn plan(&self, plan: &mut Plan);
}

/// What is known of an effect without looking at a scene.
#[derive(Clone, Copy, Debug)]
pub struct About {
    /// Its place in the sources.
    pub citation: &'static str,
    /// What it does, in a line.
    pub does: &'static str,
    /// What it costs, in the quantities that are counted.
    pub costs: &'static str,
    /// The bound of each number of its table, by key.
    pub bounds: &'static [(&'static str, Bound)],
    /// The techniques of the sources that it is the price of.
    pub techniques: &'static [Technique],
}

impl About {
    /// An effect by its place in the sources, by what it does and by what that costs.
    #[must_use]
    pub const fn new(citation: &'static str, does: &'static str, costs: &'static str) -> Self {
        Self { citation, does, costs, bounds: &[], techniques: &[] }
    }

    /// The same with a bound for each number of its table; without, any number goes.
    #[must_use]
    pub const fn bounds(self, bounds: &'static [(&'static str, Bound)]) -> Self {
        Self { bounds, ..self }
    }

    /// The same as the price of techniques.
    #[must_use]
    pub const fn techniques(self, techniques: &'static [Technique]) -> Self {
        Self { techniques, ..self }
    }
}

/// A technique that the sources name, as a scene of the gallery shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Technique {
    /// What it is called here: words joined by hyphens.
    pub name: &'static str,
    /// Where the sources describe it, as in "§7.1, Eqs. 3-5"; a paragraph alone is one of the journal version.
    pub source: &'static str,
    /// What the source, or where it says "not in the paper" this crate, says of it.
    pub claim: &'static str,
    /// The scene of the gallery that shows it, and the take of that scene.
    pub shown: [&'static str; 2],
}

/// A table of techniques: name, source, scene and take, claim.
macro_rules! techniques {
    ($($name:literal: $source:literal, $scene:literal / $take:literal, $claim:literal;)*) => {
        &[$($crate::render::effect::kind::Technique {
            name: $name,
            source: $source,
            claim: $claim,
            shown: [$scene, $take],
        }),*]
    };
}

pub(in crate::render) use techniques;

/// What an effect is to others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Chooses the threshold.
    Threshold,
    /// Its thresholds are noise.
    Noise,
    /// That noise is hashed from a place.
    Hash,
    /// That noise is drawn anew every time.
    Fresh,
    /// Has to do with the alpha test.
    Test,
    /// Gives fragments or samples thresholds that differ.
    Varied,
    /// Chooses the coarsest level.
    Level,
    /// Reads the finest level alone.
    Finest,
    /// Scales alphas.
    Scale,
    /// Tests several samples of a pixel.
    Samples,
    /// Works on whole pixels.
    Pixels,
    /// Shows several surfaces in a pixel, and no depth.
    Blends,
    /// Draws everything a second time.
    SecondPass,
}

impl Role {
    /// What two effects of the role would both do, where only one may.
    const fn alone(self) -> Option<&'static str> {
        match self {
            Self::Threshold => Some("choose the threshold"),
            Self::Level => Some("choose the level"),
            Self::Scale => Some("scale alphas"),
            Self::Noise | Self::Hash | Self::Fresh | Self::Test | Self::Varied | Self::Finest => None,
            Self::Samples | Self::Pixels | Self::Blends | Self::SecondPass => None,
        }
    }

    /// The role in a message.
    const fn words(self) -> &'static str {
        match self {
            Self::Threshold => "a threshold",
            Self::Noise => "a hashed or random threshold",
            Self::Hash => "a hashed threshold",
            Self::Fresh => "thresholds that are drawn anew",
            Self::Test => "an alpha test",
            Self::Varied => "thresholds that differ",
            Self::Level | Self::Finest => "a coarsest level",
            Self::Scale => "scaled alphas",
            Self::Samples => "several tests in a pixel",
            Self::Pixels => "whole pixels",
            Self::Blends | Self::SecondPass => "blending",
        }
    }
}

/// What an effect is to others, what it needs, and what it does not go with.
#[derive(Clone, Debug, Default)]
pub struct Rules {
    is: Vec<Role>,
    needs: Vec<Role>,
    never: Vec<(Role, &'static str)>,
    samples: Option<NonZeroU32>,
}

impl Rules {
    /// An effect of these roles that goes with all others, but for those of a role that only one may have.
    #[must_use]
    pub fn of(is: &[Role]) -> Self {
        Self { is: is.to_vec(), ..Self::default() }
    }

    /// The same with the need for another effect of a role.
    #[must_use]
    pub fn needs(mut self, role: Role) -> Self {
        self.needs.push(role);
        self
    }

    /// The same but for effects of a role, with the reason.
    #[must_use]
    pub fn never(mut self, role: Role, reason: &'static str) -> Self {
        self.never.push((role, reason));
        self
    }

    /// The same with so many samples a pixel, of which all that say so must have one number.
    #[must_use]
    pub fn samples(mut self, samples: NonZeroU32) -> Self {
        self.samples = Some(samples);
        self
    }

    /// Finds what does not go together among the effects of a set, each with its name.
    pub(super) fn check(all: &[(&'static str, Self)]) -> Result<(), Diagnostic> {
        for (index, (name, rules)) in all.iter().enumerate() {
            for (other, before) in &all[..index] {
                let shared = rules.is.iter().filter(|role| before.is.contains(role));
                if let Some(both) = shared.filter_map(|role| role.alone()).next() {
                    return Err(Diagnostic::new(
                        *name,
                        format!("`{other}` and `{name}` both {both}; keep one"),
                    ));
                }
                if rules.samples.zip(before.samples).is_some_and(|(one, two)| one != two) {
                    let message = format!("`{other}` and `{name}` must have the same samples");
                    return Err(Diagnostic::new(*name, message));
                }
            }
            for (role, reason) in &rules.never {
                if let Some((other, _)) = all.iter().find(|(other, of)| other != name && of.is.contains(role))
                {
                    let message = format!("`{name}` does not go with `{other}`: {reason}; keep one");
                    return Err(Diagnostic::new(*name, message));
                }
            }
            if let Some(lacking) =
                rules.needs.iter().find(|role| !all.iter().any(|(_, of)| of.is.contains(role)))
            {
                let message = format!("`{name}` needs {}, which no other effect gives", lacking.words());
                return Err(Diagnostic::new(*name, message));
            }
        }
        Ok(())
    }
}

/// Reads a word that has a parser of its own.
pub(super) fn by_name<'de, D, T>(deserializer: D) -> Result<T, D::Error>
where
    D: Deserializer<'de>,
    T: FromStr<Err: Display>,
{
    String::deserialize(deserializer)?.parse().map_err(D::Error::custom)
}

/// Reads the name of one of a list; `what` they are is for messages.
pub(super) fn one_of<'de, D, T, const N: usize>(
    deserializer: D,
    what: &str,
    all: [T; N],
    name: impl Fn(T) -> &'static str,
) -> Result<T, D::Error>
where
    D: Deserializer<'de>,
    T: Copy,
{
    let given = String::deserialize(deserializer)?;
    all.into_iter().find(|&one| name(one) == given).ok_or_else(|| {
        let known = all.map(&name).join(", ");
        D::Error::custom(format!("unknown {what} `{given}`; known are {known}"))
    })
}

/// Refuses the ablations of the listings, for what has two variants only.
pub(super) fn two_scales(variant: Variant, key: &str) -> Result<(), Diagnostic> {
    match variant {
        Variant::Isotropic | Variant::Anisotropic => Ok(()),
        Variant::Linear | Variant::Single => {
            Err(Diagnostic::new("variant", format!("`{key}.variant` must be isotropic or anisotropic")))
        }
    }
}
