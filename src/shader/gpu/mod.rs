//! Shaders on a device: which one, a WGSL function over many inputs, and a drawn picture with real derivatives.
//!
//! | module | does |
//! |---|---|
//! | [`adapter`] | lists the drivers of the machine and picks one by name, index or the environment |
//! | [`device`] | opens it; every call into a driver has a time limit |
//! | [`evaluate`] | runs a function `threshold` over fragments |
//! | [`parity`] | compares it with Rust, stage by stage |
//! | [`picture`] | draws a rectangle, with the derivatives of the device itself |
//! | [`program`] | runs a WGSL function over inputs from memory, or over inputs that the device makes itself |
//!
//! Back ends are Vulkan and OpenGL. Both libraries are opened at run time, so that the crate builds and answers on a
//! machine that has neither. Mesa's Vulkan layers complain on stderr when there is no display server; the environment
//! variable `NODEVICE_SELECT=1`, set before the process starts, silences them.

pub mod adapter;
pub mod device;
pub mod evaluate;
pub mod parity;
pub mod picture;
pub mod program;

pub use adapter::{Choice, Unavailable};
pub use device::Device;
pub use evaluate::Evaluator;
pub use program::{Kernel, Program};

use std::time::Duration;

/// Why a device gave no result.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// There is no such device.
    #[error(transparent)]
    Unavailable(#[from] Unavailable),
    /// The shader, or what was asked for with it, is not valid; the message is that of the validator.
    #[error("{0}")]
    Validation(String),
    /// The device has not enough memory.
    #[error("the device is out of memory")]
    OutOfMemory,
    /// The device was lost; it answers nothing from now on.
    #[error("the device was lost: {0}")]
    Lost(String),
    /// The device gave no answer in time; it counts as lost from now on.
    #[error("no answer from the device within {0:?}: does the shader end?")]
    TimedOut(Duration),
    /// The shader wrote nothing for an element.
    #[error("the shader wrote no value for element {0}")]
    NotWritten(usize),
}
