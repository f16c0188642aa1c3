//! Ctrl-C, and what asks a process to end: the study ends with what it has, a second time the command ends at once.

use crate::failure::INTERRUPTED;
use flexura::Interrupt;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// The flag that is raised when somebody asks for the end.
pub fn listen() -> Interrupt {
    let interrupt = Interrupt::new();
    for signal in [SIGINT, SIGTERM] {
        // Looked at before the flag is raised, so that it counts the second time only. Where nobody can listen, the system
        // ends the command as ever.
        let _ = flag::register_conditional_shutdown(signal, INTERRUPTED.into(), interrupt.flag());
        let _ = flag::register(signal, interrupt.flag());
    }
    interrupt
}
