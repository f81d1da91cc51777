//! Foreign code, naga, kept from taking the program with it.

use super::error::Fault;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// The name of the threads on which naga reads a user's shader. Where naga panics there, that becomes a message of this
/// module; a program may keep its panic hook from saying the same once more.
pub const READER: &str = "reader of shaders";

/// Runs naga on a stack of its own, for a limited time: it descends as the text nests, and where it panics or does not
/// come to an end that is a message.
pub(super) fn isolated<T: Send + 'static>(
    run: impl FnOnce() -> Result<T, Fault> + Send + 'static,
) -> Result<T, Fault> {
    const STACK: usize = 256 << 20;
    const PATIENCE: Duration = Duration::from_secs(60);
    let (send, outcome) = channel();
    let work = move || {
        // Nobody listens any more where the time is over.
        let _ = send.send(run());
    };
    std::thread::Builder::new()
        .name(READER.to_owned())
        .stack_size(STACK)
        .spawn(work)
        .map_err(|error| Fault::new(format!("no thread to read it on: {error}")))?;
    outcome.recv_timeout(PATIENCE).unwrap_or_else(|error| {
        Err(Fault::new(match error {
            RecvTimeoutError::Disconnected => {
                "naga, which reads shaders here, gave up on it without a message".to_owned()
            }
            RecvTimeoutError::Timeout => {
                format!("naga, which reads shaders here, did not come to an end in {PATIENCE:?}")
            }
        }))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_a_message() {
        let fault = isolated::<()>(|| panic!("on purpose")).unwrap_err();
        assert!(fault.message.contains("gave up on it"), "{fault:?}");
    }
}
