//! Ctrl-C, and what asks a process to end: the study ends with what it has, a second time the command ends at once.

use crate::failure::INTERRUPTED;
use crate::screen;
use flexura::Interrupt;

/// The flag that is raised when somebody asks for the end.
pub fn listen() -> Interrupt {
    let interrupt = Interrupt::new();
    let raised = interrupt.clone();
    // Where nobody can listen, the system ends the command as ever.
    let _ = ctrlc::set_handler(move || {
        if raised.is_raised() {
            std::process::exit(INTERRUPTED.into());
        }
        raised.raise();
        screen::note("interrupted; ends with what there is, or at once when interrupted again");
    });
    interrupt
}
