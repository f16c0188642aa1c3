//! A wish to end early, from another thread or from a signal.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Is the end wished for? Asked before every factorisation, from the thread that solves.
type Question = dyn Fn() -> bool + Send + Sync;

/// A flag that a study looks at before every tangent that it factorises. Once it is raised the study ends with what it has
/// found. Clones share the flag.
#[derive(Clone, Default)]
pub struct Interrupt {
    flag: Arc<AtomicBool>,
    question: Option<Arc<Question>>,
}

impl Interrupt {
    /// A flag that is not raised.
    pub fn new() -> Self {
        Self::default()
    }

    /// A flag that is raised by the first `true` that `question` answers: for hosts that tell of signals only when they are
    /// asked.
    pub fn asking(question: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        Self { flag: Arc::default(), question: Some(Arc::new(question)) }
    }

    /// The flag itself, for those who raise it by other means, such as the handler of a signal.
    pub fn flag(&self) -> Arc<AtomicBool> {
        self.flag.clone()
    }

    /// Asks for the end.
    pub fn raise(&self) {
        self.flag.store(true, Ordering::Relaxed);
    }

    /// Was the end asked for?
    pub fn is_raised(&self) -> bool {
        if self.flag.load(Ordering::Relaxed) {
            return true;
        }
        let is_wished = self.question.as_ref().is_some_and(|question| question());
        if is_wished {
            self.raise();
        }
        is_wished
    }
}

impl fmt::Debug for Interrupt {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_tuple("Interrupt").field(&self.flag).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_question_is_asked_until_it_is_answered_with_yes() {
        let asked = Arc::new(AtomicBool::new(false));
        let answer = asked.clone();
        let interrupt = Interrupt::asking(move || answer.load(Ordering::Relaxed));
        assert!(!interrupt.is_raised());
        asked.store(true, Ordering::Relaxed);
        assert!(interrupt.clone().is_raised());
        asked.store(false, Ordering::Relaxed);
        assert!(interrupt.is_raised(), "a flag stays raised");
    }
}
