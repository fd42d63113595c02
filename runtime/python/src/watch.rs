//! Ctrl-C and the progress of a run: the work runs beside, this thread asks Python.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;
use symplectic_tape::Watch;

use crate::errors;

/// The time between two looks at signals.
const INTERVAL: Duration = Duration::from_millis(40);

/// Operations that take less than a few milliseconds.
const SHORT: f64 = 1e6;

/// Stops a run, and sees how far it is.
#[derive(Debug, Default)]
pub(crate) struct Pulse {
    start: f64,
    /// Whether the run ends before anybody could stop it: it needs no thread of its own.
    is_short: bool,
    /// Whether the run is to end.
    pub(crate) stop: Arc<AtomicBool>,
    /// The time since the start of a single trajectory, as bits.
    elapsed: AtomicU64,
    /// The number of trajectories that are finished.
    pub(crate) finished: AtomicU64,
}

impl Pulse {
    /// For runs from a time; `operations` are about those of all evaluations.
    pub(crate) fn new(start: f64, operations: f64) -> Arc<Self> {
        Arc::new(Pulse {
            start,
            is_short: operations < SHORT,
            ..Pulse::default()
        })
    }

    pub(crate) fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    fn elapsed(&self) -> f64 {
        f64::from_bits(self.elapsed.load(Ordering::Relaxed))
    }
}

impl Watch for Pulse {
    fn start(&self) -> f64 {
        self.start
    }

    fn evaluated(&self, elapsed: f64, _trajectories: usize) {
        self.elapsed.store(elapsed.to_bits(), Ordering::Relaxed);
    }
}

/// The progress of a run as Python sees it: a function of the elapsed time and of the number of finished trajectories.
pub(crate) type Shown<'a> = Option<&'a Bound<'a, PyAny>>;

/// Does work that may take long without the GIL, and stops it at a signal. Returns the result, which is then incomplete, with the exception
/// of the signal.
pub(crate) fn guarded<T: Send>(
    py: Python<'_>,
    pulse: &Pulse,
    progress: Shown<'_>,
    work: impl FnOnce() -> T + Send,
) -> PyResult<(T, Option<PyErr>)> {
    if pulse.is_short && progress.is_none() {
        let done = py.detach(|| catch_unwind(AssertUnwindSafe(work)));
        return Ok((done.map_err(|_| lost())?, None));
    }
    let progress = progress.map(|function| function.clone().unbind());
    let (done, interrupted) = py.detach(|| {
        let (sender, receiver) = channel();
        let mut interrupted = None;
        thread::scope(|scope| {
            scope.spawn(move || {
                let done = catch_unwind(AssertUnwindSafe(work));
                // The other end waits for it.
                let _ = sender.send(done);
            });
            loop {
                match receiver.recv_timeout(INTERVAL) {
                    Ok(done) => return (done.ok(), interrupted),
                    Err(RecvTimeoutError::Disconnected) => return (None, interrupted),
                    Err(RecvTimeoutError::Timeout) if interrupted.is_some() => {}
                    Err(RecvTimeoutError::Timeout) => {
                        let asked = Python::attach(|py| {
                            py.check_signals()?;
                            if let Some(progress) = &progress {
                                let finished = pulse.finished.load(Ordering::Relaxed);
                                progress.call1(py, (pulse.elapsed(), finished))?;
                            }
                            Ok(())
                        });
                        if let Err(error) = asked {
                            pulse.stop.store(true, Ordering::Relaxed);
                            interrupted = Some(error);
                        }
                    }
                }
            }
        })
    });
    match done {
        Some(done) => Ok((done, interrupted)),
        None => Err(lost()),
    }
}

/// The library panicked.
fn lost() -> PyErr {
    errors::internal(
        "the library made an error that it should not make; please report it with the call",
    )
}
