//! A wish to end early, from another thread or from a signal.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A flag that a study looks at before every tangent that it factorises. Once it is raised the study ends with what it has
/// found. Clones share the flag.
#[derive(Clone, Debug, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// A flag that is not raised.
    pub fn new() -> Self {
        Self::default()
    }

    /// The flag itself, for those who raise it by other means, such as the handler of a signal.
    pub fn flag(&self) -> Arc<AtomicBool> {
        self.0.clone()
    }

    /// Asks for the end.
    pub fn raise(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Was the end asked for?
    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
