//! Work without the interpreter's lock: signals are heeded, and no panic gets past.

use crate::errors::bug;
use flexura::Interrupt;
use pyo3::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// How long a signal may wait. Asking takes the lock, which other threads of Python may hold for a while.
const PATIENCE: Duration = Duration::from_millis(20);

/// What a handler of signals raised.
type Raised = Arc<Mutex<Option<PyErr>>>;

/// Does some work with the lock released. The flag that the work is given is raised once a handler of signals raises an
/// exception, such as KeyboardInterrupt; that exception is what comes back then.
///
/// # Errors
/// What a handler raised; a panic, as an error that asks for a report.
pub fn released<T: Send>(py: Python<'_>, work: impl FnOnce(&Interrupt) -> T + Send) -> PyResult<T> {
    let raised: Raised = Arc::default();
    let interrupt = asking(raised.clone());
    let done = py.detach(|| catch_unwind(AssertUnwindSafe(|| work(&interrupt))));
    if let Some(error) = raised.lock().ok().and_then(|mut raised| raised.take()) {
        return Err(error);
    }
    done.map_err(|panic| {
        let words = panic.downcast_ref::<String>().map(String::as_str);
        let words = words.or_else(|| panic.downcast_ref::<&str>().copied());
        bug(words.unwrap_or("something went wrong without a word"))
    })
}

fn asking(raised: Raised) -> Interrupt {
    let last = Mutex::new(Instant::now());
    Interrupt::asking(move || {
        // Whoever finds it locked leaves the question to the one who has it.
        let Ok(mut last) = last.try_lock() else { return false };
        if last.elapsed() < PATIENCE {
            return false;
        }
        let answer = Python::attach(|py| py.check_signals());
        *last = Instant::now();
        match answer {
            Ok(()) => false,
            Err(error) => {
                if let Ok(mut raised) = raised.lock() {
                    *raised = Some(error);
                }
                true
            }
        }
    })
}
