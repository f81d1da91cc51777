//! An open device. All calls into its driver are made on one thread of its own, so that a driver that does not come
//! back (an endless shader, for OpenGL even before the first wait) costs the caller a time-out and nothing more.

use super::Error;
use super::adapter::{Adapter, Choice};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;
use wgpu::{DeviceDescriptor, ErrorFilter, Features, PollType};

/// How long a device may take for one call, unless told otherwise.
pub const DEFAULT_TIMEOUT: Duration = Duration::from_secs(10);

/// What lives on the device's thread.
pub(super) struct Context {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    /// Compiled programs; an index into this list stands for one outside.
    pub programs: Vec<wgpu::ComputePipeline>,
    /// Why the device was lost, once it is.
    lost: Arc<OnceLock<String>>,
}

type Job = Box<dyn FnOnce(&mut Context) + Send>;

/// An open device. Clones are the same device.
#[derive(Clone)]
pub struct Device(Arc<Opened>);

struct Opened {
    name: String,
    features: Features,
    limits: wgpu::Limits,
    timeout: Duration,
    /// Set by the first call that timed out: the thread hangs in the driver.
    is_stuck: OnceLock<()>,
    jobs: Mutex<Option<Sender<Job>>>,
    thread: Option<JoinHandle<()>>,
}

impl Device {
    /// Opens an adapter with the [`DEFAULT_TIMEOUT`].
    ///
    /// # Errors
    ///
    /// [`Error::Unavailable`] where there is no such adapter, [`Error::Lost`] where the driver refuses to open it,
    /// [`Error::TimedOut`] where it does not answer.
    pub fn open(choice: &Choice) -> Result<Self, Error> {
        Self::open_with_timeout(choice, DEFAULT_TIMEOUT)
    }

    /// Opens an adapter; each later call may take `timeout`.
    ///
    /// # Errors
    ///
    /// Those of [`Device::open`].
    pub fn open_with_timeout(choice: &Choice, timeout: Duration) -> Result<Self, Error> {
        let (send_opened, opened) = channel::<Result<(String, Features, wgpu::Limits), Error>>();
        let (jobs, received) = channel::<Job>();
        let wanted = choice.clone();
        let thread = thread::Builder::new()
            .name("gpu".to_owned())
            .spawn(move || {
                let mut context = match wanted.find().map_err(Error::from).and_then(|a| open(&a)) {
                    Ok((name, context)) => {
                        let found = (name, context.device.features(), context.device.limits());
                        if send_opened.send(Ok(found)).is_err() {
                            return;
                        }
                        context
                    }
                    Err(error) => {
                        // Nobody listens any more where the caller's time is over.
                        let _ = send_opened.send(Err(error));
                        return;
                    }
                };
                for job in received {
                    job(&mut context);
                }
            })
            .map_err(|error| Error::Lost(error.to_string()))?;
        let (name, features, limits) =
            opened.recv_timeout(timeout).map_err(|_| Error::TimedOut(timeout))??;
        Ok(Self(Arc::new(Opened {
            name,
            features,
            limits,
            timeout,
            is_stuck: OnceLock::new(),
            jobs: Mutex::new(Some(jobs)),
            thread: Some(thread),
        })))
    }

    /// Returns the [`Adapter::name`] of the device.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.0.name
    }

    /// Returns whether the device can tell how long a program took on it.
    #[must_use]
    pub fn has_timestamps(&self) -> bool {
        self.0.features.contains(Features::TIMESTAMP_QUERY)
    }

    pub(super) fn limits(&self) -> &wgpu::Limits {
        &self.0.limits
    }

    /// Runs a job on the device's thread and waits for it, no longer than the device's time limit.
    pub(super) fn call<T: Send + 'static>(
        &self,
        job: impl FnOnce(&mut Context) -> Result<T, Error> + Send + 'static,
    ) -> Result<T, Error> {
        let timed_out = || Error::TimedOut(self.0.timeout);
        if self.0.is_stuck.get().is_some() {
            return Err(timed_out());
        }
        let (send_result, result) = channel();
        let sent = {
            let jobs = self.0.jobs.lock().unwrap_or_else(PoisonError::into_inner);
            jobs.as_ref().is_some_and(|jobs| {
                jobs.send(Box::new(move |context| {
                    // The caller may have given up.
                    let _ = send_result.send(context.guarded(job));
                }))
                .is_ok()
            })
        };
        let ended = || Error::Lost("its thread has ended".to_owned());
        if !sent {
            return Err(ended());
        }
        match result.recv_timeout(self.0.timeout) {
            Ok(result) => result,
            Err(RecvTimeoutError::Disconnected) => Err(ended()),
            Err(RecvTimeoutError::Timeout) => {
                self.0.is_stuck.get_or_init(|| ());
                Err(timed_out())
            }
        }
    }

    /// Gives the device up, as a driver does after a fault; every later call is an error.
    ///
    /// # Errors
    ///
    /// Those of a device that was lost before.
    pub fn destroy(&self) -> Result<(), Error> {
        self.call(|context| {
            context.device.destroy();
            context.wait()
        })
    }
}

impl Drop for Opened {
    fn drop(&mut self) {
        *self.jobs.get_mut().unwrap_or_else(PoisonError::into_inner) = None;
        // Drivers are not torn down while the process ends. A thread that hangs is left alone.
        if let Some(thread) = self.thread.take().filter(|_| self.is_stuck.get().is_none()) {
            let _ = thread.join();
        }
    }
}

impl core::fmt::Debug for Device {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "Device({})", self.name())
    }
}

impl Context {
    /// Runs a job; what the driver complains about meanwhile is the error.
    fn guarded<T>(&mut self, job: impl FnOnce(&mut Self) -> Result<T, Error>) -> Result<T, Error> {
        let device = self.device.clone();
        let filters = [ErrorFilter::Internal, ErrorFilter::OutOfMemory, ErrorFilter::Validation];
        let scopes = filters.map(|filter| device.push_error_scope(filter));
        let result = job(self);
        let mut complaint = None;
        for scope in scopes.into_iter().rev() {
            complaint = pollster::block_on(scope.pop()).or(complaint);
        }
        if let Some(reason) = self.lost.get() {
            return Err(Error::Lost(reason.clone()));
        }
        match complaint {
            None => result,
            Some(wgpu::Error::OutOfMemory { .. }) => Err(Error::OutOfMemory),
            Some(error) => Err(Error::Validation(error.to_string())),
        }
    }

    /// Waits for all work to end.
    pub fn wait(&self) -> Result<(), Error> {
        match self.device.poll(PollType::wait_indefinitely()) {
            Ok(_) => Ok(()),
            Err(error) => Err(Error::Lost(error.to_string())),
        }
    }
}

fn open(adapter: &Adapter) -> Result<(String, Context), Error> {
    let adapter_of = &adapter.0;
    let descriptor = DeviceDescriptor {
        label: None,
        required_features: adapter_of.features() & Features::TIMESTAMP_QUERY,
        required_limits: adapter_of.limits(),
        ..DeviceDescriptor::default()
    };
    let (device, queue) = pollster::block_on(adapter_of.request_device(&descriptor))
        .map_err(|error| Error::Lost(error.to_string()))?;
    let lost = Arc::new(OnceLock::new());
    let slot = Arc::clone(&lost);
    device.set_device_lost_callback(move |reason, message| {
        slot.get_or_init(|| format!("{reason:?} {message}").trim().to_owned());
    });
    // Scopes catch what a call does wrong; anything else leaves the device in an unknown state.
    let slot = Arc::clone(&lost);
    device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
        slot.get_or_init(|| error.to_string());
    }));
    Ok((adapter.name(), Context { device, queue, programs: Vec::new(), lost }))
}
