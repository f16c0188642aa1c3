//! Writing to the two streams. Colours are dropped where a stream is no terminal or NO_COLOR is set.

use crate::failure::Failure;
use clap::builder::styling::{AnsiColor, Style};
use std::io::{ErrorKind, Write};

pub const BOLD: Style = Style::new().bold();
pub const GOOD: Style = AnsiColor::Green.on_default().bold();
pub const BAD: Style = AnsiColor::Red.on_default().bold();
pub const NOTE: Style = AnsiColor::Yellow.on_default().bold();
pub const DIM: Style = Style::new().dimmed();

/// Text in a style.
pub fn styled(style: Style, text: &str) -> String {
    format!("{style}{text}{style:#}")
}

/// Writes to standard output. A reader that has gone away (`| head`) is no failure.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut stream = anstream::stdout().lock();
    match stream.write_all(text.as_bytes()).and_then(|()| stream.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::Machine(format!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Writes a note to standard error. When even that fails there is nobody left to tell.
pub fn note(text: &str) {
    let _ = writeln!(anstream::stderr().lock(), "{text}");
}

/// Writes a warning to standard error.
pub fn warn(text: &str) {
    note(&format!("{} {text}", styled(NOTE, "warning:")));
}

/// Writes an error to standard error; a message that is laid out already is left as it is.
pub fn complain(message: &str) {
    let message = message.trim_end();
    if message.contains('\n') || message.contains('\u{1b}') || message.starts_with("error") {
        note(message);
    } else {
        note(&format!("{} {message}", styled(BAD, "error:")));
    }
}
