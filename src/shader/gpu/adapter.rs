//! Which driver: the list of adapters and the choice among them.

use core::fmt;
use wgpu::{Backends, DeviceType, Instance, InstanceDescriptor, InstanceFlags};

/// The environment variable that chooses an adapter: a part of its [`Adapter::name`], or its index.
pub const CHOICE_VARIABLE: &str = "HASHED_ALPHA_ADAPTER";

/// The back ends that are tried.
const BACKENDS: Backends = Backends::VULKAN.union(Backends::GL);

/// A driver with a device behind it.
#[derive(Clone, Debug)]
pub struct Adapter(pub(super) wgpu::Adapter);

impl Adapter {
    /// Returns the back end, the device and its driver, as in "Vulkan SwiftShader Device, SwiftShader driver".
    #[must_use]
    pub fn name(&self) -> String {
        let info = self.0.get_info();
        let driver = [info.driver, info.driver_info].join(" ");
        format!("{:?} {}, {}", info.backend, info.name, driver.trim())
    }
}

/// Lists the adapters of this machine, those with hardware first; empty where there is no driver.
#[must_use]
pub fn adapters() -> Vec<Adapter> {
    let mut descriptor = InstanceDescriptor::new_without_display_handle();
    descriptor.backends = BACKENDS;
    // Validation is that of wgpu itself; the layers that a debug build would ask for are rarely installed.
    descriptor.flags = InstanceFlags::empty();
    let found = pollster::block_on(Instance::new(descriptor).enumerate_adapters(BACKENDS));
    let mut adapters: Vec<_> = found.into_iter().map(Adapter).collect();
    // OpenGL drivers do not tell what they run on.
    let rank = |adapter: &Adapter| match adapter.0.get_info().device_type {
        DeviceType::DiscreteGpu => 0,
        DeviceType::IntegratedGpu => 1,
        DeviceType::VirtualGpu => 2,
        DeviceType::Other => 3,
        DeviceType::Cpu => 4,
    };
    adapters.sort_by_key(rank);
    adapters
}

/// Which adapter is wanted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Choice {
    /// The first of [`adapters`].
    #[default]
    First,
    /// The one at an index of [`adapters`].
    Index(usize),
    /// The first whose [`Adapter::name`] contains this, whatever the case of letters.
    Name(String),
}

impl Choice {
    /// Reads [`CHOICE_VARIABLE`]; the first adapter where it is not set or empty.
    #[must_use]
    pub fn from_environment() -> Self {
        std::env::var(CHOICE_VARIABLE).map_or(Self::First, |wanted| Self::from(wanted.as_str()))
    }

    /// Finds the adapter.
    ///
    /// # Errors
    ///
    /// [`Unavailable`] where there is none, or none such.
    pub fn find(&self) -> Result<Adapter, Unavailable> {
        let mut adapters = adapters();
        let index = match self {
            Self::First => (!adapters.is_empty()).then_some(0),
            Self::Index(index) => (*index < adapters.len()).then_some(*index),
            Self::Name(part) => {
                let part = part.to_lowercase();
                adapters.iter().position(|adapter| adapter.name().to_lowercase().contains(&part))
            }
        };
        index.map(|index| adapters.swap_remove(index)).ok_or_else(|| Unavailable {
            wanted: self.clone(),
            found: adapters.iter().map(Adapter::name).collect(),
        })
    }
}

impl From<&str> for Choice {
    /// Reads an index or a part of a name.
    fn from(wanted: &str) -> Self {
        match wanted.trim() {
            "" => Self::First,
            wanted => wanted.parse().map_or_else(|_| Self::Name(wanted.to_owned()), Self::Index),
        }
    }
}

impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::First => f.write_str("any adapter"),
            Self::Index(index) => write!(f, "adapter {index}"),
            Self::Name(part) => write!(f, "an adapter with `{part}` in its name"),
        }
    }
}

/// No adapter answers to a choice.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no GPU: looked for {wanted} of Vulkan or OpenGL, found {}", list(found))]
pub struct Unavailable {
    /// What was looked for.
    pub wanted: Choice,
    /// The names of the adapters that are there.
    pub found: Vec<String>,
}

fn list(names: &[String]) -> String {
    if names.is_empty() { "no driver".to_owned() } else { names.join("; ") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_choice_is_an_index_or_a_part_of_a_name() {
        assert_eq!(Choice::from(" 2 "), Choice::Index(2));
        assert_eq!(Choice::from("swiftshader"), Choice::Name("swiftshader".to_owned()));
        assert_eq!(Choice::from(""), Choice::First);
    }

    #[test]
    fn an_adapter_that_is_not_there_is_named_in_the_error() {
        let error = Choice::from("Voodoo 2").find().unwrap_err();
        assert!(error.to_string().contains("`Voodoo 2`"), "{error}");
        let nothing = Unavailable { wanted: Choice::First, found: Vec::new() };
        assert_eq!(
            nothing.to_string(),
            "no GPU: looked for any adapter of Vulkan or OpenGL, found no driver"
        );
    }
}
