//! Mesa's drivers, kept from writing to stderr.

use super::args::ShaderArgs;
use super::subjects;

/// Switches off the layer with which Mesa orders its Vulkan devices: without a display server it complains of
/// `XDG_RUNTIME_DIR`, twice, on everybody's stderr.
///
/// The layer reads its switch from the environment that the process began with, so the process begins again.
#[cfg(unix)]
pub fn silence() {
    use std::os::unix::process::CommandExt;
    use std::{env, process::Command};
    const LAYER_OFF: &str = "NODEVICE_SELECT";
    if env::var_os(LAYER_OFF).is_some() {
        return;
    }
    if let Ok(program) = env::current_exe() {
        // Comes back where it fails; then the complaint is heard.
        let _ = Command::new(program).args(env::args_os().skip(1)).env(LAYER_OFF, "1").exec();
    }
}

/// There is no such layer.
#[cfg(not(unix))]
pub fn silence() {}

/// Does so where one of the subjects may run on a device.
pub fn silence_for(typed: &[String], args: &ShaderArgs) {
    if typed.iter().any(|word| subjects::may_need_a_device(word, args.on)) {
        silence();
    }
}
